//! Displacements of the particles against the exact ones at the particles' own initial positions.

use super::model::{LOAD, MIDDLE, PATCH, POISSON, SIDE, YOUNG};
use crate::cases::prelude::*;
use crate::exact::boussinesq_box::BoxSolution;
use crate::exact::boussinesq_half_space;

/// Radius around the middle of the load that the L2 error leaves out \[m\]: a displacement under a nodal load grows
/// like 1/h and has no limit there.
pub const LEFT_OUT: f64 = 0.2;

/// Particles of a run with their exact displacements.
pub struct Comparison {
    samples: Vec<Sample>,
    cell: f64,
}

/// One particle.
struct Sample {
    x: [f64; 3],
    volume: f64,
    computed: [f64; 3],
    exact: [f64; 3],
    stress: [f64; 6],
}

/// True if a place (m) is at a distance of at least `radius` (m) from the middle of the load.
pub fn is_outside(x: &[f64; 3], radius: f64) -> bool {
    let r2 = (x[0] - MIDDLE).powi(2) + (x[1] - MIDDLE).powi(2) + (x[2] - SIDE).powi(2);
    r2 >= radius * radius
}

impl Comparison {
    /// Compares all particles; `None` if the simulation kept no displacements.
    pub fn new(simulation: &Simulation, exact: &BoxSolution) -> Option<Self> {
        let starts = (0..simulation.particles()).map(|p| simulation.initial_position(0, p));
        let x: Vec<[f64; 3]> = starts.collect::<Option<_>>()?;
        let exact = exact.displacement_many(&x).into_iter().enumerate();
        let sample = |(p, exact): (usize, [f64; 3])| {
            Some(Sample {
                x: x[p],
                volume: simulation.particle_volume(0, p),
                computed: simulation.displacement(0, p)?,
                exact,
                stress: simulation.sets()[0].stress(p),
            })
        };
        Some(Self {
            samples: exact.map(sample).collect::<Option<_>>()?,
            cell: simulation.scene().mesh.cell[0],
        })
    }

    /// Particles at a distance of at least `radius` (m) from the middle of the load.
    fn outside(&self, radius: f64) -> impl Iterator<Item = &Sample> {
        (self.samples.iter()).filter(move |s| is_outside(&s.x, radius))
    }

    /// Relative L2 error of the displacement, volume-weighted, at a distance of at least `radius` (m) from the
    /// middle of the load.
    pub fn l2_outside(&self, radius: f64) -> Option<f64> {
        relative_l2(
            self.outside(radius)
                .map(|s| (s.volume, s.computed, s.exact)),
        )
    }

    /// Relative L2 error of the stress (xx, yy, zz, yz, xz, xy), volume-weighted, at a distance of at least `radius`
    /// (m) from the middle of the load; `None` if a particle lies where the exact stress is not known.
    pub fn stress_l2_outside(&self, radius: f64, exact: &BoxSolution) -> Option<f64> {
        let points: Vec<[f64; 3]> = self.outside(radius).map(|s| s.x).collect();
        let exact = exact.stress_many(&points).into_iter();
        let samples = exact.zip(self.outside(radius)).map(|(exact, s)| {
            let [xx, yy, zz, xy, yz, xz] = exact?;
            Some((s.volume, s.stress, [xx, yy, zz, yz, xz, xy]))
        });
        relative_l2(samples.collect::<Option<Vec<_>>>()?)
    }

    /// Mean `u_z` (m) of the particles within a cell of `point` in every direction, computed and exact.
    ///
    /// Both are means over the same positions, so nothing is interpolated. With the mirror images of the particles
    /// that a plane of symmetry hides they surround the point.
    pub fn settlement_around(&self, point: [f64; 3]) -> (f64, f64) {
        let near = |s: &Sample| (0..3).all(|i| (s.x[i] - point[i]).abs() < 0.5 * self.cell);
        self.mean_settlement(near)
    }

    /// The same over the particles of the uppermost layer of cells under the loaded square.
    pub fn settlement_under_patch(&self) -> (f64, f64) {
        let loaded = |s: &Sample| {
            s.x[2] > SIDE - self.cell && (0..2).all(|i| (s.x[i] - MIDDLE).abs() < 0.5 * PATCH)
        };
        self.mean_settlement(loaded)
    }

    fn mean_settlement(&self, of: impl Fn(&Sample) -> bool) -> (f64, f64) {
        let (mut count, mut computed, mut exact) = (0.0, 0.0, 0.0);
        for sample in self.samples.iter().filter(|sample| of(sample)) {
            count += 1.0;
            computed += sample.computed[2];
            exact += sample.exact[2];
        }
        (computed / count, exact / count)
    }

    /// `u_z` along the particles nearest to the axis, from the base up.
    pub fn curve(&self, title: String) -> Curve {
        let near = |s: &&Sample| (0..2).all(|i| s.x[i] - MIDDLE < 0.5 * self.cell);
        let mut axis: Vec<&Sample> = self.samples.iter().filter(near).collect();
        axis.sort_by(|a, b| a.x[2].total_cmp(&b.x[2]));
        let points = axis.iter();
        let points = points.map(|s| CurvePoint::new(s.x[2], s.computed[2], s.exact[2]));
        Curve::new(title, ["z (m)", "u_z (m)"], points)
    }
}

/// The manual's comparison with the half-space on the axis below a point load, a line for each depth.
pub fn half_space_lines(exact: &BoxSolution) -> Vec<String> {
    let mut lines = vec![
        "The manual compares with the half-space, which is not this box (point load, on the axis):"
            .to_owned(),
    ];
    for z in [0.95, 0.9, 0.8, 0.7, 0.5, 0.25, 0.1] {
        let in_box = exact.displacement([MIDDLE, MIDDLE, z])[2];
        let half_space =
            boussinesq_half_space::vertical_displacement(YOUNG, POISSON, LOAD, 0.0, SIDE - z);
        let off = 100.0 * (half_space / in_box - 1.0);
        lines.push(format!(
            "z = {z} m: u_z {in_box:.4e} m in the box, {half_space:.4e} m in the half-space, {off:+.1} % off"
        ));
    }
    lines
}
