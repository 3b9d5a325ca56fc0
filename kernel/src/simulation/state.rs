//! The state: all that a step leaves behind and the next one needs.
//!
//! It is one plain value. A checkpoint writes it, a rehearsal and a restart take it up again, a change between stages goes
//! on with it, all by [`Cycle::save`] and [`Cycle::restore`]. What can be had from the scene is not in it: neither
//! the grid, which is scratch between steps, nor laws, loads and surfaces. How it is written is not known here.

use super::Cycle;
use super::interactions::Interaction;
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::simulation::values::{RestoreError, SavedState};

impl Cycle {
    /// The state: a simulation of the same scene that takes it up goes on with the same bits.
    #[must_use]
    pub fn save(&self) -> SavedState {
        SavedState {
            state: self.state.clone(),
            interactions: self.interactions().map(Interaction::save).collect(),
        }
    }

    /// Takes up a state that was saved of a simulation of the same scene. That the scene is the same is for the caller
    /// to know. What the last step found on the way and the next one finds anew, such as gaps, pressures and energy of
    /// an interaction, is known again after a step.
    ///
    /// # Errors
    /// A state that is not one of such a scene, by the lengths of its lists and the places of its particles. The
    /// simulation is then as it was.
    pub fn restore(&mut self, saved: SavedState) -> Result<(), RestoreError> {
        self.fits(&saved)?;
        let layouts: Vec<Layout> = self.state.sets.iter().map(|set| set.layout).collect();
        self.state = saved.state;
        self.work.failed = None;
        for (set, layout) in self.state.sets.iter_mut().zip(layouts) {
            set.layout = layout;
        }
        self.work.grid.resume(&self.state.sets, self.state.stencil);
        let interactions = self.work.interactions.iter_mut();
        for (one, was) in interactions.zip(&saved.interactions) {
            one.restore(was);
        }
        self.set_fields();
        self.join_diffusivity();
        Ok(())
    }

    /// Checks that a state can be one of this scene.
    fn fits(&self, saved: &SavedState) -> Result<(), RestoreError> {
        let (own, was) = (&self.state, &saved.state);
        same("bodies", own.sets.len(), was.sets.len())?;
        same("bodies", own.sets.len(), was.found.len())?;
        for (body, (set, was)) in own.sets.iter().zip(&was.sets).enumerate() {
            self.particles_fit(body, set, was)?;
        }
        let nodes = "nodes of absorbing planes";
        same(nodes, own.absorbing.len(), was.absorbing.len())?;
        let nodes = "nodes of free ground";
        same(nodes, own.free_ground.len(), was.free_ground.len())?;
        let count = self.interactions().count();
        same("interactions", count, saved.interactions.len())?;
        for (interaction, was) in self.interactions().zip(&saved.interactions) {
            let own = interaction.save();
            same("lists of an interaction", own.len(), was.len())?;
            for ((name, own), (_, was)) in own.iter().zip(was) {
                match interaction.entry_length(name) {
                    Some(entry) => same(name, 0, was.len() % entry)?,
                    None => same(name, own.len(), was.len())?,
                }
            }
        }
        Ok(())
    }

    fn particles_fit(
        &self,
        body: usize,
        set: &ParticleSet,
        was: &ParticleSet,
    ) -> Result<(), RestoreError> {
        let columns = format!("columns of body {body}");
        same(columns, set.layout.columns, was.columns.len())?;
        for column in &was.columns {
            let values = format!("values in a column of body {body}");
            same(values, was.id.len(), column.len())?;
        }
        let layers = format!("layers of body {body}");
        same(layers, set.layers.len(), was.layers.len())?;
        let in_layers = was.layers.last().copied().unwrap_or(0);
        let ordered = was.layers.is_sorted() && in_layers == was.id.len();
        let mesh = &self.model.settings.mesh;
        let inside = (0..set.layout.axes).all(|axis| {
            let extent = mesh.cells[axis] as f64 * mesh.cell[axis];
            let x = &was.columns[Layout::POSITION + axis];
            x.iter().all(|x| (0.0..=extent).contains(x))
        });
        if ordered && inside {
            Ok(())
        } else {
            Err(RestoreError::Places {
                body,
                particles: was.id.len(),
                in_layers,
            })
        }
    }
}

fn same(what: impl Into<String>, expected: usize, found: usize) -> Result<(), RestoreError> {
    if expected == found {
        Ok(())
    } else {
        Err(RestoreError::Length {
            what: what.into(),
            expected,
            found,
        })
    }
}
