//! The map: every method and resolution with its predicted and measured limit.

use proctor_scene::plan::AUTOMATIC_SHARE;
use proctor_scene::{Dimension, DomainUpdate, StressScheme, TransferKind, Weighting};

use super::StabilityError;
use super::block::{Choice, Form, Place, Worst};
use super::measured::{MeasuredLimit, RANGE, climb, measure};
use crate::case::{Gate, Size};
use crate::settings::Method;

/// Weighting functions, in the order in which they are shown.
pub const WEIGHTINGS: [Weighting; 4] = [
    Weighting::Linear,
    Weighting::UniformGimp,
    Weighting::ContiguousGimp(DomainUpdate::Stretch),
    Weighting::QuadraticBSpline,
];
/// Schemes, in the order in which they are shown.
pub const SCHEMES: [StressScheme; 3] = [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl];
/// Transfers that every weighting function takes, in the order in which they are shown.
pub const TRANSFERS: [TransferKind; 3] =
    [TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic];
/// Particles per cell and axis.
pub const PARTICLES: [usize; 3] = [1, 2, 4];

/// Weighting function and transfer of MLS, which is derived for quadratic B-splines alone.
pub const LEAST_SQUARES: (Weighting, TransferKind) =
    (Weighting::QuadraticBSpline, TransferKind::Mls);

/// Every pair of weighting function and transfer that goes together, in the order in which they are shown.
pub fn pairs() -> impl Iterator<Item = (Weighting, TransferKind)> {
    TRANSFERS
        .into_iter()
        .flat_map(|transfer| WEIGHTINGS.map(|weighting| (weighting, transfer)))
        .chain([LEAST_SQUARES])
}

/// Reason for which a measured limit may not lie below the predicted one.
const NOT_BELOW_PREDICTED: &str =
    "the prediction is a bound: an unstable run below it says that one of the two is wrong";
/// Reason for which a measured limit may not lie below the kernel's step.
const NOT_BELOW_KERNEL: &str =
    "a scene that leaves the step to the kernel must be stable wherever its body lies";
/// The same for methods of which the kernel says that they have no safe step.
const NOT_BELOW_KERNEL_FILLED: &str = "the kernel says that this method has no step that is safe for every body; where a body fills its cells it must be";

/// A body whose faces lie on nodes.
const FILLED: &str = ", cells full";
/// A body with particles on nodes.
const ON_NODES: &str = ", particles on nodes";

/// An entry of the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Choice of the method.
    pub choice: Choice,
    /// Worst offset of each form, the worst first.
    pub forms: Vec<Worst>,
    /// Measured limits, that of the place with the smallest prediction first.
    pub sites: Vec<Site>,
}

/// A measured limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// Name of the place, in words that follow a name; empty for the one with the smallest prediction.
    pub word: &'static str,
    /// Place of the block.
    pub place: Place,
    /// The predicted Courant number; `None` where a step is not linear.
    pub predicted: Option<f64>,
    /// The measured one.
    pub measured: MeasuredLimit,
    /// Reason for which the kernel's step must be stable here; `None` where the kernel says that it may not be.
    pub must_hold: Option<&'static str>,
}

impl Site {
    /// Smallest Courant number that was seen to be unstable; the end of the range where none was.
    #[must_use]
    pub fn first_unstable(&self) -> f64 {
        self.measured.unstable.unwrap_or(RANGE[1])
    }

    /// The same over the predicted one; `None` where there is none.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        let ratio = self.first_unstable() / self.predicted?;
        ratio.is_finite().then_some(ratio)
    }
}

impl Entry {
    /// The place with the smallest prediction.
    #[must_use]
    pub fn worst(&self) -> Worst {
        self.forms[0]
    }

    /// Prediction for bodies that are more than a cell thick along all axes.
    #[must_use]
    pub fn thick(&self) -> f64 {
        let thick = self.forms.iter().filter(|w| w.place.form.is_thick());
        thick.map(|w| w.courant).fold(f64::INFINITY, f64::min)
    }

    /// Largest Courant number at which nothing is known to become unstable.
    #[must_use]
    pub fn safe(&self) -> f64 {
        let seen = self.sites.iter().filter(|site| site.predicted.is_none());
        let seen = seen.filter_map(|site| site.measured.unstable.and(site.measured.stable));
        let first = self.sites[0].first_unstable();
        seen.fold(self.worst().courant.min(first), f64::min)
    }

