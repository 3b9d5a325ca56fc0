//! Exact sums of floating-point numbers: terms are added without round-off, and the sum is rounded once.
//!
//! A sum of rounded partial sums depends on the order of its terms. One that is exact does not, so that neither the way in
//! which particles are stored nor the number of threads can change a bit of it. A term is split at fixed powers of 2^32 and
//! added to the digits there, which are wide enough for 512 terms before carries must travel (the small
//! superaccumulator of R. M. Neal, "Fast exact summation using small and large superaccumulators", 2015).

/// Bits of a digit once its carry has travelled.
const DIGIT_BITS: u32 = 32;
/// The bits of such a digit.
const DIGIT_MASK: i64 = (1 << DIGIT_BITS) - 1;
/// Digits from 2^-1074, the smallest number, up to 2^64 times the largest one.
const DIGITS: usize = 68;
/// Terms after which carries travel. A term adds less than 2^53 to a digit, which holds 2^63.
const TERMS: u32 = 1 << 9;
/// Bits of a significand that are stored.
const SIGNIFICAND_BITS: u32 = 52;
/// Exponent bits of an infinity or a NaN.
const NOT_FINITE: u64 = 0x7ff;
/// Exponent of the unit of the lowest digit.
const LOWEST_EXPONENT: i32 = -1074;

/// An exact sum. Infinities and NaN are summed apart: the value is what their sum is in any order.
#[derive(Clone, Debug)]
pub struct ExactSum {
    /// The sum in units of 2^-1074, digit by digit, the lowest first. The highest bears the sign.
    digits: [i64; DIGITS],
    /// Terms added since carries travelled.
    terms: u32,
    /// Sum of the terms that are not finite.
    not_finite: f64,
}

impl Default for ExactSum {
    fn default() -> Self {
        Self::ZERO
    }
}

impl ExactSum {
    /// Number of its words.
    pub const WORDS: usize = DIGITS + 1;

    /// The sum of nothing.
    pub const ZERO: Self = Self {
        digits: [0; DIGITS],
        terms: 0,
        not_finite: 0.0,
    };

    /// Adds a term.
    #[inline]
    pub fn add(&mut self, x: f64) {
        let bits = x.to_bits();
        let exponent = bits >> SIGNIFICAND_BITS & NOT_FINITE;
        if exponent == NOT_FINITE {
            self.not_finite += x;
            return;
        }
        let stored = bits & ((1 << SIGNIFICAND_BITS) - 1);
        let significand = stored | u64::from(exponent != 0) << SIGNIFICAND_BITS;
        // A subnormal number has the unit of the smallest normal ones.
        let position = exponent.saturating_sub(1);
        let (digit, shift) = (
            (position / u64::from(DIGIT_BITS)) as usize,
            position as u32 % DIGIT_BITS,
        );
        let low = significand << shift & DIGIT_MASK as u64;
        let high = significand >> (DIGIT_BITS - shift);
        // All bits of the sign: negates both halves without a branch.
        let sign = (bits as i64) >> 63;
        self.digits[digit] += (low as i64 ^ sign) - sign;
        self.digits[digit + 1] += (high as i64 ^ sign) - sign;
        self.terms += 1;
        if self.terms == TERMS {
            self.carry();
        }
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: &Self) {
        self.carry();
        let mut other = other.clone();
        other.carry();
        for (digit, more) in self.digits.iter_mut().zip(other.digits) {
            *digit += more;
        }
        self.terms = 1;
        self.not_finite += other.not_finite;
    }

    /// The sum as words, for [`ExactSum::from_words`] in another process.
    #[must_use]
    pub fn words(&self) -> [u64; Self::WORDS] {
        let mut carried = self.clone();
        carried.carry();
        let mut words = [0; Self::WORDS];
        for (word, digit) in words.iter_mut().zip(carried.digits) {
            *word = digit as u64;
        }
        words[DIGITS] = carried.not_finite.to_bits();
        words
    }

    /// The sum that gave these words.
    #[must_use]
    pub fn from_words(words: &[u64; Self::WORDS]) -> Self {
        Self {
            digits: std::array::from_fn(|digit| words[digit] as i64),
            terms: 1,
            not_finite: f64::from_bits(words[DIGITS]),
        }
    }

