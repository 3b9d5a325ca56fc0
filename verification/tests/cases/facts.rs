//! Facts of single cases that no gate says: pictures, lines for the record, scenes that are those of files, orders of runs.

use std::collections::BTreeSet;

use proctor_scene::Scene;
use proctor_verification::case::{Case, Gate, RungResult, Size};
use proctor_verification::cases::grains_apart::{Polyline, Room, beyond, inside, smallest};
use proctor_verification::cases::{
    COLLAPSE, COLLIDING_BLOCKS, FOOTING, INCLINED_BLOCK, ROLLING_DISK, SLOPE, SPHERE_ON_TERRAIN,
    STAGGERED_START, cell_outlines, grain_outlines,
};

use super::{failing, quick};

#[test]
fn what_is_not_judged_is_shown() {
    let lines = |case: &Case, words: &[&str]| {
        let lines = case.judge(Size::Quick, quick(case)).for_the_record;
        let of = |line: &&String| words.iter().all(|word| line.contains(word));
        lines.iter().filter(of).count()
    };
    assert_eq!(lines(&COLLAPSE, &["experiments"]), 4);
    assert_eq!(lines(&COLLAPSE, &["Ritter"]), 1);
    assert_eq!(lines(&SLOPE, &["proportional to h: not converged"]), 1);
    assert!(lines(&FOOTING, &["locked", "no limit"]) > 0);
    assert_eq!(SLOPE.judge(Size::Quick, quick(&SLOPE)).curves.len(), 2);
    for (rung, run) in quick(&SLOPE) {
        // Five frames, each with its planes.
        let planes: usize = run.drawings.iter().map(|d| d.lines.len()).sum();
        assert_eq!(planes, 5, "{}", rung.label);
    }
    let curves = INCLINED_BLOCK
        .judge(Size::Quick, quick(&INCLINED_BLOCK))
        .curves;
    assert_eq!(curves.len(), 1);
    let breaks = curves[0].points.iter().filter(|p| p.exact.is_nan());
    assert_eq!(breaks.count(), 5);
}

/// Taller columns come farther, as widths go, and none of sand is higher at the end than at the start.
#[test]
fn taller_columns_come_farther() {
    let solved = quick(&COLLAPSE);
    let far: Vec<f64> = (solved.iter())
        .filter(|(rung, _)| rung.variant != "water")
        .map(|(_, run)| run.value("run-out over width"))
        .collect();
    assert_eq!(far.len(), 4);
    assert!(far.windows(2).all(|pair| pair[0] < pair[1]), "{far:?}");
    for (rung, run) in solved {
        // Five frames, each with its planes.
        let planes: usize = run.drawings.iter().map(|d| d.lines.len()).sum();
        assert_eq!(planes, 5, "{}", rung.label);
    }
}

/// Lines around cells have the cells on their left: their areas add up to the number of cells, whatever holes there are.
#[test]
fn lines_around_cells_enclose_them() {
    let area = |line: &Vec<[i64; 2]>| {
        let next = line.iter().cycle().skip(1);
        let parts = line
            .iter()
            .zip(next)
            .map(|(a, b)| a[0] * b[1] - b[0] * a[1]);
        parts.sum::<i64>() / 2
    };
    let one: BTreeSet<[i64; 2]> = [[3, -2]].into();
    assert_eq!(cell_outlines(&one).len(), 1);
    assert_eq!(cell_outlines(&one)[0].len(), 4);
    let square = (0..3).flat_map(|i| (0..3).map(move |j| [i, j]));
    let ring: BTreeSet<[i64; 2]> = square.filter(|cell| *cell != [1, 1]).collect();
    let mut areas: Vec<i64> = cell_outlines(&ring).iter().map(area).collect();
    areas.sort_unstable();
    assert_eq!(areas, [-1, 9]);
    // Two cells that touch at a corner, and one apart.
    let touching: BTreeSet<[i64; 2]> = [[0, 0], [1, 1], [5, 0]].into();
    let areas: i64 = cell_outlines(&touching).iter().map(area).sum();
    assert_eq!(areas, 3);
    assert!(cell_outlines(&BTreeSet::new()).is_empty());
}

