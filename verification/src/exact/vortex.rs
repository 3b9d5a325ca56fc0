//! The generalized vortex (verification notes, A3), a manufactured motion in the plane: rings about the origin turn, each
//! by its own angle.
//!
//! `x = Q(alpha) X`, `alpha = A sin(W t) h(R)`, `h = (1 - 16 (R - 1)^2)^n` between the radii 0.75 and 1.25 m and zero
//! beyond, where the body is at rest. Published is n = 2, whose body force jumps at both radii; with n = 3 it does not.
//! The motion keeps the volume (J = 1) and shears by `kappa = R d alpha/dR`. For the neo-Hookean law
//! `P = lambda ln J F^-T + mu (F - F^-T)` the balance `rho0 a = div P + rho0 b` gives, in the basis that has turned with
//! the point,
//!
//! ```text
//! b_r = (mu/rho0) R alpha'^2 - R (d alpha/dt)^2
//! b_t = R d2 alpha/dt2 - (mu/rho0) (3 alpha' + R alpha'')
//! ```
//!
//! No stress acts on the circles of the two radii, so that a ring, a disc and a body that fills more than the disc all
//! move like this. de Vaucorbeil et al. 2020 use it; one published program for it has the sign of `R (d alpha/dt)^2` wrong
//! in one of two components.

use libm::{atan2, cos, hypot, sin, sincos};

/// Inner and outer radius between which rings turn, m.
pub const RADII: [f64; 2] = [0.75, 1.25];

/// The motion. Positions are relative to the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vortex {
    /// Shear modulus mu, Pa.
    pub shear: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Amplitude A of the angle of the middle ring, rad.
    pub amplitude: f64,
    /// Angular frequency W, rad/s.
    pub angular_frequency: f64,
    /// Power n of the profile `h = (1 - 16 (R - 1)^2)^n`, from 2, the published one.
    pub power: i32,
}

/// A material point and how its ring has turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Radius R, m.
    pub radius: f64,
    /// Polar angle at the start, rad.
    pub start: f64,
    /// Angle alpha, rad.
    pub angle: f64,
    /// Its rate, 1/s.
    pub rate: f64,
    /// Its second derivative in time, 1/s^2.
    pub acceleration: f64,
    /// Its derivative along the radius, 1/m.
    pub slope: f64,
    /// Its second derivative along the radius, 1/m^2.
    pub curvature: f64,
}

impl Vortex {
    /// Turn of the ring of the point that began at `x0` (m) at `t` (s).
    #[must_use]
    pub fn turn(&self, x0: [f64; 2], t: f64) -> Turn {
        let radius = hypot(x0[0], x0[1]);
        let [h, slope, curvature] = profile(self.power, radius);
        let w = self.angular_frequency;
        let (sin, cos) = sincos(w * t);
        let a = self.amplitude;
        Turn {
            radius,
            start: atan2(x0[1], x0[0]),
            angle: a * sin * h,
            rate: a * w * cos * h,
            acceleration: -a * w * w * sin * h,
            slope: a * sin * slope,
            curvature: a * sin * curvature,
        }
    }

    /// Displacement, m, of the point that began at `x0` (m).
    #[must_use]
    pub fn displacement(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let half = 0.5 * self.turn(x0, t).angle;
        // Q - 1 without the difference of two numbers that are nearly equal.
        let (c, s) = (-2.0 * sin(half) * sin(half), 2.0 * sin(half) * cos(half));
        [c * x0[0] - s * x0[1], s * x0[0] + c * x0[1]]
    }

    /// Velocity, m/s, of the point that began at `x0` (m).
    #[must_use]
    pub fn velocity(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let turn = self.turn(x0, t);
        turn.in_plane([0.0, turn.radius * turn.rate])
    }

