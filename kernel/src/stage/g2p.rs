//! Nodes to particles: velocity, position, velocity gradient, stress; lanes = particles of one cell.
//!
//! v_p = v_p + sum_I S_Ip dv_I (FLIP), x_p = x_p + dt sum_I S_Ip v_I, L_p = sum_I v_I (x) grad S_Ip
//! (technical manual, algorithm 2, lines 12, 15, 19, 20), then the stress update of the law.

use super::{Group, Mapping, group_at, layer_of, load, store, weights_of};
use crate::constitutive::{
    Configuration, Kind, Matrix, Parameters, determinant, hypoelastic, left_stretch_diagonal,
    neo_hookean, neo_hookean_speed_squared, product, relative_deformation, stretch_diagonal,
    volume_ratio,
};
use crate::grid::Line;
use crate::lanes::{Backend, Kernel, Lanes, Selected};
use crate::particles::Layout;
use crate::scene::DomainUpdate;
use std::ops::Range;

/// What a pass does with the interpolated values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// Add the velocity increments to the particle velocities.
    pub kick: bool,
    /// Share of the interpolated velocity in the particle velocity, 0 to 1.
    pub pic_fraction: f64,
    /// Time by which positions move \[s\]; `None` leaves them.
    pub drift: Option<f64>,
    /// Displacement of the mesh meanwhile \[m\]; positions are relative to it.
    pub mesh_shift: [f64; 3],
    /// Time of the strain increment and where its gradient belongs \[s\]; `None` leaves the stress.
    pub strain: Option<(f64, Configuration)>,
    /// Gradient from the upper lanes of the nodes (remapped velocity of MUSL) instead of the lower ones.
    pub gradient_of_upper: bool,
    /// What is written to the affine velocity of the particles.
    pub affine: Affine,
}

/// Source of the affine velocity C_p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Affine {
    /// None.
    Leave,
    /// B_p D_p^-1 (Jiang et al. 2015).
    Apic,
    /// The velocity gradient.
    Tpic,
}

/// One call: some particles of a set, in layers.
pub struct G2p<'a, 'b> {
    /// Columns of these particles.
    pub columns: &'a mut [&'b mut [f64]],
    /// Where the columns are.
    pub layout: &'a Layout,
    /// How the set sees the grid.
    pub mapping: &'a Mapping,
    /// Law of the set.
    pub law: &'a Parameters,
    /// Update of the particle domain, for cpGIMP.
    pub domain_update: Option<DomainUpdate>,
    /// All nodes.
    pub nodes: &'a [Line],
    /// Smallest numbers beyond the edges of the mesh per axis \[m\].
    pub beyond: [f64; 3],
    /// What to do.
    pub task: Task,
}

/// What a pass found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Found {
    /// Largest |v|² \[m²/s²\].
    pub speed_squared: f64,
    /// Largest V/m \[m³/kg\] for the hypoelastic laws, largest c² for the neo-Hookean law; see
    /// [`Found::wave_speed`].
    pub stiffness: f64,
    /// Largest move in cells along any axis.
    pub travel: f64,
    /// Largest half-length of a particle domain in cells.
    pub half_length: f64,
    /// First particle that went wrong, relative to the range of the call.
    pub fault: Option<(usize, FaultKind)>,
}

/// How a particle can go wrong in a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A value is not a number or infinite.
    NotFinite,
    /// Volume zero or negative.
    Inverted,
    /// Position outside the mesh.
    Outside,
}

impl Found {
    /// The larger of two findings; the fault of `self` comes first.
    #[must_use]
    pub fn and(self, later: Self) -> Self {
        Self {
            speed_squared: self.speed_squared.max(later.speed_squared),
            stiffness: self.stiffness.max(later.stiffness),
            travel: self.travel.max(later.travel),
            half_length: self.half_length.max(later.half_length),
            fault: self.fault.or(later.fault),
        }
    }

