//! A strip footing on ground without weight: the ground that moves, the way of the footing, its load and the gates of it.

use super::moved::smooth;
use super::press::Press;
use crate::cases::prelude::*;
use crate::exact::bearing::Ground;

/// Name of the load among the quantities.
pub const LOAD: &str = "load of the footing";
/// Looks at the load on the way; it is judged over the last of these intervals, in which the footing goes a ten thousandth
/// of its way.
const LOOKS: u32 = 40;

/// A strength that breaks the gates of the load from above, and one that breaks those from below.
pub const WRONG_STRENGTH: Wrong =
    Wrong::factor("strength", 0.75).breaks(|gate| gate.ends_with(LOAD) && !gate.contains("order"));
/// The other one.
pub const STRONGER: Wrong =
    Wrong::factor("strength", 1.4).breaks(|gate| gate.contains("footing over the exact one"));

/// Half of a footing in plane strain, and the elasticity of the ground.
#[derive(Clone, Copy, Debug)]
pub struct Footing {
    /// Width, B \[m\].
    pub width: f64,
    /// Strength of the ground, and the pressure beside the footing.
    pub ground: Ground,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Time of the way \[s\].
    pub time: f64,
}

impl Footing {
    /// Width of the half and depth of the ground \[m\], in halves of B: what moves, a tenth more aside and a half below.
    pub fn extent(&self) -> [f64; 2] {
        let [aside, deep] = self.ground.reach();
        [1.1 * aside, 1.5 * deep].map(|reach| 0.5 * self.width * (2.0 * reach).ceil())
    }

    /// Distance that the footing goes \[m\]: three to four times what elastic ground would let it sink at the exact load.
    pub fn way(&self) -> f64 {
        let load = self.ground.bearing() - self.ground.surcharge;
        let times = if self.ground.friction == 0.0 {
            3.0
        } else {
            4.0
        };
        times * load * self.width * (1.0 - self.poisson.powi(2)) / self.young
    }

    /// Nodes at the surface that press from rest to rest, on a mesh with cells of this size \[m\].
    pub fn press(&self, cell: f64) -> Press {
        let [_, deep] = self.extent();
        Press::from_rest(deep, cell, [self.way(), self.time]).up_to(0.5 * self.width)
    }

    /// Presses the footing down: its mean pressure at the end \[Pa\], and that over the settlement beside the exact one, over a
    /// strength \[Pa\].
    ///
    /// # Errors
    /// If a step fails.
    pub fn sink(
        &self,
        press: &Press,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
        [exact, strength]: [f64; 2],
        label: &str,
    ) -> Result<(f64, Curve), Failure> {
        let (mut points, mut pressure) = (vec![], f64::NAN);
        let share = |look: u32| f64::from(look) / f64::from(LOOKS);
        let times = (1..=LOOKS).map(|look| share(look) * self.time);
        press.forces(simulation, times, observer, |force| {
            pressure = force / (0.5 * self.width);
            let middle = share(points.len() as u32 + 1) - 0.5 / f64::from(LOOKS);
            points.push(CurvePoint::new(
                self.way() / self.width * self.young / strength * smooth(middle)[0],
                pressure / strength,
                exact / strength,
            ));
        })?;
        let curve = Curve::new(
            format!("load over settlement, {label}"),
            [
                "settlement over B, times Young's modulus over strength",
                "mean pressure over strength",
            ],
            points,
        );
        Ok((pressure, curve))
    }
}

/// Gate on the load of each rung: the most by which it is above the exact one.
pub const fn above(most: fn(&Rung) -> f64, reason: &'static str) -> GateRule {
    excess(LOAD).at_most_by(most, reason).of_each()
}

/// Gate on the load of each rung: its least over the exact one.
pub const fn below(least: f64, reason: &'static str) -> GateRule {
    share(LOAD).at_least(least, reason).of_each()
}

/// Gate on the order of the load of a variant.
pub const ORDER: GateRule = order(LOAD)
    .at_least(
        0.7,
        "falls with h: the edge of the footing is a share of a cell",
    )
    .of_several();

/// Cell size over a width \[m\], no finer than 1/16: there the order says how the rest of the load falls.
pub fn coarse(rung: &Rung, width: f64) -> f64 {
    (rung.cell / width).max(1.0 / 16.0)
}
