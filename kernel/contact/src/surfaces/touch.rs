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
//! The correction of the particle velocity that the technical manual has (algorithm 2, line 14) is not used: positions and
//! strains follow the nodes, which do not know of it; the load of the surface is then never a force at the nodes, and a body at
//! rest sinks with a speed of the order g dt. And why not a condition on the nodes beyond the surface: a node knows the surface
//! to a cell, and a body that slides over a tilted one meets a staircase of nodes that come and go. Here a block on a plane at
//! 30 degrees to the grid keeps its lowest particles on the plane to 3e-5 of a cell, and without friction slides as it should
//! to round-off.
//!
//! Left out: a particle touches the nearest triangle alone, so in a groove that is narrower than a particle the second
//! flank is met a step later. An undamped body that starts to slide keeps ringing; while it rings faster than it
//! slides, parts of it slip backwards or stick, and the friction of the whole is a little less than mu N.

use proctor_kernel::grid::Line;
use proctor_kernel::lanes::{Backend, Kernel, Lanes, SelectedLanes};
use std::ops::Range;

/// A node that touching particles reach.
#[derive(Clone, Debug, PartialEq)]
pub struct TouchedNode {
    /// Index in the grid.
    pub node: usize,
    /// The lowest number of the velocity fields that move together there: 0 the common one, then the layers.
    pub field: usize,
    /// The others, as places in [`SurfaceTouches::others`].
    pub others: Range<usize>,
    /// 1/m per axis \[1/kg\], and nothing; zero along axes in which a boundary prescribes the velocity.
    pub mobility: [f64; 4],
    /// Velocity after the equation of motion \[m/s\].
    pub velocity: [f64; 3],
    /// The part of it that the equation of motion gave \[m/s\].
    pub increment: [f64; 3],
    /// Change of velocity so far \[m/s\], and nothing.
    pub change: [f64; 4],
}

/// A node of a touching particle, as its place in [`SurfaceTouches::nodes`], and its weight per axis: beside a boundary the mirrored
/// part of a weight has the sign of the mirrored velocity.
pub type Weight = (usize, [f64; 4]);

/// A particle and a surface that it touches or may touch within the step.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceTouch {
    /// Its nodes, as places in [`SurfaceTouches::weights`].
    pub weights: Range<usize>,
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

impl SurfaceTouch {
    /// Impulse on the body \[N s\].
    #[must_use]
    pub fn impulse(&self) -> [f64; 3] {
        std::array::from_fn(|axis| {
            self.normal_impulse * self.normal[axis] + self.tangential_impulse[axis]
        })
    }

    /// True if the surface pushes the particle, and whether friction holds it.
    #[must_use]
    pub fn pushes_and_holds(&self) -> (bool, bool) {
        if self.floor == f64::NEG_INFINITY {
            return (true, self.friction == f64::INFINITY);
        }
        let held = self.friction * self.normal_impulse;
        let tau = dot(&self.tangential_impulse, &self.tangential_impulse);
        (
            self.normal_impulse > 0.0,
            // A slipping particle is on the cone to round-off.
            tau < held * held * (1.0 - 1e-9),
        )
    }
}

/// Response of the velocity of a touching point to impulses on it alone, all others held.
#[derive(Clone, Copy, Debug)]
struct Response {
    /// Along the normal \[1/kg\], and its inverse; both zero where a boundary holds the point in that direction.
    along: [f64; 2],
    /// The largest along any axis \[1/kg\], and its inverse.
    across: [f64; 2],
}

/// Particles that touch, and what they share. All lists are kept from step to step, so that a step takes no memory.
#[derive(Clone, Debug, Default)]
pub struct SurfaceTouches {
    /// Particles, in the order of their identifiers by surface and body.
    pub list: Vec<SurfaceTouch>,
    /// Nodes of one particle after the other.
    pub weights: Vec<Weight>,
    /// Nodes that any of them reaches.
    pub nodes: Vec<TouchedNode>,
    /// Further fields of one node after the other, by their numbers, increasing.
    pub others: Vec<usize>,
    responses: Vec<Response>,
}

impl SurfaceTouches {
    /// Forgets all particles and nodes.
    pub fn clear(&mut self) {
        self.list.clear();
        self.weights.clear();
        self.nodes.clear();
        self.others.clear();
    }

    /// Energy that the impulse of a touch takes from the nodes \[J\], by friction and along the normal: the
    /// impulse times the mean of the velocities over the surface before and after the step, with the sign turned.
    #[must_use]
    pub fn taken(&self, touch: &SurfaceTouch) -> [f64; 2] {
        let mut mean = touch.relative;
        for (n, w) in &self.weights[touch.weights.clone()] {
            let node = &self.nodes[*n];
            for axis in 0..3 {
                mean[axis] += w[axis] * (0.5 * (node.change[axis] - node.increment[axis]));
            }
        }
        [
            -dot(&touch.tangential_impulse, &mean),
            -touch.normal_impulse * dot(&touch.normal, &mean),
        ]
    }

