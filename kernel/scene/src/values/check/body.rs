//! Bodies: identifiers, materials, shapes and their place in the mesh.

use super::collector::Collector;
use super::history::check_history;
use crate::values::initial_stress::axis_of;
use crate::values::{Body, InitialStress, Scene};
use proctor_geometry::number::Number;
use proctor_geometry::polygon;
use proctor_geometry::stratum::Stratum;
use proctor_kernel::model::{Dimension, Mesh, Shape, Vector};

pub(super) fn check(scene: &Scene, mesh_is_sound: bool, problems: &mut Collector) {
    if scene.bodies.is_empty() {
        problems.add("bodies", "none", "at least one body");
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        let path = format!("bodies[{i}]");
        check_references(scene, i, body, &path, problems);
        for (axis, &n) in body.particles_per_cell.iter().enumerate() {
            let is_flat = axis >= scene.dimension.axes();
            if n == 0 || n > Body::MOST_PARTICLES || (is_flat && n != 1) {
                problems.add(
                    format!("{path}.particles_per_cell[{axis}]"),
                    n.to_string(),
                    if is_flat {
                        "1: there are two dimensions".to_owned()
                    } else {
                        format!("a whole number from 1 to {}", Body::MOST_PARTICLES)
                    },
                );
            }
        }
        problems.vector(format!("{path}.initial_velocity"), &body.velocity);
        if let Some(motion) = &body.motion {
            check_history(&format!("{path}.prescribed_velocity"), motion, problems);
        }
        check_initial_stress(scene, body, &format!("{path}.initial_stress"), problems);
        let before = problems.found.len();
        check_shape(&body.shape, scene.dimension, &path, problems);
        if mesh_is_sound && problems.found.len() == before {
            check_place(&body.shape, scene, &path, problems);
        }
    }
}

fn check_references(scene: &Scene, i: usize, body: &Body, path: &str, problems: &mut Collector) {
    if body.material >= scene.materials.len() {
        problems.add(
            format!("{path}.material_id"),
            format!("index {}", body.material),
            format!("the index of one of {} materials", scene.materials.len()),
        );
    }
    if let Some(first) = scene.bodies[..i].iter().position(|b| b.id == body.id) {
        problems.add(
            format!("{path}.id"),
            format!("{}, the id of {} too", body.id, scene.bodies[first].name),
            "an id that no other body has",
        );
    }
}

fn check_initial_stress(scene: &Scene, body: &Body, path: &str, problems: &mut Collector) {
    let material = scene.materials.get(body.material);
    if body.initial_stress != InitialStress::None
        && let Some(material) = material
        && material.law.needs_deformation()
    {
        problems.add(
            path,
            format!(
                "a stress at the start of a {} material, whose stress follows from its deformation alone",
                material.law.name()
            ),
            "no `initial_stress`, or another material",
        );
    }
    match &body.initial_stress {
        InitialStress::None => {}
        &InitialStress::Isotropic(stress) => {
            problems.finite(format!("{path}.value"), stress);
        }
        &InitialStress::AtRest {
            ratio,
            level,
            surcharge,
        } => {
            problems.not_negative(format!("{path}.ratio"), ratio);
            problems.finite(format!("{path}.level"), level);
            problems.not_negative(format!("{path}.surcharge"), surcharge);
            if axis_of(&scene.gravity).is_none() {
                problems.add(
                    path,
                    "ground at rest without gravity along one axis",
                    "`gravity` with one component that is not zero, or `type` \"isotropic\"",
                );
            }
        }
        InitialStress::Overburden(overburden) => {
            problems.not_negative(format!("{path}.ratio"), overburden.ratio);
            problems.not_negative(format!("{path}.surcharge"), overburden.surcharge);
            let last = scene.dimension.axes() - 1;
            if axis_of(&scene.gravity) != Some(last) || scene.gravity[last] > 0.0 {
                let axis = ["x", "y", "z"][last];
                problems.add(
                    path,
                    format!("ground at rest below a surface without gravity along -{axis} alone"),
                    format!("`gravity` with a negative component along {axis} and no other"),
                );
            }
        }
    }
}

