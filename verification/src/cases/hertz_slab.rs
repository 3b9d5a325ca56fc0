//! Does the half disk on a rigid plane give the same as a slab of one layer of cells in three dimensions?
//!
//! Set-up: that of `hertz` with kappa = 1.5e4 Pa/m, once in the plane and once as a slab as thick as a cell, whose
//! boundaries are triangles. The reference of the slab is the run in the plane; both are compared with Hertz as `hertz` is,
//! which is shown.
//!
//! Expected: force, peak, half-width and the pressure of every vertex the same within the error that either has against
//! Hertz divided by ten. What differs is the projection: along interpolated normals in the plane, along the normals of
//! triangles in space. `precision` studies the slab against Hertz, as `hertz` does the plane. `proctor verify hertz-slab`.

use super::hertz::{FORCE, Hertz, L2_HERTZ, PEAK, WIDTH};
use super::judging::{table, value_of};
use super::slab::{self, AsSlab};
use crate::case::{Case, Gate, Rung, Size, Solved, Verdict};
use crate::study::Study;

const SAME: &str = "one layer of cells is the plane, but for how surfaces are projected";

/// The half disk as a slab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzSlab;

impl HertzSlab {
    /// The case as it is meant.
    pub const GIVEN: Self = Self;
}

impl Case for HertzSlab {
    fn name(&self) -> &'static str {
        "hertz-slab"
    }

    fn question(&self) -> &'static str {
        "Does a slab in three dimensions give the Hertz contact of the plane?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        slab::rungs(match size {
            Size::Quick => &[0.4],
            Size::Full => &[0.4, 0.2, 0.1],
        })
    }

    with_own_settings!();

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let value = |label: &str, name| value_of(solved, label, name);
        let cell = self.rungs(size).last().map_or(f64::NAN, |rung| rung.cell);
        let (plane, slab) = (format!("plane h={cell}"), format!("slab h={cell}"));
        let (shape, why) = match size {
            Size::Quick => (
                0.03,
                "with 3.4 cells over the width the pressure oscillates, and each projection gives its own waves",
            ),
            Size::Full => (0.01, SAME),
        };
        let gates = [(FORCE, 0.01, SAME), (PEAK, shape, why), (WIDTH, shape, why)]
            .into_iter()
            .map(|(name, bound, reason)| {
                Gate::at_most(
                    format!("{slab}: {name} against the plane"),
                    (value(&slab, name) / value(&plane, name) - 1.0).abs(),
                    bound,
                    reason,
                )
            })
            .collect();
        Verdict {
            tables: slab::VARIANTS
                .iter()
                .map(|v| {
                    let names = [FORCE, PEAK, WIDTH, L2_HERTZ];
                    ((*v).to_owned(), table(solved, v, &names))
                })
                .collect(),
            gates,
            for_the_record: vec![],
            curves: vec![],
        }
    }
}

impl AsSlab for HertzSlab {
    fn in_plane(&self) -> &'static dyn Study {
        &Hertz::GIVEN
    }

    fn of(&self, rung: &Rung) -> (Rung, bool) {
        let plane = Rung {
            variant: "hertz",
            ..rung.clone()
        };
        (plane, rung.variant == "slab")
    }

    fn studied(&self, size: Size) -> (&'static str, &'static [f64]) {
        match size {
            Size::Quick => ("slab", &[0.8, 0.4]),
            Size::Full => ("slab", &[0.8, 0.4, 0.2]),
        }
    }
}
