//! Messages on standard error.

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

/// True on ranks that leave it to the first one to speak.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Says nothing from here on but by [`always`].
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Writes a line to standard error. A message that nobody can read, for standard error is closed or full, changes nothing:
/// the exit code says how it went.
pub fn always(words: &str) {
    let _ = writeln!(std::io::stderr(), "{words}");
}

/// The same, unless this process is quiet.
pub fn line(words: &str) {
    if !QUIET.load(Ordering::Relaxed) {
        always(words);
    }
}

/// Writes a line to standard error: see [`line`].
macro_rules! say {
    ($($words:tt)*) => {
        $crate::say::line(&format!($($words)*))
    };
}

pub(crate) use say;
