//! A progress bar on a terminal, and nothing in a pipe.

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::LazyLock;

/// Parts into which a bar divides the work.
const PARTS: u64 = 1000;

/// All bars, so that work that runs side by side has one below the other.
static BARS: LazyLock<MultiProgress> = LazyLock::new(|| {
    MultiProgress::with_draw_target(if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    })
});

/// How far some work has come, shown on standard error.
pub struct Progress {
    bar: ProgressBar,
    shown: u64,
}

impl Progress {
    /// A bar for work with this name.
    pub fn new(name: &str) -> Self {
        let bar = BARS.add(ProgressBar::new(PARTS));
        if let Ok(style) =
            ProgressStyle::with_template("{prefix} {bar:30} {percent:>3} %  {eta} left")
        {
            bar.set_style(style);
        }
        bar.set_prefix(name.to_owned());
        Self { bar, shown: 0 }
    }

    /// Shows the share that is done, 0 to 1. Cheap where nothing visible changes, so that it may be told of every
    /// step.
    pub fn at(&mut self, share: f64) {
        let part = (share * PARTS as f64) as u64;
        if part != self.shown {
            self.shown = part;
            self.bar.set_position(part.min(PARTS));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
