//! Least work of a particle in a step, to compare with what the machine can do.

use proctor_scene::plan::Plan;
use proctor_scene::{StressScheme, Weighting};

/// Floating-point operations of a particle in a step, 3D, 27 nodes, one mapping and one interpolation, linear
/// elastic: a count whose floor is 27 ns on a core with 75 GFLOP/s of multiply-adds (AVX-512: 2025 operations) and
/// 47 ns on one with 42 GFLOP/s (AVX2: 1974 operations).
const OPERATIONS: f64 = 2000.0;

/// Bytes that two passes over such particles, of 14 numbers each, move at least: the same count has a floor of 19 to
/// 23 ns at 11.9 GB/s, which is 226 to 274 bytes.
const BYTES: f64 = 250.0;

/// Least work of a particle in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Least {
    /// Floating-point operations.
    pub operations: f64,
    /// Bytes moved.
    pub bytes: f64,
}

impl Least {
    /// Counts for the plan of a scene; `None` where nothing was counted: two dimensions, a second mapping, an affine velocity,
    /// functions of two nodes, domains that follow the deformation.
    #[must_use]
    pub fn of(plan: &Plan, weighting: Weighting) -> Option<Self> {
        let counted = plan.axes == 3
            && plan.scheme == StressScheme::Usl
            && !plan.full_mapping
            && matches!(
                weighting,
                Weighting::UniformGimp | Weighting::QuadraticBSpline
            );
        counted.then_some(Self {
            operations: OPERATIONS,
            bytes: BYTES,
        })
    }
}
