//! Weighting functions S_Ip along one axis, and their derivatives.
//!
//! One local coordinate per particle and axis decides everything: with xi = x/h measured from the mesh
//! origin, the base node is b = floor(xi - 1/2) and f = xi - b lies in [1/2, 3/2), so that every function with
//! l_p <= h/2 touches exactly the nodes b, b+1, b+2. With l = l_p/h (Steffen et al. 2008; technical manual,
//! section 2, S_Ip piecewise):
//!
//! - uGIMP and cpGIMP: w_0 = 1 - f for f < 1 - l, (1 + l - f)²/(4 l) up to 1 + l, then 0; w_2 is its mirror
//!   image (f -> 2 - f); w_1 = 1 - w_0 - w_2;
//! - l = 1/2 is the quadratic B-spline;
//! - the linear hat is the limit l -> 0, written out because its derivative jumps at f = 1.
//!
//! A hat reaches two nodes, b = floor(xi) and b + 1 with w_0 = 1 - f and w_1 = f, but for a particle that lies on a node to the
//! last bit: there the mean of both sides has derivatives at three. The stages take two where they can.
//!
//! A cpGIMP domain with h/2 < l_p <= h needs four nodes: b = floor(xi - 1), f in [1, 2), and
//! w_0 = (1 + l - f)²/(4 l), w_3 its mirror image (f -> 3 - f); partition of unity and linear reproduction
//! then fix w_1 = 2 - f - 2 w_0 + w_3 and w_2 = f - 1 + w_0 - 2 w_3.
//!
//! All weights are formed from differences in [0, 2], so a mesh origin at 1e6 m changes nothing, and none of
//! them is negative.

use crate::lanes::Lanes;

/// Family of weighting functions of a particle set; the half-length comes with the particle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Linear hat.
    Hat,
    /// GIMP with a half-length (the quadratic B-spline is half a cell).
    Gimp,
}

impl Family {
    /// Nodes per axis of the stages that map and gather, for a scene of which particles reach `stencil`: with hats two, and
    /// one before them for a particle that lies on a node.
    #[must_use]
    pub const fn stage_nodes(self, stencil: usize) -> usize {
        match self {
            Self::Hat => 2,
            Self::Gimp => stencil,
        }
    }

    /// Offset of the cells by which particles are sorted: those which have the same nodes in the stages are together, and
    /// `stencil` nodes from that cell on are all that they reach.
    #[must_use]
    pub(crate) const fn sort_offset(self, stencil: usize) -> f64 {
        match self {
            Self::Hat => 1.0,
            Self::Gimp => base_offset(stencil),
        }
    }
}

/// Overlap in cells up to which a domain meets the cells around a node by round-off alone.
///
/// A domain that ends on a node ends an ulp before or behind it, by how its position was rounded, and positions are sums over many
/// steps. More would let what rests on a line come and go: with MUSL and cpGIMP a pressed block lost a tenth of its stress at
/// 1e-8, as without any it loses 0.035. With an overlap d the node would have a weight ~ d² and a
/// gradient ~ d; from the mass m w and the force V sigma g it gets a velocity ~ 1/d, and the particle from it a strain rate
/// that does not depend on d. So a node that is reached by round-off is not reached: it has no weight and no gradient. This is
/// the one test of where a domain ends, for all that weighs, prescribes, touches or loads.
pub const ROUND_OFF: f64 = 1e-11;

/// Largest weight of a node that counts as none: hats have no domain, and their weight grows as the overlap itself. Domains
/// have no such weights, as [`ROUND_OFF`] is in their function.
#[must_use]
#[inline]
pub fn round_off_weight(family: Family) -> f64 {
    match family {
        Family::Hat => ROUND_OFF,
        Family::Gimp => 0.0,
    }
}

/// Weights along an axis, those of nodes that are reached by round-off alone set to zero.
#[must_use]
pub fn reached<const N: usize>(weights: [f64; N], round_off: f64) -> [f64; N] {
    weights.map(|w| if w > round_off { w } else { 0.0 })
}

/// Overlap of a domain with the cells around a node, in cells: none where it is round-off. With it, the lanes that overlap.
#[inline(always)]
fn overlap<L: Lanes>(reach: L) -> (L, L::Mask) {
    let reached = L::splat(ROUND_OFF).lt(reach);
    (L::select(reached, reach, L::splat(0.0)), reached)
}

/// Offset of the base: b = floor(xi - `base_offset(N)`).
#[inline(always)]
#[must_use]
pub const fn base_offset(nodes: usize) -> f64 {
    match nodes {
        2 => 0.0,
        3 => 0.5,
        _ => 1.0,
    }
}

