//! Plays whole steps or one part of a step of a scene, for counts of instructions: only what is called from `played`
//! is to be counted (`valgrind --tool=callgrind --toggle-collect='*played*'`).
//!
//! `counted SCENE.json step|PART TIMES` prints the number of particles and the hash of their state.

use proctor_files::json;
use proctor_scene::simulation::{Options, Part, Simulation, StepError};
use std::path::Path;

/// Steps before the first that is played: the first one starts the leapfrog.
const WARM_UP: usize = 2;

#[inline(never)]
fn played(play: &mut dyn FnMut() -> Result<(), StepError>) -> Result<(), StepError> {
    play()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, what, times] = arguments.as_slice() else {
        return Err("counted SCENE.json step|PART TIMES".into());
    };
    let times: usize = times.parse()?;
    let scene = json::read(Path::new(file))?;
    // One thread: a count of the work, not of threads that wait.
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = Simulation::new(&scene, &options)?;
    for _ in 0..WARM_UP {
        simulation.step(f64::INFINITY)?;
    }
    if what == "step" {
        for _ in 0..times {
            played(&mut || simulation.step(f64::INFINITY).map(|_| ()))?;
        }
    } else {
        let part = Part::ALL.into_iter().find(|part| part.name() == what);
        let part = part.ok_or_else(|| format!("no part {what}"))?;
        let mut rehearsal = simulation.rehearse(part)?;
        for _ in 0..times {
            rehearsal.set()?;
            played(&mut || rehearsal.play())?;
        }
    }
    println!(
        "{} {:016x}",
        simulation.particles(),
        simulation.state_hash()
    );
    Ok(())
}
