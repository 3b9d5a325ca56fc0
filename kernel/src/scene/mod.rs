//! The scene: what is simulated, as checked values.
//!
//! A [`Scene`] is plain data in SI units. It is built in one of two ways: by a library user, who fills the
//! fields and calls [`Scene::check`], or from a JSON file (feature `json`) through the raw stage, which also
//! calls `check`. Nothing behind this module sees a value that was not checked.
//!
//! Vectors always have three components; in two dimensions (plane strain, x-y) the third is zero.

use std::sync::Arc;

/// A vector in SI units, in axis order x, y, z. In two dimensions the third component is zero.
pub type Vector = [f64; 3];

/// Number of space dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Plane strain in the x-y plane, unit thickness (1 m).
    Two,
    /// Three dimensions.
    Three,
}

impl Dimension {
    /// Number of axes, 2 or 3.
    #[must_use]
    pub fn axes(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}

/// Everything that is simulated.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name shown in summaries; for a file, its stem.
    pub name: String,
    /// Number of space dimensions.
    pub dimension: Dimension,
    /// End time \[s\].
    pub time: f64,
    /// How the time step is chosen.
    pub time_step: TimeStep,
    /// Acceleration of gravity \[m/s²\].
    pub gravity: Vector,
    /// Background mesh.
    pub mesh: Mesh,
    /// Weighting function S_Ip.
    pub weighting: Weighting,
    /// When the stress is updated in the cycle.
    pub scheme: StressScheme,
    /// How velocity is carried between particles and nodes.
    pub transfer: Transfer,
    /// Materials; bodies refer to them by index.
    pub materials: Vec<Material>,
    /// Bodies, in the order of the file.
    pub bodies: Vec<Body>,
    /// Numerical damping.
    pub damping: Damping,
    /// Motion of one boundary plane, if any ("earthquake").
    pub base_motion: Option<BaseMotion>,
    /// Forces on nodes, constant in time.
    pub point_loads: Vec<PointLoad>,
    /// Tractions on rectangles that are fixed in space, integrated over the nodal basis.
    pub tractions: Vec<Traction>,
    /// Total forces spread over the particles that lie in a box at the start, and move with them.
    pub box_loads: Vec<BoxLoad>,
    /// What happens to a particle that leaves the mesh.
    pub outside: Outside,
    /// What is written, and how often.
    pub results: Results,
    /// Particles whose history is written to `history.csv`.
    pub probes: Vec<Probe>,
    /// Number of threads asked for by the scene; the command line overrides it.
    pub threads: Option<usize>,
}

/// How the time step is chosen. The critical step of the scheme is the ceiling in every case, unless
/// `allow_unstable` lifts it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimeStep {
    /// A safe fraction of the scheme's own stability bound, chosen anew in each step.
    Automatic,
    /// `multiplier` times min(h) / max(c + |v|), the manual's `critical_time_step_multiplier`.
    Multiplier {
        /// Factor on min(h) / max(c + |v|), dimensionless, positive.
        multiplier: f64,
        /// Run even where the scheme's own bound says unstable.
        allow_unstable: bool,
    },
    /// A constant step.
    Fixed {
        /// Time step \[s\].
        dt: f64,
        /// Run even where the scheme's own bound says unstable.
        allow_unstable: bool,
    },
}

/// Regular background mesh of equal cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Lower corner \[m\].
    pub origin: Vector,
    /// Edges of a cell \[m\]; the third is 1 in two dimensions.
    pub cell: Vector,
    /// Number of cells per axis; the third is 1 in two dimensions.
    pub cells: [usize; 3],
    /// Condition of each boundary plane, `planes[axis][side]`, side 0 lower (`X0`), 1 upper (`Xn`).
    pub planes: [[PlaneCondition; 2]; 3],
}

/// Condition on a boundary plane of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlaneCondition {
    /// No condition.
    Free,
    /// Normal velocity zero, tangential free. A plane that is not named is sliding.
    Sliding,
    /// Velocity zero.
    Fixed,
}

/// Weighting function S_Ip (technical manual, section 2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weighting {
    /// Linear hat N_I at the particle position (classical MPM).
    Linear,
    /// GIMP with a particle domain that keeps its initial size (uGIMP; what the manual's peer calls GIMP).
    UniformGimp,
    /// GIMP with a particle domain that follows the deformation (cpGIMP).
    ContiguousGimp(DomainUpdate),
    /// Quadratic B-spline.
    QuadraticBSpline,
}

