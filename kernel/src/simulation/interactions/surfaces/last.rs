//! The impulses of the last step, with which the sweeps of the next one begin.
//!
//! They are known by surface, set and identifier, so that neither a sort nor a restart changes with what a step begins.

use super::near::Place;
use crate::scene::Vector;
use crate::stage::touch::Touch;

/// Surface, set and identifier of a particle.
type Key = (usize, usize, u64);

/// Forces \[N\] on particles: along the normal of the surface, and across it.
#[derive(Clone, Debug, Default)]
pub(super) struct Last(Vec<(Key, f64, Vector)>);

/// Numbers of an entry where it is saved.
const NUMBERS: usize = 7;

impl Last {
    /// Gives touches the impulses that the forces of the last step have in a step of this length \[s\], turned into the plane
    /// in which the particle now touches and, as friction asks, no larger than mu times the normal one.
    pub(super) fn give(
        &self,
        touches: &mut [Touch],
        places: &[Place],
        identified: impl Fn(&Place) -> u64,
        time: f64,
    ) {
        for (touch, place) in touches.iter_mut().zip(places) {
            let key = (place.surface, place.set, identified(place));
            let Ok(at) = self.0.binary_search_by_key(&key, |entry| entry.0) else {
                continue;
            };
            let (_, pressure, drag) = self.0[at];
            let n = &touch.normal;
            let out: f64 = (0..3).map(|axis| drag[axis] * n[axis]).sum();
            let across: Vector = std::array::from_fn(|axis| time * (drag[axis] - out * n[axis]));
            let size = across.iter().map(|i| i * i).sum::<f64>().sqrt();
            touch.normal_impulse = (time * pressure).max(touch.floor);
            let most = if touch.friction == 0.0 {
                0.0
            } else {
                touch.friction * touch.normal_impulse.abs()
            };
            let share = if size > most { most / size } else { 1.0 };
            touch.tangential_impulse = across.map(|i| share * i);
        }
    }

    /// Takes up what was found. The force of a penalty is none of it: it is that of a gap, not of what presses.
    pub(super) fn take(
        &mut self,
        touches: &[Touch],
        places: &[Place],
        identified: impl Fn(&Place) -> u64,
        time: f64,
    ) {
        self.0.clear();
        for (touch, place) in touches.iter().zip(places) {
            let by_penalty = touch.penalty > 0.0 && touch.floor > 0.0;
            if touch.normal_impulse != 0.0 && !by_penalty {
                let key = (place.surface, place.set, identified(place));
                let drag = touch.tangential_impulse.map(|i| i / time);
                self.0.push((key, touch.normal_impulse / time, drag));
            }
        }
        self.0.sort_unstable_by_key(|entry| entry.0);
    }

    /// The entries as a list of numbers.
    pub(super) fn save(&self) -> Vec<f64> {
        let entry = |&((surface, set, id), pressure, [x, y, z]): &(Key, f64, Vector)| {
            [surface as f64, set as f64, id as f64, pressure, x, y, z]
        };
        self.0.iter().flat_map(entry).collect()
    }

    /// What was saved. Entries of particles that there are none of are never asked for.
    pub(super) fn of(saved: &[f64]) -> Self {
        let mut entries: Vec<_> = saved
            .as_chunks::<NUMBERS>()
            .0
            .iter()
            .map(|&[surface, set, id, pressure, x, y, z]| {
                ((surface as usize, set as usize, id as u64), pressure, [x, y, z])
            })
            .collect();
        entries.sort_unstable_by_key(|entry| entry.0);
        Self(entries)
    }
}
