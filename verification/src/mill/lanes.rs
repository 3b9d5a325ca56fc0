//! Jets as lanes: a law of the kernel gives the derivatives of its stress.
//!
//! A law chooses by comparison of values; the derivative is that of the branch that is taken. A scalar function of a law's own
//! ([`Lanes::map`]) hides its derivative, so that such a law needs a reference of its own.

use proctor_kernel::lanes::Lanes;

use crate::exact::jet::{Jet, Scalar};

impl<const N: usize> Lanes for Jet<N> {
    const WIDTH: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self::constant(x)
    }
    fn splat_two(a: f64, b: f64, lanes: u8) -> Self {
        Self::constant(if lanes & 1 == 1 { b } else { a })
    }
    fn load(from: &[f64]) -> Self {
        Self::constant(from[0])
    }
    fn load_part(from: &[f64], count: usize) -> Self {
        Self::constant(if count > 0 { from[0] } else { 0.0 })
    }
    fn store(self, to: &mut [f64]) {
        to[0] = self.value;
    }
    fn store_part(self, to: &mut [f64], count: usize) {
        if count > 0 {
            to[0] = self.value;
        }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        if self.value < b.value { self } else { b }
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        if self.value > b.value { self } else { b }
    }
    fn floor(self) -> Self {
        Self::constant(self.value.floor())
    }
    fn sqrt(self) -> Self {
        Scalar::sqrt(self)
    }
    fn mantissa_and_exponent(self) -> (Self, Self) {
        let exponent = (self.value.to_bits() >> 52 & 0x7ff) as f64 - 1023.0;
        (
            self * Self::constant(libm::exp2(-exponent)),
            Self::constant(exponent),
        )
    }
    fn power_of_two(self) -> Self {
        Self::constant(libm::exp2(self.value))
    }
    #[inline(always)]
    fn lt(self, b: Self) -> bool {
        self.value < b.value
    }
    #[inline(always)]
    fn eq(self, b: Self) -> bool {
        self.value == b.value
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }

    /// # Panics
    /// Always: the derivative of such a function is not known.
    fn map(self, _: fn(f64) -> f64) -> Self {
        // A derivative of zero would be a wrong reference without a word.
        panic!("a function of numbers has no derivative here: the law needs a reference of its own")
    }
}
