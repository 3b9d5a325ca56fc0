//! Does the disk on the inclined plane roll the same as a slab of one layer of cells in three dimensions?
//!
//! Set-up: that of `rolling-disk`, once in the plane and once as a slab as thick as a cell, whose boundaries are triangles
//! and whose slip has two components. The reference of the slab is the run in the plane; `precision`
//! studies the slab that rolls against the rigid disk, as `rolling-disk` does. `proctor verify rolling-disk-slab`.

use super::prelude::*;
use super::rolling_disk::{self, AREA, RATIO, WAY};
use super::vocabulary::slab;

/// Variants of the disk, and of each the plane and the slab.
const VARIANTS: [[&str; 3]; 2] = [
    ["slip", "slip plane", "slip slab"],
    ["stick", "stick plane", "stick slab"],
];

/// The rolling disk as a slab.
pub static ROLLING_DISK_SLAB: Case = Case::new(
    "rolling-disk-slab",
    "Does a slab in three dimensions roll as the disk in the plane does?",
)
.ladder(Ladder::made(|size| {
    let cell = size.pick(0.2, 0.1);
    let variants = VARIANTS.iter().flat_map(|names| &names[1..]);
    variants.map(|variant| Rung::new(variant, cell)).collect()
}))
.method(|rung| rolling_disk::method(&in_plane(rung)))
.tried_scene(|rung, settings| {
    let plane = rolling_disk::scene(&in_plane(rung), settings);
    slab::of(plane, rung.variant.ends_with("slab"))
})
.run(|mut run| {
    let plane = in_plane(run.rung);
    rolling_disk::compare(run.as_rung(&plane))
})
.judge_by(judge)
.line_of_each(|rung, run| {
    Some(format!(
        "{}: {AREA} is {:.2} %",
        rung.label,
        100.0 * run.value(AREA)
    ))
})
.tables(&[TableRule::new("{variant}", &[WAY, RATIO])])
.studies(&[Plan::new(
    Ladder::sizes(
        &[("stick slab", &[0.4, 0.2])],
        &[("stick slab", &[0.2, 0.1, 0.05])],
    ),
    rolling_disk::MEASURES,
    2,
)
.trying(slab::tries)])
.no_guest(NO_GUEST);

/// The rung of the disk in the plane.
fn in_plane(rung: &Rung) -> Rung {
    let own = VARIANTS.iter().find(|names| names.contains(&rung.variant));
    rung.as_variant(own.unwrap_or(&VARIANTS[0])[0])
}

fn judge(runs: &Runs<'_>) -> Verdict {
    let value = |variant: &str, name| {
        let run = runs.solved.iter().find(|(rung, _)| rung.variant == variant);
        run.map_or(f64::NAN, |(_, s)| s.value(name))
    };
    let gates = VARIANTS.iter().flat_map(|&[_, plane, slab]| {
        [(WAY, 0.005), (RATIO, 0.01)].map(|(name, bound)| {
            Gate::at_most(
                format!("{slab}: {name} against the plane"),
                (value(slab, name) / value(plane, name) - 1.0).abs(),
                bound,
                "one layer of cells is the plane, but for how surfaces are projected",
            )
        })
    });
    Verdict {
        gates: gates.collect(),
        ..Verdict::default()
    }
}
