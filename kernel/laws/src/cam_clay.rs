//! Modified Cam clay: clay that remembers the pressure that it has borne.

mod ellipse;

use super::linear_elastic::midpoint;
use super::plastic::{ALGORITHMIC, STRAIN, WORK};
use super::tensor::{
    Configuration, Matrix, components, deviator, rotate, second_invariant, volume_ratio,
};
use super::{
    Constant, ConstantDefault, ConstantRange, Increment, InvalidConstant, Law, Particle, Readable,
    Stress,
};
use crate::functions;
use proctor_kernel::lanes::Lanes;
use proctor_kernel::layout::Variable;

/// Largest pressure that the clay has borne \[Pa\], compression positive: the end of its ellipse. 0 until a stress has
/// been
/// seen, from which it follows then.
pub const PRECONSOLIDATION: Variable = Variable::scalar("preconsolidation", "Pa");

/// Plastic volume strain, compression positive as the pressures are.
const COMPRESSION: Variable = Variable::scalar("plastic compression", "");

/// Modified Cam clay (Roscoe and Burland 1968): q²/M² + p (p - p_c) <= 0 with pressure p and `q = sqrt(3 J_2)`,
/// associated flow,
/// and straight lines of ln v against ln p (Butterfield 1979): p rises as exp(e_v/kappa), `p_c` as
/// exp(`e_v^p`/(lambda - kappa)), with volume strains in compression, e_v = -ln det f of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamClay {
    critical_ratio: f64,
    compression: f64,
    swelling: f64,
    poisson: f64,
    shear: f64,
    preconsolidation: f64,
    overconsolidation: f64,
    reference_pressure: f64,
}

impl CamClay {
    /// Law of the stress ratio q/p at the critical state M, the slopes of ln v against ln p in first compression lambda and in
    /// swelling kappa, and Poisson's ratio. It is normally consolidated under the stress at the start.
    #[must_use]
    pub const fn new(critical_ratio: f64, compression: f64, swelling: f64, poisson: f64) -> Self {
        Self {
            critical_ratio,
            compression,
            swelling,
            poisson,
            shear: 0.0,
            preconsolidation: 0.0,
            overconsolidation: 1.0,
            reference_pressure: 1e5,
        }
    }

    /// The same with a shear modulus that stays \[Pa\]; 0 for one in proportion to the pressure.
    #[must_use]
    pub const fn with_shear(self, shear: f64) -> Self {
        Self { shear, ..self }
    }

    /// The same with a preconsolidation pressure at the start \[Pa\]; 0 for one that follows from the stress there.
    #[must_use]
    pub const fn preconsolidated(self, preconsolidation: f64) -> Self {
        Self {
            preconsolidation,
            ..self
        }
    }

    /// The same with an ellipse at the start that is so many times as large as the one on which the stress lies.
    #[must_use]
    pub const fn overconsolidated(self, overconsolidation: f64) -> Self {
        Self {
            overconsolidation,
            ..self
        }
    }

    /// The same with another pressure \[Pa\] at which stiffness before the first step is counted.
    #[must_use]
    pub const fn at_pressure(self, reference_pressure: f64) -> Self {
        Self {
            reference_pressure,
            ..self
        }
    }

    /// Size of the ellipse at the start over that on which an isotropic pressure \[Pa\] lies.
    #[must_use]
    pub fn overconsolidation(&self, pressure: f64) -> f64 {
        if self.preconsolidation > 0.0 {
            self.preconsolidation / pressure
        } else {
            self.overconsolidation
        }
    }

    /// True where the shear modulus grows with the pressure.
    #[must_use]
    pub fn is_proportional(&self) -> bool {
        self.shear == 0.0
    }

    /// Shear modulus over bulk modulus where both grow with the pressure, 3 (1 - 2 nu)/(2 (1 + nu)).
    const fn proportion(&self) -> f64 {
        3.0 * (1.0 - 2.0 * self.poisson) / (2.0 * (1.0 + self.poisson))
    }

    /// Bulk and shear modulus at the reference pressure \[Pa\].
    fn moduli(&self) -> [f64; 2] {
        let bulk = self.reference_pressure.max(self.preconsolidation) / self.swelling;
        let shear = if self.shear > 0.0 {
            self.shear
        } else {
            self.proportion() * bulk
        };
        [bulk, shear]
    }

    /// Shear modulus under a pressure.
    #[inline(always)]
    fn shear_at<L: Lanes>(&self, pressure: L) -> L {
        if self.shear > 0.0 {
            L::splat(self.shear)
        } else {
            L::splat(self.proportion() / self.swelling) * pressure
        }
    }

    /// Preconsolidation pressure of a stress at the start with p and q², where none has been seen.
    #[inline(always)]
    fn first<L: Lanes>(&self, [p, square]: [L; 2]) -> L {
        if self.preconsolidation > 0.0 {
            return L::splat(self.preconsolidation);
        }
        let share = L::splat(self.critical_ratio.powi(-2));
        // A rounding above the stress, so that it lies on the ellipse or within.
        let factor = L::splat(self.overconsolidation * (1.0 + 4.0 * f64::EPSILON));
        factor * ((square / p) * share + p)
    }
}

