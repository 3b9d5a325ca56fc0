//! Quality of results: measures that tell how far they may be trusted. Words about them belong to whoever reports a run.

use crate::laws::StrainRange;
use crate::simulation::Cycle;
use crate::simulation::interactions::BalanceTraits;
use crate::simulation::values::{Energy, Extremes, ROUND_OFF};

/// Largest remainder of the energy balance over its scale that needs no explanation.
pub const MOST_REMAINDER: f64 = 0.02;
/// Round-off of potentials that cancel, over their size.
const CANCELLED: f64 = 1e-12;

/// Measures of how far the results of a run may be taken.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultQuality {
    /// Largest deformations so far.
    pub extremes: Extremes,
    /// The range of the first law without an energy at large strain, where a change of volume lies beyond it.
    pub exceeded_range: Option<StrainRange>,
    /// Share of the angular momentum of the start that is gone, where it has to stay.
    pub lost_spin: Option<f64>,
    /// Tractions that bodies have left behind, by their places in the scene, with the share of each that acts on nothing.
    pub tractions_left: Vec<(usize, f64)>,
    /// The part of all interactions in the energy balance.
    pub interactions: BalanceTraits,
    /// True where every work that is done has a channel of the energy balance.
    pub knows_all_work: bool,
    /// The largest energy that there was to turn over \[J\].
    pub energy_scale: f64,
}

impl Cycle {
    /// Measures of the results as they are now; `energy` is the balance of [`Cycle::energy`].
    #[must_use]
    pub fn result_quality(&self, energy: &Energy) -> ResultQuality {
        let extremes = self.extremes();
        ResultQuality {
            exceeded_range: self.exceeded_range(&extremes),
            extremes,
            lost_spin: self.lost_spin(),
            tractions_left: self.tractions_left(),
            interactions: self.balance_traits(),
            knows_all_work: self.knows_all_work(),
            energy_scale: self.scale_of_energy(energy),
        }
    }

    /// The largest energy that there was to turn over \[J\], and never less than round-off of its parts.
    #[must_use]
    pub fn scale_of_energy(&self, energy: &Energy) -> f64 {
        let ledger = &self.state.ledger;
        let waves = self
            .state
            .found
            .iter()
            .map(|found| found.wave_speed_squared);
        let at_rest = ROUND_OFF * self.mass() * waves.fold(0.0, f64::max);
        let given = self
            .state
            .invariants
            .given
            .max(ledger.initial_energy + energy.external_work);
        let present = energy.kinetic + energy.strain + energy.contact;
        let cancelled = CANCELLED * (ledger.dead_load_origin.abs() + energy.external_work.abs());
        let parts = [present, at_rest, cancelled / MOST_REMAINDER];
        parts.into_iter().fold(given, f64::max)
    }
}
