//! The executables of a configuration: commands, limits, the meaning of their labels, and their own keys of a scene.

use super::check::Check;
use super::raw::{OneOrMany, RawConfig, RawExecutable, RawSolver};
use super::{Executable, Space, TimeLabel};
use crate::bench::children::OWN;
use serde_json::Map;
use std::time::Duration;

/// Longest time that an executable may have \[s\]: a year.
const LONGEST_TIMEOUT: f64 = 3.2e7;
/// Most cells of a slab in place of a problem in the plane.
const MOST_CELLS: usize = 16;
/// Keys of a scene that say how it is solved, not what: an executable may have others than the scene.
const OF_METHOD: [&str; 5] = [
    "shape_function",
    "stress_scheme_update",
    "transfer",
    "domain_update",
    "pic_fraction",
];

impl Check<'_> {
    /// All executables, in the order of the file.
    pub(super) fn executables(&mut self, raw: &RawConfig) -> Vec<Executable> {
        let named = raw.executables.iter().flat_map(|named| &named.0);
        named
            .filter_map(|(name, executable)| {
                let path = format!("executables.{name}");
                if name == OWN {
                    let accepted = "another name: this program is among them by itself";
                    self.add(&*path, format!("the name `{OWN}`"), accepted);
                }
                match executable {
                    RawExecutable::Path(program) => Some(Executable {
                        name: name.clone(),
                        command: proctor_command(self.program(program)),
                        folder: None,
                        timeout: Executable::TIMEOUT,
                        time_label: TimeLabel::Frame,
                        warm_up: false,
                        method: None,
                        scene: Map::new(),
                        space: Space::Slab(1),
                    }),
                    RawExecutable::Solver(solver) => self.solver(&path, name, solver),
                }
            })
            .collect()
    }

    fn solver(&mut self, path: &str, name: &str, solver: &RawSolver) -> Option<Executable> {
        let mut command = match &solver.command {
            // One text is split at blanks, a list is taken as it is.
            Some(OneOrMany(words)) if words.len() == 1 => {
                words[0].split_whitespace().map(str::to_owned).collect()
            }
            Some(OneOrMany(words)) => words.clone(),
            None => vec![],
        };
        let accepted = "program and arguments, with {scene}, {threads} and {out}";
        let at = format!("{path}.command");
        if command.is_empty() {
            self.add(at, "no command", accepted);
            return None;
        }
        if !command.iter().any(|word| word.contains("{scene}")) {
            self.add(at, "a command without {scene}", accepted);
        }
        command[0] = self.program(&command[0]);
        let scene = solver.scene.clone().unwrap_or_default();
        for key in scene
            .keys()
            .filter(|key| !OF_METHOD.contains(&key.as_str()))
        {
            self.unknown(&format!("{path}.scene.{key}"), key, &OF_METHOD);
        }
        let folder = solver.folder.as_ref();
        Some(Executable {
            name: name.to_owned(),
            command,
            folder: folder.map(|folder| self.folder.join(folder)),
            timeout: self.timeout(&format!("{path}.timeout"), solver.timeout),
            time_label: self.time_label(&format!("{path}.time_label"), solver.time_label.as_ref()),
            warm_up: solver.warm_up.unwrap_or(false),
            method: solver.method.clone(),
            scene,
            space: self.space(path, solver),
        })
    }

    fn time_label(&mut self, path: &str, given: Option<&String>) -> TimeLabel {
        let Some(word) = given else {
            return TimeLabel::default();
        };
        let known = TimeLabel::ALL.iter().find(|(known, _)| known == word);
        if let Some((_, label)) = known {
            return *label;
        }
        self.unknown(path, word, &TimeLabel::ALL.map(|(known, _)| known));
        TimeLabel::default()
    }

    fn space(&mut self, path: &str, solver: &RawSolver) -> Space {
        let cells = solver.thickness.unwrap_or(1);
        if !(1..=MOST_CELLS).contains(&cells) {
            let accepted = format!("a whole number from 1 to {MOST_CELLS}: cells of a slab");
            self.add(format!("{path}.thickness"), cells.to_string(), accepted);
        }
        match solver.dimension {
            Some(2) => {
                if solver.thickness.is_some() {
                    let accepted = "no thickness of a solver of two dimensions";
                    self.add(format!("{path}.thickness"), cells.to_string(), accepted);
                }
                Space::Plane
            }
            None | Some(3) => Space::Slab(cells),
            Some(other) => {
                self.add(format!("{path}.dimension"), other.to_string(), "2 or 3");
                Space::Slab(cells)
            }
        }
    }

    fn timeout(&mut self, path: &str, given: Option<f64>) -> Duration {
        let Some(seconds) = given else {
            return Executable::TIMEOUT;
        };
        let timeout = Duration::try_from_secs_f64(seconds).unwrap_or_default();
        if timeout.is_zero() || seconds > LONGEST_TIMEOUT {
            self.add(
                path,
                seconds.to_string(),
                format!("a number greater than 0 and at most {LONGEST_TIMEOUT} [s]"),
            );
        }
        timeout
    }

    /// A program by path, seen from the folder of the configuration; one without a folder is looked for in PATH
    /// unless it lies beside the configuration.
    fn program(&self, name: &str) -> String {
        let beside = self.folder.join(name);
        if name.contains('/') || beside.is_file() {
            std::path::absolute(&beside)
                .unwrap_or(beside)
                .display()
                .to_string()
        } else {
            name.to_owned()
        }
    }
}

/// The command of a program that takes what `proctor run` takes.
pub fn proctor_command(program: String) -> Vec<String> {
    let arguments = ["run", "{scene}", "--out", "{out}", "--threads", "{threads}"];
    let mut command = vec![program];
    command.extend(arguments.map(str::to_owned));
    command
}