    /// Velocity gradient, 1/s, at the start, when nothing is displaced: `[a][b]` = dv_a/dx_b.
    #[must_use]
    pub fn velocity_gradient(&self, x0: [f64; 2]) -> [[f64; 2]; 2] {
        let turn = self.turn(x0, 0.0);
        // The rate of alpha is A W h at t = 0, and so is its slope that of h.
        let shear = self.amplitude
            * self.angular_frequency
            * profile(self.power, turn.radius)[1]
            * turn.radius;
        turn.tensor([[0.0, -turn.rate], [turn.rate + shear, 0.0]])
    }

    /// Deformation gradient of the point that began at `x0` (m).
    #[must_use]
    pub fn deformation(&self, x0: [f64; 2], t: f64) -> [[f64; 2]; 2] {
        let turn = self.turn(x0, t);
        // Q (1 + kappa e_t e_r) with the basis of the start.
        let simple = Turn { angle: 0.0, ..turn }.tensor([[1.0, 0.0], [turn.shear(), 1.0]]);
        let (sin, cos) = sincos(turn.angle);
        let row = |a: f64, b: f64, column: usize| a * simple[0][column] + b * simple[1][column];
        [
            [row(cos, -sin, 0), row(cos, -sin, 1)],
            [row(sin, cos, 0), row(sin, cos, 1)],
        ]
    }

    /// Body force per mass, m/s^2, on the point that began at `x0` (m), radial and tangential in the basis that has turned
    /// with it.
    #[must_use]
    pub fn turned_body_force(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let turn = self.turn(x0, t);
        let (r, stiffness) = (turn.radius, self.shear / self.density);
        [
            stiffness * r * turn.slope * turn.slope - r * turn.rate * turn.rate,
            r * turn.acceleration - stiffness * (3.0 * turn.slope + r * turn.curvature),
        ]
    }

    /// Body force per mass, m/s^2, on the point that began at `x0` (m).
    #[must_use]
    pub fn body_force(&self, x0: [f64; 2], t: f64) -> [f64; 2] {
        let turned = self.turned_body_force(x0, t);
        self.turn(x0, t).in_plane(turned)
    }

    /// Cauchy stress, Pa, of the point that began at `x0` (m): xx, yy, zz, xy. With J = 1 it is mu (F F^T - 1).
    #[must_use]
    pub fn stress(&self, x0: [f64; 2], t: f64) -> [f64; 4] {
        let turn = self.turn(x0, t);
        let kappa = turn.shear();
        let [[xx, xy], [_, yy]] = turn.tensor([[0.0, kappa], [kappa, kappa * kappa]]);
        [self.shear * xx, self.shear * yy, 0.0, self.shear * xy]
    }
}

impl Turn {
    /// Amount of shear kappa.
    #[must_use]
    pub fn shear(&self) -> f64 {
        self.radius * self.slope
    }

    /// A vector of the basis that has turned with the point, along x and y.
    #[must_use]
    pub fn in_plane(&self, [radial, tangential]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = sincos(self.start + self.angle);
        [
            cos * radial - sin * tangential,
            sin * radial + cos * tangential,
        ]
    }

    /// The same of a tensor.
    fn tensor(&self, t: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let (sin, cos) = sincos(self.start + self.angle);
        let q = [[cos, -sin], [sin, cos]];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let terms = [(0, 0), (0, 1), (1, 0), (1, 1)];
                terms
                    .iter()
                    .map(|&(a, b)| q[i][a] * t[a][b] * q[j][b])
                    .sum()
            })
        })
    }
}

/// `h` and its first two derivatives along the radius.
fn profile(power: i32, radius: f64) -> [f64; 3] {
    if radius <= RADII[0] || radius >= RADII[1] {
        return [0.0; 3];
    }
    let (s, n) = (radius - 1.0, f64::from(power));
    let (k, slope, curvature) = (1.0 - 16.0 * s * s, -32.0 * s, -32.0);
    [
        k.powi(power),
        n * k.powi(power - 1) * slope,
        n * (n - 1.0) * k.powi(power - 2) * slope * slope + n * k.powi(power - 1) * curvature,
    ]
}
