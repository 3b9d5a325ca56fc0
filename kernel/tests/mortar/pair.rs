//! Forces of a pair: balance, patch test, friction, and what does not depend on the frame.

use crate::common::cases;
use crate::mortar::space::support::{GC, KAPPA, law};
use crate::mortar::support::{at_rest, ceiling, floor, moved, point};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::Boundary;
use proctor_contact::geometry::mortar::law::NormalLaw;
use proctor_contact::geometry::mortar::outline::outline;
use proctor_contact::geometry::mortar::pair::{
    PairForces, PairLaw, PairSurfaces, Slip, StepAhead, contact_forces, resultant,
};
use proctor_contact::geometry::mortar::points::Detection;
use proctor_scene::Shape;
use proptest::prelude::*;
use std::ops::Range;

fn forces(
    slave: &Boundary,
    master: &Boundary,
    law: &PairLaw,
    slip: &mut Slip<1>,
) -> PairForces<2, 1> {
    contact_forces(
        PairSurfaces {
            slave,
            master,
            slave_moved: &at_rest(slave),
            master_moved: &at_rest(master),
            slave_velocity: &at_rest(slave),
            master_velocity: &at_rest(master),
            ahead: None,
        },
        law,
        slip,
    )
}

fn disc(center: [f64; 2], radius: f64, segment: f64) -> Boundary {
    let shape = Shape::Sphere {
        center: [center[0], center[1], 0.0],
        radius,
    };
    Boundary::new(&outline(&shape, segment).expect("positive")).expect("sound")
}

#[test]
fn parallel_surfaces_have_their_distance_as_gap() {
    for gap in [0.09, 0.05, 0.001, -0.02] {
        for detection in [Detection::Mortar, Detection::NodeToSegment] {
            let slave = ceiling(&[0.0, 0.13, 0.5, 0.77, 1.0], gap);
            let master = floor(&[-0.3, 0.2, 0.6, 1.4], 0.0);
            let found = forces(&slave, &master, &law(detection, 0.0), &mut Slip::default());
            for v in found.sites {
                let v = v.expect("faces the floor");
                assert!((v.gap - gap).abs() < 1e-14);
                let pressure = NormalLaw::barrier(KAPPA, GC).pressure(gap);
                assert!((v.pressure - pressure).abs() < 1e-8 * pressure);
            }
        }
    }
}

/// The bottom of a polygon with 2 n sides over a plane: the vertex weight function is a hat over two chords.
#[test]
fn the_gap_of_a_circle_is_its_distance_from_the_chords() {
    let (radius, height) = (0.5, 0.54);
    let slave = disc([0.0, height], radius, 0.04);
    let master = floor(&[-1.0, 1.0], 0.0);
    let found = forces(
        &slave,
        &master,
        &law(Detection::Mortar, 0.0),
        &mut Slip::default(),
    );
    let (k, gap) = found.smallest_gap().expect("they are near");
    // The chord rises by s²/(2 R); the hat times it along the normal has the mean s²/(6 R), and the chords fall short
    // of the circle by nothing at the vertex.
    let s = slave.edge(k).norm();
    assert!(slave.points[k].x.abs() < s);
    let exact = height - radius + s * s / (6.0 * radius);
    assert!((gap - exact).abs() < 0.06 * s * s / radius, "{gap} {exact}");
}

