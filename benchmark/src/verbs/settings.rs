//! Threads and lanes as options of the command line.

use clap::{Args, ValueEnum};
use proctor_kernel::lanes::LaneChoice;
use proctor_kernel::simulation::Options;
use std::num::NonZeroUsize;

/// How the cycle is run. Neither changes a bit of the result.
#[derive(Args)]
pub struct Settings {
    /// Number of threads [default: what the scene says, else one for 8192 particles, at most all
    /// of the machine]
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Vector lanes of the inner loops; auto takes the widest that the machine has
    #[arg(long, value_enum, default_value_t = Lanes::Auto)]
    pub lanes: Lanes,
}

impl Settings {
    /// The same for the kernel.
    pub fn options(&self) -> Options {
        Options {
            threads: self.threads.map(NonZeroUsize::get),
            lanes: self.lanes.into(),
            ..Options::default()
        }
    }
}

/// Threads that the machine can run at once.
pub fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, NonZeroUsize::get)
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
