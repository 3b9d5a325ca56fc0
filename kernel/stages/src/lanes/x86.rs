//! AVX2 and AVX-512F lanes.
//!
//! The types are private to the lanes module and reach other code only as the associated types of a backend,
//! inside `run_avx2` or `run_avx512`, which are called only where the features were detected. That is the
//! safety argument of every `unsafe` block below; loads and stores check the length of their slice first.

use super::scalar::Pair;
use super::{
    Backend, EXPONENT, EXPONENT_OF_ONE, EXPONENTS, Kernel, Lanes, MANTISSA, ONE, Quad,
    ScalarBackend, WHOLE,
};
#[allow(clippy::wildcard_imports)] // the vector intrinsics
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::OnceLock;

/// Four lanes.
#[derive(Clone, Copy)]
pub(super) struct Avx2Lanes(__m256d);

/// Eight lanes.
#[derive(Clone, Copy)]
pub(super) struct Avx512Lanes(__m512d);

#[derive(Clone, Copy)]
struct Avx2;

impl Backend for Avx2 {
    type Native = Avx2Lanes;
    type Line = Pair<Avx2Lanes>;
    type Half = Avx2Lanes;
    const WHOLE_LINE: bool = false;
}

#[derive(Clone, Copy)]
struct Avx512;

impl Backend for Avx512 {
    type Native = Avx512Lanes;
    type Line = Avx512Lanes;
    type Half = Avx2Lanes;
    const WHOLE_LINE: bool = true;
}

/// True on processors of Intel, which add eight numbers as fast as four. Those of AMD with AVX-512 were measured to gather faster
/// by four.
pub(super) fn adds_eight_lanes_at_once() -> bool {
    // Asked once: on a virtual machine the instruction takes microseconds, and lanes are selected in inner loops.
    static INTEL: OnceLock<bool> = OnceLock::new();
    *INTEL.get_or_init(|| {
        #[allow(unused_unsafe)] // safe since Rust 1.94
        // SAFETY: every processor with AVX-512 has the instruction.
        let vendor = unsafe { __cpuid(0) };
        [vendor.ebx, vendor.edx, vendor.ecx].map(u32::to_le_bytes) == [*b"Genu", *b"ineI", *b"ntel"]
    })
}

/// # Safety
/// The machine must have AVX2 and FMA.
#[target_feature(enable = "avx2,fma")]
pub(super) unsafe fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Avx2>()
}

/// # Safety
/// The machine must have AVX-512F, AVX-512VL, AVX2 and FMA.
#[target_feature(enable = "avx512f,avx512vl,avx2,fma")]
pub(super) unsafe fn run_avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Avx512>()
}

/// # Safety
/// The machine must have FMA (which implies AVX).
#[target_feature(enable = "fma")]
pub(super) unsafe fn run_scalar_fused<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<ScalarBackend>()
}

macro_rules! binary {
    ($trait:ident, $method:ident, $avx2:ident, $avx512:ident) => {
        impl $trait for Avx2Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Self(unsafe { $avx2(self.0, b.0) })
            }
        }
        impl $trait for Avx512Lanes {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Self(unsafe { $avx512(self.0, b.0) })
            }
        }
    };
}
binary!(Add, add, _mm256_add_pd, _mm512_add_pd);
binary!(Sub, sub, _mm256_sub_pd, _mm512_sub_pd);
binary!(Mul, mul, _mm256_mul_pd, _mm512_mul_pd);
binary!(Div, div, _mm256_div_pd, _mm512_div_pd);

impl Neg for Avx2Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // -0 - x is -x for every x, signed zeros included.
        Self::splat(-0.0) - self
    }
}

impl Neg for Avx512Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::splat(-0.0) - self
    }
}

/// Masks for the first 0 to 4 lanes: `PARTS[4 - count..]`.
static PARTS: [i64; 8] = [-1, -1, -1, -1, 0, 0, 0, 0];

impl Avx2Lanes {
    #[inline(always)]
    fn part(count: usize) -> __m256i {
        let window = &PARTS[4 - count..8 - count];
        unsafe { _mm256_loadu_si256(window.as_ptr().cast()) }
    }
}

