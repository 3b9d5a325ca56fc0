//! Contact forces of rigid surfaces and driven bodies, in sum and at the nodes, for output.

use super::obstacle::RigidObstacle;
use super::{SurfaceContact, TouchingParticles};
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{Grid, NodalForce};

impl SurfaceContact {
    /// Force of a surface on a body in the last step \[N\].
    #[must_use]
    pub fn force_on(&self, surface: usize, set: usize) -> Vector {
        if self.last_kick > 0.0 {
            self.last[surface][set].map(|i| i / self.last_kick)
        } else {
            [0.0; 3]
        }
    }

    /// Force on a body in the last step \[N\] of contact with the shapes of driven bodies; on a driven one the reaction.
    #[must_use]
    pub fn shape_force_on(&self, set: usize) -> Vector {
        let mut sum = [0.0; 3];
        if self.last_kick <= 0.0 {
            return sum;
        }
        for (rigid, impulses) in self.rigid.iter().zip(&self.last) {
            let RigidObstacle::Driven(driven) = rigid else {
                continue;
            };
            let force = impulses[driven.partner].map(|i| i / self.last_kick);
            for axis in 0..3 {
                if driven.partner == set {
                    sum[axis] += force[axis];
                } else if driven.body == set {
                    sum[axis] -= force[axis];
                }
            }
        }
        sum
    }

    /// Impulse of a surface on a body since the start \[N s\].
    #[must_use]
    pub fn impulse_on(&self, surface: usize, set: usize) -> Vector {
        self.total[surface][set]
    }
}

impl SurfaceContact {
    /// Forces at the nodes, particle by particle. Particles within the threshold that do not touch bring no force. A driven body
    /// has the reaction, at those of the nodes that it reaches itself.
    pub(super) fn forces_at_nodes(&self, grid: &Grid, give: &mut dyn FnMut(NodalForce)) {
        if self.last_kick <= 0.0 {
            return;
        }
        let TouchingParticles { touches, keys, .. } = &self.trial;
        for (touch, key) in touches.list.iter().zip(keys) {
            let force = touch.impulse().map(|i| i / self.last_kick);
            let gap = touch.gap;
            let mut give = |body: usize, node: usize, force: Vector| {
                give(NodalForce {
                    body,
                    node,
                    force,
                    gap,
                });
            };
            let weights = &touches.weights[touch.weights.clone()];
            let nodes = || weights.iter().map(|(n, w)| (touches.nodes[*n].node, w));
            for (node, w) in nodes() {
                let share = std::array::from_fn(|axis| w[axis] * force[axis]);
                give(key.set, node, share);
            }
            let RigidObstacle::Driven(driven) = &self.rigid[key.surface] else {
                continue;
            };
            let Some(field) = grid.own_field(driven.body) else {
                continue;
            };
            let own = || nodes().filter(|(node, _)| field.mass(&grid.shape, *node) > 0.0);
            let sum: Vector = std::array::from_fn(|axis| own().map(|(_, w)| w[axis]).sum());
            let part = |w: f64, sum: f64| if sum > 0.0 { w / sum } else { 0.0 };
            for (node, w) in own() {
                let share = std::array::from_fn(|k| -force[k] * part(w[k], sum[k]));
                give(driven.body, node, share);
            }
        }
    }
}
