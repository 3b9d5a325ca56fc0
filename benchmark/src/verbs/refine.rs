//! `proctor refine`: an error bar for a scene without an exact answer.

mod methods;

use super::settings::{Settings, bounded};
use super::stages;
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::record::Record;
use crate::refine::judge::SceneBars;
use crate::refine::quantity::Quantity;
use crate::refine::work::{Runs, Work};
use crate::refine::{rows, run};
use crate::say::say;
use crate::show::figures::refine as figures;
use crate::show::paint::{Mark, Paint};
use crate::show::{number, refine as show};
use clap::Args;
use proctor_files::json::{SourceMap, Stage};
use proctor_files::output::atomic;
use proctor_kernel::lanes::SelectedLanes;
use proctor_scene::simulation::Options;
use proctor_scene::{Problem, Scene};
use proctor_verification::refine::Meshes;
use proctor_verification::refine::field::Field;
use std::io::Write;
use std::path::{Path, PathBuf};

/// An error bar for a scene without an exact answer.
///
/// Runs the scene on three or more meshes and gives each quantity a value, a bar that holds the answer of an infinitely fine
/// mesh in 95 of 100 cases, the order seen, and a verdict. The bar is about mesh and step, not about model or data. The scene
/// as it stands is the finest mesh; `--finer 1` makes it the middle one. No bar is claimed where the energies of the scene do
/// not settle, or where the place of the mesh changes a value by more than its cell size does.
#[derive(Args)]
#[command(
    after_help = "Example: proctor new beam, then proctor refine beam.json --finer 1\n\
    As pictures and as a record: proctor refine beam.json --finer 1 --svg bars --json bars.json\n\
    A quantity of one's own: proctor refine beam.json --finer 1 --quantity dip=tip_uy@0.3\n\
    In a check: proctor refine beam.json --finer 1 --within 2%"
)]
pub struct Refine {
    /// Scene file (JSON); - for standard input
    scene: PathBuf,
    /// Number of meshes; the bars are those of the finest three
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u8).range(3..=8))]
    meshes: u8,
    /// Ratio of neighbouring cell sizes
    #[arg(long, value_name = "R", default_value_t = 2.0, value_parser = ratio)]
    ratio: f64,
    /// Number of meshes that are finer than the scene's own
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u8).range(..=4))]
    finer: u8,
    /// Places of the middle mesh beside its own, moved by parts of a cell [default: 3 with contact between bodies, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(..=15))]
    offsets: Option<u8>,
    /// Stage to judge; those before it are run on each mesh, too [default: the last one]
    #[arg(long, value_name = "NAME")]
    stage: Option<String>,
    /// Judge the run up to this time alone, in seconds
    #[arg(long, value_name = "T", value_parser = time)]
    until: Option<f64>,
    /// Quantity instead of the usual ones: a column of history.csv at the end, its largest value, its mean, or its value at a
    /// time; may be given several times
    #[arg(long, value_name = "NAME=COLUMN@end|max|mean|T", value_parser = Quantity::parse)]
    quantity: Vec<Quantity>,
    /// Field of the particles to compare between meshes: displacement, velocity or stress; may be given several times
    #[arg(long, value_name = "FIELD", value_parser = field, conflicts_with = "methods")]
    field: Vec<Field>,
    /// Refine with two to four methods side by side, such as cpGIMP-MUSL-FLIP,uGIMP-USL-APIC; `all`: the scene's own and those
    /// that are cheapest most often. Exit code 1 if their bars do not overlap
    #[arg(long, value_name = "all|NAME,…", value_delimiter = ',', conflicts_with_all = ["within", "svg"])]
    methods: Vec<String>,
    /// Exit code 1 if a bar is wider than this part of the change of its quantity, or is not claimed
    #[arg(long, value_name = "P%", value_parser = part)]
    within: Option<f64>,
    /// Write a record of all runs and bars (Google Benchmark JSON)
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write a picture of each quantity over the meshes and over time into this folder; created if it does not exist
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    settings: Settings,
}

fn ratio(text: &str) -> Result<f64, String> {
    let ratio = text.parse::<f64>().ok();
    let ratio = ratio.filter(|ratio| (1.2..=8.0).contains(ratio));
    ratio.ok_or_else(|| "accepted: a number from 1.2 to 8".to_owned())
}

fn time(text: &str) -> Result<f64, String> {
    let time = text.parse::<f64>().ok();
    let time = time.filter(|time| *time > 0.0 && time.is_finite());
    time.ok_or_else(|| "accepted: a time above 0 in seconds".to_owned())
}

fn field(text: &str) -> Result<Field, String> {
    let found = Field::ALL.into_iter().find(|field| field.word() == text);
    found.ok_or_else(|| "accepted: displacement, velocity, stress".to_owned())
}

fn part(text: &str) -> Result<f64, String> {
    let per_cent = text.strip_suffix('%').map(str::trim_end);
    let value = per_cent.unwrap_or(text).parse::<f64>().ok();
    let value = value.filter(|value| *value > 0.0 && value.is_finite());
    let value = value.map(|value| {
        if per_cent.is_some() {
            0.01 * value
        } else {
            value
        }
    });
    value.ok_or_else(|| "accepted: a part above 0 such as 2% or 0.02".to_owned())
}

