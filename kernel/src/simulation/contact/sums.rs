//! What acts on all fields of a slab, and what is measured of them.

use super::{all, driven};
use crate::contact::layers::SlabFields;
use crate::simulation::Simulation;
use crate::simulation::acting::Acting;
use crate::simulation::passes::forces;
use crate::stage::solve::{EmptyNode, Forces, NodeForce, PlaneSums, Planes};

impl Simulation {
    /// Ghost nodes of all fields and sums of the last mapping, plane by plane, with the velocities after contact with
    /// surfaces.
    pub(in crate::simulation) fn sums_of_fields(&mut self, acting: &Acting) -> Vec<PlaneSums> {
        let forces = forces(&self.scene, &self.plan, &self.loads, acting.kick);
        let (driven, measure) = (driven(&self.bodies), self.plan.measure);
        let layers = &mut self.contact.layers;
        let per_slab = layers.visit(&mut self.field, |mut fields| {
            for planes in all(&mut fields) {
                planes.unfold(&acting.walls, true);
            }
            let mut sums = vec![PlaneSums::default(); fields.common.range.len()];
            // The loads found their nodes when they were added.
            if let Ok(loads) = shared_loads(&fields, forces.loads, &driven) {
                add_sums(&mut fields, &loads, &forces, &driven, measure, &mut sums);
            }
            sums
        });
        per_slab.into_iter().flatten().collect()
    }
}

/// Adds the sums of all fields whose motion is not prescribed to those of the planes. `loads` are those of each field.
pub(super) fn add_sums(
    fields: &mut SlabFields<'_>,
    loads: &[Vec<NodeForce>],
    forces: &Forces<'_>,
    driven: &[bool],
    measure: bool,
    sums: &mut [PlaneSums],
) {
    for (number, own) in loads.iter().enumerate() {
        let forces = Forces {
            loads: own,
            ..*forces
        };
        let body = number.checked_sub(1).map(|i| fields.layers[i].body);
        if body.is_none_or(|body| !driven[body]) {
            let mut own = vec![PlaneSums::default(); sums.len()];
            number_of(fields, number).add_sums(&forces, measure, &mut own);
            for (sums, own) in sums.iter_mut().zip(&own) {
                sums.power += own.power;
                sums.kinetic += own.kinetic;
                sums.unbalanced_squared += own.unbalanced_squared;
            }
        }
    }
}

/// A field by its number: the common one, then the layers.
pub(in crate::simulation) fn number_of<'f, 'a>(
    fields: &'f mut SlabFields<'a>,
    number: usize,
) -> &'f mut Planes<'a> {
    match number {
        0 => &mut fields.common,
        _ => &mut fields.layers[number - 1].planes,
    }
}

/// Shares nodal loads between the fields of a node by their mass. Lists by number of the field.
pub(in crate::simulation) fn shared_loads(
    fields: &SlabFields<'_>,
    loads: &[NodeForce],
    driven: &[bool],
) -> Result<Vec<Vec<NodeForce>>, EmptyNode> {
    let shape = fields.common.shape;
    let first = fields.common.range.start * shape.plane_nodes();
    let last = fields.common.range.end * shape.plane_nodes();
    let mut shared = vec![vec![]; fields.layers.len() + 1];
    for load in loads.iter().filter(|l| (first..last).contains(&l.node)) {
        let [plane, row, k] = shape.indices(load.node);
        let mass = |planes: &Planes<'_>| {
            if planes.rows.span(plane, row).contains(&k) {
                planes.nodes[load.node - first][0]
            } else {
                0.0
            }
        };
        let masses: Vec<f64> = std::iter::once(mass(&fields.common))
            .chain(fields.layers.iter().map(|layer| {
                if driven[layer.body] {
                    0.0
                } else {
                    mass(&layer.planes)
                }
            }))
            .collect();
        let total: f64 = masses.iter().sum();
        if total <= 0.0 {
            return Err(EmptyNode(load.node));
        }
        for (own, mass) in shared.iter_mut().zip(masses) {
            if mass > 0.0 {
                own.push(NodeForce {
                    force: load.force.map(|f| f * (mass / total)),
                    ..*load
                });
            }
        }
    }
    Ok(shared)
}
