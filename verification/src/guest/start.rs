//! Problems that begin with a velocity that differs from place to place.
//!
//! A scene file has one velocity for a body. So a body becomes as many bodies as it has rows, columns or particles, each of half a
//! cell: without contact bodies share one velocity field, and the problem is the same.

use proctor_scene::{Body, Dimension, Scene, Shape, Vector};

use super::{Guest, prepared, settings, slab};
use crate::case::Rung;
use crate::settings::Settings;

/// Particles per cell and axis of these problems.
const PER_CELL: usize = 2;

/// A scene of one box as a problem with a start: the velocity (m/s) of the particle at a place (m), which differs along the first
/// `axes` axes, and the exact displacement (m), compared at the end. Steps are of [`super::COURANT`] for waves of `speed` (m/s).
pub(crate) fn moving(
    rung: &Rung,
    scene: fn(&Rung, &Settings) -> Scene,
    axes: usize,
    speed: f64,
    velocity: impl Fn(&Vector) -> Vector,
    exact: impl Fn(&Vector, f64) -> Vector + Send + Sync + 'static,
) -> Guest {
    let mut scene = scene(rung, &settings());
    if scene.dimension == Dimension::Two {
        scene = slab(scene);
    }
    let bodies = std::mem::take(&mut scene.bodies);
    for body in bodies {
        let pieces = pieces(&body, rung.cell, axes, &velocity);
        scene.bodies.extend(pieces);
    }
    for (i, body) in scene.bodies.iter_mut().enumerate() {
        body.id = i as i64 + 1;
        body.name = format!("piece {}", i + 1);
    }
    let step = super::COURANT * rung.cell / speed;
    Guest::new(prepared(scene, 1, step), exact).at_the_end()
}

/// A box in pieces of one particle along the first axes.
fn pieces(body: &Body, cell: f64, axes: usize, velocity: impl Fn(&Vector) -> Vector) -> Vec<Body> {
    let Shape::Cuboid { p1, p2, .. } = &body.shape else {
        return vec![body.clone()];
    };
    let edge = cell / PER_CELL as f64;
    let counts: [usize; 3] = std::array::from_fn(|axis| {
        if axis < axes {
            ((p2[axis] - p1[axis]) / edge).round() as usize
        } else {
            1
        }
    });
    let mut all = vec![];
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            for k in 0..counts[2] {
                let place = [i, j, k];
                let corner = |axis: usize, more: usize| {
                    if axis < axes {
                        p1[axis] + (place[axis] + more) as f64 * edge
                    } else {
                        [p1, p2][more][axis]
                    }
                };
                let (low, high): (Vector, Vector) = (
                    std::array::from_fn(|axis| corner(axis, 0)),
                    std::array::from_fn(|axis| corner(axis, 1)),
                );
                let middle = std::array::from_fn(|axis| 0.5 * (low[axis] + high[axis]));
                let mut piece = body.clone();
                piece.shape = crate::cases::cuboid(low, high);
                piece.velocity = velocity(&middle);
                all.push(piece);
            }
        }
    }
    all
}

/// A body between rollers that swings along each of `axes` axes in its first mode, half a wave in `length` (m), with an amplitude
/// (m) so small that linear theory holds: no force is needed, since what one axis does shears nothing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swing {
    pub axes: usize,
    pub length: f64,
    pub amplitude: f64,
    /// Speed of waves of compression \[m/s\].
    pub speed: f64,
    /// Constants of Lamé, lambda and mu \[Pa\].
    pub lame: [f64; 2],
}

impl Swing {
    /// Displacement along each axis over `factor`, of the particle that began at a place (m).
    fn along(self, x: &Vector, factor: f64) -> Vector {
        let number = std::f64::consts::PI / self.length;
        std::array::from_fn(|axis| {
            if axis < self.axes {
                self.amplitude * factor * libm::sin(number * x[axis])
            } else {
                0.0
            }
        })
    }

    /// Stress \[Pa: xx, yy, zz, yz, xz, xy\] where the displacement is along each axis times `factor`: each axis is
    /// strained for itself.
    fn stress(self, x: &Vector, factor: f64) -> [f64; 6] {
        let number = std::f64::consts::PI / self.length;
        let strain: Vector = std::array::from_fn(|axis| {
            if axis < self.axes {
                self.amplitude * factor * number * libm::cos(number * x[axis])
            } else {
                0.0
            }
        });
        let [lambda, shear] = self.lame;
        let pressure = lambda * strain.iter().sum::<f64>();
        let [x, y, z] = strain.map(|e| pressure + 2.0 * shear * e);
        [x, y, z, 0.0, 0.0, 0.0]
    }

    /// Angular frequency \[rad/s\].
    fn frequency(self) -> f64 {
        std::f64::consts::PI / self.length * self.speed
    }

    /// The problem of a rung, in the scene of its case.
    pub(crate) fn guest(self, rung: &Rung, scene: fn(&Rung, &Settings) -> Scene) -> Guest {
        moving(
            rung,
            scene,
            self.axes,
            self.speed,
            move |x| self.along(x, self.frequency()),
            move |x, t| self.along(x, libm::sin(self.frequency() * t)),
        )
        .with_stress(move |x, t| self.stress(x, libm::sin(self.frequency() * t)))
    }
}