/// The scene on its meshes.
fn on_meshes(scene: &Scene, meshes: &Meshes, places: &SourceMap) -> Result<Vec<Scene>, Failure> {
    meshes.scenes(scene).map_err(|problems| {
        let lines: Vec<String> = problems.iter().map(|p| places.of_problem(p)).collect();
        Failure::BadInput(lines.join("\n"))
    })
}

/// Stages of each mesh, each with a change.
fn stages_on_meshes(
    stages: &[Stage],
    meshes: &Meshes,
    change: impl Fn(&Scene) -> Scene,
) -> Result<Vec<Vec<Scene>>, Failure> {
    let mut all = vec![vec![]; meshes.count];
    for stage in stages {
        let scenes = on_meshes(&change(&stage.scene), meshes, &stage.places)?;
        for (mesh, scene) in all.iter_mut().zip(scenes) {
            mesh.push(scene);
        }
    }
    Ok(all)
}

/// Stages that begin from nothing but what they are given: a state from a file is one of a single mesh.
fn from_the_start(stages: &[Stage]) -> Result<(), Failure> {
    match stages.first() {
        Some(first) if first.scene.initial_state.is_some() => {
            let problem = Problem::new(
                "initial_state",
                "the state of a run on one mesh",
                "the scene of that run as a stage before this one (`stages`), which is run on each mesh",
            );
            Err(Failure::BadInput(first.places.of_problem(&problem)))
        }
        _ => Ok(()),
    }
}

