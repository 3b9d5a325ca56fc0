//! Plan entries of mortar contact.

use crate::geometry::mortar::motion::FollowMode;
use crate::geometry::mortar::points::Detection;
use crate::values::{ContactValues, Enforcement, PlannedBody};
use proctor_kernel::model::{CycleSettings, Dimension};
use proctor_kernel::plan::PlanEntries;

/// One entry for each boundary, and one for each pair.
pub(crate) fn plan_entries(
    values: &ContactValues,
    settings: &CycleSettings,
    _: &[PlannedBody<'_>],
    list: &mut PlanEntries,
) {
    for boundary in &values.mortar.boundaries {
        list.keep(
            "stage",
            &format!("boundary of body {}", boundary.body),
            match boundary.follow {
                FollowMode::Unaugmented => {
                    "its vertices follow the velocities of the nodes, those without mass too"
                }
                FollowMode::Velocity => "its vertices follow the velocities of the nodes",
                FollowMode::Spin => "its vertices follow velocities and spins of the nodes, and forces on them turn these too",
                FollowMode::Gradient => {
                    "its vertices follow velocities and velocity gradients of the nodes, and forces on them turn and \
                     stretch these too"
                }
                FollowMode::Material => "its vertices stay on the particles that are around them at the start, which take their forces",
            },
        );
    }
    for contact in &values.mortar.contacts {
        list.keep(
            "stage",
            &format!("mortar contact {}", contact.id),
            &format!(
                "master {}, slave {}, critical gap {} m, normal stiffness {} Pa/m, friction {}; {}, {}",
                contact.master,
                contact.slave,
                contact.critical_gap,
                contact.normal_stiffness,
                contact.friction,
                match contact.enforcement {
                    Enforcement::Barrier => "barrier",
                    Enforcement::Penalty => "penalty",
                },
                match (contact.detection, settings.dimension) {
                    (Detection::Mortar, Dimension::Two) => "mortar segments",
                    (Detection::Mortar, Dimension::Three) => "mortar triangles",
                    (Detection::NodeToSegment, Dimension::Two) => "node to segment",
                    (Detection::NodeToSegment, Dimension::Three) => "node to triangle",
                },
            ),
        );
    }
}
