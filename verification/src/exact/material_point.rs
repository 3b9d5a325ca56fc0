//! Closed forms of laws along paths of strain, at a point.
//!
//! Source: soil notes, 2.1 to 2.5. Strains are logarithmic, axes do not turn, tension is positive. A perfectly plastic
//! deviator that is sheared at a constant rate turns towards the rate: with the angle psi between them,
//! `tan(psi/2) = tan(psi_0/2) exp(-2 G |e| / R)` (Krieg and Krieg 1977), which is a hyperbolic tangent for the part along the
//! rate and a hyperbolic secant for the part across. A soil that does not dilate keeps its mean stress in shear, and does the
//! same in the plane of shear.

/// Shear stress and what is left of the deviator across it, over its value at first, of a perfectly plastic material that yields
/// without shear stress and is then sheared by an angle: `k tanh(G g/k)` and `sech(G g/k)`, k the shear strength (Pa), G the
/// shear modulus (Pa).
#[must_use]
pub fn turned(shear: f64, strength: f64, angle: f64) -> [f64; 2] {
    let way = shear * angle / strength;
    [strength * libm::tanh(way), 1.0 / libm::cosh(way)]
}

/// Shear to an angle and back by `back`, of a material that hardens alike in all directions by H (Pa) per plastic strain: the
/// shear stress (Pa). It yields at the shear stress `limit` (Pa); the slope beyond is `G H/(3 G + H)`, and the way back is
/// elastic for twice the stress that was reached.
#[must_use]
pub fn to_and_fro([shear, hardening]: [f64; 2], limit: f64, there: f64, back: f64) -> f64 {
    let slope = shear * hardening / (3.0 * shear + hardening);
    let reached = if there <= limit / shear {
        return shear * (there - back);
    } else {
        limit + slope * (there - limit / shear)
    };
    let elastic = 2.0 * reached / shear;
    if back <= elastic {
        reached - shear * back
    } else {
        -reached - slope * (back - elastic)
    }
}

/// A soil without dilation under normal stresses in the plane of shear (Pa, tension positive) that is sheared in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearedSoil {
    /// Shear modulus, Pa.
    pub shear: f64,
    /// Mean of the normal stresses in the plane, which stays, Pa.
    pub mean: f64,
    /// Half of their difference at the start, Pa.
    pub apart: f64,
    /// Radius of the circle of Mohr at yield, `c cos(phi) - mean sin(phi)`, Pa.
    pub radius: f64,
}

impl ShearedSoil {
    /// Strength from the normal stresses (Pa), the angle of friction (degrees) and the cohesion (Pa).
    #[must_use]
    pub fn new(shear: f64, [x, y]: [f64; 2], friction: f64, cohesion: f64) -> Self {
        let (sine, cosine) = libm::sincos(friction.to_radians());
        let mean = 0.5 * (x + y);
        Self {
            shear,
            mean,
            apart: 0.5 * (x - y),
            radius: cohesion * cosine - mean * sine,
        }
    }

    /// The angle at which it yields.
    #[must_use]
    pub fn first(&self) -> f64 {
        (self.radius * self.radius - self.apart * self.apart).sqrt() / self.shear
    }

    /// Normal stresses and shear stress (Pa) at an angle, `tau = R tanh(G (g - g_y)/R + artanh(tau_y/R))`.
    #[must_use]
    pub fn at(&self, angle: f64) -> [f64; 3] {
        let first = self.first();
        if angle <= first {
            let [x, y] = [self.mean + self.apart, self.mean - self.apart];
            return [x, y, self.shear * angle];
        }
        let begun = libm::atanh(self.shear * first / self.radius);
        let way = self.shear * (angle - first) / self.radius + begun;
        let apart = self.radius / libm::cosh(way) * self.apart.signum();
        [
            self.mean + apart,
            self.mean - apart,
            self.radius * libm::tanh(way),
        ]
    }
}

/// Isotropic soil that dilates and is sheared at constant volume: normal stress in the plane and shear stress (Pa). It starts
/// at a mean stress (Pa, tension positive); with `X = sin(phi) sin(psi) (lambda + G)` the shear stress grows by
/// `G X/(G + X)` per angle once it yields, and the mean stress follows the yield surface.
#[must_use]
pub fn held_dilation(
    [lambda, shear]: [f64; 2],
    mean: f64,
    [friction, cohesion, dilation]: [f64; 3],
    angle: f64,
) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(friction.to_radians());
    let limit = cohesion * cosine - mean * sine;
    let first = limit / shear;
    if angle <= first {
        return [mean, shear * angle];
    }
    let x = sine * libm::sin(dilation.to_radians()) * (lambda + shear);
    let tau = limit + shear * x / (shear + x) * (angle - first);
    [(cohesion * cosine - tau) / sine, tau]
}

/// Shear stress (Pa) of Bingham's fluid that is sheared from rest at a rate (1/s): elastic with G (Pa) up to the limit (Pa) at
/// the time t_y, then `limit + mu rate (1 - exp(-G (t - t_y)/mu))`.
#[must_use]
pub fn bingham([shear, viscosity, limit]: [f64; 3], rate: f64, time: f64) -> f64 {
    let first = limit / (shear * rate);
    if time <= first {
        return shear * rate * time;
    }
    limit - viscosity * rate * libm::expm1(-shear * (time - first) / viscosity)
}
