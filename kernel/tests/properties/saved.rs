//! A state that is saved and taken up again goes on with the same bits, and one of another scene is refused.

use crate::common::{options, run, simulation};
use crate::properties::touching::{Touching, touching};
use proctor_scene::simulation::{Options, RestoreError, SavedState, Simulation};

/// Steps after the state was taken up, enough for a sort.
const STEPS: usize = 10;

/// A simulation in which contact acted.
fn after(touching: &Touching) -> Simulation {
    let mut simulation = simulation(&touching.scene);
    touching.run(&mut simulation);
    simulation
}

#[test]
fn a_state_taken_up_goes_on_with_the_same_bits() {
    for touching in touching() {
        let mut whole = after(&touching);
        let saved = whole.save();
        let threads = Options {
            threads: Some(2),
            least_share: Some(1),
            ..options()
        };
        let mut resumed = Simulation::new(&touching.scene, &threads).expect("the scene is sound");
        resumed.restore(saved.clone()).expect("the same scene");
        assert_eq!(resumed.save(), saved, "{}", touching.name);
        for surface in 0..touching.scene.surfaces.len() {
            let force = |s: &Simulation| s.surface_force(surface);
            assert_eq!(force(&resumed), force(&whole), "{}", touching.name);
        }
        run(&mut whole, STEPS);
        run(&mut resumed, STEPS);
        assert_eq!(resumed.save(), whole.save(), "{}", touching.name);
        assert_eq!(resumed.energy(), whole.energy(), "{}", touching.name);
        assert_eq!(
            resumed.state_hash(),
            whole.state_hash(),
            "{}",
            touching.name
        );
    }
}

/// Damage to a saved state: its name and the change; `false` where the scene has no such thing.
type Spoil = (&'static str, fn(&mut SavedState) -> bool);

const SPOILS: [Spoil; 13] = [
    ("bodies", |s| s.state.sets.pop().is_some()),
    ("columns of body 0", |s| {
        s.state.sets[0].columns.pop().is_some()
    }),
    ("values in a column of body 0", |s| {
        s.state.sets[0].columns[3].pop().is_some()
    }),
    ("layers of body 0", |s| {
        s.state.sets[0].layers.pop().is_some()
    }),
    ("interactions", |s| s.interactions.pop().is_some()),
    ("lists of an interaction", |s| {
        s.interactions.iter_mut().any(|lists| lists.pop().is_some())
    }),
    ("near pairs", |s| shorten(s, "near pairs")),
    ("forces of pairs", |s| shorten(s, "forces of pairs")),
    ("vertices of boundary", |s| shorten(s, "vertices")),
    ("displacements of boundary", |s| shorten(s, "displacements")),
    ("slips of contact", |s| shorten(s, "slips")),
    ("last impulses of surfaces", |s| shorten(s, "last impulses")),
    ("impulses of surfaces", |s| shorten(s, "impulses")),
];

/// Takes a number from the first list of an interaction whose name begins so.
fn shorten(saved: &mut SavedState, name: &str) -> bool {
    let mut lists = saved.interactions.iter_mut().flatten();
    let list = lists.find(|(found, _)| found.starts_with(name));
    list.is_some_and(|(_, values)| values.pop().is_some())
}

#[test]
fn a_state_of_another_scene_is_refused_and_changes_nothing() {
    let mut met = [false; SPOILS.len()];
    for touching in touching() {
        let saved = after(&touching).save();
        let mut simulation = simulation(&touching.scene);
        let before = simulation.save();
        for (k, (name, spoil)) in SPOILS.iter().enumerate() {
            let mut spoilt = saved.clone();
            if !spoil(&mut spoilt) {
                continue;
            }
            met[k] = true;
            match simulation.restore(spoilt) {
                Err(RestoreError::Length {
                    what,
                    expected,
                    found,
                }) => {
                    assert!(what.starts_with(name), "{}: {what}", touching.name);
                    assert_ne!(expected, found);
                }
                other => panic!("{}: {name}: {other:?}", touching.name),
            }
        }
        for place in [-1.0, 1.0e3, f64::NAN] {
            let mut spoilt = saved.clone();
            spoilt.state.sets[0].columns[2][0] = place;
            let error = simulation.restore(spoilt).expect_err("outside the mesh");
            let is_place = matches!(error, RestoreError::Places { body: 0, .. });
            assert!(is_place, "{error}");
        }
        assert_eq!(simulation.save(), before, "{}", touching.name);
    }
    assert_eq!(met, [true; SPOILS.len()]);
}
