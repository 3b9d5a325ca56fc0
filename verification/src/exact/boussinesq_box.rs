//! The box on rollers under a vertical load: the exact reference of the manual's Boussinesq problem.
//!
//! A linear elastic box `[0,a] x [0,b] x [0,H]` slides without friction on its base and its four sides
//! (zero normal displacement, zero shear) and carries a downward load on its top: a point load, or the same
//! force spread evenly over an aligned square patch. The side rollers mirror the load, so the solution is a
//! double cosine series (verification notes, section 2; Fourier solution of the elastic layer).
//!
//! Two summations, chosen by the depth `H - z` of each point:
//! * below the surface the series itself, cut where `exp(-k (H - z))` is below round-off;
//! * near the surface, where the series hardly decays, an Ewald split: image loads near by in closed form, the
//!   rest by a filtered series of about twenty modes per axis.

mod image;
mod mode;
mod mode_sum;
mod near_surface;

use mode::Medium;
use mode_sum::{Amplitudes, Parity};
use thiserror::Error;

/// Body and load: the input of [`BoxSolution`].
#[derive(Debug, Clone, PartialEq)]
pub struct BoxProblem {
    /// Extent along x, m.
    pub a: f64,
    /// Extent along y, m.
    pub b: f64,
    /// Extent along z, from the base to the loaded top, m.
    pub height: f64,
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio, in (-1, 1/2).
    pub poisson: f64,
    /// Total downward force, N.
    pub load: f64,
    /// Place of the load (the centre of the patch), m.
    pub position: [f64; 2],
    /// Side of the square patch that carries the load, m; `None` for a point load.
    pub patch: Option<f64>,
}

/// Reason for which a [`BoxProblem`] has no solution here.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{field} is {value}, accepted is {accepted}")]
pub struct InvalidBox {
    /// The field at fault.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// Values that are accepted.
    pub accepted: &'static str,
}

/// Stress at a point, Pa, tension positive: `[xx, yy, zz, xy, yz, zx]`.
pub type Stress = [f64; 6];

/// The series stops where `k (H - z)` passes this: `40 exp(-40)` is 2e-16 of the largest term.
const DECAY: f64 = 40.0;

/// Depth, relative to the shorter side of the top, above which a point load is summed by the Ewald split.
const SPLIT_DEPTH_POINT: f64 = 0.02;

/// The same for a patch. Smaller, because a patch needs a quadrature per image and its series decays faster.
const SPLIT_DEPTH_PATCH: f64 = 0.004;

/// Depth, relative to the shorter side, above which the series is not summed (6400 modes per axis there).
const LEAST_SERIES_DEPTH: f64 = 0.002;

/// Length of the Ewald split relative to the shorter side: balances images (within 12 lengths) and modes.
const SPLIT_LENGTH: f64 = 0.1;

/// The exact displacement and stress of a [`BoxProblem`].
#[derive(Debug, Clone)]
pub struct BoxSolution {
    problem: BoxProblem,
    medium: Medium,
}

impl BoxSolution {
    /// Checks the problem and prepares its constants.
    ///
    /// # Errors
    /// [`InvalidBox`] names the first field that is not finite, not positive where it must be, or (load and
    /// patch) not inside the top face.
    pub fn new(problem: BoxProblem) -> Result<Self, InvalidBox> {
        let refuse = |field, value, accepted| {
            Err(InvalidBox {
                field,
                value,
                accepted,
            })
        };
        let positive = [
            ("a", problem.a),
            ("b", problem.b),
            ("height", problem.height),
            ("young", problem.young),
            ("patch", problem.patch.unwrap_or(1.0)),
        ];
        for (field, value) in positive {
            if !(value.is_finite() && value > 0.0) {
                return refuse(field, value, "a positive number");
            }
        }
        if !(problem.poisson > -1.0 && problem.poisson < 0.5) {
            return refuse(
                "poisson",
                problem.poisson,
                "between -1 and 0.5, both excluded",
            );
        }
        if !problem.load.is_finite() {
            return refuse("load", problem.load, "a finite number");
        }
        let half = 0.5 * problem.patch.unwrap_or(0.0);
        for (field, centre, side) in [
            ("position x", problem.position[0], problem.a),
            ("position y", problem.position[1], problem.b),
        ] {
            // A patch flush with an edge may miss it by round-off.
            let slack = 1e-12 * side;
            if !(centre - half >= -slack && centre + half <= side + slack) {
                return refuse(
                    field,
                    centre,
                    "a position that keeps the load on the top face",
                );
            }
        }
        let medium = Medium::new(problem.young, problem.poisson, problem.height);
        Ok(Self { problem, medium })
    }

    /// The problem solved.
    #[must_use]
    pub fn problem(&self) -> &BoxProblem {
        &self.problem
    }

    /// Displacement `[u_x, u_y, u_z]` in m at `[x, y, z]` in m, `z` from the base. See [`Self::displacement_many`].
    #[must_use]
    pub fn displacement(&self, point: [f64; 3]) -> [f64; 3] {
        self.displacement_many(&[point])[0]
    }

    /// Displacements in m at many points, in their order.
    ///
    /// Points that share coordinates share work: the cost is about the number of modes at each distinct `z`
    /// times the number of distinct `y` there, so a lattice of 1e5 particles takes seconds.
    /// Under a point load itself `u_z` is infinite. Outside `0 <= z <= H` the result is NaN.
    #[must_use]
    pub fn displacement_many(&self, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.by_depth(points, |solution, z, layer| {
            if solution.problem.height - z < solution.split_depth() {
                solution.layer_by_split(z, layer, SPLIT_LENGTH * solution.shorter_side())
            } else {
                solution.layer_by_series(z, layer)
            }
        })
    }

