//! A material point without a grid on the paths of the laboratory: strains are driven, stresses are held, and what the law
//! makes of it is kept, by the law's own code.

mod cam_clay;
mod closed_form;
mod held;
pub mod path;

pub use closed_form::{exact_deviator, exact_pressure};

use proctor_laws::{
    AnyLaw, CamClay, DruckerPrager, MohrCoulomb, Point, PointFault, Softening, Tresca, VonMises,
};
use thiserror::Error;

/// A test of the laboratory; z is the axis of the specimen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// Pressed along z between walls.
    Oedometer,
    /// Pressed along z under a constant pressure at the sides.
    Triaxial,
    /// Pressed along z at constant volume.
    Undrained,
    /// Pressed along z under a constant pressure along x, between walls along y.
    Biaxial,
    /// Sheared in x and z at constant volume.
    Shear,
    /// Pressed from all sides alike.
    Isotropic,
    /// Pulled along z under a constant pressure at the sides.
    Extension,
}

/// Control of a component of strain and stress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Its strain at the end of the path, reached in equal steps.
    Strain(f64),
    /// Its stress stays what it is at the start.
    Held,
}

impl Test {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Oedometer,
        Self::Triaxial,
        Self::Undrained,
        Self::Biaxial,
        Self::Shear,
        Self::Isotropic,
        Self::Extension,
    ];

    /// Its word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Oedometer => "oedometer",
            Self::Triaxial => "triaxial",
            Self::Undrained => "undrained",
            Self::Biaxial => "biaxial",
            Self::Shear => "shear",
            Self::Isotropic => "isotropic",
            Self::Extension => "extension",
        }
    }

    /// Effect on components xx, yy, zz, yz, xz, xy for a strain: of the axis, of an angle in shear, of the volume where all
    /// sides are pressed.
    #[must_use]
    pub fn controls(self, strain: f64) -> [Control; 6] {
        use Control::{Held, Strain};
        let none = Strain(0.0);
        let of = |xx, yy, zz, xz| [xx, yy, Strain(zz), none, Strain(xz), none];
        match self {
            Self::Oedometer => of(none, none, -strain, 0.0),
            Self::Triaxial => of(Held, Held, -strain, 0.0),
            Self::Undrained => of(Strain(0.5 * strain), Strain(0.5 * strain), -strain, 0.0),
            Self::Biaxial => of(Held, none, -strain, 0.0),
            Self::Shear => of(none, none, 0.0, 0.5 * strain),
            Self::Isotropic => {
                let third = -strain / 3.0;
                of(Strain(third), Strain(third), third, 0.0)
            }
            Self::Extension => of(Held, Held, strain, 0.0),
        }
    }

    /// Largest difference q = sqrt(3 `J_2`) \[Pa\] that a law admits on this path from a pressure \[Pa\] on, in closed form;
    /// `None` where it has no such end: where strength changes with strain, or pressure does, as by dilation at constant volume.
    #[must_use]
    pub fn strength(self, law: &AnyLaw, pressure: f64) -> Option<f64> {
        if law.downcast::<CamClay>().is_some() {
            return cam_clay::strength(self, law, pressure);
        }
        if let Some(law) = law.downcast::<VonMises>() {
            let ends = law.is_perfect() && self != Self::Isotropic;
            return ends.then(|| law.yield_stress());
        }
        // Principal stresses of Mohr and Coulomb where two of them are equal: s_1 - s_3 with the one that is held.
        let root = 3.0_f64.sqrt();
        let of_pyramid = |friction: f64, cohesion: f64, dilation: f64| {
            let (s, c) = (
                libm::sin(friction.to_radians()),
                libm::cos(friction.to_radians()),
            );
            match self {
                Self::Triaxial => Some(2.0 * (cohesion * c + pressure * s) / (1.0 - s)),
                Self::Extension => Some(2.0 * (cohesion * c + pressure * s) / (1.0 + s)),
                // The pressure stays: q is sqrt3 times the shear stress.
                Self::Shear if dilation == 0.0 => Some(root * (cohesion * c + pressure * s)),
                _ => None,
            }
        };
        if let Some(law) = law.downcast::<Tresca>() {
            return match self {
                // Two equal stresses in the end, so that q is their difference to the third.
                Self::Undrained | Self::Oedometer => Some(2.0 * law.cohesion()),
                _ => of_pyramid(0.0, law.cohesion(), 0.0),
            };
        }
        if let Some(law) = law.downcast::<MohrCoulomb>() {
            let [friction, cohesion, dilation, _] = law.peak();
            return (law.softens() == Softening::None)
                .then(|| of_pyramid(friction, cohesion, dilation))
                .flatten();
        }
        let [eta, limit, flow] = law.downcast::<DruckerPrager>()?.cone();
        match self {
            Self::Triaxial => Some((limit + eta * pressure) / (1.0 / root - eta / 3.0)),
            Self::Extension => Some((limit + eta * pressure) / (1.0 / root + eta / 3.0)),
            Self::Shear if flow == 0.0 => Some(root * (limit + eta * pressure)),
            _ => None,
        }
    }
}

