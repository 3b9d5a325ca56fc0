//! The rate law `sigma' = lambda tr(D) 1 + 2 G D` with the Jaumann rate in motions whose spin is known: exact stresses, and
//! closed forms of what two updates in equal steps make of them (verification notes, A8 and A9).
//!
//! In the plane the deviator is the complex number `sigma_xy + i (sigma_xx - sigma_yy)/2`, which a spin turns. Each step
//! of an update multiplies it by a number q and adds the same increment e, so that after n steps from zero it is
//! `e (q^n - 1)/(q - 1)`, and from d without increments `d q^n`. *Hughes and Winget 1980* turn by the angle of a midpoint
//! rule, and |q| = 1; the *forward* update (equation 14 of the mortar paper, the manuals' algorithm 2) has
//! `q = 1 + i s`, s twice the spin of the step, and |q| > 1.

use std::f64::consts::TAU;

use libm::{atan, atan2, exp, hypot, log1p, sin, sincos};

/// Update of the stress by a spin in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Update {
    /// Turned by the midpoint rule, then strained.
    HughesWinget,
    /// Forward Euler of the Jaumann rate.
    Forward,
}

/// In-plane stress, Pa, or per modulus: xx, yy, xy.
pub type PlaneStress = [f64; 3];

/// Simple shear `x = X + gamma Y` from a state without stress, for the shear modulus G = 1.
#[must_use]
pub fn sheared(gamma: f64) -> PlaneStress {
    let xx = 2.0 * sin(0.5 * gamma) * sin(0.5 * gamma);
    [xx, -xx, sin(gamma)]
}

/// The same as an update in equal steps computes it.
#[must_use]
pub fn sheared_by(update: Update, gamma: f64, steps: u32) -> PlaneStress {
    let increment = gamma / f64::from(steps);
    // The velocity gradient squared is zero, so that the midpoint rule leaves it as it is: tan(angle/2) = increment/4.
    let factor = Factor::of(update, 4.0 * atan(0.25 * increment), increment);
    let [re, im] = factor.power(steps);
    let [re_1, im_1] = factor.power(1);
    // e (q^n - 1)/(q - 1)
    let square = (re_1 - 1.0).powi(2) + im_1.powi(2);
    let xy = ((re - 1.0) * (re_1 - 1.0) + im * im_1) / square;
    let xx = (im * (re_1 - 1.0) - (re - 1.0) * im_1) / square;
    [increment * xx, -increment * xx, increment * xy]
}

/// The stress of a body that has turned rigidly, in equal steps of which each moves its points along chords of their
/// circles, as an update gives it.
///
/// The velocity gradient is `(Q - 1)/dt`. Its spin is the sine of the angle of a step; its symmetric part, `cos - 1`, a
/// strain that is none. The midpoint rule makes of it the rotation Q and no strain. The forward update takes it at its
/// word, and adds `2 (lambda + G) (cos - 1)` to the mean of the in-plane stresses in each step.
#[must_use]
pub fn turned_by(
    update: Update,
    start: PlaneStress,
    [lambda, shear]: [f64; 2],
    steps_per_turn: u32,
    steps: u32,
) -> PlaneStress {
    let angle = TAU / f64::from(steps_per_turn);
    let factor = Factor::of(update, 2.0 * angle, 2.0 * sin(angle));
    let [re, im] = factor.power(steps);
    let [xx, yy, xy] = start;
    // A spin to the left takes from xx what it gives to xy: (xx - yy)/2 + i xy turns with the angle.
    let (half, mean) = (0.5 * (xx - yy), 0.5 * (xx + yy));
    let (half, xy) = (re * half - im * xy, im * half + re * xy);
    let strain = match update {
        Update::HughesWinget => 0.0,
        Update::Forward => -2.0 * sin(0.5 * angle) * sin(0.5 * angle),
    };
    let mean = mean + f64::from(steps) * 2.0 * (lambda + shear) * strain;
    [mean + half, mean - half, xy]
}

/// Logarithm of what the deviator grows by in one turn of N steps, to first order in 1/N: 8 pi^2/N of the forward update,
/// nothing of the other.
#[must_use]
pub fn growth_per_turn(update: Update, steps_per_turn: u32) -> f64 {
    match update {
        Update::HughesWinget => 0.0,
        Update::Forward => 2.0 * TAU * TAU / f64::from(steps_per_turn),
    }
}

/// Size of the in-plane deviator.
#[must_use]
pub fn deviator([xx, yy, xy]: PlaneStress) -> f64 {
    hypot(0.5 * (xx - yy), xy)
}

/// A complex number by the logarithm of its modulus and its argument.
struct Factor {
    log_modulus: f64,
    argument: f64,
}

impl Factor {
    /// Factor of one step: the angle (rad) of a rotation, or the forward increment.
    fn of(update: Update, angle: f64, increment: f64) -> Self {
        match update {
            Update::HughesWinget => Self {
                log_modulus: 0.0,
                argument: angle,
            },
            Update::Forward => Self {
                log_modulus: 0.5 * log1p(increment * increment),
                argument: atan2(increment, 1.0),
            },
        }
    }

    /// Real and imaginary part of a power.
    fn power(&self, n: u32) -> [f64; 2] {
        let n = f64::from(n);
        let modulus = exp(n * self.log_modulus);
        let (sin, cos) = sincos(n * self.argument);
        [modulus * cos, modulus * sin]
    }
}