/// Base node of a place in cells: the largest whole number that is not above it less the offset of the stencil.
///
/// `f64::floor` is a call of the C library where the compiler may not take the instruction for it; the same number
/// without it.
#[inline]
#[must_use]
pub fn base_node(xi: f64, nodes: usize) -> f64 {
    below(xi - base_offset(nodes))
}

/// The largest whole number that is not above a number.
#[inline]
#[must_use]
pub(crate) fn below(x: f64) -> f64 {
    if cfg!(target_feature = "sse4.1") {
        return x.floor();
    }
    let toward_zero = x as i64 as f64;
    if toward_zero > x {
        toward_zero - 1.0
    } else {
        toward_zero
    }
}

/// Weights and derivatives d/dxi at the `N` nodes of one axis.
///
/// `f` is the coordinate from the base node in cells, in [1/2, 3/2) for `N` = 3 and [1, 2) for `N` = 4; `l` is
/// the half-length of the particle domain in cells, 0 < l <= 1/2 or 1 (unused for hats, which have `N` = 3).
#[inline(always)]
pub fn axis_weights<L: Lanes, const N: usize>(family: Family, f: L, l: L) -> ([L; N], [L; N]) {
    if family == Family::Hat && N == 3 {
        hat_weights::<L, N>(f)
    } else {
        gimp_weights::<L, N>(f, l, L::splat(1.0) / (L::splat(4.0) * l))
    }
}

/// [`axis_weights`] of the linear hat, `N` = 3.
#[inline(always)]
pub(crate) fn hat_weights<L: Lanes, const N: usize>(f: L) -> ([L; N], [L; N]) {
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let before = f.lt(one);
    let (mut g_0, mut g_2) = (L::select(before, -one, zero), L::select(before, zero, one));
    let tie = f.eq(one);
    // Asked for the whole group, as hardly a particle lies on a node to the last bit.
    if L::bits(tie) != 0 {
        // There the mean of both sides, the limit of GIMP: the neighbours have no weight, and where they have no mass either,
        // what they would give and take has to cancel.
        let half = L::splat(0.5);
        g_0 = L::select(tie, -half, g_0);
        g_2 = L::select(tie, half, g_2);
    }
    closed::<L, N>((one - f).max(zero), (f - one).max(zero), g_0, g_2)
}

/// Weights and derivatives d/dxi of hats at the two nodes around a particle, `f` cells from the first, in (0, 1).
#[inline(always)]
pub(crate) fn hat_pair<L: Lanes, const N: usize>(f: L) -> ([L; N], [L; N]) {
    let one = L::splat(1.0);
    let mut w = [one - f; N];
    let mut g = [-one; N];
    w[1] = f;
    g[1] = one;
    (w, g)
}

/// The same at three nodes of which the second is at most `f` cells before the particle, in [0, 1): where some particles lie on
/// it. All others have the numbers of [`hat_pair`], and nothing at the first node.
#[inline(always)]
pub(crate) fn hat_triple<L: Lanes, const N: usize>(f: L) -> ([L; N], [L; N]) {
    let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
    let tie = f.eq(zero);
    let mut w = [zero; N];
    let mut g = [L::select(tie, -half, zero); N];
    w[1] = one - f;
    w[2] = f;
    g[1] = L::select(tie, zero, -one);
    g[2] = L::select(tie, half, one);
    (w, g)
}

/// [`axis_weights`] of GIMP, with `quarter` = 1/(4 l).
#[inline(always)]
pub(crate) fn gimp_weights<L: Lanes, const N: usize>(f: L, l: L, quarter: L) -> ([L; N], [L; N]) {
    let (zero, one, two) = (L::splat(0.0), L::splat(1.0), L::splat(2.0));
    if N == 4 {
        let mut w = [zero; N];
        let mut g = [zero; N];
        // As below: 1 - f and f - 2 are exact, l comes last.
        let (lower, _) = overlap(l + (one - f));
        let (upper, _) = overlap(l + (f - two));
        w[0] = lower * lower * quarter;
        w[3] = upper * upper * quarter;
        w[1] = two - f - two * w[0] + w[3];
        w[2] = f - one + w[0] - two * w[3];
        g[0] = -(two * lower * quarter);
        g[3] = two * upper * quarter;
        g[1] = -one - two * g[0] + g[3];
        g[2] = one + g[0] - two * g[3];
        return (w, g);
    }
    // f - 1 is exact; adding l last keeps the small sums exact to their own round-off, so that
    // derivatives, which divide them by l, are good for small l too.
    let below = one - f;
    let above = f - one;
    let (lower, reaches_lower) = overlap(l + below);
    let (upper, reaches_upper) = overlap(l + above);
    // A domain that does not reach the cells on one side of the middle node is linear on the other.
    closed::<L, N>(
        L::select(reaches_upper, lower * lower * quarter, below),
        L::select(reaches_lower, upper * upper * quarter, above),
        L::select(reaches_upper, -(two * lower * quarter), -one),
        L::select(reaches_lower, two * upper * quarter, one),
    )
}

