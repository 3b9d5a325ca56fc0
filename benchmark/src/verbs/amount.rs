//! The verbosity of a verb, as options of the command line.

use clap::Args;

/// Verbosity of a judgement.
#[derive(Args, Clone, Copy, Debug)]
pub struct Amount {
    /// Print every run, every table, and every gate with its reason
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    /// Print the verdict alone
    #[arg(short, long)]
    quiet: bool,
}

impl Amount {
    /// True if everything is printed.
    pub fn all(self) -> bool {
        self.verbose
    }

    /// True if anything but the verdict is printed.
    pub fn more_than_the_verdict(self) -> bool {
        !self.quiet
    }
}
