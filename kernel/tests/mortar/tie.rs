//! Weights that tie a point to particles around it.

use nalgebra::{Matrix2, Matrix3, Rotation2, SMatrix};
use proctor_contact::geometry::mortar::PointIn;
use proctor_contact::geometry::mortar::tie::affine_weights;
use proptest::prelude::*;

/// A row of particles, and so many beside it, half a cell apart; the first row lies a quarter of a cell below zero.
fn below(rows: usize, shift: f64) -> Vec<PointIn<2>> {
    let at = |row: usize, k: i32| {
        PointIn::<2>::new(0.5 * f64::from(k) + shift, -0.25 - 0.5 * row as f64)
    };
    (0..rows)
        .flat_map(|row| (-6..=6).map(move |k| at(row, k)))
        .collect()
}

fn sum<const D: usize>(weights: &[f64], points: &[PointIn<D>]) -> PointIn<D> {
    weights.iter().zip(points).map(|(w, x)| x * *w).sum()
}

proptest! {
    #![proptest_config(crate::common::cases(64))]

    /// Translation, rotation and uniform strain take the point along.
    #[test]
    fn affine_motions_are_exact(
        angle in -3.0..3.0, shift in -0.25..0.25, at in prop::array::uniform2(-0.3..0.3),
        entries in prop::array::uniform4(-0.5..0.5),
    ) {
        let (points, at) = (below(4, shift), PointIn::<2>::from(at));
        let weights = affine_weights(&points, &at, &PointIn::repeat(1.0), 0.01).expect("rows on all sides");
        let strain = Matrix2::identity() + Matrix2::from_row_slice(&entries);
        let along = |x: &PointIn<2>| Rotation2::new(angle) * (strain * x) + PointIn::<2>::new(3.0, -2.0);
        let moved: Vec<_> = points.iter().map(along).collect();
        let off = (sum(&weights, &moved) - along(&at)).norm();
        prop_assert!(off < 1e-13, "{off}");
        prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-13);
    }
}

#[test]
fn what_is_not_affine_is_of_second_order_in_the_support() {
    let error = |h: f64| {
        let points: Vec<_> = below(4, 0.1).iter().map(|x| x * h).collect();
        let weights =
            affine_weights(&points, &PointIn::zeros(), &PointIn::repeat(h), 0.01).expect("rows");
        let field = |x: &PointIn<2>| (1.0 + x[0] + 2.0 * x[1]).sin();
        let found: f64 = weights.iter().zip(&points).map(|(w, x)| w * field(x)).sum();
        (found - field(&PointIn::zeros())).abs()
    };
    let order = (error(0.1) / error(0.05)).log2();
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

/// One row knows nothing of how its body turns, however long it is; nor has a point without particles a place.
#[test]
fn particles_must_span_all_directions() {
    let support = PointIn::<2>::repeat(1.0);
    assert_eq!(
        affine_weights(&below(1, 0.0), &PointIn::zeros(), &support, 0.01),
        None
    );
    assert!(affine_weights(&below(2, 0.0), &PointIn::zeros(), &support, 0.01).is_some());
    assert_eq!(
        affine_weights(&below(2, 0.0), &PointIn::repeat(9.0), &support, 0.01),
        None
    );
    assert_eq!(affine_weights(&[], &PointIn::zeros(), &support, 0.01), None);
}

#[test]
fn in_space_as_in_the_plane() {
    let places = (0..216).map(|k| [k / 36, k / 6 % 6, k % 6]);
    let points: Vec<PointIn<3>> = places
        .map(|place| PointIn::from_fn(|axis, _| 0.5 * f64::from(place[axis]) + 0.25))
        .collect();
    let at = PointIn::<3>::new(0.0, 1.4, 0.1);
    let weights = affine_weights(&points, &at, &PointIn::repeat(1.0), 0.01).expect("on all sides");
    let strain: SMatrix<f64, 3, 3> = Matrix3::new(1.0, 0.2, 0.1, -0.3, 1.1, 0.0, 0.4, 0.0, 0.8);
    let moved: Vec<_> = points.iter().map(|x| strain * x).collect();
    assert!((sum(&weights, &moved) - strain * at).norm() < 1e-13);
}
