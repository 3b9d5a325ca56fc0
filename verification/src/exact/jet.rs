//! Derivatives by forward mode: a value with its partial derivatives.
//!
//! A [`Jet`] obeys the rules of sum, product, quotient and chain (Wengert 1964), so that a formula that is written once for
//! any [`Scalar`] gives its derivatives to round-off. A jet of jets gives the second ones.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that formulas are written in: f64, or a number with derivatives.
pub trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A constant.
    fn of(x: f64) -> Self;
    /// The value without derivatives.
    fn value(self) -> f64;
    /// Sine of an angle \[rad\].
    fn sin(self) -> Self;
    /// Cosine of an angle \[rad\].
    fn cos(self) -> Self;
    /// Square root; its derivative at 0 is infinite.
    fn sqrt(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;

    /// The number times itself, `n` factors.
    fn power(self, n: usize) -> Self {
        (0..n).fold(Self::of(1.0), |product, _| product * self)
    }
}

impl Scalar for f64 {
    fn of(x: f64) -> Self {
        x
    }
    fn value(self) -> f64 {
        self
    }
    fn sin(self) -> Self {
        libm::sin(self)
    }
    fn cos(self) -> Self {
        libm::cos(self)
    }
    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }
    fn ln(self) -> Self {
        libm::log(self)
    }
    fn exp(self) -> Self {
        libm::exp(self)
    }
}

/// A value and its partial derivatives by `N` variables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<const N: usize, T = f64> {
    /// The value.
    pub value: T,
    /// Its derivatives, one for each variable.
    pub partials: [T; N],
}

impl<const N: usize, T: Scalar> Jet<N, T> {
    /// A number that depends on no variable.
    #[inline]
    pub fn constant(value: T) -> Self {
        Self {
            value,
            partials: [T::of(0.0); N],
        }
    }

    /// The variable of that number, with this value.
    #[inline]
    pub fn variable(value: T, number: usize) -> Self {
        let mut jet = Self::constant(value);
        jet.partials[number] = T::of(1.0);
        jet
    }

    /// A function of this number, by its value and its derivative there.
    #[inline]
    fn chain(self, value: T, derivative: T) -> Self {
        Self {
            value,
            partials: self.partials.map(|partial| partial * derivative),
        }
    }
}

impl<const N: usize, T: Scalar> Add for Jet<N, T> {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self {
            value: self.value + b.value,
            partials: std::array::from_fn(|i| self.partials[i] + b.partials[i]),
        }
    }
}

impl<const N: usize, T: Scalar> Sub for Jet<N, T> {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self {
            value: self.value - b.value,
            partials: std::array::from_fn(|i| self.partials[i] - b.partials[i]),
        }
    }
}

impl<const N: usize, T: Scalar> Mul for Jet<N, T> {
    type Output = Self;
    // The derivative of a product is a sum.
    #[allow(clippy::suspicious_arithmetic_impl)]
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self {
            value: self.value * b.value,
            partials: std::array::from_fn(|i| {
                self.partials[i] * b.value + self.value * b.partials[i]
            }),
        }
    }
}

impl<const N: usize, T: Scalar> Div for Jet<N, T> {
    type Output = Self;
    #[inline]
    fn div(self, b: Self) -> Self {
        let inverse = T::of(1.0) / b.value;
        let value = self.value / b.value;
        Self {
            value,
            partials: std::array::from_fn(|i| (self.partials[i] - value * b.partials[i]) * inverse),
        }
    }
}

impl<const N: usize, T: Scalar> Neg for Jet<N, T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            partials: self.partials.map(|partial| -partial),
        }
    }
}

impl<const N: usize, T: Scalar> Scalar for Jet<N, T> {
    #[inline]
    fn of(x: f64) -> Self {
        Self::constant(T::of(x))
    }
    fn value(self) -> f64 {
        self.value.value()
    }
    fn sin(self) -> Self {
        self.chain(self.value.sin(), self.value.cos())
    }
    fn cos(self) -> Self {
        self.chain(self.value.cos(), -self.value.sin())
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, T::of(0.5) / root)
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::of(1.0) / self.value)
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }
}