    /// Displacements in m by the Ewald split with a chosen split length, m, whatever the depth.
    ///
    /// The result does not depend on the length; this is how that is checked. Depth and length should be
    /// of one size: the parts cancel when the depth is many lengths. NaN unless the length lies between 0.01 and 1
    /// of the shorter side.
    #[must_use]
    pub fn displacement_by_split(&self, points: &[[f64; 3]], split_length: f64) -> Vec<[f64; 3]> {
        let accepted = (0.01..=1.0).contains(&(split_length / self.shorter_side()));
        self.by_depth(points, |solution, z, layer| {
            if accepted {
                solution.layer_by_split(z, layer, split_length)
            } else {
                vec![[f64::NAN; 3]; layer.len()]
            }
        })
    }

    /// Displacements in m by the cosine series alone; NaN nearer to the surface than 0.002 of the shorter side,
    /// where the series hardly decays.
    #[must_use]
    pub fn displacement_by_series(&self, points: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.by_depth(points, |solution, z, layer| {
            if solution.problem.height - z >= LEAST_SERIES_DEPTH * solution.shorter_side() {
                solution.layer_by_series(z, layer)
            } else {
                vec![[f64::NAN; 3]; layer.len()]
            }
        })
    }

    /// Normal stress on horizontal planes, Pa; `None` where [`Self::stress_many`] gives none.
    #[must_use]
    pub fn stress_zz(&self, point: [f64; 3]) -> Option<f64> {
        self.stress_many(&[point])[0].map(|stress| stress[2])
    }

    /// Stress in Pa at many points, in their order; `None` nearer to the loaded surface than 0.002 of the
    /// shorter side (the series hardly decays there) and outside `0 <= z <= H`.
    ///
    /// Hooke's law on the displacement series, mode by mode; the shear on horizontal planes follows from
    /// vertical equilibrium.
    #[must_use]
    pub fn stress_many(&self, points: &[[f64; 3]]) -> Vec<Option<Stress>> {
        use Parity::{Cos, Sin};
        let parities = [
            (Cos, Cos),
            (Cos, Cos),
            (Cos, Cos),
            (Sin, Sin),
            (Cos, Sin),
            (Sin, Cos),
        ];
        let least_depth = LEAST_SERIES_DEPTH * self.shorter_side();
        let stresses = self.by_depth(points, |solution, z, layer| {
            let depth = solution.problem.height - z;
            if depth < least_depth {
                return vec![[f64::NAN; 6]; layer.len()];
            }
            let medium = &solution.medium;
            mode_sum::sum(
                &solution.amplitudes(DECAY / depth),
                layer,
                parities,
                |k, c| medium.stress_coefficients(&medium.mode(k, z), k, c),
            )
        });
        stresses
            .into_iter()
            .map(|s| if s[2].is_nan() { None } else { Some(s) })
            .collect()
    }

    /// Groups the points by `z`, evaluates each layer, and puts the results back in order.
    fn by_depth<const N: usize>(
        &self,
        points: &[[f64; 3]],
        evaluate: impl Fn(&Self, f64, &[[f64; 2]]) -> Vec<[f64; N]>,
    ) -> Vec<[f64; N]> {
        let mut results = vec![[f64::NAN; N]; points.len()];
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|&i, &j| points[i][2].total_cmp(&points[j][2]));
        for group in order.chunk_by(|&i, &j| points[i][2] == points[j][2]) {
            let z = points[group[0]][2];
            if !(0.0..=self.problem.height).contains(&z) {
                continue;
            }
            let layer: Vec<[f64; 2]> = group
                .iter()
                .map(|&i| [points[i][0], points[i][1]])
                .collect();
            for (&i, value) in group.iter().zip(evaluate(self, z, &layer)) {
                results[i] = value;
            }
        }
        results
    }

    /// One layer by the cosine series.
    fn layer_by_series(&self, z: f64, layer: &[[f64; 2]]) -> Vec<[f64; 3]> {
        let medium = &self.medium;
        let amplitudes = self.amplitudes(DECAY / (self.problem.height - z));
        mode_sum::sum(&amplitudes, layer, mode_sum::DISPLACEMENT, |k, c| {
            medium.mode(k, z).displacement_coefficients(c)
        })
    }

    /// One layer by the Ewald split: the filtered series plus the images near by.
    fn layer_by_split(&self, z: f64, layer: &[[f64; 2]], split_length: f64) -> Vec<[f64; 3]> {
        let split = near_surface::Split::new(&self.medium, z, split_length);
        let amplitudes = self.amplitudes(split.largest_wave_number());
        let mut displacements =
            mode_sum::sum(&amplitudes, layer, mode_sum::DISPLACEMENT, |k, c| {
                split.mode(k).displacement_coefficients(c)
            });
        let images = image::Images::new(&self.problem, &self.medium, z, split_length);
        for (displacement, &point) in displacements.iter_mut().zip(layer) {
            let near = images.displacement(point);
            for axis in 0..3 {
                displacement[axis] += near[axis];
            }
        }
        displacements
    }

    /// Amplitudes of the load's modes with wave numbers up to `k_max`, 1/m.
    fn amplitudes(&self, k_max: f64) -> Amplitudes {
        let problem = &self.problem;
        let [x0, y0] = problem.position;
        let width = problem.patch.unwrap_or(0.0);
        Amplitudes::new(problem.load, [problem.a, problem.b], [x0, y0], width, k_max)
    }

    fn shorter_side(&self) -> f64 {
        self.problem.a.min(self.problem.b)
    }

    fn split_depth(&self) -> f64 {
        let relative = if self.problem.patch.is_some() {
            SPLIT_DEPTH_PATCH
        } else {
            SPLIT_DEPTH_POINT
        };
        relative * self.shorter_side()
    }
}
