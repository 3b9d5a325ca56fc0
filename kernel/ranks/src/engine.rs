//! MPI as the engine of ranks.
//!
//! A communicator belongs to the thread that started MPI, and so does everything here: a simulation that ranks share is stepped
//! by that thread, with a team of threads of which it is one ([`Team::of_caller`](proctor_kernel::team::Team::of_caller)).

use mpi::Threading;
use mpi::datatype::PartitionMut;
use mpi::environment::Universe;
use mpi::request::{Request, Scope, scope};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Destination, MatchedReceiveVec, Source};
use proctor_kernel::ranks::Ranks;
use std::cell::RefCell;
use std::fmt;
use std::num::NonZero;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Time for which a rank looks for a message without a rest, where each rank of its machine has a processor.
const EAGER: Duration = Duration::from_micros(200);
/// Rest between two looks after that: as short as the system lets it be, about fifty microseconds. The processor is then free for a
/// rank or program that works.
const REST: Duration = Duration::from_micros(1);

thread_local! {
    /// The communicator of all ranks, on the thread that started MPI.
    static WORLD: RefCell<Option<SimpleCommunicator>> = const { RefCell::new(None) };
}

/// MPI could not be started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EngineError {
    /// It was started before in this process.
    StartedBefore,
    /// It does not let a process with several threads speak from one of them.
    Threads,
}

impl fmt::Display for EngineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StartedBefore => write!(f, "MPI was started before in this process"),
            Self::Threads => write!(
                f,
                "this MPI serves no process with threads; accepted: one with MPI_THREAD_FUNNELED"
            ),
        }
    }
}

impl std::error::Error for EngineError {}

/// MPI, from its start to its end. Whoever drops it waits for the other ranks to do so.
pub struct Engine {
    ranks: Arc<World>,
    _universe: Universe,
}

impl Engine {
    /// Starts MPI on the calling thread.
    ///
    /// # Errors
    /// See [`EngineError`].
    pub fn start() -> Result<Self, EngineError> {
        let started = mpi::initialize_with_threading(Threading::Funneled);
        let (universe, threading) = started.ok_or(EngineError::StartedBefore)?;
        if threading < Threading::Funneled {
            return Err(EngineError::Threads);
        }
        let world = universe.world();
        let ranks = World {
            rank: world.rank() as usize,
            count: world.size() as usize,
            eager: eager(&world),
            message_nanoseconds: AtomicU64::new(0),
        };
        WORLD.set(Some(world));
        Ok(Self {
            ranks: Arc::new(ranks),
            _universe: universe,
        })
    }

    /// The ranks of all processes. Messages are sent and received by the thread that started MPI; on another one they panic.
    #[must_use]
    pub fn ranks(&self) -> Arc<dyn Ranks> {
        Arc::clone(&self.ranks) as Arc<dyn Ranks>
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        // Before MPI ends.
        WORLD.set(None);
    }
}

/// [`EAGER`], or nothing where this machine has fewer processors than ranks. All ranks call it.
fn eager(world: &SimpleCommunicator) -> Duration {
    let here = world.split_shared(world.rank()).size() as usize;
    let processors = thread::available_parallelism().map_or(1, NonZero::get);
    if here > processors {
        Duration::ZERO
    } else {
        EAGER
    }
}

/// All ranks.
struct World {
    rank: usize,
    count: usize,
    /// Time for which it looks for a message without a rest.
    eager: Duration,
    /// Time in messages so far.
    message_nanoseconds: AtomicU64,
}

impl World {
    /// Calls `act` with the communicator of this thread, and counts its time.
    fn speak<R>(&self, act: impl FnOnce(&SimpleCommunicator) -> R) -> R {
        let start = Instant::now();
        let result = WORLD.with_borrow(|world| match world {
            Some(world) => act(world),
            None => panic!("a rank speaks from the thread that started MPI"),
        });
        let took = start.elapsed().as_nanos() as u64;
        self.message_nanoseconds.fetch_add(took, Ordering::Relaxed);
        result
    }
}

impl World {
    /// Looks until something is found. MPI itself looks without a rest: ranks that wait would take the time of those that work
    /// wherever a machine has fewer processors than it has work.
    fn wait<T>(&self, mut look: impl FnMut() -> Option<T>) -> T {
        let begun = Instant::now();
        loop {
            if let Some(found) = look() {
                return found;
            }
            if begun.elapsed() >= self.eager {
                thread::sleep(REST);
            }
        }
    }

    /// The next words from a rank.
    fn receive(&self, from: &impl Source) -> Vec<u64> {
        let arrived = self.wait(|| from.immediate_matched_probe());
        arrived.matched_receive_vec().0
    }

    /// Waits until a message or a collective operation has ended.
    fn finish<'a, D: ?Sized, S: Scope<'a>>(&self, request: Request<'a, D, S>) {
        let mut open = Some(request);
        self.wait(|| {
            open = open.take()?.test().err();
            open.is_none().then_some(())
        });
    }
}

impl Ranks for World {
    fn rank(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.count
    }

    fn message_time(&self) -> Duration {
        Duration::from_nanos(self.message_nanoseconds.load(Ordering::Relaxed))
    }

    fn all_gather(&self, own: &[u64]) -> Vec<Vec<u64>> {
        self.speak(|world| {
            let mut counts = vec![0_i32; self.count];
            let length = own.len() as i32;
            scope(|scope| {
                self.finish(world.immediate_all_gather_into(scope, &length, &mut counts[..]));
            });
            let mut starts = Vec::with_capacity(self.count);
            let mut end = 0;
            for count in &counts {
                starts.push(end);
                end += count;
            }
            let mut words = vec![0_u64; end as usize];
            {
                let mut parts = PartitionMut::new(&mut words[..], &counts[..], &starts[..]);
                scope(|scope| {
                    self.finish(world.immediate_all_gather_varcount_into(scope, own, &mut parts));
                });
            }
            let mut rest = &words[..];
            counts
                .iter()
                .map(|&count| {
                    let (part, behind) = rest.split_at(count as usize);
                    rest = behind;
                    part.to_vec()
                })
                .collect()
        })
    }

    fn all_to_all(&self, mut parts: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        let own = std::mem::take(&mut parts[self.rank]);
        let others = || (0..self.count).filter(|rank| *rank != self.rank);
        self.speak(|world| {
            let process = |rank: usize| world.process_at_rank(rank as i32);
            let mut received = vec![vec![]; self.count];
            received[self.rank] = own;
            scope(|scope| {
                let send = |rank| process(rank).immediate_send(scope, &parts[rank][..]);
                let sent: Vec<_> = others().map(send).collect();
                for rank in others() {
                    received[rank] = self.receive(&process(rank));
                }
                for sent in sent {
                    self.finish(sent);
                }
            });
            received
        })
    }

    fn exchange(&self, with: [Option<usize>; 2], to: [Vec<u64>; 2]) -> [Vec<u64>; 2] {
        self.speak(|world| {
            let process = |rank: usize| world.process_at_rank(rank as i32);
            let mut received = [vec![], vec![]];
            scope(|scope| {
                let sends = with.iter().zip(&to);
                let sent: Vec<_> = sends
                    .filter_map(|(rank, words)| {
                        let rank = (*rank)?;
                        Some(process(rank).immediate_send(scope, &words[..]))
                    })
                    .collect();
                for (rank, words) in with.iter().zip(&mut received) {
                    if let Some(rank) = *rank {
                        *words = self.receive(&process(rank));
                    }
                }
                for sent in sent {
                    self.finish(sent);
                }
            });
            received
        })
    }
}
