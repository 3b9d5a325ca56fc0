//! Rows of particles with B-splines that are no whole number in a cell: what they carry of one pressure.

use super::places::name;
use super::resting::{Rest, Support, all};
use crate::values::Scene;
use nalgebra::{DMatrix, DVector};
use proctor_kernel::model::Weighting;
use proctor_kernel::weights::{Family, axis_weights_at, base_node, spline_touching};

/// Deviation of a row from the pressure that is worth a warning, two cells and more from the load.
const OFF: f64 = 0.01;
/// The same within the cell at the support.
const OFF_BESIDE: f64 = 0.035;
/// Cells below a load on two rows of particles in which it is felt as what it is.
const FELT: f64 = 2.5;
/// Cells of a column that are looked at.
const MOST: f64 = 24.0;
/// Empty lines of the mesh kept behind the face.
const BEHIND: f64 = 2.0;
/// Stiffness of nodes that no row reaches, over that of a cell.
const EMPTY: f64 = 1e-13;

/// Bodies whose rows do not carry a pressure evenly.
///
/// The sum over particles of V grad S is not the integral of grad S unless rows are 1, 1/2, 1/3 … of a cell apart, so that one
/// stress in all rows is no equilibrium. What is one follows from the rows alone, in a column one particle wide: of 29 driven
/// columns that this gives more than 2 % in a row, 23 are off by that in runs of every scheme, transfer and dimension, to three
/// digits of it with an affine transfer and USL.
pub(super) fn uneven(scene: &Scene) -> Vec<String> {
    if scene.weighting != Weighting::QuadraticBSpline {
        return vec![];
    }
    let of = |rest: &Rest<'_>| {
        let (axis, length) = (rest.axis, rest.length(scene, rest.axis));
        let spacing = length / rest.rows(scene, axis);
        let rows = (length.min(MOST) / spacing).round() as usize;
        let beyond = rest.beyond(scene, axis, rest.side);
        let face = if beyond > 0.0 { 1.0 - beyond } else { 0.0 };
        let shares = shares(face, spacing, rows, rest.on)?;
        let felt = rows as f64 * spacing - 2.0 * spacing - FELT;
        let (mut least, mut most, mut is_off) = (1.0_f64, 1.0_f64, false);
        for (row, share) in shares.iter().enumerate() {
            let height = spacing * (row as f64 + 0.5);
            if height < felt {
                (least, most) = (least.min(*share), most.max(*share));
                let bound = if height < 1.0 { OFF_BESIDE } else { OFF };
                is_off |= (share - 1.0).abs() > bound;
            }
        }
        let per_cell = rest.body.particles_per_cell[axis];
        is_off.then(|| {
            format!(
                "{}: rows of particles are {spacing:.4} of a cell apart, no whole number in one: with B-splines rows under one \
                 pressure carry between {least:.3} and {most:.3} of it, whatever scheme and transfer; rows of 1/{per_cell} of a \
                 cell carry it evenly, and so do \"GIMP\" and \"cpGIMP\" with any",
                name(rest.body)
            )
        })
    };
    all(scene).iter().filter_map(of).collect()
}

/// Stress of each row over the pressure, from the support on: a column of rows that are pressed by forces on the two rows at its
/// other end, at rest. `face` is where it rests, in cells above a line of the mesh, `spacing` the distance of the rows in cells.
/// `None` where no rest is found.
///
/// A driven body pushes no node away from itself: a weight below zero, which the third node of a face may have, counts as none there. Rows
/// near the face then carry up to 2.2 % less (spacing 0.4624, face at 0.368: 0.9781 of the pressure, in runs as well).
fn shares(face: f64, spacing: f64, rows: usize, on: Support) -> Option<Vec<f64>> {
    if rows < 2 {
        return None;
    }
    let nodes = (BEHIND + face + rows as f64 * spacing).ceil() as usize + 3;
    let middles = (0..rows).map(|row| BEHIND + face + spacing * (row as f64 + 0.5));
    let reached: Vec<(usize, [f64; 3], [f64; 3])> = middles
        .map(|xi| {
            let (base, w, g) = axis_weights_at::<3>(Family::Gimp, xi, 0.5);
            (base as usize, w, g)
        })
        .collect();
    // Unknowns: displacements of the nodes, and the force of the support.
    let mut equations = DMatrix::<f64>::zeros(nodes + 1, nodes + 1);
    let mut forces = DVector::<f64>::zeros(nodes + 1);
    for (row, (base, w, g)) in reached.iter().enumerate() {
        for a in 0..3 {
            for b in 0..3 {
                equations[(base + a, base + b)] += spacing * g[a] * g[b];
            }
            if row + 2 >= rows {
                forces[base + a] -= 0.5 * w[a];
            }
        }
    }
    for node in 0..nodes {
        equations[(node, node)] += EMPTY;
    }
    // The first row touches the support, with the weights that contact has there.
    let xi = BEHIND + face + 0.5 * spacing;
    let base = base_node(xi, 3);
    let mut touching = spline_touching(xi - base, 0.5 * spacing, -0.5 * spacing);
    if on == Support::Driven {
        touching = touching.map(|w| w.max(0.0));
        let sum: f64 = touching.iter().sum();
        touching = touching.map(|w| w / sum);
    }
    for (n, w) in touching.iter().enumerate() {
        let node = base as usize + n;
        equations[(node, nodes)] += w;
        equations[(nodes, node)] += w;
    }
    let moved = equations.lu().solve(&forces)?;
    let stress = |(base, _, g): &(usize, [f64; 3], [f64; 3])| {
        -(0..3).map(|n| g[n] * moved[base + n]).sum::<f64>()
    };
    Some(reached.iter().map(stress).collect())
}