/// The finest rung of all bars has a gate on its impulse. Against an exact one that is off by twice the gate, either way, it
/// fails, and no other gate notices.
#[test]
fn an_impulse_off_by_twice_its_gate_breaks_it() {
    let of_impulse = |gate: &&Gate| gate.name.ends_with(": impulse");
    let mut found = 0;
    for (rung, solved) in quick(&COLLIDING_BLOCKS) {
        // Gates of the rung, judged alone.
        let judged = |solved: RungResult| {
            let verdict = COLLIDING_BLOCKS.judge(Size::Quick, &[(rung.clone(), solved)]);
            let own = format!("{}: ", rung.label);
            let gates = verdict.gates.into_iter();
            gates
                .filter(|g| g.name.starts_with(&own))
                .collect::<Vec<_>>()
        };
        let given = judged(solved.clone());
        let Some(impulse) = given.iter().find(of_impulse) else {
            continue;
        };
        println!(
            "{}: {:.3e} of {:.3e}",
            impulse.name, impulse.value, impulse.bound
        );
        found += 1;
        for sign in [1.0, -1.0] {
            let mut wrong = solved.clone();
            let quantities = wrong.quantities.iter_mut();
            for q in quantities.filter(|q| q.name == "impulse") {
                let exact = q.exact.expect("an exact impulse") * (1.0 + sign * 2.0 * impulse.bound);
                q.exact = Some(exact);
                q.error = Some((q.value / exact - 1.0).abs());
            }
            for (gate, before) in judged(wrong).iter().zip(&given) {
                let ours = of_impulse(&gate);
                assert_eq!(gate.passed(), !ours, "{}: {}", gate.name, gate.value);
                assert!(ours || gate.value.to_bits() == before.value.to_bits());
            }
        }
    }
    // Three schemes, two more ratios of masses, one of lengths, one of impedances, and three dimensions.
    assert_eq!(found, 8);
}

/// A disk that sticks without creep is not the reference: the gate on its turn notices 3 %.
#[test]
fn a_disk_that_does_not_creep_breaks_the_gate_on_the_turn() {
    let mut solved = quick(&ROLLING_DISK).to_vec();
    let stick = solved.iter_mut().find(|(r, _)| r.variant == "stick");
    let (_, run) = stick.expect("a disk that sticks");
    let turn = run
        .quantities
        .iter_mut()
        .find(|q| q.name.starts_with("rotation"));
    let turn = turn.expect("its turn");
    let creeping = turn.exact.expect("known");
    turn.value = 1.0;
    turn.error = Some((turn.value / creeping - 1.0).abs());
    let failing = failing(&ROLLING_DISK.judge(Size::Quick, &solved));
    assert_eq!(failing.len(), 1, "{failing:?}");
    assert!(failing[0].starts_with("stick") && failing[0].contains("rotation"));
}

/// The two starts are different: at once the error falls with the first power of the step, staggered with the second.
#[test]
fn a_start_at_once_is_of_order_one() {
    let solved = quick(&STAGGERED_START);
    let verdict = STAGGERED_START.judge(Size::Quick, solved);
    let order = |variant: &str| {
        let name = format!("{variant}: observed order of L2(u)");
        let gate = verdict.gates.iter().find(|gate| gate.name == name);
        gate.expect("a gate").value
    };
    assert!(order("staggered") > 1.7, "{}", order("staggered"));
    let at_once = order("at once");
    assert!((0.85..1.15).contains(&at_once), "{at_once}");
}

