//! Checks of a configuration: from raw keys, collecting every problem on the way.

use super::raw::{OneOrMany, RawConfig};
use super::scene::{Method, SceneChoice};
use super::{CommandLineChoices, Config, manual};
use crate::bench::scenes;
use proctor_files::json::{listed, nearest, words_of};
use proctor_kernel::memory::{Memory, words};
use proctor_kernel::team::Team;
use proctor_scene::Problem;
use proctor_scene::simulation::Part;
use std::path::Path;

/// Default number of particles, and with `--quick`.
const PARTICLES: [usize; 2] = [64_000, 8_000];
/// Default particles times steps of a sample, and with `--quick`: about 0.3 and 0.03 s on one thread.
const PARTICLE_STEPS: [u64; 2] = [2_500_000, 250_000];
/// Fewest repetitions: a spread needs three.
const FEWEST_REPETITIONS: usize = 3;
/// Most ranks of one process: each has threads of its own.
const MOST_RANKS: usize = 256;
/// Most repetitions, and steps before the clock starts.
const MOST_REPETITIONS: usize = 1_000_000;
/// Bytes that a particle of a built-in scene needs with its share of the mesh, on the low side: what does not fit by this
/// does not fit at all.
const PARTICLE: f64 = 300.0;
/// The keys of scene files whose words are a method.
const METHOD: [&str; 3] = ["shape_function", "stress_scheme_update", "transfer"];
/// Steps before the clock starts: the first sorts and fills the caches.
const WARM_UP: usize = 3;

/// Collects problems, defaults and warnings.
pub(super) struct Check<'a> {
    pub(super) folder: &'a Path,
    pub(super) problems: Vec<Problem>,
    defaults: Vec<String>,
    warnings: Vec<String>,
}

impl<'a> Check<'a> {
    pub(super) fn new(folder: &'a Path) -> Self {
        Self {
            folder,
            problems: vec![],
            defaults: vec![],
            warnings: vec![],
        }
    }

    /// The whole configuration; to be used only if there is no problem.
    pub(super) fn config(&mut self, raw: &RawConfig, asked: &CommandLineChoices) -> Config {
        let global = raw.global.as_ref();
        let parameters = raw.parameters.as_ref();
        let quick = usize::from(asked.quick);
        let by_manual = raw.global.is_some() || raw.interpolation.is_some() || raw.update.is_some();
        let usual = if by_manual {
            manual::PARTICLES
        } else {
            PARTICLES[quick]
        };
        let particles = self.counts(
            "particles",
            [
                ("particles", raw.particles.as_ref()),
                (
                    "parameters.particles",
                    parameters.and_then(|p| p.particles.as_ref()),
                ),
            ],
            ("global.numParticles", global.and_then(|g| g.num_particles)),
            &[usual],
        );
        let machine = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let mut usual = vec![1, machine];
        usual.dedup();
        let mut threads = self.counts(
            "threads",
            [
                ("threads", raw.threads.as_ref()),
                (
                    "parameters.threads",
                    parameters.and_then(|p| p.threads.as_ref()),
                ),
            ],
            ("global.numThreads", global.and_then(|g| g.num_threads)),
            &usual,
        );
        if !asked.threads.is_empty() {
            threads.clone_from(&asked.threads);
        }
        let ranks = raw.ranks.as_ref().map_or_else(
            || vec![1],
            |list| {
                let lists = [("ranks", Some(list)), ("ranks", None)];
                self.counts("ranks", lists, ("ranks", None), &[1])
            },
        );
        for many in ranks.iter().filter(|&&ranks| ranks > MOST_RANKS) {
            let accepted = format!("at most {MOST_RANKS} ranks in one process");
            self.add("ranks", many.to_string(), accepted);
        }
        let memory = Memory::of_machine();
        for count in &particles {
            let needed = *count as f64 * PARTICLE;
            if memory.require("particles", needed).is_err() {
                self.add(
                    "particles",
                    format!("{count}, which would need {} of memory", words(needed)),
                    format!("at most the {} that are free", words(memory.bytes() as f64)),
                );
            }
        }
        for count in threads.iter().filter(|&&count| count > Team::most()) {
            self.add(
                "threads",
                count.to_string(),
                format!("at most {} threads", Team::most()),
            );
        }
        for more in threads.iter().filter(|&&threads| threads > machine) {
            self.warnings.push(format!(
                "{more} threads on a machine that runs {machine} at once"
            ));
        }
        let tests = manual::tests(self, raw, by_manual);
        let scenes = self.scenes(raw, by_manual);
        if raw.particles.is_some() && !scenes.is_empty() && !scenes.iter().any(SceneChoice::scales)
        {
            self.warnings.push(
                "`particles` acts on built-in scenes; those of the files have their own".into(),
            );
        }
        Config {
            particles,
            threads,
            ranks,
            methods: self.methods(raw, &scenes),
            repetitions: asked
                .repetitions
                .unwrap_or_else(|| self.repetitions(raw.repetitions)),
            warm_up: {
                let given = self.countable("warm_up", raw.warm_up);
                self.value("warm_up", given, WARM_UP)
            },
            particle_steps: self.positive(
                "particle_steps",
                raw.particle_steps,
                PARTICLE_STEPS[quick],
            ),
            stages: self.stages(raw, by_manual),
            stages_everywhere: raw.stages.is_some(),
            tests,
            executables: self.executables(raw),
            scenes,
            defaults: std::mem::take(&mut self.defaults),
            warnings: std::mem::take(&mut self.warnings),
        }
    }

