//! A line of progress on a terminal, and nothing in a pipe.

pub mod estimate;
pub mod ladders;

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::Instant;

/// Parts into which a line divides the work.
const PARTS: u64 = 1000;

/// All lines, so that work that runs side by side has one below the other.
static BARS: LazyLock<MultiProgress> = LazyLock::new(|| {
    MultiProgress::with_draw_target(if std::io::stderr().is_terminal() {
        ProgressDrawTarget::stderr()
    } else {
        ProgressDrawTarget::hidden()
    })
});

/// Shows no line any more.
pub(crate) fn hide() {
    BARS.set_draw_target(ProgressDrawTarget::hidden());
}

/// Writes something that stays, above all lines: they are taken away first and come back with the next step.
pub(crate) fn above<T>(write: impl FnOnce() -> T) -> T {
    BARS.suspend(write)
}

/// Progress of some work, and the time of the rest, shown on standard error.
pub(crate) struct Progress {
    bar: ProgressBar,
    begun: Instant,
    /// Time of all of it \[s\], if it is known.
    expected: Option<f64>,
    shown: u64,
}

impl Progress {
    /// A line for work with this name, of which nobody knows how long it takes.
    pub fn new(name: &str) -> Self {
        Self::with(name, None)
    }

    /// A line for work that is expected to take so long \[s\].
    pub fn expecting(name: &str, seconds: f64) -> Self {
        Self::with(name, Some(seconds))
    }

    fn with(name: &str, expected: Option<f64>) -> Self {
        let bar = ProgressBar::new(PARTS)
            .with_prefix(name.to_owned())
            .with_message(estimate::words(estimate::left(expected, 0.0, 0.0)));
        if let Ok(style) = ProgressStyle::with_template("{prefix} {bar:30} {percent:>3} %  {msg}") {
            bar.set_style(style);
        }
        Self {
            bar: BARS.add(bar),
            begun: Instant::now(),
            expected,
            shown: 0,
        }
    }

    /// Shows the share that is done, 0 to 1. Cheap where nothing visible changes, so that it may be told of every
    /// step.
    pub fn at(&mut self, share: f64) {
        let part = (share * PARTS as f64) as u64;
        if part != self.shown {
            self.shown = part;
            self.bar.set_position(part.min(PARTS));
            self.tell(share);
        }
    }

    fn tell(&self, share: f64) {
        let elapsed = self.begun.elapsed().as_secs_f64();
        let left = estimate::left(self.expected, share, elapsed);
        self.bar.set_message(estimate::words(left));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// Work of several parts, which may run side by side, as one line.
pub(crate) struct Whole {
    /// Expected time of each part \[s\].
    weights: Vec<f64>,
    state: Mutex<State>,
}

struct State {
    progress: Progress,
    /// Share of each part that is done.
    shares: Vec<f64>,
}

impl Whole {
    /// A line for parts that are expected to take so long each \[s\], `at_a_time` of them side by side.
    pub fn new(name: &str, weights: Vec<f64>, at_a_time: usize) -> Self {
        let all: f64 = weights.iter().sum();
        Self {
            state: Mutex::new(State {
                progress: Progress::expecting(name, all / at_a_time.max(1) as f64),
                shares: vec![0.0; weights.len()],
            }),
            weights,
        }
    }

    /// Shows how much of a part is done, 0 to 1.
    pub fn at(&self, part: usize, share: f64) {
        // A line that a panic left in its midst still shows.
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = state.shares.get_mut(part) {
            *known = share.clamp(0.0, 1.0);
        }
        let done: f64 = self
            .weights
            .iter()
            .zip(&state.shares)
            .map(|(w, s)| w * s)
            .sum();
        let all: f64 = self.weights.iter().sum();
        if all > 0.0 {
            state.progress.at(done / all);
        }
    }
}