/// Uniform pressure passes through meshes that do not match: the forces on the vertices of the master are those of a
/// uniform pressure. Node to segment detection fails this, which is why mortar is worth its cost.
#[test]
fn patch_test() {
    let gap = 0.05;
    let slave = ceiling(&[-0.5, -0.13, 0.22, 0.31, 0.64, 1.1, 1.5], gap);
    let master = floor(&[-1.0, 0.0, 0.17, 0.4, 0.55, 0.9, 1.0, 2.0], 0.0);
    let p = NormalLaw::barrier(KAPPA, GC).pressure(gap);
    let error = |detection| {
        let found = forces(&slave, &master, &law(detection, 0.0), &mut Slip::default());
        for (f, length) in found.slave.iter().zip(slave.tributary_lengths()) {
            assert!((f - point(0.0, p * length)).norm() < 1e-12 * p);
        }
        // Vertices of the master whose segments the slave covers whole.
        (2..6)
            .map(|k| (found.master[k] + point(0.0, p * master.tributary_lengths()[k])).norm())
            .fold(0.0, f64::max)
            / p
    };
    assert!(error(Detection::Mortar) < 1e-13);
    assert!(error(Detection::NodeToSegment) > 0.02);
}

/// Two wavy blobs of radius 1/2 at a distance within the range, with vertices off their circle by up to a share of a
/// segment.
fn random_pair(distance: Range<f64>, waves: f64) -> impl Strategy<Value = (Boundary, Boundary)> {
    (
        0.1..0.3_f64,
        0.1..0.3_f64,
        -0.4..0.4_f64,
        distance,
        0.0..6.3_f64,
        0.0..waves,
    )
        .prop_map(|(a, b, x, y, angle, wobble)| {
            let mut slave = moved(&disc([0.0, 0.0], 0.5, a), angle, point(x, y));
            let mut master = disc([0.0, 0.0], 0.5, b);
            for (k, p) in slave.points.iter_mut().enumerate() {
                *p += wobble * a * point((3.7 * k as f64).sin(), (1.3 * k as f64).cos());
            }
            for (k, p) in master.points.iter_mut().enumerate() {
                *p += wobble * b * point((2.9 * k as f64).cos(), (5.1 * k as f64).sin());
            }
            (slave, master)
        })
}

fn largest(forces: &[Point]) -> f64 {
    forces.iter().map(Point::norm).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn action_is_reaction((slave, master) in random_pair(0.75..1.1, 0.2), mu in 0.0..1.0_f64, nts in any::<bool>(),
        seed in prop::array::uniform4(-0.01..0.01_f64)) {
        let detection = if nts { Detection::NodeToSegment } else { Detection::Mortar };
        let law = law(detection, mu);
        let slave_moved = vec![point(seed[0], seed[1]); slave.points.len()];
        let master_moved = vec![point(seed[2], seed[3]); master.points.len()];
        let mut slip = Slip::default();
        let found = contact_forces(
            PairSurfaces { slave: &slave, master: &master, slave_moved: &slave_moved, master_moved: &master_moved,
                slave_velocity: &at_rest(&slave), master_velocity: &at_rest(&master), ahead: None },
            &law, &mut slip);
        let (on_slave, moment_slave) = resultant(&slave.points, &found.slave, &point(0.0, 0.0));
        let (on_master, moment_master) = resultant(&master.points, &found.master, &point(0.0, 0.0));
        let scale = found.slave.iter().map(Point::norm).sum::<f64>();
        prop_assert!((on_slave + on_master).norm() <= 1e-12 * scale);
        // The forces act across the gap along different normals at the ends of a segment, and friction across the whole
        // gap: the couple is at most the force times the distance searched, and small against that for small gaps.
        let searched = law.search.reach.max(law.search.depth);
        prop_assert!((moment_slave + moment_master).abs() <= 1.1 * searched * scale);
        for (k, v) in found.sites.iter().enumerate() {
            if let Some(v) = v {
                prop_assert!(v.pressure >= 0.0 && v.traction[0].abs() <= mu * v.pressure * (1.0 + 1e-14));
                prop_assert!((v.normal.norm() - 1.0).abs() < 1e-14);
            } else {
                prop_assert_eq!(slip.0[k], [0.0]);
            }
        }
        // Pushing apart: the master gets no stiffness that the slave does not have.
        let sums = [&found.slave_stiffness, &found.master_stiffness].map(|k| k.iter().sum::<f64>());
        prop_assert!((sums[0] - sums[1]).abs() <= 1e-12 * sums[0]);
    }

    /// Turning and shifting everything turns the forces and changes nothing else. The bodies overlap by less than the
    /// radius of any wave: beyond it normals cross, and where a vertex projects to is ill-conditioned.
    #[test]
    fn forces_turn_with_the_bodies((slave, master) in random_pair(0.97..1.1, 0.02), angle in -3.0..3.0_f64,
        shift in prop::array::uniform2(-5.0..5.0_f64)) {
        let law = law(Detection::Mortar, 0.4);
        let turn = nalgebra::Rotation2::new(angle);
        let slide = point(3.0e-5, -2.0e-5);
        let run = |slave: &Boundary, master: &Boundary, slide: Point| {
            let mut slip = Slip::default();
            let steps: Vec<PairForces<2, 1>> = (0..3).map(|_| contact_forces(
                PairSurfaces { slave, master, slave_moved: &vec![slide; slave.points.len()],
                    master_moved: &at_rest(master), slave_velocity: &at_rest(slave),
                    master_velocity: &at_rest(master), ahead: None }, &law, &mut slip)).collect();
            steps.into_iter().next_back().unwrap()
        };
        let here = run(&slave, &master, slide);
        let there = run(
            &moved(&slave, angle, Point::from(shift)),
            &moved(&master, angle, Point::from(shift)),
            turn * slide,
        );
        let scale = largest(&here.slave).max(largest(&here.master)).max(1.0);
        for (a, b) in here.slave.iter().chain(&here.master).zip(there.slave.iter().chain(&there.master)) {
            prop_assert!((turn * a - b).norm() < 1e-8 * scale, "{a} {b}");
        }
        prop_assert!((here.energy - there.energy).abs() < 1e-8 * (here.energy + 1.0));
    }
}

