//! The same scene in another frame: lengths along axes that are exchanged, turned round, scaled and shifted.

use proctor_scene::{InitialStress, Mesh, Scene, Shape, Vector};

/// A frame: axis `a` of a scene is axis `to[a]` of the other, in the direction `sign[a]`; coordinates are then shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// New index of each axis.
    pub to: [usize; 3],
    /// Its direction: 1 where it is kept, -1 where it turns round.
    pub sign: [f64; 3],
    /// Added to coordinates, along the new axes \[m\].
    pub shift: Vector,
}

impl Frame {
    /// The frame that changes nothing.
    pub const SAME: Self = Self {
        to: [0, 1, 2],
        sign: [1.0; 3],
        shift: [0.0; 3],
    };

    /// A direction, or a velocity, in the other frame.
    #[must_use]
    pub fn direction(&self, v: &Vector) -> Vector {
        let mut new = [0.0; 3];
        for axis in 0..3 {
            // Zero keeps its sign, so that a scene written of it is as plain as the first.
            if v[axis] != 0.0 {
                new[self.to[axis]] = self.sign[axis] * v[axis];
            }
        }
        new
    }

    /// A position in the other frame.
    #[must_use]
    pub fn point(&self, x: &Vector) -> Vector {
        let new = self.direction(x);
        std::array::from_fn(|axis| new[axis] + self.shift[axis])
    }

    /// Lower and upper corner of a box in the other frame.
    fn corners(&self, p1: &mut Vector, p2: &mut Vector) {
        let (a, b) = (self.point(p1), self.point(p2));
        *p1 = std::array::from_fn(|axis| a[axis].min(b[axis]));
        *p2 = std::array::from_fn(|axis| a[axis].max(b[axis]));
    }

    /// A stress xx, yy, zz, yz, xz, xy in the other frame.
    #[must_use]
    pub fn stress(&self, s: &[f64; 6]) -> [f64; 6] {
        let mut new = [0.0; 6];
        for (index, (a, b)) in ENTRIES.into_iter().enumerate() {
            let (i, j) = (self.to[a], self.to[b]);
            let place = ENTRIES.iter().position(|e| *e == (i, j) || *e == (j, i));
            if let Some(place) = place {
                new[place] = self.sign[a] * self.sign[b] * s[index];
            }
        }
        new
    }

    /// The scene in the other frame: bodies, gravity, planes and loads of boxes; scenes here have no other loads.
    #[must_use]
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut new = scene.clone();
        new.mesh = self.mesh(&scene.mesh, scene.dimension.axes());
        new.gravity = self.direction(&scene.gravity);
        for body in &mut new.bodies {
            if let Shape::Cuboid { p1, p2 } = &mut body.shape {
                self.corners(p1, p2);
            }
            body.velocity = self.direction(&body.velocity);
            if let Some(motion) = &mut body.motion {
                for value in &mut motion.values {
                    *value = self.direction(value);
                }
            }
            let mut particles = [1; 3];
            for axis in 0..3 {
                particles[self.to[axis]] = body.particles_per_cell[axis];
            }
            body.particles_per_cell = particles;
            if let InitialStress::AtRest { level, .. } = &mut body.initial_stress {
                let axis = (0..3).find(|axis| scene.gravity[*axis] != 0.0);
                let axis = axis.unwrap_or(0);
                *level = self.sign[axis] * *level + self.shift[self.to[axis]];
            }
        }
        for load in &mut new.box_loads {
            self.corners(&mut load.p1, &mut load.p2);
            load.force = self.direction(&load.force);
        }
        new
    }

    fn mesh(&self, mesh: &Mesh, axes: usize) -> Mesh {
        let mut new = mesh.clone();
        let (mut low, mut high) = (mesh.origin, mesh.upper());
        self.corners(&mut low, &mut high);
        for axis in 0..axes {
            let to = self.to[axis];
            new.cell[to] = mesh.cell[axis];
            new.cells[to] = mesh.cells[axis];
            new.planes[to] = mesh.planes[axis];
            if self.sign[axis] < 0.0 {
                new.planes[to].reverse();
            }
            new.origin[to] = low[to];
        }
        new
    }
}

/// Row and column of the entries of a stress.
const ENTRIES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