    /// Finds the impulses of all touches, from those that they have; returns the number of sweeps. Sweeps end when none changes a
    /// velocity by more than `tolerance` times the largest that an impulse gave before or in the first sweep, or after `most`. Where
    /// penalty forces act beside them, they go on from there, for as many again.
    pub fn resolve(&mut self, lanes: SelectedLanes, tolerance: f64, most: usize) -> usize {
        for touch in self.list.iter_mut().filter(|t| t.penalty > 0.0) {
            touch.floor = 0.0;
        }
        self.responses.clear();
        for touch in &self.list {
            let response = self.response(touch);
            self.responses.push(response);
        }
        let mut scale = 0.0_f64;
        for (touch, response) in self.list.iter().zip(&self.responses) {
            let impulse = touch.impulse();
            if impulse != [0.0; 3] {
                let weights = &self.weights[touch.weights.clone()];
                give(&mut self.nodes, weights, &impulse);
                scale = scale.max(touch.normal_impulse.abs() * response.along[0]);
            }
        }
        let sweeps = self.sweep(lanes, [tolerance, scale], most);
        let mut pushed = false;
        for touch in &mut self.list {
            if touch.penalty > 0.0 && touch.normal_impulse <= 0.0 {
                touch.floor = touch.penalty;
                touch.normal_impulse = touch.penalty;
                let impulse = touch.normal.map(|n| n * touch.penalty);
                give(
                    &mut self.nodes,
                    &self.weights[touch.weights.clone()],
                    &impulse,
                );
                pushed = true;
            }
        }
        if pushed {
            sweeps + self.sweep(lanes, [tolerance, 0.0], most)
        } else {
            sweeps
        }
    }

    /// The response sum_I S_Ip² / m_I of the point of a touch.
    fn response(&self, touch: &SurfaceTouch) -> Response {
        let mut sum = [0.0_f64; 3];
        for (n, w) in &self.weights[touch.weights.clone()] {
            for axis in 0..3 {
                sum[axis] += w[axis] * w[axis] * self.nodes[*n].mobility[axis];
            }
        }
        let normal = touch.normal;
        let along: f64 = (0..3)
            .map(|axis| normal[axis] * normal[axis] * sum[axis])
            .sum();
        let across = sum.iter().fold(0.0_f64, |m, r| m.max(*r));
        let with_inverse = |response: f64| {
            if response > 0.0 {
                [response, 1.0 / response]
            } else {
                [0.0; 2]
            }
        };
        Response {
            along: with_inverse(along),
            across: with_inverse(across),
        }
    }

    /// Sweeps with a tolerance and the largest velocity that an impulse gave before them \[m/s\].
    fn sweep(&mut self, lanes: SelectedLanes, [tolerance, scale]: [f64; 2], most: usize) -> usize {
        lanes.run(Sweeps {
            list: &mut self.list,
            responses: &self.responses,
            weights: &self.weights,
            nodes: &mut self.nodes,
            tolerance,
            scale,
            most,
        })
    }

