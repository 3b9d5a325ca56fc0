//! What mortar contact tells of itself.

use crate::mortar::Point;
use crate::scene::Vector;
use crate::simulation::Simulation;

/// What a vertex of a slave feels, for output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexState {
    /// Position in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Outward normal; zero where nothing is faced.
    pub normal: Vector,
    /// Weighted gap \[m\]; infinite where nothing is faced.
    pub gap: f64,
    /// Contact pressure \[Pa\].
    pub pressure: f64,
    /// Tangential traction \[Pa\].
    pub traction: f64,
    /// Length that belongs to the vertex \[m\].
    pub length: f64,
}

/// A vertex of a boundary or rigid line, for output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryVertex {
    /// Identifier of the body or line.
    pub id: i64,
    /// Number of the vertex in its boundary, from 0.
    pub vertex: i64,
    /// Position in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Displacement since the start \[m\].
    pub displacement: Vector,
    /// Contact pressure \[Pa\]; zero where the vertex is no slave.
    pub pressure: f64,
    /// Smallest weighted gap \[m\]; NaN where the vertex is no slave or faces nothing.
    pub gap: f64,
    /// Contact traction on the vertex, normal and tangential \[Pa\]; zero where it is no slave.
    pub traction: Vector,
    /// Contact force on the vertex, per thickness \[N/m\].
    pub force: Vector,
}

impl Simulation {
    /// The vertices of all boundaries and rigid lines, one after the other, and the segments between them. Contact is as
    /// of the last detection.
    #[must_use]
    pub fn boundaries(&self) -> (Vec<BoundaryVertex>, Vec<[usize; 2]>) {
        let (mut vertices, mut segments) = (vec![], vec![]);
        for (s, surface) in self.mortar.surfaces.iter().enumerate() {
            let first = vertices.len();
            let ends = surface.boundary.segments().iter();
            segments.extend(ends.map(|ends| ends.map(|k| first + k)));
            for (k, x) in surface.boundary.points.iter().enumerate() {
                let seen = self
                    .mortar
                    .pairs
                    .iter()
                    .filter(|pair| pair.slave == s)
                    .filter_map(|pair| pair.forces.vertices.get(k)?.as_ref());
                let (mut pressure, mut gap, mut traction) = (0.0, f64::NAN, Point::zeros());
                for v in seen {
                    pressure += v.pressure;
                    gap = v.gap.min(gap);
                    let tangent = Point::new(-v.normal.y, v.normal.x);
                    traction -= v.pressure * v.normal + v.traction * tangent;
                }
                let flat = |v: Point| [v.x, v.y, 0.0];
                vertices.push(BoundaryVertex {
                    id: surface.id,
                    vertex: k as i64,
                    position: self.in_scene(x),
                    displacement: flat(x - surface.start[k]),
                    pressure,
                    gap,
                    traction: flat(traction),
                    force: flat(surface.force[k]),
                });
            }
        }
        (vertices, segments)
    }

    /// Vertices of the slave of a mortar contact as of the last detection, in order of the polyline.
    #[must_use]
    pub fn mortar_vertices(&self, contact: i64) -> Option<Vec<VertexState>> {
        let pair = self.mortar.pairs.iter().find(|p| p.id == contact)?;
        let points = &self.mortar.surfaces[pair.slave].boundary.points;
        let states = points.iter().enumerate().map(|(k, x)| {
            let seen = pair.forces.vertices.get(k).copied().flatten();
            VertexState {
                position: self.in_scene(x),
                normal: seen.map_or([0.0; 3], |v| [v.normal.x, v.normal.y, 0.0]),
                gap: seen.map_or(f64::INFINITY, |v| v.gap),
                pressure: seen.map_or(0.0, |v| v.pressure),
                traction: seen.map_or(0.0, |v| v.traction),
                length: seen.map_or(0.0, |v| v.length),
            }
        });
        Some(states.collect())
    }

    /// Vertices of the boundary of a body or of a rigid line, in the coordinates of the scene \[m\].
    #[must_use]
    pub fn boundary_vertices(&self, id: i64) -> Option<Vec<Vector>> {
        let surface = self.mortar.surfaces.iter().find(|s| s.id == id)?;
        let points = surface.boundary.points.iter();
        Some(points.map(|x| self.in_scene(x)).collect())
    }

    /// Mortar contact force on the vertices of a body or rigid line in the last step \[N\].
    #[must_use]
    pub fn mortar_force(&self, id: i64) -> Option<Vector> {
        let surface = self.mortar.surfaces.iter().find(|s| s.id == id)?;
        let sum: Point = surface.force.iter().sum();
        Some([sum.x, sum.y, 0.0])
    }

    /// Energy stored in the normal laws of mortar contact as of the last detection \[J\].
    #[must_use]
    pub fn mortar_energy(&self) -> f64 {
        self.mortar.pairs.iter().map(|p| p.forces.energy).sum()
    }

    pub(super) fn in_scene(&self, x: &Point) -> Vector {
        let origin = self.origin();
        [x.x + origin[0], x.y + origin[1], 0.0]
    }
}