    /// The sum, rounded once to the nearest number, to the even one of two; infinite where it is too large.
    #[must_use]
    pub fn value(&self) -> f64 {
        if self.not_finite.is_nan() {
            // Which of several bit patterns an addition gives may depend on the order.
            return f64::NAN;
        }
        if self.not_finite != 0.0 {
            return self.not_finite;
        }
        let mut size = self.clone();
        size.carry();
        let negative = size.digits[DIGITS - 1] < 0;
        if negative {
            size.digits = size.digits.map(|digit| -digit);
            size.carry();
        }
        let highest = size.digits.iter().rposition(|digit| *digit != 0);
        // Three digits have at least 65 bits, more than a number holds; a digit below them counts as a part of the last bit.
        let lowest = highest.map_or(0, |highest| highest.saturating_sub(2));
        let window = size.digits[lowest..lowest + 3].iter().rev();
        let window = window.fold(0_u128, |window, digit| {
            window << DIGIT_BITS | *digit as u128
        });
        let rest = size.digits[..lowest].iter().any(|digit| *digit != 0);
        let exponent = LOWEST_EXPONENT + (lowest as u32 * DIGIT_BITS) as i32;
        let size = (window | u128::from(rest)) as f64 * power_of_two(exponent);
        if negative { -size } else { size }
    }

    /// Lets carries travel: each digit but the highest lies in 0..2^32 afterwards.
    fn carry(&mut self) {
        for i in 0..DIGITS - 1 {
            let carry = self.digits[i] >> DIGIT_BITS;
            self.digits[i] &= DIGIT_MASK;
            self.digits[i + 1] += carry;
        }
        self.terms = 0;
    }
}

impl Extend<f64> for ExactSum {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, terms: I) {
        terms.into_iter().for_each(|term| self.add(term));
    }
}

impl FromIterator<f64> for ExactSum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        let mut sum = Self::ZERO;
        sum.extend(terms);
        sum
    }
}

/// The exact sum of terms, rounded once.
#[must_use]
pub fn exact_sum(terms: impl IntoIterator<Item = f64>) -> f64 {
    terms.into_iter().collect::<ExactSum>().value()
}

/// 2^exponent, for exponents from -1074 to 1023.
fn power_of_two(exponent: i32) -> f64 {
    let biased = exponent + 1023;
    if biased > 0 {
        f64::from_bits((biased as u64) << SIGNIFICAND_BITS)
    } else {
        f64::from_bits(1 << (exponent - LOWEST_EXPONENT))
    }
}

#[cfg(test)]
mod tests {
    use super::{DIGITS, ExactSum, LOWEST_EXPONENT, exact_sum, power_of_two};

    /// Numbers of all sizes and both signs, from a linear congruence.
    fn numbers(count: usize, exponents: std::ops::Range<i32>) -> Vec<f64> {
        let mut word = 0x2545_f491_4f6c_dd1d_u64;
        let mut next = || {
            word = (word.wrapping_mul(6_364_136_223_846_793_005))
                .wrapping_add(1_442_695_040_888_963_407);
            word >> 11
        };
        let span = (exponents.end - exponents.start) as u64;
        (0..count)
            .map(|_| {
                let exponent = exponents.start + (next() % span) as i32;
                let sign = if next() % 2 == 0 { 1.0 } else { -1.0 };
                sign * (1.0 + next() as f64 / (1_u64 << 53) as f64) * power_of_two(exponent)
            })
            .collect()
    }

    /// The sum by whole numbers, of terms between 1 and 2^60: none of it is rounded but the last step.
    fn by_whole_numbers(terms: &[f64]) -> f64 {
        let whole = |x: f64| (x * power_of_two(52)) as i128;
        terms.iter().map(|x| whole(*x)).sum::<i128>() as f64 / power_of_two(52)
    }

    #[test]
    fn the_sum_is_that_of_whole_numbers_rounded_once() {
        for count in [1, 2, 3, 100, 5000] {
            let terms = numbers(count, 0..60);
            assert_eq!(
                exact_sum(terms.iter().copied()),
                by_whole_numbers(&terms),
                "{count}"
            );
        }
    }

