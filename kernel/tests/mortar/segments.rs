//! Projections, and the points at which the mortar integrals are evaluated.

use crate::common::cases;
use crate::mortar::support::{ceiling, floor, open, point};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::Boundary;
use proctor_contact::geometry::mortar::points::{
    Detection, MasterSearch, MortarPoint, MortarPoints,
};
use proctor_contact::geometry::mortar::segments::{feet, project};
use proctor_kernel::team::Team;
use proptest::prelude::*;

const SEARCH: MasterSearch = MasterSearch {
    reach: 0.5,
    depth: 0.5,
};

fn points(slave: &Boundary, master: &Boundary, detection: Detection) -> Vec<MortarPoint<2>> {
    let mut found = MortarPoints::default();
    found.find(
        &Team::ALONE,
        slave,
        &slave.normals(),
        master,
        detection,
        SEARCH,
    );
    found.iter().copied().collect()
}

fn covered(points: &[MortarPoint<2>]) -> f64 {
    points.iter().map(|p| p.weight).sum()
}

#[test]
fn only_facing_segments_are_seen() {
    let master = floor(&[0.0, 2.0], 0.0);
    let down = point(0.0, -3.0);
    let seen = project(&point(0.5, 0.2), &down, &master, 0).expect("faces");
    // The floor runs from x = 2 to 0.
    assert!((seen.eta - 0.75).abs() < 1e-15 && (seen.gap - 0.2).abs() < 1e-15);
    let inside = project(&point(0.5, -0.2), &down, &master, 0).expect("faces");
    assert!((inside.gap + 0.2).abs() < 1e-15);
    assert_eq!(
        project(&point(0.5, 0.2), &point(0.0, 1.0), &master, 0),
        None
    );
    assert_eq!(
        project(&point(0.5, 0.2), &point(0.0, 0.0), &master, 0),
        None
    );
}

proptest! {
    #![proptest_config(cases(256))]

    /// The point at a known place on a slave segment, moved along the normal there, projects back to that place.
    #[test]
    fn feet_are_found(xi in 0.01..0.99_f64, gap in -0.3..0.3_f64, t1 in -0.5..0.5_f64, t2 in -0.5..0.5_f64,
        angle in 0.0..6.3_f64) {
        let turn = nalgebra::Rotation2::new(angle);
        let x = [turn * point(-0.5, 0.1), turn * point(0.5, 0.1)];
        let n = [t1, t2].map(|t: f64| turn * point(t.sin(), -t.cos()));
        let normal = n[0] * (1.0 - xi) + n[1] * xi;
        let y = x[0] * (1.0 - xi) + x[1] * xi + gap * normal;
        let found: Vec<f64> = feet(&y, [&x[0], &x[1]], [&n[0], &n[1]]).collect();
        prop_assert!(found.iter().any(|f| (f - xi).abs() < 1e-9), "{found:?} {xi}");
    }

    /// Parallel lines of any division: the whole overlap is covered once, and D and M have the same total.
    #[test]
    fn flat_surfaces_are_covered_once(
        mut cuts in prop::collection::vec(0.01..0.99_f64, 0..8), mut others in prop::collection::vec(-0.49..1.49_f64, 0..8),
        from in -0.5..0.4_f64, to in 0.6..1.5_f64,
    ) {
        cuts.extend([0.0, 1.0]);
        others.retain(|x| from < *x && *x < to);
        others.extend([from, to]);
        for list in [&mut cuts, &mut others] {
            list.sort_unstable_by(f64::total_cmp);
            list.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
        }
        let slave = ceiling(&cuts, 0.1);
        let master = floor(&others, 0.0);
        let overlap = to.min(1.0) - from.max(0.0);
        let found = points(&slave, &master, Detection::Mortar);
        prop_assert!((covered(&found) - overlap).abs() < 1e-12);
        for p in &found {
            let apart = p.on_master(&master.points) - p.on_slave(&slave.points);
            // The projection is vertical.
            prop_assert!((apart - point(0.0, -0.1)).norm() < 1e-13, "{apart}");
            prop_assert!((p.master[0].1 + p.master[1].1 - 1.0).abs() < 1e-15);
        }
        // The integral of a product of shape functions is exact: row sums of D are half the lengths of the segments
        // where the master covers them whole.
        if from < 0.0 && to > 1.0 {
            let mut rows = vec![0.0; cuts.len()];
            for p in &found {
                for (k, share) in p.slave {
                    rows[k] += share * p.weight;
                }
            }
            for (row, length) in rows.iter().zip(slave.tributary_lengths()) {
                prop_assert!((row - length).abs() < 1e-13);
            }
        }
    }
}

#[test]
fn the_nearest_of_several_masters_is_seen() {
    // A slot: two floors, one under the other.
    let near = [[1.0, 0.0], [0.0, 0.0]];
    let far = [[1.0, -0.2], [0.0, -0.2]];
    let both = Boundary::new(&[
        crate::mortar::support::chain(
            &far,
            proctor_contact::geometry::mortar::boundary::BoundarySide::Open,
        ),
        crate::mortar::support::chain(
            &near,
            proctor_contact::geometry::mortar::boundary::BoundarySide::Open,
        ),
    ])
    .expect("sound");
    let slave = ceiling(&[0.2, 0.8], 0.1);
    for detection in [Detection::Mortar, Detection::NodeToSegment] {
        let found = points(&slave, &both, detection);
        assert!((covered(&found) - 0.6).abs() < 1e-14);
        for p in found {
            assert!(p.master[0].0 >= 2, "{p:?}");
        }
    }
}

#[test]
fn search_ends_at_reach_and_depth() {
    let master = floor(&[-1.0, 2.0], 0.0);
    for (y, seen) in [(0.49, true), (0.51, false), (-0.49, true), (-0.51, false)] {
        let slave = ceiling(&[0.0, 1.0], y);
        for detection in [Detection::Mortar, Detection::NodeToSegment] {
            let found = !points(&slave, &master, detection).is_empty();
            assert_eq!(found, seen, "{y} {detection:?}");
        }
    }
}

/// On a convex slave the fan of normals at a corner still gives every point of the slave one point of the master.
#[test]
fn a_corner_is_covered_once() {
    let slave = open(&[[-0.3, 0.3], [0.0, 0.05], [0.3, 0.3]]);
    let master = floor(&[-2.0, -0.1, 0.05, 2.0], 0.0);
    let found = points(&slave, &master, Detection::Mortar);
    let whole = 2.0 * 0.3_f64.hypot(0.25);
    assert!(
        (covered(&found) - whole).abs() < 1e-12,
        "{}",
        covered(&found)
    );
    for p in &found {
        let on: Point = p.on_master(&master.points);
        assert!(on.y.abs() < 1e-14);
    }
}

/// Threads share the elements of the slave, and the points come in the same order.
#[test]
fn threads_find_the_same_points() {
    let line = |count: i32, wave: f64| -> Vec<f64> {
        (0..=count)
            .map(|i| f64::from(i) + wave * f64::from(i).sin())
            .collect()
    };
    let (slave, master) = (ceiling(&line(300, 0.3), 0.1), floor(&line(200, 0.2), 0.0));
    let found = |threads| {
        let team = Team::new(threads).expect("threads");
        let mut found = MortarPoints::default();
        found.find(
            &team,
            &slave,
            &slave.normals(),
            &master,
            Detection::Mortar,
            SEARCH,
        );
        found.iter().copied().collect::<Vec<_>>()
    };
    let one = found(1);
    assert!(one.len() > 700, "{}", one.len());
    for threads in [2, 3, 5] {
        assert_eq!(found(threads), one, "{threads} threads");
    }
}
