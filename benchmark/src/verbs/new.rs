//! `proctor new`: a small scene to start from.

use super::names;
use crate::exit::{Failure, Outcome};
use clap::Args;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Write a small scene to start from; without a kind, list the kinds.
///
/// The scene runs as it is, in seconds, and says in its comments what happens in it. No file is ever overwritten.
#[derive(Args)]
#[command(
    after_help = "Example: proctor new column, then proctor run column.json --out column\n\
    The kinds: proctor new"
)]
pub struct New {
    /// Kind of scene; without it, list the kinds
    kind: Option<String>,
    /// File to write [default: KIND.json in this folder]
    #[arg(long, value_name = "FILE", requires = "kind")]
    out: Option<PathBuf>,
}

/// A scene to start from.
#[derive(Clone, Copy)]
struct Template {
    name: &'static str,
    /// Events of the scene.
    what: &'static str,
    text: &'static str,
    /// A file that it names, in its folder: name and text.
    beside: Option<(&'static str, &'static str)>,
    /// Folder of the last stage in that of the results; empty where the scene has no stages.
    stage: &'static str,
    /// Field of the frames that shows most.
    field: &'static str,
    /// A key to change, and what that does.
    change: &'static [(&'static str, &'static str)],
}

const TEMPLATES: &[Template] = &[
    Template {
        name: "column",
        what: "an elastic column settles under its own weight",
        text: include_str!("../../templates/column.json"),
        beside: None,
        stage: "",
        field: "Stress_YY",
        change: &[
            (
                "young",
                "1e5 instead of 1e6: it sinks about ten times as far",
            ),
            ("damping", "without it the column swings for ever"),
            ("cells_dimension", "half of it, and twice `cells_number`"),
        ],
    },
    Template {
        name: "incline",
        what: "a block slides down an incline with friction: contact on the grid",
        text: include_str!("../../templates/incline.json"),
        beside: None,
        stage: "",
        field: "Velocity",
        change: &[
            (
                "friction",
                "0.6 instead of 0.3: the block stays where it is",
            ),
            ("gravity", "another angle of the incline"),
            ("normal_type", "\"collinear\" instead of \"master\""),
        ],
    },
    Template {
        name: "discs",
        what: "two rubber discs collide and part: contact on the grid",
        text: include_str!("../../templates/discs.json"),
        beside: None,
        stage: "",
        field: "Pressure",
        change: &[
            ("initial_velocity", "twice as fast, or not along one line"),
            ("transfer", "\"FLIP\" instead of \"APIC\""),
            ("contact", "without it the discs brake before they touch"),
        ],
    },
    Template {
        name: "ball",
        what: "a soft ball rolls down a rigid incline: contact between boundaries (mortar)",
        text: include_str!("../../templates/ball.json"),
        beside: None,
        stage: "",
        field: "Velocity",
        change: &[
            ("friction", "0 instead of 0.3: it slides and does not turn"),
            ("normal_stiffness", "1e5 instead of 1e4: it sinks in less"),
            ("points", "a line with a bend"),
        ],
    },
    Template {
        name: "soil",
        what: "an embankment of soil on ground that shakes: a record moves the base",
        text: include_str!("../../templates/soil.json"),
        beside: Some(("soil.csv", include_str!("../../templates/soil.csv"))),
        stage: "",
        field: "Velocity",
        change: &[
            ("file", "a record of an earthquake instead of soil.csv"),
            ("density", "or `young`: another period of the embankment"),
            ("gravity", "[0, -9.81], with time to settle"),
        ],
    },
    Template {
        name: "earthquake",
        what: "a slope settles, then a wave comes in from the rock below: stages, absorbing base",
        text: include_str!("../../templates/earthquake.json"),
        beside: Some((
            "earthquake.csv",
            include_str!("../../templates/earthquake.csv"),
        )),
        stage: "/2-shake",
        field: "Velocity",
        change: &[
            (
                "file",
                "a record of an earthquake instead of earthquake.csv",
            ),
            (
                "base",
                "\"rigid\" with a fixed plane_Y0: waves that go down come back",
            ),
            ("cohesion", "1e4 instead of 3e4: the slope slides"),
        ],
    },
    Template {
        name: "terrain",
        what: "a slope of three layers under a terrain begins with the stress of its own weight",
        text: include_str!("../../templates/terrain.json"),
        beside: Some(("terrain.csv", include_str!("../../templates/terrain.csv"))),
        stage: "",
        field: "Stress_YY",
        change: &[
            (
                "upper",
                "your own terrain, rows of x and y; in three dimensions a raster",
            ),
            ("layers", "another base, or one layer more"),
            ("cohesion", "3000 in the fill: its face slides"),
        ],
    },
    Template {
        name: "sand",
        what: "a column of sand collapses and spreads on rough ground: Mohr-Coulomb",
        text: include_str!("../../templates/sand.json"),
        beside: None,
        stage: "",
        field: "Velocity",
        change: &[
            ("friction", "20 instead of 30: it runs farther"),
            ("cohesion", "5000: the column stands"),
            ("point_p2", "a column twice as high, in a longer mesh"),
        ],
    },
    Template {
        name: "dam",
        what: "a column of water is let go and runs along the ground: a dam breaks",
        text: include_str!("../../templates/dam.json"),
        beside: None,
        stage: "",
        field: "Velocity",
        change: &[
            ("viscosity", "500 instead of 0.001: it creeps"),
            (
                "type",
                "\"bingham\" with a `yield_stress` of 2000: mud comes to rest",
            ),
            ("cells_dimension", "half of it, and twice `cells_number`"),
        ],
    },
    Template {
        name: "consolidation",
        what: "a layer of saturated soil is loaded and drains at its top: two phases",
        text: include_str!("../../templates/consolidation.json"),
        beside: None,
        stage: "",
        field: "Pore Pressure",
        change: &[
            (
                "hydraulic_conductivity",
                "a tenth of it, and ten times the `time`: the same settlement",
            ),
            ("plane_Yn", "\"sliding\" for the water: nothing drains"),
            ("bulk_fluid", "2e9, that of water: smaller steps"),
        ],
    },
    Template {
        name: "dam-slope",
        what: "the water before a dam is drawn down, and its face slides: two phases, standing water",
        text: include_str!("../../templates/dam-slope.json"),
        beside: None,
        stage: "",
        field: "Displacement",
        change: &[
            ("level", "5: the reservoir stays, and the dam stands"),
            ("cohesion", "2e4 instead of 1000: it stands"),
            (
                "hydraulic_conductivity",
                "0.1: pores drain, and it slides a quarter as far",
            ),
        ],
    },
    Template {
        name: "pile",
        what: "a pile in clay settles under a load on its head: a body of revolution",
        text: include_str!("../../templates/pile.json"),
        beside: None,
        stage: "",
        field: "Displacement",
        change: &[
            ("traction", "-6e5 instead of -3e5: the clay yields"),
            ("cohesion", "2e4 instead of 4e4: the same"),
            ("axisymmetric", "without it the pile is a wall"),
        ],
    },
    Template {
        name: "triaxial",
        what: "a triaxial test on sand, run as a body of revolution in its cell",
        text: include_str!("../../templates/triaxial.json"),
        beside: None,
        stage: "",
        field: "Stress_YY",
        change: &[
            ("friction", "28 instead of 30: it fails before 290 kPa"),
            ("cohesion", "1e4 instead of 0: nothing yields"),
            (
                "plane_Y0",
                "\"sliding\": a smooth platen, and stress is uniform",
            ),
        ],
    },
    Template {
        name: "beam",
        what: "a soft beam, fixed at one end, bends under its own weight: large strains",
        text: include_str!("../../templates/beam.json"),
        beside: None,
        stage: "",
        field: "Stress_XX",
        change: &[
            (
                "shape_function",
                "\"linear\": shows the noise of cells that are crossed in the stress",
            ),
            ("damping", "{\"type\": \"kinetic\"}: it comes to rest"),
            ("particles_per_cell", "2 instead of 3"),
        ],
    },
    Template {
        name: "drop",
        what: "a rubber sphere falls on the ground and bounces, in three dimensions",
        text: include_str!("../../templates/drop.json"),
        beside: None,
        stage: "",
        field: "Pressure",
        change: &[
            ("plane_Z0", "\"fixed\" instead of a smooth ground"),
            (
                "cells_dimension",
                "half of it, and twice `cells_number`: 8 times the particles",
            ),
            ("poisson", "0.45, with `volumetric_strain` \"cell_average\""),
        ],
    },
];

