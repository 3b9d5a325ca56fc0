//! `proctor element`: a material on the paths of the laboratory, without a grid.

mod table;

use super::{names, scene};
use crate::exit::{Failure, Outcome};
use crate::show::{Table, figures, number};
use clap::Args;
use proctor_files::output::atomic;
use proctor_scene::{Material, Scene};
use proctor_verification::case::{Curve, CurvePoint};
use proctor_verification::element::path::{Path as Steps, follow};
use proctor_verification::element::{
    ElementError, State, Test, exact_deviator, exact_pressure, run,
};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Most steps of a path.
const MOST_STEPS: usize = 1_000_000;
/// Rows of the table in the terminal.
const ROWS: usize = 10;
/// Names of strain and stress components.
const COMPONENTS: [&str; 6] = ["xx", "yy", "zz", "yz", "xz", "xy"];

/// Run laboratory tests on the materials of a scene, without a grid.
///
/// A specimen under an isotropic pressure is strained, and some of its stresses are held: oedometer, triaxial, undrained,
/// biaxial, shear, isotropic, extension; z is its axis. The law is that of the scene, with its own code. Where a path has an
/// end in closed form, it is printed beside the result. Stresses are positive in tension; p and q = sqrt(3 J2) are not
/// negative under pressure.
///
/// With --table the path is your own: a CSV file with a header. Column `time` [s] increases; `strain_xx`, `strain_yy`,
/// `strain_zz`, `strain_yz`, `strain_xz`, `strain_xy` are totals (of the tensor; logarithmic where axes stay), `stress_xx` ...
/// [Pa] instead of the strain of a component drives its stress. What has no column keeps a strain of 0. The path begins at
/// time 0 without strain, under the pressure, and goes straight from row to row.
#[derive(Args)]
#[command(
    after_help = "Example: proctor element fixtures/scenes/soil_element.json --pressure 1e5\n\
    One test, with its curve: proctor element fixtures/scenes/soil_element.json --test shear --pressure 1e5 --svg curves\n\
    A path of your own: proctor element fixtures/scenes/soil_element.json --table path.csv"
)]
pub struct Element {
    /// Scene file (JSON) with the material; - for standard input
    scene: PathBuf,
    /// Only these tests: oedometer, triaxial, undrained, biaxial, shear, isotropic, extension
    #[arg(long = "test", value_name = "TEST")]
    tests: Vec<String>,
    /// Take the path from this table (CSV) instead: columns time, strain_xx ... strain_xy; stress_xx ... drives a stress
    #[arg(long, value_name = "FILE", conflicts_with_all = ["tests", "strain", "time"])]
    table: Option<PathBuf>,
    /// Only the material of this id
    #[arg(long, value_name = "ID")]
    material: Option<i64>,
    /// Pressure on all sides at the start [Pa]
    #[arg(
        long,
        value_name = "PA",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    pressure: f64,
    /// Strain at the end: axial strain; in `shear` the angle, in `isotropic` the volume strain
    #[arg(long, default_value_t = 0.05, allow_negative_numbers = true)]
    strain: f64,
    /// Number of steps; with --table from each row to the next
    #[arg(long, default_value_t = 200)]
    steps: usize,
    /// Duration of the path [s]; it matters for fluids and for materials with a relaxation time
    #[arg(
        long,
        value_name = "S",
        default_value_t = 1.0,
        allow_negative_numbers = true
    )]
    time: f64,
    /// Write all states into this folder, created if it does not exist: a table (CSV) for each material and test
    #[arg(long, value_name = "DIR")]
    csv: Option<PathBuf>,
    /// Write curves into this folder, created if it does not exist: two pictures for each material and test, three for a fluid
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
}

