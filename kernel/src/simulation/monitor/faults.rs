//! Particles that went wrong in a pass: the run stops with a typed error, or goes on with an event.

use crate::layout::Layout;
use crate::model::Outside;
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::values::{Event, EventKind, ParticleAt, StepError, StepErrorKind};
use crate::stage::g2p::FaultKind;

impl Cycle {
    /// Stops for a fault, or removes particles outside the mesh where the scene says so.
    pub(crate) fn judge(&mut self, faults: &[(usize, usize, FaultKind)]) -> Result<(), StepError> {
        for &(set, p, kind) in faults {
            match self.fatal(set, p, kind) {
                Some(kind) => return Err(self.error(kind)),
                None => self.remove_outside(set)?,
            }
        }
        Ok(())
    }

    /// The error for which a run stops; `None` for a particle that is removed.
    pub(crate) fn fatal(&self, set: usize, p: usize, kind: FaultKind) -> Option<StepErrorKind> {
        match kind {
            FaultKind::NotFinite => Some(self.not_finite(set, p)),
            FaultKind::Inverted => Some(StepErrorKind::Inverted(self.particle_at(set, p))),
            FaultKind::Outside if self.model.settings.outside == Outside::Stop => {
                Some(StepErrorKind::Outside(self.particle_at(set, p)))
            }
            FaultKind::Outside => None,
        }
    }

    /// Removes all particles of a set outside the mesh, and closes their accounts.
    pub(crate) fn remove_outside(&mut self, set: usize) -> Result<(), StepError> {
        let (gone, here) = match self.outside(set) {
            Ok(gone) => {
                let own = self.own_particles(&self.state.sets[set]);
                let here = gone.iter().filter(|p| own.contains(**p));
                let here = here.map(|&p| self.account(set, p)).collect();
                (gone, Ok(here))
            }
            Err(kind) => (vec![], Err(kind)),
        };
        let removed = self
            .join_removed(set, here)
            .map_err(|kind| self.error(kind))?;
        self.count_removed(removed.len());
        for one in removed {
            self.state.ledger.removed += one.energy;
            self.state.ledger.dead_load_origin -= one.load;
            self.state.events.push(Event {
                step: self.state.clock.step + 1,
                time: self.state.clock.time,
                kind: EventKind::Removed(one.at),
            });
        }
        self.state.sets[set].remove(&gone, &self.work.grid.team);
        Ok(())
    }

    /// The particles of a set outside the mesh, or the fault of one that no removal mends.
    fn outside(&self, set: usize) -> Result<Vec<usize>, StepErrorKind> {
        let mesh = &self.model.settings.mesh;
        let mut gone = vec![];
        for p in 0..self.state.sets[set].len() {
            let x = self.state.sets[set].position(p);
            let layout = &self.state.sets[set].layout;
            let sound = (Layout::VOLUME..Layout::stress(layout.axes) + layout.stress_components())
                .chain(layout.variables..layout.columns);
            // The first fault of the set was a particle outside; others may lie behind it.
            if { sound }.any(|column| !self.state.sets[set].columns[column][p].is_finite()) {
                return Err(self.not_finite(set, p));
            }
            if self.state.sets[set].columns[Layout::VOLUME][p] <= 0.0 {
                return Err(StepErrorKind::Inverted(self.particle_at(set, p)));
            }
            let inside = (0..self.model.plan.axes)
                .all(|axis| x[axis] >= 0.0 && x[axis] <= mesh.cells[axis] as f64 * mesh.cell[axis]);
            if !inside {
                gone.push(p);
            }
        }
        Ok(gone)
    }

    /// Quantity of a particle that is not finite: the result of its law, or another.
    fn not_finite(&self, set: usize, p: usize) -> StepErrorKind {
        const STRESS: [&[&str]; 2] = [
            &["stress xx", "stress yy", "stress zz", "stress xy"],
            &[
                "stress xx",
                "stress yy",
                "stress zz",
                "stress yz",
                "stress xz",
                "stress xy",
            ],
        ];
        let particle = self.particle_at(set, p);
        let ParticleSet {
            layout, columns, ..
        } = &self.state.sets[set];
        let stress = Layout::stress(layout.axes);
        let others =
            (Layout::VOLUME..stress).chain(stress + layout.stress_components()..layout.variables);
        if { others }.any(|column| !columns[column][p].is_finite()) {
            return StepErrorKind::NotFinite(particle);
        }
        let given = (STRESS[layout.axes - 2].iter().zip(stress..))
            .map(|(name, column)| ((*name).to_owned(), column))
            .chain(
                (layout.components()).map(|(variable, i, column)| (variable.component(i), column)),
            );
        let Some((column, _)) = { given }.find(|(_, column)| !columns[*column][p].is_finite())
        else {
            return StepErrorKind::NotFinite(particle);
        };
        StepErrorKind::Law {
            particle,
            law: self.model.bodies[set].law.name(),
            column,
        }
    }

    pub(crate) fn particle_at(&self, set: usize, p: usize) -> ParticleAt {
        self.view().particle_at(set, p)
    }

    /// Takes four nodes per axis once a particle domain exceeds half a cell.
    pub(crate) fn widen_stencil(&mut self) -> Result<(), StepError> {
        let half_length = self
            .state
            .found
            .iter()
            .map(|found| found.half_length)
            .fold(0.0, f64::max);
        if half_length > 1.0 {
            return Err(self.error(StepErrorKind::DomainTooLarge { half_length }));
        }
        if half_length > 0.5 && self.state.stencil == 3 {
            self.state.stencil = 4;
            self.state.travel = f64::INFINITY;
            self.state.events.push(Event {
                step: self.state.clock.step + 1,
                time: self.state.clock.time,
                kind: EventKind::WiderStencil,
            });
        }
        Ok(())
    }
}
