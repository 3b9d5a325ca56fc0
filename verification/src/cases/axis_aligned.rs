//! Do errors fall at their order when particles cross many cells?
//!
//! Source: Uintah's axis-aligned manufactured solution. Every line of a neo-Hookean square or
//! cube between rollers stretches along itself, driven by the body force that makes it a motion. With an amplitude
//! of 5 % of the side (`large`) particles cross up to one cell in eight of the mesh and domains stretch by 16 %; with
//! 1e-4 (`small`) nothing crosses.
//!
//! Expected: order 2 of uGIMP without crossing; cpGIMP at least 1.7 in the displacement with it, 1.0 to
//! 1.8 in the stress, with dt like h². uGIMP and B-splines stall with crossing, and linear functions diverge: that is
//! for `proctor precision axis-aligned` to show. `proctor verify axis-aligned axis-aligned-3d`.

use super::prelude::*;
use crate::exact::axis_aligned_mms::{AxisAlignedMms, Law as ExactLaw};

const SIDE: f64 = 1.0; // Side of the square or cube [m]
/// Neo-Hookean with E = 10 MPa, nu = 0.3: the order of rubber.
const LAW: NeoHookean = NeoHookean::new(1e7, 0.3);
const DENSITY: f64 = 1000.0; // Density [kg/m³]
/// Amplitudes with crossing and without \[m\].
const LARGE: f64 = 0.05;
const SMALL: f64 = 1e-4;
/// End of the comparison, in sides over `sqrt(E/rho)`: the sine is at 0.81 and no field is zero.
const END: f64 = 0.7;
/// `c dt/h` is this times h/L, so that dt falls like h²: 0.3 at 8 cells, inside the bound where waves run faster in
/// compression.
const COURANT_TIMES_CELLS: f64 = 2.4;
const MOST_COURANT: f64 = 0.3; // Largest of them, which four cells have too
/// Cells along the cube that other solvers get at most: each of its particles is a body, 4096 of them.
const MOST_CELLS_OF_GUESTS: f64 = 8.5;

const OF_SMALL: &str = "uGIMP in one dimension without crossing: 2.0 in the displacement; stresses 1.0 to 1.8, less 0.1";
const OF_LARGE: &str =
    "cpGIMP in one dimension: 1.7 to 1.9 in the displacement, 1.0 to 1.8 in stresses";
const WRONG_AMPLITUDE: Wrong =
    Wrong::factor("amplitude", 1.008).breaks(|gate| gate.contains(DISPLACEMENT));
/// Meshes in space are twice as coarse, and the bound is four times as large.
const WRONG_IN_SPACE: Wrong =
    Wrong::factor("amplitude", 1.032).breaks(|gate| gate.contains(DISPLACEMENT));

const GATES: &[GateRule] = &[
    // 1.9e-3 at 32 cells in one dimension, where every particle feels one phase.
    error(DISPLACEMENT).at_most_by(
        |finest| 4e-3 * (32.0 * finest.cell / SIDE).powi(2),
        "twice the error of cpGIMP in one dimension at 32 cells, and order 2 elsewhere",
    ),
    order(DISPLACEMENT).at_least(1.8, OF_SMALL).on(is_small),
    order(STRESS).at_least(0.9, OF_SMALL).on(is_small),
    order(DISPLACEMENT)
        .at_least(1.7, OF_LARGE)
        .on(|rung| !is_small(rung)),
    order(STRESS)
        .at_least(1.0, OF_LARGE)
        .on(|rung| !is_small(rung)),
];

/// The axis-aligned motion in the plane.
pub static AXIS_ALIGNED: Case = common(
    "axis-aligned",
    "Do errors fall at their order in a plane where particles cross many cells?",
)
.ladder(cells_along(
    &["small", "large"],
    [&[8, 16, 32], &[8, 16, 32, 64]],
))
.scene(|rung, settings| scene("axis-aligned", Dimension::Two, rung, settings))
.options(start::<2>)
.compare(compare::<2>)
.wrong_references(&[WRONG_AMPLITUDE])
.tables(&[
    TableRule::new(
        "axis-aligned, uGIMP, amplitude 1e-4, USL, FLIP, dt like h²",
        &[DISPLACEMENT, STRESS],
    )
    .of(|variant| variant == "small"),
    TableRule::new(
        "axis-aligned, cpGIMP, amplitude 0.05, USL, FLIP, dt like h²",
        &[DISPLACEMENT, STRESS],
    )
    .of(|variant| variant == "large"),
])
.studies(&[Plan::new(
    cells_along(&["large"], [&[8, 16, 32], &[8, 16, 32, 64, 128]]),
    FIELDS,
    2,
)])
.guest(|rung| {
    Ok(swing(2).guest(rung, |rung, settings| {
        scene("axis-aligned", Dimension::Two, rung, settings)
    }))
});

