//! The columns of `history.csv`, and their values of one state.

use super::probes::FollowedProbe;
use proctor_scene::simulation::{Energy, Simulation};

/// Rows of the history of a simulation.
pub struct HistoryRows {
    probes: Vec<FollowedProbe>,
}

impl HistoryRows {
    /// History of a simulation at its start, when the particle nearest to each probe is found.
    #[must_use]
    pub fn new(simulation: &Simulation) -> Self {
        Self {
            probes: FollowedProbe::all(simulation),
        }
    }

    /// Names of the history columns behind time and step.
    #[must_use]
    pub fn columns(&self, simulation: &Simulation) -> Vec<String> {
        let letters = &["x", "y", "z"][..simulation.plan().axes];
        let mut names = vec!["kinetic_energy".to_string(), "strain_energy".into()];
        names.extend(letters.iter().map(|l| format!("momentum_{l}")));
        for set in 0..simulation.sets().len() {
            let body = simulation.body(set).id;
            names.push(format!("body{body}_mass"));
            names.extend(letters.iter().map(|l| format!("body{body}_{l}")));
            names.extend(letters.iter().map(|l| format!("body{body}_v{l}")));
            if simulation.has_contact(set) {
                names.extend(letters.iter().map(|l| format!("body{body}_contact_f{l}")));
            }
        }
        for surface in 0..simulation.scene().surfaces.len() {
            names.extend(
                letters
                    .iter()
                    .map(|l| format!("surface{surface}_contact_f{l}")),
            );
        }
        for probe in &self.probes {
            names.extend(probe.columns(simulation));
        }
        names.push("velocity_time".into());
        names.extend(BALANCE.map(str::to_owned));
        if simulation.model().settings.absorbs() {
            names.push(ABSORBED.into());
        }
        if simulation.has_water() {
            names.extend(WATER.map(str::to_owned));
        }
        if has_drift(simulation) {
            names.extend(DRIFT.map(str::to_owned));
        }
        // Of ranks the first one alone asks for names: no value, which all of them sum up.
        let bodies = simulation.model().bodies.iter();
        for body in bodies.filter(|body| body.law.yields()) {
            let id = body.id;
            names.extend(YIELDING.map(|channel| format!("body{id}_energy_{channel}")));
        }
        names
    }

    /// One row of the history, for the energy balance of the same state; a probed particle that was removed leaves empty cells.
    #[must_use]
    pub fn row(&self, simulation: &Simulation, energy: &Energy) -> Vec<f64> {
        let axes = simulation.plan().axes;
        let mut row = vec![simulation.kinetic_energy(), simulation.strain_energy()];
        row.extend_from_slice(&simulation.momentum()[..axes]);
        for set in 0..simulation.sets().len() {
            let center = simulation.center(set);
            let (mass, x, v) = (center.mass, center.position, center.velocity);
            row.push(mass);
            row.extend_from_slice(&x[..axes]);
            row.extend_from_slice(&v[..axes]);
            if simulation.has_contact(set) {
                row.extend_from_slice(&simulation.contact_force(set)[..axes]);
            }
        }
        for surface in 0..simulation.scene().surfaces.len() {
            row.extend_from_slice(&simulation.surface_force(surface)[..axes]);
        }
        for probe in &self.probes {
            row.extend(probe.values(simulation));
        }
        row.push(simulation.velocity_time());
        row.extend([
            energy.kinetic,
            energy.contact,
            energy.external_work,
            energy.damping,
            energy.friction,
            energy.impact,
            energy.plastic,
            energy.removed,
            energy.remainder,
        ]);
        if simulation.model().settings.absorbs() {
            row.push(energy.absorbed);
        }
        if simulation.has_water() {
            row.extend([simulation.water_mass(), energy.water, energy.drag]);
        }
        if has_drift(simulation) {
            // Between two stages all bodies with a boundary may be driven: empty cells.
            let drift = simulation.boundary_drift();
            row.extend(drift.map_or([f64::NAN; 2], |drift| [drift.distance, drift.in_cells]));
        }
        for (_, energy) in simulation.yielding() {
            row.extend([energy.stored, energy.plastic, energy.algorithmic]);
        }
        row
    }
}

/// The energy balance at the time of the row; `kinetic_energy` is that of the velocities, at `velocity_time`.
const BALANCE: [&str; 9] = [
    "energy_kinetic",
    "energy_contact",
    "energy_external_work",
    "energy_damping",
    "energy_friction",
    "energy_impact",
    "energy_plastic",
    "energy_removed",
    "energy_remainder",
];

/// Energy that left through absorbing planes \[J\].
const ABSORBED: &str = "energy_absorbed";

/// Mass of pore water \[kg\], what its compression stores, and what its drag took \[J\].
const WATER: [&str; 3] = ["water_mass", "energy_water", "energy_drag"];

/// Work of the strain of a body that yields, by its destination \[J\].
const YIELDING: [&str; 3] = ["stored", "plastic", "algorithmic"];

/// Distance of the farthest vertex of mortar contact from its place in the body \[m\], and over the smallest size of a cell.
const DRIFT: [&str; 2] = ["boundary_drift", "boundary_drift_in_cells"];

/// True if a body has a boundary, whose vertices could drift.
fn has_drift(simulation: &Simulation) -> bool {
    !simulation.scene().mortar.boundaries.is_empty()
}
