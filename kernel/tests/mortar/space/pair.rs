//! Forces of a pair in space: balance, patch test, friction, and what does not depend on the frame.

use super::support::{GC, KAPPA, at_rest, ball, ceiling, dragged, floor, law, moved, point};
use crate::common::cases;
use nalgebra::{Rotation3, Vector3};
use proctor_contact::geometry::mortar::law::NormalLaw;
use proctor_contact::geometry::mortar::pair::Slip;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_contact::geometry::mortar::space::{Point, resultant};
use proptest::prelude::*;
use std::ops::Range;

/// Uniform pressure passes through triangulations that do not match: the forces on the vertices of both are those of a
/// uniform pressure. Node to segment detection fails this.
#[test]
fn patch_test() {
    let gap = 0.05;
    let slave = ceiling(
        &[-0.5, -0.13, 0.22, 0.31, 0.64, 1.1, 1.5],
        &[-0.4, 0.1, 0.35, 0.9, 1.3],
        gap,
        |i, j| (i * j) % 3 == 1,
    );
    let master = floor(
        &[-1.0, 0.0, 0.17, 0.4, 0.55, 0.9, 1.0, 2.0],
        &[-1.0, 0.02, 0.3, 0.42, 0.77, 1.0, 2.0],
        0.0,
        |i, j| (i + j) % 2 == 0,
    );
    let p = NormalLaw::barrier(KAPPA, GC).pressure(gap);
    let turn = Rotation3::from_euler_angles(0.3, 1.1, -2.0);
    let error = |detection, turn: &Rotation3<f64>| {
        let shift = point(3.0, -1.0, 2.0);
        let [s, m] = [&slave, &master].map(|f| moved(f, turn, &shift));
        let found = at_rest(&s, &m, &law(detection, 0.0));
        let up = turn * point(0.0, 0.0, 1.0);
        for (f, area) in found.slave.iter().zip(slave.tributary_areas()) {
            assert!((f - up * (p * area)).norm() < 1e-11 * p, "{f} {}", p * area);
        }
        for v in found.sites.iter().flatten() {
            assert!((v.gap - gap).abs() < 1e-14 && (v.normal + up).norm() < 1e-14);
        }
        // Vertices of the master whose triangles the slave covers whole.
        let whole = |x: &Point| (0.1..=0.95).contains(&x.x) && (0.1..=0.8).contains(&x.y);
        let areas = master.tributary_areas();
        let inner = (0..master.points.len()).filter(|k| whole(&master.points[*k]));
        assert_eq!(inner.clone().count(), 4 * 3);
        inner
            .map(|k| (found.master[k] + up * (p * areas[k])).norm())
            .fold(0.0, f64::max)
            / p
    };
    assert!(error(Detection::Mortar, &Rotation3::identity()) < 1e-13);
    assert!(error(Detection::Mortar, &turn) < 1e-11);
    assert!(error(Detection::NodeToSegment, &Rotation3::identity()) > 0.005);
}

/// Two lumpy balls of radius 1/2, their vertices off the sphere by up to a share of a segment.
fn random_pair(distance: Range<f64>, waves: f64) -> impl Strategy<Value = (Facets, Facets)> {
    (
        0.15..0.4_f64,
        0.15..0.4_f64,
        prop::array::uniform2(-0.3..0.3_f64),
        distance,
        prop::array::uniform3(-3.0..3.0_f64),
        0.0..waves,
    )
        .prop_map(|(a, b, [x, y], distance, turn, wobble)| {
            let turn = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
            let to = point(x, y, 1.0).normalize() * distance;
            let mut slave = moved(&ball([0.0; 3], 0.5, a), &turn, &to);
            let mut master = ball([0.0; 3], 0.5, b);
            let wave = |k: usize, f: f64| {
                let k = f * k as f64;
                point((3.7 * k).sin(), (1.3 * k).cos(), (2.1 * k).sin())
            };
            for (k, p) in slave.points.iter_mut().enumerate() {
                *p += wobble * a * wave(k, 1.0);
            }
            for (k, p) in master.points.iter_mut().enumerate() {
                *p += wobble * b * wave(k, 1.7);
            }
            (slave, master)
        })
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn action_is_reaction((slave, master) in random_pair(0.75..1.1, 0.2), mu in 0.0..1.0_f64, nts in any::<bool>(),
        by in prop::array::uniform3(-0.01..0.01_f64)) {
        let law = law(if nts { Detection::NodeToSegment } else { Detection::Mortar }, mu);
        let mut slip = Slip::default();
        let found = dragged(&slave, &master, &law, &Point::from(by), &mut slip);
        let about = point(0.0, 0.0, 0.0);
        let (on_slave, moment_slave) = resultant(&slave.points, &found.slave, &about);
        let (on_master, moment_master) = resultant(&master.points, &found.master, &about);
        let scale = found.slave.iter().map(Point::norm).sum::<f64>();
        prop_assert!((on_slave + on_master).norm() <= 1e-12 * scale);
        let searched = law.search.margin();
        prop_assert!((moment_slave + moment_master).norm() <= 1.1 * searched * scale);
        for (k, v) in found.sites.iter().enumerate() {
            if let Some(v) = v {
                let [s, t] = v.traction;
                prop_assert!(v.pressure >= 0.0 && s.hypot(t) <= mu * v.pressure * (1.0 + 1e-14));
                prop_assert!((v.normal.norm() - 1.0).abs() < 1e-14);
                prop_assert!(v.measure > 0.0);
            } else {
                prop_assert_eq!(slip.0[k], [0.0; 2]);
            }
        }
        let sums = [&found.slave_stiffness, &found.master_stiffness].map(|k| k.iter().sum::<f64>());
        prop_assert!((sums[0] - sums[1]).abs() <= 1e-12 * sums[0]);
    }

    /// Turning and shifting everything turns the forces and changes nothing else; so does turning it between two steps,
    /// since the slip that is kept turns with the surface.
    #[test]
    fn forces_turn_with_the_bodies((slave, master) in random_pair(0.98..1.1, 0.02),
        turn in prop::array::uniform3(-3.0..3.0_f64), shift in prop::array::uniform3(-5.0..5.0_f64)) {
        let law = law(Detection::Mortar, 0.4);
        let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
        let shift = Point::from(shift);
        let [slave_there, master_there] = [&slave, &master].map(|f| moved(f, &rotation, &shift));
        let slide = point(3.0e-5, -2.0e-5, 1.0e-5);
        let mut here = Slip::default();
        let mut there = Slip::default();
        for _ in 0..2 {
            dragged(&slave, &master, &law, &slide, &mut here);
            dragged(&slave_there, &master_there, &law, &(rotation * slide), &mut there);
        }
        let mut turned_between = here.clone();
        let a = dragged(&slave, &master, &law, &slide, &mut here);
        for slip in [&mut there, &mut turned_between] {
            let b = dragged(&slave_there, &master_there, &law, &(rotation * slide), slip);
            let largest = a.slave.iter().chain(&a.master).map(Point::norm).fold(1.0, f64::max);
            for (a, b) in a.slave.iter().chain(&a.master).zip(b.slave.iter().chain(&b.master)) {
                prop_assert!((rotation * a - b).norm() < 1e-8 * largest, "{a} {b}");
            }
            prop_assert!((a.energy - b.energy).abs() < 1e-8 * (a.energy + 1.0));
        }
    }
}

