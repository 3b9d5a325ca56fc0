//! One sample: a scene or a single stage, set up, warmed up and timed.

use super::counts::Least;
use super::memory;
use crate::measure::{Spent, Stopwatch};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_kernel::ranks::{Ranks, ThreadRank, of_threads};
use proctor_scene::Scene;
use proctor_scene::simulation::{InitialField, Options, Part, Phase, Simulation, StepError};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Work of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole steps.
    Steps,
    /// A single stage, without going on in time.
    Stage(Part),
}

/// Something that can be sampled.
pub struct Work {
    /// Name without the numbers of ranks and threads.
    pub name: String,
    /// Kind of work.
    pub kind: Kind,
    /// The scene.
    pub scene: Scene,
    /// State of the particles at the start, where the scene alone does not say it.
    pub initial: Option<InitialField>,
    /// Ranks that share the steps, threads of this process.
    pub ranks: usize,
    /// Threads of each rank.
    pub threads: usize,
}

/// Settings of a sample.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Steps, or plays of a stage, before the clock starts.
    pub warm_up: usize,
    /// Particles times steps, which decides the number of steps.
    pub particle_steps: u64,
    /// Lanes.
    pub lanes: LaneChoice,
}

/// Result of a sample.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Particles.
    pub particles: usize,
    /// Steps, or plays of a stage.
    pub steps: u64,
    /// Time in them.
    pub spent: Spent,
    /// Clock time in each phase of whole steps, in the order of [`Phase::ALL`].
    pub phases: Option<[Duration; Phase::ALL.len()]>,
    /// Bytes of state per particle, by the plan.
    pub bytes_per_particle: usize,
    /// Bytes of the nodes that are held.
    pub node_bytes: usize,
    /// Largest resident size of the process from before the set-up to the end \[bytes\].
    pub peak_rss: Option<u64>,
    /// Least work of a particle in a step, where it was counted.
    pub least: Option<Least>,
    /// Lanes in use.
    pub lanes: SelectedLanes,
}

impl Work {
    /// Threads of all ranks.
    #[must_use]
    pub fn processors(&self) -> usize {
        self.ranks * self.threads
    }

    /// Threads, and ranks where there are several, in words.
    #[must_use]
    pub fn on(&self) -> String {
        if self.ranks == 1 {
            self.threads.to_string()
        } else {
            format!("{} ranks of {}", self.ranks, self.threads)
        }
    }

    /// Takes a sample; `None` if `stop` was raised meanwhile.
    ///
    /// # Errors
    /// If the scene cannot be set up or stepped.
    pub fn sample(&self, settings: &Settings, stop: &AtomicBool) -> Result<Option<Sample>, String> {
        if self.ranks == 1 {
            return self.sample_of(None, settings, stop);
        }
        let mut ranks = of_threads(self.ranks).into_iter().map(Arc::new);
        let first = ranks.next();
        std::thread::scope(|scope| {
            let other = |rank| {
                scope.spawn(move || self.sample_of(Some(&rank), settings, &AtomicBool::new(false)))
            };
            let others: Vec<_> = ranks.map(other).collect();
            let sample = self.sample_of(first.as_ref(), settings, stop);
            drop(first);
            // They have the same sample or error, or wait for messages of a rank that was stopped.
            for other in others {
                drop(other.join());
            }
            sample
        })
    }

    /// The sample of a rank, where there are several.
    fn sample_of(
        &self,
        rank: Option<&Arc<ThreadRank>>,
        settings: &Settings,
        stop: &AtomicBool,
    ) -> Result<Option<Sample>, String> {
        let mut options = Options {
            threads: Some(self.threads),
            lanes: settings.lanes,
            initial: self.initial.clone(),
            ..Options::default()
        };
        let resets = memory::reset_peak();
        let mut simulation = self.start(&options, rank)?;
        // New threads would have to find their processors each time that the scene begins anew.
        options.team = Some(simulation.team());
        let particles = simulation.particles();
        let steps = (settings.particle_steps / particles.max(1) as u64).clamp(3, 10_000);
        let mut timed = match self.kind {
            Kind::Stage(part) => {
                // The first step is not like the others: velocities and positions are at the same time.
                SampleTime::stage(&mut simulation, part, settings.warm_up, steps, stop)
            }
            Kind::Steps => {
                let start = || self.start(&options, rank);
                self.steps(&mut simulation, &start, settings.warm_up, steps, stop)
            }
        }?;
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        timed.stopwatch.spent.wall = timed.stopwatch.spent.wall.max(Duration::from_nanos(1));
        let plan = simulation.plan();
        Ok(Some(Sample {
            particles,
            steps,
            spent: timed.stopwatch.spent,
            phases: timed.phases,
            bytes_per_particle: plan.bytes_per_particle(),
            node_bytes: simulation.nodes_active() * plan.bytes_per_node(),
            peak_rss: resets.then(memory::peak).flatten(),
            least: Least::of(plan, self.scene.weighting),
            lanes: simulation.lanes(),
        }))
    }

