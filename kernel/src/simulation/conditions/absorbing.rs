//! Absorbing planes: dashpots with the impedance of the ground, through which waves leave (Lysmer and Kuhlemeyer 1969).
//!
//! At a node of area A the ground beyond exerts f = -Z (v - 2 `v_in`) - k d + R per axis. Z is A times density times wave
//! speed: that of compression along the normal of the plane, that of shear along the plane. `v_in` is the velocity of a wave
//! that comes in, k the stiffness of a spring, d the displacement since the start. R balances the stress and the weight that
//! are there at the start, so that ground at rest stays at rest.
//!
//! Beside a base that shakes the ground beyond a side moves too: v is then that against free ground (`free_ground.rs`).
//!
//! An antisymmetric plane has R alone: the ground beside it bears the stress that is there at the start.
//!
//! v is the mean of the velocities before and after the kick. The dashpot is then implicit: it takes exactly Z v² dt, is of
//! second order in time, and bounds no time step. Beyond the plane the motion goes on linearly
//! ([`Wall::extrapolates`](crate::stage::solve::Wall)).

use super::{ConditionResult, ConditionType};
use crate::fields::{Owner, SlabField};
use crate::grid::{GridShape, Line};
use crate::model::{CycleSettings, Vector};
use crate::simulation::Cycle;
use crate::simulation::context::{Condition, FieldNodes, NodalConditions};
use crate::simulation::values::{AbsorbingNode, Drift, StepError, StepErrorKind};
use crate::stage::solve::{DashpotNode, EmptyNode, ExactStepSums, StepSum};
use std::sync::Arc;

/// Cells by which the material at a plane may move off the dashpots, which stay at their nodes.
const MOST_TRAVEL: f64 = 0.5;

struct AbsorbingPlanes;

/// Absorbing planes.
pub(super) const ABSORBING_PLANES: ConditionType = ConditionType {
    plan_entries: |settings, list| {
        let why = if settings.has_free_ground() {
            "waves leave through a plane; free ground moves beside the sides"
        } else if settings.absorbs() {
            "waves leave through a plane"
        } else {
            "antisymmetric planes bear the stress of the start"
        };
        list.choose(
            "stage",
            "reactions of planes",
            settings.has_reactions(),
            why,
            "no plane is absorbing, or antisymmetric with stress at the start",
        );
    },
    make: Some(of),
    planes: false,
};

fn of(settings: &CycleSettings, _: &GridShape) -> Option<ConditionResult> {
    settings
        .has_reactions()
        .then(|| Ok(Arc::new(AbsorbingPlanes) as _))
}

impl Condition for AbsorbingPlanes {
    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        for_dashpots(field, |line, dashpot, share, _| {
            for axis in 0..3 {
                line[4 + axis] += share * dashpot.force[axis];
            }
        });
        Ok(())
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        let kick = field.kick();
        for_dashpots(field, |line, dashpot, share, sums| {
            for axis in 0..3 {
                let impedance = share * dashpot.impedance[axis];
                if impedance == 0.0 {
                    continue;
                }
                let twice_beta = impedance * kick / line[0];
                let (v, dv) = (line[1 + axis], line[4 + axis]);
                let before = v - dv;
                let change = (dv - twice_beta * before) / (1.0 + 0.5 * twice_beta);
                (line[1 + axis], line[4 + axis]) = (before + change, change);
                let mean = before + 0.5 * change;
                sums.add(StepSum::Absorbed, impedance * mean * mean * kick);
            }
        });
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        for_dashpots(field, |line, dashpot, share, sums| {
            let power = (0..3).map(|axis| dashpot.force[axis] * line[1 + axis]);
            sums.add(StepSum::Power, share * power.sum::<f64>());
        });
    }
}

/// Calls `act` with each node of absorbing planes where a field has mass, the share of the field in the mass there, and the
/// sums of the slab.
fn for_dashpots(
    field: &mut FieldNodes<'_, '_>,
    mut act: impl FnMut(&mut Line, &DashpotNode, f64, &mut ExactStepSums),
) {
    let shape = field.slab.shape();
    let [first, last] =
        [field.slab.range().start, field.slab.range().end].map(|p| p * shape.plane_nodes());
    let all = &field.context.nodal.absorbing;
    let begin = all.partition_point(|dashpot| dashpot.node < first);
    let owned = all[begin..].iter();
    for dashpot in owned.take_while(|dashpot| dashpot.node < last) {
        let [plane, row, k] = shape.indices(dashpot.node);
        if !field.slab.owns_row(row) {
            continue;
        }
        let index = dashpot.node - first;
        let mass = |field: &SlabField<'_>| {
            if field.planes.rows.span(plane, row).contains(&k) {
                field.planes.nodes[index][0]
            } else {
                0.0
            }
        };
        // The surroundings of pore water are those of the skeleton.
        let fields = field.slab.fields.iter();
        let fields = fields.filter(|field| field.owner != Owner::Water);
        let own = mass(&field.slab.fields[field.number]);
        if own <= 0.0 {
            continue;
        }
        let share = if fields.clone().count() == 1 {
            1.0
        } else {
            own / fields.map(mass).sum::<f64>()
        };
        let (planes, _, sums) = field.parts();
        act(&mut planes.nodes[index], dashpot, share, sums);
    }
}