impl Element {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        self.check()?;
        let path = match &self.table {
            Some(file) => Some(self.steps_of(file)?),
            None => None,
        };
        let asked: Vec<PathRequest<'_>> = match &path {
            Some(path) => vec![PathRequest::Table(path)],
            None => names::chosen(&self.tests, &Test::ALL, "test", Test::word)?
                .into_iter()
                .map(PathRequest::Test)
                .collect(),
        };
        let (scene, _) = scene(&self.scene)?;
        let mut broken = false;
        for material in self.materials(&scene)? {
            for asked in &asked {
                broken |= !self.one(material, *asked, out)?;
            }
        }
        Ok(if broken {
            Outcome::Failed
        } else {
            Outcome::Fine
        })
    }

    fn check(&self) -> Result<(), Failure> {
        let bad = |what: &str, found: String, accepted: &str| {
            Err(Failure::BadInput(format!(
                "{what}: found {found}; accepted: {accepted}"
            )))
        };
        if !(self.pressure.is_finite() && self.pressure >= 0.0) {
            let accepted = "a finite number, 0 or greater [Pa]";
            return bad("--pressure", self.pressure.to_string(), accepted);
        }
        if !(self.strain > 0.0 && self.strain <= 1.0) {
            let accepted = "a number greater than 0, at most 1";
            return bad("--strain", self.strain.to_string(), accepted);
        }
        if self.steps == 0 || self.steps > MOST_STEPS {
            let accepted = format!("a whole number from 1 to {MOST_STEPS}");
            return bad("--steps", self.steps.to_string(), &accepted);
        }
        if !(self.time.is_finite() && self.time > 0.0) {
            let accepted = "a finite number greater than 0 [s]";
            return bad("--time", self.time.to_string(), accepted);
        }
        Ok(())
    }

    /// The path of a table, not longer than any other may be.
    fn steps_of(&self, file: &Path) -> Result<Steps, Failure> {
        let path = table::read(file, self.pressure)?;
        if path.rows.len() > MOST_STEPS / self.steps {
            return Err(Failure::BadInput(format!(
                "--steps: found {} for each of {} rows; accepted: at most {MOST_STEPS} together",
                self.steps,
                path.rows.len()
            )));
        }
        Ok(path)
    }

    fn materials<'a>(&self, scene: &'a Scene) -> Result<Vec<&'a Material>, Failure> {
        let Some(id) = self.material else {
            return Ok(scene.materials.iter().collect());
        };
        let found: Vec<&Material> = scene.materials.iter().filter(|m| m.id == id).collect();
        if found.is_empty() {
            let ids: Vec<String> = scene.materials.iter().map(|m| m.id.to_string()).collect();
            return Err(Failure::BadInput(format!(
                "--material: found {id}, which no material has; accepted: {}",
                ids.join(", ")
            )));
        }
        Ok(found)
    }

    /// One test of one material; whether it went through to its end.
    fn one(
        &self,
        material: &Material,
        asked: PathRequest<'_>,
        out: &mut dyn Write,
    ) -> Result<bool, Failure> {
        let law = &material.law;
        if law.needs_deformation() && self.pressure > 0.0 {
            return Err(Failure::BadInput(format!(
                "--pressure: found {} for {}, a {} material, whose stress follows from its deformation alone; accepted: 0",
                self.pressure,
                material.name,
                law.name()
            )));
        }
        let ran = self.take(material, asked);
        let states = &ran.states;
        writeln!(out, "{}", self.title(material, asked))?;
        write!(out, "{}", Self::table_of(&ran, material))?;
        let strength = match asked {
            PathRequest::Test(test) => test.strength(law, self.pressure),
            PathRequest::Table(_) => None,
        };
        if let (Some(exact), Some(last)) = (strength, states.last()) {
            writeln!(
                out,
                "  strength q: {} Pa at the end, {} Pa in closed form",
                number(last.deviator()),
                number(exact)
            )?;
        }
        if law.is_fluid() {
            writeln!(
                out,
                "  a fluid: its shear stress follows the rate of strain, and so how fast the path is gone"
            )?;
        }
        let name = format!("{}-{}", file_name(material), asked.word());
        if let Some(folder) = &self.csv {
            let path = folder.join(format!("{name}.csv"));
            write_to(&path, &csv(&ran, material))?;
            writeln!(out, "  states in {}", path.display())?;
        }
        if let Some(folder) = &self.svg {
            for (word, curve) in self.curves(&ran, material, asked) {
                let path = folder.join(format!("{name}-{word}.svg"));
                write_to(&path, &figures::curve(&curve).to_svg())?;
                writeln!(out, "  curve in {}", path.display())?;
            }
        }
        if let Err(error) = &ran.ended {
            writeln!(out, "  ended early: {error}")?;
        }
        writeln!(out)?;
        Ok(ran.ended.is_ok())
    }

    fn title(&self, material: &Material, asked: PathRequest<'_>) -> String {
        let what = match asked {
            PathRequest::Test(test) => format!("{} test", test.word()),
            PathRequest::Table(_) => "path of the table".to_owned(),
        };
        let (name, law) = (&material.name, material.law.name());
        format!("{name} ({law}): {what} from {} Pa", number(self.pressure))
    }

    /// Goes the way that is asked.
    fn take(&self, material: &Material, asked: PathRequest<'_>) -> PathRun {
        let (law, density) = (&material.law, material.density);
        match asked {
            PathRequest::Test(test) => {
                let controls = test.controls(self.strain);
                let dt = self.time / self.steps as f64;
                let (states, ended) = run(law, density, self.pressure, &controls, self.steps, dt);
                let share = |i: usize| i as f64 / self.steps as f64;
                PathRun {
                    at: (0..states.len()).map(|i| share(i) * self.strain).collect(),
                    of_table: false,
                    whole: self.steps,
                    states,
                    ended,
                }
            }
            PathRequest::Table(path) => {
                let (at, states, ended) = follow(law, density, self.pressure, path, self.steps);
                PathRun {
                    at,
                    of_table: true,
                    whole: self.steps * path.rows.len(),
                    states,
                    ended,
                }
            }
        }
    }

    fn table_of(ran: &PathRun, material: &Material) -> Table {
        let variables = names_of_variables(material);
        let first = if ran.of_table { "time (s)" } else { "strain" };
        let headings = [first, "p (Pa)", "q (Pa)", "volume"].map(str::to_owned);
        let mut table = Table::new(headings.into_iter().chain(variables));
        let every = (ran.whole / ROWS).max(1);
        for (i, (state, at)) in ran.states.iter().zip(&ran.at).enumerate() {
            if i % every != 0 && i + 1 != ran.states.len() {
                continue;
            }
            let own = [
                if ran.of_table {
                    number(*at)
                } else {
                    format!("{} %", number(100.0 * at))
                },
                number(state.pressure()),
                number(state.deviator()),
                format!("{} %", number(100.0 * state.volume_strain())),
            ];
            let variables = state.variables.iter().copied().map(number);
            table.push(own.into_iter().chain(variables));
        }
        table
    }

    /// q and the volume strain over the strain, and the pressure of a fluid, each with the word of its file.
    fn curves(
        &self,
        ran: &PathRun,
        material: &Material,
        asked: PathRequest<'_>,
    ) -> Vec<(&'static str, Curve)> {
        let (abscissa, scale) = if ran.of_table {
            ("time (s)", 1.0)
        } else {
            ("strain (%)", 100.0)
        };
        let of =
            |ordinate, value: &dyn Fn(&State) -> f64, exact: &dyn Fn(f64) -> Option<f64>| Curve {
                title: self.title(material, asked),
                abscissa,
                ordinate,
                points: (ran.states.iter().zip(&ran.at))
                    .map(|(state, at)| CurvePoint {
                        at: scale * at,
                        computed: value(state),
                        exact: exact(*at).unwrap_or(f64::NAN),
                    })
                    .collect(),
            };
        let law = &material.law;
        let (pressure, rate) = (self.pressure, self.strain / self.time);
        let deviator = |strain| match asked {
            // The start is an isotropic pressure: where the path has a closed form, it begins without a difference of stresses.
            PathRequest::Test(test) if strain == 0.0 => {
                exact_deviator(test, law, pressure, self.strain, rate).map(|_| 0.0)
            }
            PathRequest::Test(test) => exact_deviator(test, law, pressure, strain, rate),
            PathRequest::Table(_) => None,
        };
        let volume = |state: &State| 100.0 * state.volume_strain();
        let mut curves = vec![
            ("q", of("q (Pa)", &State::deviator, &deviator)),
            ("volume", of("volume strain (%)", &volume, &|_| None)),
        ];
        if law.is_fluid() {
            let exact = |strain| match asked {
                PathRequest::Test(test) => exact_pressure(test, law, pressure, strain),
                PathRequest::Table(_) => None,
            };
            curves.push(("p", of("p (Pa)", &State::pressure, &exact)));
        }
        curves
    }
}

