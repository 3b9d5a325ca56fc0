//! Problems in plane strain in other shapes than that of a slab one cell thick: as scenes in the plane, and as thicker slabs.

use proctor_scene::{Dimension, Mesh, PlaneCondition, PointLoad, Scene, Shape};

use super::Guest;

/// Share of a cell within which a load stands on a node.
const NODE: f64 = 1e-6;

impl Guest {
    /// True for a slab one cell thick between rollers, in which nothing moves along z.
    #[must_use]
    pub fn is_in_plane(&self) -> bool {
        let scene = &self.scene;
        let flat = |vector: &[f64; 3]| vector[2] == 0.0;
        scene.mesh.cells[2] == 1
            && scene.mesh.planes[2] == [PlaneCondition::Sliding; 2]
            && scene.base_motion.is_none()
            && flat(&scene.gravity)
            && scene.bodies.iter().all(|body| flat(&body.velocity))
            && scene.point_loads.iter().all(|load| flat(&load.force))
    }

    /// The same problem in two dimensions, with loads over a metre; none where it is not in the plane.
    #[must_use]
    pub fn in_plane(mut self) -> Option<Self> {
        if !self.is_in_plane() {
            return None;
        }
        let scene = &mut self.scene;
        let slab = &scene.mesh;
        let thick = slab.cell[2];
        let low = slab.origin[2];
        let mut mesh = Mesh::new(
            Dimension::Two,
            [slab.origin[0], slab.origin[1], 0.0],
            [slab.cell[0], slab.cell[1], 1.0],
            [slab.cells[0], slab.cells[1], 1],
        );
        mesh.planes[..2].copy_from_slice(&slab.planes[..2]);
        scene.point_loads = per_metre(&scene.point_loads, low, thick);
        scene.mesh = mesh;
        scene.dimension = Dimension::Two;
        for body in &mut scene.bodies {
            // The same extent along z as that of a scene file in two dimensions.
            if let Shape::Cuboid { p1, p2, .. } = &mut body.shape {
                (p1[2], p2[2]) = (0.0, 0.0);
            }
            body.particles_per_cell[2] = 1;
        }
        for traction in &mut self.tractions {
            (traction.p1[2], traction.p2[2]) = (0.0, 0.0);
        }
        Some(self)
    }

    /// The same problem as a slab of `cells` cells; one that is not in the plane stays as it is.
    #[must_use]
    pub fn thick(mut self, cells: usize) -> Self {
        if cells <= 1 || !self.is_in_plane() {
            return self;
        }
        let low = self.scene.mesh.origin[2];
        let thick = self.scene.mesh.cell[2];
        let high = low + cells as f64 * thick;
        self.scene.mesh.cells[2] = cells;
        for body in &mut self.scene.bodies {
            if let Shape::Cuboid { p2, .. } = &mut body.shape {
                p2[2] = high;
            }
        }
        let loads = per_metre(&self.scene.point_loads, low, thick);
        self.scene.point_loads = loads
            .iter()
            .flat_map(|load| {
                (0..=cells).map(move |k| {
                    let share = if k == 0 || k == cells { 0.5 } else { 1.0 };
                    let mut position = load.position;
                    position[2] = low + k as f64 * thick;
                    PointLoad {
                        position,
                        force: load.force.map(|f| f * share * thick),
                    }
                })
            })
            .collect();
        for traction in &mut self.tractions {
            if traction.p2[2] > traction.p1[2] {
                traction.p2[2] = high;
            }
        }
        self
    }

    /// Particles of one body, or of all, over those of the slab one cell thick that the problem was.
    #[must_use]
    pub fn particles_over(&self, slab: &Self) -> f64 {
        let layers = |scene: &Scene| {
            let per_cell = scene
                .bodies
                .first()
                .map_or(1, |body| body.particles_per_cell[2]);
            match scene.dimension {
                Dimension::Three => scene.mesh.cells[2] * per_cell,
                Dimension::Two => 1,
            }
        };
        if slab.is_in_plane() {
            layers(&self.scene) as f64 / layers(&slab.scene) as f64
        } else {
            1.0
        }
    }
}

/// Loads on both faces of a slab of thickness `thick` (m), added along z, as forces on a metre.
fn per_metre(loads: &[PointLoad], low: f64, thick: f64) -> Vec<PointLoad> {
    let mut all: Vec<PointLoad> = vec![];
    for load in loads {
        let [x, y, _] = load.position;
        let near = |other: &&mut PointLoad| {
            let [a, b, _] = other.position;
            (a - x).abs() < NODE * thick && (b - y).abs() < NODE * thick
        };
        let force = load.force.map(|f| f / thick);
        match all.iter_mut().find(near) {
            Some(known) => {
                for axis in 0..3 {
                    known.force[axis] += force[axis];
                }
            }
            None => all.push(PointLoad {
                position: [x, y, low],
                force,
            }),
        }
    }
    for load in &mut all {
        load.position[2] = 0.0;
    }
    all
}
