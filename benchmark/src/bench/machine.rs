//! The limits of the machine: bandwidth by a triad, arithmetic by fused multiply-adds.

use proctor_kernel::lanes::{Backend, Kernel, Lanes, SelectedLanes};
use std::hint::black_box;
use std::sync::Barrier;
use std::time::{Duration, Instant};

/// Numbers of each of the three arrays of a thread: 32 MiB, beyond the caches of a core.
const NUMBERS: usize = 1 << 22;
/// Rounds of each measurement; the fastest counts, since whatever else runs on the machine only adds time.
const ROUNDS: usize = 5;
/// Independent chains of multiply-adds: more than latency times ports of any present core.
const CHAINS: usize = 12;
/// Links of a chain per round.
const LINKS: usize = 2_000_000;

/// Measured peaks of the machine for a number of threads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Threads.
    pub threads: usize,
    /// Bytes per second of `a = b + s c` on f64, three times eight bytes per element.
    pub bandwidth: f64,
    /// Floating-point operations per second of f64 multiply-adds in the widest lanes, two per multiply-add.
    pub arithmetic: f64,
}

impl Peaks {
    /// Measures both on all threads at once.
    #[must_use]
    pub fn measure(threads: usize, lanes: SelectedLanes) -> Self {
        let bytes = 24.0 * NUMBERS as f64 * threads as f64;
        let bandwidth = bytes
            / fastest(threads, || {
                let mut a = vec![0.0; NUMBERS];
                let (b, c) = (vec![1.0; NUMBERS], vec![2.0; NUMBERS]);
                move || triad(&mut a, &b, &c, 3.0)
            });
        let width = lanes.run(Width) as f64;
        let operations = 2.0 * width * (CHAINS * LINKS) as f64 * threads as f64;
        let arithmetic = operations
            / fastest(threads, || {
                move || {
                    black_box(lanes.run(MultiplyAdd(black_box(1e-9))));
                }
            });
        Self {
            threads,
            bandwidth,
            arithmetic,
        }
    }
}

/// Shortest time \[s\] in which all threads do the work that each of them makes for itself: from the first that begins
/// to the last that ends. The threads look at the clock themselves; one that only waits for them may be woken late.
fn fastest<W: FnMut()>(threads: usize, make: impl Fn() -> W + Sync) -> f64 {
    let start = Barrier::new(threads);
    let stamps: Vec<[(Instant, Instant); ROUNDS]> = std::thread::scope(|scope| {
        let worker = || {
            // Each thread touches its memory first, so that it lies near.
            let mut work = make();
            work();
            std::array::from_fn(|_| {
                start.wait();
                let begin = Instant::now();
                work();
                (begin, Instant::now())
            })
        };
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers
            .into_iter()
            .filter_map(|worker| worker.join().ok())
            .collect()
    });
    let round = |round: usize| {
        let begin = stamps.iter().map(|stamps| stamps[round].0).min();
        let end = stamps.iter().map(|stamps| stamps[round].1).max();
        begin.zip(end).map(|(begin, end)| end - begin)
    };
    let fastest: Option<Duration> = (0..ROUNDS).filter_map(round).min();
    fastest.map_or(f64::NAN, |time| time.as_secs_f64())
}

fn triad(a: &mut [f64], b: &[f64], c: &[f64], s: f64) {
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = b + s * c;
    }
    black_box(a);
}

struct Width;

impl Kernel for Width {
    type Output = usize;
    #[inline(always)]
    fn run<B: Backend>(self) -> usize {
        B::Native::WIDTH
    }
}

struct MultiplyAdd(f64);

impl Kernel for MultiplyAdd {
    type Output = f64;
    #[inline(always)]
    fn run<B: Backend>(self) -> f64 {
        let factor = B::Native::splat(1.0 - self.0);
        let mut chains = [factor; CHAINS];
        for _ in 0..LINKS {
            for chain in &mut chains {
                *chain = chain.mul_add(factor, factor);
            }
        }
        let mut sum = chains[0];
        for chain in &chains[1..] {
            sum = sum + *chain;
        }
        let mut lanes = [0.0; 8];
        sum.store(&mut lanes);
        lanes[0]
    }
}
