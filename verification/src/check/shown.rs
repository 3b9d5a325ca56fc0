//! Errors and balances of the cases that are shown and not judged.

use crate::case::Case;

/// Errors and balances that no gate of the quick ladder judges, by case, and why. What is not here is judged.
const SHOWN: &[(&str, &[&str], &str)] = &[
    (
        "boussinesq",
        &["L2(u), all", "L2(stress)"],
        "the displacement under a nodal load grows with 1/h, stresses with it",
    ),
    (
        "incompressible-box",
        &["u_z at (.5,.5,.5)", "L2(u), r >= 0.2 m", "residual"],
        "beside the settlement of the patch; the whole ladder judges the order of L2, and *boussinesq* the residual",
    ),
    (
        "base-acceleration",
        &[
            "v(H - h/4, 0.2 s)",
            "L2(stress)",
            "difference of the lowest particles over A",
        ],
        "particles h/4 from an edge: the velocities of the edges themselves are judged, and L2(v)",
    ),
    (
        "staggered-start",
        &["L2(stress)"],
        "nothing is known of its order with USF, and what GIMP's domains leave of it does not fall with the cells",
    ),
    (
        "inclined-block",
        &["displacement at 2 s, elastic"],
        "of blocks that walk, beside finite elements",
    ),
    (
        "inclined-two-blocks",
        &["displacement, mu = 0.2, elastic"],
        "of `precision`, against finite elements of the block; the ladder judges the rigid one",
    ),
    (
        "block-on-two-blocks",
        &[
            "mean vertical stress in the pillars",
            "mean vertical stress in the block",
        ],
        "of `precision`; the reference leaves out the widening, 0.14 %",
    ),
    (
        "hertz",
        &[
            "peak pressure",
            "L2(p) against the barrier layer",
            "the layer's own L2 distance from Hertz",
        ],
        "with 3.4 cells over the half-width the pressure oscillates; the whole ladder judges the first two",
    ),
    (
        "hertz-slab",
        &[
            "L2(p) against Hertz",
            "L2(p) against the barrier layer",
            "the layer's own L2 distance from Hertz",
        ],
        "judged against the plane, not against Hertz",
    ),
    (
        "hertz-sphere",
        &["L2(p) against Hertz"],
        "2.4 cells over the contact radius",
    ),
    (
        "hertz-ball",
        &["L2(p) against Hertz"],
        "judged by radius and peak; the study has it",
    ),
    (
        "rolling-disk-slab",
        &["growth of the area minus that of spin and load"],
        "judged in the plane",
    ),
    (
        "cantilever",
        &[
            "the same, farthest vertex",
            "vertices from the reference, rms",
        ],
        "the paper gives neither; the first is a corner alone",
    ),
];

/// Names of the errors and balances of a case that no gate of its short ladder judges.
#[must_use]
pub fn shown(case: &Case) -> Vec<&'static str> {
    let own = SHOWN.iter().filter(|(of, ..)| *of == case.name());
    own.flat_map(|(_, names, _)| names.iter().copied())
        .collect()
}
