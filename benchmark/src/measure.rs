//! Time by the clock and time on the processors.

use cpu_time::{ProcessTime, ThreadTime};
use std::time::{Duration, Instant};

/// Time spent in what was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spent {
    /// Time by the clock.
    pub wall: Duration,
    /// Time on the processors, summed over the threads of the work.
    pub cpu: Duration,
}

impl Spent {
    /// CPU time per particle and step \[ns\], or `None` where nothing was stepped.
    #[must_use]
    pub fn ns_per(self, particle_steps: f64) -> Option<f64> {
        (particle_steps > 0.0).then(|| self.cpu.as_secs_f64() * 1e9 / particle_steps)
    }
}

/// Ratio of clock time to processor time from which other work kept the processors busy.
const BUSY: f64 = 1.2;
/// Work below which that says nothing \[s\].
const TOO_SHORT: f64 = 0.5;

/// Ratio of clock time to processor time of the runs, where it shows a busy machine: a run computes and waits for nobody, so
/// that on one thread both are the same. Of runs on several threads a busy machine shows only where not even one of them was
/// kept at work.
#[must_use]
pub fn busy(runs: impl IntoIterator<Item = Spent>) -> Option<f64> {
    let (wall, cpu) = runs.into_iter().fold((0.0, 0.0), |(wall, cpu), run| {
        (wall + run.wall.as_secs_f64(), cpu + run.cpu.as_secs_f64())
    });
    let times: f64 = wall / cpu;
    (wall >= TOO_SHORT && times > BUSY).then_some(times)
}

/// A clock of processor time, begun.
#[derive(Clone, Copy, Debug)]
pub enum ProcessorClock {
    /// All threads of the process, those that are busy elsewhere in it too.
    Process(ProcessTime),
    /// The calling thread.
    Thread(ThreadTime),
}

impl ProcessorClock {
    /// Begins to measure work of so many threads: work on one keeps to the thread that calls it.
    #[must_use]
    pub fn of_threads(threads: usize) -> Self {
        if threads == 1 {
            Self::Thread(ThreadTime::now())
        } else {
            Self::Process(ProcessTime::now())
        }
    }

    /// Time on the processors since the beginning.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        match self {
            Self::Process(begun) => begun.elapsed(),
            Self::Thread(begun) => begun.elapsed(),
        }
    }
}

/// Adds up the time of pieces of work.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    /// Time spent so far, summed over all pieces.
    pub spent: Spent,
}

impl Stopwatch {
    /// Runs `work` and adds its time. Threads that are still busy elsewhere in this process count as well.
    pub fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        self.by(|| ProcessorClock::Process(ProcessTime::now()), work)
    }

    /// The same for work that keeps to the calling thread; other threads do not count.
    pub fn time_thread<T>(&mut self, work: impl FnOnce() -> T) -> T {
        self.by(|| ProcessorClock::Thread(ThreadTime::now()), work)
    }

    /// The clock on the wall begins before that of the processor, which takes a call of the system: the phases of a step, which
    /// end where the next begins, hold that call and are parts of the whole.
    fn by<T>(&mut self, begin: fn() -> ProcessorClock, work: impl FnOnce() -> T) -> T {
        let (wall, cpu) = (Instant::now(), begin());
        let result = work();
        self.spent.cpu += cpu.elapsed();
        self.spent.wall += wall.elapsed();
        result
    }
}