/// Deviator of the strain increment in the configuration half way, ordered as a law is given a stress.
#[inline(always)]
fn sheared<L: Lanes, const D: usize>(g: &Matrix<L>) -> [L; 6] {
    let half = L::splat(0.5);
    let mut e = [L::splat(0.0); 6];
    for i in 0..D {
        e[i] = g[i][i];
    }
    if D == 2 {
        e[3] = half * (g[0][1] + g[1][0]);
    } else {
        e[3] = half * (g[1][2] + g[2][1]);
        e[4] = half * (g[0][2] + g[2][0]);
        e[5] = half * (g[0][1] + g[1][0]);
    }
    deviator::<L, D>(&e).1
}

impl Law for CamClay {
    const CONSTANTS: &'static [Constant] = &[
        Constant {
            key: "critical_ratio",
            meaning: "Stress ratio q/p at the critical state, M = 6 sin(phi)/(3 - sin(phi)) of an angle of friction",
            unit: "",
            accepted: ConstantRange::Between(0.0, 3.0),
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "compression",
            meaning: "Slope of ln(v) against ln(p) in first compression; that of v against ln(p), over v",
            unit: "",
            accepted: ConstantRange::Between(0.0, 1.0),
            given: ConstantDefault::Needed,
        },
        Constant {
            key: "swelling",
            meaning: "Slope of ln(v) against ln(p) in swelling, less than that of first compression",
            unit: "",
            accepted: ConstantRange::Between(0.0, 0.2),
            given: ConstantDefault::Needed,
        },
        super::POISSON,
        Constant {
            key: "shear_modulus",
            meaning: "Shear modulus that stays, in place of that of Poisson's ratio; 0 for one that grows with the pressure",
            unit: "Pa",
            accepted: ConstantRange::NotNegative,
            given: ConstantDefault::Or(0.0),
        },
        Constant {
            key: "preconsolidation",
            meaning: "Largest pressure before the start; 0 for one that follows from the stress at the start",
            unit: "Pa",
            accepted: ConstantRange::NotNegative,
            given: ConstantDefault::Or(0.0),
        },
        Constant {
            key: "overconsolidation",
            meaning: "Size of the yield surface over that on which the stress at the start lies; 1 where it has borne no more",
            unit: "",
            accepted: ConstantRange::From(1.0, 1000.0),
            given: ConstantDefault::Or(1.0),
        },
        Constant {
            key: "reference_pressure",
            meaning: "Pressure at which its stiffness counts in penalties, damping and absorbing planes",
            unit: "Pa",
            accepted: ConstantRange::Positive,
            given: ConstantDefault::Or(1e5),
        },
    ];
    const VARIABLES: &'static [Variable] =
        &[STRAIN, WORK, ALGORITHMIC, COMPRESSION, PRECONSOLIDATION];
    const YIELDS: bool = true;

    crate::compiled_here!();

    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn values(&self) -> Vec<f64> {
        vec![
            self.critical_ratio,
            self.compression,
            self.swelling,
            self.poisson,
            self.shear,
            self.preconsolidation,
            self.overconsolidation,
            self.reference_pressure,
        ]
    }

    fn problems(&self) -> Vec<InvalidConstant> {
        let mut found = vec![];
        if self.swelling >= self.compression {
            found.push(InvalidConstant {
                key: "swelling",
                found: format!(
                    "{}, no less than the slope in first compression of {}",
                    self.swelling, self.compression
                ),
                accepted: format!("a number less than {}", self.compression),
            });
        }
        if self.preconsolidation > 0.0 && self.overconsolidation != 1.0 {
            found.push(InvalidConstant {
                key: "overconsolidation",
                found: format!(
                    "{} beside a `preconsolidation` of {} Pa",
                    self.overconsolidation, self.preconsolidation
                ),
                accepted: "one of both".to_owned(),
            });
        }
        found
    }

    fn young(&self) -> f64 {
        let [bulk, shear] = self.moduli();
        9.0 * bulk * shear / (3.0 * bulk + shear)
    }

    /// Wave speed at the reference pressure, or at that of preconsolidation where it is larger.
    fn wave_speed(&self, density: f64) -> f64 {
        let [bulk, shear] = self.moduli();
        ((bulk + 4.0 / 3.0 * shear) / density).sqrt()
    }

    /// A stress that is no pressure at the start gives no number.
    #[inline(always)]
    fn update<L: Lanes, const D: usize>(
        &self,
        increment: &Increment<L>,
        stress: &mut Stress<L, D>,
        variables: &mut [L],
    ) -> L {
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let at: Configuration = increment.configuration;
        let g = midpoint::<L, D>(&increment.gradient, at);
        let (mean, start) = deviator::<L, D>(&rotate::<L, D>(&g, stress.packed()));
        let p_start = L::select(mean.lt(zero), -mean, L::splat(f64::NAN));
        let square_of = |s: &[L; 6]| L::splat(3.0) * second_invariant::<L, D>(s);
        let square_start = square_of(&start);
        let mut before = variables[4];
        let seen = zero.lt(before);
        if !L::bits(seen) & L::bits(L::first(L::WIDTH)) != 0 {
            before = L::select(seen, before, self.first([p_start, square_start]));
        }
        let compressed = -functions::ln(volume_ratio::<L, D>(&increment.gradient, at));
        let mut p = p_start * functions::exp(compressed * L::splat(1.0 / self.swelling));
        let shear = self.shear_at(p_start);
        let e = sheared::<L, D>(&g);
        let mut s = start;
        for slot in 0..components(D) {
            s[slot] = (shear + shear).mul_add(e[slot], start[slot]);
        }
        let square = square_of(&s);
        let share = L::splat(self.critical_ratio.powi(-2));
        let beyond = square.mul_add(share, p * (p - before));
        // A stress on the ellipse stays there, but for round-off.
        let yields = (L::splat(8.0 * f64::EPSILON) * before * before).lt(beyond);
        let (mut after, mut plastic, mut square) = (before, zero, square);
        let j = increment.volume / increment.mass * L::splat(increment.density);
        if L::bits(yields) != 0 {
            let back = self.returned([p, square], before, shear, yields);
            let lost = L::splat(f64::NAN);
            p = L::select(yields, L::select(back.found, back.pressure, lost), p);
            after = L::select(yields, back.preconsolidation, before);
            let ratio = L::select(yields, back.ratio, one);
            for slot in 0..components(D) {
                s[slot] = s[slot] * ratio;
            }
            square = square * ratio * ratio;
            let strain = L::select(yields, back.strain, zero);
            let swollen = L::select(yields, back.compression, zero);
            variables[0] = variables[0] + strain;
            variables[3] = variables[3] + swollen;
            // Of p the share that is not stored: see `stored`.
            let of_volume = p * swollen * L::splat(1.0 / (1.0 - self.swelling));
            plastic = (L::select(yields, back.work, zero) + of_volume) * j;
            variables[1] = variables[1] + plastic;
        }
        // The trapezoidal work of the step, less what is stored and what is plastic.
        let (mut work, mut sheared) = ((p_start + p) * compressed, zero);
        for slot in 0..components(D) {
            let twice = L::splat(if slot < 3 { 1.0 } else { 2.0 });
            sheared = (twice * (start[slot] + s[slot])).mul_add(e[slot], sheared);
        }
        let before = j * functions::exp(compressed);
        // With the volume half way.
        work = L::splat(0.25) * (work + sheared) * (j + before);
        let now = self.stored([p, square], self.shear_at(p)) * j;
        let then = self.stored([p_start, square_start], shear) * before;
        variables[2] = variables[2] + (work - plastic - (now - then));
        variables[4] = after;
        let out = stress.packed_mut();
        for slot in 0..components(D) {
            out[slot] = if slot < 3 { s[slot] - p } else { s[slot] };
        }
        let bulk = p * L::splat(1.0 / self.swelling);
        let stiffness = L::splat(4.0 / 3.0).mul_add(self.shear_at(p), bulk);
        stiffness * increment.volume / increment.mass
    }

    fn energy(&self, particle: &Particle<'_>) -> f64 {
        let [xx, yy, zz, yz, xz, xy] = particle.stress;
        let mean = (xx + yy + zz) / 3.0;
        let normal = (xx - mean).powi(2) + (yy - mean).powi(2) + (zz - mean).powi(2);
        let square = 1.5 * (normal + 2.0 * (yz * yz + xz * xz + xy * xy));
        let p = (-mean).max(0.0);
        let shear = if self.shear > 0.0 {
            self.shear
        } else {
            self.proportion() * p / self.swelling
        };
        let of_shear = if shear > 0.0 {
            square / (6.0 * shear)
        } else {
            0.0
        };
        (p * self.swelling / (1.0 - self.swelling) + of_shear) * particle.volume
    }

    /// The plastic work.
    fn dissipated(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[1] * particle.mass / particle.density
    }

    fn algorithmic(&self, particle: &Particle<'_>) -> f64 {
        particle.variables[2] * particle.mass / particle.density
    }
}

impl CamClay {
    /// Energy per volume \[J/m³\] under p and q²: that which swelling to no pressure gives back, p kappa/(1 - kappa) of
    /// the
    /// volume as it is, since p goes as the volume to the power of -1/kappa; and q²/(6 G).
    #[inline(always)]
    fn stored<L: Lanes>(&self, [p, square]: [L; 2], shear: L) -> L {
        let of_shear = square / (L::splat(6.0) * shear);
        p.mul_add(L::splat(self.swelling / (1.0 - self.swelling)), of_shear)
    }
}

impl Readable for CamClay {
    const NAME: &'static str = "cam_clay";
    const MEANING: &'static str = "clay that hardens as it is compressed and has a critical state";

    fn read(values: &[f64], _: &[usize]) -> Self {
        Self::new(values[0], values[1], values[2], values[3])
            .with_shear(values[4])
            .preconsolidated(values[5])
            .overconsolidated(values[6])
            .at_pressure(values[7])
    }
}
