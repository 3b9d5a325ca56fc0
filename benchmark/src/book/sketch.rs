//! The sketch of a scene: bodies, rigid lines and the planes of the mesh, seen along the axis across.

use crate::report::escape;
use crate::show::number;
use proctor_scene::{Dimension, PlaneCondition, Scene, Shape, Vector};
use std::fmt::Write as _;

/// Width and height that the mesh may take.
const ROOM: [f64; 2] = [440.0, 260.0];
/// Space around it.
const MARGIN: f64 = 20.0;
/// Cells along an axis from which on the lines of the mesh are left out.
const MOST_LINES: usize = 90;
/// Corners of a circle.
const CORNERS: usize = 48;

/// The mesh in the plane of the sketch.
struct Plane {
    axes: [usize; 2],
    origin: [f64; 2],
    extent: [f64; 2],
    scale: f64,
}

impl Plane {
    fn of(scene: &Scene) -> Option<Self> {
        let steepest = (0..3).max_by(|&a, &b| {
            let size = |axis: usize| scene.gravity[axis].abs();
            size(a).total_cmp(&size(b))
        })?;
        let up = match (scene.dimension, steepest) {
            (Dimension::Three, axis) if axis > 0 && scene.gravity[axis] != 0.0 => axis,
            (Dimension::Three, _) if scene.mesh.cells[2] > 1 => 2,
            _ => 1,
        };
        let axes = [0, up];
        let mesh = &scene.mesh;
        let extent = axes.map(|axis| mesh.cell[axis] * mesh.cells[axis] as f64);
        let scale = (ROOM[0] / extent[0]).min(ROOM[1] / extent[1]);
        scale.is_finite().then_some(Self {
            axes,
            origin: axes.map(|axis| mesh.origin[axis]),
            extent,
            scale,
        })
    }

    /// A place of the scene in the picture.
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            MARGIN + (x - self.origin[0]) * self.scale,
            MARGIN + (self.origin[1] + self.extent[1] - y) * self.scale,
        ]
    }

    fn path(&self, points: &[[f64; 2]], closed: bool) -> String {
        let mut path = String::new();
        for (i, point) in points.iter().enumerate() {
            let [x, y] = self.place(*point);
            let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
        }
        if closed {
            path.push('Z');
        }
        path
    }

    fn of_vector(&self, vector: &Vector) -> [f64; 2] {
        self.axes.map(|axis| vector[axis])
    }

    fn rectangle(&self, low: &Vector, high: &Vector) -> Vec<[f64; 2]> {
        let ([x0, y0], [x1, y1]) = (self.of_vector(low), self.of_vector(high));
        vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    }

    /// The outlines of a shape; none of one that has no simple outline.
    fn outlines(&self, shape: &Shape) -> Vec<Vec<[f64; 2]>> {
        let circle = |center: &Vector, radius: f64| -> Vec<[f64; 2]> {
            let [x, y] = self.of_vector(center);
            (0..CORNERS)
                .map(|k| {
                    let (sin, cos) =
                        libm::sincos(std::f64::consts::TAU * k as f64 / CORNERS as f64);
                    [x + radius * cos, y + radius * sin]
                })
                .collect()
        };
        match shape {
            Shape::Cuboid { p1, p2 } => vec![self.rectangle(p1, p2)],
            Shape::Sphere { center, radius } => vec![circle(center, *radius)],
            Shape::Ring {
                center,
                inner,
                outer,
            } => vec![circle(center, *outer), circle(center, *inner)],
            Shape::Cylinder { p1, p2, radius } => {
                let across = (0..3).find(|axis| !self.axes.contains(axis)).unwrap_or(2);
                let along = (0..3).find(|&axis| p1[axis] != p2[axis]).unwrap_or(2);
                if along == across {
                    return vec![circle(p1, *radius)];
                }
                let (mut low, mut high) = (*p1, *p2);
                for axis in 0..3 {
                    (low[axis], high[axis]) = (p1[axis].min(p2[axis]), p1[axis].max(p2[axis]));
                    if axis != along {
                        low[axis] -= radius;
                        high[axis] += radius;
                    }
                }
                vec![self.rectangle(&low, &high)]
            }
            Shape::Polygon { points } => {
                vec![points.iter().map(|point| self.of_vector(point)).collect()]
            }
            Shape::ExtrudedPolygon {
                points,
                axis,
                range,
            } => {
                let others: Vec<usize> = (0..3).filter(|other| other != axis).collect();
                if self.axes[..] == others[..] {
                    return vec![points.clone()];
                }
                let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
                (low[*axis], high[*axis]) = (range[0], range[1]);
                for point in points {
                    for (k, &other) in others.iter().enumerate() {
                        low[other] = low[other].min(point[k]);
                        high[other] = high[other].max(point[k]);
                    }
                }
                vec![self.rectangle(&low, &high)]
            }
            Shape::Particles(seeds) => {
                let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
                for seed in seeds.iter() {
                    for axis in 0..3 {
                        low[axis] = low[axis].min(seed.position[axis]);
                        high[axis] = high[axis].max(seed.position[axis]);
                    }
                }
                vec![self.rectangle(&low, &high)]
            }
            Shape::Stratum(_) | Shape::Enclosed(_) => vec![],
        }
    }
}

