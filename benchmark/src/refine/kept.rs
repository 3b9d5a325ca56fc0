//! Scenes that guard the gate of a scene: those whose energies must settle, and those of which no bar may be claimed.

use super::judge::SceneBars;
use super::work::{Runs, Work};
use crate::interrupt::Interrupt;
use proctor_files::json;
use proctor_scene::simulation::Options;
use proctor_verification::refine::Meshes;
use std::path::Path;

/// A scene, refined on three meshes.
#[derive(Clone, Copy, Debug)]
pub struct KeptScene {
    /// Its name.
    pub name: &'static str,
    text: &'static str,
    finer: usize,
    /// True where its energies must settle; else they must not.
    pub settles: bool,
}

macro_rules! scene {
    ($name:literal, $finer:literal, $settles:literal) => {
        KeptScene {
            name: $name,
            text: include_str!(concat!("../../../fixtures/refine/", $name, ".json")),
            finer: $finer,
            settles: $settles,
        }
    };
}

/// The scenes.
pub const SCENES: [KeptScene; 5] = [
    scene!("beam_musl", 1, false),
    scene!("discs", 1, false),
    scene!("beam_apic", 1, true),
    scene!("sand", 0, true),
    scene!("swing", 1, true),
];

/// Scenes that the main job refines.
pub const OF_MAIN_JOB: [KeptScene; 2] = [SCENES[2], SCENES[3]];

impl KeptScene {
    /// Runs it on its meshes; `None` where Ctrl-C ended the work.
    ///
    /// # Errors
    /// The reason why it cannot be read, run or judged.
    pub fn refined(
        &self,
        options: &Options,
        interrupt: &Interrupt,
    ) -> Result<Option<(SceneBars, Runs)>, String> {
        let scene = json::from_json(self.text, self.name, Path::new(""));
        let scene = scene.map_err(|error| error.to_string())?;
        let meshes = Meshes {
            count: 3,
            ratio: 2.0,
            finer: self.finer,
        };
        let told = |problems: Vec<proctor_scene::Problem>| {
            let lines: Vec<String> = problems.iter().map(ToString::to_string).collect();
            lines.join("; ")
        };
        let scenes = meshes.scenes(&scene).map_err(told)?;
        let work = Work {
            name: self.name,
            scenes: &scenes,
            earlier: &[],
            offsets: 0,
            snapshot_at: None,
            options,
            tells: false,
        };
        let runs = work.run(interrupt).map_err(|error| error.to_string())?;
        if interrupt.raised() {
            return Ok(None);
        }
        let refined = SceneBars::new(self.name, &runs.meshes, &[], &[], None)?;
        Ok(Some((refined, runs)))
    }
}
