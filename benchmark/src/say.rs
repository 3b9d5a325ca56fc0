//! Messages on standard error.

/// Writes a line to standard error. A message that nobody can read, for standard error is closed or full, changes nothing:
/// the exit code says how it went.
macro_rules! say {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($words)*);
    }};
}

pub(crate) use say;