    /// The scene at its start, as the part of a rank where there are several.
    fn start(
        &self,
        options: &Options,
        rank: Option<&Arc<ThreadRank>>,
    ) -> Result<Simulation, String> {
        let simulation = Simulation::new(&self.scene, options);
        let mut simulation = simulation.map_err(|error| error.to_string())?;
        if let Some(rank) = rank {
            let shared = simulation.share_among(Arc::clone(rank) as Arc<dyn Ranks>);
            shared.map_err(|refusal| refusal.to_string())?;
        }
        Ok(simulation)
    }

    /// Whole steps. A scene that is over begins anew, outside the clock.
    fn steps(
        &self,
        simulation: &mut Simulation,
        start: &dyn Fn() -> Result<Simulation, String>,
        warm_up: usize,
        steps: u64,
        stop: &AtomicBool,
    ) -> Result<SampleTime, String> {
        let mut timed = SampleTime::default();
        let phases = Arc::new(Mutex::new(PhaseTimes::default()));
        let end = self.scene.time;
        let goes_on = |simulation: &Simulation| {
            simulation.time() < end * (1.0 - 1e-9) && !stop.load(Ordering::Relaxed)
        };
        let mut done = 0;
        while done < steps && !stop.load(Ordering::Relaxed) {
            if !goes_on(simulation) {
                *simulation = start()?;
            }
            let (mut cold, mut observed) = (warm_up, false);
            let team = simulation.team();
            let result = team.lead(|| {
                while done < steps && goes_on(simulation) {
                    if cold > 0 {
                        simulation.step(end)?;
                        cold -= 1;
                        continue;
                    }
                    if !observed {
                        let phases = Arc::clone(&phases);
                        let end = move |phase| times_of(&phases).end(phase);
                        simulation.observe_phases(Some(Box::new(end)));
                        observed = true;
                    }
                    times_of(&phases).begin();
                    timed.stopwatch.time(|| simulation.step(end))?;
                    done += 1;
                }
                Ok(())
            });
            simulation.observe_phases(None);
            result.map_err(|e: StepError| e.to_string())?;
        }
        timed.phases = Some(times_of(&phases).spent);
        Ok(timed)
    }
}

/// Clock time in each phase so far.
struct PhaseTimes {
    before: Instant,
    spent: [Duration; Phase::ALL.len()],
}

impl Default for PhaseTimes {
    fn default() -> Self {
        Self {
            before: Instant::now(),
            spent: [Duration::ZERO; Phase::ALL.len()],
        }
    }
}

impl PhaseTimes {
    /// A step begins.
    fn begin(&mut self) {
        self.before = Instant::now();
    }

    /// A phase has ended.
    fn end(&mut self, phase: Phase) {
        let now = Instant::now();
        self.spent[phase as usize] += now - self.before;
        self.before = now;
    }
}

/// The times, which one thread after the other writes.
fn times_of(phases: &Mutex<PhaseTimes>) -> MutexGuard<'_, PhaseTimes> {
    phases.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Time of a sample.
#[derive(Default)]
struct SampleTime {
    stopwatch: Stopwatch,
    phases: Option<[Duration; Phase::ALL.len()]>,
}

impl SampleTime {
    /// A stage again and again on the same state; making that state is outside the clock.
    fn stage(
        simulation: &mut Simulation,
        part: Part,
        warm_up: usize,
        plays: u64,
        stop: &AtomicBool,
    ) -> Result<Self, String> {
        let mut timed = Self::default();
        let mut rehearsal = simulation.rehearse(part).map_err(|e| e.to_string())?;
        for play in 0..warm_up as u64 + plays {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            rehearsal.set().map_err(|e| e.to_string())?;
            if play < warm_up as u64 {
                rehearsal.play().map_err(|e| e.to_string())?;
            } else {
                timed
                    .stopwatch
                    .time(|| rehearsal.play())
                    .map_err(|e| e.to_string())?;
            }
        }
        Ok(timed)
    }
}
