//! One lane, and pairs of narrower groups.

use super::{EXPONENT, EXPONENT_OF_ONE, EXPONENTS, Lanes, MANTISSA, ONE, Quad, WHOLE};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// One f64.
#[derive(Clone, Copy)]
pub(super) struct Scalar(f64);

/// Two groups side by side, twice as wide.
#[derive(Clone, Copy)]
pub(super) struct Pair<T>(T, T);

macro_rules! binary {
    ($trait:ident, $method:ident) => {
        impl $trait for Scalar {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Self(self.0.$method(b.0))
            }
        }
        impl<T: Lanes> $trait for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Self(self.0.$method(b.0), self.1.$method(b.1))
            }
        }
    };
}
binary!(Add, add);
binary!(Sub, sub);
binary!(Mul, mul);
binary!(Div, div);

impl Neg for Scalar {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Lanes> Neg for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Lanes for Scalar {
    const WIDTH: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(x)
    }
    #[inline(always)]
    fn splat_two(a: f64, b: f64, lanes: u8) -> Self {
        Self(if lanes & 1 == 1 { b } else { a })
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self(from[0])
    }
    #[inline(always)]
    fn load_part(from: &[f64], count: usize) -> Self {
        Self(if count > 0 { from[0] } else { 0.0 })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        to[0] = self.0;
    }
    #[inline(always)]
    fn store_part(self, to: &mut [f64], count: usize) {
        if count > 0 {
            to[0] = self.0;
        }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(self.0.mul_add(b.0, c.0))
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Self(if self.0 < b.0 { self.0 } else { b.0 })
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Self(if self.0 > b.0 { self.0 } else { b.0 })
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor())
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        let bits = self.0.to_bits();
        let exponent = (bits >> EXPONENT & EXPONENTS) as f64 - EXPONENT_OF_ONE;
        (Self(f64::from_bits(bits & MANTISSA | ONE)), Self(exponent))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let shifted = self.0 + (WHOLE + EXPONENT_OF_ONE);
        Self(f64::from_bits(shifted.to_bits() << EXPONENT))
    }
    #[inline(always)]
    fn lt(self, b: Self) -> bool {
        self.0 < b.0
    }
    #[inline(always)]
    fn eq(self, b: Self) -> bool {
        self.0 == b.0
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn bits(mask: bool) -> u32 {
        u32::from(mask)
    }
}

impl<T: Lanes> Lanes for Pair<T> {
    const WIDTH: usize = 2 * T::WIDTH;
    type Mask = (T::Mask, T::Mask);

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(T::splat(x), T::splat(x))
    }
    #[inline(always)]
    fn splat_two(a: f64, b: f64, lanes: u8) -> Self {
        Self(
            T::splat_two(a, b, lanes),
            T::splat_two(a, b, lanes >> T::WIDTH),
        )
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        Self(T::load(from), T::load(&from[T::WIDTH..]))
    }
    #[inline(always)]
    fn load_part(from: &[f64], count: usize) -> Self {
        let (first, second) = from.split_at(from.len().min(T::WIDTH));
        Self(
            T::load_part(first, count.min(T::WIDTH)),
            T::load_part(second, count.saturating_sub(T::WIDTH)),
        )
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        self.0.store(to);
        self.1.store(&mut to[T::WIDTH..]);
    }
    #[inline(always)]
    fn store_part(self, to: &mut [f64], count: usize) {
        let (first, second) = to.split_at_mut(to.len().min(T::WIDTH));
        self.0.store_part(first, count.min(T::WIDTH));
        self.1.store_part(second, count.saturating_sub(T::WIDTH));
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(self.0.mul_add(b.0, c.0), self.1.mul_add(b.1, c.1))
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Self(self.0.min(b.0), self.1.min(b.1))
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Self(self.0.max(b.0), self.1.max(b.1))
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor(), self.1.floor())
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        let (first, second) = (
            self.0.mantissa_and_exponent(),
            self.1.mantissa_and_exponent(),
        );
        (Self(first.0, second.0), Self(first.1, second.1))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Self(self.0.power_of_two(), self.1.power_of_two())
    }
    #[inline(always)]
    fn lt(self, b: Self) -> Self::Mask {
        (self.0.lt(b.0), self.1.lt(b.1))
    }
    #[inline(always)]
    fn eq(self, b: Self) -> Self::Mask {
        (self.0.eq(b.0), self.1.eq(b.1))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Self(T::select(mask.0, a.0, b.0), T::select(mask.1, a.1, b.1))
    }
    #[inline(always)]
    fn bits(mask: Self::Mask) -> u32 {
        T::bits(mask.0) | (T::bits(mask.1) << T::WIDTH)
    }
}

impl Quad for Pair<Pair<Scalar>> {
    #[inline(always)]
    fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        [
            Pair(Pair(a.0.0, b.0.0), Pair(c.0.0, d.0.0)),
            Pair(Pair(a.0.1, b.0.1), Pair(c.0.1, d.0.1)),
            Pair(Pair(a.1.0, b.1.0), Pair(c.1.0, d.1.0)),
            Pair(Pair(a.1.1, b.1.1), Pair(c.1.1, d.1.1)),
        ]
    }
}