/// Turns derivatives d/dxi of GIMP along the radius into those of a ring: the integral of N' r over the particle domain in the
/// place of that of N', over its length and the radius of the particle.
///
/// A node inside the domain parts it into a piece below and one above, whose mean radii differ: its derivative falls by
/// kappa = (l² - (f - n)²)/(2 l rho), and those of its neighbours rise by half of that. So they sum to zero and keep linear fields.
/// On the axis kappa is zero, as the mirror image of the domain fills what it leaves.
///
/// `first` is the radius of the first node in cells, `inverse_radius` one over that of the particle.
#[inline(always)]
pub(crate) fn weigh_by_radius<L: Lanes, const N: usize>(
    g: &mut [L; N],
    f: L,
    [l, quarter]: [L; 2],
    first: L,
    inverse_radius: L,
) {
    let (zero, half, two) = (L::splat(0.0), L::splat(0.5), L::splat(2.0));
    for n in 1..N - 1 {
        let node = L::splat(n as f64);
        let off = f - node;
        let (below, _) = overlap(l - off);
        let (above, _) = overlap(l + off);
        let kappa = two * quarter * below * above * inverse_radius;
        let kappa = L::select(zero.lt(first + node), kappa, zero);
        g[n - 1] = half.mul_add(kappa, g[n - 1]);
        g[n] = g[n] - kappa;
        g[n + 1] = half.mul_add(kappa, g[n + 1]);
    }
}

/// Three weights and derivatives from the outer ones: they sum to one and to zero.
#[inline(always)]
fn closed<L: Lanes, const N: usize>(w_0: L, w_2: L, g_0: L, g_2: L) -> ([L; N], [L; N]) {
    let mut w = [w_0; N];
    let mut g = [g_0; N];
    w[2] = w_2;
    w[1] = L::splat(1.0) - w_0 - w_2;
    g[2] = g_2;
    g[1] = -(g_0 + g_2);
    (w, g)
}

/// Factors of gradients of least squares, in the place of derivatives d/dxi of quadratic B-splines: weight times distance over
/// `D_p`, which is 1/4 in cells, at the nodes of an axis (Hu et al. 2018, eq. 18).
#[inline(always)]
pub(crate) fn least_squares_weights<L: Lanes, const N: usize>(f: L, w: &[L; N]) -> [L; N] {
    let mut g = *w;
    for n in 0..N {
        g[n] = w[n] * (L::splat(4.0) * (L::splat(n as f64) - f));
    }
    g
}

/// Weights of the mean of a linear field over the cells in which a particle domain lies, from the derivatives d/dxi of its
/// weights along the axis: half of the part of the domain in the cell below a node, and half of that in the cell above.
///
/// The derivative of a linear hat is 1 in the cell below its node and -1 in the one above, so that minus the sum of the
/// derivatives up to a node is the part of the domain in the cell above that node. That holds for all families.
#[inline(always)]
pub(crate) fn cell_mean_weights<L: Lanes, const N: usize>(g: &[L; N]) -> [L; N] {
    let half = L::splat(0.5);
    let mut weights = *g;
    let mut below = L::splat(0.0);
    for n in 0..N {
        let above = below - g[n];
        weights[n] = half * (below + above);
        below = above;
    }
    weights
}

/// The same along a radius: weights of the mean of a linear field over the rings of these cells, and those of the mean of the radial
/// and the hoop strain together, (r_{I+1} v_{I+1} - r_I v_I)/(r_c h) in the cell between two nodes about the radius r_c, times h.
/// `first` is the radius of the first node in cells. Beyond the axis both are those of the mirror image.
#[inline(always)]
pub(crate) fn ring_mean_weights<L: Lanes, const N: usize>(g: &[L; N], first: L) -> [[L; N]; 2] {
    let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
    let inverse = |radius: L| {
        // No particle lies in a cell whose middle is on the axis, where nodes are not.
        let is_ring = zero.lt(radius * radius);
        L::select(is_ring, one / L::select(is_ring, radius, one), zero)
    };
    let tilt = L::splat(1.0 / 12.0);
    let (mut means, mut strains) = (*g, *g);
    let (mut below, mut inverse_below) = (zero, zero);
    for n in 0..N {
        let node = first + L::splat(n as f64);
        let (above, inverse_above) = (below - g[n], inverse(node + half));
        let sum = half * (below + above);
        means[n] = tilt.mul_add(below * inverse_below - above * inverse_above, sum);
        strains[n] = node * (below * inverse_below - above * inverse_above);
        (below, inverse_below) = (above, inverse_above);
    }
    [means, strains]
}

