//! Does the half disk on a rigid plane give the same as a slab of one layer of cells in three dimensions?
//!
//! Set-up: that of `hertz` with kappa = 1.5e4 Pa/m, once in the plane and once as a slab as thick as a cell, whose
//! boundaries are triangles. The reference of the slab is the run in the plane; both are compared with Hertz as `hertz` is,
//! which is shown.
//!
//! Expected: force, peak, half-width and the pressure of every vertex the same within the error that either has against
//! Hertz divided by ten. What differs is the projection: along interpolated normals in the plane, along the normals of
//! triangles in space. `precision` studies the slab against Hertz, as `hertz` does the plane. `proctor verify hertz-slab`.

use super::hertz::{self, FORCE, L2_HERTZ, PEAK, WIDTH};
use super::prelude::*;
use super::vocabulary::slab::{self, VARIANTS};

const SAME: &str = "one layer of cells is the plane, but for how surfaces are projected";

/// The half disk as a slab.
pub static HERTZ_SLAB: Case = Case::new(
    "hertz-slab",
    "Does a slab in three dimensions give the Hertz contact of the plane?",
)
.ladder(Ladder::made(|size| {
    slab::rungs(size.pick(&[0.4], &[0.4, 0.2, 0.1]))
}))
.method(|rung| hertz::method(&in_plane(rung)))
.tried_scene(|rung, settings| {
    let plane = hertz::scene(&in_plane(rung), settings);
    slab::of(plane, rung.variant == "slab")
})
.run(|mut run| {
    let plane = in_plane(run.rung);
    hertz::compare(run.as_rung(&plane))
})
.judge_by(judge)
.tables(&[TableRule::new("{variant}", &[FORCE, PEAK, WIDTH, L2_HERTZ])])
.studies(&[Plan::new(
    Ladder::sizes(&[("slab", &[0.8, 0.4])], &[("slab", &[0.4, 0.2, 0.1])]),
    hertz::MEASURES,
    2,
)
.trying(slab::tries)])
.no_guest(NO_GUEST);

fn in_plane(rung: &Rung) -> Rung {
    rung.as_variant("hertz")
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let cell = runs.finest(None).map_or(f64::NAN, |rung| rung.cell);
    let [plane, slab] = VARIANTS.map(|variant| format!("{variant} h={cell}"));
    let (shape, why) = match runs.size {
        Size::Quick => (
            0.03,
            "with 3.4 cells over the width the pressure oscillates, and each projection gives its own waves",
        ),
        Size::Full => (0.01, SAME),
    };
    let gates = [(FORCE, 0.01, SAME), (PEAK, shape, why), (WIDTH, shape, why)];
    let gates = gates.map(|(name, bound, reason)| {
        let name_of_gate = format!("{slab}: {name} against the plane");
        let ratio = runs.value(&slab, name) / runs.value(&plane, name);
        Gate::at_most(name_of_gate, (ratio - 1.0).abs(), bound, reason)
    });
    Verdict {
        gates: gates.to_vec(),
        ..Verdict::default()
    }
}