impl Lanes for Avx2Lanes {
    const WIDTH: usize = 4;
    type Mask = __m256d;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(unsafe { _mm256_set1_pd(x) })
    }
    #[inline(always)]
    fn splat_two(a: f64, b: f64, lanes: u8) -> Self {
        let mut all = [a; 4];
        for lane in 0..4 {
            if lanes >> lane & 1 == 1 {
                all[lane] = b;
            }
        }
        Self(unsafe { _mm256_setr_pd(all[0], all[1], all[2], all[3]) })
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        let from = &from[..4];
        Self(unsafe { _mm256_loadu_pd(from.as_ptr()) })
    }
    #[inline(always)]
    fn load_part(from: &[f64], count: usize) -> Self {
        let from = &from[..count];
        Self(unsafe { _mm256_maskload_pd(from.as_ptr(), Self::part(count)) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        let to = &mut to[..4];
        unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn store_part(self, to: &mut [f64], count: usize) {
        let to = &mut to[..count];
        unsafe { _mm256_maskstore_pd(to.as_mut_ptr(), Self::part(count), self.0) }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm256_fmadd_pd(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Self(unsafe { _mm256_min_pd(self.0, b.0) })
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Self(unsafe { _mm256_max_pd(self.0, b.0) })
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self(unsafe { _mm256_floor_pd(self.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm256_castpd_si256(self.0);
            let mantissa = _mm256_or_si256(
                _mm256_and_si256(bits, _mm256_set1_epi64x(MANTISSA as i64)),
                _mm256_set1_epi64x(ONE as i64),
            );
            let exponent = _mm256_and_si256(
                _mm256_srli_epi64::<{ EXPONENT as i32 }>(bits),
                _mm256_set1_epi64x(EXPONENTS as i64),
            );
            // A whole number below 2^52 as one of these lanes.
            let exponent = _mm256_or_si256(exponent, _mm256_set1_epi64x(WHOLE.to_bits() as i64));
            (
                Self(_mm256_castsi256_pd(mantissa)),
                Self(_mm256_castsi256_pd(exponent)) - Self::splat(WHOLE + EXPONENT_OF_ONE),
            )
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let shifted = self + Self::splat(WHOLE + EXPONENT_OF_ONE);
        unsafe {
            let bits = _mm256_slli_epi64::<{ EXPONENT as i32 }>(_mm256_castpd_si256(shifted.0));
            Self(_mm256_castsi256_pd(bits))
        }
    }
    #[inline(always)]
    fn lt(self, b: Self) -> __m256d {
        unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, b.0) }
    }
    #[inline(always)]
    fn eq(self, b: Self) -> __m256d {
        unsafe { _mm256_cmp_pd::<_CMP_EQ_OQ>(self.0, b.0) }
    }
    #[inline(always)]
    fn select(mask: __m256d, a: Self, b: Self) -> Self {
        Self(unsafe { _mm256_blendv_pd(b.0, a.0, mask) })
    }
    #[inline(always)]
    fn bits(mask: __m256d) -> u32 {
        unsafe { _mm256_movemask_pd(mask) as u32 }
    }
}

impl Quad for Avx2Lanes {
    #[inline(always)]
    fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        unsafe {
            let (ab_even, ab_odd) = (_mm256_unpacklo_pd(a.0, b.0), _mm256_unpackhi_pd(a.0, b.0));
            let (cd_even, cd_odd) = (_mm256_unpacklo_pd(c.0, d.0), _mm256_unpackhi_pd(c.0, d.0));
            [
                Self(_mm256_permute2f128_pd::<0x20>(ab_even, cd_even)),
                Self(_mm256_permute2f128_pd::<0x20>(ab_odd, cd_odd)),
                Self(_mm256_permute2f128_pd::<0x31>(ab_even, cd_even)),
                Self(_mm256_permute2f128_pd::<0x31>(ab_odd, cd_odd)),
            ]
        }
    }
}

impl Lanes for Avx512Lanes {
    const WIDTH: usize = 8;
    type Mask = __mmask8;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self(unsafe { _mm512_set1_pd(x) })
    }
    #[inline(always)]
    fn splat_two(a: f64, b: f64, lanes: u8) -> Self {
        Self(unsafe { _mm512_mask_blend_pd(lanes, _mm512_set1_pd(a), _mm512_set1_pd(b)) })
    }
    #[inline(always)]
    fn load(from: &[f64]) -> Self {
        let from = &from[..8];
        Self(unsafe { _mm512_loadu_pd(from.as_ptr()) })
    }
    #[inline(always)]
    fn load_part(from: &[f64], count: usize) -> Self {
        let from = &from[..count];
        Self(unsafe { _mm512_maskz_loadu_pd(part_512(count), from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f64]) {
        let to = &mut to[..8];
        unsafe { _mm512_storeu_pd(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn store_part(self, to: &mut [f64], count: usize) {
        let to = &mut to[..count];
        unsafe { _mm512_mask_storeu_pd(to.as_mut_ptr(), part_512(count), self.0) }
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(unsafe { _mm512_fmadd_pd(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        Self(unsafe { _mm512_min_pd(self.0, b.0) })
    }
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        Self(unsafe { _mm512_max_pd(self.0, b.0) })
    }
    #[inline(always)]
    fn floor(self) -> Self {
        // Bits 1:0 of the immediate choose rounding towards minus infinity, bit 3 suppresses exceptions.
        Self(unsafe { _mm512_roundscale_pd::<0x09>(self.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn mantissa_and_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm512_castpd_si512(self.0);
            let mantissa = _mm512_or_si512(
                _mm512_and_si512(bits, _mm512_set1_epi64(MANTISSA as i64)),
                _mm512_set1_epi64(ONE as i64),
            );
            let exponent = _mm512_and_si512(
                _mm512_srli_epi64::<EXPONENT>(bits),
                _mm512_set1_epi64(EXPONENTS as i64),
            );
            // A whole number below 2^52 as one of these lanes.
            let exponent = _mm512_or_si512(exponent, _mm512_set1_epi64(WHOLE.to_bits() as i64));
            (
                Self(_mm512_castsi512_pd(mantissa)),
                Self(_mm512_castsi512_pd(exponent)) - Self::splat(WHOLE + EXPONENT_OF_ONE),
            )
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let shifted = self + Self::splat(WHOLE + EXPONENT_OF_ONE);
        unsafe {
            let bits = _mm512_slli_epi64::<EXPONENT>(_mm512_castpd_si512(shifted.0));
            Self(_mm512_castsi512_pd(bits))
        }
    }
    #[inline(always)]
    fn lt(self, b: Self) -> __mmask8 {
        unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, b.0) }
    }
    #[inline(always)]
    fn eq(self, b: Self) -> __mmask8 {
        unsafe { _mm512_cmp_pd_mask::<_CMP_EQ_OQ>(self.0, b.0) }
    }
    #[inline(always)]
    fn select(mask: __mmask8, a: Self, b: Self) -> Self {
        Self(unsafe { _mm512_mask_blend_pd(mask, b.0, a.0) })
    }
    #[inline(always)]
    fn bits(mask: __mmask8) -> u32 {
        u32::from(mask)
    }
}

/// Mask of the first `count <= 8` lanes.
#[inline(always)]
fn part_512(count: usize) -> __mmask8 {
    ((1_u32 << count) - 1) as __mmask8
}
