//! Water in the pores of a material: its constants, and what follows from them.

use super::{History, Vector};

/// Water in the pores of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoreWater {
    /// Porosity at the start, above 0 and below 1.
    pub porosity: f64,
    /// Density of the grains \[kg/m³\].
    pub grain_density: f64,
    /// Density of the water \[kg/m³\].
    pub density: f64,
    /// Bulk modulus of the water \[Pa\].
    pub bulk: f64,
    /// Hydraulic conductivity per axis at the start \[m/s\].
    pub conductivity: Vector,
    /// Law by which it follows the volume of the skeleton.
    pub permeability: Permeability,
    /// Gravity for which the conductivity was measured \[m/s²\]: the permeability over the viscosity is conductivity over
    /// density and this gravity, whatever gravity acts.
    pub conductivity_gravity: f64,
}

/// Law by which the conductivity of a skeleton follows its volume, J times that of the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Permeability {
    /// It stays as it was.
    #[default]
    Constant,
    /// It is k J² (Xie and Leo 2004).
    Square,
    /// It is k J² (n/`n_0`)³, which is in proportion to n³/(1-n)² (Kozeny 1927; Carman 1937).
    KozenyCarman,
}

/// Pressure of the pore water at a boundary plane of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanePressure {
    /// The same everywhere, compression positive \[Pa\].
    Uniform(f64),
    /// That of water at rest below a level, and none above it: the level in the first component \[m\], a coordinate along the
    /// axis that most of gravity is along.
    Level(History),
}

/// Water at rest that stands beside bodies and presses on their surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct StandingWater {
    /// Its level in the first component \[m\], a coordinate along the axis of gravity.
    pub level: History,
    /// Density \[kg/m³\].
    pub density: f64,
    /// Identifiers of the bodies that it presses on; empty for all.
    pub bodies: Vec<i64>,
    /// The side of the bodies on which it stands; `None` all around.
    pub shore: Option<Shore>,
}

/// The side on which water stands, and where its pressure ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shore {
    /// Axis along which the water is on one side.
    pub axis: usize,
    /// 0 for the water at lower coordinates, 1 for that at higher ones.
    pub side: usize,
    /// Coordinates between which the pressure fades \[m\]: a part of the bodies that has no surface below the level.
    pub between: [f64; 2],
}

impl Shore {
    /// Share of the pressure at a coordinate along the axis.
    #[must_use]
    pub fn share(&self, x: f64) -> f64 {
        let [from, to] = self.between;
        let s = ((x - from) / (to - from)).clamp(0.0, 1.0);
        let rising = s * s * (3.0 - 2.0 * s);
        if self.side == 0 { 1.0 - rising } else { rising }
    }
}

/// Least and largest porosity of a particle.
pub const POROSITIES: [f64; 2] = [0.01, 0.99];

impl PoreWater {
    /// Density of the skeleton without water at the start \[kg/m³\].
    #[must_use]
    pub fn dry_density(&self) -> f64 {
        (1.0 - self.porosity) * self.grain_density
    }

    /// Porosity of a particle with this mass of grains \[kg\] and this volume \[m³\].
    #[must_use]
    #[inline]
    pub fn porosity_of(&self, mass: f64, volume: f64) -> f64 {
        1.0 - mass / (self.grain_density * volume)
    }

    /// Drag along the first axis on water in soil that is nothing but pores, with the conductivity of the start, per volume and
    /// velocity between water and skeleton \[N s/m⁴\]: `rho_w` g / k. Soil of a porosity n has n² of it, over what the law of
    /// permeability makes of k.
    #[must_use]
    pub(crate) fn drag_scale(&self) -> f64 {
        self.density * self.conductivity_gravity / self.conductivity[0]
    }

    /// Drag along each axis over that along the first.
    #[must_use]
    pub fn drag_ratios(&self) -> Vector {
        self.conductivity.map(|k| self.conductivity[0] / k)
    }

    /// Speed of the fast compression wave in soil whose skeleton has waves of a speed of which this is the square
    /// \[m²/s²\], where water and skeleton do not drag each other \[m/s\].
    ///
    /// c1² = (a + sqrt(a² - 4 d))/2 with a = `E_c`/((1-n) `rho_s`) + (1-n) `K_w`/(n `rho_s`) + `K_w`/`rho_w` and
    /// d = `E_c` `K_w`/((1-n) `rho_s` `rho_w`): the larger root of the two coupled waves (Biot 1956). Drag lowers it, so that a
    /// step that it bounds is stable for every conductivity.
    #[must_use]
    pub fn fast_speed(&self, skeleton_squared: f64, porosity: f64) -> f64 {
        let water = self.bulk / self.density;
        let coupled = (1.0 - porosity) * self.bulk / (porosity * self.grain_density);
        let a = skeleton_squared + coupled + water;
        let d = skeleton_squared * water;
        let root = (a * a - 4.0 * d).max(0.0).sqrt();
        (0.5 * (a + root)).sqrt()
    }
}