/// The look of a plane of the mesh: its stroke, and the word of the caption.
fn look(condition: PlaneCondition) -> Option<(&'static str, &'static str)> {
    match condition {
        PlaneCondition::Free => None,
        PlaneCondition::Sliding => Some((
            "stroke-width=\"3\" stroke-dasharray=\"6 4\"",
            "dashed: sliding",
        )),
        PlaneCondition::Fixed => Some(("stroke-width=\"5\"", "solid: fixed")),
        PlaneCondition::Antisymmetric => Some((
            "stroke-width=\"3\" stroke-dasharray=\"1 4\"",
            "dotted: antisymmetric",
        )),
        PlaneCondition::Absorbing => Some((
            "stroke-width=\"3\" stroke-dasharray=\"9 3 2 3\"",
            "dash-dot: absorbing",
        )),
    }
}

/// The sketch as an SVG document; none of a scene whose bodies have no outline.
#[must_use]
pub fn svg(scene: &Scene) -> Option<String> {
    let plane = Plane::of(scene)?;
    let outlines: Vec<Vec<Vec<[f64; 2]>>> = { scene.bodies.iter() }
        .map(|body| plane.outlines(&body.shape))
        .filter(|outlines| !outlines.is_empty())
        .collect();
    if outlines.is_empty() {
        return None;
    }
    let size = plane
        .extent
        .map(|extent| extent * plane.scale + 2.0 * MARGIN);
    let width = size[0].max(160.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {:.0}\" width=\"{width:.0}\" role=\"img\">\n<title>{}</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        size[1],
        escape(&format!("{}: bodies on their mesh", scene.name)),
    );
    let mesh = &scene.mesh;
    let mut lines = String::new();
    for (k, &axis) in plane.axes.iter().enumerate() {
        if plane.axes.iter().any(|&axis| mesh.cells[axis] > MOST_LINES) {
            continue;
        }
        for i in 0..=mesh.cells[axis] {
            let at = plane.origin[k] + mesh.cell[axis] * i as f64;
            let (mut from, mut to) = (plane.origin, plane.origin);
            (from[k], to[k]) = (at, at);
            to[1 - k] += plane.extent[1 - k];
            lines.push_str(&plane.path(&[from, to], false));
        }
    }
    let _ = writeln!(
        text,
        "<path d=\"{lines}\" fill=\"none\" stroke=\"#d5d9de\"/>"
    );
    for (i, outlines) in outlines.iter().enumerate() {
        let path: String = outlines.iter().map(|line| plane.path(line, true)).collect();
        let fill = ["#9ecae6", "#f4c9a3", "#b3e2d5", "#d9c6e4"][i % 4];
        let _ = writeln!(
            text,
            "<path d=\"{path}\" fill=\"{fill}\" fill-opacity=\"0.85\" fill-rule=\"evenodd\" stroke=\"#1b1f24\"/>"
        );
    }
    let [x0, y0] = plane.origin;
    let [x1, y1] = [x0 + plane.extent[0], y0 + plane.extent[1]];
    for (k, ends) in [
        [[[x0, y0], [x0, y1]], [[x1, y0], [x1, y1]]],
        [[[x0, y0], [x1, y0]], [[x0, y1], [x1, y1]]],
    ]
    .iter()
    .enumerate()
    {
        for (side, ends) in ends.iter().enumerate() {
            let Some((stroke, _)) = look(mesh.planes[plane.axes[k]][side]) else {
                continue;
            };
            let path = plane.path(ends, false);
            let _ = writeln!(text, "<path d=\"{path}\" stroke=\"#1b1f24\" {stroke}/>");
        }
    }
    for line in scene.mortar.lines.iter().flat_map(|line| &line.chains) {
        let points: Vec<[f64; 2]> = line.points.iter().map(|p| [p.x, p.y]).collect();
        let path = plane.path(&points, false);
        let _ = writeln!(
            text,
            "<path d=\"{path}\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"3\"/>"
        );
    }
    let [gx, gy] = plane.of_vector(&scene.gravity);
    let g = gx.hypot(gy);
    if g > 0.0 {
        let (x, y) = (width - 26.0, 26.0);
        let (dx, dy) = (16.0 * gx / g, -16.0 * gy / g);
        let _ = writeln!(
            text,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#d55e00\" stroke-width=\"2\"/><circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3.5\" fill=\"#d55e00\"/>",
            x - dx,
            y - dy,
            x + dx,
            y + dy,
            x + dx,
            y + dy
        );
    }
    text.push_str("</svg>\n");
    Some(text)
}

/// The words below the sketch: the run, the mesh, the planes and gravity.
#[must_use]
pub fn caption(scene: &Scene, label: &str) -> String {
    let axes = match scene.dimension {
        Dimension::Two => 2,
        Dimension::Three => 3,
    };
    let cells: Vec<String> = (0..axes)
        .map(|axis| scene.mesh.cells[axis].to_string())
        .collect();
    let mut words: Vec<&str> = vec![];
    for planes in &scene.mesh.planes[..axes] {
        for (_, word) in planes.iter().filter_map(|condition| look(*condition)) {
            if !words.contains(&word) {
                words.push(word);
            }
        }
    }
    let mut text = format!(
        "Run {label}: {} {} on a mesh of {} cells of {} m.",
        scene.bodies.len(),
        if scene.bodies.len() == 1 {
            "body"
        } else {
            "bodies"
        },
        cells.join(" x "),
        number(scene.mesh.cell[0]),
    );
    if !words.is_empty() {
        let _ = write!(text, " Planes of the mesh, {}.", words.join(", "));
    }
    if !scene.mortar.lines.is_empty() {
        text.push_str(" Orange: a rigid line.");
    }
    if scene.gravity.iter().any(|g| *g != 0.0) {
        let size = scene.gravity.iter().map(|g| g * g).sum::<f64>().sqrt();
        let _ = write!(
            text,
            " The arrow ends in a dot and shows gravity, {} m/s².",
            number(size)
        );
    }
    text
}
