//! Warnings about the results of a run that went on to its end: energy that no channel explains, deformations that a law or
//! the particle domains do not bear, and motion that damping has left.
//!
//! The scale of the energy balance is the largest energy that there was to turn over: what the start and the work done have
//! given at most, or what moves and is strained now. A negative remainder is energy from nowhere, which no transfer explains.
//! A positive one is dissipation, which affine transfers, a share of PIC, USL, friction of some contacts and planes that stop
//! what hits them explain; nothing explains more of it than there was.

use crate::residual_motion::{self, ResidualMotion};
use crate::running::Simulation;
use proctor_kernel::laws::StrainRange;
use proctor_kernel::model::{Damping, StressScheme, Transfer, TransferKind, Weighting};
use proctor_kernel::simulation::{Energy, MOST_REMAINDER, MOST_STRETCH_RATIO, ResultQuality};
use std::fmt;

/// Share of the angular momentum whose loss needs no word.
const MOST_LOST_SPIN: f64 = 0.05;
/// Largest share of the mass of a body beyond that. A beam that bends under its own weight has 17 % near its root, and its tip is
/// where domains that follow have it within 0.05 %; of the bar at 1.48 it is 40 %.
const MOST_STRETCHED: f64 = 0.25;
/// Share of PIC from which it explains dissipation.
const HARDLY_PIC: f64 = 1e-6;

/// A reason for caution with results.
#[derive(Clone, Debug, PartialEq)]
pub enum ResultWarning {
    /// The energy balance does not close.
    Energy {
        /// Energy that no channel accounts for \[J\]; negative if energy came from nowhere.
        remainder: f64,
        /// The largest energy that there was to turn over \[J\].
        scale: f64,
        /// Probable causes, each with what to use.
        causes: Vec<&'static str>,
    },
    /// A law without an energy at large strain.
    Strain {
        /// J - 1 where its magnitude was largest.
        volume_change: f64,
        /// Strains up to which the law holds.
        range: StrainRange,
    },
    /// A traction that its body has left behind.
    Traction {
        /// Its place in the scene.
        index: usize,
        /// The share of its area that acts on nothing.
        share: f64,
    },
    /// Particle domains that do not follow a large stretch.
    Stretch {
        /// Largest ratio of principal stretches.
        ratio: f64,
        /// Share of the mass of a body beyond a ratio of 1.25.
        share: f64,
        /// True if the weighting function is a B-spline, which has no domains that could follow.
        bspline: bool,
    },
    /// Angular momentum that FLIP lost.
    Spin {
        /// Share of that of the start.
        lost: f64,
    },
    /// Damped bodies that are not at rest.
    Motion(ResidualMotion),
}

impl ResultWarning {
    /// Kinds of cautions, as words for files.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Energy { .. } => "energy",
            Self::Strain { .. } => "strain",
            Self::Traction { .. } => "traction",
            Self::Stretch { .. } => "stretch",
            Self::Spin { .. } => "spin",
            Self::Motion(_) => "motion",
        }
    }

    /// True if it is of the same kind as another, and of the same load.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Traction { index, .. }, Self::Traction { index: of, .. }) => index == of,
            _ => std::mem::discriminant(self) == std::mem::discriminant(other),
        }
    }

    /// Ratio to the accepted value: of two cautions of one kind the larger ratio tells more.
    #[must_use]
    pub fn size(&self) -> f64 {
        match self {
            Self::Energy {
                remainder, scale, ..
            } => remainder.abs() / scale,
            Self::Strain { volume_change, .. } => volume_change.abs(),
            Self::Traction { share, .. } => *share,
            Self::Stretch { ratio, .. } => *ratio,
            Self::Spin { lost } => *lost,
            Self::Motion(motion) => motion.share,
        }
    }
}

impl fmt::Display for ResultWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Energy {
                remainder,
                scale,
                causes,
            } => {
                let share = 100.0 * remainder.abs() / scale;
                if *remainder < 0.0 {
                    write!(f, "{:.4e} J of energy came from nowhere", -remainder)?;
                } else {
                    write!(
                        f,
                        "{remainder:.4e} J of energy went where no channel accounts for it"
                    )?;
                }
                write!(
                    f,
                    ", {share:.1} % of the {scale:.4e} J that there was; probable cause: "
                )?;
                f.write_str(&causes.join("; or "))
            }
            Self::Strain {
                volume_change,
                range,
            } => write!(
                f,
                "`{}` was strained to J - 1 = {volume_change:.3}, beyond {}: the stress of increments has no energy there, and \
                 the stored energy is off by {:.0} %; {}",
                range.law,
                range.most_volume_change,
                100.0 * (range.energy_error)(1.0 + volume_change),
                range.instead
            ),
            Self::Traction { index, share } => write!(
                f,
                "traction[{index}] is fixed in space, and no particle reaches {:.0} % of it any more: that part acts on nothing; \
                 \"box_load\" moves with the particles",
                100.0 * share
            ),
            Self::Spin { lost } => write!(
                f,
                "{:.0} % of the angular momentum is gone though nothing turns the bodies: FLIP moves particles with another velocity \
                 than they carry, and spin of bodies few cells across becomes noise; \"APIC\" keeps it",
                100.0 * lost
            ),
            Self::Motion(motion) => motion.fmt(f),
            Self::Stretch {
                ratio,
                share,
                bspline,
            } => {
                write!(
                    f,
                    "principal stretches differ by a factor of up to {ratio:.3}, by more than {MOST_STRETCH_RATIO} in {:.0} % of a \
                     body: ",
                    100.0 * share
                )?;
                if *bspline {
                    f.write_str(
                        "quadratic B-splines take particles for points, whose distance no longer fits the cells (12 % of the \
                         elongation at a factor of 1.5, more on smaller cells); \"shape_function\": \"cpGIMP\" with \
                         \"domain_update\": \"stretch\" holds within 0.5 %",
                    )
                } else {
                    f.write_str(
                        "particle domains of the update \"determinant\" keep the ratio of their sides, so that they part along one \
                         axis and overlap along the other (2.6 % of the elongation at a factor of 1.5, 3 to 6 % at 1.7, more on \
                         smaller cells); \"domain_update\": \"stretch\" holds within 0.5 %",
                    )
                }
            }
        }
    }
}

