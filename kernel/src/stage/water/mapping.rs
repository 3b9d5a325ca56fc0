//! Pore water to the nodes: mass, momentum, force of the pressure, drag.

use super::point::PointNodes;
use crate::grid::Line;
use crate::layout::Layout;
use crate::model::{PoreWater, Vector};
use crate::particles::ParticleSet;
use crate::stage::Mapping;
use crate::stage::p2g::Carry;
use crate::stage::solve::Planes;
use std::ops::Range;

/// The water of one set of particles on its way to the nodes.
pub(crate) struct WaterP2g<'a> {
    /// The particles.
    pub set: &'a ParticleSet,
    /// Their view of the grid.
    pub mapping: &'a Mapping,
    /// The water in their pores.
    pub water: &'a PoreWater,
    /// Nodes per axis of the stencil.
    pub stencil: usize,
    /// Layers of particles that reach the planes.
    pub layers: Range<usize>,
    /// A second mapping has momentum in the place of force: [`Carry::Remap`].
    pub carry: Carry,
}

/// Maps water onto planes: to the lanes of a node mass, momentum, the force of the pressure sum V p grad S, and the drag along
/// the first axis sum V D S.
pub(crate) fn map(from: &WaterP2g<'_>, planes: &mut Planes<'_>) {
    let WaterP2g { set, water, .. } = from;
    let Some(column) = set.layout.water else {
        return;
    };
    let axes = set.layout.axes;
    let columns = &set.columns;
    let pressure = &columns[column + axes];
    for p in set.in_layers(from.layers.clone()) {
        let volume = columns[Layout::VOLUME][p];
        let porosity = water.porosity_of(columns[Layout::MASS][p], volume);
        let mass = porosity * water.density * volume;
        let momentum = set.vector(column, p).map(|w| mass * w);
        let force = volume * pressure[p];
        let drag = volume * water.drag(porosity, 0);
        let nodes = PointNodes::of(columns, from.mapping, (planes.shape, from.stencil), p);
        each(planes, &nodes, |line, weight, gradient| {
            if from.carry == Carry::Remap {
                for axis in 0..axes {
                    line[4 + axis] += momentum[axis] * weight;
                }
                return;
            }
            line[0] += mass * weight;
            for axis in 0..axes {
                line[1 + axis] += momentum[axis] * weight;
                line[4 + axis] += force * gradient[axis];
            }
            line[7] += drag * weight;
        });
    }
}

/// Calls `act` for the nodes of a particle that lie in the owned planes.
fn each(planes: &mut Planes<'_>, nodes: &PointNodes, mut act: impl FnMut(&mut Line, f64, Vector)) {
    let first = planes.range.start * planes.shape.plane_nodes();
    let [a, b, c] = nodes.base;
    for i in (0..nodes.count[0]).filter(|i| planes.range.contains(&(a + i))) {
        for j in 0..nodes.count[1] {
            let row = planes.shape.index([a + i, b + j, c]) - first;
            for k in 0..nodes.count[2] {
                let (weight, gradient) = nodes.at([i, j, k]);
                act(&mut planes.nodes[row + k], weight, gradient);
            }
        }
    }
}
