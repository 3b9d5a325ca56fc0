//! Configurations: the manual's as they are, ours, and everything that is wrong at once.

use proctor_benchmark::bench::config::{CommandLineChoices, Config, TimeLabel};
use proctor_benchmark::bench::slots;
use proctor_scene::SceneError;
use std::path::{Path, PathBuf};

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../fixtures/bench")
        .join(name)
}

fn read(name: &str) -> Config {
    Config::read(&fixture(name), &CommandLineChoices::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn parse(text: &str) -> Result<Config, SceneError> {
    Config::from_json(
        text,
        "c.json",
        Path::new(""),
        &CommandLineChoices::default(),
    )
}

/// Messages on a configuration that is wrong, without the list of what is accepted.
fn faults(text: &str) -> Vec<String> {
    let error = parse(text).expect_err("not a sound configuration");
    error
        .problems
        .iter()
        .map(|p| {
            let at = p.location.as_ref().expect("a place");
            let hint = p.hint.as_deref().unwrap_or("");
            format!("{}:{} {} {} {hint}", at.line, at.column, p.path, p.found)
                .trim()
                .to_owned()
        })
        .collect()
}

#[test]
fn the_manuals_multi_benchmark_means_what_it_says() {
    let config = read("start-multi-benchmark-configuration.json");
    assert_eq!(config.particles, [15_000, 25_000, 50_000]);
    assert_eq!(config.threads, [1, 5, 10]);
    let names: Vec<&str> = config.executables.iter().map(|e| e.name.as_str()).collect();
    assert_eq!(names, ["win_benchmark_executable", "win_github_id"]);
    // "3x3x2 = 18 tests" of the manual, and nine of this program beside them.
    let runs = proctor_benchmark::bench::children::runs(&config).expect("sound scenes");
    assert_eq!(runs.len(), 18 + 9);
}

#[test]
fn the_manuals_tests_are_stages_with_its_parameters() {
    let config = read("benchmark-configuration.json");
    assert_eq!(
        (config.particles.as_slice(), config.threads.as_slice()),
        (&[15_000][..], &[1][..])
    );
    assert!(config.scenes.is_empty());
    let found: Vec<(&str, &str)> = config
        .tests
        .iter()
        .map(|test| (test.name, test.part.name()))
        .collect();
    assert_eq!(
        found,
        [
            ("NodalMass", "p2g"),
            ("NodalMomentum", "p2g"),
            ("NodalInternalForce", "p2g"),
            ("NodalExternalForce", "p2g"),
            ("ParticleStrainIncrement", "g2p"),
            ("ParticleVorticityIncrement", "g2p"),
            ("ContributionNodes", "weights"),
            ("ParticleDensity", "g2p"),
            ("ParticleStress", "g2p"),
        ]
    );
    // The value that the file does not give is noted, those that it gives are not.
    let noted = |key: &str| config.defaults.iter().any(|line| line.starts_with(key));
    assert!(
        noted("global.particleMass: ")
            && noted("interpolation.ParticleVorticityIncrement_nParticles.omega: ")
    );
    assert!(!noted("global.randomSeed") && !noted("update.ParticleStress_nParticles.E"));
    let slots = slots(&config).expect("sound scenes");
    assert_eq!(slots.len(), 9);
    let momentum = &config.tests[1].make(20);
    let start = (momentum.initial)(&[0.5; 3]);
    assert_eq!(start.velocity, [1.0, 2.0, 3.0]);
    // The same seed places the same particles; they lie in the first cell.
    let again = &config.tests[0].make(20);
    assert_eq!(
        format!("{:?}", momentum.scene.bodies),
        format!("{:?}", again.scene.bodies)
    );
}

#[test]
fn a_flag_of_the_manual_switches_tests_off() {
    let config =
        parse(r#"{"global": {"interpolationTest": false, "numParticles": 10}}"#).expect("sound");
    let names: Vec<&str> = config.tests.iter().map(|test| test.name).collect();
    assert_eq!(
        names,
        ["ContributionNodes", "ParticleDensity", "ParticleStress"]
    );
}

#[test]
fn lists_are_multiplied() {
    let config = read("methods.json");
    assert_eq!(config.methods.len(), 4 * 2);
    // Two built-in scenes with two numbers of particles and one file, each with whole steps and three stages.
    assert_eq!(
        slots(&config).expect("sound scenes").len(),
        (2 * 2 + 1) * 8 * 4 * 2
    );
    let mut names: Vec<String> = slots(&config)
        .expect("sound scenes")
        .iter()
        .map(|slot| format!("{}/{}", slot.work.name, slot.work.threads))
        .collect();
    let all = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), all, "names tell slots apart");
}

#[test]
fn the_command_line_overrides_the_file() {
    let asked = CommandLineChoices {
        threads: vec![3],
        repetitions: Some(7),
        quick: true,
    };
    let config = Config::read(&fixture("methods.json"), &asked).expect("sound");
    assert_eq!(
        (config.threads.as_slice(), config.repetitions),
        (&[3][..], 7)
    );
    // Quick is about what the file does not say.
    assert_eq!(config.particles, [8000, 64_000]);
    let usual = parse("{}").expect("sound").particle_steps;
    assert!(config.particle_steps < usual);
}

#[test]
fn everything_that_is_wrong_is_said_at_once_with_its_place() {
    let text = r#"{
  "scenes": ["moving-3d", "no/such.json", "movin-2d"],
  "shape_function": "uGIMPP",
  "threads": [1, 0],
  "repetitions": 2,
  "particles": 0,
  "parameters": {"particles": 3},
  "executables": {"other": {"command": "solver input"}},
  "stages": ["p2g", "g2pp"]
}"#;
    assert_eq!(
        faults(text),
        [
            r#"2:27 scenes[1] "no/such.json", which is no file"#,
            r#"2:43 scenes[2] "movin-2d" did you mean `moving-2d`?"#,
            r#"3:21 shape_function "uGIMPP" did you mean `uGIMP`?"#,
            "4:18 threads[1] 0",
            "5:18 repetitions 2",
            "6:16 particles 0",
            "7:31 parameters.particles `particles` and `parameters.particles` together",
            "8:40 executables.other.command a command without {scene}",
            r#"9:21 stages[1] "g2pp" did you mean `g2p`?"#,
        ]
    );
}