/// A plate pressed on a floor and pulled in changing directions: a spring in the direction of the pull, then sliding
/// with a friction of mu p against the motion, whatever way it turns.
#[test]
fn pulling_a_plate_over_a_floor() {
    let mu = 0.3;
    let law = law(Detection::Mortar, mu);
    let gap = 0.05;
    let slave = ceiling(&[0.0, 0.2, 0.5], &[0.0, 0.3, 0.5], gap, |i, j| i == j);
    let master = floor(&[-1.0, 0.1, 1.0], &[-1.0, 0.2, 1.0], 0.0, |_, _| false);
    let p = law.normal.pressure(gap);
    let mut slip = Slip::default();
    let mut pull = |by: Point| {
        let found = dragged(&slave, &master, &law, &by, &mut slip);
        resultant(&slave.points, &found.slave, &Point::zeros()).0 / 0.25
    };
    let stiffness = law.friction.expect("given").stiffness;
    let step = 1.0e-5;
    let direction = point(0.6, -0.8, 0.0);
    for k in 1..=5 {
        let friction = pull(direction * step) - Vector3::z() * p;
        assert!((friction + direction * (f64::from(k) * stiffness * step)).norm() < 1e-9 * p);
    }
    for turns in [0.0, 0.2, 0.7] {
        let (sin, cos) = (std::f64::consts::TAU * turns).sin_cos();
        let way = point(cos, sin, 0.0);
        // The old direction decays like exp(-path over elastic slip), here 0.02 m over mu p / kappa_t = 4e-4 m.
        for _ in 0..200 {
            pull(way * (10.0 * step));
        }
        let friction = pull(way * step) - Vector3::z() * p;
        assert!(
            (friction + way * (mu * p)).norm() < 1e-12 * p,
            "{friction} {}",
            mu * p
        );
    }
}

/// Friction across a gap is a couple of mu g F.
#[test]
fn friction_across_the_gap_is_a_couple() {
    let (mu, gap) = (0.3, 0.04);
    let law = law(Detection::Mortar, mu);
    let slave = ceiling(&[0.0, 0.25, 0.5], &[0.0, 0.5], gap, |_, _| false);
    let master = floor(&[-1.0, 1.0], &[-1.0, 1.0], 0.0, |_, _| false);
    let found = dragged(
        &slave,
        &master,
        &law,
        &point(1.0, 2.0, 0.0),
        &mut Slip::default(),
    );
    let about = Point::zeros();
    let (force, on_slave) = resultant(&slave.points, &found.slave, &about);
    let (_, on_master) = resultant(&master.points, &found.master, &about);
    assert!(((on_slave + on_master).norm() - mu * gap * force.z).abs() < 1e-12 * force.z);
}

/// A slip that was there is forgotten when the surfaces part.
#[test]
fn slip_is_forgotten_without_pressure() {
    let law = law(Detection::Mortar, 0.3);
    let master = floor(&[-1.0, 1.0], &[-1.0, 1.0], 0.0, |_, _| false);
    let at = |gap: f64| ceiling(&[0.0, 0.5], &[0.0, 0.5], gap, |_, _| false);
    let kept = [1.0e-4, -2.0e-4];
    let mut slip = Slip(vec![kept; 4]);
    let none = Point::zeros();
    let _ = dragged(&at(0.5 * GC), &master, &law, &none, &mut slip);
    assert!(slip.0.iter().all(|u| *u == kept));
    let _ = dragged(&at(1.5 * GC), &master, &law, &none, &mut slip);
    assert_eq!(slip.0, [[0.0; 2]; 4]);
}
