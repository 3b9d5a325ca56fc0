//! `proctor plan`: what a scene needs.

mod forecast;
mod ground;
mod ranks;

use super::settings::bounded;
use super::stages;
use crate::exit::{Failure, Outcome};
use crate::measure::Stopwatch;
use crate::say::say;
use crate::show::{Table, bytes, grouped};
use clap::Args;
use forecast::Forecast;
use proctor_files::json::SourceMap;
use proctor_kernel::memory::{Memory, words};
use proctor_scene::Scene;
use proctor_scene::simulation::{Options, Simulation, estimate_memory};
use std::io::Write;
use std::path::PathBuf;

/// Show what a scene needs, what is left out, and why; and what a run will take.
///
/// Nothing is written. The bodies are filled with particles, so that every fault of the scene shows. Its first steps are taken,
/// for a quarter of a second or at least five: from these come the time step and what rules it, the number of steps and the run
/// time. Number of steps and bytes of frames and checkpoint are exact where the time step is constant; else they hold as long as
/// the step stays.
#[derive(Args)]
#[command(after_help = "Example: proctor plan fixtures/scenes/manual/boussinesq.json")]
pub struct Plan {
    /// Scene file (JSON); - for standard input
    scene: PathBuf,
    /// Show the shares that so many ranks of MPI would have
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    ranks: Option<u32>,
}

/// Memory that it takes some time to fill \[bytes\]: then what is to come is said first.
const LARGE: f64 = 1e9;

impl Plan {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        for (number, stage) in stages(&self.scene)?.iter().enumerate() {
            if number > 0 {
                writeln!(out)?;
            }
            if let Some(threads) = stage.scene.threads {
                bounded(&format!("{}: n_threads", self.scene.display()), threads)?;
            }
            show(&stage.scene, &stage.places, self.ranks, out)?;
        }
        Ok(Outcome::Fine)
    }
}

/// Begin of the warning that the stress at the start is out of balance.
pub(super) const OUT_OF_BALANCE: &str = "the initial stress is out of balance";

/// True for a scene that is damped until forces are in balance: they may be out of it at the start.
pub(super) fn seeks_balance(scene: &Scene) -> bool {
    scene.until.is_some() && scene.damping.slows()
}

/// Shows the plan of a scene, or of one stage.
fn show(
    scene: &Scene,
    places: &SourceMap,
    ranks: Option<u32>,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let options = Options::default();
    let asked = estimate_memory(scene);
    if asked.bytes > LARGE {
        say!(
            "about {} particles and {} nodes, which need {} of the {} that are free",
            grouped(asked.particles as u64),
            grouped(asked.nodes as u64),
            words(asked.bytes),
            words(Memory::of_machine().bytes() as f64)
        );
    }
    let mut stopwatch = Stopwatch::default();
    let mut simulation = stopwatch
        .time(|| Simulation::new(scene, &options))
        .map_err(|error| Failure::BadInput(places.of_setup(&error)))?;
    let set_up = stopwatch.spent.cpu.as_secs_f64();
    let mut plan = simulation.plan().clone();
    // The plan fills bodies that begin from a state anew: their stress is in the state, which is not there yet.
    if scene.initial_state.is_some() || seeks_balance(scene) {
        plan.warnings
            .retain(|warning| !warning.starts_with(OUT_OF_BALANCE));
    }
    writeln!(out, "scene {}", scene.name)?;
    writeln!(out, "{plan}")?;
    let mut table = Table::new(["body", "particles", "state"]);
    for ((body, set), layout) in scene
        .bodies
        .iter()
        .zip(simulation.sets())
        .zip(&plan.layouts)
    {
        let particles = set.len();
        let name = if body.name.is_empty() {
            body.id.to_string()
        } else {
            body.name.clone()
        };
        table.push([
            name,
            grouped(particles as u64),
            bytes((particles * layout.bytes_per_particle()) as u64),
        ]);
    }
    write!(out, "\n{table}")?;
    if let Some(table) = ground::volumes(scene, &simulation) {
        write!(out, "\n{table}")?;
    }
    let axes = scene.dimension.axes();
    let nodes: u64 = scene.mesh.cells[..axes]
        .iter()
        .map(|&cells| cells as u64 + 1)
        .product();
    let active = simulation.nodes_active() as u64;
    let mut table = Table::new(["mesh", "nodes", "state"]);
    table.push(["whole".to_owned(), grouped(nodes)]);
    table.push([
        "held, with a border".to_owned(),
        grouped(active),
        bytes(active * plan.bytes_per_node() as u64),
    ]);
    write!(out, "\n{table}")?;
    if let Some(ranks) = ranks {
        let shares = ranks::shares(&simulation, ranks as usize)
            .map_err(|error| Failure::BadInput(format!("{}: {error}", places.name())))?;
        write!(out, "\n{shares}")?;
    }
    if let Some(line) = ground::imbalance(scene, &mut simulation) {
        writeln!(out, "\n{line}")?;
    }
    let forecast = Forecast::new(
        scene,
        places,
        &mut simulation,
        (set_up, plan.warnings.len()),
    );
    write!(out, "\n{forecast}")?;
    Ok(())
}
