//! `proctor refine --methods`: ladders of several methods side by side.

use super::{Refine, on_meshes, stages_on_meshes};
use crate::exit::{Failure, Outcome};
use crate::interrupt::Interrupt;
use crate::record::{BY_SCENE, Record};
use crate::refine::judge::SceneBars;
use crate::refine::methods::{self, MethodRun};
use crate::refine::work::Work;
use crate::say::say;
use crate::show::paint::Paint;
use crate::show::refine_methods as show;
use proctor_files::json::Stage;
use proctor_scene::simulation::Options;
use proctor_verification::refine::Meshes;
use proctor_verification::settings::Method;
use std::io::Write;

/// The word for the usual methods.
const ALL: &str = "all";
/// Most methods of one comparison.
const MOST: usize = 4;

/// The methods that a user names.
///
/// # Errors
/// An unknown one, or too few or too many.
pub fn chosen(names: &[String], scene: &proctor_scene::Scene) -> Result<Vec<Method>, Failure> {
    if names == [ALL] {
        return Ok(methods::usual(scene));
    }
    if !(2..=MOST).contains(&names.len()) {
        return Err(Failure::BadInput(format!(
            "--methods: found {} methods; accepted: two to {MOST} of them, or `{ALL}`",
            names.len()
        )));
    }
    let of = |name: &String| {
        methods::named(name).ok_or_else(|| {
            let known: Vec<String> = methods::every().into_iter().map(methods::word).collect();
            Failure::BadInput(format!(
                "--methods: found {name:?}; accepted: `{ALL}`, or of {}",
                known.join(", ")
            ))
        })
    };
    names.iter().map(of).collect()
}

impl Refine {
    /// Refines the scene with each method; fails where their bars do not overlap.
    pub(super) fn side_by_side(
        &self,
        stage: &Stage,
        before: &[Stage],
        meshes: &Meshes,
        options: &Options,
        out: &mut dyn Write,
    ) -> Result<Outcome, Failure> {
        let Stage { scene, places, .. } = stage;
        let chosen = chosen(&self.methods, scene)?;
        let mut record = Record::new(options);
        record.set_incomplete(true);
        self.keep(&record)?;
        let interrupt = Interrupt::listen()?;
        let mut all: Vec<MethodRun> = vec![];
        for method in chosen {
            if interrupt.raised() {
                break;
            }
            let with = methods::with(scene, method);
            if let Err(error) = with.check() {
                say!("note: {} is left out: {error}", methods::word(method));
                continue;
            }
            let scenes = on_meshes(&with, meshes, places)?;
            let earlier = stages_on_meshes(before, meshes, |scene| methods::with(scene, method))?;
            self.has_columns(&scenes[0], options, places)?;
            let name = format!("{}/{}", scene.name, methods::word(method));
            let work = Work {
                name: &name,
                scenes: &scenes,
                earlier: &earlier,
                offsets: self.offsets.unwrap_or(0).into(),
                snapshot_at: None,
                options,
                tells: true,
            };
            let runs = work
                .run(&interrupt)
                .map_err(|error| Failure::BadInput(places.of_setup(&error)))?;
            let refined =
                SceneBars::new(&name, &runs.meshes, &runs.moved, &self.quantity, self.until);
            let threads = options.threads.unwrap_or(BY_SCENE);
            match &refined {
                Ok(refined) => record.push_refined(refined, &runs, threads),
                Err(_) => crate::refine::rows::push(&mut record, &name, &runs, None, threads),
            }
            self.keep(&record)?;
            all.push(MethodRun {
                method,
                runs,
                refined,
            });
        }
        record.set_incomplete(interrupt.raised());
        self.keep(&record)?;
        let apart = methods::apart(&all);
        show::table(&scene.name, &all, &apart, Paint::of_standard_output(), out)?;
        Ok(if interrupt.raised() {
            interrupt.outcome()
        } else if apart.is_empty() && all.iter().any(|run| run.refined.is_ok()) {
            Outcome::Fine
        } else {
            Outcome::Failed
        })
    }
}