    /// The smallest ratio of measured to predicted.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        self.sites.iter().filter_map(Site::ratio).reduce(f64::min)
    }

    /// The kernel's bound.
    #[must_use]
    pub fn bound(&self) -> f64 {
        let choice = &self.choice;
        choice.method.stability_number(choice.particles_per_cell)
    }

    /// The kernel's automatic step as a Courant number.
    #[must_use]
    pub fn automatic(&self) -> f64 {
        AUTOMATIC_SHARE * self.bound()
    }

    /// Gates of the map. A limit that was not found in the range is beyond it, and the range's end stands for it.
    #[must_use]
    pub fn gates(&self) -> Vec<Gate> {
        let name = self.choice.name();
        let mut gates = vec![];
        for site in &self.sites {
            let word = site.word;
            if let Some(ratio) = site.ratio() {
                let name = format!("{name}{word}: measured over predicted");
                gates.push(Gate::at_least(name, ratio, 1.0, NOT_BELOW_PREDICTED));
            }
            if let Some(reason) = site.must_hold {
                let name = format!("{name}{word}: measured over the kernel's step");
                let ratio = site.first_unstable() / self.automatic();
                gates.push(Gate::at_least(name, ratio, 1.0, reason));
            }
        }
        gates
    }
}

impl Choice {
    /// Its words, joined by blanks: `uGIMP USL FLIP 2D, 2 per cell`.
    #[must_use]
    pub fn name(&self) -> String {
        format!(
            "{} {}D, {} per cell",
            self.method,
            self.dimension.axes(),
            self.particles_per_cell
        )
    }

    /// The whole row of the map.
    ///
    /// # Errors
    /// A scene that is refused, or an iteration that does not come to an end.
    pub fn solve(&self) -> Result<Entry, StabilityError> {
        let mut forms = vec![];
        for form in Form::all(self.dimension, self.particles_per_cell) {
            forms.push(self.worst_of(form)?);
        }
        forms.sort_by(|a, b| a.courant.total_cmp(&b.courant));
        let worst = forms[0];
        let safe = self.method.has_safe_step();
        let mut sites = vec![Site {
            word: "",
            place: worst.place,
            predicted: Some(worst.courant),
            measured: measure(&self.scene(worst.place), worst.courant)?,
            must_hold: safe.then_some(NOT_BELOW_KERNEL),
        }];
        let mut at = |word, offset, predicted: Option<f64>, reason| {
            let place = Place {
                form: Form::LARGE,
                offset,
            };
            let scene = self.scene(place);
            sites.push(Site {
                word,
                place,
                predicted,
                measured: match predicted {
                    Some(guess) => measure(&scene, guess)?,
                    None => climb(&scene)?,
                },
                must_hold: Some(reason),
            });
            Ok::<(), StabilityError>(())
        };
        if !safe {
            let place = Place {
                form: Form::LARGE,
                offset: 0.0,
            };
            let predicted = self.predict(place)?;
            at(FILLED, 0.0, Some(predicted), NOT_BELOW_KERNEL_FILLED)?;
        }
        let on_node = 0.5 / self.particles_per_cell as f64;
        if safe && self.is_on_node(on_node) {
            at(ON_NODES, on_node, None, NOT_BELOW_KERNEL)?;
        }
        Ok(Entry {
            choice: *self,
            forms,
            sites,
        })
    }
}

/// Choices in the map of a size, the longest last: the plane in short, plane and space in full.
#[must_use]
pub fn choices(size: Size) -> Vec<Choice> {
    let dimensions: &[Dimension] = match size {
        Size::Quick => &[Dimension::Two],
        Size::Full => &[Dimension::Two, Dimension::Three],
    };
    let mut all = vec![];
    for &dimension in dimensions {
        for (weighting, transfer) in pairs() {
            for scheme in SCHEMES {
                for particles_per_cell in PARTICLES {
                    let method = Method {
                        weighting,
                        scheme,
                        transfer,
                    };
                    all.push(Choice {
                        method,
                        dimension,
                        particles_per_cell,
                    });
                }
            }
        }
    }
    all
}
