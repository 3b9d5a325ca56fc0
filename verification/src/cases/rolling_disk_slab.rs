//! Does the disk on the inclined plane roll the same as a slab of one layer of cells in three dimensions?
//!
//! Set-up: that of `rolling-disk`, once in the plane and once as a slab as thick as a cell, whose boundaries are triangles
//! and whose slip has two components. The reference of the slab is the run in the plane; `precision`
//! studies the slab that rolls against the rigid disk, as `rolling-disk` does. `proctor verify rolling-disk-slab`.

use super::judging::table;
use super::rolling_disk::{AREA, RATIO, RollingDisk, WAY};
use super::slab::AsSlab;
use crate::case::{Case, Gate, Rung, Size, Solved, Verdict};
use crate::study::Study;

/// Variants of the disk, and of each the plane and the slab.
const VARIANTS: [[&str; 3]; 2] = [
    ["slip", "slip plane", "slip slab"],
    ["stick", "stick plane", "stick slab"],
];

/// The rolling disk as a slab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingDiskSlab;

impl RollingDiskSlab {
    /// The case as it is meant.
    pub const GIVEN: Self = Self;
}

impl Case for RollingDiskSlab {
    fn name(&self) -> &'static str {
        "rolling-disk-slab"
    }

    fn question(&self) -> &'static str {
        "Does a slab in three dimensions roll as the disk in the plane does?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        let cell = match size {
            Size::Quick => 0.2,
            Size::Full => 0.1,
        };
        VARIANTS
            .iter()
            .flat_map(|names| &names[1..])
            .map(|&variant| Rung::new(variant, cell))
            .collect()
    }

    with_own_settings!();

    fn judge(&self, _size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let value = |variant: &str, name| {
            let run = solved.iter().find(|(rung, _)| rung.variant == variant);
            run.map_or(f64::NAN, |(_, s)| s.value(name))
        };
        let gates = VARIANTS
            .iter()
            .flat_map(|&[_, plane, slab]| {
                [(WAY, 0.005), (RATIO, 0.01)].map(|(name, bound)| {
                    Gate::at_most(
                        format!("{slab}: {name} against the plane"),
                        (value(slab, name) / value(plane, name) - 1.0).abs(),
                        bound,
                        "one layer of cells is the plane, but for how surfaces are projected",
                    )
                })
            })
            .collect();
        Verdict {
            tables: VARIANTS
                .iter()
                .flat_map(|names| &names[1..])
                .map(|v| ((*v).to_owned(), table(solved, v, &[WAY, RATIO])))
                .collect(),
            gates,
            for_the_record: solved
                .iter()
                .map(|(rung, s)| {
                    format!("{}: {AREA} is {:.2} %", rung.label, 100.0 * s.value(AREA))
                })
                .collect(),
            curves: vec![],
        }
    }
}

impl AsSlab for RollingDiskSlab {
    fn in_plane(&self) -> &'static dyn Study {
        &RollingDisk::GIVEN
    }

    fn of(&self, rung: &Rung) -> (Rung, bool) {
        let [variant, ..] = VARIANTS
            .into_iter()
            .find(|names| names.contains(&rung.variant))
            .unwrap_or(VARIANTS[0]);
        let plane = Rung {
            variant,
            ..rung.clone()
        };
        (plane, rung.variant.ends_with("slab"))
    }

    fn studied(&self, size: Size) -> (&'static str, &'static [f64]) {
        match size {
            Size::Quick => ("stick slab", &[0.4, 0.2]),
            Size::Full => ("stick slab", &[0.2, 0.1, 0.05]),
        }
    }
}
