//! Fixed groups of f64 lanes with fused multiply-add, chosen at run time.
//!
//! The only module with `unsafe`: it wraps the vector instructions. Its promise is that every backend gives
//! the same bits for every operation, so that a result does not depend on the machine's vector width:
//! multiplication and addition are contracted only where the code says [`Lanes::mul_add`], `min` and `max`
//! follow the x86 rule (the second operand where the comparison is false), and nothing reduces across lanes
//! except order-independent operations. The tests compare all backends bit by bit.
//!
//! A stage is written once as a [`Kernel`], generic over a [`Backend`]; [`SelectedLanes::run`] calls it inside a
//! function compiled for the chosen instruction set. Everything a kernel calls must be `#[inline(always)]`,
//! and none of it a closure over lanes, which cannot be: what is not inlined is compiled without those instructions,
//! and every operation in it becomes a call. `.ci/run` looks for such calls.

// The vector intrinsics are unsafe functions; see the module documentation.
#![allow(unsafe_code)]

use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

pub mod functions;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod x86;

use scalar::{Pair, Scalar};

/// A group of f64 lanes.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Number of lanes.
    const WIDTH: usize;
    /// One truth value per lane.
    type Mask: Copy;

    /// All lanes equal to `x`.
    fn splat(x: f64) -> Self;
    /// The lanes whose bits are set in `lanes` equal to `b`, the others to `a`.
    fn splat_two(a: f64, b: f64, lanes: u8) -> Self;
    /// The first `WIDTH` values of `from`. Panics where there are fewer.
    fn load(from: &[f64]) -> Self;
    /// The first `count <= WIDTH` values of `from`, the other lanes zero.
    fn load_part(from: &[f64], count: usize) -> Self;
    /// Writes all lanes to the first `WIDTH` values of `to`. Panics where there are fewer.
    fn store(self, to: &mut [f64]);
    /// Writes the first `count <= WIDTH` lanes to `to`.
    fn store_part(self, to: &mut [f64], count: usize);
    /// `self * b + c`, rounded once.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// `if self < b { self } else { b }` per lane.
    fn min(self, b: Self) -> Self;
    /// `if self > b { self } else { b }` per lane.
    fn max(self, b: Self) -> Self;
    /// Largest integer not above the lane.
    fn floor(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Mantissa from 1 to 2 and exponent of 2 of a positive number of full precision, both exact.
    fn mantissa_and_exponent(self) -> (Self, Self);
    /// 2 to the power of a whole number from -1022 to 1023, exact.
    fn power_of_two(self) -> Self;
    /// `self < b` per lane, false for NaN.
    fn lt(self, b: Self) -> Self::Mask;
    /// `self == b` per lane, false for NaN.
    fn eq(self, b: Self) -> Self::Mask;
    /// `a` where the mask is true, else `b`.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// Bit i is set where lane i of the mask is true.
    fn bits(mask: Self::Mask) -> u32;

    /// Magnitude.
    #[inline(always)]
    fn abs(self) -> Self {
        self.max(-self)
    }

    /// True in the first `count` lanes.
    #[inline(always)]
    #[must_use]
    fn first(count: usize) -> Self::Mask {
        const INDEX: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
        Self::load(&INDEX).lt(Self::splat(count as f64))
    }

    /// The largest lane, 0 where none is above it.
    #[inline(always)]
    fn largest(self) -> f64 {
        let mut values = [0.0; 8];
        self.store(&mut values);
        let mut most = 0.0;
        for value in values {
            if value > most {
                most = value;
            }
        }
        most
    }

    /// Applies a scalar function to every lane.
    #[inline(always)]
    fn map(self, f: fn(f64) -> f64) -> Self {
        let mut values = [0.0; 8];
        self.store(&mut values);
        for value in &mut values[..Self::WIDTH] {
            *value = f(*value);
        }
        Self::load(&values)
    }
}

/// Bits of the mantissa of a number, and those of one.
const MANTISSA: u64 = (1 << EXPONENT) - 1;
const ONE: u64 = 1.0_f64.to_bits();
/// First bit of the exponent, behind which the sign is left.
const EXPONENT: u32 = 52;
/// Bits of an exponent, at the lower end of a number.
const EXPONENTS: u64 = 0x7ff;
/// 2^52: whole numbers below it are the last bits of their sum with it. The exponent of one stands for 2^0.
const WHOLE: f64 = 4_503_599_627_370_496.0;
const EXPONENT_OF_ONE: f64 = 1023.0;

/// Loads up to `L::WIDTH` values; the common full case is a plain load.
#[inline(always)]
#[must_use]
pub fn load<L: Lanes>(column: &[f64], at: usize, count: usize) -> L {
    if count == L::WIDTH {
        L::load(&column[at..at + L::WIDTH])
    } else {
        L::load_part(&column[at..at + count], count)
    }
}

/// Stores up to `L::WIDTH` values.
#[inline(always)]
pub(crate) fn store<L: Lanes>(value: L, column: &mut [f64], at: usize, count: usize) {
    if count == L::WIDTH {
        value.store(&mut column[at..at + L::WIDTH]);
    } else {
        value.store_part(&mut column[at..at + count], count);
    }
}

/// Four lanes.
pub trait Quad: Lanes {
    /// Lane j of row i becomes lane i of row j.
    fn transpose(rows: [Self; 4]) -> [Self; 4];
}

/// An instruction set: its natural vector, one of eight lanes (a node of the grid) and one of four (half a node).
pub trait Backend: Copy {
    /// Natural vector of the instruction set: 1, 4 or 8 lanes.
    type Native: Lanes;
    /// Eight lanes.
    type Line: Lanes;
    /// Four lanes.
    type Half: Quad;
    /// True if a line is one register: then both of its halves cost no more than one.
    const WHOLE_LINE: bool;
}

