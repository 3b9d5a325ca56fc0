//! Nodes to the pore water of particles: its velocity and the pressure.

use super::nodes::hand_over;
use super::open::reach_beyond;
use crate::fields::shares;
use crate::layout::Layout;
use crate::model::{CycleSettings, POROSITIES, PlaneCondition, StressScheme};
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::values::{StepError, StepErrorKind};
use crate::stage::g2p::{WaterG2p, WaterTask};
use std::sync::atomic::{AtomicBool, Ordering};

impl Cycle {
    /// Gathers the velocity of the water of all bodies, where there is any: it gets its increments, and the pressure changes over a
    /// time \[s\] by mean velocities that begin at a lane of the nodes. Positions are those of the mapping still.
    ///
    /// With the share f of PIC, w = (1 - f) w + sum S ((1 - f) dw + f w), p -= (`K_w`/n) dt sum grad S . (v + n (w - v)).
    ///
    /// # Errors
    /// A particle whose porosity is outside [`POROSITIES`].
    pub(in crate::simulation) fn gather_water(
        &mut self,
        kicks: bool,
        compress: Option<(f64, usize)>,
    ) -> Result<(), StepError> {
        if !self.work.grid.has_water {
            return Ok(());
        }
        let pic = self.model.settings.transfer.pic_fraction;
        let share = if kicks { pic } else { 0.0 };
        let lane = compress.map(|(_, lane)| lane);
        let planes = &self.model.settings.water_planes;
        let is_open = |axis: usize, side: usize| {
            planes.is_some_and(|planes| planes[axis][side] == PlaneCondition::Free)
        };
        self.work.grid.visit(|mut slab| {
            hand_over(&mut slab, share, lane);
            reach_beyond(&mut slab, is_open);
        });
        self.exchange_nodes();
        let grid = &mut self.work.grid;
        let task = WaterTask {
            kick: kicks.then_some(1.0 - pic),
            compress,
            averaged: self.model.plan.cell_average,
        };
        let Some(field) = grid.fields.last() else {
            return Ok(());
        };
        let nodes = field.nodes.lines();
        let particles = self.state.sets.iter().map(ParticleSet::len).sum();
        let most = grid.share_of_particles(particles);
        let bodies = &self.model.bodies;
        let wet = (self.state.sets.iter_mut().zip(bodies))
            .filter_map(|(set, body)| Some((set, body, body.water.as_ref()?)));
        let parts = wet.flat_map(|(set, body, water)| {
            let (ranges, layout) = (shares(set.len(), most), set.layout);
            (set.parts_mut(ranges)).map(move |(_, columns)| (body, water, layout, columns))
        });
        let (lanes, axes, stencil) = (self.model.lanes, self.model.plan.axes, self.state.stencil);
        let all_sound = AtomicBool::new(true);
        grid.team.each(parts, |(body, water, layout, mut columns)| {
            let call = WaterG2p {
                columns: &mut columns,
                layout: &layout,
                mapping: &body.mapping,
                water,
                nodes,
                task,
            };
            if !call.run(lanes, axes, stencil) {
                all_sound.store(false, Ordering::Relaxed);
            }
        });
        let faulty = !all_sound.into_inner();
        if self.holds_anywhere(faulty) {
            self.watch_porosity()
        } else {
            Ok(())
        }
    }

    /// The first particle whose porosity no soil has.
    #[cold]
    fn watch_porosity(&self) -> Result<(), StepError> {
        for (index, (set, body)) in self.state.sets.iter().zip(&self.model.bodies).enumerate() {
            let Some(water) = &body.water else { continue };
            let columns = [Layout::MASS, Layout::VOLUME].map(|column| &set.columns[column]);
            let porosity = |p: usize| water.porosity_of(columns[0][p], columns[1][p]);
            let [low, high] = POROSITIES;
            let own = self.own_particles(set);
            let outside = own.iter().find(|p| !(low..=high).contains(&porosity(*p)));
            let here = outside.map(|p| (p, porosity(p)));
            if let Some((particle, porosity)) = self.join_first(index, here) {
                return Err(self.error(StepErrorKind::Porosity { particle, porosity }));
            }
        }
        Ok(())
    }
}

/// Nodes of the water that ranks send each other once more in a step, since particles gather mean velocities and increments from them:
/// the number of times.
pub(in crate::simulation) fn exchanges_per_step(settings: &CycleSettings) -> usize {
    1 + usize::from(settings.scheme == StressScheme::Musl)
}