/// The scene is that of the fixture but for its end and what it writes.
#[test]
fn the_terrain_is_that_of_the_file() {
    let path = "../fixtures/scenes/sphere_on_terrain.json";
    let file = proctor_files::json::read(std::path::Path::new(path)).expect("it is sound");
    let case = SPHERE_ON_TERRAIN;
    let own = case.scene_of(&case.rungs(Size::Quick)[0]).expect("a scene");
    let physics = |s: &Scene| {
        (
            (s.time, s.time_step, s.gravity, s.mesh.clone()),
            (s.weighting, s.scheme, s.transfer, s.damping),
            s.materials[0].law.clone(),
            s.materials[0].density,
            s.bodies
                .iter()
                .map(|b| (b.shape.clone(), b.particles_per_cell, b.velocity))
                .collect::<Vec<_>>(),
            s.surfaces
                .iter()
                .map(|t| (t.surface.clone(), t.friction, t.distance_threshold))
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(
        format!("{:?}", physics(&own)),
        format!("{:?}", physics(&file))
    );
}

/// The printed scene is that of the manual's file.
#[test]
fn the_printed_incline_is_that_of_the_file() {
    let path = "../fixtures/scenes/manual/inclined_block.json";
    let file = proctor_files::json::read(std::path::Path::new(path)).expect("it is sound");
    let case = INCLINED_BLOCK;
    let rungs = case.rungs(Size::Full);
    let rung = rungs.iter().find(|r| r.label == "printed h=1 mu=0.5");
    let own = case
        .scene_of(rung.expect("it is among the rungs"))
        .expect("a scene");
    let physics = |s: &Scene| {
        (
            (s.time, s.time_step, s.gravity, s.mesh.clone()),
            (s.weighting, s.scheme, s.transfer, s.contact_distance),
            s.materials[0].law.clone(),
            s.bodies
                .iter()
                .map(|b| (b.shape.clone(), b.particles_per_cell, b.velocity))
                .collect::<Vec<_>>(),
            s.contacts
                .iter()
                .map(|c| (c.friction, c.master, c.slave, c.normal))
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(
        format!("{:?}", physics(&own)),
        format!("{:?}", physics(&file))
    );
}

/// Two squares of which one comes nearer, and a room.
#[test]
fn what_lies_in_another_grain_or_beyond_a_side_is_counted() {
    let square = |x: f64, y: f64| {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        corners.map(|[a, b]| [x + a, y + b, 0.0]).to_vec()
    };
    let room = Room {
        x: [0.0, 10.0],
        y: [0.0, 10.0],
    };
    let at = |x, y| vec![square(2.0, 2.0), square(x, y)];
    let all = |grains: &[Polyline]| {
        (
            inside(grains),
            beyond(grains, &room),
            smallest(grains, &room, 0.5),
        )
    };
    let near = |(a, b, c): (usize, usize, f64), (d, e, f): (usize, usize, f64)| {
        assert_eq!((a, b), (d, e));
        assert!((c - f).abs() < 1e-12, "{c} {f}");
    };
    near(all(&at(5.0, 5.0)), (0, 0, 0.5));
    near(all(&at(3.03, 3.04)), (0, 0, 0.05));
    near(all(&at(2.9, 2.8)), (2, 0, -0.1));
    // No deeper than a ten thousandth of a side.
    near(all(&at(2.9999, 2.5)), (2, 0, -1e-4));
    for (x, y) in [(-0.01, 5.0), (9.01, 5.0), (5.0, -0.01), (5.0, 9.01)] {
        near(all(&at(x, y)), (0, 2, -0.01));
    }
    near(all(&at(8.9, 5.0)), (0, 0, 0.1));
}

#[test]
fn some_grains_are_concave_and_all_are_apart() {
    let outlines = grain_outlines(4);
    assert_eq!(outlines.len(), 16);
    let concave = outlines.iter().filter(|outline| {
        let n = outline.len();
        (0..n).any(|k| {
            let [a, b, c] = [outline[k], outline[(k + 1) % n], outline[(k + 2) % n]];
            (b[0] - a[0]) * (c[1] - b[1]) < (b[1] - a[1]) * (c[0] - b[0])
        })
    });
    assert!((4..16).contains(&concave.count()));
    for (k, outline) in outlines.iter().enumerate() {
        let place = [(k % 4) as f64 * 2.5, (k / 4) as f64 * 3.25];
        for point in outline {
            assert!((place[0] + 0.09..place[0] + 2.41).contains(&point[0]));
            assert!((place[1] + 0.22..place[1] + 3.03).contains(&point[1]));
        }
    }
}
