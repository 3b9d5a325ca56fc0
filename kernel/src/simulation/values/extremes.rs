//! Largest deformations of a run.

/// Largest ratio of principal stretches that particle domains bear which do not follow it. A hanging elastic bar is off by
/// 0.2 % of its elongation where it is 1.22, by 2.6 % where it is 1.48, with quadratic B-splines by 1.5 and 12 %, and not by
/// less on smaller cells.
pub const MOST_STRETCH_RATIO: f64 = 1.25;

/// Largest deformations so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extremes {
    /// J of the particle of a law without an energy at large strain with the largest |J - 1|, less 1; zero where no body has that law.
    pub volume_change: f64,
    /// Largest ratio of principal stretches of a stretched particle, where particle domains do not follow them; zero where no
    /// particle is looked at.
    pub stretch_ratio: f64,
    /// Largest share of the mass of a body with such a ratio above [`MOST_STRETCH_RATIO`].
    pub stretched_share: f64,
}
