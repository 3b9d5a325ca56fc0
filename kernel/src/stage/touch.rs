//! Particles that touch a rigid surface: impulses at the nodes, such that none goes through the surface.
//!
//! A particle p with gap g_p touches a surface with the point of its domain that is nearest to it. That point moves with
//! sum_I S_Ip v_I, where S_Ip are the weights of the domain there and not those of its centre, so what keeps it out is a
//! bound on that very sum,
//!
//! n . (sum_I S_Ip v_I - v_s) >= -max(g_p, 0) / dt,
//!
//! with the normal n and the velocity v_s of the surface. The impulse that it takes, lambda n + tau, goes to the nodes
//! with the same weights, dv_I = S_Ip (lambda n + tau) / m_I, so that the momentum given to the nodes is the impulse.
//! They are the weights at which a row of particles under one stress ends, so that a surface balances that stress and the
//! layer on it is strained as what lies behind it: with the weights of the centre its stress is 0.14 to 1.5 times that of
//! a block that is pressed. lambda >= 0: the surface never pulls.
//! |tau| <= mu lambda, against the sliding of the particle (Coulomb).
//!
//! Particles share nodes, so the impulses are found together, by sweeps over the particles in the order of their
//! identifiers, each of which corrects one particle with all others held: projected Gauss-Seidel (Moreau 1999,
//! contact dynamics). A sweep changes nothing else than the impulses, so momentum balances after every sweep; a
//! residue is an error of the gap, never of the balance.
//!
//! Why not the correction of the particle velocity that the technical manual has (algorithm 2, line 14): positions
//! and strains follow the nodes, which do not know of it; what the surface carries is then never a force at the nodes,
//! and a body at rest sinks with a speed of the order g dt. And why not a condition on the nodes beyond the surface:
//! a node knows the surface to a cell, and a body that slides over a tilted one meets a staircase of nodes that come
//! and go. Here a block on a plane at 30 degrees to the grid keeps its lowest particles on the plane to 3e-5 of a
//! cell, and without friction slides as it should to round-off.
//!
//! Left out: a particle touches the nearest triangle alone, so in a groove that is narrower than a particle the second
//! flank is met a step later. An undamped body that starts to slide keeps ringing; while it rings faster than it
//! slides, parts of it slip backwards or stick, and the friction of the whole is a little less than mu N.

use crate::grid::Line;

/// A node that touching particles reach.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchedNode {
    /// Index in the grid.
    pub node: usize,
    /// Velocity fields that move together there, by their numbers: 0 the common one, then the layers.
    pub fields: Vec<usize>,
    /// 1/m per axis \[1/kg\]; zero along axes in which a boundary prescribes the velocity.
    pub mobility: [f64; 3],
    /// Change of velocity so far \[m/s\].
    pub change: [f64; 3],
}

/// A particle and a surface that it touches or may touch within the step.
#[derive(Clone, Debug, PartialEq)]
pub struct Touch {
    /// Nodes, as places in the list of touched nodes, and weight per axis: beside a boundary the mirrored part of a
    /// weight has the sign of the mirrored velocity.
    pub weights: Vec<(usize, [f64; 3])>,
    /// Unit normal of the surface, away from it.
    pub normal: [f64; 3],
    /// Velocity of the touching point over the surface before contact, sum_I S_Ip v_I - v_s \[m/s\].
    pub relative: [f64; 3],
    /// Gap before the step \[m\], negative where the particle reaches through.
    pub gap: f64,
    /// Smallest normal velocity that is let through \[m/s\], zero or negative.
    pub bound: f64,
    /// Smallest normal impulse \[N s\]: 0, or that of the penalty force; minus infinity makes the bound an equation.
    pub floor: f64,
    /// Impulse of the penalty force \[N s\]: the floor of a particle that reaches through and that nothing presses. One that
    /// is pressed is as near as its own strain lets it be.
    pub penalty: f64,
    /// Coefficient of friction; infinite for a particle that sticks whatever the normal impulse.
    pub friction: f64,
    /// Normal impulse found \[N s\].
    pub normal_impulse: f64,
    /// Tangential impulse found \[N s\].
    pub tangential_impulse: [f64; 3],
}

impl Touch {
    /// Impulse on the body \[N s\].
    #[must_use]
    pub fn impulse(&self) -> [f64; 3] {
        std::array::from_fn(|axis| {
            self.normal_impulse * self.normal[axis] + self.tangential_impulse[axis]
        })
    }

