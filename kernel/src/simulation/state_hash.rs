//! Hash of the particle state, which is that of one process whoever has the particles.

use crate::particles::ParticleSet;

/// FNV-1a hash, 64 bits, over identifier and the bits of every column of all particles in order of the
/// identifier, set by set. Equal for every number of threads and every kind of lanes.
#[must_use]
pub(crate) fn state_hash(sets: &[ParticleSet]) -> u64 {
    let mut hash = StateHash::default();
    let mut order = vec![];
    for set in sets {
        hash.add(set.len() as u64);
        by_identifier(set, 0..set.len(), &mut order);
        hash.add_particles(set, &order);
    }
    hash.0
}

/// A hash of words that come one after the other.
pub(super) struct StateHash(u64);

impl Default for StateHash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl StateHash {
    /// The hash of what was added.
    pub(super) fn value(&self) -> u64 {
        self.0
    }

    /// Adds a word at a time instead of a byte: eight times faster, and every bit still counts.
    pub(super) fn add(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        self.0 ^= self.0 >> 32;
    }

    /// Adds particles of a set.
    pub(super) fn add_particles(&mut self, set: &ParticleSet, places: &[u32]) {
        for &p in places {
            let p = p as usize;
            self.add(set.id[p]);
            for column in &set.columns {
                self.add(column[p].to_bits());
            }
        }
    }
}

/// Fills `places` with the places of some particles of a set in order of the identifier. Identifiers of a set are consecutive
/// but for removed particles, so that a table of places takes the time of one pass.
pub(super) fn by_identifier(
    set: &ParticleSet,
    particles: impl Iterator<Item = usize> + Clone,
    places: &mut Vec<u32>,
) {
    let ids = particles.clone().map(|p| set.id[p]);
    let (first, last) = ids.fold((u64::MAX, 0), |(low, high), id| (low.min(id), high.max(id)));
    places.clear();
    places.resize((last + 1).saturating_sub(first) as usize, u32::MAX);
    for p in particles {
        places[(set.id[p] - first) as usize] = p as u32;
    }
    places.retain(|&p| p != u32::MAX);
}