    /// Largest wave speed of the set \[m/s\].
    #[must_use]
    pub fn wave_speed(&self, law: &Parameters) -> f64 {
        match law.kind {
            Kind::NeoHookean => self.stiffness.max(0.0).sqrt(),
            _ => ((law.lambda + 2.0 * law.shear) * self.stiffness).sqrt(),
        }
    }
}

/// An interpolation stage, compiled for one dimension, stencil and set of sums.
pub type G2pFn = fn(Selected, G2p<'_, '_>) -> Found;

/// Chooses the instance for a task.
#[must_use]
pub fn instance(axes: usize, stencil: usize, task: &Task) -> G2pFn {
    let gradient = task.strain.is_some() || task.affine == Affine::Tpic;
    let apic = task.affine == Affine::Apic;
    match (axes, stencil) {
        (2, 3) => sums::<2, 3>(task, gradient, apic),
        (2, _) => sums::<2, 4>(task, gradient, apic),
        (_, 3) => sums::<3, 3>(task, gradient, apic),
        (_, _) => sums::<3, 4>(task, gradient, apic),
    }
}

fn sums<const D: usize, const N: usize>(task: &Task, gradient: bool, apic: bool) -> G2pFn {
    match (task.kick, gradient, apic, task.gradient_of_upper) {
        (_, _, true, _) => entry::<D, N, true, true, true, false>,
        (_, true, false, true) => entry::<D, N, false, true, false, true>,
        (true, true, false, false) => entry::<D, N, true, true, false, false>,
        (true, false, false, _) => entry::<D, N, true, false, false, false>,
        (false, _, false, _) => entry::<D, N, false, true, false, false>,
    }
}

fn entry<
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
>(
    lanes: Selected,
    call: G2p<'_, '_>,
) -> Found {
    lanes.run(Instance::<'_, '_, D, N, KICK, GRADIENT, APIC, UPPER>(call))
}

pub(super) struct Instance<
    'a,
    'b,
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
>(pub(super) G2p<'a, 'b>);

impl<
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
> Kernel for Instance<'_, '_, D, N, KICK, GRADIENT, APIC, UPPER>
{
    type Output = Found;

    #[inline(always)]
    fn run<B: Backend>(self) -> Found {
        let mut call = self.0;
        let end = call.columns[0].len();
        let mut maxima = Maxima::<B::Native>::new();
        let mut sums = Sums::<B::Native>::zero();
        let mut fault = None;
        let mut at = 0;
        while at < end {
            let group = group_at::<B::Native, _, D, N>(call.columns, call.mapping, at, end);
            interpolate::<B::Native, D, N, KICK, GRADIENT, APIC, UPPER>(
                call.columns,
                call.mapping,
                call.nodes,
                &group,
                at,
                &mut sums,
            );
            let bad = update::<B::Native, D, N>(&mut call, &sums, &mut maxima, at, group.count);
            if bad != 0 && fault.is_none() {
                fault = Some(first_fault::<D>(&call, at, bad));
            }
            at += group.count;
        }
        maxima.found(fault)
    }
}

/// Interpolated values of one group.
struct Sums<L> {
    /// sum S v.
    velocity: [L; 3],
    /// sum S dv.
    increment: [L; 3],
    /// sum v (x) grad S \[1/s\].
    gradient: Matrix<L>,
    /// C_p of APIC \[1/s\].
    affine: Matrix<L>,
}

impl<L: Lanes> Sums<L> {
    #[inline(always)]
    fn zero() -> Self {
        let zero = L::splat(0.0);
        Self {
            velocity: [zero; 3],
            increment: [zero; 3],
            gradient: [[zero; 3]; 3],
            affine: [[zero; 3]; 3],
        }
    }
}

/// Interpolates to one group. Writes the first D components of what is asked for, and leaves the rest of `sums`.
#[inline(always)]
fn interpolate<
    L: Lanes,
    const D: usize,
    const N: usize,
    const KICK: bool,
    const GRADIENT: bool,
    const APIC: bool,
    const UPPER: bool,
