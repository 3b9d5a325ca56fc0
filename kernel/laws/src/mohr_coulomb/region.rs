//! The return to the pyramid of Mohr and Coulomb with tension cut-off in principal stresses: nine regions, each in closed
//! form, chosen by comparison; the map from trial to returned stress is continuous, so that round-off moves nothing between
//! regions.

use crate::Isotropic;
use proctor_kernel::lanes::Lanes;

/// Strength of a group of particles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strength<L> {
    /// sin phi.
    pub sine: L,
    /// 2 c cos phi \[Pa\].
    pub cohesive: L,
    /// sin psi.
    pub flow: L,
    /// Largest tension t \[Pa\].
    pub tension: L,
}

impl<L: Lanes> Strength<L> {
    /// F = (1 + sin phi) a - (1 - sin phi) b - 2 c cos phi of a larger and a smaller principal stress.
    #[inline(always)]
    fn beyond(&self, a: L, b: L) -> L {
        let one = L::splat(1.0);
        (one + self.sine) * a - (one - self.sine) * b - self.cohesive
    }

    /// Distance of principal stresses, the largest first, beyond the surface; not positive inside.
    #[inline(always)]
    pub fn excess(&self, s: &[L; 3]) -> L {
        self.beyond(s[0], s[2]).max(s[0] - self.tension)
    }
}

/// The stress on the surface to which principal trial stresses beyond it return, the largest first.
#[inline(always)]
pub(super) fn returned<L: Lanes>(
    elasticity: &Isotropic,
    strength: &Strength<L>,
    trial: &[L; 3],
) -> [L; 3] {
    let zero = L::splat(0.0);
    let by_shear = sheared(elasticity, strength, trial);
    let by_tension = torn(elasticity, strength, trial);
    let by_both = sheared_and_torn(elasticity, strength, trial);

    // Shear alone keeps the order of the stresses and stays below the tension, or tension alone below the pyramid.
    let disorder = (by_shear[1] - by_shear[0]).max(by_shear[2] - by_shear[1]);
    let not_by_shear = zero.lt(disorder.max(by_shear[0] - strength.tension));
    let not_by_tension = zero.lt(strength.beyond(by_tension[0], by_tension[2]));
    let mut out = *trial;
    for i in 0..3 {
        let otherwise = L::select(not_by_tension, by_both[i], by_tension[i]);
        out[i] = L::select(not_by_shear, otherwise, by_shear[i]);
    }
    out
}

/// Return to the plane of the pyramid, or to the edge that it meets with the next: where the two larger stresses are equal,
/// or the two smaller ones.
#[inline(always)]
fn sheared<L: Lanes>(elasticity: &Isotropic, strength: &Strength<L>, s: &[L; 3]) -> [L; 3] {
    let (one, half) = (L::splat(1.0), L::splat(0.5));
    let lambda2 = L::splat(2.0 * elasticity.lambda);
    let (shear, shear2, shear4) = (
        L::splat(elasticity.shear),
        L::splat(2.0 * elasticity.shear),
        L::splat(4.0 * elasticity.shear),
    );
    let (sine, flow) = (strength.sine, strength.flow);
    let both = sine * flow;
    // C : b for the flow direction b = (1 + sin psi, 0, -(1 - sin psi)).
    let swell = lambda2 * flow;
    let (first, last) = (swell + shear2 * (one + flow), swell - shear2 * (one - flow));
    let plane = shear4 * (one + both) + (lambda2 + lambda2) * both;
    let beyond = strength.beyond(s[0], s[2]);

    let multiplier = beyond / plane;
    let on_plane = [
        s[0] - multiplier * first,
        s[1] - multiplier * swell,
        s[2] - multiplier * last,
    ];

    let right = (lambda2 + lambda2) * both + shear2 * (one - sine) * (one - flow);
    let multiplier = (beyond + strength.beyond(s[1], s[2])) / (plane + right);
    let larger = half * (s[0] + s[1]) - multiplier * (swell + shear * (one + flow));
    let on_right = [larger, larger, s[2] - multiplier * last];

    let left = (lambda2 + lambda2) * both + shear2 * (one + sine) * (one + flow);
    let multiplier = (beyond + strength.beyond(s[0], s[1])) / (plane + left);
    let smaller = half * (s[1] + s[2]) - multiplier * (swell - shear * (one - flow));
    let on_left = [s[0] - multiplier * first, smaller, smaller];

    let is_right = on_plane[0].lt(on_plane[1]);
    let is_left = on_plane[1].lt(on_plane[2]);
    let mut out = on_plane;
    for i in 0..3 {
        out[i] = L::select(
            is_right,
            on_right[i],
            L::select(is_left, on_left[i], on_plane[i]),
        );
    }
    out
}