    /// Whether the surface pushes the particle, and whether friction holds it.
    #[must_use]
    pub fn pushes_and_holds(&self) -> (bool, bool) {
        let held = self.friction * self.normal_impulse;
        let tau = dot(&self.tangential_impulse, &self.tangential_impulse);
        (
            self.normal_impulse > 0.0,
            // A slipping particle is on the cone to round-off.
            tau < held * held * (1.0 - 1e-9),
        )
    }

    /// What the impulse takes from the kinetic energy of the nodes \[J\], by friction and along the normal: the impulse
    /// times the mean of the velocities over the surface before and after the step, with the sign turned. `line` gives a
    /// node after the solve, before the changes are applied.
    #[must_use]
    pub fn taken<'a>(
        &self,
        nodes: &[TouchedNode],
        line: impl Fn(&TouchedNode) -> &'a Line,
    ) -> [f64; 2] {
        let mut mean = self.velocity(nodes);
        for axis in 0..3 {
            let mut before = self.relative[axis];
            for (n, w) in &self.weights {
                before -= w[axis] * line(&nodes[*n])[4 + axis];
            }
            mean[axis] = 0.5 * (mean[axis] + before);
        }
        [
            -dot(&self.tangential_impulse, &mean),
            -self.normal_impulse * dot(&self.normal, &mean),
        ]
    }

    /// Response sum_I S_Ip² / m_I per axis \[1/kg\].
    fn response(&self, nodes: &[TouchedNode]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (n, w) in &self.weights {
            for axis in 0..3 {
                sum[axis] += w[axis] * w[axis] * nodes[*n].mobility[axis];
            }
        }
        sum
    }

    fn give(&self, nodes: &mut [TouchedNode], impulse: &[f64; 3]) {
        for (n, w) in &self.weights {
            let node = &mut nodes[*n];
            for axis in 0..3 {
                node.change[axis] += w[axis] * node.mobility[axis] * impulse[axis];
            }
        }
    }

    /// Velocity over the surface with the impulses so far.
    fn velocity(&self, nodes: &[TouchedNode]) -> [f64; 3] {
        let mut v = self.relative;
        for (n, w) in &self.weights {
            for axis in 0..3 {
                v[axis] += w[axis] * nodes[*n].change[axis];
            }
        }
        v
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Finds the impulses of all touches; returns the number of sweeps. Sweeps end when none changes a velocity by more
/// than `tolerance` times the largest change of the first one, or after `most`. Where penalty forces act beside them, they
/// go on from there, for as many again.
pub fn resolve(
    touches: &mut [Touch],
    nodes: &mut [TouchedNode],
    tolerance: f64,
    most: usize,
) -> usize {
    let responses: Vec<[f64; 3]> = touches.iter().map(|t| t.response(nodes)).collect();
    for touch in touches.iter_mut().filter(|t| t.penalty > 0.0) {
        touch.floor = 0.0;
    }
    let sweeps = sweep(touches, &responses, nodes, tolerance, most);
    let mut pushed = false;
    for touch in touches.iter_mut() {
        if touch.penalty > 0.0 && touch.normal_impulse <= 0.0 {
            touch.floor = touch.penalty;
            touch.normal_impulse = touch.penalty;
            let impulse = touch.normal.map(|n| n * touch.penalty);
            touch.give(nodes, &impulse);
            pushed = true;
        }
    }
    if pushed {
        sweeps + sweep(touches, &responses, nodes, tolerance, most)
    } else {
        sweeps
    }
}

fn sweep(
    touches: &mut [Touch],
    responses: &[[f64; 3]],
    nodes: &mut [TouchedNode],
    tolerance: f64,
    most: usize,
) -> usize {
    let mut first = 0.0;
    for sweep in 1..=most {
        let mut largest = 0.0_f64;
        for (touch, response) in touches.iter_mut().zip(responses) {
            largest = largest.max(correct(touch, response, nodes));
        }
        if sweep == 1 {
            first = largest;
        }
        if largest <= tolerance * first {
            return sweep;
        }
    }
    most
}

/// The same where local damping acts, which resists by alpha times the unbalanced force. Contact is a part of what
/// balances: damped without it, a body at rest on a surface would be carried by its damping, by a share alpha of its
/// weight. So the damping of the touched nodes is taken back, the contact found, and both done again together.
///
/// `line` gives a node after the damped solve. Returns what damping takes by this beyond what it took before \[J\].
pub fn resolve_damped<'a>(
    touches: &mut [Touch],
    nodes: &mut [TouchedNode],
    line: impl Fn(&TouchedNode) -> &'a Line,
    alpha: f64,
    tolerance: f64,
    most: usize,
) -> f64 {
    // Increment and velocity before it along an axis, where the node is free and damping had a direction.
    let damped = |node: &TouchedNode, axis: usize| {
        let line = line(node);
        let (dv, before) = (line[4 + axis], line[1 + axis] - line[4 + axis]);
        (node.mobility[axis] > 0.0 && before != 0.0).then_some((dv, before))
    };
    let undamped = |dv: f64, before: f64| {
        let kept = 1.0 - alpha * before.signum() * dv.signum();
        // A factor of 1 took everything; then there is nothing to give back.
        if kept > 0.0 { dv / kept } else { dv }
    };
    for node in nodes.iter_mut() {
        for axis in 0..3 {
            if let Some((dv, before)) = damped(node, axis) {
                node.change[axis] = undamped(dv, before) - dv;
            }
        }
    }
    resolve(touches, nodes, tolerance, most);
    let mut taken = 0.0;
    for node in nodes.iter_mut() {
        let mut change = [0.0; 3];
        for axis in 0..3 {
            if let Some((dv, before)) = damped(node, axis) {
                let unbalanced = dv + node.change[axis];
                change[axis] =
                    undamped(dv, before) - dv - alpha * unbalanced.abs() * before.signum();
                let mean = before + 0.5 * (dv + change[axis]);
                taken -= change[axis] / node.mobility[axis] * mean;
            }
        }
        node.change = change;
    }
    for touch in touches.iter_mut() {
        touch.normal_impulse = 0.0;
        touch.tangential_impulse = [0.0; 3];
    }
    resolve(touches, nodes, tolerance, most);
    taken
}

