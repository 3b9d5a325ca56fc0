//! `proctor` without a verb: the main job on the built-in set.

use crate::exit::{Failure, Outcome};
use crate::show::{Table, case as show, grouped};
use crate::speed::{self, Speed};
use crate::suite::{self, Ran};
use proctor_kernel::simulation::Options;
use proctor_verification::case::{self, Size};
use std::io::Write;

const WHERE_TO_GO: &str = "\
Where to go from here (in a checkout, `cargo run --release --` stands for `proctor`)
  proctor verify
      the full ladders with observed orders, and why each bound
  proctor run fixtures/scenes/disc_bounce_2d.json --out out
      a scene; open out/particles.pvd in ParaView
  proctor plan fixtures/scenes/manual/boussinesq.json
      what a scene needs, and what is left out
  proctor -h
      everything else";

/// The suites in short, error and run time side by side, then the speed.
pub fn run(out: &mut dyn Write) -> Result<Outcome, Failure> {
    let options = Options::default();
    let mut all: Vec<Ran> = vec![];
    for &case in case::all() {
        let ran = suite::run(case, Size::Quick, &options);
        show::runs(&ran, out)?;
        show::gates(&ran, false, out)?;
        out.flush()?;
        all.push(ran);
    }
    let measured = speeds();
    match &measured {
        Ok(speeds) => show_speeds(speeds, out)?,
        Err(reason) => writeln!(out, "speed: FAIL, {reason}\n")?,
    }
    show::total(&all, out)?;
    writeln!(out, "\n{WHERE_TO_GO}")?;
    Ok(if measured.is_ok() && all.iter().all(Ran::passed) {
        Outcome::Fine
    } else {
        Outcome::Failed
    })
}

/// One thread, and all of them.
fn speeds() -> Result<Vec<Speed>, String> {
    let scene = speed::block().map_err(|error| error.to_string())?;
    let all = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let mut counts = vec![1, all];
    counts.dedup();
    counts
        .into_iter()
        .map(|threads| speed::measure(&scene, threads))
        .collect()
}

fn show_speeds(speeds: &[Speed], out: &mut dyn Write) -> Result<(), Failure> {
    let Some(first) = speeds.first() else {
        return Ok(());
    };
    writeln!(
        out,
        "speed: {} particles, 3D, uGIMP, USL, {} lanes; ns per particle and step, best of 3\n",
        grouped(first.particles as u64),
        first.lanes
    )?;
    let mut table = Table::new(["threads", "wall", "CPU"]);
    for speed in speeds {
        table.push([
            speed.threads.to_string(),
            format!("{:.0}", speed.wall),
            format!("{:.0}", speed.cpu),
        ]);
    }
    writeln!(out, "{table}")?;
    Ok(())
}