/// A line pressed on a floor and pulled along it: a spring, then sliding at mu p, then the spring the other way.
#[test]
fn pulling_a_line_along_a_floor() {
    let mu = 0.3;
    let law = law(Detection::Mortar, mu);
    let gap = 0.05;
    let slave = ceiling(&[0.0, 0.2, 0.5], gap);
    let master = floor(&[-1.0, 0.1, 1.0], 0.0);
    let p = law.normal.pressure(gap);
    let step = 1.0e-5;
    let mut slip = Slip::default();
    let mut pull = |dx: f64| {
        let found = contact_forces(
            PairSurfaces {
                slave: &slave,
                master: &master,
                slave_moved: &[point(dx, 0.0); 3],
                master_moved: &at_rest(&master),
                slave_velocity: &at_rest(&slave),
                master_velocity: &at_rest(&master),
                ahead: None,
            },
            &law,
            &mut slip,
        );
        resultant(&slave.points, &found.slave, &point(0.0, 0.0)).0.x / 0.5
    };
    let stiffness = law.friction.expect("given").stiffness;
    for k in 1..=5 {
        // The slave moves to the right and is held back.
        assert!((pull(step) + f64::from(k) * stiffness * step).abs() < 1e-9 * p);
    }
    for _ in 0..100 {
        pull(step);
    }
    assert!((pull(step) + mu * p).abs() < 1e-12 * p);
    assert!((pull(-step) - (stiffness * step - mu * p)).abs() < 1e-9 * p);
}

/// Friction across a gap is a couple of mu g F: not a fault of the sums but of surfaces that touch before they meet.
#[test]
fn friction_across_the_gap_is_a_couple() {
    let (mu, gap) = (0.3, 0.04);
    let law = law(Detection::Mortar, mu);
    let slave = ceiling(&[0.0, 0.25, 0.5], gap);
    let master = floor(&[-1.0, 1.0], 0.0);
    let mut slip = Slip(vec![[1.0]; 3]);
    let found = forces(&slave, &master, &law, &mut slip);
    let (force, on_slave) = resultant(&slave.points, &found.slave, &point(0.0, 0.0));
    let (_, on_master) = resultant(&master.points, &found.master, &point(0.0, 0.0));
    let couple = (on_slave + on_master).abs();
    assert!(
        (couple - mu * gap * force.y).abs() < 1e-12 * force.y,
        "{couple}"
    );
}

