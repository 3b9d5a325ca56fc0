//! The load that a strip footing carries on a half-space without weight: Prandtl 1920 for a solid without friction, Reissner
//! 1924 with friction and a pressure on the surface beside the footing.
//!
//! Both are exact for a perfectly plastic solid whose flow is normal to the surface of Mohr and Coulomb: below the footing
//! lies a wedge at 45° + phi/2, beside the footing one at 45° - phi/2, and between the two a fan bounded by a logarithmic
//! spiral. Stresses in the whole half-space that nowhere exceed the strength give the same load as the motion of these
//! wedges, whether the footing is rough or smooth, and whatever the elasticity before.

use libm::{cos, exp, tan};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Ground below a strip footing, without weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Angle of friction phi, degrees.
    pub friction: f64,
    /// Cohesion c, Pa: the shear strength where there is no friction.
    pub cohesion: f64,
    /// Pressure q on the surface beside the footing, Pa.
    pub surcharge: f64,
}

impl Ground {
    fn angle(&self) -> f64 {
        self.friction.to_radians()
    }

    /// Factor of the surcharge, N_q = exp(pi tan phi) tan²(45° + phi/2).
    #[must_use]
    pub fn of_surcharge(&self) -> f64 {
        let wedge = tan(FRAC_PI_4 + 0.5 * self.angle());
        exp(PI * tan(self.angle())) * wedge * wedge
    }

    /// Factor of the cohesion, N_c = (N_q - 1) cot phi; 2 + pi without friction.
    #[must_use]
    pub fn of_cohesion(&self) -> f64 {
        if self.friction == 0.0 {
            2.0 + PI
        } else {
            (self.of_surcharge() - 1.0) / tan(self.angle())
        }
    }

    /// Mean pressure below the footing at which the ground gives way, c N_c + q N_q, Pa.
    #[must_use]
    pub fn bearing(&self) -> f64 {
        self.cohesion * self.of_cohesion() + self.surcharge * self.of_surcharge()
    }

    /// Width and depth of the ground that moves beside the middle of a footing, over the width of the footing: the wedge below
    /// it has sides of 1/(2 cos(45° + phi/2)), which the spiral lengthens by exp(tan(phi) times its angle).
    #[must_use]
    pub fn reach(&self) -> [f64; 2] {
        let (phi, slope) = (self.angle(), tan(self.angle()));
        let side = 0.5 / cos(FRAC_PI_4 + 0.5 * phi);
        let last = side * exp(FRAC_PI_2 * slope);
        let aside = 0.5 + 2.0 * last * cos(FRAC_PI_4 - 0.5 * phi);
        // The tangent of the spiral is level where its radius stands at phi to the vertical.
        let deep = side * exp((FRAC_PI_4 + 0.5 * phi) * slope) * cos(phi);
        [aside, deep]
    }
}