    #[test]
    fn neither_order_nor_parts_change_a_bit() {
        let mut terms = numbers(3000, -1022..1000);
        let forward = exact_sum(terms.iter().copied());
        let mut parts = ExactSum::ZERO;
        for part in terms.chunks(117) {
            parts.merge(&part.iter().copied().collect());
        }
        terms.reverse();
        let backward = exact_sum(terms.iter().copied());
        terms.sort_by(f64::total_cmp);
        let sorted = exact_sum(terms.iter().copied());
        let bits = [forward, backward, sorted, parts.value()].map(f64::to_bits);
        assert_eq!(bits, [forward.to_bits(); 4]);
    }

    #[test]
    fn what_cancels_leaves_what_is_small() {
        assert_eq!(exact_sum([1e300, 1.0, -1e300, 5e-324, -1.0]), 5e-324);
        let mut terms = numbers(2000, -1000..1000);
        let negated: Vec<f64> = terms.iter().map(|x| -x).collect();
        terms.extend(negated);
        assert_eq!(exact_sum(terms.iter().copied()).to_bits(), 0);
    }

    #[test]
    fn one_number_is_its_own_sum() {
        let edges = [
            0.0,
            5e-324,
            -5e-324,
            f64::MIN_POSITIVE,
            f64::MAX,
            f64::MIN,
            1.0,
            -0.1,
        ];
        for x in numbers(3000, -1022..1023).into_iter().chain(edges) {
            assert_eq!(exact_sum([x]).to_bits(), x.to_bits(), "{x:e}");
        }
    }

    #[test]
    fn a_tie_goes_to_the_even_number_and_a_part_beyond_it_decides() {
        let half = power_of_two(-53);
        assert_eq!(exact_sum([1.0, half]), 1.0);
        assert_eq!(exact_sum([1.0, half, 5e-324]), 1.0 + f64::EPSILON);
        assert_eq!(
            exact_sum([1.0 + f64::EPSILON, half]),
            1.0 + 2.0 * f64::EPSILON
        );
        assert_eq!(
            exact_sum([1.0 + f64::EPSILON, half, -5e-324]),
            1.0 + f64::EPSILON
        );
        assert_eq!(exact_sum([-1.0, -half, -5e-324]), -1.0 - f64::EPSILON);
        // Subnormal numbers have units of their own.
        assert_eq!(
            exact_sum([f64::MIN_POSITIVE, -5e-324]),
            f64::MIN_POSITIVE - 5e-324
        );
    }

    #[test]
    fn a_sum_may_pass_the_largest_number_and_come_back() {
        assert_eq!(exact_sum([f64::MAX, f64::MAX, -f64::MAX]), f64::MAX);
        assert_eq!(exact_sum([f64::MAX, f64::MAX]), f64::INFINITY);
        assert_eq!(exact_sum([-f64::MAX, -f64::MAX]), f64::NEG_INFINITY);
        assert_eq!(exact_sum((0..100_000).map(|_| f64::MAX)), f64::INFINITY);
        let and_back = (0..200_000).map(|i| if i < 100_000 { f64::MAX } else { f64::MIN });
        assert_eq!(exact_sum(and_back.chain([3.0])), 3.0);
    }

    #[test]
    fn what_is_not_finite_is_seen_in_any_order() {
        for terms in [[f64::INFINITY, 1.0, -1e300], [-1e300, f64::INFINITY, 1.0]] {
            assert_eq!(exact_sum(terms), f64::INFINITY);
        }
        assert_eq!(exact_sum([1.0, f64::NEG_INFINITY]), f64::NEG_INFINITY);
        assert!(exact_sum([f64::NAN, 1.0, f64::INFINITY]).is_nan());
        assert!(exact_sum([f64::INFINITY, 1.0, f64::NEG_INFINITY]).is_nan());
    }

    #[test]
    fn many_equal_terms_leave_no_round_off() {
        let count = 1_000_000;
        let found = exact_sum((0..count).map(|_| 0.1));
        // The number next to 0.1 times a million, rounded once: by whole numbers.
        let unit = power_of_two(-56);
        let whole = (0.1 / unit) as i128 * i128::from(count);
        assert_eq!(found, whole as f64 * unit);
        let highest = LOWEST_EXPONENT + 32 * (DIGITS as i32 - 1);
        assert!(
            highest > 1024 + 32,
            "a carry has room above the largest number"
        );
    }
}