    pub(super) fn add(
        &mut self,
        path: impl Into<String>,
        found: impl Into<String>,
        accepted: impl Into<String>,
    ) {
        self.problems.push(Problem::new(path, found, accepted));
    }

    /// A value, or its default, which is noted.
    pub(super) fn value<T: Clone + std::fmt::Debug>(
        &mut self,
        path: &str,
        given: Option<T>,
        usual: T,
    ) -> T {
        given.unwrap_or_else(|| {
            self.defaults.push(format!("{path}: not given, {usual:?}"));
            usual
        })
    }

    fn positive(&mut self, path: &str, given: Option<u64>, usual: u64) -> u64 {
        if given == Some(0) {
            self.add(path, "0", "a whole number, 1 or more");
        }
        self.value(path, given, usual)
    }

    /// A count that is only ever too large by mistake.
    fn countable(&mut self, path: &str, given: Option<usize>) -> Option<usize> {
        if let Some(many) = given.filter(|&given| given > MOST_REPETITIONS) {
            self.add(
                path,
                many.to_string(),
                format!("a whole number, at most {MOST_REPETITIONS}"),
            );
        }
        given.map(|given| given.min(MOST_REPETITIONS))
    }

    fn repetitions(&mut self, given: Option<usize>) -> usize {
        let given = self.countable("repetitions", given);
        if let Some(few) = given.filter(|&given| given < FEWEST_REPETITIONS) {
            self.add(
                "repetitions",
                few.to_string(),
                format!("a whole number, {FEWEST_REPETITIONS} or more, so that there is a spread"),
            );
        }
        self.value("repetitions", given, FEWEST_REPETITIONS)
    }

    /// A list of counts from one of two keys, else the single count of the manual's `global`, else the default.
    fn counts(
        &mut self,
        name: &str,
        lists: [(&str, Option<&OneOrMany<usize>>); 2],
        global: (&str, Option<usize>),
        usual: &[usize],
    ) -> Vec<usize> {
        if let [(one, Some(_)), (other, Some(_))] = lists {
            self.add(
                other,
                format!("`{one}` and `{other}` together"),
                "one of them",
            );
        }
        if let Some((path, list)) = lists
            .iter()
            .find_map(|(path, list)| list.map(|list| (path, list)))
        {
            if list.0.is_empty() {
                self.add(
                    *path,
                    "an empty list",
                    "at least one whole number, 1 or more",
                );
            }
            for (i, _) in list.0.iter().enumerate().filter(|(_, count)| **count == 0) {
                self.add(
                    entry(path, i, list.0.len()),
                    "0",
                    "a whole number, 1 or more",
                );
            }
            return list.0.clone();
        }
        match global {
            (path, Some(0)) => {
                self.add(path, "0", "a whole number, 1 or more");
                vec![0]
            }
            (_, Some(count)) => vec![count],
            (_, None) => self.value(name, None, usual.to_vec()),
        }
    }

    /// The entries of a list, each of which must be a word that this key of scene files accepts.
    fn words(&mut self, key: &str, list: Option<&OneOrMany<String>>) -> Vec<Option<String>> {
        let Some(list) = list.filter(|list| !list.0.is_empty()) else {
            self.defaults
                .push(format!("{key}: not given, that of each scene"));
            return vec![None];
        };
        let known = words_of(key);
        for (i, word) in list.0.iter().enumerate() {
            if !known.iter().any(|known| known.eq_ignore_ascii_case(word)) {
                self.unknown(&entry(key, i, list.0.len()), word, &known);
            }
        }
        list.0.iter().cloned().map(Some).collect()
    }

    pub(super) fn unknown(&mut self, path: &str, word: &str, known: &[&str]) {
        let problem = Problem::new(path, format!("\"{word}\""), listed(known.iter().copied()));
        let near = nearest(word, known.iter().copied());
        self.problems.push(match near {
            Some(near) => problem.hint(format!("did you mean `{near}`?")),
            None => problem,
        });
    }