/// A computation that is compiled for every backend.
pub trait Kernel {
    /// Result of the kernel.
    type Output;
    /// Runs it; must be `#[inline(always)]`.
    fn run<B: Backend>(self) -> Self::Output;
}

/// Choice of the lanes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LaneChoice {
    /// The widest that the machine has.
    #[default]
    Auto,
    /// Eight f64 lanes (AVX-512F).
    Avx512,
    /// Four f64 lanes (AVX2 and FMA).
    Avx2,
    /// One lane.
    Scalar,
}

impl LaneChoice {
    /// The word of the command line.
    #[must_use]
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Avx512 => "avx512",
            Self::Avx2 => "avx2",
            Self::Scalar => "scalar",
        }
    }
}

/// A backend that this machine has been seen to support.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SelectedLanes {
    kind: Kind,
    whole_groups: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    #[cfg(target_arch = "x86_64")]
    Avx512,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Scalar lanes with a hardware fused multiply-add.
    ScalarFused,
    /// Lanes in plain Rust, where fused multiply-add is a library call.
    Plain,
}

/// The machine lacks the lanes that were asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LanesUnavailable(pub LaneChoice);

impl fmt::Display for LanesUnavailable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "this machine has no {} lanes; accepted here:",
            self.0.word()
        )?;
        for choice in [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar] {
            if SelectedLanes::new(choice).is_ok() {
                write!(f, " {}", choice.word())?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for LanesUnavailable {}

impl SelectedLanes {
    /// Selects a backend.
    ///
    /// # Errors
    /// If the machine lacks the instruction set that was asked for.
    pub fn new(choice: LaneChoice) -> Result<Self, LanesUnavailable> {
        #[cfg(target_arch = "x86_64")]
        {
            let fma = is_x86_feature_detected!("fma");
            let avx2 = fma && is_x86_feature_detected!("avx2");
            let avx512 =
                avx2 && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl");
            match choice {
                LaneChoice::Auto | LaneChoice::Avx512 if avx512 => Ok(Self {
                    kind: Kind::Avx512,
                    whole_groups: x86::adds_eight_lanes_at_once(),
                }),
                LaneChoice::Auto | LaneChoice::Avx2 if avx2 => Ok(Self::of(Kind::Avx2)),
                LaneChoice::Auto | LaneChoice::Scalar => {
                    Ok(Self::of(if fma { Kind::ScalarFused } else { Kind::Plain }))
                }
                missing => Err(LanesUnavailable(missing)),
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            match choice {
                // Every other 64-bit target that Rust supports well (aarch64) has fused multiply-add.
                LaneChoice::Auto | LaneChoice::Scalar => {
                    Ok(Self::of(if cfg!(target_arch = "aarch64") {
                        Kind::ScalarFused
                    } else {
                        Kind::Plain
                    }))
                }
                missing => Err(LanesUnavailable(missing)),
            }
        }
    }

    /// The widest backend of this machine.
    #[must_use]
    pub fn any() -> Self {
        Self::new(LaneChoice::Auto).unwrap_or(Self::plain())
    }

    /// Lanes in plain Rust, for a machine without fused multiply-add: one lane at a time, and lines of eight as with AVX-512. All
    /// others are compared with them, and they take the paths of AVX-512 through a line on any machine.
    #[must_use]
    pub fn plain() -> Self {
        Self::of(Kind::Plain)
    }

    fn of(kind: Kind) -> Self {
        Self {
            kind,
            whole_groups: false,
        }
    }

    /// The same lanes, in which groups of particles stay together however many base nodes they have, or do not. No bit depends
    /// on it.
    #[must_use]
    pub fn with_whole_groups(self, whole_groups: bool) -> Self {
        Self {
            whole_groups,
            ..self
        }
    }

    /// True where a group of particles in lanes is the fastest even with three base nodes: on machines that add eight numbers as
    /// fast as four.
    #[must_use]
    #[inline]
    pub(crate) fn whole_groups(self) -> bool {
        self.whole_groups
    }

    /// Name for summaries: `avx512`, `avx2`, `scalar`, or `scalar without fused multiply-add` where every
    /// multiply-add is a slow library call.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self.kind {
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => "avx512",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => "avx2",
            Kind::ScalarFused => "scalar",
            Kind::Plain => "scalar without fused multiply-add",
        }
    }

    /// Runs a kernel, compiled for this backend.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self.kind {
            // SAFETY: `SelectedLanes::new` makes these kinds only where the features were detected.
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => unsafe { x86::run_avx512(kernel) },
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => unsafe { x86::run_avx2(kernel) },
            #[cfg(target_arch = "x86_64")]
            Kind::ScalarFused => unsafe { x86::run_scalar_fused(kernel) },
            #[cfg(not(target_arch = "x86_64"))]
            Kind::ScalarFused => kernel.run::<ScalarBackend>(),
            Kind::Plain => kernel.run::<Plain>(),
        }
    }
}

/// One lane at a time.
#[derive(Clone, Copy)]
struct ScalarBackend;

impl Backend for ScalarBackend {
    type Native = Scalar;
    type Line = Pair<Pair<Pair<Scalar>>>;
    type Half = Pair<Pair<Scalar>>;
    const WHOLE_LINE: bool = false;
}

/// One lane at a time in plain Rust, with lines taken as one register as with AVX-512. Every multiply-add is a library call here:
/// eight of them side by side at each place were nine tenths of the code for lanes.
#[derive(Clone, Copy)]
struct Plain;

impl Backend for Plain {
    type Native = Scalar;
    type Line = Pair<Pair<Pair<Scalar>>>;
    type Half = Pair<Pair<Scalar>>;
    const WHOLE_LINE: bool = true;
}
