//! Words of the plan for contact on the grid and for bonds.

use crate::values::{ContactNormal, ContactValues, PlannedBody};
use proctor_kernel::model::{CycleSettings, History, StressScheme};
use proctor_kernel::plan::PlanEntries;

/// Entries for each pair, for contact as a whole, and for bonds.
pub(super) fn plan_entries(
    values: &ContactValues,
    settings: &CycleSettings,
    bodies: &[PlannedBody<'_>],
    list: &mut PlanEntries,
) {
    pair_words(values, settings, bodies, list);
    contact_words(values, list);
    bond_words(values, bodies, list);
}

/// An entry for each pair.
fn pair_words(
    values: &ContactValues,
    settings: &CycleSettings,
    bodies: &[PlannedBody<'_>],
    list: &mut PlanEntries,
) {
    let driven = |id: i64| {
        let mut bodies = bodies.iter();
        bodies.find(|b| b.id == id && b.motion.is_some())
    };
    for contact in &values.contacts {
        let normal = match contact.normal {
            ContactNormal::Master => "normal of the master",
            ContactNormal::Slave => "normal of the slave",
            ContactNormal::Collinear => "mean of both normals",
        };
        let with_shape = [contact.master, contact.slave]
            .into_iter()
            .filter_map(driven);
        let mut with_shape = with_shape.filter(|b| b.shape.has_surface());
        let how = with_shape.next().map_or_else(
            || format!("{normal}; on the grid, while the boxes of the bodies meet"),
            |b| {
                let unless = match settings.scheme {
                    StressScheme::Usl => "",
                    StressScheme::Musl => "; at rest and with faces on lines of the mesh its nodes do",
                    StressScheme::Usf => {
                        "; where it moves or ends on lines of the mesh its nodes do, with USF"
                    }
                };
                format!(
                    "the shape of body {}, which is driven, pushes the particles that touch it, along its own normal{unless}",
                    b.id
                )
            },
        );
        list.choose(
            "stage",
            &format!("contact {}", contact.id),
            !(driven(contact.master).is_some() && driven(contact.slave).is_some()),
            &format!(
                "bodies {} (master) and {}, friction {}, {how}",
                contact.master, contact.slave, contact.friction
            ),
            "the motion of both bodies is prescribed",
        );
    }
}

/// Entries for contact as a whole.
fn contact_words(values: &ContactValues, list: &mut PlanEntries) {
    if values.contacts.is_empty() && !values.mortar.contacts.is_empty() {
        return;
    }
    if values.contacts.is_empty() {
        list.leave("stage", "contact", "the scene asks for none");
        return;
    }
    list.choose(
        "stage",
        "real distance of contacts",
        values.distance != Some(0.0),
        &values.distance.map_or_else(
            || "contact acts below the sum of the half-lengths of the particles".to_owned(),
            |lambda| format!("contact acts below {lambda} cells"),
        ),
        "its coefficient is zero",
    );
    list.keep(
        "node field",
        "mass gradient, second velocity field",
        "128 bytes per node of a body while it is near a partner",
    );
}

/// An entry for each body that stands still and has no contact with one that moves.
fn bond_words(values: &ContactValues, bodies: &[PlannedBody<'_>], list: &mut PlanEntries) {
    let stands = |body: &&PlannedBody<'_>| {
        let still = |motion: &History| motion.values.iter().all(|v| *v == [0.0; 3]);
        body.motion.is_some_and(still) && body.shape.has_surface()
    };
    for body in bodies.iter().filter(stands) {
        let touched = |other: &PlannedBody<'_>| {
            let is_pair =
                |[a, b]: [i64; 2]| [[body.id, other.id], [other.id, body.id]].contains(&[a, b]);
            let on_grid = values.contacts.iter().map(|c| [c.master, c.slave]);
            let mortar = values.mortar.contacts.iter().map(|c| [c.master, c.slave]);
            other.motion.is_some() || on_grid.chain(mortar).any(is_pair)
        };
        if bodies
            .iter()
            .any(|other| other.id != body.id && !touched(other))
        {
            list.keep(
                "stage",
                &format!("bond of body {}", body.id),
                "it is at rest: bodies without contact with it stick to its nodes, and to its shape where that ends within cells",
            );
        }
    }
}
