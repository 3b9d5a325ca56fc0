//! Ranks: processes that share one simulation, and the messages between them.
//!
//! Each rank owns a block of node planes along the first axis, and of rows along the second where there are more ranks than
//! planes have room for, and the particles that begin there. It holds copies (ghosts) of the particles beside it that reach its
//! nodes. It computes its ghosts once more, in the order in which one process would, so
//! that no bit depends on the number of ranks: see `Cycle::share_among` of the kernel. This file
//! names the messages that a step needs; an engine such as MPI sends them.

mod threads;

use std::time::Duration;

pub use threads::{ThreadRank, of_threads};

/// Ranks of one simulation. All of them call the same function at the same time, in the same order.
///
/// A message is a list of words: numbers and the bits of floating-point numbers. An engine that loses a rank ends the process:
/// no function here returns an error.
pub trait Ranks: Send + Sync {
    /// Number of this rank, from 0.
    fn rank(&self) -> usize;

    /// Number of ranks.
    fn count(&self) -> usize;

    /// The words of each rank, in order of the ranks.
    fn all_gather(&self, own: &[u64]) -> Vec<Vec<u64>>;

    /// Sends a part to each rank, in their order; the part that each rank sent here, in their order.
    fn all_to_all(&self, parts: Vec<Vec<u64>>) -> Vec<Vec<u64>>;

    /// Sends words to two other ranks, where there are any; the words that these sent here. A rank that names another is named
    /// by it.
    fn exchange(&self, with: [Option<usize>; 2], to: [Vec<u64>; 2]) -> [Vec<u64>; 2];

    /// Time that this rank has spent in messages so far, until the others answered; zero where nobody measures it.
    fn message_time(&self) -> Duration {
        Duration::ZERO
    }

    /// The first rank on which something holds.
    fn first_with(&self, here: bool) -> Option<usize> {
        let all = self.all_gather(&[u64::from(here)]);
        all.iter()
            .position(|words| words.first().is_some_and(|word| *word != 0))
    }

    /// Puts the largest of each number over all ranks in its place.
    fn join_most(&self, numbers: &mut [f64]) {
        let words: Vec<u64> = numbers.iter().map(|number| number.to_bits()).collect();
        for of_rank in self.all_gather(&words) {
            for (most, word) in numbers.iter_mut().zip(of_rank) {
                *most = most.max(f64::from_bits(word));
            }
        }
    }
}

/// Words that are read one after the other.
pub struct Words<'a>(std::slice::Iter<'a, u64>);

impl<'a> Words<'a> {
    /// Reads from the first on.
    #[must_use]
    pub fn of(words: &'a [u64]) -> Self {
        Self(words.iter())
    }

    /// The next word; zero behind the last.
    pub fn word(&mut self) -> u64 {
        self.0.next().copied().unwrap_or(0)
    }

    /// The next word as a count or a place.
    pub fn count(&mut self) -> usize {
        self.word() as usize
    }

    /// The next word as a number.
    pub fn number(&mut self) -> f64 {
        f64::from_bits(self.word())
    }

    /// The words that are left.
    #[must_use]
    pub fn rest(&self) -> &'a [u64] {
        self.0.as_slice()
    }

    /// The next words.
    pub fn take(&mut self, count: usize) -> &'a [u64] {
        let all = self.0.as_slice();
        let (taken, rest) = all.split_at(count.min(all.len()));
        self.0 = rest.iter();
        taken
    }
}
