//! Nodes that are moved as an exact solution moves there.

use proctor_scene::Vector;
use proctor_scene::simulation::{Condition, FieldNodes};

/// Nodes that get the velocity of a field.
pub struct PrescribedVelocity<F> {
    /// The velocity of the node at a place \[m\] at a time \[s\], in m/s; `None` where the node is free.
    velocity: F,
}

impl<F: Fn(Vector, f64) -> Option<Vector> + Send + Sync> PrescribedVelocity<F> {
    /// Nodes that a field moves: their velocity \[m/s\] by place \[m\] and time \[s\].
    pub const fn by(velocity: F) -> Self {
        Self { velocity }
    }

    fn prescribe(&self, field: &mut FieldNodes<'_, '_>) {
        let (time, kick) = (field.time(), field.kick());
        field.for_each(|node| {
            let x = node.position();
            let [before, after] = [time - kick, time].map(|t| (self.velocity)(x, t));
            if let (Some(before), Some(after)) = (before, after) {
                node.prescribe(before, after);
            }
        });
    }
}

impl<F: Fn(Vector, f64) -> Option<Vector> + Send + Sync> Condition for PrescribedVelocity<F> {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        self.prescribe(field);
    }

    fn remap(&self, field: &mut FieldNodes<'_, '_>) {
        self.prescribe(field);
    }
}

/// Nodes that get the velocity of a field as it is at the end of a step, whatever acts on them.
pub struct SetVelocity<F> {
    velocity: F,
}

impl<F: Fn(Vector, f64) -> Vector + Send + Sync> SetVelocity<F> {
    /// Nodes whose velocity is that of a field \[m/s\] by place \[m\] and time \[s\].
    pub const fn by(velocity: F) -> Self {
        Self { velocity }
    }
}

impl<F: Fn(Vector, f64) -> Vector + Send + Sync> Condition for SetVelocity<F> {
    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        let time = field.time();
        field.for_each(|node| node.set_velocity((self.velocity)(node.position(), time)));
    }
}

/// Share of the way from rest to rest at a share of the time, 10 s³ - 15 s⁴ + 6 s⁵, and its derivative.
pub fn smooth(share: f64) -> [f64; 2] {
    let s = share.clamp(0.0, 1.0);
    [
        s * s * s * (10.0 + s * (6.0 * s - 15.0)),
        30.0 * s * s * (1.0 - s) * (1.0 - s),
    ]
}
