//! Gaps between the bodies of pairs at the nodes where they meet.

use super::{Bodies, Meetings, PLAUSIBLE};
use crate::contact::surface::{self, Probe, Search, Side};
use crate::scene::{ContactNormal, Vector};
use crate::simulation::interactions::grid::faces::SlabFields;

/// A node with the index of its touch and the normal.
type At = (usize, usize, Vector);

/// Lists that are filled for one pair after the other.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    own: Vec<At>,
    /// With a normal that may do where the own one does not separate the bodies.
    doubtful: Vec<At>,
    probes: Vec<Probe>,
    distances: Vec<f64>,
}

impl Meetings {
    /// Measures the gaps of all pairs whose distance matters.
    pub(super) fn measure(
        &mut self,
        fields: &mut SlabFields<'_, '_, '_>,
        bodies: &Bodies<'_>,
        sides: &[Option<[usize; 2]>],
        lists: &mut Lists,
    ) {
        let Lists {
            own,
            doubtful,
            probes,
            distances: along,
        } = lists;
        let shape = fields.shape();
        for (index, (pair, numbers)) in bodies.pairs.iter().zip(sides).enumerate() {
            let Some(numbers) = numbers.filter(|_| pair.corrects_distance) else {
                continue;
            };
            own.clear();
            for meeting in &self.nodes {
                for touch in meeting.touches.clone() {
                    if self.touches[touch].pair == index {
                        own.push((meeting.node, touch, self.touches[touch].normal));
                    }
                }
            }
            distances(fields, bodies, numbers, own, probes, along);
            doubtful.clear();
            for (&(node, touch, normal), &distance) in own.iter().zip(&*along) {
                let touching = pair.distance_along(&normal);
                self.touches[touch].gap = distance - touching;
                if distance < PLAUSIBLE * touching {
                    let local = node - fields.range().start * shape.plane_nodes();
                    let [Some(master), Some(slave)] = numbers.map(|number| {
                        Some(Side {
                            mass: fields.planes(number).nodes[local][0],
                            surface: &fields.faces[fields.place_of(number)?].lines[local],
                        })
                    }) else {
                        continue;
                    };
                    // Of two that could do, both: which body is called the master must make no difference.
                    let others: &[ContactNormal] = match pair.normal {
                        ContactNormal::Collinear => &[ContactNormal::Master, ContactNormal::Slave],
                        _ => &[ContactNormal::Collinear],
                    };
                    for &other in others {
                        if let Some(other) = surface::normal(other, &master, &slave, &shape.cell) {
                            doubtful.push((node, touch, other));
                        }
                    }
                }
            }
            distances(fields, bodies, numbers, doubtful, probes, along);
            for (&(_, touch, normal), &distance) in doubtful.iter().zip(&*along) {
                let touch = &mut self.touches[touch];
                let gap = distance - pair.distance_along(&normal);
                if gap > touch.gap {
                    (touch.gap, touch.normal) = (gap, normal);
                }
            }
        }
    }
}

/// Distances of the bodies of a pair along a normal at each of some nodes: eq. (8) along one normal, so that the position
/// of the node drops out.
fn distances(
    fields: &mut SlabFields<'_, '_, '_>,
    bodies: &Bodies<'_>,
    numbers: [usize; 2],
    at: &[At],
    probes: &mut Vec<Probe>,
    distances: &mut Vec<f64>,
) {
    distances.clear();
    if at.is_empty() {
        return;
    }
    let shape = fields.shape();
    let search = Search {
        shape,
        planes: fields.range(),
        stencil: bodies.stencil,
    };
    let first = search.planes.start * shape.plane_nodes();
    distances.resize(at.len(), 0.0);
    for (number, sign) in numbers.into_iter().zip([1.0, -1.0]) {
        probes.clear();
        probes.extend(at.iter().map(|&(node, _, normal)| {
            Probe::new(node - first, shape.indices(node), normal.map(|c| sign * c))
        }));
        let Some(place) = fields.place_of(number) else {
            continue;
        };
        let face = &mut fields.faces[place];
        search.probe(&bodies.sets[face.body], face.interface, face.lines, probes);
        for (distance, probe) in distances.iter_mut().zip(&*probes) {
            *distance -= probe.reach;
        }
    }
}
