//! A pressure on the skeleton of a column that follows its top.
//!
//! Tractions stay where they are in space. The virtual power of a uniform pressure q on the whole surface of a body is -q times
//! the integral of div v, so that a node gets -q sum V grad S over the particles, as from standing water: wherever the surface
//! is, and the stress -q of a column at rest cancels with it node by node. Walls take what acts on them.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use proctor_kernel::layout::Layout;
use proctor_scene::simulation::{
    Condition, EmptyNode, FieldNodes, NodalConditions, Node, StepView,
};

/// A pressure on a column of one cell's width on the base y = 0, of particles with domains.
pub struct Lid {
    /// Cell size \[m\].
    cell: f64,
    /// Pressure at a time \[Pa; s\].
    pressure: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Forces on nodes \[N\], by their numbers along both axes.
    forces: Mutex<BTreeMap<[i64; 2], [f64; 2]>>,
}

impl Lid {
    /// A lid on a column of a cell size \[m\], by the pressure at a time \[Pa; s\].
    pub fn new(cell: f64, pressure: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self {
            cell,
            pressure: Box::new(pressure),
            forces: Mutex::default(),
        }
    }

    /// Calls `act` with each node of the skeleton that the lid presses and its force \[N\].
    fn on_nodes(&self, field: &mut FieldNodes<'_, '_>, act: impl Fn(&mut Node<'_>, [f64; 3])) {
        let forces = self.forces.lock().unwrap_or_else(PoisonError::into_inner);
        field.for_each(|node| {
            let [x, y, _] = node.position();
            let at = [x, y].map(|x| (x / self.cell).round() as i64);
            if let Some([along, up]) = forces.get(&at) {
                act(node, [*along, *up, 0.0]);
            }
        });
    }
}

/// Weight of the node 0 and its derivative, at a place with half of the length of a domain \[cells\]: the mean of the hat.
fn weight(at: f64, half: f64) -> [f64; 2] {
    let hat = |x: f64| (1.0 - x.abs()).max(0.0);
    // Integral of the hat from the left.
    let sum = |x: f64| {
        let x = x.clamp(-1.0, 1.0);
        0.5 + x - 0.5 * x * x.abs()
    };
    let (low, high, length) = (at - half, at + half, 2.0 * half);
    [
        (sum(high) - sum(low)) / length,
        (hat(high) - hat(low)) / length,
    ]
}

impl Condition for Lid {
    fn prescribe(&self, view: &StepView<'_>, nodal: &mut NodalConditions) {
        let [before, after] = nodal.half_steps;
        let pressure = (self.pressure)(0.5 * (before + after));
        let mut forces = self.forces.lock().unwrap_or_else(PoisonError::into_inner);
        forces.clear();
        for (set, body) in view.particles.iter().zip(view.bodies) {
            let of_body = body.mapping.half_length;
            let own = body.mapping.half_length_column;
            for p in 0..set.len() {
                let half = [0, 1]
                    .map(|axis| own.map_or(of_body[axis], |column| set.columns[column + axis][p]));
                let volume = set.columns[Layout::VOLUME][p];
                let [x, y] = [0, 1].map(|axis| set.position(p)[axis] / self.cell);
                for i in 0..=1 {
                    let [across, along] = weight(x - f64::from(i), half[0]);
                    let lowest = y.floor() as i64 - 1;
                    for j in lowest..=lowest + 3 {
                        let [weight, slope] = weight(y - j as f64, half[1]);
                        let of = -pressure * volume / self.cell;
                        // What lies below the base is the image of the node above it.
                        let sign = if j < 0 { -1.0 } else { 1.0 };
                        let force = forces.entry([i64::from(i), j.abs()]).or_default();
                        force[0] += of * along * weight;
                        force[1] += sign * of * across * slope;
                    }
                }
            }
        }
    }

    fn before(&self, field: &mut FieldNodes<'_, '_>) -> Result<(), EmptyNode> {
        // The method itself has one lifetime of a node, not any.
        #[allow(clippy::redundant_closure_for_method_calls)]
        self.on_nodes(field, |node, force| node.add_force(force));
        Ok(())
    }

    fn settled(&self, field: &mut FieldNodes<'_, '_>) {
        self.on_nodes(field, |node, force| {
            let v = node.velocity();
            node.add_power((0..3).map(|axis| force[axis] * v[axis]).sum());
        });
    }
}
