//! The scene: what is simulated, as checked values.
//!
//! A [`Scene`] is plain data in SI units. Whoever fills its fields, a library user or a reader of files, calls
//! [`Scene::check`]. Nothing behind this module sees a value that was not checked.
//!
//! Vectors always have three components; in two dimensions (plane strain, x-y) the third is zero.

mod body;
mod build;
mod check;
mod error;
mod initial_stress;
mod material;
mod mortar;
mod overburden;
mod pressure;
mod results;
mod state_file;

pub use body::Body;
pub use build::BodyEntry;
pub use error::{Location, Problem, SceneError};
pub use initial_stress::InitialStress;
pub use material::Material;
pub use mortar::MOST_CREEP;
pub use overburden::Overburden;
pub use pressure::{HeldPressure, InitialPressure};
pub use results::{Field, NodalField, Probe, ProbeTarget, ProbedQuantity, Results};
pub use state_file::StateFile;

use proctor_contact::{Contact, ContactValues, Mortar, PlannedBody, RigidSurface};
use proctor_kernel::laws::AnyLaw;
use proctor_kernel::model::{
    BaseMotion, BoxLoad, CycleSettings, Damping, Dimension, GroundBeyond, HeldBox, Mesh,
    OnImbalance, Outside, PlaneCondition, PlanePressure, PointLoad, PoreWater, StandingWater,
    StressScheme, TimeStep, Traction, Transfer, TransferKind, Vector, VolumetricStrain, Weighting,
    plane_acts,
};

/// Everything that is simulated.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name shown in summaries; for a file, its stem.
    pub name: String,
    /// Number of space dimensions.
    pub dimension: Dimension,
    /// End time \[s\].
    pub time: f64,
    /// Share of the weight below which the sum of the unbalanced forces at the nodes ends a run before that.
    pub until: Option<f64>,
    /// Choice of the time step.
    pub time_step: TimeStep,
    /// Acceleration of gravity \[m/s²\].
    pub gravity: Vector,
    /// Background mesh.
    pub mesh: Mesh,
    /// Weighting function `S_Ip`.
    pub weighting: Weighting,
    /// Stress scheme: the place of the stress update in the cycle.
    pub scheme: StressScheme,
    /// Transfer of velocity between particles and nodes.
    pub transfer: Transfer,
    /// Averaging of the volumetric part of strain and stress.
    pub volumetric_strain: VolumetricStrain,
    /// Materials; bodies refer to them by index.
    pub materials: Vec<Material>,
    /// Water in the pores of each material, by its index; empty where there is one phase. The density of the grains is that of
    /// the material.
    pub pore_water: Vec<Option<PoreWater>>,
    /// Condition of each boundary plane for the pore water, as those of the mesh are for bodies; `Sliding` lets none through.
    pub water_planes: [[PlaneCondition; 2]; 3],
    /// Pressure of the pore water at each boundary plane where one is given; the plane is `Free` for the water.
    pub water_pressures: [[Option<PlanePressure>; 2]; 3],
    /// Waters that stand beside bodies and press on their surfaces.
    pub standing_waters: Vec<StandingWater>,
    /// Pore pressures at the start.
    pub initial_pressures: Vec<InitialPressure>,
    /// Pore pressures that particles keep, in their order: of two boxes that overlap the later one counts.
    pub held_pressures: Vec<HeldPressure>,
    /// Bodies, in the order of the file.
    pub bodies: Vec<Body>,
    /// The run from whose end bodies begin, if any.
    pub initial_state: Option<StateFile>,
    /// Rigid surfaces (3D), the terrain among them.
    pub surfaces: Vec<RigidSurface>,
    /// Numerical damping.
    pub damping: Damping,
    /// Motion of one boundary plane, if any ("earthquake").
    pub base_motion: Option<BaseMotion>,
    /// The ground beyond absorbing planes: a wave that comes in, springs.
    pub ground_beyond: GroundBeyond,
    /// Boxes in which nodes stand still.
    pub held_boxes: Vec<HeldBox>,
    /// Forces on nodes, constant in time.
    pub point_loads: Vec<PointLoad>,
    /// Tractions on rectangles that are fixed in space, integrated over the nodal basis.
    pub tractions: Vec<Traction>,
    /// Total forces spread over the particles that lie in a box at the start, and move with them.
    pub box_loads: Vec<BoxLoad>,
    /// Pairs of bodies in contact.
    pub contacts: Vec<Contact>,
    /// Factor lambda of the real-distance correction: contact acts where the surfaces of the particles of a pair are
    /// closer than lambda cells (contact manual, section 1.2). 0 switches the correction off. `None`: the sum of the
    /// half-lengths of the particles of both bodies, which is the manual's 0.5 with two particles per cell and axis.
    ///
    /// The shape of a driven body touches a particle at the half-length of that particle; with a factor above 0 at lambda
    /// cells less the half-length of its own particles.
    pub contact_distance: Option<f64>,
    /// Mortar contact, with the boundaries and rigid lines that it needs.
    pub mortar: Mortar,
    /// Treatment of a particle that leaves the mesh.
    pub outside: Outside,
    /// Reaction to an imbalance of energy, momentum or a strain increment.
    pub on_imbalance: OnImbalance,
    /// Results that are written, and their interval.
    pub results: Results,
    /// Particles whose history is written to `history.csv`.
    pub probes: Vec<Probe>,
    /// Number of threads asked for by the scene; the command line overrides it.
    pub threads: Option<usize>,
}

