//! A plane of nodes that presses from above.

use std::collections::BTreeMap;
use std::sync::Mutex;

use proctor_scene::simulation::{Condition, FieldNodes, Simulation};

use super::moved::smooth;
use super::stepping::run_until;
use crate::study::{Failure, Observer};

/// Nodes of one height that get one velocity along y, as those of a boundary plane do: particles feel how it changes, and
/// the force of what is pressed works.
pub struct Press {
    /// Height of the nodes \[m\].
    height: f64,
    /// Cell size \[m\].
    cell: f64,
    /// Largest x of a node that presses \[m\].
    reach: f64,
    /// True if the nodes are also held across the direction of the press.
    rough: bool,
    /// True if it presses pore water too, which cannot leave through it.
    on_water: bool,
    /// Velocity upwards \[m/s\] at a time \[s\].
    velocity: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    /// Impulse of each node so far \[N s\], by its place: threads visit nodes in an order of their own.
    impulses: Mutex<BTreeMap<[i64; 2], f64>>,
}

impl Press {
    /// A smooth plane as wide as the mesh, by its height and cell size \[m\] and its velocity upwards \[m/s\].
    pub fn smooth(
        height: f64,
        cell: f64,
        velocity: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self {
            height,
            cell,
            reach: f64::INFINITY,
            rough: false,
            on_water: false,
            velocity: Box::new(velocity),
            impulses: Mutex::default(),
        }
    }

    /// A smooth plane as wide as the mesh that goes down by a way \[m\] in a time \[s\], from rest to rest.
    pub fn from_rest(height: f64, cell: f64, [way, time]: [f64; 2]) -> Self {
        Self::smooth(height, cell, move |at| -way / time * smooth(at / time)[1])
    }

    /// The same up to a coordinate x \[m\], with the node there.
    pub fn up_to(self, reach: f64) -> Self {
        Self { reach, ..self }
    }

    /// The same, and what touches it cannot slide.
    pub fn rough(self, rough: bool) -> Self {
        Self { rough, ..self }
    }

    /// The same, and shut for the water in the pores, which it presses as it presses the skeleton.
    pub fn on_water(self) -> Self {
        Self {
            on_water: true,
            ..self
        }
    }

    /// Impulse downwards that it gave so far \[N s\]; NaN where a thread was lost that kept it.
    pub fn impulse(&self) -> f64 {
        self.impulses
            .lock()
            .map_or(f64::NAN, |impulses| impulses.values().sum())
    }

    /// Runs to each of these times \[s\] in turn, and hands on the mean force downwards since the one before \[N\].
    ///
    /// # Errors
    /// If a step fails.
    pub fn forces(
        &self,
        simulation: &mut Simulation,
        times: impl IntoIterator<Item = f64>,
        observer: &mut dyn Observer,
        mut each: impl FnMut(f64),
    ) -> Result<(), Failure> {
        let (mut from, mut given) = (0.0, 0.0);
        for time in times {
            run_until(simulation, time, observer, |_| {})?;
            // Velocities, and so impulses, are half a step behind.
            let (until, impulse) = (simulation.velocity_time(), self.impulse());
            each((impulse - given) / (until - from));
            (from, given) = (until, impulse);
        }
        Ok(())
    }

    fn keep(&self, position: [f64; 3], impulse: f64) {
        let at = [position[0], position[2]].map(|x| (x / self.cell).round() as i64);
        if let Ok(mut impulses) = self.impulses.lock() {
            *impulses.entry(at).or_default() += impulse;
        }
    }
}

impl Condition for Press {
    fn acts_on_water(&self) -> bool {
        self.on_water
    }

    fn after(&self, field: &mut FieldNodes<'_, '_>) {
        let (time, kick) = (field.time(), field.kick());
        let [before, after] = [time - kick, time].map(|time| (self.velocity)(time));
        field.for_each(|node| {
            let position = node.position();
            let near = 1e-6 * self.cell;
            if (position[1] - self.height).abs() > near || position[0] > self.reach + near {
                return;
            }
            let (velocity, change) = (node.velocity(), node.change());
            let mut old: [f64; 3] = std::array::from_fn(|axis| velocity[axis] - change[axis]);
            let mut new = velocity;
            (old[1], new[1]) = (before, after);
            if self.rough {
                for axis in [0, 2] {
                    (old[axis], new[axis]) = (0.0, 0.0);
                }
            }
            node.prescribe(old, new);
            let force = node.mass() * (after - before - change[1]) / kick;
            node.add_power(force * after);
            self.keep(position, -force * kick);
        });
    }
}
