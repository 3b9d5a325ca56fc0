//! Settings of the cycle: mesh, method, loads and boundary conditions.

use super::{
    BaseMotion, BoxLoad, Damping, Dimension, GroundBeyond, HeldBox, Mesh, PlaneCondition,
    PlanePressure, PointLoad, StandingWater, StressScheme, TimeStep, Traction, Transfer, Vector,
    VolumetricStrain, Weighting,
};

/// Treatment of a particle that leaves the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// The run stops with a typed error.
    Stop,
    /// The particle is removed and recorded with its mass.
    Remove,
}

/// Reaction to a balance of the run that does not hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnImbalance {
    /// The run goes on, and says at its end since when it is not to be trusted.
    Tell,
    /// The run stops with a typed error.
    Stop,
}

/// Settings of the cycle: what it reads beside the bodies. Values are taken as they are; whoever makes them has checked them.
#[derive(Clone, Debug)]
pub struct CycleSettings {
    /// Number of space dimensions.
    pub dimension: Dimension,
    /// Background mesh.
    pub mesh: Mesh,
    /// Choice of the time step.
    pub time_step: TimeStep,
    /// Acceleration of gravity \[m/s²\].
    pub gravity: Vector,
    /// Weighting function `S_Ip`.
    pub weighting: Weighting,
    /// Stress scheme: the place of the stress update in the cycle.
    pub scheme: StressScheme,
    /// Transfer of velocity between particles and nodes.
    pub transfer: Transfer,
    /// Numerical damping.
    pub damping: Damping,
    /// Motion of one boundary plane, if any.
    pub base_motion: Option<BaseMotion>,
    /// The ground beyond absorbing planes.
    pub ground_beyond: GroundBeyond,
    /// Boxes in which nodes stand still.
    pub held_boxes: Vec<HeldBox>,
    /// Forces on nodes, constant in time.
    pub point_loads: Vec<PointLoad>,
    /// Tractions on rectangles that are fixed in space.
    pub tractions: Vec<Traction>,
    /// Total forces that are spread over particles at the start.
    pub box_loads: Vec<BoxLoad>,
    /// Particles per cell along the first axis, whose rows bear tractions where the scene is axisymmetric.
    pub radial_particles: usize,
    /// True where the motion of a body is prescribed.
    pub drives_bodies: bool,
    /// Condition of each boundary plane for the pore water, where bodies have any.
    pub water_planes: Option<[[PlaneCondition; 2]; 3]>,
    /// Pressure of the pore water at each boundary plane where one is given.
    pub water_pressures: [[Option<PlanePressure>; 2]; 3],
    /// Density of the pore water of all bodies \[kg/m³\]; 0 without.
    pub water_density: f64,
    /// Waters that stand beside bodies.
    pub standing_waters: Vec<StandingWater>,
    /// Averaging of the volumetric part of strain and stress.
    pub volumetric_strain: VolumetricStrain,
    /// True where a body has a stress at the start.
    pub starts_stressed: bool,
    /// Treatment of a particle that leaves the mesh.
    pub outside: Outside,
    /// Reaction to an imbalance of energy, momentum or a strain increment.
    pub on_imbalance: OnImbalance,
}

impl CycleSettings {
    /// True if a boundary plane has a condition: 0 the lower, 1 the upper plane of the axis. A moving base is one.
    #[must_use]
    pub fn plane_acts(&self, axis: usize, side: usize) -> bool {
        plane_acts(&self.mesh, self.base_motion.as_ref(), axis, side)
    }

    /// The absorbing planes: axis of the normal, and 0 for the lower or 1 for the upper plane.
    pub fn absorbing_planes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.planes_that_are(PlaneCondition::Absorbing)
    }

    /// The antisymmetric planes that bear the stress of the start.
    pub fn bearing_planes(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let planes = self.planes_that_are(PlaneCondition::Antisymmetric);
        planes.filter(|_| self.starts_stressed)
    }

    fn planes_that_are(
        &self,
        condition: PlaneCondition,
    ) -> impl Iterator<Item = (usize, usize)> + '_ {
        let planes = (0..self.dimension.axes()).flat_map(|axis| [(axis, 0), (axis, 1)]);
        planes.filter(move |(axis, side)| self.mesh.planes[*axis][*side] == condition)
    }

    /// True if a plane has reactions.
    #[must_use]
    pub fn has_reactions(&self) -> bool {
        self.absorbs() || self.bearing_planes().next().is_some()
    }

    /// True if a plane is absorbing.
    #[must_use]
    pub fn absorbs(&self) -> bool {
        self.absorbing_planes().next().is_some()
    }

    /// Axis and side of the plane that shakes, as a base or by a wave.
    #[must_use]
    pub fn shaken_plane(&self) -> Option<(usize, usize)> {
        let wave = self.ground_beyond.incoming.as_ref();
        (self.base_motion.as_ref().or(wave)).map(|base| (base.axis, base.side))
    }

    /// True if free ground moves beside absorbing sides.
    #[must_use]
    pub fn has_free_ground(&self) -> bool {
        self.shaken_plane()
            .is_some_and(|(axis, _)| self.free_sides(axis).next().is_some())
    }

    /// The absorbing planes beside a plane that shakes.
    pub fn free_sides(&self, shaken: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        (self.absorbing_planes()).filter(move |(axis, _)| *axis != shaken)
    }
}

/// True if a boundary plane of a mesh has a condition, or is the moving base.
#[must_use]
pub fn plane_acts(mesh: &Mesh, base: Option<&BaseMotion>, axis: usize, side: usize) -> bool {
    mesh.planes[axis][side] != PlaneCondition::Free
        || base.is_some_and(|base| (base.axis, base.side) == (axis, side))
}
