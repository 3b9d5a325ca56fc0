//! Pictures of particles: each coloured by a field, over axes with units and beside a bar of the colours.

mod field;
mod furniture;
pub mod palette;
mod revolve;
mod view;

pub use field::{ParticleField, usual};
pub use revolve::revolved;
pub use view::{Projection, View};

use super::drawing::{Drawing, Pixels};
use crate::frames::Frame;
use furniture::Room;

/// Particles whose distance from their neighbours is measured, for the size of a mark.
const SAMPLES: usize = 64;
/// Side of a mark over the distance of neighbours: squares touch, and balls overlap a little.
const FILLED: f64 = 1.06;

/// Particles to be drawn.
#[derive(Clone, Debug)]
pub struct ParticlePicture<'a> {
    /// The particles.
    pub frame: &'a Frame,
    /// The field that colours them.
    pub field: &'a ParticleField,
    /// Values of the first and of the last colour.
    pub range: [f64; 2],
    /// Lower and upper corner of the part that is shown \[m\].
    pub bounds: [[f64; 3]; 2],
    /// Distance of neighbours \[m\], the size of a mark.
    pub spacing: f64,
    /// The direction to look from in space.
    pub view: View,
    /// The mesh, where its lines are to be drawn.
    pub mesh: Option<&'a MeshLines>,
    /// Words above the picture.
    pub title: &'a str,
    /// Words below it, such as the time.
    pub caption: &'a str,
}

/// The lines of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshLines {
    /// Lower corner \[m\].
    pub origin: [f64; 3],
    /// Sides of a cell \[m\].
    pub cell: [f64; 3],
    /// Number of cells along each axis.
    pub cells: [usize; 3],
}

impl ParticlePicture<'_> {
    /// The drawing.
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let flat = is_flat(self.frame);
        let projection = if flat {
            Projection::PLANE
        } else {
            self.view.projection()
        };
        let room = Room::new(self, &projection, flat);
        let mut pixels = Pixels::new(room.size());
        let half = 0.5 * FILLED * self.spacing * room.scale();
        let mut order: Vec<usize> = (0..self.frame.points.len()).collect();
        if !flat {
            // The farthest first, so that the nearest are in front.
            let points = &self.frame.points;
            let near: Vec<f64> = points
                .iter()
                .map(|point| projection.nearness(point))
                .collect();
            order.sort_unstable_by(|&p, &q| near[p].total_cmp(&near[q]).then(p.cmp(&q)));
        }
        for p in order {
            let at = room.at(projection.place(&self.frame.points[p]));
            let colour = palette::colour(self.field.values[p], self.range);
            if flat {
                pixels.square(at, half, colour);
            } else {
                pixels.ball(at, half, colour);
            }
        }
        let (behind, before) = room.items(self, &projection);
        Drawing {
            size: room.size(),
            title: self.title.to_owned(),
            behind,
            pixels,
            before,
        }
    }
}

/// True where all particles lie in the plane z = 0, as those of plane strain do.
#[must_use]
pub fn is_flat(frame: &Frame) -> bool {
    frame.points.iter().all(|point| point[2] == 0.0)
}

/// Lower and upper corner of the box that holds all particles \[m\], half a distance of neighbours around them.
#[must_use]
pub fn bounds(frame: &Frame, spacing: f64) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in &frame.points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    if frame.points.is_empty() {
        return [[0.0; 3], [1.0; 3]];
    }
    let half = 0.5 * spacing;
    let axes = if is_flat(frame) { 2 } else { 3 };
    for axis in 0..axes {
        low[axis] -= half;
        high[axis] += half;
    }
    [low, high]
}

/// Distance of neighbours \[m\]: the median over some particles of the distance to the nearest other one.
#[must_use]
pub fn spacing(frame: &Frame) -> f64 {
    let points = &frame.points;
    let every = points.len().div_ceil(SAMPLES).max(1);
    let mut nearest: Vec<f64> = (0..points.len())
        .step_by(every)
        .map(|p| {
            let squares = points.iter().enumerate().map(|(q, other)| {
                let off = (0..3).map(|axis| (other[axis] - points[p][axis]).powi(2));
                if q == p { f64::INFINITY } else { off.sum() }
            });
            squares.fold(f64::INFINITY, f64::min).sqrt()
        })
        .filter(|distance| distance.is_finite())
        .collect();
    nearest.sort_unstable_by(f64::total_cmp);
    nearest.get(nearest.len() / 2).copied().unwrap_or(1.0)
}
