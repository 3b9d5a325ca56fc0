//! The far boundary of a half-space around the axis of an axisymmetric scene.

use std::collections::BTreeMap;

use proctor_scene::Vector;
use proctor_scene::simulation::{Condition, FieldNodes};

/// Moves the nodes of the mantle and of the bottom of a cylinder, and those beyond, to where the exact half-space has them, at a
/// constant speed until `end`.
pub struct FarBoundary {
    cell: f64,
    /// Time at which they stand \[s\].
    end: f64,
    /// Displacement of each \[m\] by its place in cells.
    nodes: BTreeMap<[i64; 2], Vector>,
}

impl FarBoundary {
    /// The boundary of a cylinder of cells of a size \[m\] whose radius and depth are `far` \[m\] and whose bottom lies at height 0,
    /// with so many cells beyond it. `displacement` has the exact displacement at a place \[m\], where it stands at `end` \[s\].
    pub fn new(
        cell: f64,
        [far, end]: [f64; 2],
        beyond: usize,
        displacement: impl Fn(Vector) -> Vector,
    ) -> Self {
        let (count, beyond) = ((far / cell).round() as i64, beyond as i64);
        let mut nodes = BTreeMap::new();
        for i in 0..=count + beyond {
            for j in -beyond..=count {
                if i >= count || j <= 0 {
                    let x = [i as f64 * cell, j as f64 * cell, 0.0];
                    nodes.insert([i, j], displacement(x));
                }
            }
        }
        Self { cell, end, nodes }
    }

    fn displacement(&self, x: Vector) -> Option<Vector> {
        let place = [x[0], x[1]].map(|x| (x / self.cell).round() as i64);
        self.nodes.get(&place).copied()
    }

    fn prescribe(&self, field: &mut FieldNodes<'_, '_>) {
        let (time, kick) = (field.time(), field.kick());
        let speed = |time: f64| {
            if time > 0.0 && time < self.end {
                1.0 / self.end
            } else {
                0.0
            }
        };
        let [before, after] = [time - kick, time].map(speed);
        field.for_each(|node| {
            if let Some(u) = self.displacement(node.position()) {
                node.prescribe(u.map(|u| before * u), u.map(|u| after * u));
            }
        });
    }
}

impl Condition for FarBoundary {
    /// Each node has a displacement of its own.
    fn not_local(&self) -> Option<&'static str> {
        None
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        self.prescribe(field);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        self.prescribe(field);
    }
}