/// Sizes and whether the shape exists in this number of dimensions.
fn check_shape(shape: &Shape, dimension: Dimension, path: &str, problems: &mut Collector) {
    let only = match shape {
        Shape::Ring { .. } | Shape::Polygon { .. } => Some(Dimension::Two),
        Shape::Cylinder { .. } | Shape::ExtrudedPolygon { .. } | Shape::Enclosed(_) => {
            Some(Dimension::Three)
        }
        Shape::Stratum(stratum) if stratum.axes() == 2 => Some(Dimension::Two),
        Shape::Stratum(_) => Some(Dimension::Three),
        Shape::Cuboid { .. } | Shape::Sphere { .. } | Shape::Particles(_) => None,
    };
    if only.is_some_and(|only| only != dimension) {
        problems.add(
            format!("{path}.type"),
            format!(
                "a {} in {} dimensions",
                shape.word(dimension),
                dimension.axes()
            ),
            "a shape of this number of dimensions",
        );
        return;
    }
    match shape {
        Shape::Cuboid { p1, p2 } => {
            check_box(path, p1, p2, dimension.axes(), problems);
        }
        Shape::Sphere { center, radius } => {
            problems.vector(format!("{path}.center"), center);
            problems.positive(format!("{path}.radius"), *radius, "m");
        }
        Shape::Ring {
            center,
            inner,
            outer,
        } => {
            problems.vector(format!("{path}.center"), center);
            problems.positive(format!("{path}.inner_radius"), *inner, "m");
            if !(outer.is_finite() && outer > inner) {
                problems.add(
                    format!("{path}.outer_radius"),
                    Number(*outer).to_string(),
                    format!(
                        "a finite number greater than the inner radius {} [m]",
                        Number(*inner)
                    ),
                );
            }
        }
        Shape::Cylinder { p1, p2, radius } => {
            let finite = problems.vector(format!("{path}.point_p1"), p1)
                & problems.vector(format!("{path}.point_p2"), p2);
            if finite && p1 == p2 {
                problems.add(
                    format!("{path}.point_p2"),
                    "the centre of the first end face: an empty body",
                    "the centre of the other end face",
                );
            }
            problems.positive(format!("{path}.radius"), *radius, "m");
        }
        Shape::Polygon { points } => {
            let mut finite = true;
            for (k, point) in points.iter().enumerate() {
                finite &= problems.vector(format!("{path}.points[{k}]"), point);
            }
            if finite {
                let plane: Vec<_> = points.iter().map(|p| [p[0], p[1]]).collect();
                check_polygon(path, &plane, problems);
            }
        }
        Shape::ExtrudedPolygon {
            points,
            axis,
            range,
        } => {
            if *axis > 2 {
                problems.add(format!("{path}.axis"), axis.to_string(), "0, 1 or 2");
            }
            if !(range[0].is_finite() && range[1].is_finite() && range[0] < range[1]) {
                problems.add(
                    format!("{path}.range"),
                    format!("[{}, {}]", range[0], range[1]),
                    "two finite numbers, the lower first [m]",
                );
            }
            if points.iter().flatten().all(|x| x.is_finite()) {
                check_polygon(path, points, problems);
            } else {
                problems.add(
                    format!("{path}.points"),
                    "a coordinate that is not finite",
                    "finite numbers",
                );
            }
        }
        Shape::Stratum(stratum) => {
            problems.positive(format!("{path}.upper"), stratum.volume(), "m³");
        }
        Shape::Enclosed(body) => {
            problems.positive(format!("{path}.stl_mesh"), body.volume(), "m³");
        }
        Shape::Particles(seeds) => {
            if seeds.is_empty() {
                problems.add(
                    format!("{path}.particles"),
                    "none: an empty body",
                    "at least one particle",
                );
            }
            for (k, seed) in seeds.iter().enumerate() {
                problems.vector(format!("{path}.particles[{k}]"), &seed.position);
                if !(seed.volume.is_finite() && seed.volume > 0.0) {
                    problems.add(
                        format!("{path}.particles[{k}]"),
                        format!("the volume {}", seed.volume),
                        "a finite volume greater than 0 [m³]",
                    );
                }
            }
        }
    }
}

fn check_polygon(path: &str, points: &[[f64; 2]], problems: &mut Collector) {
    if let Some(fault) = polygon::fault(points) {
        problems.add(
            format!("{path}.points"),
            fault,
            "three or more corners of a polygon that does not cross or touch itself, the first not repeated",
        );
    }
}

/// Two corners with a positive extent along each axis.
pub(super) fn check_box(
    path: &str,
    p1: &Vector,
    p2: &Vector,
    axes: usize,
    problems: &mut Collector,
) -> bool {
    let before = problems.found.len();
    if problems.vector(format!("{path}.point_p1"), p1)
        & problems.vector(format!("{path}.point_p2"), p2)
    {
        for axis in 0..axes {
            let extent = p2[axis] - p1[axis];
            if extent <= 0.0 {
                let state = if extent == 0.0 { "empty" } else { "inverted" };
                problems.add(
                    format!("{path}.point_p2[{axis}]"),
                    format!("{}, which makes the box {state}", p2[axis]),
                    format!("a number greater than point_p1[{axis}] = {} [m]", p1[axis]),
                );
            }
        }
    }
    problems.found.len() == before
}

