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

/// Gates of the load of a rung over the exact one: the most by which it is above, in cells over a width \[m\], and its least, each
/// with the reason. Cells count no finer than B/16: there the order says how the rest falls.
pub fn gates(
    runs: &Runs<'_>,
    rung: &Rung,
    width: f64,
    [most, least]: [(f64, &'static str); 2],
) -> [Gate; 2] {
    let load = runs.run(&rung.label).and_then(|run| run.quantity(LOAD));
    let over = load.and_then(|load| Some(load.value / load.exact?));
    let (over, name) = (over.unwrap_or(f64::NAN), format!("{}: {LOAD}", rung.label));
    let bound = most.0 * (rung.cell / width).max(1.0 / 16.0);
    let below = format!("{name} over the exact one");
    [
        Gate::at_most(name, over - 1.0, bound, most.1),
        Gate::at_least(below, over, least.0, least.1),
    ]
}

/// Gate of the order of the load of a variant.
pub fn order_of(runs: &Runs<'_>, variant: &'static str) -> Gate {
    let reason = "falls with h: the edge of the footing is a share of a cell";
    runs.gate_of(variant, &order(LOAD).at_least(0.7, reason))
}
