//! Decisions that the ranks of a run take together.

use super::RunError;
use proctor_kernel::ranks::Ranks;

/// A result that each rank has: the own error where there is one, else that another rank has one.
pub(super) fn agree<T>(
    ranks: Option<&dyn Ranks>,
    here: Result<T, RunError>,
) -> Result<T, RunError> {
    let Some(ranks) = ranks else { return here };
    let word = match &here {
        Ok(_) => 0,
        Err(error) => 1 + u64::from(error.is_bad_input()),
    };
    let all = ranks.all_gather(&[word]);
    let here = here?;
    match all.iter().position(|words| words[0] != 0) {
        None => Ok(here),
        Some(rank) => Err(RunError::OtherRank {
            rank,
            bad_input: all[rank][0] == 2,
        }),
    }
}

/// Statements that hold on any rank.
pub(super) fn any<const K: usize>(ranks: Option<&dyn Ranks>, here: [bool; K]) -> [bool; K] {
    let Some(ranks) = ranks else { return here };
    let mut all = [false; K];
    for words in ranks.all_gather(&here.map(u64::from)) {
        for (all, word) in all.iter_mut().zip(words) {
            *all |= word != 0;
        }
    }
    all
}
