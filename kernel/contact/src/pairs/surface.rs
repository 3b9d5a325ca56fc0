//! The surface of a body at the nodes: outward normal from the mass gradient, and how far particles reach along it.
//!
//! The mass gradient sum m grad N (contact manual, eq. 2, with the gradient that the print lacks) lies in the upper
//! lanes of the second line of a node of a layer. Its derivative is that by the position of the particle, so it points
//! from the body outward. At a wall the body goes on as its mirror image, as its mass does.

use super::interface::Interface;
use super::separation::Cloud;
use crate::values::ContactNormal;
use proctor_kernel::grid::{GHOSTS_BELOW, GridShape, Line};
use proctor_kernel::layout::Layout;
use proctor_kernel::model::Vector;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::stage::solve::{Planes, Wall};
use proctor_kernel::weights::base_node;
use std::ops::Range;

/// Mass gradient times cell over mass below which it is no normal: deep in a body it cancels to what the unevenness of
/// the particles leaves. Half a cell below a surface it is about 0.5, one cell below it 0.
const SMALLEST_GRADIENT: f64 = 0.02;

/// Distance of two unit normals up to which the gradients of two bodies are opposite: an angle of three degrees.
const OPPOSITE: f64 = 0.05;

/// First lane of the mass gradient in the second line of a node.
const GRADIENT: usize = 4;
/// Lane of the second line that marks nodes whose distance is looked for.
const MARK: usize = 7;

/// Folds mass gradients on ghost nodes onto their mirror nodes; on a plane the gradient along its normal cancels
/// against that of the mirror image.
pub fn fold_gradient(surface: &mut Planes<'_>, walls: &[Wall]) {
    for wall in walls {
        let (ghost, plane, mirror) = wall.layers(surface.shape);
        surface.for_pairs(wall.axis, ghost, mirror, |nodes, ghost, mirror| {
            for axis in 0..3 {
                let from = nodes[ghost][GRADIENT + axis];
                nodes[mirror][GRADIENT + axis] += if axis == wall.axis { -from } else { from };
            }
        });
        surface.for_pairs(wall.axis, plane, plane, |nodes, node, _| {
            nodes[node][GRADIENT + wall.axis] = 0.0;
        });
    }
}

/// One body at a node.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceSide<'a> {
    /// Mass of the body at the node \[kg\].
    pub mass: f64,
    /// Second line of the node.
    pub surface: &'a Line,
}

impl SurfaceSide<'_> {
    /// Outward unit normal, where the gradient is one.
    fn normal(&self, cell: &Vector) -> Option<Vector> {
        let g: Vector = std::array::from_fn(|axis| self.surface[GRADIENT + axis]);
        let size = length(&g);
        let scaled = length(&std::array::from_fn(|axis| g[axis] * cell[axis]));
        (scaled > SMALLEST_GRADIENT * self.mass && size > 0.0).then(|| g.map(|c| c / size))
    }
}

/// Normal of a pair at a node, as mass gradients have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassGradients {
    /// Unit normal from master to slave.
    pub normal: Vector,
    /// True if the gradients of both bodies are opposite: at a free corner, an edge or the end of a wall one of them
    /// turns.
    pub opposite: bool,
}

/// Normal of a pair at a node from mass gradients. `None` where neither body has one.
#[must_use]
pub fn normal(
    kind: ContactNormal,
    master: &SurfaceSide<'_>,
    slave: &SurfaceSide<'_>,
    cell: &Vector,
) -> Option<MassGradients> {
    let of_master = master.normal(cell);
    let of_slave = slave.normal(cell).map(|n| n.map(|c| -c));
    let (Some(m), Some(s)) = (of_master, of_slave) else {
        let normal = of_master.or(of_slave)?;
        return Some(MassGradients {
            normal,
            opposite: false,
        });
    };
    let normal = match kind {
        ContactNormal::Master => m,
        ContactNormal::Slave => s,
        ContactNormal::Collinear => {
            let sum: Vector = std::array::from_fn(|axis| m[axis] + s[axis]);
            let size = length(&sum);
            // Equal outward normals, of two bodies on the same side of the node, have no mean.
            if size > 1e-6 {
                sum.map(|c| c / size)
            } else {
                m
            }
        }
    };
    let between: f64 = (0..3).map(|axis| (m[axis] - s[axis]).powi(2)).sum();
    Some(MassGradients {
        normal,
        opposite: between <= OPPOSITE * OPPOSITE,
    })
}

/// A node where the reach of the particles of a body along a direction is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// Index of the node among those that are owned.
    pub node: usize,
    /// Storage indices of the node.
    pub at: [usize; 3],
    /// Unit direction.
    pub direction: Vector,
    /// Place of the cloud to which particles are added, where there is one.
    pub cloud: Option<usize>,
    /// Reach from the node along the direction \[m\]; minus infinity where there is no particle.
    pub reach: f64,
    /// The particle that reaches so far, relative to the node \[m\].
    pub facing: Vector,
    /// Farthest that any particle lies from the node along the direction \[m\].
    pub farthest: f64,
    /// The first particle that lies so far, relative to the node \[m\].
    pub extreme: Vector,
    /// Rank by which the particle was chosen: its reach less a share of its distance from the line through the node.
    rank: f64,
}

impl Probe {
    /// A probe that has seen no particle.
    #[must_use]
    pub fn new(node: usize, at: [usize; 3], direction: Vector, cloud: Option<usize>) -> Self {
        Self {
            node,
            at,
            direction,
            cloud,
            reach: f64::NEG_INFINITY,
            facing: [0.0; 3],
            farthest: f64::NEG_INFINITY,
            extreme: [0.0; 3],
            rank: f64::NEG_INFINITY,
        }
    }

