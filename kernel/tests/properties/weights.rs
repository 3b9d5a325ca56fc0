//! Weighting functions: what makes them a basis, everywhere and on the seams between their pieces.

use proctor_kernel::weights::{self, Family, axis_weights_at, base_node, base_offset};
use proptest::prelude::*;

/// Weights and derivatives at the nodes around a point, with the index of the first node.
#[derive(Debug)]
struct Axis {
    base: f64,
    w: Vec<f64>,
    g: Vec<f64>,
}

impl Axis {
    fn at(family: Family, nodes: usize, xi: f64, l: f64) -> Self {
        if nodes == 3 {
            let (base, w, g) = axis_weights_at::<3>(family, xi, l);
            Self {
                base,
                w: w.to_vec(),
                g: g.to_vec(),
            }
        } else {
            let (base, w, g) = axis_weights_at::<4>(family, xi, l);
            Self {
                base,
                w: w.to_vec(),
                g: g.to_vec(),
            }
        }
    }

    /// Weight and derivative at a node, zero outside the stencil.
    fn of(&self, node: f64) -> (f64, f64) {
        let n = node - self.base;
        if n < 0.0 || n >= self.w.len() as f64 {
            (0.0, 0.0)
        } else {
            (self.w[n as usize], self.g[n as usize])
        }
    }
}

/// Family, nodes per axis and half-length in cells of every weighting function.
fn function() -> impl Strategy<Value = (Family, usize, f64)> {
    prop_oneof![
        Just((Family::Hat, 3, 0.25)),
        Just((Family::Gimp, 3, 0.5)),
        (0.001..=0.5).prop_map(|l| (Family::Gimp, 3, l)),
        (0.001..=1.0).prop_map(|l| (Family::Gimp, 4, l)),
        Just((Family::Gimp, 4, 1.0)),
    ]
}

/// A coordinate in cells: anywhere, on nodes and faces, where a domain touches them, and one ulp beside.
fn coordinate(l: f64) -> impl Strategy<Value = f64> {
    let seam = (
        0_i32..40,
        prop_oneof![Just(0.0), Just(0.5), Just(l), Just(1.0 - l)],
        -1_i32..=1,
    )
        .prop_map(|(cell, offset, ulps)| {
            let xi = f64::from(cell) + offset;
            match ulps {
                -1 => xi.next_down(),
                1 => xi.next_up(),
                _ => xi,
            }
        });
    prop_oneof![0.0..40.0, seam]
}

fn function_and_point() -> impl Strategy<Value = ((Family, usize, f64), [f64; 3])> {
    function().prop_flat_map(|f| (Just(f), [coordinate(f.2), coordinate(f.2), coordinate(f.2)]))
}

/// The weights are formed from differences in [0, 2]; sums of up to 64 products of them stay within this.
const ROUND_OFF: f64 = 1.0e-14;

fn check_basis(axes: &[Axis], xi: &[f64]) -> Result<(), TestCaseError> {
    let (mut unity, mut gradient, mut position) = (0.0, [0.0; 3], [0.0; 3]);
    let mut jacobian = [[0.0; 3]; 3];
    let d = axes.len();
    let counts: Vec<usize> = axes.iter().map(|axis| axis.w.len()).collect();
    for flat in 0..counts.iter().product() {
        let mut at = vec![0; d];
        let mut rest = flat;
        for axis in 0..d {
            at[axis] = rest % counts[axis];
            rest /= counts[axis];
        }
        let w: f64 = (0..d).map(|axis| axes[axis].w[at[axis]]).product();
        prop_assert!(w >= 0.0, "negative weight {w}");
        unity += w;
        let g: Vec<f64> = (0..d)
            .map(|k| {
                (0..d)
                    .map(|axis| {
                        if axis == k {
                            axes[axis].g[at[axis]]
                        } else {
                            axes[axis].w[at[axis]]
                        }
                    })
                    .product()
            })
            .collect();
        for axis in 0..d {
            // Distance from the particle: nothing is lost to a large coordinate.
            let node = axes[axis].base + at[axis] as f64 - xi[axis];
            position[axis] += w * node;
            gradient[axis] += g[axis];
            for k in 0..d {
                jacobian[axis][k] += g[k] * node;
            }
        }
    }
    // Derivatives reach 1 per cell and axis, so their sums carry the same round-off.
    prop_assert!((unity - 1.0).abs() <= ROUND_OFF, "sum of weights {unity}");
    for axis in 0..d {
        prop_assert!(
            gradient[axis].abs() <= ROUND_OFF,
            "sum of gradients {gradient:?}"
        );
        prop_assert!(
            position[axis].abs() <= ROUND_OFF,
            "sum S (x_I - x_p) {position:?}"
        );
        for k in 0..d {
            let exact = f64::from(u8::from(axis == k));
            prop_assert!(
                (jacobian[axis][k] - exact).abs() <= ROUND_OFF,
                "sum grad S (x) x_I {jacobian:?}"
            );
        }
    }
    Ok(())
}

