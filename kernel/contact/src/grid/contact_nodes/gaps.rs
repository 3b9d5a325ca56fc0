//! Normals and gaps between the bodies of pairs at the nodes where they meet.

use super::{Bodies, ContactNodes};
use crate::grid::faces::SlabFields;
use crate::pairs::Pair;
use crate::pairs::separation::Cloud;
use crate::pairs::surface::{self, Probe, ProbeSearch, SurfaceSide};
use crate::values::ContactNormal;
use proctor_kernel::grid::GridShape;
use proctor_kernel::model::Vector;

/// Share of the widest margin between the particles of two bodies that the normal of their mass gradients must leave to
/// stand where those gradients are not opposite. On a flat face a turn by three degrees costs more than the rest of it.
const LEAST_MARGIN: f64 = 0.9;

/// Share of the distance of contact by which one gap must be wider than another to be preferred: where two normals do as
/// well, which body is called the master must make no difference.
const WIDER: f64 = 1e-9;

/// Share of the distance of contact below which the distance along a normal says that the normal does not separate the
/// bodies: beside an edge that of one body alone points past the other.
const PLAUSIBLE: f64 = 0.25;

/// A node where a pair meets.
#[derive(Clone, Copy, Debug)]
struct PairAtNode {
    /// Index of the node in the grid.
    node: usize,
    /// Index of the touch.
    touch: usize,
    /// Normal of the gradients.
    normal: Vector,
    /// Place of its cloud of particles, where the gradients are not opposite.
    cloud: Option<usize>,
}

/// Lists that are filled for one pair after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct GapLists {
    nodes: Vec<PairAtNode>,
    probes: Vec<Probe>,
    distances: Vec<Distance>,
    /// The first of them belong to the nodes; the rest is memory.
    clouds: Vec<Cloud>,
}

/// Distance of two bodies along a normal.
#[derive(Clone, Copy, Debug)]
struct Distance {
    /// Along the normal, between the particles that face each other on the line through the node \[m\].
    facing: f64,
    /// Vector from the centre of the master to that of the slave \[m\].
    between: Vector,
    /// Between the planes across the normal that bound the particles near the node \[m\]; no larger.
    least: f64,
    /// Vector from the particle of the master on one of those planes to that of the slave on the other \[m\].
    bounds: Vector,
}

impl ContactNodes {
    /// Measures the gaps of all pairs whose distance matters, and replaces normals that do not separate the bodies.
    pub(super) fn measure(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        sides: &[Option<[usize; 2]>],
        lists: &mut GapLists,
    ) {
        let shape = fields.shape();
        let first = fields.range().start * shape.plane_nodes();
        for (index, (pair, numbers)) in bodies.pairs.iter().zip(sides).enumerate() {
            let &Some(numbers) = numbers else {
                continue;
            };
            self.list(index, pair, lists);
            lists.measure(fields, bodies, numbers);
            let widest = pair.distance[..shape.axes]
                .iter()
                .copied()
                .fold(0.0, f64::max)
                * (1.0 + WIDER);
            for (at, distance) in lists.nodes.iter().zip(&lists.distances) {
                let touch = &mut self.touches[at.touch];
                if pair.corrects_distance {
                    touch.gap = distance.facing - pair.distance_along(&at.normal);
                    // What is farther apart along one direction does not touch along any.
                    if distance.least > widest {
                        continue;
                    }
                }
                let Some(cloud) = at.cloud.map(|cloud| &lists.clouds[cloud]) else {
                    continue;
                };
                let Some(ends) = Ends::of(fields, numbers, at.node - first, pair, &at.normal)
                else {
                    continue;
                };
                if let Some((normal, gap)) = instead(pair, at, distance, ends, cloud, shape) {
                    touch.normal = normal;
                    if pair.corrects_distance {
                        touch.gap = gap;
                    }
                }
            }
        }
    }

    /// Lists the nodes where a pair meets and its normal or gap is looked for.
    fn list(&self, index: usize, pair: &Pair, lists: &mut GapLists) {
        lists.nodes.clear();
        let mut clouds = 0;
        for meeting in &self.nodes {
            for touch in meeting.touches.clone() {
                let of = &self.touches[touch];
                if of.pair == index && (pair.corrects_distance || !of.opposite) {
                    let cloud = (!of.opposite).then_some(clouds);
                    clouds += usize::from(!of.opposite);
                    lists.nodes.push(PairAtNode {
                        node: meeting.node,
                        touch,
                        normal: of.normal,
                        cloud,
                    });
                }
            }
        }
        if lists.clouds.len() < clouds {
            lists.clouds.resize_with(clouds, Cloud::default);
        }
        for cloud in &mut lists.clouds[..clouds] {
            cloud.points.iter_mut().for_each(Vec::clear);
        }
    }
}

/// Normals of both bodies of a pair at a node, from master to slave.
#[derive(Clone, Copy, Debug)]
struct Ends {
    /// Normals of the master and of the slave.
    normals: [Vector; 2],
    /// True where they are opposite: they have no mean, and none of them goes before the other.
    cancel: bool,
}

