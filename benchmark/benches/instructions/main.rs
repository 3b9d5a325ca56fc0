//! Instructions per particle and step, counted by valgrind: the same number on every run, whatever else the machine
//! does.
//!
//! `cargo bench --bench instructions [-- [--features] [--only WORD] [--since FILE] [--json FILE]]`. The example `counted` of
//! proctor-files is built as the program is and run under callgrind (which runs the AVX2 lanes). Then features that do nothing
//! are counted against the same scene without them: they may cost 0.1 % and must change no bit. `--features` does only that, `--only
//! laws` counts nothing but what has the word in its name. `--since FILE` takes from that record what depends on no source that
//! changed since, by the digests beside it; `--json FILE` writes the record and its digests.
//!
//! Exit code 0 fine, 1 if a count does not repeat or a feature costs something, and 0 with the words "left out" where
//! valgrind is not installed.

mod counter;

use counter::Counts;
use proctor_benchmark::bench::counted::{Group, Item, features, scenes_and_parts};
use proctor_benchmark::bench::sources::KeptDigests;
use proctor_benchmark::record::{Record, Row};
use proctor_benchmark::show::{Table, grouped};
use proctor_scene::simulation::Options;
use std::error::Error;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

/// Largest relative difference between two counts of the same, and cost of a feature that does nothing.
const TOLERANCE: f64 = 1e-3;

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(1)
        }
    }
}

/// The request.
#[derive(Default)]
struct Request {
    only_features: bool,
    only: Option<String>,
    since: Option<PathBuf>,
    json: Option<PathBuf>,
}

impl Request {
    fn read() -> Result<Self, Box<dyn Error>> {
        let mut asked = Self::default();
        let mut arguments = std::env::args().skip(1);
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or(format!("{argument} wants a value"));
            match argument.as_str() {
                "--features" => asked.only_features = true,
                "--only" => asked.only = Some(value()?),
                "--since" => asked.since = Some(value()?.into()),
                "--json" => asked.json = Some(value()?.into()),
                // Cargo says so to every bench target.
                "--bench" => {}
                other => {
                    return Err(format!(
                        "unknown argument {other}; accepted: --features, --only WORD, --since FILE, --json FILE"
                    )
                    .into());
                }
            }
        }
        Ok(asked)
    }
}

fn run() -> Result<bool, Box<dyn Error>> {
    let asked = Request::read()?;
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("left out: valgrind is not installed");
        return Ok(true);
    }
    let mut record = Record::new(&Options::default());
    record.context["counted_for"] = "x86-64".into();
    // Whatever this machine has: valgrind runs no wider ones.
    record.context["lanes"] = "avx2".into();
    let mut items = vec![];
    if !asked.only_features {
        items.extend(scenes_and_parts()?);
        let word = asked.only.as_deref().unwrap_or("");
        items.retain(|item| item.name.contains(word));
    }
    let groups = if asked.only.is_none() {
        features()
    } else {
        vec![]
    };
    let counts = Counts::of(&asked, &record, &items, &groups)?;
    let mut sound = true;
    if !items.is_empty() {
        sound &= tell_counts(&items, &counts, &mut record);
    }
    if !groups.is_empty() {
        sound &= tell_features(&groups, &counts, &mut record);
    }
    if let Some(path) = &asked.json {
        record.write(path)?;
        counts.digests.write(&KeptDigests::beside(path))?;
        println!("record in {}", path.display());
    }
    Ok(sound)
}

/// Prints the counts of scenes and puts them into the record; whether the first came out the same again.
fn tell_counts(items: &[Item], counts: &Counts, record: &mut Record) -> bool {
    println!("instructions per particle and step, AVX2 lanes\n");
    let mut table = Table::new(["what", "particles", "instructions", "again"]);
    let mut sound = true;
    for item in items {
        if let Some((row, digest)) = counts.kept.get(&item.row()) {
            let number = |key: &str| row.counters.get(key).copied().unwrap_or_default();
            table.push([
                item.name.clone(),
                grouped(number("particles") as u64),
                format!("{:.1}", number("instructions")),
                format!("sources unchanged since {}", digest.short()),
            ]);
            record.push(row.clone());
            continue;
        }
        let count = &counts.counted[&item.name];
        let each = count.per_particle();
        let mut line = vec![
            item.name.clone(),
            grouped(count.particles),
            format!("{each:.1}"),
        ];
        if let Some((_, again)) = counts.again.as_ref().filter(|(name, _)| *name == item.name) {
            let again = again.per_particle();
            let repeats = (again - each).abs() <= TOLERANCE * each;
            line.push(format!(
                "{again:.1}{}",
                if repeats { "" } else { " DIFFERS" }
            ));
            sound &= repeats;
        }
        table.push(line);
        let mut row = Row::sample(item.row(), 0, 1);
        row.count("instructions", each);
        row.count("particles", count.particles as f64);
        record.push(row);
    }
    println!("{table}");
    sound
}

/// Prints what features that do nothing cost and puts their counts into the record; whether they cost and change nothing.
fn tell_features(groups: &[Group], counts: &Counts, record: &mut Record) -> bool {
    println!("features that do nothing: instructions per particle and step\n");
    let mut table = Table::new(["feature", "instructions", "more", "verdict"]);
    let mut sound = true;
    for group in groups {
        let short = |item: &Item| item.name.trim_start_matches("feature/").to_owned();
        let base = counts.counted.get(&group.base.name);
        if let Some(base) = base {
            table.push([short(&group.base), format!("{:.2}", base.per_particle())]);
        }
        for item in &group.features {
            let name = short(item);
            if let Some((row, digest)) = counts.kept.get(&item.row()) {
                let each = row
                    .counters
                    .get("instructions")
                    .copied()
                    .unwrap_or_default();
                let since = format!("sources unchanged since {}", digest.short());
                table.push([name, format!("{each:.2}"), String::new(), since]);
                record.push(row.clone());
                continue;
            }
            let count = &counts.counted[&item.name];
            let base = base.expect("counted with its features");
            let each = count.per_particle();
            let more = each / base.per_particle() - 1.0;
            let verdict = if count.hash != base.hash {
                "CHANGES THE RESULT"
            } else if more > TOLERANCE {
                "COSTS MORE THAN 0.1 %"
            } else {
                "ok"
            };
            sound &= verdict == "ok";
            table.push([
                name,
                format!("{each:.2}"),
                format!("{:+.4} %", 100.0 * more),
                verdict.to_owned(),
            ]);
            let mut row = Row::sample(item.row(), 0, 1);
            row.count("instructions", each);
            record.push(row);
        }
    }
    println!("{table}");
    sound
}
