//! Normals and gaps between the bodies of pairs at the nodes where they meet.

use super::{Bodies, Meetings};
use crate::contact::Pair;
use crate::contact::separation::Cloud;
use crate::contact::surface::{self, Probe, Search, Side};
use crate::grid::GridShape;
use crate::scene::{ContactNormal, Vector};
use crate::simulation::interactions::grid::faces::SlabFields;

/// Share of the widest margin between the particles of two bodies that the normal of their mass gradients must leave to
/// stand where those gradients are not opposite. On a flat face a turn by three degrees costs more than the rest of it.
const LEAST_MARGIN: f64 = 0.9;

/// Share of the distance of contact by which one gap must be wider than another to be preferred: where two normals do as
/// well, which body is called the master must make no difference.
const WIDER: f64 = 1e-9;

/// Share of the distance of contact below which the distance along a normal says that the normal does not separate the
/// bodies: beside an edge that of one body alone points past the other.
const PLAUSIBLE: f64 = 0.25;

/// A node with the index of its touch and the normal.
type At = (usize, usize, Vector);

/// Lists that are filled for one pair after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    /// Nodes with the normal of the gradients.
    own: Vec<At>,
    /// Those where bodies touch whose gradients are not opposite.
    doubtful: Vec<At>,
    probes: Vec<Probe>,
    distances: Vec<Distance>,
    /// The first of them belong to the doubtful nodes; the rest is memory.
    clouds: Vec<Cloud>,
}

/// Distance of two bodies along a normal.
#[derive(Clone, Copy, Debug)]
struct Distance {
    /// Between the particles that face each other on the line through the node \[m\].
    facing: f64,
    /// Between the planes across the normal that bound the particles near the node \[m\]; no larger.
    least: f64,
}

impl Meetings {
    /// Measures the gaps of all pairs whose distance matters, and replaces normals that do not separate the bodies.
    pub(super) fn measure(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        sides: &[Option<[usize; 2]>],
        lists: &mut Lists,
    ) {
        let shape = fields.shape();
        let first = fields.range().start * shape.plane_nodes();
        for (index, (pair, numbers)) in bodies.pairs.iter().zip(sides).enumerate() {
            let &Some(numbers) = numbers else {
                continue;
            };
            lists.own.clear();
            for meeting in &self.nodes {
                for touch in meeting.touches.clone() {
                    let of = &self.touches[touch];
                    if of.pair == index && (pair.corrects_distance || !of.opposite) {
                        lists.own.push((meeting.node, touch, of.normal));
                    }
                }
            }
            lists.measure(fields, bodies, numbers);
            lists.doubtful.clear();
            let widest = pair.distance.iter().copied().fold(0.0, f64::max) * (1.0 + WIDER);
            for (&at, distance) in lists.own.iter().zip(&lists.distances) {
                let touch = &mut self.touches[at.1];
                if pair.corrects_distance {
                    touch.gap = distance.facing - pair.distance_along(&at.2);
                }
                // What is farther apart along one direction does not touch along any.
                if !touch.opposite && (distance.least <= widest || !pair.corrects_distance) {
                    lists.doubtful.push(at);
                }
            }
            lists.gather(fields, bodies, numbers);
            for (&(node, touch, own), cloud) in lists.doubtful.iter().zip(&lists.clouds) {
                let [Some(master), Some(slave)] = numbers.map(|number| {
                    Some(Side {
                        mass: fields.planes(number).nodes[node - first][0],
                        surface: &fields.faces[fields.place_of(number)?].lines[node - first],
                    })
                }) else {
                    continue;
                };
                let (normal, gap) = decide(pair, own, cloud, [&master, &slave], shape);
                let touch = &mut self.touches[touch];
                touch.normal = normal;
                if pair.corrects_distance {
                    touch.gap = gap;
                }
            }
        }
    }
}

