//! The plan: what a simulation needs, and nothing else.
//!
//! It is decided once. What is left out is never called and its fields are never allocated.

mod stability;

use crate::layout::Layout;
use crate::model::{DomainUpdate, StressScheme, Transfer, TransferKind};
use crate::stage::g2p::Affine;
use crate::weights::Family;
pub use stability::{AUTOMATIC_SHARE, has_safe_step, stability_number};
use std::fmt;

/// Decisions for one simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Number of axes, 2 or 3.
    pub axes: usize,
    /// True where the two axes are radius and height.
    pub axisymmetric: bool,
    /// Family of weighting functions.
    pub family: Family,
    /// Domain update of the particles.
    pub domain_update: Option<DomainUpdate>,
    /// Stress scheme.
    pub scheme: StressScheme,
    /// Affine velocity.
    pub affine: Affine,
    /// True if volumetric strain is a mean over cells.
    pub cell_average: bool,
    /// True if the mapping carries affine velocity or forces of the particles.
    pub full_mapping: bool,
    /// Kinetic damping.
    pub kinetic_damping: bool,
    /// Factor of viscous damping.
    pub viscous_damping: Option<f64>,
    /// True if kinetic energy and unbalanced force are measured at the nodes in every step.
    pub measure: bool,
    /// Columns of the particle sets, per body.
    pub layouts: Vec<Layout>,
    /// Decisions of the plan, in words.
    pub entries: Vec<PlanEntry>,
    /// Warnings of results that the scene may spoil, each with its reason.
    pub warnings: Vec<String>,
}

/// One decision in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanEntry {
    /// Group: stage, particle field, output, time step.
    pub group: &'static str,
    /// Feature that is kept or left out.
    pub name: String,
    /// True if it is kept.
    pub kept: bool,
    /// Reason.
    pub because: String,
}

impl Plan {
    /// Bytes of state per particle, the largest over the bodies.
    #[must_use]
    pub fn bytes_per_particle(&self) -> usize {
        self.layouts
            .iter()
            .map(Layout::bytes_per_particle)
            .max()
            .unwrap_or(0)
    }

    /// Bytes per node that is in use.
    #[must_use]
    pub fn bytes_per_node(&self) -> usize {
        size_of::<crate::grid::Line>()
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let width = self.entries.iter().map(|e| e.name.len()).max().unwrap_or(0);
        for kept in [true, false] {
            writeln!(f, "{}", if kept { "kept" } else { "left out" })?;
            for entry in self.entries.iter().filter(|e| e.kept == kept) {
                writeln!(
                    f,
                    "  {:<14}  {:<width$}  {}{}",
                    entry.group,
                    entry.name,
                    if kept { "" } else { "because " },
                    entry.because
                )?;
            }
        }
        for warning in &self.warnings {
            writeln!(f, "warning: {warning}")?;
        }
        writeln!(f, "bytes per particle  {}", self.bytes_per_particle())?;
        write!(f, "bytes per node      {}", self.bytes_per_node())
    }
}

/// The entries of a plan, as the list grows.
#[derive(Clone, Debug, Default)]
pub struct PlanEntries(pub Vec<PlanEntry>);

impl PlanEntries {
    /// Adds what is kept.
    pub fn keep(&mut self, group: &'static str, name: &str, because: &str) {
        self.0.push(PlanEntry {
            group,
            name: name.into(),
            kept: true,
            because: because.into(),
        });
    }

    /// Adds what is left out.
    pub fn leave(&mut self, group: &'static str, name: &str, because: &str) {
        self.0.push(PlanEntry {
            group,
            name: name.into(),
            kept: false,
            because: because.into(),
        });
    }

    /// Adds what is kept or left out, with the reason for either.
    pub fn choose(
        &mut self,
        group: &'static str,
        name: &str,
        kept: bool,
        why: &str,
        why_not: &str,
    ) {
        if kept {
            self.keep(group, name, why);
        } else {
            self.leave(group, name, why_not);
        }
    }
}

/// True where the method lets displacements grow that no strain sees, which a body in tension does not bear: FLIP with MUSL or USF.
#[must_use]
pub fn loses_tension(transfer: Transfer, scheme: StressScheme) -> bool {
    let flip = transfer.kind == TransferKind::Flip && transfer.pic_fraction < 1.0;
    flip && scheme != StressScheme::Usl
}

/// A scheme by its word in scenes.
#[must_use]
pub fn scheme_word(scheme: StressScheme) -> &'static str {
    match scheme {
        StressScheme::Usl => "USL",
        StressScheme::Usf => "USF",
        StressScheme::Musl => "MUSL",
    }
}