    /// Takes the particle at `d` from the node if it is the one that a ball of radius `radius`, coming along the line
    /// through the node, meets first: the surface of the body as seen from the node.
    fn see(&mut self, d: &Vector, radius: f64) {
        let along: f64 = (0..3).map(|k| d[k] * self.direction[k]).sum();
        // Its rank is no larger than this.
        if along < self.rank {
            return;
        }
        if along > self.farthest {
            self.farthest = along;
            self.extreme = *d;
        }
        let aside: f64 = (0..3)
            .map(|k| (d[k] - along * self.direction[k]).powi(2))
            .sum();
        let rank = along - aside / (2.0 * radius);
        if rank > self.rank || (rank == self.rank && along > self.reach) {
            self.rank = rank;
            self.reach = along;
            self.facing = *d;
        }
    }
}

/// The planes in which a probe looks.
pub struct ProbeSearch<'a> {
    /// Shape of the grid.
    pub shape: &'a GridShape,
    /// Planes that are owned.
    pub planes: Range<usize>,
    /// Nodes per axis of the stencil.
    pub stencil: usize,
}

/// The box of all nodes with a probe, and lengths that are the same for all particles.
struct ProbeBox {
    /// Lowest and highest storage indices.
    low: [usize; 3],
    high: [usize; 3],
    /// One over the cell \[1/m\].
    per_length: Vector,
    /// Radius of the ball that a probe sends along its line \[m\].
    radius: f64,
}

impl ProbeSearch<'_> {
    /// Finds the reach of the particles at the interface of a body at probes, which are at different nodes, and puts them
    /// into the clouds of those that have one, as those of one side of their pair. `surface` are the second lines of the
    /// nodes of the owned planes.
    pub fn probe(
        &self,
        (set, interface): (&ParticleSet, &Interface),
        surface: &mut [Line],
        probes: &mut [Probe],
        (clouds, side): (&mut [Cloud], usize),
    ) {
        let (mut low, mut high) = ([usize::MAX; 3], [0; 3]);
        for (slot, probe) in probes.iter().enumerate() {
            surface[probe.node][MARK] = (slot + 1) as f64;
            for k in 0..3 {
                low[k] = low[k].min(probe.at[k]);
                high[k] = high[k].max(probe.at[k]);
            }
        }
        // A particle may have left its layer by one cell since the last sort, and a layer by which hats are sorted may begin one
        // node before the stencil.
        let first = self.planes.start.saturating_sub(self.stencil + 1);
        let within = ProbeBox {
            low,
            high,
            per_length: self.shape.cell.map(|cell| 1.0 / cell),
            radius: radius(self.shape),
        };
        for p in interface.in_layers(first..self.planes.end + 1).flatten() {
            self.show((set, p), &within, surface, probes, (clouds, side));
        }
        for probe in probes.iter() {
            surface[probe.node][MARK] = 0.0;
        }
    }

    /// Shows a particle to the probes at the nodes of its stencil that lie in a box.
    fn show(
        &self,
        (set, p): (&ParticleSet, usize),
        within: &ProbeBox,
        surface: &[Line],
        probes: &mut [Probe],
        (clouds, side): (&mut [Cloud], usize),
    ) {
        let shape = self.shape;
        let mut reach: [Range<usize>; 3] = [0..1, 0..1, 0..1];
        for axis in 0..shape.axes {
            let direction = shape.direction(axis);
            let xi = set.columns[Layout::POSITION + axis][p] * within.per_length[axis];
            let base = (base_node(xi, self.stencil) + GHOSTS_BELOW as f64) as usize;
            let end = (base + self.stencil).min(within.high[direction] + 1);
            let range = base.max(within.low[direction])..end;
            if range.is_empty() {
                return;
            }
            reach[direction] = range;
        }
        let x = set.position(p);
        for i in reach[0].clone() {
            for j in reach[1].clone() {
                let row = ((i - self.planes.start) * shape.nodes[1] + j) * shape.nodes[2];
                for k in reach[2].clone() {
                    let slot = surface[row + k][MARK] as usize;
                    if slot > 0 {
                        let probe = &mut probes[slot - 1];
                        let node = shape.position_of([i, j, k]);
                        let d = std::array::from_fn(|a| x[a] - node[a]);
                        probe.see(&d, within.radius);
                        if let Some(cloud) = probe.cloud {
                            clouds[cloud].points[side].push(d);
                        }
                    }
                }
            }
        }
    }
}

/// Radius of the ball that a probe sends along its line \[m\]: the smallest side of a cell.
fn radius(shape: &GridShape) -> f64 {
    (0..shape.axes)
        .map(|axis| shape.cell[axis])
        .fold(f64::INFINITY, f64::min)
}

/// Distance of the particles of a cloud along a direction \[m\], as probes measure it.
#[must_use]
pub fn distance_in(cloud: &Cloud, direction: &Vector, shape: &GridShape) -> f64 {
    let reach = |side: usize, sign: f64| {
        let mut probe = Probe::new(0, [0; 3], direction.map(|c| sign * c), None);
        for d in &cloud.points[side] {
            probe.see(d, radius(shape));
        }
        probe.reach
    };
    0.0 - reach(0, 1.0) - reach(1, -1.0)
}

/// Length of a vector.
#[must_use]
pub(crate) fn length(v: &Vector) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
