//! The cases: one file each.

// The hooks of all cases have one shape, whatever a case does with it.
#![allow(clippy::needless_pass_by_value, clippy::unnecessary_wraps)]

mod absorbing;
mod angular_momentum;
mod axis_aligned;
mod bar;
mod bar_energy;
mod base_acceleration;
mod block_on_two_blocks;
mod boussinesq;
mod breathing;
mod cantilever;
mod cavity;
mod circular_footing;
mod clay_footing;
mod collapse;
mod colliding_blocks;
mod colliding_disks;
mod column_closed;
mod column_early;
mod column_modal;
mod column_terzaghi;
mod corner_block;
mod cylinder_core;
mod drawdown;
mod element;
mod fluid;
mod footing;
mod grains;
mod half_space;
mod half_space_boxes;
mod head;
mod hertz;
mod hertz_ball;
mod hertz_slab;
mod hertz_sphere;
mod homogeneous;
mod hydrostatic_jump;
mod inclined_block;
mod inclined_two_blocks;
mod incompressible_box;
mod infinite_slope;
mod ironing;
mod plastic_wave;
mod prelude;
mod punch;
mod radial_vibration;
mod revolved;
mod rings;
mod rolling_disk;
mod rolling_disk_slab;
mod rotation;
mod round_collapse;
mod seepage;
mod self_weight;
mod shear_and_turn;
mod slipping_disk;
mod slope;
mod softening_bar;
mod sphere_on_terrain;
mod spin;
mod spinning_collision;
mod staggered_start;
mod step_bar;
mod sudden_weight;
mod thick_cylinder;
mod thick_sphere;
mod tilted_incline;
mod triaxial;
mod undrained_patch;
mod vocabulary;
mod vortex;
mod xie_leo;
mod yielding_column;
mod yielding_cylinder;

pub use grains::{apart as grains_apart, outlines as grain_outlines};
pub use vocabulary::run_out::outlines as cell_outlines;

use std::sync::OnceLock;

use crate::case::{Case, CurvePoint};
use crate::study::Measure;
pub(crate) use vocabulary::mortar::{barrier, boundary, open_line, rubbing};
pub(crate) use vocabulary::parts::{
    AT_REST, NO_RESULTS, body, confined_modulus, contact, cuboid, elastic, elastic_law,
    equal_steps_of, larger, material, moving, moving_along_x, rectangle, starting, traction,
    uniaxial,
};

/// Makes the cases public, and the one list of them.
macro_rules! list {
    ($($module:ident :: [$($case:ident),+]),+ $(,)?) => {
        $(pub use $module::{$($case),+};)+

        /// All cases, in the order in which they are shown.
        pub(crate) static ALL: &[&Case] = &[$($(&$module::$case),+),+];

        /// The names of the files of the cases, in the same order.
        pub(crate) static FILES: &[&str] = &[$($({
            let _ = stringify!($case);
            concat!(stringify!($module), ".rs")
        }),+),+];

        /// The heads of the files of the cases, in the same order.
        pub(crate) static HEADS: &[&str] = &[$($({
            const SOURCE: &str = include_str!(concat!(stringify!($module), ".rs"));
            const HEAD: [u8; head::length(SOURCE)] = head::copy(SOURCE);
            let _ = stringify!($case);
            head::text(&HEAD)
        }),+),+];
    };
}

// A new case is a file, declared above, where the formatter finds it, and a line here.
list! {
    boussinesq::[BOUSSINESQ],
    incompressible_box::[INCOMPRESSIBLE_BOX],
    base_acceleration::[BASE_ACCELERATION],
    bar::[BAR],
    axis_aligned::[AXIS_ALIGNED, AXIS_ALIGNED_3D],
    self_weight::[SELF_WEIGHT],
    rotation::[ROTATION],
    vortex::[VORTEX],
    step_bar::[STEP_BAR],
    sudden_weight::[SUDDEN_WEIGHT],
    plastic_wave::[PLASTIC_WAVE],
    yielding_column::[YIELDING_COLUMN],
    softening_bar::[SOFTENING_BAR],
    footing::[FOOTING],
    collapse::[COLLAPSE],
    slope::[SLOPE],
    fluid::[FLUID],
    element::[ELEMENT],
    homogeneous::[HOMOGENEOUS],
    shear_and_turn::[SHEAR_AND_TURN],
    spin::[SPIN],
    staggered_start::[STAGGERED_START],
    bar_energy::[BAR_ENERGY],
    angular_momentum::[ANGULAR_MOMENTUM],
    inclined_block::[INCLINED_BLOCK],
    inclined_two_blocks::[INCLINED_TWO_BLOCKS],
    colliding_blocks::[COLLIDING_BLOCKS],
    colliding_disks::[COLLIDING_DISKS],
    block_on_two_blocks::[BLOCK_ON_TWO_BLOCKS],
    tilted_incline::[TILTED_INCLINE],
    sphere_on_terrain::[SPHERE_ON_TERRAIN],
    hertz::[HERTZ],
    rolling_disk::[ROLLING_DISK],
    slipping_disk::[SLIPPING_DISK],
    spinning_collision::[SPINNING_COLLISION],
    corner_block::[CORNER_BLOCK],
    hertz_slab::[HERTZ_SLAB],
    hertz_sphere::[HERTZ_SPHERE],
    hertz_ball::[HERTZ_BALL],
    rolling_disk_slab::[ROLLING_DISK_SLAB],
    cantilever::[CANTILEVER],
    rings::[RINGS],
    ironing::[IRONING],
    grains::[GRAINS],
    thick_cylinder::[THICK_CYLINDER],
    cylinder_core::[CYLINDER_CORE],
    half_space::[HALF_SPACE],
    punch::[RIGID_PUNCH],
    half_space_boxes::[HALF_SPACE_BOXES],
    radial_vibration::[RADIAL_VIBRATION],
    column_modal::[COLUMN_MODAL],
    column_early::[COLUMN_EARLY],
    column_closed::[COLUMN_CLOSED],
    column_terzaghi::[COLUMN_TERZAGHI],
    hydrostatic_jump::[HYDROSTATIC_JUMP],
    seepage::[SEEPAGE],
    infinite_slope::[INFINITE_SLOPE],
    undrained_patch::[UNDRAINED_PATCH],
    xie_leo::[XIE_LEO],
    drawdown::[DRAWDOWN],
    clay_footing::[CLAY_FOOTING],
    breathing::[BREATHING],
    revolved::[REVOLVED],
    thick_sphere::[THICK_SPHERE],
    yielding_cylinder::[YIELDING_CYLINDER],
    cavity::[CAVITY],
    triaxial::[TRIAXIAL],
    circular_footing::[CIRCULAR_FOOTING],
    round_collapse::[ROUND_COLLAPSE],
    absorbing::[ABSORBING],
}

/// The error of the stress, where a case has one.
pub(crate) const STRESS_MEASURE: Measure = Measure::new("stress", vocabulary::stepping::STRESS);

/// The errors of displacement and stress.
pub(crate) const FIELDS: &[Measure] = &[
    Measure::new("displacement", vocabulary::stepping::DISPLACEMENT),
    STRESS_MEASURE,
];

/// Parts two lines of a curve.
pub(crate) const PARTED: CurvePoint = CurvePoint {
    at: f64::NAN,
    computed: f64::NAN,
    exact: f64::NAN,
};

/// A reference that takes long. That of the case as it is meant is computed once and kept; a wrong one is for a test, which
/// asks for it once.
pub(crate) fn known_reference<T>(
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
