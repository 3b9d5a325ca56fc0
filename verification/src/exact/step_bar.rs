//! A bar that is pressed suddenly and stays pressed: d'Alembert's waves (verification notes, A7).
//!
//! The end `x = 0` is held, the end `x = L` carries the pressure p from t = 0. With the distance `y = L - x` from the
//! loaded end, a front runs in with c, brings the velocity p/(rho c) and the stress -p, doubles the stress at the held
//! end, and comes back:
//!
//! ```text
//! u = -p/(rho c) sum_n (-1)^n ((t - (2 n L + y)/c)_+ - (t - (2 (n + 1) L - y)/c)_+)
//! ```
//!
//! Linear theory: strains p/E must be small.

/// The bar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepBar {
    /// Length L, m.
    pub length: f64,
    /// Modulus E along the bar, Pa.
    pub modulus: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Pressure p on the end, Pa.
    pub pressure: f64,
}

impl StepBar {
    /// Wave speed `c = sqrt(E/rho)`, m/s.
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        (self.modulus / self.density).sqrt()
    }

    /// Time that a wave takes along the bar, s.
    #[must_use]
    pub fn transit(&self) -> f64 {
        self.length / self.wave_speed()
    }

    /// Speed of what the front has passed, p/(rho c), m/s.
    #[must_use]
    pub fn speed_behind_the_front(&self) -> f64 {
        self.pressure / (self.density * self.wave_speed())
    }

    /// Displacement, m, at `x` (m) and `t` (s).
    #[must_use]
    pub fn displacement(&self, x: f64, t: f64) -> f64 {
        let ramps = self.fronts(x, t, |since| since);
        -self.speed_behind_the_front() * (ramps[0] - ramps[1])
    }

    /// Velocity, m/s.
    #[must_use]
    pub fn velocity(&self, x: f64, t: f64) -> f64 {
        let passed = self.fronts(x, t, |_| 1.0);
        -self.speed_behind_the_front() * (passed[0] - passed[1])
    }

    /// Axial stress, Pa, tension positive.
    #[must_use]
    pub fn stress(&self, x: f64, t: f64) -> f64 {
        let passed = self.fronts(x, t, |_| 1.0);
        -self.pressure * (passed[0] + passed[1])
    }

    /// Sums over the fronts that have passed `x`, those that come from the loaded end and those from the held one, with the
    /// signs of the sum, of a function of the time since (s).
    fn fronts(&self, x: f64, t: f64, of: impl Fn(f64) -> f64) -> [f64; 2] {
        let c = self.wave_speed();
        let (mut sums, mut sign) = ([0.0; 2], 1.0);
        for way in (0_u32..).map(|n| 2.0 * self.length * f64::from(n)) {
            let ways = [way + self.length - x, way + self.length + x];
            let since = ways.map(|way| t - way / c);
            if since[0] <= 0.0 {
                break;
            }
            for (sum, since) in sums.iter_mut().zip(since) {
                if since > 0.0 {
                    *sum += sign * of(since);
                }
            }
            sign = -sign;
        }
        sums
    }
}
