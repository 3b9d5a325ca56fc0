//! The projection of a slave: the part that is covered, its master, and the distance.

use super::support::{ball, ceiling, floor, moved, point};
use crate::common::cases;
use nalgebra::Rotation3;
use proctor_contact::geometry::mortar::points::{
    Detection, MasterSearch, MortarPoint, MortarPoints,
};
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_kernel::team::Team;
use proptest::prelude::*;

const SEARCH: MasterSearch = MasterSearch {
    reach: 0.5,
    depth: 0.5,
};

fn points(slave: &Facets, master: &Facets, detection: Detection) -> Vec<MortarPoint<3>> {
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

fn covered(points: &[MortarPoint<3>]) -> f64 {
    points.iter().map(|p| p.weight).sum()
}

fn join(sheets: &[&Facets]) -> Facets {
    let corners: Vec<_> = sheets
        .iter()
        .flat_map(|f| f.triangles().iter().map(|t| t.map(|v| f.points[v].into())))
        .collect();
    Facets::from_corners(&corners).expect("is sound")
}

/// Rectangles of any division: the overlap of length times width is covered once, and all gaps are the distance.
#[test]
fn flat_surfaces_are_covered_once() {
    let slave = ceiling(&[0.0, 0.21, 0.5, 1.0], &[0.0, 0.4, 1.0], 0.1, |i, j| {
        (i + j) % 2 == 0
    });
    let master = floor(
        &[0.13, 0.3, 0.77, 2.0],
        &[-1.0, 0.1, 0.55, 0.8],
        0.0,
        |i, _| i == 1,
    );
    let found = points(&slave, &master, Detection::Mortar);
    assert!((covered(&found) - 0.87 * 0.8).abs() < 1e-14);
    for p in &found {
        let apart = p.on_master(&master.points) - p.on_slave(&slave.points);
        assert!((apart - point(0.0, 0.0, -0.1)).norm() < 1e-14);
        for on in [p.slave, p.master] {
            assert!((on.iter().map(|(_, n)| n).sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(on.iter().all(|(_, n)| *n > -1e-12));
        }
    }
}

#[test]
fn matching_and_nearly_matching_meshes_leave_no_hole() {
    let grid = [0.0, 0.25, 0.5, 0.75, 1.0];
    for off in [0.0, 1e-17, 1e-14, 1e-9] {
        let slave = ceiling(&grid, &grid, 0.1, |_, _| false);
        let master = moved(
            &floor(&grid, &grid, 0.0, |_, _| false),
            &Rotation3::identity(),
            &point(off, 0.0, 0.0),
        );
        let area = covered(&points(&slave, &master, Detection::Mortar));
        assert!((area - (1.0 - off)).abs() < 1e-13, "{off} {area}");
    }
}

#[test]
fn search_ends_at_reach_and_depth() {
    let grid = [0.0, 0.5, 1.0];
    let master = floor(&grid, &grid, 0.0, |_, _| false);
    for detection in [Detection::Mortar, Detection::NodeToSegment] {
        for (gap, seen) in [(0.49, true), (0.51, false), (-0.49, true), (-0.51, false)] {
            let slave = ceiling(&grid, &grid, gap, |_, _| true);
            let area = covered(&points(&slave, &master, detection));
            assert!(
                (area - f64::from(seen)).abs() < 1e-14,
                "{gap} {detection:?}"
            );
        }
        let turned_away = floor(&grid, &grid, 0.1, |_, _| false);
        assert_eq!(covered(&points(&turned_away, &master, detection)), 0.0);
    }
}

/// A shelf over half of the floor: the shelf is seen where there is one, the floor beside it.
#[test]
fn the_nearest_of_several_masters_is_seen() {
    let ys = [0.0, 1.0];
    let slave = ceiling(&[0.0, 0.4, 1.0], &ys, 0.4, |_, _| false);
    let ground = floor(&[-0.1, 1.1], &ys, 0.0, |_, _| false);
    let shelf = floor(&[-0.1, 0.4], &ys, 0.2, |_, _| true);
    for master in [join(&[&ground, &shelf]), join(&[&shelf, &ground])] {
        let found = points(&slave, &master, Detection::Mortar);
        assert!((covered(&found) - 1.0).abs() < 1e-14);
        for p in &found {
            let x = p.on_slave(&slave.points).x;
            let z = p.on_master(&master.points).z;
            assert!(
                (z - if x < 0.4 { 0.2 } else { 0.0 }).abs() < 1e-14,
                "{x} {z}"
            );
        }
    }
}

proptest! {
    #![proptest_config(cases(32))]

    /// Over a floor without an end, every facet of a ball that looks down far enough is covered whole; points on the
    /// master lie straight along the normal of the facet.
    #[test]
    fn a_ball_over_a_floor(height in 0.6..0.9_f64, segment in 0.1..0.3_f64, turn in prop::array::uniform3(-3.0..3.0_f64)) {
        let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
        let slave = moved(&ball([0.0; 3], 0.5, segment), &rotation, &point(0.1, 0.2, height));
        let master = floor(&[-9.0, 0.13, 9.0], &[-9.0, -0.2, 9.0], 0.0, |i, _| i == 0);
        let found = points(&slave, &master, Detection::Mortar);
        let exact: f64 = slave.triangles().iter().enumerate().filter_map(|(t, v)| {
            let n = slave.triangle_normal(t);
            let [a, b, c] = v.map(|v| slave.points[v]);
            // All corners within the search along the normal.
            let gap = |x: &proctor_contact::geometry::mortar::space::Point| x.z / -n.z;
            let gaps = [gap(&a), gap(&b), gap(&c)];
            let near = gaps.iter().all(|g| *g <= SEARCH.reach);
            (n.z < -0.2 && near).then(|| 0.5 * (b - a).cross(&(c - a)).norm())
        }).sum();
        prop_assert!(covered(&found) >= exact - 1e-12);
        for p in &found {
            prop_assert!(p.on_master(&master.points).z.abs() < 1e-12);
            let t = slave.triangles().iter().position(|t| p.slave.iter().all(|(v, _)| t.contains(v))).unwrap();
            let apart = p.on_master(&master.points) - p.on_slave(&slave.points);
            prop_assert!(apart.cross(&slave.triangle_normal(t)).norm() < 1e-12);
        }
    }
}