/// How the half-lengths l_p of a cpGIMP particle domain follow the deformation gradient F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DomainUpdate {
    /// l_p = l_p0 (det F)^(1/d).
    Determinant,
    /// l_p,i = l_p0,i U_ii, with U the right stretch tensor.
    Stretch,
}

/// When the stress is updated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StressScheme {
    /// Update stress first.
    Usf,
    /// Update stress last.
    Usl,
    /// Modified update stress last.
    Musl,
}

/// How velocity is carried between particles and nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transfer {
    /// Kind of transfer.
    pub kind: TransferKind,
    /// Share of the interpolated nodal velocity in the particle velocity, 0 (FLIP) to 1 (PIC).
    pub pic_fraction: f64,
}

/// Kind of velocity transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferKind {
    /// Particle velocity alone is carried to the nodes.
    Flip,
    /// Affine particle-in-cell (Jiang et al. 2015): carries B_p D_p^-1 (x_I - x_p) as well.
    Apic,
    /// Taylor particle-in-cell: carries the velocity gradient.
    Tpic,
}

/// A material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Initial mass density \[kg/m³\].
    pub density: f64,
    /// Constitutive law.
    pub law: Law,
}

/// Constitutive law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Hypoelastic, linear in the rate of deformation.
    LinearElastic {
        /// Young's modulus \[Pa\].
        young: f64,
        /// Poisson's ratio.
        poisson: f64,
        /// Objective rate.
        rate: ObjectiveRate,
    },
    /// Compressible neo-Hookean: sigma = (mu (F F^T - 1) + lambda ln J 1) / J.
    NeoHookean {
        /// Young's modulus at small strain \[Pa\].
        young: f64,
        /// Poisson's ratio at small strain.
        poisson: f64,
    },
}

impl Law {
    /// Young's modulus \[Pa\] and Poisson's ratio.
    #[must_use]
    pub fn young_poisson(self) -> (f64, f64) {
        match self {
            Self::LinearElastic { young, poisson, .. } | Self::NeoHookean { young, poisson } => {
                (young, poisson)
            }
        }
    }

    /// First Lamé parameter lambda = E nu / ((1 + nu)(1 - 2 nu)) \[Pa\].
    #[must_use]
    pub fn lambda(self) -> f64 {
        let (e, nu) = self.young_poisson();
        e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus G = E / (2 (1 + nu)) \[Pa\].
    #[must_use]
    pub fn shear(self) -> f64 {
        let (e, nu) = self.young_poisson();
        e / (2.0 * (1.0 + nu))
    }
}

/// Objective stress rate of the hypoelastic law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectiveRate {
    /// Hughes and Winget 1980: exact for rigid rotation increments.
    HughesWinget,
    /// Jaumann rate, forward Euler, as in the manuals; grows under rotation. For comparison.
    JaumannForward,
}

/// A body: one material, one set of particles.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name of the entry, for messages.
    pub name: String,
    /// Identifier given in the scene.
    pub id: i64,
    /// Index into [`Scene::materials`].
    pub material: usize,
    /// Shape.
    pub shape: Shape,
    /// Particles per cell and axis; the third is 1 in two dimensions.
    pub particles_per_cell: [usize; 3],
    /// Initial velocity \[m/s\].
    pub velocity: Vector,
    /// Prescribed velocity: the body moves so whatever acts on it.
    pub motion: Option<History>,
}

/// Shape of a body, in the coordinates of the scene \[m\].
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Axis-aligned box between two corners; a rectangle in two dimensions.
    Cuboid {
        /// Lower corner.
        p1: Vector,
        /// Upper corner.
        p2: Vector,
    },
    /// Sphere; a disc in two dimensions.
    Sphere {
        /// Centre.
        center: Vector,
        /// Radius.
        radius: f64,
    },
    /// Ring between two radii (2D).
    Ring {
        /// Centre.
        center: Vector,
        /// Inner radius.
        inner: f64,
        /// Outer radius.
        outer: f64,
    },
    /// Circular cylinder between the centres of its two end faces (3D).
    Cylinder {
        /// Centre of the first end face.
        p1: Vector,
        /// Centre of the second end face.
        p2: Vector,
        /// Radius.
        radius: f64,
    },
    /// Simple polygon, either orientation, not closed (2D).
    Polygon {
        /// Corners; the third component is unused.
        points: Vec<Vector>,
    },
    /// Simple polygon extruded along an axis (3D).
    ExtrudedPolygon {
        /// Corners in the plane of the two other axes, in axis order.
        points: Vec<[f64; 2]>,
        /// Axis of extrusion, 0 to 2.
        axis: usize,
        /// Lower and upper coordinate along the axis.
        range: [f64; 2],
    },
    /// Particles given one by one.
    Particles(Arc<Vec<ParticleSeed>>),
}

