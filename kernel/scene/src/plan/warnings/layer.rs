//! Ways of mortar contact by which the rows of particles at a face do not carry the pressure.

use super::places::name;
use crate::values::{Body, Scene};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_kernel::model::Weighting;

/// Bodies in mortar contact whose faces press on nodes with other weights than the stress behind them has.
///
/// Rows of particles over the pressure, first to third, of a block on a rigid line with 2 x 2 particles per cell and uGIMP, whose
/// face is at 0.1, 0.36, 0.6 and 0.9 of a cell: with `material` 1.01 0.97 1.02, 0.86 1.00 1.14, 0.58 1.27 1.20 and 0.13 1.86 1.05;
/// unaugmented, whose weights are those of a particle, 1.22 0.78 0.96 at 0.9; with linear functions 0.86 0.86 1.02, 1.22 1.02
/// 1.02, 2.74 0.83 0.83 and 1.00 1.00 1.00. Weights of the face give 1.05 0.95 1.03 at most
/// (`kernel/tests/physics/mortar_layer.rs`).
pub(super) fn layers_off(scene: &Scene) -> Vec<String> {
    let in_contact = |body: &&Body| {
        let contacts = scene.mortar.contacts.iter();
        let mut ends = contacts.flat_map(|contact| [contact.master, contact.slave]);
        // Behind a round face particles lie in steps, and no row is at it.
        body.motion.is_none() && body.shape.radius().is_none() && ends.any(|id| id == body.id)
    };
    let bodies = scene.bodies.iter().filter(in_contact);
    let warning = |body: &Body| {
        let boundaries = scene.mortar.boundaries.iter();
        let boundary = boundaries.rev().find(|boundary| boundary.body == body.id)?;
        let (way, rows) = match boundary.follow {
            _ if scene.weighting == Weighting::Linear => (
                "linear functions",
                "from 0.83 to 2.74 of it; two rows inside it is right within 3 %. With \"GIMP\", \"cpGIMP\" or \
                 \"quadratic_bspline\", and vertices that follow the spin, as they do by default,",
            ),
            FollowMode::Material => (
                "\"boundary_follows\": \"material\"",
                "0.86 and 1.00 of it where the face is at 0.36 of a cell, 0.13 and 1.86 at 0.9; three rows inside it is right within \
                 5 %. With \"spin\", the default, \"velocity\" or \"gradient\"",
            ),
            FollowMode::Unaugmented => (
                "\"boundary_follows\": \"unaugmented\"",
                "1.22 and 0.78 of it where the face is at 0.9 of a cell; three rows inside it is right within 5 %. With \"spin\", the \
                 default, \"velocity\" or \"gradient\"",
            ),
            FollowMode::Velocity | FollowMode::Spin | FollowMode::Gradient => return None,
        };
        Some(format!(
            "{}: with {way} the first two rows of particles at a face in mortar contact do not carry its pressure, which is \
             right on the boundary itself, but {rows} the rows carry it within 5 %",
            name(body)
        ))
    };
    bodies.filter_map(warning).collect()
}
