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

impl Simulation {
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