/// Normal and gap of a pair at a node where the mass gradients of its bodies are not opposite.
///
/// Where a plane separates the particles near the node, the bodies face each other across it: the normal of the gradients
/// stands if it separates them nearly as well, which leaves curved bodies the normal that the scene asks for. Where none
/// does, one body ends inside the other or goes around its corner: if the normal of the gradients does not separate them
/// there, of the normals of both bodies that one is taken along which they are farther apart.
fn decide(
    pair: &Pair,
    own: Vector,
    cloud: &Cloud,
    [master, slave]: [&Side<'_>; 2],
    shape: &GridShape,
) -> (Vector, f64) {
    let gap =
        |normal: &Vector| surface::distance_in(cloud, normal, shape) - pair.distance_along(normal);
    let of = |kind| {
        let found = surface::normal(kind, master, slave, &shape.cell);
        found.map_or(own, |found| found.normal)
    };
    let ends = [ContactNormal::Master, ContactNormal::Slave].map(of);
    let sum: f64 = (0..3).map(|k| (ends[0][k] + ends[1][k]).powi(2)).sum();
    // Opposite normals have no mean, and none of them goes before the other.
    let cancel = pair.normal == ContactNormal::Collinear && sum < 1e-12;
    let margin = if cancel {
        f64::NEG_INFINITY
    } else {
        cloud.margin(&own)
    };
    // Hulls are no farther apart than any way from one to the other, so that the search can end early.
    if let Some(way) = cloud.way(&own, margin / LEAST_MARGIN) {
        let size = surface::length(&way);
        if margin >= LEAST_MARGIN * (1.0 - WIDER) * size {
            return (own, gap(&own));
        }
        let normal = way.map(|c| c / size);
        return (normal, gap(&normal));
    }
    let mut best = own;
    if cancel {
        let between = cloud.between_middles();
        let size = surface::length(&between);
        if size > 0.0 {
            best = between.map(|c| c / size);
        }
    }
    let of_best = gap(&best);
    let touching = pair.distance_along(&best);
    if of_best >= (PLAUSIBLE - 1.0) * touching {
        return (best, of_best);
    }
    let wider = WIDER * touching;
    let [of_master, of_slave] = ends.map(|normal| gap(&normal));
    let (other, of_other) = if of_master > of_slave {
        (ends[0], of_master)
    } else {
        (ends[1], of_slave)
    };
    let alike = pair.normal == ContactNormal::Collinear && (of_master - of_slave).abs() <= wider;
    if !alike && of_other > of_best + wider {
        (other, of_other)
    } else {
        (best, of_best)
    }
}

impl Lists {
    /// Finds the distances of the bodies of a pair along the normal at each of its nodes: eq. (8) along one normal, so that
    /// the position of the node drops out.
    fn measure(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        numbers: [usize; 2],
    ) {
        self.distances.clear();
        if self.own.is_empty() {
            return;
        }
        let shape = fields.shape();
        let search = search(fields, bodies);
        let first = search.planes.start * shape.plane_nodes();
        let none = Distance {
            facing: 0.0,
            least: 0.0,
        };
        self.distances.resize(self.own.len(), none);
        for (number, sign) in numbers.into_iter().zip([1.0, -1.0]) {
            self.probes.clear();
            self.probes
                .extend(self.own.iter().map(|&(node, _, normal)| {
                    Probe::new(node - first, shape.indices(node), normal.map(|c| sign * c))
                }));
            let Some(place) = fields.place_of(number) else {
                continue;
            };
            let face = &mut fields.faces[place];
            let body = (&bodies.sets[face.body], face.interface);
            search.probe(body, face.lines, &mut self.probes);
            for (distance, probe) in self.distances.iter_mut().zip(&self.probes) {
                distance.facing -= probe.reach;
                distance.least -= probe.farthest;
            }
        }
    }

    /// Gathers the particles of both bodies near each doubtful node.
    fn gather(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        numbers: [usize; 2],
    ) {
        if self.doubtful.is_empty() {
            return;
        }
        let shape = fields.shape();
        let search = search(fields, bodies);
        let first = search.planes.start * shape.plane_nodes();
        if self.clouds.len() < self.doubtful.len() {
            self.clouds.resize_with(self.doubtful.len(), Cloud::default);
        }
        let clouds = &mut self.clouds[..self.doubtful.len()];
        for (cloud, &(node, ..)) in clouds.iter_mut().zip(&self.doubtful) {
            (cloud.node, cloud.at) = (node - first, shape.indices(node));
            cloud.points.iter_mut().for_each(Vec::clear);
        }
        for (side, number) in numbers.into_iter().enumerate() {
            let Some(place) = fields.place_of(number) else {
                continue;
            };
            let face = &mut fields.faces[place];
            let body = (&bodies.sets[face.body], face.interface);
            search.gather(body, face.lines, clouds, side);
        }
    }
}

/// Where particles are looked for.
fn search<'a>(fields: &SlabFields<'_, 'a, '_>, bodies: &Bodies<'_>) -> Search<'a> {
    Search {
        shape: fields.shape(),
        planes: fields.range(),
        stencil: bodies.stencil,
    }
}