#[test]
fn no_executable_has_the_name_of_this_program() {
    assert_eq!(
        faults(r#"{"executables": {"proctor": "other/proctor"}}"#),
        ["1:29 executables.proctor the name `proctor`"]
    );
}

#[test]
fn unknown_keys_and_wrong_types_are_named_with_their_place() {
    assert_eq!(
        faults(r#"{"global": {"numPartciles": 3}}"#),
        ["1:13 global.numPartciles the unknown key `numPartciles` did you mean `numParticles`?"]
    );
    assert_eq!(
        faults("{\n \"threads\": \"two\"}"),
        ["2:13 threads \"two\""]
    );
    assert_eq!(
        faults(r#"{"particles": [10, 2.5]}"#),
        ["1:20 particles[1] 2.5"]
    );
    assert_eq!(
        faults(r#"{"executables": {"a": 3}}"#),
        ["1:23 executables.a 3"]
    );
    assert_eq!(
        faults(r#"{"update": {"ParticleStress_nParticles": {"nu": 0.5}}}"#),
        ["1:49 update.ParticleStress_nParticles.nu 0.5"]
    );
}

#[test]
fn more_threads_than_the_machine_has_are_warned_of() {
    let config = parse(r#"{"threads": 1024}"#).expect("accepted");
    assert!(
        config.warnings.iter().any(|w| w.contains("1024 threads")),
        "{:?}",
        config.warnings
    );
}

#[test]
fn a_scene_that_a_method_does_not_suit_is_bad_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut scene: serde_json::Value = serde_json::from_str(include_str!(
        "../../../fixtures/scenes/speed/block_64k.json"
    ))
    .expect("JSON");
    scene["shape_function"] = "cpGIMP".into();
    scene["domain_update"] = "stretch".into();
    std::fs::write(folder.path().join("s.json"), scene.to_string()).expect("written");
    let text = r#"{"scenes": "s.json", "shape_function": ["cpGIMP", "linear"]}"#;
    let error = Config::from_json(
        text,
        "c.json",
        folder.path(),
        &CommandLineChoices::default(),
    );
    let error = error.expect_err("a domain update needs cpGIMP");
    assert!(error.to_string().contains("domain_update"), "{error}");
}

#[test]
fn the_configuration_of_the_book_is_accepted() {
    let chapter = std::fs::read_to_string("../docs/src/howto/other-solvers.md").expect("a chapter");
    let from = chapter
        .find("    {\n      \"executables\"")
        .expect("a configuration");
    let to = chapter[from..].find("\n\n").expect("its end");
    let text = &chapter[from..from + to];
    let config = parse(text).unwrap_or_else(|error| panic!("{error}: {text}"));
    let labels: Vec<(&str, TimeLabel)> = config
        .executables
        .iter()
        .map(|e| (e.name.as_str(), e.time_label))
        .collect();
    assert_eq!(
        labels,
        [
            ("peer", TimeLabel::OneStepLate),
            ("before", TimeLabel::Frame)
        ]
    );
    // Every label and every case that can be handed over is named there, and no other case as one that can.
    for (word, label) in TimeLabel::ALL {
        assert!(chapter.contains(&format!("`{word}`")), "{word}");
        assert_eq!(label.word(), word);
    }
    let page = chapter
        .split("It can be done for")
        .nth(1)
        .expect("the cases");
    let page = page.split("Every other case").next().expect("their end");
    for study in proctor_verification::study::all() {
        let name = format!("*{}*", study.name());
        let rung = &study.path(proctor_verification::case::Size::Quick)[0];
        assert_eq!(page.contains(&name), study.guest(rung).is_ok(), "{name}");
    }
}
