//! Pore water to the nodes: mass, momentum, force of the pressure, drag.

use super::point::PointNodes;
use crate::layout::Layout;
use crate::simulation::mapping::ParticleToGrid;
use crate::stage::p2g::Carry;
use crate::stage::solve::Planes;

/// Maps the water of all bodies onto planes: to the lanes of a node mass, momentum, the force of the pressure
/// sum V p grad S, and the drag along the first axis sum V D S; a second mapping has momentum in place of the force alone.
pub(in crate::simulation) fn map(from: &ParticleToGrid<'_>, planes: &mut Planes<'_>, carry: Carry) {
    let layers = from.layers_onto(planes);
    for (set, body) in from.sets.iter().zip(from.bodies) {
        let (Some(water), Some(column)) = (&body.water, set.layout.water) else {
            continue;
        };
        let axes = set.layout.axes;
        let columns = &set.columns;
        let pressure = &columns[column + axes];
        for layer in layers.start..layers.end.min(set.layers.len() - 1) {
            for p in set.in_layers(layer..layer + 1) {
                let volume = columns[Layout::VOLUME][p];
                let porosity = water.porosity_of(columns[Layout::MASS][p], volume);
                let mass = porosity * water.density * volume;
                let momentum = set.vector(column, p).map(|w| mass * w);
                let force = volume * pressure[p];
                let drag = volume * water.drag(porosity, 0);
                let mapping = &body.mapping;
                let nodes = PointNodes::of(columns, mapping, (planes.shape, from.stencil), p);
                each(planes, &nodes, |line, weight, gradient| match carry {
                    Carry::Remap => {
                        for axis in 0..axes {
                            line[4 + axis] += momentum[axis] * weight;
                        }
                    }
                    _ => {
                        line[0] += mass * weight;
                        for axis in 0..axes {
                            line[1 + axis] += momentum[axis] * weight;
                            line[4 + axis] += force * gradient[axis];
                        }
                        line[7] += drag * weight;
                    }
                });
            }
        }
    }
}

/// Calls `act` for the nodes of a particle that lie in the owned planes.
fn each(
    planes: &mut Planes<'_>,
    nodes: &PointNodes,
    mut act: impl FnMut(&mut [f64; 8], f64, [f64; 3]),
) {
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
