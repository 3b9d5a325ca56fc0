//! The cases: one small file each.

/// What a [`Case`] that is a [`Study`] does with the settings that are its own. It is its own one study, but where it says
/// what else is.
macro_rules! with_own_settings {
    () => {
        fn studies(&self) -> Result<Vec<&dyn $crate::study::Study>, &'static str> {
            Ok(vec![self])
        }

        with_own_settings!(but studies);
    };
    (but studies) => {
        fn scene(&self, rung: &$crate::case::Rung) -> proctor_kernel::scene::Scene {
            use $crate::study::Study;
            self.scene_with(rung, &self.own_settings(rung))
        }

        fn solve(
            &self,
            rung: &$crate::case::Rung,
            options: &proctor_kernel::simulation::Options,
            progress: &mut dyn FnMut(f64),
        ) -> Result<$crate::case::Solved, $crate::case::CaseError> {
            $crate::cases::solve_own(self, rung, options, progress)
        }
    };
}

mod axis_aligned;
mod bar;
mod base_acceleration;
mod block_on_two_blocks;
mod boussinesq;
mod cantilever;
mod colliding_blocks;
mod dynamics;
mod grains;
mod hertz;
mod hertz_slab;
mod hertz_sphere;
mod incline;
mod inclined_block;
mod inclined_two_blocks;
mod ironing;
mod judging;
mod mortar;
mod pressures;
mod rings;
mod rolling_disk;
mod rolling_disk_slab;
mod rotation;
mod self_weight;
mod slab;
mod sphere_on_terrain;
mod statics;
mod tilted_incline;

pub use axis_aligned::AxisAligned;
pub use bar::Bar;
pub use base_acceleration::BaseAcceleration;
pub use block_on_two_blocks::BlockOnTwoBlocks;
pub use boussinesq::Boussinesq;
pub use cantilever::Cantilever;
pub use colliding_blocks::CollidingBlocks;
pub use grains::{Grains, apart as grains_apart, outlines as grain_outlines};
pub use hertz::Hertz;
pub use hertz_slab::HertzSlab;
pub use hertz_sphere::HertzSphere;
pub use inclined_block::InclinedBlock;
pub use inclined_two_blocks::InclinedTwoBlocks;
pub use ironing::Ironing;
pub use rings::Rings;
pub use rolling_disk::RollingDisk;
pub use rolling_disk_slab::RollingDiskSlab;
pub use rotation::Rotation;
pub use self_weight::SelfWeight;
pub use sphere_on_terrain::SphereOnTerrain;
pub use tilted_incline::TiltedIncline;

use crate::case::{Case, CaseError, CurvePoint, Rung, Solved};
use crate::study::{Measure, Study};
use proctor_kernel::scene::{
    Body, Dimension, Law, Material, Mesh, ObjectiveRate, PlaneCondition, Results, Shape, Vector,
};
use proctor_kernel::simulation::{InitialState, Options};

/// All cases, in the order in which they are shown. Whether one can be studied with any settings it says itself
/// ([`Case::studies`]).
pub(crate) static ALL: &[&dyn Case] = &[
    &Boussinesq::GIVEN,
    &BaseAcceleration::GIVEN,
    &Bar::GIVEN,
    &AxisAligned::PLANE,
    &AxisAligned::SPACE,
    &SelfWeight::GIVEN,
    &Rotation::GIVEN,
    &InclinedBlock::GIVEN,
    &InclinedTwoBlocks::GIVEN,
    &CollidingBlocks::GIVEN,
    &BlockOnTwoBlocks::GIVEN,
    &TiltedIncline::GIVEN,
    &SphereOnTerrain::GIVEN,
    &Hertz::GIVEN,
    &RollingDisk::GIVEN,
    &HertzSlab,
    &HertzSphere::GIVEN,
    &RollingDiskSlab,
    &Cantilever::GIVEN,
    &Rings::GIVEN,
    &Ironing::GIVEN,
    &Grains::GIVEN,
];

/// The error of the stress, where a case has one.
const STRESS_MEASURE: Measure = Measure::new("stress", dynamics::STRESS);

/// The errors of displacement and stress.
const FIELDS: &[Measure] = &[
    Measure::new("displacement", dynamics::DISPLACEMENT),
    STRESS_MEASURE,
];

/// Nothing is written: a case reads the simulation itself.
const NO_RESULTS: Results = Results {
    print: 0,
    fields: Vec::new(),
    nodal_fields: Vec::new(),
    checkpoint: false,
};

/// Parts two lines of a curve.
const PARTED: CurvePoint = CurvePoint {
    at: f64::NAN,
    computed: f64::NAN,
    exact: f64::NAN,
};

/// A body at rest and without stress.
const AT_REST: InitialState = InitialState {
    velocity: [0.0; 3],
    velocity_gradient: [[0.0; 3]; 3],
    stress: [0.0; 6],
    deformation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
};

/// Runs a rung with its own settings.
fn solve_own(
    study: &dyn Study,
    rung: &Rung,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Result<Solved, CaseError> {
    let settings = study.own_settings(rung);
    study
        .solve_with(rung, &settings, options, &mut |share| progress(share))
        .map(|studied| studied.solved)
}

/// A linear elastic law \[Pa\].
fn elastic_law(young: f64, poisson: f64) -> Law {
    Law::LinearElastic {
        young,
        poisson,
        rate: ObjectiveRate::HughesWinget,
    }
}

/// The one material of a case \[kg/m³\].
fn material(name: &str, density: f64, law: Law) -> Vec<Material> {
    vec![Material {
        name: name.to_owned(),
        id: 1,
        density,
        law,
    }]
}

/// The one linear elastic material of a case \[kg/m³, Pa\].
fn elastic(density: f64, young: f64, poisson: f64) -> Vec<Material> {
    material("elastic", density, elastic_law(young, poisson))
}

/// A body of the first material, at rest; [`Settings::apply`] gives it its particles.
fn body(name: impl Into<String>, id: i64, shape: Shape) -> Body {
    Body {
        name: name.into(),
        id,
        material: 0,
        shape,
        particles_per_cell: [1; 3],
        velocity: [0.0; 3],
        motion: None,
    }
}

/// A rectangle or a cuboid.
fn cuboid(p1: Vector, p2: Vector) -> Shape {
    Shape::Cuboid { p1, p2 }
}

/// A mesh of the plane in square cells, from one corner to the other, free at all sides \[m\].
fn open_plane(cell: f64, [left, below]: [f64; 2], [right, above]: [f64; 2]) -> Mesh {
    let cells = |length: f64| (length / cell).round() as usize;
    let mut mesh = Mesh::new(
        Dimension::Two,
        [left, below, 0.0],
        [cell; 3],
        [cells(right - left), cells(above - below), 1],
    );
    mesh.planes[..2].fill([PlaneCondition::Free; 2]);
    mesh
}
