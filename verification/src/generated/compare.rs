//! Two runs of one scene in other words, compared particle by particle.

use proctor_scene::{Scene, Vector};

use super::change::Frame;
use super::seen::{FinalState, Particle, largest};
use super::units::Units;
use super::{Deviation, Judge};

/// Units of velocity and stress of a scene, for differences.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Shortest edge of a cell \[m\].
    length: f64,
    /// Largest velocity \[m/s\].
    velocity: f64,
    /// Stress of a wave of that velocity, or the largest of the start \[Pa\].
    stress: f64,
}

impl Scale {
    /// Scale of a run.
    pub fn of(scene: &Scene, seen: &FinalState) -> Self {
        let axes = scene.dimension.axes();
        let cells = scene.mesh.cell[..axes].iter();
        let impedance = scene.materials.iter().fold(0.0_f64, |most, m| {
            most.max(m.density * m.law.wave_speed(m.density))
        });
        let start = largest(seen.particles.iter().flat_map(|p| p.start_stress));
        let velocity = seen.fastest().max(start / impedance);
        Self {
            length: cells.fold(f64::INFINITY, |a, b| a.min(*b)),
            velocity,
            stress: impedance * velocity,
        }
    }
}

/// Judges whether the second run is the first in another frame and in other units, within that share of a cell, of the
/// velocities and of the stresses.
pub fn same(scene: &Scene, frame: Frame, units: Units, bound: f64) -> Judge {
    let scene = scene.clone();
    let axes = scene.dimension.axes();
    Box::new(move |seen| {
        let [one, two] = seen else { return vec![] };
        let scale = Scale::of(&scene, one);
        let mut most = [0.0_f64; 3];
        for (a, b) in pairs(one, two, &frame, &units, axes, scale.length) {
            let Some(b) = b else {
                return vec![lost()];
            };
            // Positions in other units: the third coordinate of the plane has none.
            let moved = |x: &Vector| units.point(x, axes);
            most[0] =
                most[0].max(apart(&moved(&frame.point(&a.position)), &b.position) / units.length);
            let speed = units.velocity();
            let expected = frame.direction(&a.velocity).map(|v| v * speed);
            most[1] = most[1].max(apart(&expected, &b.velocity) / speed);
            let expected = frame.stress(&a.stress).map(|s| s * units.stress());
            most[2] = most[2].max(apart(&expected, &b.stress) / units.stress());
        }
        let over = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
        vec![
            Deviation::new("positions over a cell", over(most[0], scale.length), bound),
            Deviation::new(
                "velocities over the largest",
                over(most[1], scale.velocity),
                bound,
            ),
            Deviation::new(
                "stresses over those of a wave",
                over(most[2], scale.stress),
                bound,
            ),
        ]
    })
}

/// Judges whether two runs end in the same bits, particle by particle, body by body.
pub fn equal() -> Judge {
    Box::new(|seen| {
        let [one, two] = seen else { return vec![] };
        if one.particles.len() != two.particles.len() {
            return vec![lost()];
        }
        let differs = |(a, b): &(&Particle, &Particle)| {
            (a.position, a.velocity, a.stress) != (b.position, b.velocity, b.stress)
        };
        let pairs = one.particles.iter().zip(&two.particles);
        let count = pairs.filter(differs).count();
        vec![Deviation::new(
            "particles with other bits",
            count as f64,
            0.0,
        )]
    })
}

fn lost() -> Deviation {
    Deviation::new("a particle has no counterpart", f64::NAN, 0.0)
}

/// The particles of the first run, each with that of the second that began at the same place.
fn pairs<'a>(
    one: &'a FinalState,
    two: &'a FinalState,
    frame: &Frame,
    units: &Units,
    axes: usize,
    cell: f64,
) -> Vec<(&'a Particle, Option<&'a Particle>)> {
    let near = 1e-6 * cell * units.length;
    let mut left: Vec<&Particle> = two.particles.iter().collect();
    let pair = |a: &'a Particle| {
        let place = units.point(&frame.point(&a.start), axes);
        let at = left.iter().position(|b| apart(&place, &b.start) < near);
        (a, at.map(|at| left.swap_remove(at)))
    };
    one.particles.iter().map(pair).collect()
}

/// Largest component of a difference.
pub(crate) fn apart<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    largest((0..N).map(|k| a[k] - b[k]))
}