>(
    columns: &[&mut [f64]],
    mapping: &Mapping,
    nodes: &[Line],
    group: &Group<L>,
    at: usize,
    sums: &mut Sums<L>,
) {
    let zero = L::splat(0.0);
    let (w, mut g) = weights_of::<L, _, D, N>(columns, mapping, group, at);
    let mut q = [[zero; N]; 3];
    for axis in 0..D {
        let scale = L::splat(mapping.inverse_cell[axis]);
        for n in 0..N {
            g[axis][n] = g[axis][n] * scale;
        }
        if APIC {
            q[axis] = affine_weights::<L, N>(mapping, axis, group.f[axis], &w[axis], &g[axis]);
        }
    }
    let stencil = Stencil::<L, D, N>::new(mapping, nodes, group, &w, &g);
    let affine = if APIC {
        Some(AffineFactors::new::<D>(&w, &q))
    } else {
        None
    };
    // One component after the other: its sums and the weights along a row fit the registers.
    for c in 0..D {
        let of = stencil.component::<KICK, GRADIENT, UPPER>(affine.as_ref(), c);
        sums.velocity[c] = of.velocity;
        if KICK {
            sums.increment[c] = of.increment;
        }
        if GRADIENT {
            sums.gradient[c] = of.gradient;
        }
        if APIC {
            sums.affine[c] = of.affine;
        }
    }
}

/// One component of the interpolated values.
struct Component<L> {
    velocity: L,
    increment: L,
    gradient: [L; 3],
    affine: [L; 3],
}