/// The state of the point after a step.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Logarithmic strain xx, yy, zz, yz, xz, xy.
    pub strain: [f64; 6],
    /// Cauchy stress in the same order \[Pa\].
    pub stress: [f64; 6],
    /// Volume over initial volume.
    pub volume: f64,
    /// Internal variables of the law.
    pub variables: Vec<f64>,
    /// Stored energy per initial volume \[J/m³\].
    pub stored: f64,
    /// Dissipated energy per initial volume \[J/m³\].
    pub dissipated: f64,
}

impl State {
    /// Mean pressure p, positive in compression \[Pa\].
    #[must_use]
    pub fn pressure(&self) -> f64 {
        -(self.stress[0] + self.stress[1] + self.stress[2]) / 3.0
    }

    /// q = sqrt(3 `J_2`) \[Pa\].
    #[must_use]
    pub fn deviator(&self) -> f64 {
        let p = self.pressure();
        let normal: f64 = self.stress[..3].iter().map(|s| (s + p) * (s + p)).sum();
        let beside: f64 = self.stress[3..].iter().map(|s| s * s).sum();
        (1.5 * normal + 3.0 * beside).sqrt()
    }

    /// Volume strain, positive where the volume grows.
    #[must_use]
    pub fn volume_strain(&self) -> f64 {
        self.strain[0] + self.strain[1] + self.strain[2]
    }

    fn of(point: &Point, strain: [f64; 6]) -> Self {
        Self {
            strain,
            stress: point.stress(),
            volume: point.volume(),
            variables: point.variables(),
            stored: point.energy(),
            dissipated: point.dissipated(),
        }
    }
}

/// Reason for which a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ElementError {
    /// The law gave no finite stress, or no volume was left.
    #[error("step {step}: {fault}")]
    Fault {
        /// Step, from 1.
        step: usize,
        /// The fault.
        fault: PointFault,
    },
    /// No strain was found that keeps the stresses that are held.
    #[error("step {step}: no strain keeps the stress that is held; it is missed by {missed:e} Pa")]
    NotHeld {
        /// Step, from 1.
        step: usize,
        /// Stress by which they are missed \[Pa\].
        missed: f64,
    },
}

/// Most corrections of the strain of held stresses in a step.
const CORRECTIONS: usize = 200;
/// Most doublings of the strain in which that strain is looked for.
const MOST_DOUBLED: usize = 60;
/// Share of the largest stress by which a held one may be missed.
const MISS: f64 = 1e-9;

