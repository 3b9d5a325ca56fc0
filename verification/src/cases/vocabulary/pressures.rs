//! Contact pressure at the vertices of a body that rests on its boundary, averaged over the end of a run.

use proctor_scene::Vector;
use proctor_scene::simulation::Simulation;

use super::stepping::step;
use crate::case::{Curve, CurvePoint, Rung};
use crate::study::{Failure, Observer, Phase};

const REPORT_EVERY: u64 = 20; // Steps between two calls of the progress function

/// Averages over time of what acts on the first boundary.
pub struct Pressures {
    /// Force on the body \[N; in the plane N/m\].
    pub force: Vector,
    /// Place, pressure and length or area of each vertex.
    pub vertices: Vec<[f64; 3]>,
}

impl Pressures {
    /// Runs to the end of the scene and averages from a time on \[s\], with the vertices whose place, which `place` finds
    /// from their position, is less than `within` from zero \[m\].
    ///
    /// # Errors
    /// As [`step`].
    pub fn averaged(
        simulation: &mut Simulation,
        from: f64,
        within: f64,
        place: impl Fn(&Vector) -> f64,
        observer: &mut dyn Observer,
    ) -> Result<Self, Failure> {
        let end = simulation.scene().time;
        observer.phase(Phase::Stepping);
        let (mut force, mut weight) = ([0.0; 3], 0.0);
        let mut sums: Vec<[f64; 3]> = vec![];
        while simulation.time() < end {
            let info = step(simulation, end, observer)?;
            if info.step % REPORT_EVERY == 0 {
                observer.progress((simulation.time() / end).min(1.0));
            }
            if simulation.time() <= from {
                continue;
            }
            weight += info.dt;
            let now = simulation.mortar_force(1).unwrap_or_default();
            for axis in 0..3 {
                force[axis] += info.dt * now[axis];
            }
            let vertices = simulation.mortar_vertices(1).unwrap_or_default();
            sums.resize(vertices.len(), [0.0; 3]);
            for (sum, v) in sums.iter_mut().zip(&vertices) {
                sum[0] += info.dt * place(&v.position);
                sum[1] += info.dt * v.pressure;
                sum[2] += info.dt * v.measure;
            }
        }
        observer.phase(Phase::Comparing);
        Ok(Self {
            force: force.map(|f| f / weight),
            vertices: sums
                .into_iter()
                .map(|sum| sum.map(|s| s / weight))
                .filter(|[at, _, measure]| at.abs() < within && *measure > 0.0)
                .collect(),
        })
    }

    /// Sum of the forces of the vertices times a power of their places.
    pub fn moment(&self, power: i32) -> f64 {
        let each = self.vertices.iter();
        each.map(|[at, p, w]| w * p * at.powi(power)).sum()
    }

    /// L2 norm of the difference to a pressure, over that of the pressure.
    pub fn distance(&self, exact: impl Fn(f64) -> f64) -> f64 {
        let (mut off, mut all) = (0.0, 0.0);
        for [at, p, w] in &self.vertices {
            off += w * (p - exact(*at)).powi(2);
            all += w * exact(*at).powi(2);
        }
        (off / all).sqrt()
    }

    /// The pressures at the places within a length of zero \[m\], in their order, beside the exact ones.
    pub fn curve(
        &self,
        rung: &Rung,
        abscissa: &'static str,
        within: f64,
        exact: impl Fn(f64) -> f64,
    ) -> Curve {
        let near = self.vertices.iter().filter(|[at, ..]| at.abs() < within);
        let points = near.map(|&[at, p, _]| CurvePoint::new(at, p, exact(at)));
        let title = format!("{}: contact pressure", rung.label);
        Curve::new(title, [abscissa, "p in Pa"], points)
    }
}
