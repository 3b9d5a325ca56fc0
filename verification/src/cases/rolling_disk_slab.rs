//! Does the disk on the inclined plane roll the same as a slab of one layer of cells in three dimensions?
//!
//! Set-up: that of `rolling-disk`, once in the plane and once as a slab as thick as a cell, whose boundaries are triangles
//! and whose slip has two components. The reference of the slab is the run in the plane. `proctor verify
//! rolling-disk-slab`.

use proctor_kernel::scene::Scene;
use proctor_kernel::simulation::Options;

use super::rolling_disk::{AREA, RATIO, RollingDisk, WAY};
use super::{failed, slab, table};
use crate::case::{Case, CaseError, Gate, Relation, Rung, Size, Solved, Verdict};

/// Variants of the disk, and of each the plane and the slab.
const VARIANTS: [[&str; 3]; 2] = [
    ["slip", "slip plane", "slip slab"],
    ["stick", "stick plane", "stick slab"],
];

/// The rolling disk as a slab.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingDiskSlab;

impl RollingDiskSlab {
    /// The rung of the case in the plane, and whether it is run as a slab.
    fn of(rung: &Rung) -> (Rung, bool) {
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
            .map(|&variant| Rung {
                label: format!("{variant} h={cell}"),
                cell,
                variant,
            })
            .collect()
    }

    fn scene(&self, rung: &Rung) -> Scene {
        let (plane, is_slab) = Self::of(rung);
        let scene = RollingDisk::GIVEN.scene(&plane);
        if is_slab {
            // The scene is known and has a slab; what has none is reported by `solve`.
            slab::slab(&scene).unwrap_or(scene)
        } else {
            scene
        }
    }

    fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError> {
        let (plane, is_slab) = Self::of(rung);
        let mut scene = RollingDisk::GIVEN.scene(&plane);
        if is_slab {
            scene = slab::slab(&scene).map_err(|e| failed(self, rung, &e))?;
        }
        let thickness = if is_slab { rung.cell } else { 1.0 };
        RollingDisk::GIVEN
            .solve_scene(self, &scene, thickness, &plane, options, &mut |share| {
                progress(share);
            })
            .map(|studied| studied.solved)
    }

    fn judge(&self, _size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let value = |variant: &str, name| {
            let run = solved.iter().find(|(rung, _)| rung.variant == variant);
            run.map_or(f64::NAN, |(_, s)| s.value(name))
        };
        let gates = VARIANTS
            .iter()
            .flat_map(|&[_, plane, slab]| {
                [(WAY, 0.005), (RATIO, 0.01)].map(|(name, bound)| Gate {
                    name: format!("{slab}: {name} against the plane"),
                    value: (value(slab, name) / value(plane, name) - 1.0).abs(),
                    relation: Relation::AtMost,
                    bound,
                    reason: "one layer of cells is the plane, but for how surfaces are projected",
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
