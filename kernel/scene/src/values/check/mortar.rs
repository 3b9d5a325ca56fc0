//! Mortar contact: bodies and lines that exist, laws that push, boundaries that are sound, and what it does not go
//! together with.

use super::collector::Collector;
use crate::values::Scene;
use proctor_contact::geometry::mortar::boundary::{Boundary, Chain};
use proctor_contact::geometry::mortar::outline::distance_to_outline;
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_contact::geometry::surface::Surface;
use proctor_contact::{BodyBoundary, Contact, MortarContact, Vertices};
use proctor_geometry::number::Number;
use proctor_kernel::model::{Damping, Dimension, StressScheme};

/// Shortest segment of a boundary made from a shape, in cells.
const FINEST_SEGMENT: f64 = 1e-3;

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    let mortar = &scene.mortar;
    let nothing = mortar.contacts.is_empty()
        && mortar.boundaries.is_empty()
        && mortar.lines.is_empty()
        && mortar.facets.is_empty();
    if nothing {
        return;
    }
    check_company(scene, problems);
    for (i, line) in mortar.lines.iter().enumerate() {
        let path = format!("rigid_line[{i}]");
        if scene.dimension == Dimension::Three {
            problems.add(
                path.clone(),
                "a polyline in three dimensions",
                "a `rigid_surface`",
            );
        }
        let taken = mortar.lines[..i].iter().any(|l| l.id == line.id);
        check_id(scene, line.id, taken, &path, problems);
        check_chains(&line.chains, &format!("{path}.points"), problems);
    }
    for (i, rigid) in mortar.facets.iter().enumerate() {
        let path = format!("rigid_surface[{i}]");
        if scene.dimension == Dimension::Two {
            problems.add(
                path.clone(),
                "triangles in two dimensions",
                "a `rigid_line`",
            );
        }
        let taken = mortar.lines.iter().any(|l| l.id == rigid.id)
            || mortar.facets[..i].iter().any(|r| r.id == rigid.id);
        check_id(scene, rigid.id, taken, &path, problems);
        check_facets(&rigid.surface, &format!("{path}.stl_mesh"), problems);
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

/// Refuses features that mortar contact does not support.
fn check_company(scene: &Scene, problems: &mut Collector) {
    let mortar = &scene.mortar;
    if scene.scheme == StressScheme::Usf {
        problems.add(
            "stress_scheme_update",
            "USF with mortar contact, with which a collision of two discs did not stay stable",
            "\"USL\" or \"MUSL\", or `method` \"grid\"",
        );
    }
    if scene.damping == Damping::Kinetic {
        problems.add(
            "damping.type",
            "kinetic with mortar contact, whose springs do not end at a peak of kinetic energy",
            "\"local\", \"viscous\" or \"none\"",
        );
    }
    for (i, contact) in mortar.contacts.iter().enumerate() {
        if let Some(other) = scene.contacts.iter().find(|c| c.id == contact.id) {
            problems.add(
                format!("mortar[{i}].id"),
                format!("{}, the id of {} too", contact.id, other.name),
                "an id that no other contact has",
            );
        }
    }
    for (i, contact) in mortar_and_grid(scene) {
        problems.add(
            format!("mortar[{i}]"),
            format!(
                "{} and {}, the pair of {} too",
                scene.mortar.contacts[i].master, scene.mortar.contacts[i].slave, contact.name
            ),
            "each pair by one method",
        );
    }
}

/// Mortar contacts whose pair has contact on the grid too.
fn mortar_and_grid(scene: &Scene) -> impl Iterator<Item = (usize, &Contact)> {
    let contacts = scene.mortar.contacts.iter().enumerate();
    contacts.filter_map(|(i, mortar)| {
        let ends = [mortar.master, mortar.slave];
        let same = |c: &&Contact| ends.contains(&c.master) && ends.contains(&c.slave);
        Some((i, scene.contacts.iter().find(same)?))
    })
}

fn check_id(scene: &Scene, id: i64, taken: bool, path: &str, problems: &mut Collector) {
    if taken || scene.bodies.iter().any(|b| b.id == id) {
        problems.add(
            format!("{path}.id"),
            format!("{id}, which another body, line or surface has"),
            "an id of its own",
        );
    }
}

/// A closed surface must have its outside out.
fn check_facets(surface: &Surface, path: &str, problems: &mut Collector) {
    if let Err(e) = Facets::new(surface) {
        problems.add(
            path,
            e.to_string(),
            "triangles whose normals point out of the body",
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
            let path = format!("bodies[{i}].boundary_segment");
            let least = FINEST_SEGMENT * smallest_cell(scene);
            if *length > 0.0 && *length < least {
                problems.add(
                    path,
                    Number(*length).to_string(),
                    format!(
                        "a thousandth of a cell or more, {} [m]: the grid sees nothing finer",
                        Number(least)
                    ),
                );
            } else {
                problems.positive(path, *length, "m");
            }
        }
        Vertices::Given(chains) => {
            let path = format!("bodies[{i}].boundary");
            if scene.dimension == Dimension::Three {
                problems.add(
                    path.clone(),
                    "a polyline in three dimensions",
                    "`boundary_segment` or `boundary_stl_mesh`",
                );
            }
            check_chains(chains, &path, problems);
            check_places(scene, i, chains, &path, problems);
        }
        Vertices::Surface(surface) => {
            let path = format!("bodies[{i}].boundary_stl_mesh");
            if scene.dimension == Dimension::Two {
                problems.add(
                    path.clone(),
                    "triangles in two dimensions",
                    "`boundary_segment` or `boundary`",
                );
            }
            match surface.require_closed() {
                Ok(()) => check_facets(surface, &path, problems),
                Err(error) => problems.add(path, error.kind.to_string(), error.kind.accepted()),
            }
        }
    }
}

/// Vertices lie on the body: no further from the outline of its shape than half a cell, so that they find its nodes and
/// bound its particles.
fn check_places(scene: &Scene, i: usize, chains: &[Chain], path: &str, problems: &mut Collector) {
    let most = 0.5 * smallest_cell(scene);
    let vertices = chains
        .iter()
        .enumerate()
        .flat_map(|(c, chain)| chain.points.iter().enumerate().map(move |(k, x)| (c, k, x)));
    for (chain, k, x) in vertices {
        let distance = distance_to_outline(&scene.bodies[i].shape, x);
        if let Some(distance) = distance.filter(|d| *d > most) {
            problems.add(
                path,
                format!(
                    "vertex {k} of polyline {chain} at ({}, {}) m, {} m from the outline of the body",
                    Number(x.x),
                    Number(x.y),
                    Number(distance)
                ),
                format!("vertices within half a cell of it, {} m", Number(most)),
            );
            return;
        }
    }
}

fn smallest_cell(scene: &Scene) -> f64 {
    let cell = &scene.mesh.cell[..scene.dimension.axes()];
    cell.iter().copied().fold(f64::INFINITY, f64::min)
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
        let line = scene.mortar.lines.iter().any(|l| l.id == id)
            || scene.mortar.facets.iter().any(|r| r.id == id);
        let body = scene.bodies.iter().any(|b| b.id == id);
        let bounded = scene.mortar.boundaries.iter().any(|b| b.body == id);
        let path = format!("{path}.{key}");
        if !line && !body {
            problems.add(
                path,
                format!("{id}, which no body, rigid line or rigid surface has"),
                "the id of a body with a boundary, of a rigid line or of a rigid surface",
            );
        } else if body && !bounded {
            problems.add(
                path,
                format!("{id}, a body without a boundary"),
                "a body with `boundary_segment`, `boundary` or `boundary_stl_mesh`",
            );
        }
    }
}