impl Scene {
    /// A scene with nothing in it and the default of every choice: automatic time step, no gravity, uGIMP, USL,
    /// FLIP, no damping, ten outputs, stop when a particle leaves the mesh. Add materials and bodies, then
    /// [`Scene::check`] it.
    ///
    /// uGIMP, USL and ten outputs are what the manuals' program does when its input is silent.
    #[must_use]
    pub fn new(dimension: Dimension, mesh: Mesh, time: f64) -> Self {
        Self {
            name: "scene".to_owned(),
            dimension,
            time,
            until: None,
            time_step: TimeStep::Automatic,
            gravity: [0.0; 3],
            mesh,
            weighting: Weighting::UniformGimp,
            scheme: StressScheme::Usl,
            transfer: Transfer::new(TransferKind::Flip),
            volumetric_strain: VolumetricStrain::Particle,
            materials: Vec::new(),
            pore_water: Vec::new(),
            water_planes: [[PlaneCondition::Sliding; 2]; 3],
            water_pressures: Default::default(),
            standing_waters: Vec::new(),
            initial_pressures: Vec::new(),
            held_pressures: Vec::new(),
            bodies: Vec::new(),
            initial_state: None,
            surfaces: Vec::new(),
            damping: Damping::None,
            base_motion: None,
            ground_beyond: GroundBeyond::default(),
            held_boxes: Vec::new(),
            point_loads: Vec::new(),
            tractions: Vec::new(),
            box_loads: Vec::new(),
            contacts: Vec::new(),
            contact_distance: None,
            mortar: Mortar::default(),
            outside: Outside::Stop,
            on_imbalance: OnImbalance::Tell,
            results: Results::default(),
            probes: Vec::new(),
            threads: None,
        }
    }

    /// The law of a body: that of its material, or the one that remembers the pressure of its start.
    #[must_use]
    pub(crate) fn law_of(&self, body: &Body) -> AnyLaw {
        let law = &self.materials[body.material].law;
        let pressed = match body.initial_stress {
            InitialStress::None => None,
            _ => law.pressed(),
        };
        pressed.unwrap_or_else(|| law.clone())
    }

    /// True where materials have water in their pores.
    #[must_use]
    pub fn has_water(&self) -> bool {
        !self.pore_water.is_empty()
    }

    /// Water in the pores of a material, by its index, with the density of its grains.
    #[must_use]
    pub fn water_of(&self, material: usize) -> Option<PoreWater> {
        let water = (*self.pore_water.get(material)?)?;
        Some(PoreWater {
            grain_density: self.materials[material].density,
            ..water
        })
    }

