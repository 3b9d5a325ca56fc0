//! Grains that flow: a friction that grows with the rate of shear, mu(I).

use super::linear_elastic::{midpoint, strain};
use super::plastic::{STRAIN, WORK};
use super::tensor::{components, deviator, rotate, second_invariant};
use super::{
    Constant, ConstantDefault, ConstantRange, Increment, InvalidConstant, Isotropic, Law, Particle,
    Readable, Stress,
};
use crate::functions;
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Grains with the friction mu(I) = `mu_s` + (`mu_2` - `mu_s`)/(`I_0`/I + 1) of the inertial number I = `gamma'` d sqrt(`rho_s`/p)
/// (Jop, Forterre and Pouliquen 2006): sqrt(J_2) <= mu(I) p, isochoric flow along the deviator, elastic below `mu_s` p.
///
/// The pressure is p = -K ln J with J the volume over that of the start, and none where J is above 1: grains that have parted bear
/// nothing until they meet again at that volume. With the pressure known the return to the surface is a quadratic equation
/// (Dunatunga and Kamrin 2015).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GranularFlow {
    elasticity: Isotropic,
    static_friction: f64,
    largest_friction: f64,
    inertial_number: f64,
    diameter: f64,
    density: f64,
}

impl GranularFlow {
    /// Law of Young's modulus \[Pa\], Poisson's ratio, friction coefficients of slow and of fast flow, and the inertial number half
    /// way between them; of grains with a diameter \[m\] and a density \[kg/m³\].
    #[must_use]
    pub fn new(
        young: f64,
        poisson: f64,
        [static_friction, largest_friction, inertial_number]: [f64; 3],
        [diameter, density]: [f64; 2],
    ) -> Self {
        Self {
            elasticity: Isotropic::new(young, poisson),
            static_friction,
            largest_friction,
            inertial_number,
            diameter,
            density,
        }
    }

    /// Friction coefficient mu(I).
    #[must_use]
    pub fn friction(&self, inertial_number: f64) -> f64 {
        let share = inertial_number / (self.inertial_number + inertial_number);
        self.static_friction + (self.largest_friction - self.static_friction) * share
    }

    /// Confined modulus \[Pa\].
    fn confined(&self) -> f64 {
        self.elasticity.lambda + 2.0 * self.elasticity.shear
    }
}

impl Law for GranularFlow {
    const CONSTANTS: &'static [Constant] = &[
        super::YOUNG,
        super::POISSON,
        Constant {
            key: "static_friction",
            meaning: "Friction coefficient of grains that hardly flow, mu_s",
            unit: "",
            accepted: ConstantRange::Between(0.0, 2.0),
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "largest_friction",
            meaning: "Friction coefficient of grains that flow fast, mu_2, more than that of slow ones",
            unit: "",
            accepted: ConstantRange::Between(0.0, 5.0),
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "inertial_number",
            meaning: "Inertial number at which the friction is half way between both, I_0",
            unit: "",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::Or(0.279),
        },
        Constant {
            key: "grain_diameter",
            meaning: "Diameter of a grain",
            unit: "m",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "grain_density",
            meaning: "Density of a grain, more than that of the material",
            unit: "kg/m³",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::Or(2500.0),
        },
    ];
    const VARIABLES: &'static [Variable] = &[STRAIN, WORK];
    const YIELDS: bool = true;

    crate::compiled_here!();

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        vec![
            self.elasticity.young,
            self.elasticity.poisson,
            self.static_friction,
            self.largest_friction,
            self.inertial_number,
            self.diameter,
            self.density,
        ]
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        if self.largest_friction > self.static_friction {
            return vec![];
        }
        vec![InvalidConstant {
            key: "largest_friction",
            found: format!(
                "{}, no more than the static friction of {}",
                self.largest_friction, self.static_friction
            ),
            accepted: format!("a number greater than {}", self.static_friction),
        }]
    }

    fn young(&self) -> f64 {
        self.elasticity.young
    }

    fn wave_speed(&self, density: f64) -> f64 {
        (self.confined() / density).sqrt()
    }

    fn initial_volume_ratio(&self, mean_stress: f64) -> f64 {
        libm::exp(mean_stress.min(0.0) / self.elasticity.bulk())
    }

    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let shear = self.elasticity.shear;
        let g = midpoint::<L, D>(&increment.gradient, increment.configuration);
        let (_, mut s) = deviator::<L, D>(&rotate::<L, D>(&g, stress.packed()));
        let (_, e) = deviator::<L, D>(&strain::<L, D>(increment));
        for slot in 0..components(D) {
            s[slot] = L::splat(2.0 * shear).mul_add(e[slot], s[slot]);
        }
        let j = increment.volume / increment.mass * L::splat(increment.density);
        let p = (L::splat(-self.elasticity.bulk()) * functions::ln(j)).max(zero);
        let trial = second_invariant::<L, D>(&s).sqrt();
        let slow = L::splat(self.static_friction) * p;
        let yields = slow.lt(trial);
        if L::bits(yields) != 0 {
            // (trial - tau)(fast - tau) = alpha (tau - slow), from tau = trial - G dt gamma' and the rate at which tau flows.
            let fast = L::splat(self.largest_friction) * p;
            let rate = self.inertial_number / (self.diameter * self.density.sqrt());
            let alpha = L::splat(shear * increment.dt * rate) * p.sqrt();
            let sum = fast + trial + alpha;
            let product = fast.mul_add(trial, alpha * slow);
            let root = (sum * sum - L::splat(4.0) * product).max(zero).sqrt();
            let tau = (product + product) / (sum + root);
            let ratio = L::select(yields, tau / trial, one);
            let flowed = L::select(yields, (trial - tau) * L::splat(1.0 / shear), zero);
            for slot in 0..components(D) {
                s[slot] = s[slot] * ratio;
            }
            // Of the engineering shear, sqrt(2 e : e), that is sqrt(2/3 e : e).
            variables[0] = flowed.mul_add(L::splat(1.0 / 3.0_f64.sqrt()), variables[0]);
            let work = L::select(yields, tau, zero) * flowed;
            variables[1] = work.mul_add(j, variables[1]);
        }
        let out = stress.packed_mut();
        for slot in 0..components(D) {
            out[slot] = if slot < 3 { s[slot] - p } else { s[slot] };
        }
        L::splat(self.confined()) * increment.volume / increment.mass
    }

    fn energy(&self, particle: &Particle<'_>) -> f64 {
        let [xx, yy, zz, yz, xz, xy] = particle.stress;
        let mean = (xx + yy + zz) / 3.0;
        let normal = [xx - mean, yy - mean, zz - mean];
        let invariant =
            0.5 * normal.iter().map(|s| s * s).sum::<f64>() + yz * yz + xz * xz + xy * xy;
        let start = particle.mass / particle.density;
        let j = (particle.volume / start).min(1.0);
        let of_volume = self.elasticity.bulk() * (j * libm::log(j) - j + 1.0) * start;
        of_volume + invariant / (2.0 * self.elasticity.shear) * particle.volume
    }

    /// The plastic work.
    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[1] * particle.mass / particle.density
    }
}

impl Readable for GranularFlow {
    const NAME: &'static str = "mu_i";
    const MEANING: &'static str =
        "grains that flow, with a friction that grows with the rate of shear";

    fn read(values: &[f64], _: &[usize]) -> Self {
        let [young, poisson, slow, fast, number, diameter, density] =
            [0, 1, 2, 3, 4, 5, 6].map(|i| values[i]);
        Self::new(young, poisson, [slow, fast, number], [diameter, density])
    }
}