/// Checks that the shape lies in the mesh, up to round-off.
fn check_place(shape: &Shape, scene: &Scene, path: &str, problems: &mut Collector) {
    let mesh = &scene.mesh;
    let axes = scene.dimension.axes();
    match shape {
        Shape::Cuboid { p1, p2 } => {
            for axis in 0..axes {
                outside(
                    mesh,
                    axis,
                    p1[axis],
                    &format!("{path}.point_p1[{axis}]"),
                    problems,
                );
                outside(
                    mesh,
                    axis,
                    p2[axis],
                    &format!("{path}.point_p2[{axis}]"),
                    problems,
                );
            }
        }
        Shape::Sphere { center, radius }
        | Shape::Ring {
            center,
            outer: radius,
            ..
        } => {
            let key = if matches!(shape, Shape::Ring { .. }) {
                "outer_radius"
            } else {
                "radius"
            };
            // One message for a body: all of them would speak of the same radius.
            let path = format!("{path}.{key}");
            let is_revolved = mesh.axisymmetric && center[0] == 0.0 && mesh.origin[0] == 0.0;
            (0..axes).any(|axis| {
                let low = if axis == 0 && is_revolved {
                    0.0
                } else {
                    -radius
                };
                [low, *radius]
                    .iter()
                    .any(|reach| outside(mesh, axis, center[axis] + reach, &path, problems))
            });
        }
        Shape::Cylinder { p1, p2, radius } => {
            let d: Vector = std::array::from_fn(|k| p2[k] - p1[k]);
            let length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            let path = format!("{path}.radius");
            (0..axes).any(|axis| {
                // A disc of radius r with unit normal n reaches r sqrt(1 - n_i²) along axis i.
                let reach = radius * (1.0 - d[axis] * d[axis] / length2).max(0.0).sqrt();
                let (low, high) = (p1[axis].min(p2[axis]), p1[axis].max(p2[axis]));
                outside(mesh, axis, low - reach, &path, problems)
                    || outside(mesh, axis, high + reach, &path, problems)
            });
        }
        Shape::Polygon { points } => {
            for (k, point) in points.iter().enumerate() {
                for axis in 0..axes {
                    let path = format!("{path}.points[{k}][{axis}]");
                    outside(mesh, axis, point[axis], &path, problems);
                }
            }
        }
        Shape::ExtrudedPolygon {
            points,
            axis: normal,
            range,
        } => {
            for (side, &x) in range.iter().enumerate() {
                outside(mesh, *normal, x, &format!("{path}.range[{side}]"), problems);
            }
            for (k, point) in points.iter().enumerate() {
                for (slot, axis) in (0..3).filter(|axis| axis != normal).enumerate() {
                    let path = format!("{path}.points[{k}][{slot}]");
                    outside(mesh, axis, point[slot], &path, problems);
                }
            }
        }
        Shape::Stratum(stratum) => check_stratum(stratum, mesh, path, problems),
        Shape::Enclosed(body) => {
            let path = format!("{path}.stl_mesh");
            (body.bounds().iter()).any(|corner| {
                (0..axes).any(|axis| outside(mesh, axis, corner[axis], &path, problems))
            });
        }
        Shape::Particles(seeds) => {
            for (k, seed) in seeds.iter().enumerate() {
                for axis in 0..axes {
                    let path = format!("{path}.particles[{k}][{axis}]");
                    outside(mesh, axis, seed.position[axis], &path, problems);
                }
            }
        }
    }
}

/// Places where ground between sheets leaves the mesh: beyond its plan, and at its lowest and its highest point.
fn check_stratum(stratum: &Stratum, mesh: &Mesh, path: &str, problems: &mut Collector) {
    let last = stratum.axes() - 1;
    for axis in 0..last {
        for (side, x) in stratum.range()[axis].into_iter().enumerate() {
            outside(
                mesh,
                axis,
                x,
                &format!("{path}.plan[{axis}][{side}]"),
                problems,
            );
        }
    }
    for (key, point) in ["lower", "upper"].into_iter().zip(stratum.extremes()) {
        let before = problems.found.len();
        if outside(mesh, last, point[2], &format!("{path}.{key}"), problems) {
            let place =
                (0..last).map(|axis| format!("{} = {}", ["x", "y"][axis], rounded(point[axis])));
            let found = &mut problems.found[before].found;
            *found = format!("{found}, at {}", place.collect::<Vec<_>>().join(", "));
        }
    }
}

/// A number without what sums before it were rounded by: twelve digits of it.
fn rounded(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}

/// Adds a problem if coordinate `x` lies outside the mesh; whether it does.
pub(super) fn outside(
    mesh: &Mesh,
    axis: usize,
    x: f64,
    path: &str,
    problems: &mut Collector,
) -> bool {
    let (low, high) = (mesh.origin[axis], mesh.upper()[axis]);
    let tolerance = mesh.tolerance(axis);
    let is_outside = x < low - tolerance || x > high + tolerance;
    if is_outside {
        let name = ["x", "y", "z"][axis];
        problems.add(
            path,
            format!("{name} = {x}, outside the mesh"),
            format!(
                "{name} from {} to {} [m]",
                Number(rounded(low)),
                Number(rounded(high))
            ),
        );
    }
    is_outside
}
