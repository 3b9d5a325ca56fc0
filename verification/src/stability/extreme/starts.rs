//! Starts of the rows: options with a velocity and a stress of each particle by its place.

use super::prelude::*;
use crate::random::mixed;

/// One thread; displacements are kept.
pub fn options() -> Options {
    Options {
        threads: Some(1),
        displacement: true,
        ..Options::default()
    }
}

/// The same, and a start of each particle by its place.
pub fn from(initial: impl Fn(&Vector) -> InitialState + Send + Sync + 'static) -> Options {
    starting(options(), initial)
}

/// A start with a velocity by the place \[m/s\].
pub fn flying(velocity: impl Fn(&Vector) -> Vector + Send + Sync + 'static) -> Options {
    from(move |x| moving(velocity(x), [[0.0; 3]; 3]))
}

/// A start with a stress by the place \[Pa\].
pub fn stressed(stress: impl Fn(&Vector) -> [f64; 6] + Send + Sync + 'static) -> Options {
    from(move |x| InitialState {
        stress: stress(x),
        ..AT_REST
    })
}

/// A start with a drift \[m/s\] and velocities that differ from particle to particle by up to `speed` \[m/s\], and stresses
/// by up to `stress` \[Pa\], in the plane.
pub fn rough(drift: Vector, speed: f64, stress: f64) -> Options {
    from(rough_state(drift, speed, stress))
}

/// The same, by the place.
pub fn rough_state(drift: Vector, speed: f64, stress: f64) -> impl Fn(&Vector) -> InitialState {
    move |x| {
        let mut state = moving(drift, [[0.0; 3]; 3]);
        for axis in 0..2 {
            state.velocity[axis] += speed * noise(x, 1 + axis as u64);
            state.stress[axis] = stress * noise(x, 11 + axis as u64);
        }
        state.stress[5] = stress * noise(x, 21);
        state
    }
}

/// A number between -1 and 1 for each place and seed, the same on every machine: bits of the place, mixed (splitmix64).
pub fn noise(x: &Vector, seed: u64) -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for c in x {
        state ^= c.to_bits();
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = mixed(state);
    }
    unit(state)
}

/// The same by fewer roundings of bits, velocities in the plane \[m/s\]: rows whose figures are those of this noise have it.
pub fn shaken(x: &Vector, speed: f64) -> Vector {
    let noise = |number: u64| {
        let mut word = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        for c in x {
            word = (word ^ c.to_bits()).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            word ^= word >> 29;
        }
        unit(word)
    };
    [speed * noise(1), speed * noise(2), 0.0]
}

/// The upper bits of a word as a number between -1 and 1.
fn unit(word: u64) -> f64 {
    (word >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
