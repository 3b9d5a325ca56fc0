//! Balls and shells around a point of the axis of an axisymmetric scene.

use std::sync::Arc;

use proctor_scene::{ParticleSeed, Shape, Vector};

/// A radial vector at a place, whose middle is the origin: its radial component over the distance is `over`.
pub fn radial(x: Vector, over: f64) -> Vector {
    [over * x[0], over * x[1], 0.0]
}

/// Distance of a place from the origin \[m\].
pub fn distance(x: Vector) -> f64 {
    libm::hypot(x[0], x[1])
}

/// A tensor with one component along the line to the origin and another across, at a place: xx, yy, zz, yz, xz, xy.
pub fn around(x: Vector, [along, across]: [f64; 2]) -> [f64; 6] {
    let far = distance(x);
    let [a, b] = [x[0] / far, x[1] / far];
    let more = along - across;
    [
        across + more * a * a,
        across + more * b * b,
        across,
        0.0,
        0.0,
        more * a * b,
    ]
}

/// The velocity gradient of a radial motion: of its slope and of its velocity over the distance, at a place.
pub fn gradient(x: Vector, slope: f64, over: f64) -> [[f64; 3]; 3] {
    let [xx, yy, zz, _, _, xy] = around(x, [slope, over]);
    [[xx, xy, 0.0], [xy, yy, 0.0], [0.0, 0.0, zz]]
}

/// Rings of a lattice of cells of a size \[m\] whose middle is between two distances from the origin \[m\], in the quarter of
/// positive radius and height.
pub fn shell(h: f64, per_cell: usize, [inner, outer]: [f64; 2]) -> Shape {
    let step = h / per_cell as f64;
    let count = (outer / step).ceil() as usize;
    let at = |k: usize| (k as f64 + 0.5) * step;
    let mut seeds = vec![];
    for i in 0..count {
        for j in 0..count {
            let position = [at(i), at(j), 0.0];
            if (inner..outer).contains(&distance(position)) {
                seeds.push(ParticleSeed {
                    position,
                    volume: std::f64::consts::TAU * at(i) * step * step,
                });
            }
        }
    }
    Shape::Particles(Arc::new(seeds))
}
