//! Return of a stress to the ellipse of Modified Cam clay.

use super::CamClay;
use crate::functions;
use proctor_kernel::lanes::Lanes;

/// Most steps of Newton's method for the return. On states of the ellipse strained by 1e-2 they leave round-off of `p_c²`.
const ITERATIONS: usize = 6;
/// |f| over `p_c²` at which a particle takes no further step: each one squares it, so that this is round-off.
const SETTLED: f64 = 1e-14;
/// Largest |f| over `p_c²` after them: beyond, a step strained the clay too far, and has no stress.
const TOLERANCE: f64 = 1e-9;

/// Largest magnitude of an argument of [`short_exp`].
const SHORT: f64 = 1.0 / 64.0;

/// e^x within two units in the last place, for |x| < [`SHORT`]: of x^7/7! there is less than half a unit.
#[inline(always)]
fn short_exp<L: Lanes>(x: L) -> L {
    let mut sum = L::splat(1.0 / 720.0);
    for inverse in [120.0, 24.0, 6.0, 2.0, 1.0, 1.0] {
        sum = sum.mul_add(x, L::splat(1.0 / inverse));
    }
    sum
}

/// Result of a return to the ellipse.
pub(super) struct EllipseReturn<L: Lanes> {
    /// Pressure \[Pa\].
    pub pressure: L,
    /// Preconsolidation pressure \[Pa\].
    pub preconsolidation: L,
    /// Ratio of the deviator to that of the trial stress.
    pub ratio: L,
    /// Plastic volume strain, compression positive.
    pub compression: L,
    /// Plastic strain.
    pub strain: L,
    /// Work of the deviator on it \[Pa\].
    pub work: L,
    /// Lanes in which Newton's method converged.
    pub found: L::Mask,
}

impl CamClay {
    /// The return of a trial pressure and square of the deviator to the ellipse, of the lanes that yield. Each goes as far as it needs, whatever
    /// those beside it need.
    #[inline(always)]
    pub(super) fn returned<L: Lanes>(
        &self,
        trial: [L; 2],
        before: L,
        shear: L,
        yields: L::Mask,
    ) -> EllipseReturn<L> {
        let (zero, one, two) = (L::splat(0.0), L::splat(1.0), L::splat(2.0));
        let hardens = 1.0 / (self.compression - self.swelling);
        let (of_hardening, of_swelling) = (L::splat(hardens), L::splat(1.0 / self.swelling));
        let share = self.critical_ratio.powi(-2);
        // Pressures over that of preconsolidation before.
        let scale = one / before;
        let p_trial = trial[0] * scale;
        let softness = L::splat(6.0 * share) * shear * scale;
        let square_trial = L::splat(share) * trial[1] * scale * scale;
        // First the radial return to the ellipse as it was, less a tenth: Newton's method comes from inside.
        let within = p_trial.min(L::splat(0.5));
        let room = within * (one - within);
        let radial = (L::splat(0.81) * square_trial / room).sqrt().max(one);
        let (mut x, mut g) = (zero, (radial - one) / softness);
        let mut off = one;
        let mut last = zero;
        let mut state = [p_trial, one, square_trial, one];
        for turn in 0..=ITERATIONS {
            let [mut p, mut most, ..] = state;
            if turn > 0 {
                // The last step is mostly so short that a short series has all digits.
                let steps = [-(last * of_swelling), last * of_hardening];
                let is_short = (steps[0].abs().max(steps[1].abs())).lt(L::splat(SHORT));
                p = p * short_exp(steps[0]);
                most = most * short_exp(steps[1]);
                if L::bits(yields) & !L::bits(is_short) != 0 {
                    let whole = p_trial * functions::exp(-(x * of_swelling));
                    p = L::select(is_short, p, whole);
                    most = L::select(is_short, most, functions::exp(x * of_hardening));
                }
            }
            let stretch = softness.mul_add(g, one);
            let ratio = one / stretch;
            let square = square_trial * ratio * ratio;
            state = [p, most, square, ratio];
            let slope = p + p - most;
            let f = p.mul_add(p - most, square);
            let flow = x - g * slope;
            off = f.abs().max(flow.abs());
            let settled = off.lt(L::splat(SETTLED));
            if turn == ITERATIONS || L::bits(yields) & !L::bits(settled) == 0 {
                break;
            }
            let f_x = -(p * of_swelling).mul_add(slope, p * most * of_hardening);
            let f_g = -(two * square * softness * ratio);
            let flow_x = g.mul_add((two * p).mul_add(of_swelling, most * of_hardening), one);
            let flow_g = -slope;
            let turned = one / (f_x * flow_g - f_g * flow_x);
            last = L::select(settled, zero, -(turned * (f * flow_g - f_g * flow)));
            x = x + last;
            g = L::select(settled, g, g - turned * (f_x * flow - f * flow_x));
        }
        let [p, most, square, ratio] = state;
        EllipseReturn {
            pressure: p * before,
            preconsolidation: most * before,
            ratio,
            compression: x,
            // Along the deviator sqrt(2/3 e : e) is 2 g q/M².
            strain: two * g * (square * L::splat(share)).sqrt(),
            work: two * g * square * before,
            found: off.lt(L::splat(TOLERANCE)),
        }
    }
}