/// One particle of a particle list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleSeed {
    /// Position \[m\].
    pub position: Vector,
    /// Volume \[m³\]; in two dimensions area times unit thickness.
    pub volume: f64,
}

/// Numerical damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// None.
    None,
    /// Local damping, f = -alpha |f_unb| sign(v) per component (technical manual, section 8).
    Local {
        /// Factor, 0 to 1.
        alpha: f64,
    },
    /// Kinetic damping (dynamic relaxation): velocities are set to zero at each peak of kinetic energy.
    Kinetic,
    /// f_I = -alpha m_I sqrt(E / (rho h²)) v_I (Liang et al. 2024, eq. 20).
    Viscous {
        /// Factor, dimensionless, not negative.
        alpha: f64,
    },
}

/// A vector given at times, linear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Times \[s\], strictly increasing.
    pub times: Vec<f64>,
    /// Values at the times; constant before the first and after the last.
    pub values: Vec<Vector>,
}

/// Prescribed motion of one boundary plane of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseMotion {
    /// Axis of the normal of the plane.
    pub axis: usize,
    /// 0 the lower, 1 the upper plane of that axis.
    pub side: usize,
    /// What is prescribed.
    pub motion: Motion,
}

/// A prescribed motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Acceleration \[m/s²\], linear between the times, zero before the first and after the last: velocity
    /// is kept when the record ends. Velocity starts at zero.
    Acceleration(History),
    /// Velocity \[m/s\], linear between the times, constant outside.
    Velocity(History),
}

/// Force on one node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLoad {
    /// Position of the node \[m\].
    pub position: Vector,
    /// Force \[N\]; per metre of thickness in two dimensions.
    pub force: Vector,
}

/// Constant traction on an axis-aligned rectangle (a segment in two dimensions) fixed in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traction {
    /// Lower corner \[m\].
    pub p1: Vector,
    /// Upper corner \[m\]; equal to `p1` along exactly one axis, the normal.
    pub p2: Vector,
    /// Traction \[Pa\].
    pub traction: Vector,
}

/// Total force spread by volume over the particles in a box at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxLoad {
    /// Lower corner \[m\].
    pub p1: Vector,
    /// Upper corner \[m\].
    pub p2: Vector,
    /// Total force \[N\].
    pub force: Vector,
}

/// What happens to a particle that leaves the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// The run stops with a typed error.
    Stop,
    /// The particle is removed and recorded with its mass.
    Remove,
}

/// What is written, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// Number of equal time intervals at whose ends frames and history rows are written, besides the
    /// initial state. 0: nothing but the summary.
    pub print: usize,
    /// Particle fields in the frames.
    pub fields: Vec<Field>,
    /// Write a checkpoint with each frame (the last one is kept).
    pub checkpoint: bool,
}

/// A particle field that frames can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// Particle identifier.
    Id,
    /// Material identifier.
    Material,
    /// Body identifier.
    Body,
    /// 1 for every particle that is written.
    Active,
    /// Mass \[kg\].
    Mass,
    /// Volume \[m³\].
    Volume,
    /// Mass density \[kg/m³\].
    Density,
    /// Displacement since the start \[m\].
    Displacement,
    /// Velocity \[m/s\].
    Velocity,
    /// Cauchy stress \[Pa\], six components.
    Stress,
    /// Mean pressure -tr(sigma)/3 \[Pa\].
    Pressure,
    /// Deformation gradient, nine components; only where the plan keeps it.
    DeformationGradient,
    /// External force on the particle \[N\]: weight and box loads.
    ExternalForce,
}

/// A particle whose state is written to `history.csv`.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Prefix of the columns.
    pub name: String,
    /// The particle nearest to this position at the start is followed \[m\].
    pub position: Vector,
}