impl New {
    pub fn run(&self, out: &mut dyn Write) -> Result<Outcome, Failure> {
        let Some(kind) = &self.kind else {
            return list(out);
        };
        let chosen = names::chosen(
            std::slice::from_ref(kind),
            TEMPLATES,
            "kind",
            |template: Template| template.name,
        )?;
        for template in chosen {
            let default = PathBuf::from(format!("{}.json", template.name));
            let path = self.out.as_ref().unwrap_or(&default);
            template.write(path)?;
            template.tell(path, out)?;
        }
        Ok(Outcome::Fine)
    }
}

fn list(out: &mut dyn Write) -> Result<Outcome, Failure> {
    writeln!(out, "`proctor new KIND` writes one of these scenes:")?;
    let width = TEMPLATES.iter().map(|t| t.name.len()).max().unwrap_or(0);
    for Template { name, what, .. } in TEMPLATES {
        writeln!(out, "  {name:<width$}  {what}")?;
    }
    Ok(Outcome::Fine)
}

impl Template {
    /// Writes the scene, and first what it names; neither where one of the names is taken.
    fn write(&self, path: &Path) -> Result<(), Failure> {
        let folder = path.parent().unwrap_or_else(|| Path::new(""));
        let beside = (self.beside).map(|(name, text)| (folder.join(name), text));
        let files: Vec<(PathBuf, &str)> = beside
            .into_iter()
            .chain([(path.to_owned(), self.text)])
            .collect();
        // All before any: a scene without its record, or a record alone, would be half of it.
        if let Some((taken, _)) = files.iter().find(|(path, _)| path.exists()) {
            return Err(is_taken(taken));
        }
        for (path, text) in &files {
            OpenOptions::new()
                .write(true)
                .create_new(true)
                .open(path)
                .and_then(|mut file| file.write_all(text.as_bytes()))
                .map_err(|error| match error.kind() {
                    ErrorKind::AlreadyExists => is_taken(path),
                    _ => Failure::BadInput(format!("{}: {error}", path.display())),
                })?;
        }
        Ok(())
    }