/// Takes a point of a law from an isotropic pressure \[Pa\] along a path in equal steps of `dt` \[s\]; the states from the start
/// to the end, or to where it broke off, and why it did.
pub fn run(
    law: &AnyLaw,
    density: f64,
    pressure: f64,
    controls: &[Control; 6],
    steps: usize,
    dt: f64,
) -> (Vec<State>, Result<(), ElementError>) {
    let start = [-pressure, -pressure, -pressure, 0.0, 0.0, 0.0];
    let mut point = Point::new(law, density, start);
    let mut strain = [0.0; 6];
    let mut states = vec![State::of(&point, strain)];
    let mut increment = controls.map(|control| match control {
        Control::Strain(strain) => strain / steps as f64,
        Control::Held => 0.0,
    });
    let held: Vec<usize> = (0..6).filter(|i| controls[*i] == Control::Held).collect();
    for step in 1..=steps {
        let holding = HeldStep {
            point: &point,
            held: &held,
            target: &start,
            stiffness: density * law.wave_speed(density).powi(2),
            // A strain of round-off.
            least: 1e-15 * law.young(),
            dt,
            step,
        };
        if let Err(error) = holding.solve(&mut increment) {
            return (states, Err(error));
        }
        if let Err(fault) = point.strain(&increment, dt) {
            return (states, Err(ElementError::Fault { step, fault }));
        }
        for (sum, one) in strain.iter_mut().zip(increment) {
            *sum += one;
        }
        states.push(State::of(&point, strain));
    }
    (states, Ok(()))
}

/// The step that is to be taken, and what it must keep.
struct HeldStep<'a> {
    point: &'a Point,
    held: &'a [usize],
    target: &'a [f64; 6],
    /// Largest stress that a strain may cause per strain \[Pa\].
    stiffness: f64,
    /// Least stress that counts \[Pa\].
    least: f64,
    dt: f64,
    step: usize,
}

impl HeldStep<'_> {
    /// Stress by which the held components are missed with this strain of them \[Pa\], on the average and at most, and the
    /// accepted one.
    fn missed(&self, increment: &[f64; 6], lateral: f64) -> Result<(f64, f64, f64), ElementError> {
        let mut ahead = self.point.clone();
        let mut increment = *increment;
        for component in self.held {
            increment[*component] = lateral;
        }
        let fault = |fault| ElementError::Fault {
            step: self.step,
            fault,
        };
        ahead.strain(&increment, self.dt).map_err(fault)?;
        let stress = ahead.stress();
        let size = stress.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
        let missed = self.held.iter().map(|i| stress[*i] - self.target[*i]);
        let mean = missed.clone().sum::<f64>() / self.held.len() as f64;
        let worst = missed.fold(0.0_f64, |most, r| most.max(r.abs()));
        Ok((mean, worst, (MISS * size).max(self.least)))
    }

    /// Finds the strain increment, the same for all held components, with which their stress stays. All tests that hold
    /// several hold them alike, so that one number is enough; and stress grows with it, so that it can be enclosed.
    fn solve(&self, increment: &mut [f64; 6]) -> Result<(), ElementError> {
        let Some(first) = self.held.first() else {
            return Ok(());
        };
        let mut low = increment[*first];
        let (mut of_low, mut worst, mut enough) = self.missed(increment, low)?;
        let mut found = low;
        if worst > enough {
            // No law here is stiffer than elasticity: this far the sign does not change, from there on the way is doubled.
            let mut way = -of_low / self.stiffness;
            let mut high = low + way;
            let (mut of_high, ..) = self.missed(increment, high)?;
            let mut doubled = 0;
            while of_high * of_low > 0.0 {
                doubled += 1;
                if doubled > MOST_DOUBLED {
                    return Err(self.not_held(worst));
                }
                (low, of_low) = (high, of_high);
                way *= 2.0;
                high += way;
                (of_high, ..) = self.missed(increment, high)?;
            }
            // The rule of Illinois: false position, and half the value of an end that stays.
            for _ in 0..CORRECTIONS {
                found = high - of_high * (high - low) / (of_high - of_low);
                let of_found;
                (of_found, worst, enough) = self.missed(increment, found)?;
                if worst <= enough {
                    break;
                }
                if of_found * of_high < 0.0 {
                    (low, of_low) = (high, of_high);
                } else {
                    of_low *= 0.5;
                }
                (high, of_high) = (found, of_found);
            }
        }
        if worst > enough {
            return Err(self.not_held(worst));
        }
        for component in self.held {
            increment[*component] = found;
        }
        Ok(())
    }

    fn not_held(&self, missed: f64) -> ElementError {
        ElementError::NotHeld {
            step: self.step,
            missed,
        }
    }
}