/// A way to go.
#[derive(Clone, Copy)]
enum PathRequest<'a> {
    Test(Test),
    Table(&'a Steps),
}

impl PathRequest<'_> {
    fn word(self) -> &'static str {
        match self {
            Self::Test(test) => test.word(),
            Self::Table(_) => "table",
        }
    }
}

/// A way that was gone.
struct PathRun {
    /// The strain of a test after each step, or the time of a table \[s\].
    at: Vec<f64>,
    of_table: bool,
    /// Steps to its end.
    whole: usize,
    states: Vec<State>,
    ended: Result<(), ElementError>,
}

/// Names of the internal variables of a material's law.
fn names_of_variables(material: &Material) -> Vec<String> {
    let variables = material.law.variables().iter();
    variables
        .flat_map(|variable| (0..variable.components).map(|i| variable.component(i)))
        .collect()
}

/// The name of a material as part of the name of a file.
fn file_name(material: &Material) -> String {
    let plain = |c: char| if c.is_alphanumeric() { c } else { '_' };
    material.name.chars().map(plain).collect()
}

/// All states as a table.
fn csv(ran: &PathRun, material: &Material) -> String {
    let strains = COMPONENTS.map(|c| format!("strain_{c}"));
    let stresses = COMPONENTS.map(|c| format!("stress_{c}"));
    let rest = ["p", "q", "volume_ratio", "stored", "dissipated"].map(str::to_owned);
    let variables = names_of_variables(material)
        .into_iter()
        .map(|name| name.replace(' ', "_"));
    let time = ran.of_table.then(|| "time".to_owned());
    let header: Vec<String> = (time.into_iter().chain(strains).chain(stresses).chain(rest))
        .chain(variables)
        .collect();
    let mut text = header.join(",") + "\n";
    for (state, at) in ran.states.iter().zip(&ran.at) {
        let time = ran.of_table.then_some(*at);
        let own = [
            state.pressure(),
            state.deviator(),
            state.volume,
            state.stored,
            state.dissipated,
        ];
        let numbers = (time
            .iter()
            .chain(&state.strain)
            .chain(&state.stress)
            .chain(&own))
        .chain(&state.variables);
        let cells: Vec<String> = numbers.map(|x| format!("{x:?}")).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}

/// Writes a text whole into a folder that is made if it is not there.
fn write_to(path: &Path, text: &str) -> Result<(), Failure> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| {
            Failure::BadInput(format!(
                "cannot make the folder {}: {error}",
                folder.display()
            ))
        })?;
    }
    atomic::write(path, |file| file.write_all(text.as_bytes())).map_err(Failure::bad_input)
}