/// What the components share: factors along a row, products over slow and middle axis for each row, and the rows.
struct Stencil<'a, L, const D: usize, const N: usize> {
    /// Weight and derivative along the row.
    w: [L; N],
    g: [L; N],
    /// Weight times weight.
    ww: [[L; N]; N],
    /// Derivative along the slow axis, and along the middle one.
    gw: [[L; N]; N],
    wg: [[L; N]; N],
    /// The nodes of each row.
    rows: [[&'a [Line; N]; N]; N],
}

/// The same for the factors of APIC: along the row, and over slow and middle axis with that of one of them.
struct AffineFactors<L, const N: usize> {
    q: [L; N],
    qw: [[L; N]; N],
    wq: [[L; N]; N],
}

impl<L: Lanes, const N: usize> AffineFactors<L, N> {
    #[inline(always)]
    fn new<const D: usize>(w: &[[L; N]; 3], q: &[[L; N]; 3]) -> Self {
        let mut factors = Self {
            q: q[D - 1],
            qw: [q[0]; N],
            wq: [q[0]; N],
        };
        for i in 0..N {
            for j in 0..N {
                if D == 3 {
                    factors.qw[i][j] = q[0][i] * w[1][j];
                    factors.wq[i][j] = w[0][i] * q[1][j];
                } else {
                    factors.qw[i][j] = q[0][i];
                }
            }
        }
        factors
    }
}

impl<'a, L: Lanes, const D: usize, const N: usize> Stencil<'a, L, D, N> {
    /// Rows of a plane.
    const ROWS: usize = if D == 3 { N } else { 1 };

    #[inline(always)]
    fn new(
        mapping: &Mapping,
        nodes: &'a [Line],
        group: &Group<L>,
        w: &[[L; N]; 3],
        g: &[[L; N]; 3],
    ) -> Self {
        let fast = D - 1;
        let middle = if D == 3 { layer_of(group.base[1]) } else { 0 };
        let row = layer_of(group.base[0]) * mapping.nodes[1] + middle;
        let first = row * mapping.nodes[2] + layer_of(group.base[fast]);
        let plane = mapping.nodes[1] * mapping.nodes[2];
        let mut stencil = Self {
            w: w[fast],
            g: g[fast],
            ww: [w[0]; N],
            gw: [g[0]; N],
            wg: [g[0]; N],
            rows: [[row_at(nodes, first); N]; N],
        };
        for i in 0..N {
            for j in 0..Self::ROWS {
                stencil.rows[i][j] = row_at(nodes, first + i * plane + j * mapping.nodes[2]);
                if D == 3 {
                    stencil.ww[i][j] = w[0][i] * w[1][j];
                    stencil.gw[i][j] = g[0][i] * w[1][j];
                    stencil.wg[i][j] = w[0][i] * g[1][j];
                } else {
                    stencil.ww[i][j] = w[0][i];
                    stencil.gw[i][j] = g[0][i];
                }
            }
        }
        stencil
    }

    #[inline(always)]
    fn component<const KICK: bool, const GRADIENT: bool, const UPPER: bool>(
        &self,
        affine: Option<&AffineFactors<L, N>>,
        c: usize,
    ) -> Component<L> {
        let zero = L::splat(0.0);
        let fast = D - 1;
        let source = if UPPER { 4 } else { 1 };
        let mut sums = Component {
            velocity: zero,
            increment: zero,
            gradient: [zero; 3],
            affine: [zero; 3],
        };
        for i in 0..N {
            for j in 0..Self::ROWS {
                let row = self.rows[i][j];
                // Sums along the row. A first product may be -0 where a sum from 0 is not; neither changes what it
                // is added to.
                let v_0 = L::splat(row[0][1 + c]);
                let mut v = self.w[0] * v_0;
                let mut dv = zero;
                if KICK {
                    dv = self.w[0] * L::splat(row[0][4 + c]);
                }
                let s_0 = L::splat(row[0][source + c]);
                let (mut s, mut vg) = (self.w[0] * s_0, self.g[0] * s_0);
                for k in 1..N {
                    v = self.w[k].mul_add(L::splat(row[k][1 + c]), v);
                    if KICK {
                        dv = self.w[k].mul_add(L::splat(row[k][4 + c]), dv);
                    }
                    if GRADIENT {
                        let s_i = L::splat(row[k][source + c]);
                        if UPPER {
                            s = self.w[k].mul_add(s_i, s);
                        }
                        vg = self.g[k].mul_add(s_i, vg);
                    }
                }
                if !UPPER {
                    s = v;
                }
                let ww = self.ww[i][j];
                sums.velocity = ww.mul_add(v, sums.velocity);
                if KICK {
                    sums.increment = ww.mul_add(dv, sums.increment);
                }
                if GRADIENT {
                    sums.gradient[0] = self.gw[i][j].mul_add(s, sums.gradient[0]);
                    sums.gradient[fast] = ww.mul_add(vg, sums.gradient[fast]);
                    if D == 3 {
                        sums.gradient[1] = self.wg[i][j].mul_add(s, sums.gradient[1]);
                    }
                }
                if let Some(affine) = affine {
                    let mut vq = affine.q[0] * v_0;
                    for k in 1..N {
                        vq = affine.q[k].mul_add(L::splat(row[k][1 + c]), vq);
                    }
                    sums.affine[0] = affine.qw[i][j].mul_add(v, sums.affine[0]);
                    sums.affine[fast] = ww.mul_add(vq, sums.affine[fast]);
                    if D == 3 {
                        sums.affine[1] = affine.wq[i][j].mul_add(v, sums.affine[1]);
                    }
                }
            }
        }
        sums
    }
}

/// The row of nodes of a stencil from a node on.
#[inline(always)]
fn row_at<const N: usize>(nodes: &[Line], first: usize) -> &[Line; N] {
    nodes[first..]
        .first_chunk()
        .expect("the stencil of a particle lies in the grid")
}

/// Factors of APIC along an axis: S_I (x_I - x_p)/D_p with D_p = sum S_I (x_I - x_p)² of that axis. The cross
/// terms of D_p vanish because the weights reproduce linear fields. For hats the quotient is the derivative,
/// also where D_p is zero.
#[inline(always)]
fn affine_weights<L: Lanes, const N: usize>(
    mapping: &Mapping,
    axis: usize,
    f: L,
    w: &[L; N],
    g: &[L; N],
) -> [L; N] {
    if mapping.family == crate::weights::Family::Hat {
        return *g;
    }
    let mut q = *w;
    let mut inertia = L::splat(0.0);
    for n in 0..N {
        let distance = L::splat(n as f64) - f;
        q[n] = w[n] * distance;
        inertia = q[n].mul_add(distance, inertia);
    }
    let scale = L::splat(mapping.inverse_cell[axis]) / inertia;
    for n in 0..N {
        q[n] = q[n] * scale;
    }
    q
}

/// Writes the new state of one group; returns the lanes that went wrong.
#[inline(always)]
fn update<L: Lanes, const D: usize, const N: usize>(
    call: &mut G2p<'_, '_>,
    sums: &Sums<L>,
    maxima: &mut Maxima<L>,
    at: usize,
    count: usize,
) -> u32 {
    let zero = L::splat(0.0);
    let task = call.task;
    let live = live_lanes::<L>(count);
    let mut good = u32::MAX;
    if task.kick {
        let pic = L::splat(task.pic_fraction);
        let mut square = zero;
        for c in 0..D {
            let column = &mut *call.columns[Layout::velocity(D) + c];
            let mut v = load::<L>(column, at, count) + sums.increment[c];
            if task.pic_fraction != 0.0 {
                v = pic.mul_add(sums.velocity[c] - v, v);
            }
            store(v, column, at, count);
            square = v.mul_add(v, square);
        }
        maxima.speed_squared = maxima.speed_squared.max(L::select(live, square, zero));
    }
    if let Some(affine) = call.layout.affine {
        let c_p = match task.affine {
            Affine::Leave => None,
            Affine::Apic => Some(&sums.affine),
            Affine::Tpic => Some(&sums.gradient),
        };
        if let Some(c_p) = c_p {
            for a in 0..D {
                for b in 0..D {
                    store(c_p[a][b], call.columns[affine + a * D + b], at, count);
                }
            }
        }
    }
    if let Some(dt) = task.drift {
        let dt = L::splat(dt);
        for axis in 0..D {
            let column = &mut *call.columns[Layout::POSITION + axis];
            let move_ = dt * sums.velocity[axis] - L::splat(task.mesh_shift[axis]);
            let x = load::<L>(column, at, count) + move_;
            store(x, column, at, count);
            let cells = (move_ * L::splat(call.mapping.inverse_cell[axis])).abs();
            maxima.travel = maxima.travel.max(L::select(live, cells, zero));
            // False for NaN, true on the planes themselves.
            good &= L::bits(L::splat(-f64::MIN_POSITIVE).lt(x));
            good &= L::bits(x.lt(L::splat(call.beyond[axis])));
        }
    }
    if let Some((dt, configuration)) = task.strain {
        good &= strain::<L, D>(call, sums, maxima, at, count, dt, configuration);
    }
    !good & L::bits(live)
}

/// Stress, volume and deformation after a strain increment; returns the lanes that are sound.
#[inline(always)]
fn strain<L: Lanes, const D: usize>(
    call: &mut G2p<'_, '_>,
    sums: &Sums<L>,
    maxima: &mut Maxima<L>,
    at: usize,
    count: usize,
    dt: f64,
    configuration: Configuration,
) -> u32 {
    let zero = L::splat(0.0);
    let live = live_lanes::<L>(count);
    let law = call.law;
    let mut g = sums.gradient;
    for a in 0..D {
        for b in 0..D {
            g[a][b] = g[a][b] * L::splat(dt);
        }
    }
    let mass = load::<L>(call.columns[Layout::MASS], at, count);
    let mut f = [[zero; 3]; 3];
    let mut ratio = L::splat(1.0);
    if let Some(first) = call.layout.deformation {
        for a in 0..D {
            for b in 0..D {
                f[a][b] = load::<L>(call.columns[first + a * D + b], at, count);
            }
        }
        f = product::<L, D>(&relative_deformation::<L, D>(&g, configuration), &f);
        for a in 0..D {
            for b in 0..D {
                store(f[a][b], call.columns[first + a * D + b], at, count);
            }
        }
        ratio = determinant::<L, D>(&f);
    }
    // Where F has a use in the cycle the volume is V_0 det F, so that volume, density and F agree to round-off;
    // an F that is only written must not change a bit.
    let volume = if law.kind == Kind::NeoHookean || call.domain_update.is_some() {
        mass * L::splat(1.0 / law.density) * ratio
    } else {
        load::<L>(call.columns[Layout::VOLUME], at, count) * volume_ratio::<L, D>(&g, configuration)
    };
    store(volume, call.columns[Layout::VOLUME], at, count);
    let mut good = L::bits(zero.lt(volume));

    let components = if D == 2 { 4 } else { 6 };
    let first = Layout::stress(D);
    let mut s = [zero; 6];
    let stiffness = if law.kind == Kind::NeoHookean {
        s = neo_hookean::<L, D>(law, &f, ratio);
        neo_hookean_speed_squared::<L, D>(law, &f, ratio)
    } else {
        for i in 0..components {
            s[i] = load::<L>(call.columns[first + i], at, count);
        }
        s = hypoelastic::<L, D>(law, &g, configuration, &s);
        volume / mass
    };
    maxima.stiffness = maxima.stiffness.max(L::select(live, stiffness, zero));
    let mut finite = zero;
    for i in 0..components {
        store(s[i], call.columns[first + i], at, count);
        finite = s[i].mul_add(zero, finite);
    }
    good &= L::bits(finite.eq(zero));

    if let (Some(update), Some(first), Some(initial)) = (
        call.domain_update,
        call.layout.half_length,
        call.layout.initial_half_length,
    ) {
        let factor = match update {
            DomainUpdate::Stretch => stretch_diagonal::<L, D>(&f),
            DomainUpdate::LeftStretch => left_stretch_diagonal::<L, D>(&f),
            DomainUpdate::Determinant if D == 2 => [ratio.sqrt(); 3],
            DomainUpdate::Determinant => [ratio.map(f64::cbrt); 3],
        };
        for axis in 0..D {
            let l = factor[axis] * load::<L>(call.columns[initial + axis], at, count);
            store(l, call.columns[first + axis], at, count);
            maxima.half_length = maxima.half_length.max(L::select(live, l, zero));
        }
    }
    good
}

#[inline(always)]
fn live_lanes<L: Lanes>(count: usize) -> L::Mask {
    const INDEX: [f64; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
    L::load(&INDEX).lt(L::splat(count as f64))
}

/// Largest values over the particles seen so far, per lane. Maxima do not depend on the order.
struct Maxima<L> {
    speed_squared: L,
    stiffness: L,
    travel: L,
    half_length: L,
}

impl<L: Lanes> Maxima<L> {
    #[inline(always)]
    fn new() -> Self {
        let zero = L::splat(0.0);
        Self {
            speed_squared: zero,
            stiffness: zero,
            travel: zero,
            half_length: zero,
        }
    }

    #[inline(always)]
    fn found(&self, fault: Option<(usize, FaultKind)>) -> Found {
        Found {
            speed_squared: largest(self.speed_squared),
            stiffness: largest(self.stiffness),
            travel: largest(self.travel),
            half_length: largest(self.half_length),
            fault,
        }
    }
}

#[inline(always)]
fn largest<L: Lanes>(x: L) -> f64 {
    let mut values = [0.0; 8];
    x.store(&mut values);
    let mut most = 0.0;
    for value in values {
        if value > most {
            most = value;
        }
    }
    most
}

/// Names the fault of the first bad lane of a group.
#[cold]
fn first_fault<const D: usize>(call: &G2p<'_, '_>, at: usize, bad: u32) -> (usize, FaultKind) {
    let p = at + bad.trailing_zeros() as usize;
    let state: Range<usize> = Layout::VOLUME..Layout::stress(D) + call.layout.stress_components();
    let volume = call.columns[Layout::VOLUME][p];
    // First, because ln J makes the stress of an inverted neo-Hookean particle NaN.
    let kind = if volume.is_finite() && volume <= 0.0 {
        FaultKind::Inverted
    } else if state
        .clone()
        .any(|column| !call.columns[column][p].is_finite())
    {
        FaultKind::NotFinite
    } else {
        FaultKind::Outside
    };
    (p, kind)
}
