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
        fn scene(&self, rung: &$crate::case::Rung) -> proctor_scene::Scene {
            use $crate::study::Study;
            self.scene_with(rung, &self.own_settings(rung))
        }

        fn solve(
            &self,
            rung: &$crate::case::Rung,
            options: &proctor_scene::simulation::Options,
            progress: &mut dyn FnMut(f64),
        ) -> Result<$crate::case::Solved, $crate::case::CaseError> {
            $crate::cases::solve_own(self, rung, options, progress)
        }
    };
}

mod angular_momentum;
mod axis_aligned;
mod bar;
mod bar_energy;
mod base_acceleration;
mod block_on_two_blocks;
mod boussinesq;
mod cantilever;
mod collapse;
mod colliding_blocks;
mod corner_block;
mod dynamics;
mod element;
mod fluid;
mod footing;
mod grains;
mod hertz;
mod hertz_slab;
mod hertz_sphere;
mod homogeneous;
mod incline;
mod inclined_block;
mod inclined_two_blocks;
mod incompressible_box;
mod ironing;
mod judging;
mod mortar;
mod parts;
mod plastic_wave;
mod press;
mod pressures;
mod rings;
mod rolling_disk;
mod rolling_disk_slab;
mod rotation;
mod run_out;
mod self_weight;
mod shear_and_turn;
mod slab;
mod slipping_disk;
mod slope;
mod softening_bar;
mod sphere_on_terrain;
mod spin;
mod spinning_collision;
mod staggered_start;
mod statics;
mod step_bar;
mod sudden_weight;
mod tilted_incline;
mod vortex;
mod yielding;
mod yielding_column;

pub use grains::{apart as grains_apart, outlines as grain_outlines};
pub use run_out::outlines as cell_outlines;

use std::sync::OnceLock;

use proctor_scene::OnImbalance;
use proctor_scene::simulation::{Options, Simulation};

use crate::case::{Case, CaseError, CurvePoint, Found, Rung, Solved};
use crate::study::{Failure, Measure, Study};
pub(crate) use parts::{
    AT_REST, NO_RESULTS, body, cuboid, elastic, elastic_law, material, open_plane,
};

/// Makes the types of the cases public, and the one list of them.
macro_rules! list {
    ($($module:ident :: $case:ident [$($given:ident),+]),+ $(,)?) => {
        $(pub use $module::$case;)+

        /// All cases, in the order in which they are shown. Whether one can be studied with any settings it says itself
        /// ([`Case::studies`]).
        pub(crate) static ALL: &[&dyn Case] = &[$($(&$case::$given),+),+];
    };
}

// A new case is a file, declared above, where the formatter finds it, and a line here.
list! {
    boussinesq::Boussinesq[GIVEN],
    incompressible_box::IncompressibleBox[GIVEN],
    base_acceleration::BaseAcceleration[GIVEN],
    bar::Bar[GIVEN],
    axis_aligned::AxisAligned[PLANE, SPACE],
    self_weight::SelfWeight[GIVEN],
    rotation::Rotation[GIVEN],
    vortex::Vortex[GIVEN],
    step_bar::StepBar[GIVEN],
    sudden_weight::SuddenWeight[GIVEN],
    plastic_wave::PlasticWave[GIVEN],
    yielding_column::YieldingColumn[GIVEN],
    softening_bar::SofteningBar[GIVEN],
    footing::Footing[GIVEN],
    collapse::Collapse[GIVEN],
    slope::Slope[GIVEN],
    fluid::Fluid[GIVEN],
    element::Element[GIVEN],
    homogeneous::Homogeneous[GIVEN],
    shear_and_turn::ShearAndTurn[GIVEN],
    spin::Spin[GIVEN],
    staggered_start::StaggeredStart[GIVEN],
    bar_energy::BarEnergy[GIVEN],
    angular_momentum::AngularMomentum[GIVEN],
    inclined_block::InclinedBlock[GIVEN],
    inclined_two_blocks::InclinedTwoBlocks[GIVEN],
    colliding_blocks::CollidingBlocks[GIVEN],
    block_on_two_blocks::BlockOnTwoBlocks[GIVEN],
    tilted_incline::TiltedIncline[GIVEN],
    sphere_on_terrain::SphereOnTerrain[GIVEN],
    hertz::Hertz[GIVEN],
    rolling_disk::RollingDisk[GIVEN],
    slipping_disk::SlippingDisk[GIVEN],
    spinning_collision::SpinningCollision[GIVEN],
    corner_block::CornerBlock[GIVEN],
    hertz_slab::HertzSlab[GIVEN],
    hertz_sphere::HertzSphere[GIVEN],
    rolling_disk_slab::RollingDiskSlab[GIVEN],
    cantilever::Cantilever[GIVEN],
    rings::Rings[GIVEN],
    ironing::Ironing[GIVEN],
    grains::Grains[GIVEN],
}

/// The error of the stress, where a case has one.
const STRESS_MEASURE: Measure = Measure::new("stress", dynamics::STRESS);

/// The errors of displacement and stress.
const FIELDS: &[Measure] = &[
    Measure::new("displacement", dynamics::DISPLACEMENT),
    STRESS_MEASURE,
];

/// Parts two lines of a curve.
const PARTED: CurvePoint = CurvePoint {
    at: f64::NAN,
    computed: f64::NAN,
    exact: f64::NAN,
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

/// Runs the scene of a rung that has no settings but its own, and says what `run` found.
fn solve_scene(
    case: &dyn Case,
    rung: &Rung,
    options: &Options,
    run: impl FnOnce(&mut Simulation) -> Result<Found, Failure>,
) -> Result<Solved, CaseError> {
    let simulate = || {
        let mut scene = case.scene(rung);
        scene.on_imbalance = OnImbalance::Stop;
        scene.check()?;
        let mut simulation = Simulation::new(&scene, options)?;
        let found = run(&mut simulation)?;
        Ok(Solved::new(found, &simulation))
    };
    simulate().map_err(|reason: Failure| CaseError::new(case.name(), rung, &reason))
}

/// A reference that takes long. That of the case as it is meant is computed once and kept; a wrong one is for a test, which
/// asks for it once.
fn reference<T>(
    given: &'static OnceLock<Result<T, String>>,
    is_given: bool,
    compute: impl FnOnce() -> Result<T, String>,
) -> Result<&'static T, String> {
    let known = if is_given {
        given.get_or_init(compute)
    } else {
        Box::leak(Box::new(compute()))
    };
    known.as_ref().map_err(Clone::clone)
}