/// The technical manual's `S_Ip` for `l_p <= h/2`, by distance in cells.
fn manual(distance: f64, l: f64) -> f64 {
    let d = distance.abs();
    if d < l {
        1.0 - (d * d + l * l) / (2.0 * l)
    } else if d < 1.0 - l {
        1.0 - d
    } else if d < 1.0 + l {
        (1.0 + l - d).powi(2) / (4.0 * l)
    } else {
        0.0
    }
}

/// The mean of the hat over the particle domain, for any half-length.
fn mean_of_hat(distance: f64, l: f64) -> f64 {
    let integral = |x: f64| {
        let x = x.clamp(-1.0, 1.0);
        x - 0.5 * x * x.abs()
    };
    (integral(distance + l) - integral(distance - l)) / (2.0 * l)
}

proptest! {
    #![proptest_config(crate::common::cases(2000))]

    #[test]
    fn the_basis_reproduces_linear_fields(((family, nodes, l), xi) in function_and_point()) {
        let axes: Vec<Axis> = xi.iter().map(|&x| Axis::at(family, nodes, x, l)).collect();
        check_basis(&axes[..2], &xi[..2])?;
        check_basis(&axes, &xi)?;
    }

    #[test]
    fn neighbours_one_ulp_apart_have_equal_weights(((family, nodes, l), [xi, _, _]) in function_and_point()) {
        let (here, there) = (Axis::at(family, nodes, xi, l), Axis::at(family, nodes, xi.next_up(), l));
        // Slope at most 1 per cell, one ulp of a coordinate below 41 is 7e-15; the derivative of GIMP has slope
        // 1/(2 l) per cell.
        for node in 0..6 {
            let node = here.base - 1.0 + f64::from(node);
            let ((w, g), (w_next, g_next)) = (here.of(node), there.of(node));
            prop_assert!((w - w_next).abs() <= 2.0e-14, "{here:?} {there:?}");
            if family == Family::Gimp {
                prop_assert!((g - g_next).abs() <= 2.0e-14 / l, "{here:?} {there:?}");
            }
        }
    }

    #[test]
    fn derivatives_are_slopes((family, nodes, l) in function(), xi in 1.0..40.0) {
        const STEP: f64 = 1.0e-6;
        // The derivative of a hat jumps at the node.
        prop_assume!(family == Family::Gimp || (xi - f64::round(xi)).abs() > 2.0 * STEP);
        let here = Axis::at(family, nodes, xi, l);
        let (before, after) = (Axis::at(family, nodes, xi - STEP, l), Axis::at(family, nodes, xi + STEP, l));
        for node in 0..6 {
            let node = here.base - 1.0 + f64::from(node);
            let slope = (after.of(node).0 - before.of(node).0) / (2.0 * STEP);
            // Second derivative 1/(2 l) on one side of a seam at worst; 2e-14/STEP from round-off of xi.
            prop_assert!((slope - here.of(node).1).abs() <= STEP / l + 4.0e-8, "{slope} {here:?}");
        }
    }

    #[test]
    fn three_and_four_nodes_agree(l in 0.001..=0.5, xi in (0.001..=0.5).prop_flat_map(coordinate)) {
        let (three, four) = (Axis::at(Family::Gimp, 3, xi, l), Axis::at(Family::Gimp, 4, xi, l));
        for node in 0..6 {
            let node = three.base - 1.0 + f64::from(node);
            let ((w, g), (w_4, g_4)) = (three.of(node), four.of(node));
            // Three nodes: the quadratic pieces; four nodes: the middle ones from the sums. Coefficients of
            // the derivative reach 1/(4 l) in front of differences with an error of 2 eps.
            prop_assert!((w - w_4).abs() <= 4.0e-15, "{three:?} {four:?}");
            prop_assert!((g - g_4).abs() <= 1.0e-15 + 1.0e-15 / l, "{three:?} {four:?}");
        }
    }

    #[test]
    fn weights_are_the_manuals(l in 0.001..=0.5, xi in (0.001..=0.5).prop_flat_map(coordinate)) {
        let axis = Axis::at(Family::Gimp, 3, xi, l);
        for n in 0..3 {
            let exact = manual(xi - axis.base - f64::from(n), l);
            prop_assert!((axis.w[n as usize] - exact).abs() <= 4.0e-15, "{axis:?} {exact}");
        }
    }

    #[test]
    fn weights_are_means_of_hats_over_the_domain(l in 0.001..=1.0, xi in (0.001..=1.0).prop_flat_map(coordinate)) {
        let axis = Axis::at(Family::Gimp, 4, xi, l);
        for n in 0..4 {
            let exact = mean_of_hat(xi - axis.base - f64::from(n), l);
            // The reference divides a difference of integrals of order 1 by 2 l.
            prop_assert!((axis.w[n as usize] - exact).abs() <= 4.0e-15 + 1.0e-15 / l, "{axis:?} {exact}");
        }
    }

    #[test]
    fn hats_are_hats(xi in coordinate(0.25)) {
        let axis = Axis::at(Family::Hat, 3, xi, 0.25);
        for n in 0..3 {
            let exact = (1.0 - (xi - axis.base - f64::from(n)).abs()).max(0.0);
            // 1 - w_0 - w_2 rounds once more than the formula.
            prop_assert!((axis.w[n as usize] - exact).abs() <= 4.0e-16, "{axis:?} {exact}");
        }
    }
}

