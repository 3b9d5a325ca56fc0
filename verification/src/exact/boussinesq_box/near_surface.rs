//! The part of the Ewald split that is summed over modes.
//!
//! Near the loaded surface the modes decay too slowly to be summed. They are those of the half-space plus a
//! remainder that does decay, like `exp(-2 k H)`. The half-space modes are built from
//! `e^(-kd)/k = 2/sqrt(pi) * integral of exp(-k^2 t^2 - d^2/(4 t^2)) dt over t > 0`, with `d` the depth:
//! `t` above the split length `eta` is kept here and decays like `exp(-k^2 eta^2)`; `t` below it belongs to the images
//! (`image.rs`), where it decays with distance. (Parry 1975 for two-dimensional lattices; the same split applied
//! to `e^(-kd)/k^2` gives the lateral displacement.)

use std::f64::consts::PI;

use libm::exp;

use super::mode::{Medium, Mode};
use crate::exact::special::erfc;

/// `exp(-(k eta)^2)` is below 1e-17 from here on.
const FILTER_END: f64 = 6.3;

/// `(k H)^2 exp(-2 k H)` is below 1e-16 from here on: the base is not felt.
const BASE_END: f64 = 22.0;

/// Filtered modes at one height.
pub(super) struct Split<'a> {
    medium: &'a Medium,
    z: f64,
    depth: f64,
    eta: f64,
}

impl<'a> Split<'a> {
    /// Split of length `eta` (m) at the height `z` (m).
    pub fn new(medium: &'a Medium, z: f64, eta: f64) -> Self {
        Self {
            medium,
            z,
            depth: medium.height - z,
            eta,
        }
    }

    /// Wave number (1/m) above which no mode counts.
    pub fn largest_wave_number(&self) -> f64 {
        (FILTER_END / self.eta).max(BASE_END / self.medium.height)
    }

    /// Box mode minus the half-space mode, plus the filtered half-space mode. Displacements only.
    pub fn mode(&self, k: f64) -> Mode {
        let medium = self.medium;
        let (d, eta) = (self.depth, self.eta);
        let ratio = d / (2.0 * eta);
        let compliance = 0.5 / medium.shear;
        let nu = medium.poisson;
        if k == 0.0 {
            // The images carry a mean value that the series does not have: take it out.
            let potential = 2.0 * eta / PI.sqrt() * exp(-ratio * ratio) - d * erfc(ratio);
            let field = erfc(ratio);
            let vertical = medium.mode(0.0, self.z).vertical
                + compliance * (2.0 * (1.0 - nu) * potential + d * field);
            return Mode {
                vertical,
                ..Mode::default()
            };
        }
        let mut mode = Mode::default();
        if k * medium.height < BASE_END {
            let (layer, half_space) = (medium.mode(k, self.z), medium.half_space_mode(k, d));
            mode.lateral = layer.lateral - half_space.lateral;
            mode.vertical = layer.vertical - half_space.vertical;
        }
        if k * eta < FILTER_END {
            let down = exp(-k * d) * erfc(k * eta - ratio);
            let up = exp(k * d) * erfc(k * eta + ratio);
            let gauss = erfc(ratio) * exp(-k * k * eta * eta);
            // Long parts of e^(-kd)/k, e^(-kd) and k e^(-kd)/k^2.
            let potential = 0.5 * (down + up) / k;
            let field = 0.5 * (down - up);
            let logarithmic = (gauss + 0.5 * (down - up)) / k;
            mode.vertical -= compliance * (2.0 * (1.0 - nu) * potential + d * field);
            mode.lateral += compliance * (k * d * potential - (1.0 - 2.0 * nu) * logarithmic);
        }
        mode
    }
}
