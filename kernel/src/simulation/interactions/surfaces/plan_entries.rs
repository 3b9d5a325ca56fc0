//! Plan entries of rigid surfaces.

use crate::plan::PlanEntries;
use crate::scene::{RigidSurface, Scene};

/// One entry for all of them.
pub(in crate::simulation) fn plan_entries(scene: &Scene, list: &mut PlanEntries) {
    let surfaces: Vec<String> = scene.surfaces.iter().map(surface_words).collect();
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
