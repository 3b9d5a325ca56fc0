//! The end of a verb, and the exit code that stands for it.

use std::fmt::Display;
use std::io;

/// A verb came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All is well: 0.
    Fine,
    /// A check or a run failed; the verb has said what: 1.
    Failed,
    /// There is nothing to judge by, and the verb has said why: 2.
    CannotCompare,
    /// The user stopped it: the code that a shell has for the signal, 130 for Ctrl-C and 143 for SIGTERM.
    Interrupted(u8),
}

/// A verb could not do its work.
#[derive(Debug)]
pub enum Failure {
    /// The input is at fault: 2. The text goes to standard error.
    BadInput(String),
    /// Standard output cannot be written; a closed pipe is no failure.
    Print(io::Error),
}

impl Failure {
    /// Bad input, said by an error of the kernel.
    pub fn bad_input(error: impl Display) -> Self {
        Self::BadInput(error.to_string())
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Print(error)
    }
}
