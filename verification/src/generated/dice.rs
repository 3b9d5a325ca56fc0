//! Random choices of a scene, the same on every machine.

use crate::random::Random;

/// Choices that follow from a seed and the number of a scene.
#[derive(Clone, Debug)]
pub struct Dice(Random);

impl Dice {
    /// Choices of the scene of that number.
    #[must_use]
    pub fn new(seed: u64, number: u64) -> Self {
        // Two odd factors, so that neighbours in seed and number have nothing in common.
        let mixed = seed
            .wrapping_mul(0xd134_2543_de82_ef95)
            .wrapping_add(number.wrapping_mul(0xaf25_1af3_b0f0_25b5));
        Self(Random::new(mixed))
    }

    /// A number between two.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }

    /// A positive number between two, each decade as likely as the next.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    /// A whole number from one to another, both of them included.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.0.unit() * (high - low + 1) as f64) as usize
    }

    /// True in that share of the cases.
    pub fn chance(&mut self, share: f64) -> bool {
        self.0.unit() < share
    }

    /// One entry of a list that has some.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.whole(0, from.len() - 1)]
    }

    /// -1 or 1.
    pub fn sign(&mut self) -> f64 {
        self.pick(&[-1.0, 1.0])
    }

    /// A power of two from 2^-`most` to 2^`most`.
    pub fn power(&mut self, most: i32) -> f64 {
        let exponent = self.whole(0, 2 * most as usize) as i32 - most;
        libm::ldexp(1.0, exponent)
    }

    /// The edge of a cell \[m\]: a power of two, whose multiples have no round-off, a decimal fraction, or any number.
    pub fn cell(&mut self) -> f64 {
        match self.whole(0, 3) {
            0 => self.power(4),
            1 => self.pick(&[0.1, 0.05, 0.025, 0.3, 0.7, 10.0]),
            2 => self.pick(&[3.0, 7.0, 1.0 / 3.0, 0.6, 1e-3]),
            _ => self.decades(1e-2, 1e2),
        }
    }

    /// Place of a face in its cell, in cells: on a line of the mesh, half way, on a quarter, or anywhere.
    pub fn place(&mut self) -> f64 {
        match self.whole(0, 3) {
            0 => 0.0,
            1 => self.pick(&[0.5, 0.25, 0.75]),
            _ => self.between(0.02, 0.98),
        }
    }
}
