//! A yield stress along straight lines between marks of plastic strain, as tests of the laboratory give it.

use super::{Curve, InvalidConstant};
use proctor_kernel::lanes::Lanes;

/// Most marks of a curve: each costs a comparison in every return.
pub const MOST: usize = 16;

/// The curve of a yield stress.
pub(super) const CURVE: Curve = Curve {
    key: "hardening.curve",
    meaning: "Rows of plastic strain and yield stress, between which it is linear: from `yield_stress` at zero through all \
              of them, and on with `hardening` beyond the last",
    units: ["", "Pa"],
    example: &[[0.01, 1.2e6], [0.05, 1.5e6]],
};

/// A piece of straight line: Y = `stress` + `slope` (k - `strain`) from `strain` on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Piece {
    strain: f64,
    stress: f64,
    slope: f64,
    /// q + 3 G k of a trial stress that comes to lie at its beginning.
    sum: f64,
}

/// Marks of a yield stress Y(k) \[Pa\] over the plastic strain k, and the pieces between them.
///
/// A return solves q - 3 G dk = Y(k + dk). Y(k) + 3 G k rises, so that the piece on which the stress comes to lie is the last
/// that begins below q + 3 G k, and on it the equation is linear: a return is exact however many marks it passes. Where two
/// pieces meet both give the same, so that it does not matter which of them round-off takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Marks {
    /// Rows as they were given.
    rows: [[f64; 2]; MOST],
    /// Number of values that were given; more than [`MOST`] are refused.
    count: usize,
    pieces: [Piece; MOST + 1],
}

impl Marks {
    /// None.
    pub const NONE: Self = Self {
        rows: [[0.0; 2]; MOST],
        count: 0,
        pieces: [Piece {
            strain: 0.0,
            stress: 0.0,
            slope: 0.0,
            sum: 0.0,
        }; MOST + 1],
    };

    /// Curve of rows of plastic strain and yield stress \[Pa\].
    pub fn new(rows: &[[f64; 2]]) -> Self {
        let mut marks = Self {
            count: rows.len(),
            ..Self::NONE
        };
        for (own, row) in marks.rows.iter_mut().zip(rows) {
            *own = *row;
        }
        marks
    }

    /// The same with their pieces, from a first yield stress \[Pa\] and on with a last slope \[Pa\], where q falls by
    /// `stiffness` \[Pa\] per plastic strain. Plastic strain counts `factor` where a piece falls.
    pub fn placed(mut self, [first, last]: [f64; 2], stiffness: f64, factor: f64) -> Self {
        if self.is_empty() {
            return self;
        }
        let (mut from, mut strain) = ([0.0, first], 0.0);
        for i in 0..=self.used() {
            let given = if i < self.used() {
                let to = self.rows[i];
                (to[1] - from[1]) / (to[0] - from[0])
            } else {
                last
            };
            let factor = if given < 0.0 { factor } else { 1.0 };
            self.pieces[i] = Piece {
                strain,
                stress: from[1],
                slope: given * factor,
                sum: from[1] + stiffness * strain,
            };
            if i < self.used() {
                strain += (self.rows[i][0] - from[0]) / factor;
                from = self.rows[i];
            }
        }
        self
    }

    /// Rows as they were given, as many as are used.
    pub fn rows(&self) -> &[[f64; 2]] {
        &self.rows[..self.used()]
    }

    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    fn used(&self) -> usize {
        self.count.min(MOST)
    }

    /// The steepest fall of a piece between marks, as they were given \[Pa\]; negative where none falls.
    pub fn steepest(&self, first: f64) -> f64 {
        let mut from = [0.0, first];
        let mut most = f64::NEG_INFINITY;
        for row in self.rows() {
            most = most.max((from[1] - row[1]) / (row[0] - from[0]));
            from = *row;
        }
        most
    }

    /// First fault of a row.
    pub fn problem(&self) -> Option<InvalidConstant> {
        let unfit = |found: String, accepted: String| {
            Some(InvalidConstant {
                key: CURVE.key,
                found,
                accepted,
            })
        };
        if self.count > MOST {
            return unfit(format!("{} rows", self.count), format!("at most {MOST}"));
        }
        let mut before = 0.0;
        for (i, [strain, stress]) in self.rows().iter().enumerate() {
            // A strain that is no number is not beyond the one before.
            if !(strain.is_finite() && *strain > before) {
                return unfit(
                    format!("a plastic strain of {strain} in row {i}, not beyond {before}"),
                    format!("a number greater than {before}"),
                );
            }
            if !(stress.is_finite() && *stress > 0.0) {
                return unfit(
                    format!("a yield stress of {stress} in row {i}"),
                    "a number greater than 0 [Pa]".to_owned(),
                );
            }
            before = *strain;
        }
        None
    }

    /// Yield stress \[Pa\] at a plastic strain.
    #[inline(always)]
    pub fn stress_at<L: Lanes>(&self, strain: L) -> L {
        let piece: PieceLanes<L> = self.piece(|piece| L::splat(piece.strain).lt(strain));
        piece.stress_at(strain)
    }

    /// Plastic strain of a return from q = `beyond` \[Pa\] with the plastic strain before it, where q falls by `stiffness`
    /// \[Pa\] per plastic strain.
    #[inline(always)]
    pub fn strain_of_return<L: Lanes>(&self, beyond: L, before: L, stiffness: L) -> L {
        let sum = stiffness.mul_add(before, beyond);
        let piece: PieceLanes<L> = self.piece(|piece| L::splat(piece.sum).lt(sum));
        (beyond - piece.stress_at(before)) / (stiffness + piece.slope)
    }

    /// The last piece that has begun; pieces begin one after the other.
    #[inline(always)]
    fn piece<L: Lanes>(&self, has_begun: impl Fn(&Piece) -> L::Mask) -> PieceLanes<L> {
        let first = &self.pieces[0];
        let mut found = PieceLanes {
            strain: L::splat(first.strain),
            stress: L::splat(first.stress),
            slope: L::splat(first.slope),
        };
        for piece in &self.pieces[1..=self.used()] {
            let begun = has_begun(piece);
            found.strain = L::select(begun, L::splat(piece.strain), found.strain);
            found.stress = L::select(begun, L::splat(piece.stress), found.stress);
            found.slope = L::select(begun, L::splat(piece.slope), found.slope);
        }
        found
    }
}

/// A piece for each lane.
struct PieceLanes<L> {
    strain: L,
    stress: L,
    slope: L,
}

impl<L: Lanes> PieceLanes<L> {
    /// The line of the piece, also where it goes on before it.
    #[inline(always)]
    fn stress_at(&self, strain: L) -> L {
        self.slope.mul_add(strain - self.strain, self.stress)
    }
}