/// A slip that was there is forgotten when the surfaces part.
#[test]
fn slip_is_forgotten_without_pressure() {
    let law = law(Detection::Mortar, 0.3);
    let master = floor(&[-1.0, 1.0], 0.0);
    let mut slip = Slip(vec![[1.0e-4]; 2]);
    let _ = forces(&ceiling(&[0.0, 0.5], 0.5 * GC), &master, &law, &mut slip);
    assert!(slip.0.iter().all(|u| *u == [1.0e-4]));
    let _ = forces(&ceiling(&[0.0, 0.5], 1.5 * GC), &master, &law, &mut slip);
    assert_eq!(slip.0, [[0.0]; 2]);
}

#[test]
fn the_approach_is_the_relative_motion_along_the_normal() {
    let slave = ceiling(&[0.0, 0.5], 0.05);
    let master = floor(&[-1.0, 1.0], 0.0);
    let found = contact_forces(
        PairSurfaces {
            slave: &slave,
            master: &master,
            slave_moved: &[point(0.3, -0.01); 2],
            master_moved: &[point(0.1, 0.02); 2],
            slave_velocity: &[point(3.0, -1.0); 2],
            master_velocity: &[point(1.0, 2.0); 2],
            ahead: None,
        },
        &law(Detection::Mortar, 0.0),
        &mut Slip::default(),
    );
    for vertex in found.sites {
        let vertex = vertex.expect("they face");
        assert!((vertex.approach - 0.03).abs() < 1e-15);
        assert!((vertex.closing - 3.0).abs() < 1e-14);
    }
}

/// A gap that can close within the next step, be it that it turns, has its stiffness already; one that is too slow has none.
/// So has one that the forces of now will close.
#[test]
fn the_stiffness_of_a_gap_that_will_close_counts() {
    let gap = 1.5 * GC;
    let slave = ceiling(&[0.0, 0.5], gap);
    let master = floor(&[-1.0, 1.0], 0.0);
    let none = [point(0.0, 0.0); 2];
    let stiffness = |closing: f64, kick: [f64; 2], time: f64| {
        let [slave_kick, master_kick] = kick.map(|v| [point(0.0, v); 2]);
        let found = contact_forces(
            PairSurfaces {
                slave: &slave,
                master: &master,
                slave_moved: &none,
                master_moved: &none,
                slave_velocity: &[point(0.0, -closing); 2],
                master_velocity: &none,
                ahead: Some(StepAhead {
                    time,
                    slave_kick: &slave_kick,
                    master_kick: &master_kick,
                }),
            },
            &law(Detection::Mortar, 0.0),
            &mut Slip::default(),
        );
        assert!(found.slave.iter().all(|f| f.norm() == 0.0));
        found.slave_stiffness.iter().sum::<f64>()
    };
    let (late, soon) = (0.9 * (gap - GC), gap - 0.8 * GC);
    assert_eq!(stiffness(1.0, [0.0; 2], late), 0.0);
    assert_eq!(stiffness(0.0, [0.0; 2], 10.0 * gap), 0.0);
    // Forces that open a gap keep nothing from turning.
    for (closing, kick) in [
        (1.0, [0.0; 2]),
        (-1.0, [0.0; 2]),
        (0.0, [-1.0, 0.0]),
        (0.0, [0.0, 1.0]),
        (0.0, [-0.5, 0.5]),
        (1.0, [5.0, 0.0]),
    ] {
        assert!(stiffness(closing, kick, soon) > 0.0);
    }
    assert_eq!(stiffness(0.0, [-1.0, 0.0], late), 0.0);
    assert_eq!(stiffness(0.0, [1.0, 0.0], soon), 0.0);
}
