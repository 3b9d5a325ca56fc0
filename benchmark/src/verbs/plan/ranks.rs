//! Shares of ranks in a plan.

use crate::show::{Table, bytes, grouped};
use proctor_scene::simulation::{RankForecast, SharingRefusal, Simulation};

/// The shares that so many ranks would have of a simulation, as a table with a line below.
///
/// # Errors
/// The reason for which they cannot share it.
pub(super) fn shares(simulation: &Simulation, ranks: usize) -> Result<String, SharingRefusal> {
    let shares = simulation.forecast_ranks(ranks)?;
    let mut table = Table::new([
        "rank",
        "planes",
        "rows",
        "particles",
        "ghosts",
        "sent per step",
    ]);
    for (rank, share) in shares.iter().enumerate() {
        table.push([
            rank.to_string(),
            share.planes.len().to_string(),
            share.rows.len().to_string(),
            grouped(share.particles as u64),
            grouped(share.ghosts as u64),
            bytes(share.sent as u64),
        ]);
    }
    let held = |share: &RankForecast| share.particles + share.ghosts;
    let most = shares.iter().map(held).max().unwrap_or(0);
    let own = simulation.particles() as f64 / ranks as f64;
    let line = if most > 0 {
        let share = own / most as f64;
        format!(
            "at most {:.0} % of {ranks} times the speed of one process: the largest rank computes {:.2} times the mean share; messages come \
             on top\n",
            100.0 * share,
            1.0 / share
        )
    } else {
        String::new()
    };
    Ok(format!("{table}{line}"))
}