impl Ends {
    /// Gaps of a node among the owned ones, where the pair has the normal `own`.
    fn of(
        fields: &SlabFields<'_, '_, '_>,
        numbers: [usize; 2],
        node: usize,
        pair: &Pair,
        own: &Vector,
    ) -> Option<Self> {
        let [Some(master), Some(slave)] = numbers.map(|number| {
            Some(SurfaceSide {
                mass: fields.planes(number).nodes[node][0],
                surface: &fields.faces[fields.place_of(number)?].lines[node],
            })
        }) else {
            return None;
        };
        let normals = [ContactNormal::Master, ContactNormal::Slave].map(|kind| {
            let found = surface::normal(kind, &master, &slave, &fields.shape().cell);
            found.map_or(*own, |found| found.normal)
        });
        let sum: f64 = (0..3)
            .map(|k| (normals[0][k] + normals[1][k]).powi(2))
            .sum();
        Some(Self {
            normals,
            cancel: pair.normal == ContactNormal::Collinear && sum < 1e-12,
        })
    }
}

/// Normal and gap of a pair at a node where the mass gradients of its bodies are not opposite; `None` where the normal of
/// the gradients stands.
///
/// Where a plane separates the particles near the node, the bodies face each other across it: the normal of the gradients
/// stands if it separates them nearly as well, which leaves curved bodies the normal that the scene asks for. Where none
/// does, one body ends inside the other or goes around its corner: if the normal of the gradients does not separate them
/// there, of the normals of both bodies that one is taken along which they are farther apart.
fn instead(
    pair: &Pair,
    at: &PairAtNode,
    distance: &Distance,
    ends: Ends,
    cloud: &Cloud,
    shape: &GridShape,
) -> Option<(Vector, f64)> {
    let gap =
        |normal: &Vector| surface::distance_in(cloud, normal, shape) - pair.distance_along(normal);
    // No plane leaves a wider margin than two particles are apart: where faces are aligned, no more is asked.
    let most = surface::length(&distance.between);
    if !ends.cancel && distance.least >= LEAST_MARGIN * most {
        return None;
    }
    let margin = if ends.cancel {
        f64::NEG_INFINITY
    } else {
        distance.least
    };
    // Hulls are no farther apart than any way from one to the other, so that the search can end early.
    if let Some(way) = cloud.way(distance.bounds, margin / LEAST_MARGIN) {
        let size = surface::length(&way);
        if margin >= LEAST_MARGIN * (1.0 - WIDER) * size {
            return None;
        }
        let normal = way.map(|c| c / size);
        return Some((normal, gap(&normal)));
    }
    let touching = pair.distance_along(&at.normal);
    let (mut best, mut of_best) = (at.normal, distance.facing - touching);
    if ends.cancel {
        let between = cloud.between_middles();
        let size = surface::length(&between);
        if size > 0.0 {
            best = between.map(|c| c / size);
            of_best = gap(&best);
        }
    }
    if of_best >= (PLAUSIBLE - 1.0) * touching {
        return Some((best, of_best));
    }
    let wider = WIDER * touching;
    let [of_master, of_slave] = ends.normals.map(|normal| gap(&normal));
    let (other, of_other) = if of_master > of_slave {
        (ends.normals[0], of_master)
    } else {
        (ends.normals[1], of_slave)
    };
    let alike = pair.normal == ContactNormal::Collinear && (of_master - of_slave).abs() <= wider;
    if !alike && of_other > of_best + wider {
        Some((other, of_other))
    } else {
        Some((best, of_best))
    }
}

impl GapLists {
    /// Finds the distances of the bodies of a pair along the normal at each of its nodes, eq. (8) along one normal, so that
    /// the position of the node drops out, and gathers the clouds.
    fn measure(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        numbers: [usize; 2],
    ) {
        self.distances.clear();
        if self.nodes.is_empty() {
            return;
        }
        let shape = fields.shape();
        let search = ProbeSearch {
            shape,
            planes: fields.range(),
            stencil: bodies.stencil,
        };
        let first = search.planes.start * shape.plane_nodes();
        let none = Distance {
            facing: 0.0,
            between: [0.0; 3],
            least: 0.0,
            bounds: [0.0; 3],
        };
        self.distances.resize(self.nodes.len(), none);
        for (side, (number, sign)) in numbers.into_iter().zip([1.0, -1.0]).enumerate() {
            self.probes.clear();
            self.probes.extend(self.nodes.iter().map(|at| {
                let direction = at.normal.map(|c| sign * c);
                Probe::new(at.node - first, shape.indices(at.node), direction, at.cloud)
            }));
            let Some(place) = fields.place_of(number) else {
                continue;
            };
            let face = &mut fields.faces[place];
            search.probe(
                (&bodies.sets[face.body], &bodies.interfaces[place]),
                face.lines,
                &mut self.probes,
                (&mut self.clouds, side),
            );
            for (distance, probe) in self.distances.iter_mut().zip(&self.probes) {
                distance.facing -= probe.reach;
                for axis in 0..3 {
                    distance.between[axis] -= sign * probe.facing[axis];
                    distance.bounds[axis] -= sign * probe.extreme[axis];
                }
                distance.least -= probe.farthest;
            }
        }
    }
}