/// Weights of one particle along one axis in plain numbers: base node and `N` weights and derivatives d/dxi.
///
/// For set-up and tests; the stages use [`axis_weights`] in lanes.
#[must_use]
#[inline]
pub fn axis_weights_at<const N: usize>(
    family: Family,
    xi: f64,
    l: f64,
) -> (f64, [f64; N], [f64; N]) {
    let ([base], [w], [g]) = weights_at::<N, 1>(family, [xi], l);
    (base, w, g)
}

/// Mean of the hat of a node over a piece of an axis with half-length `half`, in cells, whose middle is `distance` cells from
/// the node; the hat itself where it has no length.
///
/// The numbers of [`axis_weights_at`] for a particle hold for pieces of any place and length, next to which a particle reaches more
/// nodes than a stencil has.
#[must_use]
#[inline]
pub fn mean_of_hat(distance: f64, half: f64) -> f64 {
    let d = distance.abs();
    if half > 0.5 {
        // From the integral of the hat up to a point; half of what the piece is long is no small number.
        let up_to = |x: f64| {
            let x = x.clamp(-1.0, 1.0);
            0.5 + x - 0.5 * x * x.abs()
        };
        (up_to(d + half) - up_to(d - half)) / (2.0 * half)
    } else if d + half <= 1.0 && d >= half {
        1.0 - d
    } else if d < half {
        1.0 - (d * d + half * half) / (2.0 * half)
    } else {
        let inside = (1.0 + half - d).max(0.0);
        if inside > 0.0 {
            inside * inside / (4.0 * half)
        } else {
            0.0
        }
    }
}

/// Weights along an axis of a particle with a B-spline, `f` cells from its base node and of half-length `half`, at the point that
/// is off its centre by `offset`, where the B-spline is no whole number of particles long.
///
/// At a face they are those at which rows of such particles under one stress end. Of the three nodes that beyond the face is
/// reached by the first rows alone and has the sum of V grad `S_Ip` over them; the two others follow, as the weights sum to
/// one and their mean place is the face. Between centre and face both are mixed.
#[must_use]
#[inline]
pub fn spline_touching(f: f64, half: f64, offset: f64) -> [f64; 3] {
    let (_, centre, _) = axis_weights_at::<3>(Family::Gimp, f, 0.5);
    let share = (offset.abs() / half).min(1.0);
    // From the node beyond the face.
    let from = if offset < 0.0 { f } else { 2.0 - f };
    let mut beyond = 0.0;
    let mut left = 1.5 - from;
    while left > 0.0 {
        beyond += 2.0 * half * left;
        left -= 2.0 * half;
    }
    let face = from - half;
    let mut at_face = [beyond, 2.0 - face - 2.0 * beyond, face - 1.0 + beyond];
    if offset > 0.0 {
        at_face.reverse();
    }
    std::array::from_fn(|n| (1.0 - share) * centre[n] + share * at_face[n])
}

/// Weights of one point along `D` axes at once, each as [`axis_weights_at`] has them, in the lanes of one line (D <= 8).
#[must_use]
pub fn weights_at<const N: usize, const D: usize>(
    family: Family,
    xi: [f64; D],
    l: f64,
) -> ([f64; D], [[f64; N]; D], [[f64; N]; D]) {
    struct Axes<const N: usize, const D: usize>(Family, [f64; 8], f64);
    impl<const N: usize, const D: usize> crate::lanes::Kernel for Axes<N, D> {
        type Output = ([[f64; N]; D], [[f64; N]; D]);
        #[inline(always)]
        fn run<B: crate::lanes::Backend>(self) -> Self::Output {
            let (w, g) =
                axis_weights::<B::Line, N>(self.0, B::Line::load(&self.1), B::Line::splat(self.2));
            let (mut w_out, mut g_out) = ([[0.0; N]; D], [[0.0; N]; D]);
            for n in 0..N {
                let (mut all_w, mut all_g) = ([0.0; 8], [0.0; 8]);
                w[n].store(&mut all_w);
                g[n].store(&mut all_g);
                for axis in 0..D {
                    w_out[axis][n] = all_w[axis];
                    g_out[axis][n] = all_g[axis];
                }
            }
            (w_out, g_out)
        }
    }
    let base = xi.map(|xi| base_node(xi, N));
    let mut within = [0.0; 8];
    for axis in 0..D {
        within[axis] = xi[axis] - base[axis];
    }
    let (w, g) = crate::lanes::SelectedLanes::any().run(Axes::<N, D>(family, within, l));
    (base, w, g)
}