impl Refine {
    /// The stage that is judged and those before it.
    fn chosen(&self, mut stages: Vec<Stage>) -> Result<(Stage, Vec<Stage>), Failure> {
        if let Some(name) = &self.stage {
            let known: Vec<&str> = stages.iter().map(|stage| stage.name.as_str()).collect();
            let Some(place) = known.iter().position(|known| known == name) else {
                let accepted = match &known[..] {
                    [""] => "no --stage, since the scene has no stages".to_owned(),
                    _ => known.join(", "),
                };
                return Err(Failure::BadInput(format!(
                    "--stage: found {name:?}; accepted: {accepted}"
                )));
            };
            stages.truncate(place + 1);
        }
        from_the_start(&stages)?;
        let judged = stages.pop();
        let judged = judged.ok_or_else(|| Failure::BadInput("no stage".to_owned()))?;
        Ok((judged, stages))
    }

    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let (stage, before) = self.chosen(stages(&self.scene)?)?;
        let Stage { scene, places, .. } = &stage;
        let options = self.settings.options()?;
        SelectedLanes::new(options.lanes).map_err(Failure::bad_input)?;
        if let (None, Some(threads)) = (options.threads, scene.threads) {
            bounded(&format!("{}: n_threads", self.scene.display()), threads)?;
        }
        self.in_time(scene)?;
        let meshes = Meshes {
            count: self.meshes.into(),
            ratio: self.ratio,
            finer: self.finer.into(),
        };
        let earlier = stages_on_meshes(&before, &meshes, Scene::clone)?;
        let scenes = on_meshes(scene, &meshes, places)?;
        let offsets = match self.offsets {
            Some(offsets) => offsets.into(),
            None if scene.contacts.is_empty() => 0,
            None => 3,
        };
        for note in meshes.notes(scene, offsets) {
            say!("note: {note}");
        }
        if scene.until.is_some() {
            say!(
                "note: `until` does not end the judged run, which goes on to {} s on each mesh",
                scene.time
            );
        }
        if !self.methods.is_empty() {
            return self.side_by_side(&stage, &before, &meshes, &options, out);
        }
        self.refine(&stage, &scenes, &earlier, offsets, &options, out)
    }

    /// Judged times and times of quantities that the scene reaches.
    fn in_time(&self, scene: &Scene) -> Result<(), Failure> {
        let of_quantity = self
            .quantity
            .iter()
            .filter_map(|quantity| match quantity.when {
                crate::refine::quantity::QuantityTime::At(time) => Some(("--quantity", time)),
                _ => None,
            });
        let mut asked = self
            .until
            .map(|time| ("--until", time))
            .into_iter()
            .chain(of_quantity);
        match asked.find(|(_, time)| *time > scene.time * (1.0 + 1e-9)) {
            Some((option, time)) => Err(Failure::BadInput(format!(
                "{option}: found {time} s; accepted: up to the end of the scene, {} s",
                scene.time
            ))),
            None => Ok(()),
        }
    }

    /// Columns of quantities that a run gives: now, and not after hours.
    fn has_columns(
        &self,
        coarsest: &Scene,
        options: &Options,
        places: &SourceMap,
    ) -> Result<(), Failure> {
        if self.quantity.is_empty() {
            return Ok(());
        }
        let known = run::columns(coarsest, options)
            .map_err(|error| Failure::BadInput(places.of_setup(&error)))?;
        match self
            .quantity
            .iter()
            .find(|quantity| !known.contains(&quantity.column))
        {
            Some(Quantity { name, column, .. }) => Err(Failure::BadInput(format!(
                "--quantity {name}: found the column {column:?}; accepted: {}",
                known.join(", ")
            ))),
            None => Ok(()),
        }
    }

    fn refine(
        &self,
        Stage { scene, places, .. }: &Stage,
        scenes: &[Scene],
        earlier: &[Vec<Scene>],
        offsets: usize,
        options: &Options,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        self.has_columns(&scenes[0], options, places)?;
        let threads = options.threads.unwrap_or(crate::record::BY_SCENE);
        let mut record = Record::new(options);
        record.set_incomplete(true);
        self.keep(&record)?;
        if let Some(folder) = &self.svg {
            std::fs::create_dir_all(folder)
                .map_err(|e| Failure::BadInput(format!("{}: {e}", folder.display())))?;
        }
        let interrupt = Interrupt::listen()?;
        let cells: Vec<String> = scenes.iter().map(|s| number(s.size_of_cell())).collect();
        say!(
            "{} meshes, h = {} m, coarse to fine",
            scenes.len(),
            cells.join(", ")
        );
        let work = Work {
            name: &scene.name,
            scenes,
            earlier,
            offsets,
            snapshot_at: (!self.field.is_empty()).then(|| self.until.unwrap_or(scene.time)),
            options,
            tells: true,
        };
        let runs = work
            .run(&interrupt)
            .map_err(|error| Failure::BadInput(places.of_setup(&error)))?;
        if offsets > 0 && runs.along.is_empty() && runs.meshes.len() == scenes.len() {
            say!(
                "note: no axis is free of planes in reach, loads and held boxes: the mesh was not moved"
            );
        }
        let judged = SceneBars::new(
            &scene.name,
            &runs.meshes,
            &runs.moved,
            &self.quantity,
            self.until,
        );
        let judged = judged.map(|refined| refined.with_fields(&self.field, &runs.meshes));
        let interrupted = interrupt.raised();
        match &judged {
            Ok(refined) => record.push_refined(refined, &runs, threads),
            Err(_) => rows::push(&mut record, &scene.name, &runs, None, threads),
        }
        record.set_incomplete(interrupted);
        let outcome = match &judged {
            Ok(refined) => self.told(refined, &runs, out)?,
            Err(reason) => {
                say!("{}: {reason}", places.name());
                Outcome::Failed
            }
        };
        self.keep(&record)?;
        if let (Some(folder), Ok(refined)) = (&self.svg, &judged) {
            pictures(folder, refined, &runs, out)?;
        }
        if let Some(path) = &self.json {
            let word = if interrupted {
                "incomplete record"
            } else {
                "record"
            };
            writeln!(out, "{word} in {}", path.display())?;
        }
        Ok(if interrupted {
            interrupt.outcome()
        } else {
            outcome
        })
    }

    /// The table, and whether all bars are as narrow as the user asks.
    fn told(
        &self,
        refined: &SceneBars,
        runs: &Runs,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        let paint = Paint::of_standard_output();
        show::table(refined, runs, paint, out)?;
        let Some(within) = self.within else {
            return Ok(Outcome::Fine);
        };
        let wide = refined
            .judged
            .iter()
            .filter(|judged| judged.bar().is_none_or(|bar| bar > within * judged.change));
        let (wide, all) = (wide.count(), refined.judged.len());
        let held = wide == 0 && all > 0;
        let mark = if held { Mark::Held } else { Mark::Failed };
        writeln!(
            out,
            "{} {wide} of {all} bars are wider than {} % of the change, or not claimed",
            paint.symbol(mark),
            number(100.0 * within)
        )?;
        Ok(if held { Outcome::Fine } else { Outcome::Failed })
    }

    /// Writes the record to the file of `--json`, if any.
    fn keep(&self, record: &Record) -> Result<(), Failure> {
        match &self.json {
            Some(path) => record.write(path).map_err(Failure::bad_input),
            None => Ok(()),
        }
    }
}

/// Two pictures for each quantity: over the meshes, and over time.
fn pictures(
    folder: &Path,
    refined: &SceneBars,
    runs: &Runs,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let mut written = 0;
    for judged in &refined.judged {
        let name = format!("{}-{}", refined.scene, judged.quantity.name);
        let name = name.replace(", ", "-").replace(['/', '\\', ' '], "-");
        let settling = figures::settling(refined, judged, runs);
        let history = figures::history(refined, judged, runs);
        if let Some(table) = rows::history(refined, judged, runs) {
            let path = folder.join(format!("{name}-time.csv"));
            atomic::write(&path, |file| file.write_all(table.as_bytes()))
                .map_err(Failure::bad_input)?;
        }
        for (chart, what) in [(Some(settling), "meshes"), (history, "time")] {
            let Some(chart) = chart else { continue };
            let path = folder.join(format!("{name}-{what}.svg"));
            atomic::write(&path, |file| file.write_all(chart.to_svg().as_bytes()))
                .map_err(Failure::bad_input)?;
            written += 1;
        }
    }
    writeln!(
        out,
        "{written} pictures in {}, and the histories with their bars as tables",
        folder.display()
    )?;
    Ok(())
}
