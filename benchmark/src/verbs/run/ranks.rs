//! Runs on ranks of MPI: settings of a rank, and the refusal of copies of one run.

use crate::exit::Failure;
use crate::verbs::settings::bounded;
use proctor_kernel::ranks::Ranks;
use proctor_kernel::team::Team;
use proctor_scene::Scene;
use proctor_scene::simulation::Options;
use std::hash::{DefaultHasher, Hasher};
use std::sync::Arc;

/// Variables by which launchers of MPI and of clusters tell a process how many ranks there are.
const COUNTS: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_SIZE"];

/// Refuses to run where several processes would run the same scene side by side.
///
/// # Errors
/// Bad input, with the program that shares a run among ranks.
pub(super) fn refuse_copies() -> Result<(), Failure> {
    let count = |name: &&str| {
        let count = std::env::var(name).ok()?.parse::<usize>().ok()?;
        (count > 1).then_some(count)
    };
    match COUNTS.iter().find_map(count) {
        None => Ok(()),
        Some(count) => Err(Failure::BadInput(format!(
            "this program does not know MPI: {count} processes would each run the whole scene; accepted: \
             `mpirun -n {count} proctor-mpi run SCENE`, built by `cargo build --release -p proctor-mpi`"
        ))),
    }
}

/// The options of a rank. The thread that speaks to the other ranks is one of its team, and leads it.
///
/// # Errors
/// Threads that the system does not give.
pub(super) fn options(
    options: Options,
    scene: &Scene,
    ranks: &Arc<dyn Ranks>,
) -> Result<Options, Failure> {
    let threads = options.threads.or(scene.threads).unwrap_or(1);
    bounded("--threads", threads)?;
    let team = match &options.team {
        Some(team) => Arc::clone(team),
        None => Team::of_caller(threads)
            .map(Arc::new)
            .map_err(|error| Failure::BadInput(format!("threads: {error}")))?,
    };
    Ok(Options {
        team: Some(team),
        ranks: Some(Arc::clone(ranks)),
        ..options
    })
}

/// Compares the programs of all ranks.
///
/// # Errors
/// A rank whose program has other bytes than that of the first: no bit of theirs need be the same.
pub fn same_program(ranks: &dyn Ranks) -> Result<(), Failure> {
    let bytes = std::env::current_exe().and_then(std::fs::read);
    let mut hasher = DefaultHasher::new();
    hasher.write(&bytes.unwrap_or_default());
    let all = ranks.all_gather(&[hasher.finish()]);
    match all.iter().position(|words| *words != all[0]) {
        None => Ok(()),
        Some(rank) => Err(Failure::BadInput(format!(
            "rank {rank} runs another program than rank 0; accepted: the same file on all machines"
        ))),
    }
}