    /// Says what was written and what to do with it.
    fn tell(&self, path: &Path, out: &mut dyn Write) -> Result<(), Failure> {
        let shown = path.display();
        write!(out, "{shown}")?;
        if let Some((name, _)) = self.beside {
            write!(out, " and beside it {name}")?;
        }
        let results = match path.extension() {
            Some(_) => path.with_extension(""),
            None => path.with_extension("out"),
        };
        let results = results.display();
        writeln!(out, ": {}", self.what)?;
        writeln!(out, "\nnext")?;
        writeln!(out, "  proctor plan {shown}")?;
        writeln!(out, "  proctor run {shown} --out {results}")?;
        writeln!(
            out,
            "  then open {results}{}/particles.pvd in ParaView, coloured by {}",
            self.stage, self.field
        )?;
        writeln!(out, "\nto change (`proctor keys KEY` explains a key)")?;
        let width = self.change.iter().map(|(key, _)| key.len()).max();
        let width = width.unwrap_or(0);
        for (key, what) in self.change {
            writeln!(out, "  {key:<width$}  {what}")?;
        }
        Ok(())
    }
}

fn is_taken(path: &Path) -> Failure {
    Failure::BadInput(format!(
        "{}: found a file of this name, which stays as it is; accepted: a name that is free, with --out FILE",
        path.display()
    ))
}
