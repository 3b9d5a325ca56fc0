//! Threads and lanes as options of the command line.

use crate::exit::Failure;
use crate::say::say;
use crate::side_by_side::processors;
use clap::{Args, ValueEnum};
use proctor_kernel::lanes::LaneChoice;
use proctor_scene::simulation::Options;
use std::num::NonZeroUsize;

/// Settings of the cycle. Neither changes a bit of the result.
#[derive(Args)]
pub struct Settings {
    /// Number of threads, at most four per hardware thread [default: `n_threads` of the scene, else
    /// one per 8192 particles, at most one per hardware thread]
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Vector lanes of the inner loops; auto takes the widest that the machine has
    #[arg(long, value_enum, default_value_t = Lanes::Auto)]
    pub lanes: Lanes,
}

impl Settings {
    /// The same for the kernel.
    ///
    /// # Errors
    /// As [`bounded`].
    pub fn options(&self) -> Result<Options, Failure> {
        let threads = self.threads.map(NonZeroUsize::get);
        if let Some(threads) = threads {
            bounded(OPTION, threads)?;
        }
        Ok(Options {
            threads,
            lanes: self.lanes.into(),
            ..Options::default()
        })
    }
}

/// Name of the option in messages.
pub const OPTION: &str = "--threads";

/// Threads per processor that are still taken. They only wait for each other: a small scene was seen fourteen times slower
/// on a thousand threads than on one.
const PER_PROCESSOR: usize = 4;

/// Says so where there are more threads than processors.
///
/// # Errors
/// [`Failure::BadInput`] if there are more than four times as many; `asked_by` names what asks for them.
pub fn bounded(asked_by: &str, threads: usize) -> Result<(), Failure> {
    let machine = processors();
    let most = machine.saturating_mul(PER_PROCESSOR);
    if threads > most {
        return Err(Failure::BadInput(format!(
            "{asked_by}: found {threads} threads; accepted: at most {most}, {PER_PROCESSOR} for each of the {machine} that \
             this machine runs at once"
        )));
    }
    if threads > machine {
        say!(
            "warning: {asked_by}: {threads} threads on a machine that runs {machine} at once wait for each other; the \
             results are the same"
        );
    }
    Ok(())
}

/// Vector lanes by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Lanes {
    /// The widest that the machine has
    Auto,
    /// Eight lanes
    Avx512,
    /// Four lanes
    Avx2,
    /// One lane
    Scalar,
}

impl From<Lanes> for LaneChoice {
    fn from(lanes: Lanes) -> Self {
        match lanes {
            Lanes::Auto => Self::Auto,
            Lanes::Avx512 => Self::Avx512,
            Lanes::Avx2 => Self::Avx2,
            Lanes::Scalar => Self::Scalar,
        }
    }
}