    /// Every combination of weighting function, scheme and transfer.
    fn methods(&mut self, raw: &RawConfig, scenes: &[SceneChoice]) -> Vec<Method> {
        let weightings = self.words("shape_function", raw.shape_function.as_ref());
        let schemes = self.words("stress_scheme_update", raw.stress_scheme_update.as_ref());
        let transfers = self.words("transfer", raw.transfer.as_ref());
        let mut methods = self.named_methods(raw);
        if methods.is_empty() {
            for weighting in &weightings {
                for scheme in &schemes {
                    for transfer in &transfers {
                        methods.push(Method {
                            weighting: weighting.clone(),
                            scheme: scheme.clone(),
                            transfer: transfer.clone(),
                        });
                    }
                }
            }
        }
        // A combination that a scene refuses (a domain update without cpGIMP, say) is bad input, not a failed run.
        if self.problems.is_empty() {
            for scene in scenes {
                for method in &methods {
                    if let Err(error) = scene.scene(1000, method) {
                        self.problems.extend(error.problems);
                    }
                }
            }
        }
        methods
    }

    /// The methods that are listed as three words each.
    fn named_methods(&mut self, raw: &RawConfig) -> Vec<Method> {
        let Some(list) = &raw.methods else {
            return vec![];
        };
        let lists = [
            &raw.shape_function,
            &raw.stress_scheme_update,
            &raw.transfer,
        ];
        if lists.iter().any(|list| list.is_some()) {
            let accepted = "either `methods`, or lists of each of the three";
            self.add("methods", "`methods` beside one of its words", accepted);
        }
        let mut methods = vec![];
        for (i, text) in list.0.iter().enumerate() {
            let path = entry("methods", i, list.0.len());
            let words: Vec<&str> = text.split_whitespace().collect();
            let [weighting, scheme, transfer] = words[..] else {
                let accepted =
                    "weighting function, stress scheme and transfer, such as \"uGIMP MUSL APIC\"";
                self.add(path, format!("\"{text}\""), accepted);
                continue;
            };
            for (key, word) in METHOD.into_iter().zip([weighting, scheme, transfer]) {
                let known = words_of(key);
                if !known.iter().any(|known| known.eq_ignore_ascii_case(word)) {
                    self.unknown(&path, word, &known);
                }
            }
            methods.push(Method {
                weighting: Some(weighting.to_owned()),
                scheme: Some(scheme.to_owned()),
                transfer: Some(transfer.to_owned()),
            });
        }
        methods
    }

    fn scenes(&mut self, raw: &RawConfig, by_manual: bool) -> Vec<SceneChoice> {
        let usual: Vec<String> = if by_manual {
            vec![]
        } else if raw.executables.is_some() {
            vec!["moving-3d".into()]
        } else {
            scenes::USUAL.map(str::to_owned).to_vec()
        };
        let given = raw.scenes.as_ref().map(|list| list.0.clone());
        let names = self.value("scenes", given, usual);
        let mut scenes = vec![];
        for (i, name) in names.iter().enumerate() {
            let path = entry("scenes", i, names.len());
            if let Some((scene, axes)) = scenes::find(name) {
                scenes.push(SceneChoice::BuiltIn(scene, axes));
            } else if Path::new(name)
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("json"))
            {
                let file = self.folder.join(name);
                if !file.is_file() {
                    self.add(
                        path,
                        format!("\"{name}\", which is no file"),
                        "a scene file that exists",
                    );
                    continue;
                }
                match SceneChoice::read(&file) {
                    Ok(scene) => scenes.push(scene),
                    Err(error) => self.problems.extend(error.problems),
                }
            } else {
                let known: Vec<String> = scenes::names().collect();
                let known: Vec<&str> = known.iter().map(String::as_str).collect();
                let problem = Problem::new(
                    path,
                    format!("\"{name}\""),
                    format!(
                        "{}; or the path of a scene file that ends in .json",
                        listed(known.iter().copied())
                    ),
                );
                self.problems.push(match nearest(name, known) {
                    Some(near) => problem.hint(format!("did you mean `{near}`?")),
                    None => problem,
                });
            }
        }
        scenes
    }

    fn stages(&mut self, raw: &RawConfig, by_manual: bool) -> Vec<Part> {
        let usual: Vec<String> = if by_manual || raw.executables.is_some() || raw.scenes.is_some() {
            vec![]
        } else {
            Part::ALL
                .iter()
                .map(|part| part.name().to_owned())
                .collect()
        };
        let given = raw.stages.as_ref().map(|list| list.0.clone());
        let names = self.value("stages", given, usual);
        let known = Part::ALL.map(Part::name);
        let mut stages = vec![];
        for (i, name) in names.iter().enumerate() {
            match Part::ALL.into_iter().find(|part| part.name() == name) {
                Some(part) => stages.push(part),
                None => self.unknown(&entry("stages", i, names.len()), name, &known),
            }
        }
        stages
    }
}

/// Path of an entry of a list that may stand alone. Where it stands in the text is found by the key in either case.
fn entry(key: &str, i: usize, entries: usize) -> String {
    if entries == 1 {
        key.to_owned()
    } else {
        format!("{key}[{i}]")
    }
}
