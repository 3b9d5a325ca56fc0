//! The runs of a refinement: coarse to fine, then the middle mesh at other places.

use super::place;
use super::run::{LETTERS, MeshRun, run};
use crate::interrupt::Interrupt;
use crate::progress::Progress;
use crate::say::say;
use crate::show::{number, seconds};
use proctor_scene::Scene;
use proctor_scene::simulation::{Options, SetupError};
use std::sync::{Mutex, PoisonError};

/// The runs that were made.
#[derive(Clone, Debug, Default)]
pub struct Runs {
    /// Runs on the meshes, coarse to fine.
    pub meshes: Vec<MeshRun>,
    /// Runs on the middle mesh, moved.
    pub moved: Vec<MeshRun>,
    /// Axes along which it was moved, in letters.
    pub along: Vec<&'static str>,
}

impl Runs {
    /// Total time by the clock of runs on the meshes, and of the moved ones \[s\].
    #[must_use]
    pub fn seconds(&self) -> [f64; 2] {
        let of = |runs: &[MeshRun]| runs.iter().map(|run| run.spent.wall.as_secs_f64()).sum();
        [of(&self.meshes), of(&self.moved)]
    }

    /// Time of the finest run by the clock \[s\].
    #[must_use]
    pub fn finest_seconds(&self) -> f64 {
        let finest = self.meshes.last();
        finest.map_or(f64::NAN, |run| run.spent.wall.as_secs_f64())
    }

    /// Exponent with which the time grows as cells become smaller, from the two finest meshes.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        let [.., a, b] = &self.meshes[..] else {
            return f64::NAN;
        };
        let times = b.spent.cpu.as_secs_f64() / a.spent.cpu.as_secs_f64();
        libm::log(times) / libm::log(a.cell / b.cell)
    }
}

/// The work of a refinement: scenes on meshes, coarse to fine.
pub struct Work<'a> {
    /// Name for the progress line.
    pub name: &'a str,
    /// The scenes.
    pub scenes: &'a [Scene],
    /// Stages before each of them on the same mesh; empty where there are none.
    pub earlier: &'a [Vec<Scene>],
    /// Number of places of the middle mesh beside its own.
    pub offsets: usize,
    /// Time at which the fields of the particles are kept \[s\].
    pub snapshot_at: Option<f64>,
    /// Threads and lanes.
    pub options: &'a Options,
    /// True where the expected time is printed.
    pub tells: bool,
}

impl Work<'_> {
    /// Runs everything, or until Ctrl-C; what is done is kept.
    ///
    /// # Errors
    /// A scene that cannot be set up.
    pub fn run(&self, interrupt: &Interrupt) -> Result<Runs, Box<SetupError>> {
        let mut runs = Runs::default();
        for (k, scene) in self.scenes.iter().enumerate() {
            let label = format!("h = {} m", number(scene.size_of_cell()));
            let done = self.one(scene, self.before(k), &label, interrupt)?;
            let stops = done.fault.is_some() || done.interrupted;
            if done.interrupted {
                return Ok(runs);
            }
            runs.meshes.push(done);
            if stops {
                return Ok(runs);
            }
            if k == 0 && self.tells {
                self.foretell(&runs.meshes[0]);
            }
        }
        let middle = self.scenes.len().checked_sub(2);
        let Some(middle) = middle.filter(|_| self.offsets > 0) else {
            return Ok(runs);
        };
        let scene = &self.scenes[middle];
        let bounds = runs.meshes[middle].bounds;
        let mut axes = place::free_axes(scene, bounds);
        for stage in self.before(middle) {
            let free = place::free_axes(stage, bounds);
            axes.retain(|axis| free.contains(axis));
        }
        runs.along = axes.iter().map(|axis| LETTERS[*axis]).collect();
        if axes.is_empty() {
            return Ok(runs);
        }
        for k in 1..=self.offsets {
            let part = k as f64 / (self.offsets + 1) as f64;
            let moved = place::moved(scene, &axes, part);
            let before = self.before(middle).iter();
            let before: Vec<Scene> = before
                .map(|stage| place::moved(stage, &axes, part))
                .collect();
            let label = format!("mesh moved by {} of a cell", number(part));
            let done = self.one(&moved, &before, &label, interrupt)?;
            if done.interrupted {
                break;
            }
            runs.moved.push(done);
        }
        Ok(runs)
    }

    /// The stages before the scene on a mesh.
    fn before(&self, mesh: usize) -> &[Scene] {
        self.earlier.get(mesh).map_or(&[], Vec::as_slice)
    }

    fn one(
        &self,
        scene: &Scene,
        earlier: &[Scene],
        label: &str,
        interrupt: &Interrupt,
    ) -> Result<MeshRun, Box<SetupError>> {
        let progress = Mutex::new(Progress::new(&format!("{}, {label}", self.name)));
        run(scene, earlier, self.options, self.snapshot_at, &|share| {
            let mut progress = progress.lock().unwrap_or_else(PoisonError::into_inner);
            progress.at(share);
            !interrupt.raised()
        })
    }

    /// Tells what the finer meshes will take, from the coarsest one.
    fn foretell(&self, coarsest: &MeshRun) {
        let exponent = self.scenes[0].dimension.axes() as f64 + 1.0;
        let finer = self.scenes[1..]
            .iter()
            .map(|scene| libm::pow(coarsest.cell / scene.size_of_cell(), exponent));
        let middle = self.scenes.len() - 2;
        let again = self.offsets as f64
            * libm::pow(coarsest.cell / self.scenes[middle].size_of_cell(), exponent);
        let all = coarsest.spent.wall.as_secs_f64() * (finer.sum::<f64>() + again);
        if all > 5.0 {
            say!("the finer meshes take about {}", seconds(all));
        }
    }
}