/// Corrects one touch with all others held; returns the change of its velocity.
fn correct(touch: &mut Touch, response: &[f64; 3], nodes: &mut [TouchedNode]) -> f64 {
    let n = touch.normal;
    let along: f64 = (0..3).map(|axis| n[axis] * n[axis] * response[axis]).sum();
    // Held by a boundary in the direction of the normal: nothing can move it.
    if along <= 0.0 {
        return 0.0;
    }
    let v = touch.velocity(nodes);
    let short = touch.bound - dot(&v, &n);
    let normal_impulse = (touch.normal_impulse + short / along).max(touch.floor);
    let step = normal_impulse - touch.normal_impulse;
    let mut impulse = n.map(|c| c * step);
    touch.normal_impulse = normal_impulse;
    let mut changed = step.abs() * along;
    if touch.friction > 0.0 {
        let across = response.iter().fold(0.0_f64, |m, r| m.max(*r));
        let v_n = dot(&v, &n);
        let wanted: [f64; 3] = std::array::from_fn(|axis| {
            touch.tangential_impulse[axis] - (v[axis] - v_n * n[axis]) / across
        });
        let size = dot(&wanted, &wanted).sqrt();
        let cap = if touch.friction.is_finite() {
            touch.friction * normal_impulse
        } else {
            f64::INFINITY
        };
        let share = if size > cap { cap / size } else { 1.0 };
        for axis in 0..3 {
            let next = share * wanted[axis];
            let step = next - touch.tangential_impulse[axis];
            impulse[axis] += step;
            changed = changed.max(step.abs() * across);
            touch.tangential_impulse[axis] = next;
        }
    }
    if impulse != [0.0; 3] {
        touch.give(nodes, &impulse);
    }
    changed
}

/// Adds the changes of the nodes of one field to its velocities, and where asked for to their increments.
pub fn apply(
    nodes: &[TouchedNode],
    field: usize,
    lines: &mut [Line],
    first_lane: usize,
    increments: bool,
) {
    for touched in nodes.iter().filter(|t| t.fields.contains(&field)) {
        let line = &mut lines[touched.node];
        for axis in 0..3 {
            line[first_lane + axis] += touched.change[axis];
            if increments {
                line[4 + axis] += touched.change[axis];
            }
        }
    }
}
