//! Nodes to the pore water of particles: its velocity and the pressure.

use super::nodes::flux;
use crate::grid::{GridShape, Line};
use crate::layout::Layout;
use crate::model::{POROSITIES, PoreWater};
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::fields::shares;
use crate::simulation::values::{StepError, StepErrorKind};
use crate::stage::Mapping;
use crate::stage::water::PointNodes;

/// A pass over the water of particles.
#[derive(Clone, Copy, Debug)]
pub(in crate::simulation) struct WaterTask {
    /// Add the velocity increments.
    pub(in crate::simulation) kick: bool,
    /// Time over which the pressure changes \[s\], and the lane of a node where the velocities begin that change it.
    pub(in crate::simulation) compress: Option<(f64, usize)>,
}

/// Nodes of skeleton and water that particles gather from.
struct Nodes<'a> {
    skeleton: &'a [Line],
    water: &'a [Line],
    shape: &'a GridShape,
    stencil: usize,
}

impl Cycle {
    /// Gathers the velocity of the water of all bodies, where there is any. Positions are those of the mapping still.
    ///
    /// w += sum S dw, p -= (`K_w`/n) dt sum grad S . (v + n (w - v)).
    ///
    /// # Errors
    /// A particle whose porosity is outside [`POROSITIES`].
    pub(in crate::simulation) fn gather_water(&mut self, task: WaterTask) -> Result<(), StepError> {
        if !self.work.grid.has_water {
            return Ok(());
        }
        let grid = &self.work.grid;
        let Some(water) = grid.fields.last() else {
            return Ok(());
        };
        let nodes = Nodes {
            skeleton: grid.fields[0].nodes.lines(),
            water: water.nodes.lines(),
            shape: &grid.shape,
            stencil: self.state.stencil,
        };
        let particles = self.state.sets.iter().map(ParticleSet::len).sum();
        let most = grid.share_of_particles(particles);
        let pic = self.model.settings.transfer.pic_fraction;
        let bodies = &self.model.bodies;
        let wet = (self.state.sets.iter_mut().zip(bodies))
            .filter_map(|(set, body)| Some((set, body, body.water?)));
        let parts = wet.flat_map(|(set, body, water)| {
            let (ranges, layout) = (shares(set.len(), most), set.layout);
            (set.parts_mut(ranges)).map(move |(_, columns)| (body, water, layout, columns))
        });
        grid.team.each(parts, |(body, water, layout, mut columns)| {
            gather(
                &mut columns,
                &layout,
                (&body.mapping, &water),
                &nodes,
                task,
                pic,
            );
        });
        if task.compress.is_some() {
            self.watch_porosity()?;
        }
        Ok(())
    }

    /// The first particle whose porosity no soil has.
    fn watch_porosity(&self) -> Result<(), StepError> {
        for (index, (set, body)) in self.state.sets.iter().zip(&self.model.bodies).enumerate() {
            let Some(water) = &body.water else { continue };
            let columns = [Layout::MASS, Layout::VOLUME].map(|column| &set.columns[column]);
            let all = columns[0].iter().zip(columns[1]);
            let [low, high] = POROSITIES;
            let outside = |(mass, volume): (&f64, &f64)| {
                let n = water.porosity_of(*mass, *volume);
                !(low..=high).contains(&n)
            };
            if let Some(p) = all.clone().position(outside) {
                let porosity = water.porosity_of(columns[0][p], columns[1][p]);
                let particle = self.particle_at(index, p);
                return Err(self.error(StepErrorKind::Porosity { particle, porosity }));
            }
        }
        Ok(())
    }
}

fn gather(
    columns: &mut [&mut [f64]],
    layout: &Layout,
    (mapping, water): (&Mapping, &PoreWater),
    nodes: &Nodes<'_>,
    task: WaterTask,
    pic: f64,
) {
    let Some(first) = layout.water else { return };
    let axes = layout.axes;
    for p in 0..columns[0].len() {
        let point = PointNodes::of(columns, mapping, (nodes.shape, nodes.stencil), p);
        let [a, b, c] = point.base;
        let (mut velocity, mut increment, mut divergence) = ([0.0; 3], [0.0; 3], 0.0);
        for i in 0..point.count[0] {
            for j in 0..point.count[1] {
                let row = nodes.shape.index([a + i, b + j, c]);
                for k in 0..point.count[2] {
                    let (weight, gradient) = point.at([i, j, k]);
                    let flow = &nodes.water[row + k];
                    if task.kick {
                        for axis in 0..axes {
                            velocity[axis] += weight * flow[1 + axis];
                            increment[axis] += weight * flow[4 + axis];
                        }
                    }
                    if let Some((_, lane)) = task.compress {
                        divergence += flux(&nodes.skeleton[row + k], flow, lane, &gradient);
                    }
                }
            }
        }
        if task.kick {
            for axis in 0..axes {
                let w = &mut columns[first + axis][p];
                let flip = *w + increment[axis];
                *w = flip + pic * (velocity[axis] - flip);
            }
        }
        if let Some((dt, _)) = task.compress {
            let porosity = water.porosity_of(columns[Layout::MASS][p], columns[Layout::VOLUME][p]);
            columns[first + axes][p] -= water.bulk / porosity * dt * divergence;
        }
    }
}
