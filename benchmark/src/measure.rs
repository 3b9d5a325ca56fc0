//! Time by the clock and time on the processors.

use cpu_time::{ProcessTime, ThreadTime};
use std::time::{Duration, Instant};

/// Time spent in what was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spent {
    /// By the clock.
    pub wall: Duration,
    /// On the processors, summed over the threads of the work.
    pub cpu: Duration,
}

impl Spent {
    /// CPU time per particle and step \[ns\], or `None` where nothing was stepped.
    #[must_use]
    pub fn ns_per(self, particle_steps: f64) -> Option<f64> {
        (particle_steps > 0.0).then(|| self.cpu.as_secs_f64() * 1e9 / particle_steps)
    }
}

/// Adds up the time of pieces of work.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    /// The sum so far.
    pub spent: Spent,
}

impl Stopwatch {
    /// Does `work` and adds its time. Threads that are still busy elsewhere in this process count as well.
    pub fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        let result = work();
        self.spent.cpu += cpu.elapsed();
        self.spent.wall += wall.elapsed();
        result
    }

    /// The same for work that keeps to the calling thread; other threads do not count.
    pub fn time_thread<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let (wall, cpu) = (Instant::now(), ThreadTime::now());
        let result = work();
        self.spent.cpu += cpu.elapsed();
        self.spent.wall += wall.elapsed();
        result
    }
}
