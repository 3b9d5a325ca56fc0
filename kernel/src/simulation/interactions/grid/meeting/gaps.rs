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

/// A node with the index of its touch and the normal.
type At = (usize, usize, Vector);

/// Lists that are filled for one pair after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    /// Nodes where the gradients of both bodies are opposite.
    own: Vec<At>,
    /// Nodes where they are not.
    doubtful: Vec<At>,
    probes: Vec<Probe>,
    distances: Vec<f64>,
    /// The first of them belong to the doubtful nodes; the rest is memory.
    clouds: Vec<Cloud>,
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
            lists.doubtful.clear();
            for meeting in &self.nodes {
                for touch in meeting.touches.clone() {
                    let Some(of) = self.touches.get(touch).filter(|of| of.pair == index) else {
                        continue;
                    };
                    let at = (meeting.node, touch, of.normal);
                    if !of.opposite {
                        lists.doubtful.push(at);
                    } else if pair.corrects_distance {
                        lists.own.push(at);
                    }
                }
            }
            lists.look(fields, bodies, numbers);
            for (&(_, touch, normal), &distance) in lists.own.iter().zip(&lists.distances) {
                self.touches[touch].gap = distance - pair.distance_along(&normal);
            }
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
/// does, one body ends inside the other or goes around its corner: of the normals of the gradients that one is taken
/// along which the bodies are farthest apart.
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
    if let Some(way) = cloud.way(&own) {
        let size = surface::length(&way);
        if !cancel && cloud.margin(&own) >= LEAST_MARGIN * size {
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
    let wider = WIDER * pair.distance_along(&best);
    let [of_best, of_master, of_slave] = [best, ends[0], ends[1]].map(|normal| gap(&normal));
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
    /// Finds the distances of the bodies of a pair along the normal at each of its own nodes, eq. (8) along one normal, so
    /// that the position of the node drops out, and gathers the particles near each doubtful one.
    fn look(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        numbers: [usize; 2],
    ) {
        let Self {
            own,
            doubtful,
            probes,
            distances,
            clouds,
        } = self;
        distances.clear();
        if own.is_empty() && doubtful.is_empty() {
            return;
        }
        let shape = fields.shape();
        let search = Search {
            shape,
            planes: fields.range(),
            stencil: bodies.stencil,
        };
        let first = search.planes.start * shape.plane_nodes();
        distances.resize(own.len(), 0.0);
        if clouds.len() < doubtful.len() {
            clouds.resize_with(doubtful.len(), Cloud::default);
        }
        let clouds = &mut clouds[..doubtful.len()];
        for (cloud, &(node, ..)) in clouds.iter_mut().zip(&*doubtful) {
            (cloud.node, cloud.at) = (node - first, shape.indices(node));
            cloud.points.iter_mut().for_each(Vec::clear);
        }
        for (side, (number, sign)) in numbers.into_iter().zip([1.0, -1.0]).enumerate() {
            probes.clear();
            probes.extend(own.iter().map(|&(node, _, normal)| {
                Probe::new(node - first, shape.indices(node), normal.map(|c| sign * c))
            }));
            let Some(place) = fields.place_of(number) else {
                continue;
            };
            let face = &mut fields.faces[place];
            search.look(
                (&bodies.sets[face.body], face.interface),
                face.lines,
                probes,
                (clouds, side),
            );
            for (distance, probe) in distances.iter_mut().zip(&*probes) {
                *distance -= probe.reach;
            }
        }
    }
}
