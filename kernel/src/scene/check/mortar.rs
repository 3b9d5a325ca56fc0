//! Mortar contact: bodies and lines that exist, laws that push, boundaries that are sound, and what it does not go
//! together with.

use super::collector::Collector;
use crate::mortar::boundary::{Boundary, Chain};
use crate::scene::{
    BodyBoundary, Damping, Dimension, MortarContact, Scene, StressScheme, Vertices,
};

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    let mortar = &scene.mortar;
    if mortar.contacts.is_empty() && mortar.boundaries.is_empty() && mortar.lines.is_empty() {
        return;
    }
    check_company(scene, problems);
    for (i, line) in mortar.lines.iter().enumerate() {
        let path = format!("rigid_line[{i}]");
        let taken = scene.bodies.iter().any(|b| b.id == line.id)
            || mortar.lines[..i].iter().any(|l| l.id == line.id);
        if taken {
            problems.add(
                format!("{path}.id"),
                format!("{}, which another body or line has", line.id),
                "an id of its own",
            );
        }
        check_chains(&line.chains, &format!("{path}.points"), problems);
    }
    for boundary in &mortar.boundaries {
        check_boundary(scene, boundary, problems);
    }
    for (i, contact) in mortar.contacts.iter().enumerate() {
        let path = format!("mortar[{i}]");
        check_law(contact, &path, problems);
        check_ends(scene, contact, &path, problems);
        let same = |c: &&MortarContact| {
            (c.master, c.slave) == (contact.master, contact.slave)
                || (c.slave, c.master) == (contact.master, contact.slave)
        };
        if let Some(first) = mortar.contacts[..i].iter().find(same) {
            problems.add(
                path.clone(),
                format!(
                    "{} and {}, the pair of {} too",
                    contact.master, contact.slave, first.name
                ),
                "each pair once, whichever is the master",
            );
        }
        if let Some(first) = mortar.contacts[..i].iter().find(|c| c.id == contact.id) {
            problems.add(
                format!("{path}.id"),
                format!("{}, the id of {} too", contact.id, first.name),
                "an id that no other contact has",
            );
        }
    }
}

/// What mortar contact is not built for.
fn check_company(scene: &Scene, problems: &mut Collector) {
    if scene.dimension != Dimension::Two {
        problems.add(
            "dimension",
            "3 with mortar contact, which is built in two dimensions",
            "2, or `method` \"grid\"",
        );
    }
    if scene.scheme != StressScheme::Usl {
        problems.add(
            "stress_scheme_update",
            "USF or MUSL with mortar contact, which is built for USL",
            "\"USL\", or `method` \"grid\"",
        );
    }
    if scene.base_motion.is_some() {
        problems.add(
            "earthquake.active",
            "a moving base with mortar contact, whose boundaries do not follow the mesh",
            "no `earthquake`, or `method` \"grid\"",
        );
    }
    if scene.damping == Damping::Kinetic {
        problems.add(
            "damping.type",
            "kinetic with mortar contact, whose springs do not end at a peak of kinetic energy",
            "\"local\", \"viscous\" or \"none\"",
        );
    }
    if !scene.surfaces.is_empty() {
        problems.add(
            "terrain_contact",
            "a rigid surface beside mortar contact, whose bodies have velocity fields that surfaces do not see",
            "a `rigid_line`, or no mortar contact",
        );
    }
    if !scene.contacts.is_empty() {
        problems.add(
            "contact",
            "grid and mortar contacts in one scene",
            "one method for all contacts",
        );
    }
}

fn check_chains(chains: &[Chain], path: &str, problems: &mut Collector) {
    if let Err(e) = Boundary::new(chains) {
        problems.add(
            path,
            e.to_string(),
            "polylines with the material on their left that do not cross",
        );
    }
}

fn check_boundary(scene: &Scene, boundary: &BodyBoundary, problems: &mut Collector) {
    let Some(i) = scene.bodies.iter().position(|b| b.id == boundary.body) else {
        problems.add(
            "boundary",
            format!("{}, which no body has", boundary.body),
            "the id of a body",
        );
        return;
    };
    match &boundary.vertices {
        Vertices::Spacing(length) => {
            problems.positive(format!("bodies[{i}].boundary_segment"), *length, "m");
        }
        Vertices::Given(chains) => {
            check_chains(chains, &format!("bodies[{i}].boundary"), problems);
        }
    }
}

fn check_law(contact: &MortarContact, path: &str, problems: &mut Collector) {
    problems.positive(format!("{path}.critical_gap"), contact.critical_gap, "m");
    problems.positive(
        format!("{path}.normal_stiffness"),
        contact.normal_stiffness,
        "Pa/m",
    );
    problems.not_negative(format!("{path}.friction"), contact.friction);
    if contact.friction > 0.0 {
        problems.positive(
            format!("{path}.tangential_stiffness"),
            contact.tangential_stiffness,
            "Pa/m",
        );
    }
}

/// Both ends exist, have a boundary, and are not the same.
fn check_ends(scene: &Scene, contact: &MortarContact, path: &str, problems: &mut Collector) {
    if contact.master == contact.slave {
        problems.add(
            format!("{path}.slave_id"),
            format!("{}, the master itself", contact.slave),
            "the id of another body or line",
        );
    }
    for (key, id) in [("master_id", contact.master), ("slave_id", contact.slave)] {
        let line = scene.mortar.lines.iter().any(|l| l.id == id);
        let body = scene.bodies.iter().any(|b| b.id == id);
        let bounded = scene.mortar.boundaries.iter().any(|b| b.body == id);
        let path = format!("{path}.{key}");
        if !line && !body {
            problems.add(
                path,
                format!("{id}, which no body and no rigid line has"),
                "the id of a body with a boundary or of a rigid line",
            );
        } else if body && !bounded {
            problems.add(
                path,
                format!("{id}, a body without a boundary"),
                "a body with `boundary_segment` or `boundary`",
            );
        }
    }
}
