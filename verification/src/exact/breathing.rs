//! Free radial vibration of an elastic cylinder (plane strain) or sphere, whose surface carries nothing.
//!
//! Love 1944, section 196 (sphere); Graff 1975, sections 8.1 and 8.2. With x = omega R/c_p, the sphere has
//! x cos x = (1 - x² (c_p/c_s)²/4) sin x and the shape sin(x)/x² - cos(x)/x, the cylinder x J0 = 2 (c_s/c_p)² J1 and the shape J1.

/// The body that breathes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Round {
    /// A cylinder in plane strain.
    Cylinder,
    /// A sphere.
    Sphere,
}

impl Round {
    /// The lowest x = omega R/c_p for a Poisson's ratio.
    #[must_use]
    pub fn lowest(self, poisson: f64) -> f64 {
        // (c_p/c_s)².
        let ratio = 2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson);
        let surface = |x: f64| match self {
            Self::Cylinder => x * libm::j0(x) - 2.0 / ratio * libm::j1(x),
            Self::Sphere => x * libm::cos(x) - (1.0 - 0.25 * ratio * x * x) * libm::sin(x),
        };
        // Below pi there is one root, and nothing at zero but zero itself.
        #[allow(clippy::approx_constant, reason = "a place below pi, not pi itself")]
        let (mut low, mut high) = (0.5, 3.14);
        let sign = surface(low) > 0.0;
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (surface(middle) > 0.0) == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// The shape at k r, and its derivative by k r.
    #[must_use]
    pub fn shape(self, x: f64) -> [f64; 2] {
        match self {
            Self::Cylinder if x < 1e-4 => [0.5 * x, 0.5],
            Self::Cylinder => [libm::j1(x), libm::j0(x) - libm::j1(x) / x],
            Self::Sphere if x < 1e-2 => [x / 3.0 - x * x * x / 30.0, 1.0 / 3.0 - x * x / 10.0],
            Self::Sphere => {
                let (sin, cos) = libm::sincos(x);
                let of = sin / (x * x) - cos / x;
                [of, sin / x - 2.0 * of / x]
            }
        }
    }
}