/// Return to the tension: by one, two or all three stresses.
#[inline(always)]
fn torn<L: Lanes>(elasticity: &Isotropic, strength: &Strength<L>, s: &[L; 3]) -> [L; 3] {
    let half = L::splat(0.5);
    let (lambda, shear) = (elasticity.lambda, elasticity.shear);
    let t = strength.tension;
    let aside = L::splat(lambda / (lambda + 2.0 * shear)) * (s[0] - t);
    let (second, third) = (s[1] - aside, s[2] - aside);
    let two = t.lt(second);
    let aside = L::splat(lambda / (lambda + shear)) * (half * (s[0] + s[1]) - t);
    let second = L::select(two, t, second);
    let third = L::select(two, s[2] - aside, third);
    [t, second, L::select(t.lt(third), t, third)]
}

/// Return to where the tension meets the pyramid: on that line, or at one of its ends.
#[inline(always)]
fn sheared_and_torn<L: Lanes>(
    elasticity: &Isotropic,
    strength: &Strength<L>,
    s: &[L; 3],
) -> [L; 3] {
    let one = L::splat(1.0);
    let (lambda, shear2) = (
        L::splat(elasticity.lambda),
        L::splat(2.0 * elasticity.shear),
    );
    let confined = lambda + shear2;
    let flow = strength.flow;
    let t = strength.tension;
    let swell = (lambda + lambda) * flow;
    let (first, last) = (swell + shear2 * (one + flow), swell - shear2 * (one - flow));
    let smallest = ((one + strength.sine) * t - strength.cohesive) / (one - strength.sine);
    let determinant = first * lambda - last * confined;
    let (at_first, at_last) = (s[0] - t, s[2] - smallest);
    let sheared = (at_first * lambda - at_last * confined) / determinant;
    let torn = (first * at_last - last * at_first) / determinant;
    let second = s[1] - sheared * swell - torn * lambda;
    [t, smallest.max(second.min(t)), smallest]
}

/// The part of the plastic volume strain that opens a gap, where all three principal stresses return to the tension. At the
/// apex of the pyramid it is what is left beside shear: three times the strain d for which e - d is flow of planes of the
/// pyramid, along which a positive principal strain weighs 1/(1 + sin psi) and a negative one 1/(1 - sin psi), and all of them
/// together nothing. Where the tension is cut off before, no plane takes part.
#[inline(always)]
pub(super) fn opened<L: Lanes>(
    elasticity: &Isotropic,
    strength: &Strength<L>,
    trial: &[L; 3],
    after: &[L; 3],
) -> L {
    // Digits that a return to the apex may be off by.
    const NEARLY: f64 = 1.0 - 1e-12;
    let (zero, one, three) = (L::splat(0.0), L::splat(1.0), L::splat(3.0));
    let t = strength.tension;
    let held = after[2].lt(t * L::splat(NEARLY));
    if L::bits(held) == L::bits(one.lt(three)) {
        return zero;
    }
    let mut e = [zero; 3];
    for i in 0..3 {
        e[i] = trial[i] - after[i];
    }
    let mean = (e[0] + e[1] + e[2]) * L::splat(1.0 / 3.0);
    let swollen = mean * L::splat(1.0 / elasticity.bulk());
    for entry in &mut e {
        let sheared = (*entry - mean) * L::splat(0.5 / elasticity.shear);
        *entry = swollen.mul_add(L::splat(1.0 / 3.0), sheared);
    }
    let (more, less) = (one + strength.flow, one - strength.flow);
    // With two negative strains, and with one.
    let first = (less * e[0] + more * (e[1] + e[2])) / (less + more + more);
    let second = (less * (e[0] + e[1]) + more * e[2]) / (less + less + more);
    let beside = three * L::select(first.lt(e[1]), second, first);
    let is_cut = (L::splat(2.0) * strength.sine * t).lt(strength.cohesive * L::splat(NEARLY));
    let opened = L::select(is_cut, swollen, beside).max(zero);
    L::select(held, zero, opened)
}