    /// The same where local damping acts, which resists by alpha times the unbalanced force. Contact is a part of what
    /// balances: damped without it, a body at rest on a surface would be carried by its damping, by a share alpha of its
    /// weight. So the damping of the touched nodes is taken back, the contact found, and both done again together.
    ///
    /// Returns what damping takes by this beyond what it took before \[J\].
    pub fn resolve_damped(
        &mut self,
        lanes: SelectedLanes,
        alpha: f64,
        tolerance: f64,
        most: usize,
    ) -> f64 {
        // Increment and velocity before it along an axis, where the node is free and damping had a direction.
        let damped = |node: &TouchedNode, axis: usize| {
            let dv = node.increment[axis];
            let before = node.velocity[axis] - dv;
            (node.mobility[axis] > 0.0 && before != 0.0).then_some((dv, before))
        };
        let undamped = |dv: f64, before: f64| {
            let kept = 1.0 - alpha * before.signum() * dv.signum();
            // A factor of 1 took everything; then there is nothing to give back.
            if kept > 0.0 { dv / kept } else { dv }
        };
        let goes_on = self.list.iter().any(|t| t.normal_impulse != 0.0);
        for node in &mut self.nodes {
            for axis in 0..3 {
                if let Some((dv, before)) = damped(node, axis) {
                    node.change[axis] = undamped(dv, before) - dv;
                }
            }
        }
        self.resolve(lanes, tolerance, most);
        let mut taken = 0.0;
        for node in &mut self.nodes {
            let mut change = [0.0; 4];
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
        if !goes_on {
            for touch in &mut self.list {
                touch.normal_impulse = 0.0;
                touch.tangential_impulse = [0.0; 3];
            }
        }
        self.resolve(lanes, tolerance, most);
        taken
    }

    /// Adds the changes of the nodes of one field to its velocities, and where asked for to their increments.
    pub fn apply(&self, field: usize, lines: &mut [Line], first_lane: usize, increments: bool) {
        for touched in &self.nodes {
            if touched.field != field && !self.others[touched.others.clone()].contains(&field) {
                continue;
            }
            let line = &mut lines[touched.node];
            for axis in 0..3 {
                line[first_lane + axis] += touched.change[axis];
                if increments {
                    line[4 + axis] += touched.change[axis];
                }
            }
        }
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Gives an impulse \[N s\] to the nodes of a touch.
fn give(nodes: &mut [TouchedNode], weights: &[Weight], impulse: &[f64; 3]) {
    for (n, w) in weights {
        let node = &mut nodes[*n];
        for axis in 0..3 {
            node.change[axis] += w[axis] * node.mobility[axis] * impulse[axis];
        }
    }
}

/// Sweeps over all touches: a vector and one unused lane are half a line.
struct Sweeps<'a> {
    list: &'a mut [SurfaceTouch],
    responses: &'a [Response],
    weights: &'a [Weight],
    nodes: &'a mut [TouchedNode],
    tolerance: f64,
    /// Largest velocity that an impulse gave before \[m/s\].
    scale: f64,
    most: usize,
}

impl Kernel for Sweeps<'_> {
    type Output = usize;

    #[inline(always)]
    fn run<B: Backend>(self) -> usize {
        let mut scale = self.scale;
        for sweep in 1..=self.most {
            let mut largest = 0.0_f64;
            for (touch, response) in self.list.iter_mut().zip(self.responses) {
                let weights = &self.weights[touch.weights.clone()];
                let changed = correct::<B::Half>(touch, response, weights, self.nodes);
                if changed > largest {
                    largest = changed;
                }
            }
            if sweep == 1 && largest > scale {
                scale = largest;
            }
            if largest <= self.tolerance * scale {
                return sweep;
            }
        }
        self.most
    }
}

/// a . b with multiply-add.
#[inline(always)]
fn dot_fused(a: &[f64; 4], b: &[f64; 3]) -> f64 {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

/// Velocity of a touching point over the surface with the impulses so far.
///
/// Four sums side by side, as each term of one waits for the term before it.
#[inline(always)]
fn velocity<H: Lanes>(touch: &SurfaceTouch, weights: &[Weight], nodes: &[TouchedNode]) -> [f64; 4] {
    let [x, y, z] = touch.relative;
    let zero = H::splat(0.0);
    let mut sums = [H::load(&[x, y, z, 0.0]), zero, zero, zero];
    let mut fours = weights.chunks_exact(4);
    for four in &mut fours {
        for (sum, (n, w)) in sums.iter_mut().zip(four) {
            *sum = H::load(w).mul_add(H::load(&nodes[*n].change), *sum);
        }
    }
    for (sum, (n, w)) in sums.iter_mut().zip(fours.remainder()) {
        *sum = H::load(w).mul_add(H::load(&nodes[*n].change), *sum);
    }
    let mut v = [0.0; 4];
    ((sums[0] + sums[1]) + (sums[2] + sums[3])).store(&mut v);
    v
}

/// Corrects one touch with all others held; returns the change of its velocity.
#[inline(always)]
fn correct<H: Lanes>(
    touch: &mut SurfaceTouch,
    response: &Response,
    weights: &[Weight],
    nodes: &mut [TouchedNode],
) -> f64 {
    let Response {
        along: [along, per_along],
        across: [across, per_across],
    } = *response;
    // Held by a boundary in the direction of the normal: nothing can move it.
    if along <= 0.0 {
        return 0.0;
    }
    let n = touch.normal;
    let v = velocity::<H>(touch, weights, nodes);
    let v_n = dot_fused(&v, &n);
    let mut normal_impulse = (touch.bound - v_n).mul_add(per_along, touch.normal_impulse);
    if normal_impulse < touch.floor {
        normal_impulse = touch.floor;
    }
    let step = normal_impulse - touch.normal_impulse;
    touch.normal_impulse = normal_impulse;
    let mut impulse = [n[0] * step, n[1] * step, n[2] * step, 0.0];
    let mut changed = step.abs() * along;
    if touch.friction > 0.0 {
        let mut wanted = [0.0; 4];
        for axis in 0..3 {
            let sliding = (-v_n).mul_add(n[axis], v[axis]);
            wanted[axis] = (-sliding).mul_add(per_across, touch.tangential_impulse[axis]);
        }
        let square = dot_fused(&wanted, &[wanted[0], wanted[1], wanted[2]]);
        let cap = if touch.friction < f64::INFINITY {
            touch.friction * normal_impulse
        } else {
            f64::INFINITY
        };
        if square > cap * cap {
            let share = cap / square.sqrt();
            for w in &mut wanted {
                *w *= share;
            }
        }
        for axis in 0..3 {
            let step = wanted[axis] - touch.tangential_impulse[axis];
            impulse[axis] += step;
            let moved = step.abs() * across;
            if moved > changed {
                changed = moved;
            }
            touch.tangential_impulse[axis] = wanted[axis];
        }
    }
    if impulse != [0.0; 4] {
        let impulse = H::load(&impulse);
        for (n, w) in weights {
            let node = &mut nodes[*n];
            let answer = H::load(w) * H::load(&node.mobility);
            answer
                .mul_add(impulse, H::load(&node.change))
                .store(&mut node.change);
        }
    }
    changed
}