    /// Size of a cell \[m\]: its side, or the mean of sides that differ, that of the cube as large.
    #[must_use]
    pub fn size_of_cell(&self) -> f64 {
        let sides = &self.mesh.cell[..self.dimension.axes()];
        if sides.iter().all(|side| *side == sides[0]) {
            sides[0]
        } else {
            libm::pow(sides.iter().product(), 1.0 / sides.len() as f64)
        }
    }

    /// Share of the largest stable step of the table that a body bears. A rod on the axis of revolution has radial and hoop strain by
    /// one free node, and is stiffer than all bodies of the plane; a thin ring is by less, the farther it is from the axis.
    #[must_use]
    pub fn step_share(&self, body: &Body) -> f64 {
        let h = self.mesh.cell[0];
        match body.shape.bounds() {
            Some([low, high]) if self.mesh.axisymmetric => {
                let inner = low[0].max(0.0);
                if high[0] - inner >= Self::THICK * h {
                    return 1.0;
                }
                // Hoop strain over radial strain is at most h/r.
                let middle = 0.5 * (inner + high[0]);
                (middle / (middle + h)).max(Self::OF_RODS)
            }
            _ => 1.0,
        }
    }

    /// Radial thickness in cells from which a body takes the steps of the plane.
    const THICK: f64 = 2.0;
    /// Share for rods: the square of the largest frequency is at most four times that of the plane, 2/(1 - nu) in a solid.
    const OF_RODS: f64 = 0.5;

    /// True if a boundary plane has a condition: 0 the lower, 1 the upper plane of the axis. A moving base is one.
    #[must_use]
    pub fn plane_acts(&self, axis: usize, side: usize) -> bool {
        plane_acts(&self.mesh, self.base_motion.as_ref(), axis, side)
    }

    /// The values that the cycle reads.
    #[must_use]
    pub fn settings(&self) -> CycleSettings {
        let mut bodies = self.bodies.iter();
        CycleSettings {
            dimension: self.dimension,
            mesh: self.mesh.clone(),
            time_step: self.time_step,
            gravity: self.gravity,
            weighting: self.weighting,
            scheme: self.scheme,
            transfer: self.transfer,
            damping: self.damping,
            base_motion: self.base_motion.clone(),
            ground_beyond: self.ground_beyond.clone(),
            held_boxes: self.held_boxes.clone(),
            point_loads: self.point_loads.clone(),
            tractions: self.tractions.clone(),
            box_loads: self.box_loads.clone(),
            radial_particles: self
                .bodies
                .first()
                .map_or(1, |body| body.particles_per_cell[0]),
            water_planes: self.has_water().then_some(self.water_planes),
            water_pressures: self.water_pressures.clone(),
            water_density: self
                .pore_water
                .iter()
                .flatten()
                .next()
                .map_or(0.0, |water| water.density),
            standing_waters: self.standing_waters.clone(),
            volumetric_strain: self.volumetric_strain,
            drives_bodies: bodies.clone().any(|body| body.motion.is_some()),
            starts_stressed: self.initial_state.is_some()
                || !self.initial_pressures.is_empty()
                || !self.held_pressures.is_empty()
                || bodies.any(|body| body.initial_stress != InitialStress::None),
            outside: self.outside,
            on_imbalance: self.on_imbalance,
        }
    }

    /// The values that contact reads.
    #[must_use]
    pub fn contact_values(&self) -> ContactValues {
        ContactValues {
            contacts: self.contacts.clone(),
            distance: self.contact_distance,
            mortar: self.mortar.clone(),
            surfaces: self.surfaces.clone(),
        }
    }

    /// The bodies, for the words of a plan.
    pub(crate) fn planned_bodies(&self) -> Vec<PlannedBody<'_>> {
        let bodies = self.bodies.iter().map(|body| PlannedBody {
            id: body.id,
            shape: &body.shape,
            motion: body.motion.as_ref(),
        });
        bodies.collect()
    }
}
