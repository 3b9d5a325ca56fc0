//! Rests: boxes that lie with a face on a driven body that stands still, or on a rigid line in mortar contact.

use super::places::gap;
use crate::values::{Body, Scene};
use proctor_kernel::model::{Shape, Vector};
use proctor_kernel::weights::ROUND_OFF;

/// The support of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Support {
    /// A driven body that stands still.
    Driven,
    /// A rigid line in mortar contact.
    Line,
    /// A plane of the mesh.
    Plane,
}

/// A box with a face on a support.
pub(super) struct Rest<'a> {
    /// The body.
    pub body: &'a Body,
    /// Its lower and upper corner \[m\].
    pub bounds: [Vector; 2],
    /// Normal of the face.
    pub axis: usize,
    /// Side of the body on which it is: 0 the lower one, 1 the upper one.
    pub side: usize,
    /// The support.
    pub on: Support,
}

impl Rest<'_> {
    /// Length of the body along an axis \[cells\].
    pub fn length(&self, scene: &Scene, axis: usize) -> f64 {
        (self.bounds[1][axis] - self.bounds[0][axis]) / scene.mesh.cell[axis]
    }

    /// Rows of particles along an axis.
    pub fn rows(&self, scene: &Scene, axis: usize) -> f64 {
        let particles = self.body.particles_per_cell[axis] as f64;
        (self.length(scene, axis) * particles - 1e-6)
            .ceil()
            .max(1.0)
    }

    /// Cells from the face on a side to the line of the mesh that the body ends beyond, towards the outside.
    pub fn beyond(&self, scene: &Scene, axis: usize, side: usize) -> f64 {
        let xi = (self.bounds[side][axis] - scene.mesh.origin[axis]) / scene.mesh.cell[axis];
        let outward = if side == 0 { -xi } else { xi };
        let beyond = outward - outward.floor();
        let round_off = scene.mesh.tolerance(axis) / scene.mesh.cell[axis];
        if beyond > 1.0 - round_off.max(ROUND_OFF) {
            0.0
        } else {
            beyond
        }
    }

    /// True where the face on the support lies on a line of the mesh.
    pub fn on_a_line(&self, scene: &Scene) -> bool {
        let round_off = scene.mesh.tolerance(self.axis) / scene.mesh.cell[self.axis];
        self.beyond(scene, self.axis, self.side) < round_off.max(ROUND_OFF)
    }

    /// True where nothing holds a side: neither a plane with a condition nor another body within a cell.
    pub fn is_free(&self, scene: &Scene, axis: usize, side: usize) -> bool {
        let (mesh, cell) = (&scene.mesh, scene.mesh.cell[axis]);
        let to_plane = if side == 0 {
            self.bounds[0][axis] - mesh.origin[axis]
        } else {
            mesh.upper()[axis] - self.bounds[1][axis]
        };
        let mut beside = self.bounds;
        if side == 0 {
            beside[1][axis] = self.bounds[0][axis];
            beside[0][axis] = self.bounds[0][axis] - cell;
        } else {
            beside[0][axis] = self.bounds[1][axis];
            beside[1][axis] = self.bounds[1][axis] + cell;
        }
        let meets = |other: &Body| {
            let Some(bounds) = other.shape.bounds() else {
                return false;
            };
            let axes = 0..scene.dimension.axes();
            other.id != self.body.id
                && axes
                    .into_iter()
                    .all(|a| gap(&beside, &bounds, a) < -mesh.tolerance(a))
        };
        (to_plane > cell || !scene.plane_acts(axis, side)) && !scene.bodies.iter().any(meets)
    }

    /// True where a driven body that stands still lies at the opposite face as well.
    pub fn is_between_driven(&self, scene: &Scene) -> bool {
        let opposite = [self.axis, 1 - self.side];
        self.on == Support::Driven
            && support(scene, self.body, &self.bounds, opposite) == Some(Support::Driven)
    }

    /// Axes along the face.
    pub fn along(&self, scene: &Scene) -> impl Iterator<Item = usize> {
        let normal = self.axis;
        (0..scene.dimension.axes()).filter(move |axis| *axis != normal)
    }
}

/// All rests of a scene, one for each body at most.
pub(super) fn all<'a>(scene: &'a Scene) -> Vec<Rest<'a>> {
    let faces = (0..scene.dimension.axes()).flat_map(|axis| [(axis, 0), (axis, 1)]);
    let of = |body: &'a Body| {
        let is_box = matches!(body.shape, Shape::Cuboid { .. });
        if !is_box || body.motion.is_some() {
            return None;
        }
        let bounds = body.shape.bounds()?;
        faces.clone().find_map(|(axis, side)| {
            let on = support(scene, body, &bounds, [axis, side])?;
            Some(Rest {
                body,
                bounds,
                axis,
                side,
                on,
            })
        })
    };
    scene.bodies.iter().filter_map(of).collect()
}

/// The support of a face of a body.
fn support(
    scene: &Scene,
    body: &Body,
    bounds: &[Vector; 2],
    [axis, side]: [usize; 2],
) -> Option<Support> {
    let axes = scene.dimension.axes();
    let meet = |master: i64, slave: i64, other: i64| {
        [(master, slave), (slave, master)].contains(&(body.id, other))
    };
    let carries = |other: &&Body| {
        let stands =
            (other.motion.as_ref()).is_some_and(|m| m.values.iter().all(|v| *v == [0.0; 3]));
        let (true, Shape::Cuboid { .. }, Some(below)) =
            (stands, &other.shape, other.shape.bounds())
        else {
            return false;
        };
        let between = bounds[side][axis] - below[1 - side][axis];
        let beside = |a: usize| a == axis || gap(bounds, &below, a) < -scene.mesh.tolerance(a);
        between.abs() < scene.mesh.tolerance(axis) && (0..axes).all(beside)
    };
    if scene.bodies.iter().any(|other| carries(&other)) {
        return Some(Support::Driven);
    }
    let lies = |contact: &proctor_contact::MortarContact| {
        let mut lines = scene.mortar.lines.iter();
        let line = lines.find(|line| meet(contact.master, contact.slave, line.id));
        let segments = line.into_iter().flat_map(|line| &line.chains);
        let mut segments = segments.flat_map(|chain| chain.points.windows(2));
        segments.any(|ends| {
            let (a, b) = (&ends[0], &ends[1]);
            let gap = (bounds[side][axis] - a[axis]) * if side == 0 { 1.0 } else { -1.0 };
            let along = 1 - axis;
            let reaches = a[along].min(b[along]) < bounds[1][along]
                && a[along].max(b[along]) > bounds[0][along];
            let level = (a[axis] - b[axis]).abs() < scene.mesh.tolerance(axis);
            level && reaches && (-contact.critical_gap..=contact.critical_gap).contains(&gap)
        })
    };
    let in_plane = axis < 2;
    (in_plane && scene.mortar.contacts.iter().any(lies)).then_some(Support::Line)
}