impl Cycle {
    /// The absorbing nodes of a step, with the forces of this time.
    pub(in crate::simulation) fn prescribe_absorbing(&self, nodal: &mut NodalConditions) {
        if self.state.absorbing.is_empty() {
            return;
        }
        let incoming = self.model.settings.ground_beyond.incoming.as_ref();
        let incoming_velocity = self.wave_of(nodal);
        let shape = &self.work.grid.shape;
        nodal
            .absorbing
            .extend(self.state.absorbing.iter().map(|one| {
                let enters = incoming
                    .is_some_and(|wave| shape.lies_in_plane(one.node, wave.axis, wave.side));
                let wave = if enters { incoming_velocity } else { [0.0; 3] };
                DashpotNode {
                    node: one.node,
                    impedance: one.impedance,
                    force: std::array::from_fn(|axis| {
                        one.reaction[axis] - one.stiffness[axis] * one.displacement[axis]
                            + 2.0 * one.impedance[axis] * wave[axis]
                    }),
                }
            }));
        self.add_free_ground(nodal, incoming_velocity);
    }

    /// Velocity of the wave that comes in, in the middle of a kick \[m/s\].
    pub(in crate::simulation) fn wave_of(&self, nodal: &NodalConditions) -> Vector {
        let middle = 0.5 * (nodal.half_steps[0] + nodal.half_steps[1]);
        let wave = self.model.incoming.as_ref();
        wave.map_or([0.0; 3], |wave| wave.at(middle))
    }

    /// Adds the displacement increment of a step at the nodes of absorbing planes, after the equation of motion.
    ///
    /// # Errors
    /// The material at a plane has moved off it by half a cell: the dashpots, which stay at their nodes, hold nothing there.
    pub(in crate::simulation) fn move_absorbing_planes(
        &mut self,
        nodal: &NodalConditions,
        drift: &Drift,
    ) -> Result<(), StepError> {
        if self.state.absorbing.is_empty() {
            return Ok(());
        }
        self.move_free_ground(nodal, drift);
        let mut nodes = std::mem::take(&mut self.state.absorbing);
        for one in &mut nodes {
            let (mut mass, mut momentum) = (0.0, [0.0; 3]);
            for (_, rows, lines) in self.fields() {
                let [plane, row, k] = self.work.grid.shape.indices(one.node);
                let line = &lines[one.node];
                if rows.span(plane, row).contains(&k) && line[0] > 0.0 {
                    mass += line[0];
                    for axis in 0..3 {
                        momentum[axis] += line[0] * line[1 + axis];
                    }
                }
            }
            if mass > 0.0 {
                for axis in 0..3 {
                    one.displacement[axis] += momentum[axis] / mass * drift.time;
                }
            }
        }
        self.join_displacements(&mut nodes);
        self.state.absorbing = nodes;
        self.stays_at_dashpots()
    }

    /// Displacements as the ranks that own the nodes have them: every rank knows all.
    fn join_displacements(&self, nodes: &mut [AbsorbingNode]) {
        if self.ranks().is_none() {
            return;
        }
        let mut all: Vec<Vector> = nodes.iter().map(|one| one.displacement).collect();
        self.join_at_nodes(nodes.iter().map(|one| one.node), &mut all);
        for (one, displacement) in nodes.iter_mut().zip(all) {
            one.displacement = displacement;
        }
    }

    fn stays_at_dashpots(&self) -> Result<(), StepError> {
        let (mesh, shape) = (&self.model.settings.mesh, &self.work.grid.shape);
        for (axis, side) in self.model.settings.absorbing_planes() {
            let nodes = self.state.absorbing.iter();
            let on = nodes.filter(|one| shape.lies_in_plane(one.node, axis, side));
            // A node that the ground hardly touches runs ahead: each counts by its dashpot.
            let [all, sum] = on.fold([0.0; 2], |[all, sum], one| {
                let weight = one.impedance[axis];
                [all + weight, sum + weight * one.displacement[axis]]
            });
            let mean = if all > 0.0 { sum / all } else { 0.0 };
            if mean.abs() > MOST_TRAVEL * mesh.cell[axis] {
                return Err(self.error(StepErrorKind::OffAbsorbingPlane {
                    plane: (axis, side),
                    displacement: mean,
                }));
            }
        }
        Ok(())
    }
}