#[test]
fn half_a_cell_is_the_quadratic_b_spline() {
    for k in 0..1000 {
        let xi = 3.0 + f64::from(k) / 1000.0;
        let axis = Axis::at(Family::Gimp, 3, xi, 0.5);
        for n in 0..3 {
            let d = (xi - axis.base - f64::from(n)).abs();
            let exact = if d < 0.5 {
                0.75 - d * d
            } else {
                0.5 * (1.5 - d).powi(2)
            };
            assert!((axis.w[n as usize] - exact).abs() <= 1.0e-15, "{axis:?}");
        }
    }
}

proptest! {
    /// The mean of a hat over a piece of an axis, wherever the piece lies and however short it is, down to the hat itself.
    #[test]
    fn means_of_hats_of_any_piece(at in -3.0..3.0_f64, half in 0.0..1.0_f64) {
        let whole = weights::mean_of_hat(at, half);
        let parts = [-0.5, 0.5].map(|side| weights::mean_of_hat(at + side * half, 0.5 * half));
        prop_assert!((whole - 0.5 * (parts[0] + parts[1])).abs() < 1e-14, "{whole} {parts:?}");
        prop_assert!((weights::mean_of_hat(at, 0.0) - (1.0 - at.abs()).max(0.0)).abs() < 1e-15);
        let sum: f64 = (-5..=5).map(|n| weights::mean_of_hat(at - f64::from(n), half)).sum();
        prop_assert!((sum - 1.0).abs() < 1e-14);
        if half > 1e-3 {
            prop_assert!((whole - mean_of_hat(at, half)).abs() < 1e-12);
        }
    }
}

/// The base node is the floor, also where the compiler has no instruction for it, at whole numbers and a bit beside them.
#[test]
fn the_base_node_is_the_floor() {
    for nodes in [3, 4] {
        let offset = base_offset(nodes);
        for number in -2..40 {
            let whole = f64::from(number) + offset;
            for xi in [whole, whole.next_down(), whole.next_up(), whole + 0.3] {
                assert_eq!(base_node(xi, nodes), (xi - offset).floor(), "{xi}");
            }
        }
    }
}

/// A node that a domain reaches by round-off alone has neither weight nor gradient, and one that it reaches by more has both;
/// the others still sum to one and to zero.
#[test]
fn what_round_off_reaches_is_not_reached() {
    for l in [0.1, 0.25, 1.0 / 6.0, 0.5] {
        for side in [-1.0, 1.0] {
            for overlap in [
                0.0,
                1e-16,
                1e-12,
                0.5 * weights::ROUND_OFF,
                2.0 * weights::ROUND_OFF,
            ] {
                // The domain ends beside node 5, and reaches the one a cell beyond by the overlap.
                let xi = 5.0 + side * (overlap - l);
                let axis = Axis::at(Family::Gimp, 3, xi, l);
                let (w, g) = axis.of(5.0 + side);
                let reached = overlap > weights::ROUND_OFF;
                assert_eq!(
                    (w > 0.0, g != 0.0),
                    (reached, reached),
                    "{l} {side} {overlap}: {w} {g}"
                );
                let sums: [f64; 2] = [axis.w.iter().sum(), axis.g.iter().sum()];
                assert!(
                    (sums[0] - 1.0).abs() < 1e-15 && sums[1].abs() < 1e-15,
                    "{sums:?}"
                );
            }
        }
    }
}
