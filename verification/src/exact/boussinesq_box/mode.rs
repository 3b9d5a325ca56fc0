//! One cosine mode of the elastic layer on rollers: its profile over the height.

use libm::{exp, expm1};

/// Elastic constants and height of the box.
#[derive(Debug, Clone)]
pub(super) struct Medium {
    /// Poisson's ratio.
    pub poisson: f64,
    /// Shear modulus G, Pa.
    pub shear: f64,
    /// Lamé's first constant, Pa.
    pub lambda: f64,
    /// Modulus of laterally confined compression, Pa.
    pub confined: f64,
    /// Height H, m.
    pub height: f64,
}

/// Profiles of one mode at one height, per pascal of its surface pressure.
///
/// With `c = (kx, ky)/k`: `u_x = lateral c_x sin cos`, `u_y = lateral c_y cos sin`, `u_z = vertical cos cos`,
/// `s_zz = pressure cos cos`, `s_xz = shear c_x sin cos`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Mode {
    /// Amplitude of the lateral displacement, m/Pa.
    pub lateral: f64,
    /// Amplitude of the vertical displacement, m/Pa.
    pub vertical: f64,
    /// Amplitude of `s_zz`, 1.
    pub pressure: f64,
    /// Amplitude of the shear on horizontal planes, 1.
    pub shear: f64,
}

impl Mode {
    /// Coefficients of `u_x, u_y, u_z` for the direction `c` of the wave vector.
    pub fn displacement_coefficients(&self, c: [f64; 2]) -> [f64; 3] {
        [self.lateral * c[0], self.lateral * c[1], self.vertical]
    }
}

impl Medium {
    pub fn new(young: f64, poisson: f64, height: f64) -> Self {
        let shear = young / (2.0 * (1.0 + poisson));
        let lambda = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
        Self {
            poisson,
            shear,
            lambda,
            confined: lambda + 2.0 * shear,
            height,
        }
    }

    /// The mode of wave number `k` (1/m) at height `z` (m): verification notes, section 2.
    ///
    /// Written with `S = (1 - e^(-2kz))/2` and `C = (1 + e^(-2kz))/2`, so that only decaying exponentials appear.
    pub fn mode(&self, k: f64, z: f64) -> Mode {
        if k == 0.0 {
            return Mode {
                vertical: -z / self.confined,
                pressure: -1.0,
                ..Mode::default()
            };
        }
        let (s, c) = (-0.5 * expm1(-2.0 * k * z), 0.5 * (1.0 + exp(-2.0 * k * z)));
        let kz = k * z;
        let kh = k * self.height;
        let fade = exp(-2.0 * kh);
        let (s_h, c_h) = (-0.5 * expm1(-2.0 * kh), 0.5 * (1.0 + fade));
        let scale = exp(-k * (self.height - z)) / (s_h * c_h + kh * fade);
        let compliance = scale / (2.0 * self.shear * k);
        let nu = self.poisson;
        Mode {
            lateral: compliance * ((kh * c_h - (1.0 - 2.0 * nu) * s_h) * c - kz * s_h * s),
            vertical: -compliance * ((2.0 * (1.0 - nu) * s_h + kh * c_h) * s - kz * s_h * c),
            pressure: -scale * ((s_h + kh * c_h) * c - kz * s_h * s),
            shear: scale * (kh * c_h * s - kz * s_h * c),
        }
    }

    /// The same mode in the half-space, `depth` (m) below the surface, `k > 0`: what [`Self::mode`] becomes for an infinite height.
    pub fn half_space_mode(&self, k: f64, depth: f64) -> Mode {
        let kd = k * depth;
        let fade = exp(-kd);
        let compliance = fade / (2.0 * self.shear * k);
        let nu = self.poisson;
        Mode {
            lateral: compliance * (kd - (1.0 - 2.0 * nu)),
            vertical: -compliance * (kd + 2.0 * (1.0 - nu)),
            pressure: -fade * (1.0 + kd),
            shear: fade * kd,
        }
    }

    /// Coefficients of `[xx, yy, zz, xy, yz, zx]` for the direction `c` of the wave vector.
    ///
    /// Volumetric strain from `s_zz = M u_z' + lambda k lateral`, then Hooke's law.
    pub fn stress_coefficients(&self, mode: &Mode, k: f64, c: [f64; 2]) -> [f64; 6] {
        let spread = k * mode.lateral;
        let volume_strain = spread + (mode.pressure - self.lambda * spread) / self.confined;
        let mean = self.lambda * volume_strain;
        let two_g = 2.0 * self.shear * spread;
        [
            mean + two_g * c[0] * c[0],
            mean + two_g * c[1] * c[1],
            mode.pressure,
            -two_g * c[0] * c[1],
            mode.shear * c[1],
            mode.shear * c[0],
        ]
    }
}
