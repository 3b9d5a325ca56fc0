//! Plan entries of rigid surfaces.

use crate::values::{ContactValues, PlannedBody, RigidSurface};
use proctor_kernel::model::CycleSettings;
use proctor_kernel::plan::PlanEntries;

/// One entry for all of them.
pub(crate) fn plan_entries(
    values: &ContactValues,
    _: &CycleSettings,
    _: &[PlannedBody<'_>],
    list: &mut PlanEntries,
) {
    let surfaces: Vec<String> = values.surfaces.iter().map(surface_words).collect();
    list.choose(
        "stage",
        "contact with rigid surfaces",
        !surfaces.is_empty(),
        &surfaces.join("; "),
        "the scene has none",
    );
}

/// A surface in a few words, its open edges among them: a terrain has some, a closed body none.
fn surface_words(rigid: &RigidSurface) -> String {
    let edges = rigid.surface.open_edges().map_or_else(
        || "closed".to_owned(),
        |open| {
            let [a, b] = open.first;
            format!(
                "{} open edges, the first at triangle {} from {a:?} to {b:?} m",
                open.count, open.triangle
            )
        },
    );
    format!(
        "{}, {} triangles, {edges}{}{}",
        rigid.name,
        rigid.surface.triangle_count(),
        if rigid.motion.is_some() {
            ", moving"
        } else {
            ""
        },
        if rigid.penalty_stiffness.is_some() {
            ", with a penalty force"
        } else {
            ""
        },
    )
}
