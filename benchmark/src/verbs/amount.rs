//! How much a verb tells, as options of the command line.

use clap::Args;

/// How much is told of what was judged.
#[derive(Args, Clone, Copy, Debug)]
pub struct Amount {
    /// Tell everything: every run, table and gate with its reason
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// Tell the verdict and nothing else
    #[arg(short, long)]
    quiet: bool,
}

impl Amount {
    /// Whether everything is told.
    pub fn all(self) -> bool {
        self.verbose
    }

    /// Whether anything but the verdict is told.
    pub fn more_than_the_verdict(self) -> bool {
        !self.quiet
    }
}