/// The same in space.
pub static AXIS_ALIGNED_3D: Case = common(
    "axis-aligned-3d",
    "Do errors fall at their order in space where particles cross many cells?",
)
.ladder(cells_along(&["large"], [&[8, 16], &[8, 16, 32]]))
.scene(|rung, settings| scene("axis-aligned-3d", Dimension::Three, rung, settings))
.options(start::<3>)
.compare(compare::<3>)
.wrong_references(&[WRONG_IN_SPACE])
.tables(&[TableRule::new(
    "axis-aligned-3d, cpGIMP, amplitude 0.05, USL, FLIP, dt like h²",
    &[DISPLACEMENT, STRESS],
)])
.studies(&[Plan::new(
    cells_along(&["large"], [&[4, 8, 16], &[4, 8, 16, 32]]),
    FIELDS,
    3,
)])
.guest(|rung| {
    if rung.cell < SIDE / MOST_CELLS_OF_GUESTS {
        return Err("each particle would be a body of its own, tens of thousands of them");
    }
    Ok(swing(3).guest(rung, |rung, settings| {
        scene("axis-aligned-3d", Dimension::Three, rung, settings)
    }))
});

const fn common(name: &'static str, question: &'static str) -> Case {
    Case::new(name, question)
        .method(method)
        .displacements()
        .gates_of_variants(GATES)
}

/// No scene file can say the force that drives the motion. With the small amplitude the body swings so by itself.
fn swing(axes: usize) -> guest::start::Swing {
    let modulus = LAW.elasticity().lambda + 2.0 * LAW.elasticity().shear;
    guest::start::Swing {
        axes,
        length: SIDE,
        amplitude: SMALL,
        speed: (modulus / DENSITY).sqrt(),
        lame: [LAW.elasticity().lambda, LAW.elasticity().shear],
    }
}

const fn cells_along(variants: &'static [&'static str], counts: [&'static [u32]; 2]) -> Ladder {
    Ladder::variants(variants, " ", "L/h", SIDE, counts)
}

fn is_small(rung: &Rung) -> bool {
    rung.variant == "small"
}

fn method(rung: &Rung) -> Settings {
    let weighting = if is_small(rung) {
        Weighting::UniformGimp
    } else {
        Weighting::ContiguousGimp(DomainUpdate::Stretch)
    };
    Settings::new(Method::DEFAULT.with_weighting(weighting))
        .courant((COURANT_TIMES_CELLS * rung.cell / SIDE).min(MOST_COURANT))
}

/// The motion of a rung in as many directions with its amplitude times `factor`.
fn exact<const D: usize>(rung: &Rung, factor: f64) -> AxisAlignedMms<D> {
    let young = LAW.elasticity().young;
    AxisAlignedMms {
        law: ExactLaw::NeoHookean,
        lambda: LAW.elasticity().lambda,
        mu: LAW.elasticity().shear,
        density: DENSITY,
        amplitude: factor * if is_small(rung) { SMALL } else { LARGE },
        wave_number: PI / SIDE,
        angular_frequency: PI / SIDE * (young / DENSITY).sqrt(),
        phases: [0.0; D],
    }
}

/// The first components of a vector.
fn first<const D: usize>(x: &[f64; 3]) -> [f64; D] {
    std::array::from_fn(|axis| x[axis])
}

/// A vector of so many components in space, where the others are zero.
fn in_space<const D: usize>(x: [f64; D]) -> [f64; 3] {
    std::array::from_fn(|axis| x.get(axis).copied().unwrap_or(0.0))
}

fn scene(name: &str, dimension: Dimension, rung: &Rung, settings: &Settings) -> Scene {
    let h = rung.cell;
    let mesh = Mesh::new(dimension, [0.0; 3], [h; 3], [cells(SIDE, h); 3]);
    let young = LAW.elasticity().young;
    let end = END * SIDE / (young / DENSITY).sqrt();
    let speed = ((LAW.elasticity().lambda + 2.0 * LAW.elasticity().shear) / DENSITY).sqrt();
    let mut far = [0.0; 3];
    far[..dimension.axes()].fill(SIDE);
    settings.applied(Scene {
        time_step: settings.equal_steps(end, h, speed).0,
        materials: material("neo-Hookean", DENSITY, LAW),
        bodies: vec![body("body", 1, cuboid([0.0; 3], far))],
        ..bare_scene(name, dimension, mesh, end)
    })
}

fn start<const D: usize>(rung: &Rung, _: Reference, options: Options) -> Options {
    let (start, force) = (exact::<D>(rung, 1.0), exact::<D>(rung, 1.0));
    let options = starting(options, move |x| {
        let [a, b, c] = in_space(start.stretch_rates(first(x), 0.0));
        let gradient = [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]];
        moving(in_space(start.velocity(first(x), 0.0)), gradient)
    });
    driven(options, move |x, t| in_space(force.body_force(first(x), t)))
}

fn compare<const D: usize>(run: &mut Run<'_>) -> Result<Measurements, Failure> {
    let (exact, t) = (
        exact::<D>(run.rung, run.reference.of(&WRONG_AMPLITUDE)),
        run.time(),
    );
    let quantities = run.errors(
        |x| in_space(exact.displacement(first(&x), t)),
        |x| {
            let [xx, yy, zz] = exact.stress(first(&x), t);
            [xx, yy, zz, 0.0, 0.0, 0.0]
        },
    );
    Ok(Measurements::of(quantities))
}
