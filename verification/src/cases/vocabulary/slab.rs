//! Scenes in the plane as slabs of one layer of cells in three dimensions.
//!
//! All that happens in the plane is the same at every depth: the faces of the slab lie in sliding planes of the mesh, and
//! particles and triangles are the same on both sides of its middle. What a slab gives, divided by its thickness, is to be
//! what the plane gives; what is left is that the two project boundaries differently.

use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::outline::outline;
use proctor_contact::geometry::mortar::space::refine::fill;
use proctor_contact::geometry::surface::{Surface, SurfaceError};
use proctor_scene::{
    Body, BodyBoundary, BoxLoad, Dimension, Mesh, Mortar, PlaneCondition, RigidFacets, Scene,
    Shape, Vertices,
};
use std::sync::Arc;

use crate::case::{Rung, Size};
use crate::settings::Method;
use crate::study::Failure;
use thiserror::Error;

/// The variant of a rung that is solved in the plane, and that which is solved as a slab.
pub const VARIANTS: [&str; 2] = ["plane", "slab"];

/// The methods that a study of a slab tries: contact in space takes most of the time, on any mesh.
pub fn tries(size: Size, method: Method) -> bool {
    size == Size::Full || method == Method::DEFAULT
}

/// A scene of the plane, or its slab.
///
/// # Errors
/// If it has no slab.
pub fn of(plane: Scene, is_slab: bool) -> Result<Scene, Failure> {
    Ok(if is_slab { slab(&plane)? } else { plane })
}

/// A scene that has no slab.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoSlab {
    /// A shape of a body that cannot be extruded.
    #[error("a {0} cannot be extruded")]
    Shape(&'static str),
    /// An extruded boundary is no surface.
    #[error("{0}")]
    Surface(SurfaceError),
}

/// Rungs of both variants at the given cells.
pub fn rungs(cells: &[f64]) -> Vec<Rung> {
    let both = cells
        .iter()
        .flat_map(|&cell| VARIANTS.map(|variant| (cell, variant)));
    both.map(|(cell, variant)| Rung::new(variant, cell))
        .collect()
}

/// The slab of a scene, as thick as its cells are wide; forces are those per metre times the thickness.
///
/// # Errors
/// Bodies that are no rectangles, polygons or discs, and boundaries that are no surface when extruded.
pub fn slab(plane: &Scene) -> Result<Scene, NoSlab> {
    let thickness = plane.mesh.cell[0];
    let deep = |[x, y, _]: [f64; 3], z: f64| [x, y, z];
    let bodies: Vec<Body> = plane
        .bodies
        .iter()
        .map(|body| {
            Ok(Body {
                shape: extruded(&body.shape, thickness)?,
                ..body.clone()
            })
        })
        .collect::<Result<_, NoSlab>>()?;
    let boundaries = plane.mortar.boundaries.iter().map(|boundary| {
        let chains = match &boundary.vertices {
            Vertices::Given(chains) => chains.clone(),
            Vertices::Spacing(length) => plane
                .bodies
                .iter()
                .find(|body| body.id == boundary.body)
                .and_then(|body| outline(&body.shape, *length).ok())
                .unwrap_or_default(),
            Vertices::Surface(_) => vec![],
        };
        Ok(BodyBoundary {
            vertices: Vertices::Surface(Arc::new(surface(&chains, thickness)?)),
            ..boundary.clone()
        })
    });
    let facets = plane.mortar.lines.iter().map(|line| {
        Ok(RigidFacets {
            name: line.name.clone(),
            id: line.id,
            surface: Arc::new(surface(&line.chains, thickness)?),
            motion: line.motion.clone(),
        })
    });
    let loads = plane.box_loads.iter().map(|load| BoxLoad {
        p1: deep(load.p1, 0.0),
        p2: deep(load.p2, thickness),
        force: load.force.map(|f| f * thickness),
    });
    let Mesh {
        origin,
        cell,
        cells,
        planes,
        ..
    } = plane.mesh.clone();
    Ok(Scene {
        dimension: Dimension::Three,
        mesh: Mesh {
            origin: deep(origin, 0.0),
            cell: deep(cell, thickness),
            cells: [cells[0], cells[1], 1],
            planes: [planes[0], planes[1], [PlaneCondition::Sliding; 2]],
            axisymmetric: false,
        },
        bodies,
        box_loads: loads.collect(),
        mortar: Mortar {
            boundaries: boundaries.collect::<Result<_, NoSlab>>()?,
            lines: vec![],
            facets: facets.collect::<Result<_, NoSlab>>()?,
            contacts: plane.mortar.contacts.clone(),
        },
        ..plane.clone()
    })
}

fn extruded(shape: &Shape, thickness: f64) -> Result<Shape, NoSlab> {
    match shape {
        Shape::Cuboid { p1, p2 } => Ok(Shape::Cuboid {
            p1: [p1[0], p1[1], 0.0],
            p2: [p2[0], p2[1], thickness],
        }),
        Shape::Sphere { center, radius } => Ok(Shape::Cylinder {
            p1: [center[0], center[1], 0.0],
            p2: [center[0], center[1], thickness],
            radius: *radius,
        }),
        Shape::Polygon { points } => Ok(Shape::ExtrudedPolygon {
            points: points.iter().map(|p| [p[0], p[1]]).collect(),
            axis: 2,
            range: [0.0, thickness],
        }),
        other => Err(NoSlab::Shape(other.word(Dimension::Two))),
    }
}

/// Polylines from z = 0 to the thickness: four triangles about the middle of each face, so that nothing differs between
/// the two sides, and lids on closed ones.
fn surface(chains: &[Chain], thickness: f64) -> Result<Surface, NoSlab> {
    let mut corners: Vec<[[f64; 3]; 3]> = vec![];
    for chain in chains {
        let points = &chain.points;
        let joined = match chain.side {
            BoundarySide::Open => points.len() - 1,
            BoundarySide::Outer | BoundarySide::Hole => points.len(),
        };
        for k in 0..joined {
            let (a, b) = (points[k], points[(k + 1) % points.len()]);
            let ring = [
                [a.x, a.y, 0.0],
                [b.x, b.y, 0.0],
                [b.x, b.y, thickness],
                [a.x, a.y, thickness],
            ];
            let middle = [0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * thickness];
            corners.extend((0..4).map(|i| [ring[i], ring[(i + 1) % 4], middle]));
        }
        if chain.side == BoundarySide::Outer {
            let (points, triangles) = fill(points, f64::INFINITY);
            for [a, b, c] in triangles {
                let at = |v: usize, z: f64| [points[v].x, points[v].y, z];
                corners.push([a, b, c].map(|v| at(v, thickness)));
                corners.push([a, c, b].map(|v| at(v, 0.0)));
            }
        }
    }
    Surface::new(&corners).map_err(NoSlab::Surface)
}
