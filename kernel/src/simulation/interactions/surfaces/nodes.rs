//! What surfaces did at the nodes, for those who look at it from outside.

use super::{Found, Surfaces};
use crate::scene::Vector;
use crate::simulation::Simulation;

impl Simulation {
    /// Force of the surfaces on a body at a node in the last step \[N\] and the gap of the particle that brought it
    /// there \[m\], particle by particle: `(body, node, force, gap)`. Particles within the threshold that do not touch
    /// bring no force.
    pub(in crate::simulation) fn surface_forces_at_nodes(
        &self,
    ) -> impl Iterator<Item = (usize, usize, Vector, f64)> {
        let surfaces = self.interaction::<Surfaces>();
        let surfaces = surfaces.into_iter().filter(|s| s.last_kick > 0.0);
        surfaces.flat_map(|s| {
            let Found {
                touches, places, ..
            } = &s.trial;
            touches
                .list
                .iter()
                .zip(places)
                .flat_map(move |(touch, place)| {
                    let force = touch.impulse().map(|i| i / s.last_kick);
                    let weights = &touches.weights[touch.weights.clone()];
                    weights.iter().map(move |(node, w)| {
                        let share = std::array::from_fn(|axis| w[axis] * force[axis]);
                        (place.set, touches.nodes[*node].node, share, touch.gap)
                    })
                })
        })
    }
}