impl Simulation {
    /// Reasons for caution with the results as they are now, none where all is well; `energy` is the balance of
    /// [`energy`](proctor_kernel::simulation::Cycle::energy).
    #[must_use]
    pub fn cautions(&self, energy: &Energy) -> Vec<ResultWarning> {
        let quality = self.result_quality(energy);
        let extremes = quality.extremes;
        let mut all = vec![];
        all.extend(self.energy_caution(energy, &quality));
        if let Some(range) = quality.exceeded_range {
            all.push(ResultWarning::Strain {
                volume_change: extremes.volume_change,
                range,
            });
        }
        if let Some(lost) = quality.lost_spin.filter(|lost| *lost > MOST_LOST_SPIN) {
            all.push(ResultWarning::Spin { lost });
        }
        all.extend(
            residual_motion::residual_motion(self, energy, &quality).map(ResultWarning::Motion),
        );
        let left = quality.tractions_left.into_iter();
        all.extend(left.map(|(index, share)| ResultWarning::Traction { index, share }));
        if extremes.stretched_share > MOST_STRETCHED {
            all.push(ResultWarning::Stretch {
                ratio: extremes.stretch_ratio,
                share: extremes.stretched_share,
                bspline: self.model().settings.weighting == Weighting::QuadraticBSpline,
            });
        }
        all
    }

    /// True for an earlier reason that still holds: missing energy is little beside much that came later, and motion that was left
    /// may have come to rest.
    #[must_use]
    pub fn still_matters(&self, caution: &ResultWarning, energy: &Energy) -> bool {
        match caution {
            ResultWarning::Energy { remainder, .. } => {
                remainder.abs() > MOST_REMAINDER * self.scale_of_energy(energy)
            }
            ResultWarning::Motion(_) => false,
            _ => true,
        }
    }

    fn energy_caution(&self, energy: &Energy, quality: &ResultQuality) -> Option<ResultWarning> {
        if !quality.knows_all_work {
            return None;
        }
        let scale = quality.energy_scale;
        // Local damping is booked with the velocities that bodies would have without each other; what contact makes of them moves
        // between damping and remainder.
        let settings = &self.model().settings;
        let meets = quality.interactions.moves_damping;
        let remainder = if meets && matches!(settings.damping, Damping::Local { .. }) {
            energy.remainder + energy.damping
        } else {
            energy.remainder
        };
        let most = if remainder < 0.0 || !self.dissipates(quality) {
            MOST_REMAINDER
        } else {
            1.0
        };
        (remainder.abs() > most * scale).then(|| ResultWarning::Energy {
            remainder,
            scale,
            causes: self.causes(remainder, quality),
        })
    }

    /// True if the method takes energy that no channel has.
    fn dissipates(&self, quality: &ResultQuality) -> bool {
        let settings = &self.model().settings;
        let Transfer { kind, pic_fraction } = settings.transfer;
        let planes = (0..self.model().plan.axes)
            .any(|axis| [0, 1].iter().any(|side| settings.plane_acts(axis, *side)));
        kind != TransferKind::Flip
            || pic_fraction > HARDLY_PIC
            || settings.scheme != StressScheme::Usf
            || planes
            || !settings.held_boxes.is_empty()
            || quality.interactions.dissipates
            || self.model().bodies.len() > 1
    }

    /// Probable causes of a remainder, the likeliest first.
    fn causes(&self, remainder: f64, quality: &ResultQuality) -> Vec<&'static str> {
        let settings = &self.model().settings;
        let mut all = vec![];
        if let Some(range) = quality.exceeded_range {
            all.push(range.cause);
        }
        if remainder > 0.0 {
            all.push("contact or damping that gave energy which the transfer took again: look at each channel");
            return all;
        }
        if quality.extremes.stretched_share > MOST_STRETCHED {
            all.push("particle domains that do not follow their stretch: use \"domain_update\": \"stretch\"");
        }
        let damped = settings.damping != Damping::None;
        let flip = settings.transfer.kind == TransferKind::Flip;
        if flip && settings.scheme != StressScheme::Usl {
            all.push(
                "FLIP with MUSL or USF, which lets motion that nodes do not see grow, in tension above all: use \"APIC\" or USL",
            );
        } else if flip {
            all.push("FLIP, which lets motion that nodes do not see grow: use \"APIC\"");
        }
        if settings.weighting == Weighting::Linear {
            all.push("particles that cross cells with linear functions: use \"GIMP\" or B-splines");
        }
        if !(settings.point_loads.is_empty() && settings.tractions.is_empty()) {
            all.push("a load fixed in space that its body leaves: use \"box_load\", which moves with the particles");
        }
        if quality.interactions.may_be_stiff {
            all.push(
                "contact that is too stiff or meets too fast for the step: use a smaller step",
            );
        }
        if all.is_empty() && damped {
            all.push(
                "damping against a velocity that contact or planes turn round: use less of it",
            );
        }
        if all.is_empty() {
            all.push("a step too large: halve it and compare");
        }
        all
    }
}
