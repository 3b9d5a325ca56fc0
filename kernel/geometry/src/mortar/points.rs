//! The points at which integrals over a contact are evaluated.
//!
//! D and M are both sums over these points and no others, so that the forces on the two bodies cancel whatever part
//! of an element is covered.

use super::PointIn;
use super::broad::{Near, by_slave};
use super::elements::Elements;
use super::space::projection::Part;
use crate::team::Team;

/// How contact is found along the slave.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detection {
    /// Integrals over the parts of elements that face each other.
    #[default]
    Mortar,
    /// At the sites of the slave, each with its share of its elements.
    NodeToSegment,
}

/// Where the master is looked for along the slave's normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Largest gap \[m\].
    pub reach: f64,
    /// Deepest penetration \[m\].
    pub depth: f64,
}

impl Search {
    /// Whether a gap lies within the search.
    #[must_use]
    pub fn contains(&self, gap: f64) -> bool {
        (-self.depth..=self.reach).contains(&gap)
    }

    /// How far from the slave a master can be seen \[m\].
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.reach.max(self.depth)
    }
}

/// Fewest elements of a slave that are worth handing to another thread.
const SHORTEST_SHARE: usize = 16;

/// Cosine between the normals of facing elements, below which they can touch.
pub const FACING: f64 = -0.2;

/// A point of the slave, the point of the master that it faces, and its share of the contact. An element has D
/// vertices: two on a segment of the plane, three on a triangle in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MortarPoint<const D: usize> {
    /// The vertices of the slave's element, and their shape functions N_i at the point.
    pub slave: [(usize, f64); D],
    /// The sites of these vertices.
    pub sites: [usize; D],
    /// The same for the master.
    pub master: [(usize, f64); D],
    /// Weight of the point in an integral over the slave, w_g J_l \[m, in space m²\].
    pub weight: f64,
}

impl<const D: usize> MortarPoint<D> {
    /// Interpolates values of the slave's vertices to the point.
    #[must_use]
    pub fn on_slave(&self, values: &[PointIn<D>]) -> PointIn<D> {
        interpolate(&self.slave, values)
    }

    /// Interpolates values of the master's vertices to the facing point.
    #[must_use]
    pub fn on_master(&self, values: &[PointIn<D>]) -> PointIn<D> {
        interpolate(&self.master, values)
    }
}

fn interpolate<const D: usize>(on: &[(usize, f64); D], values: &[PointIn<D>]) -> PointIn<D> {
    let of = |(k, share): (usize, f64)| share * values[k];
    on[1..].iter().fold(of(on[0]), |sum, k| sum + of(*k))
}

/// The points of a pair of boundaries. Kept from step to step for its memory alone.
#[derive(Clone, Debug, Default)]
pub struct MortarPoints<const D: usize> {
    /// The points, in order along the slave.
    pub points: Vec<MortarPoint<D>>,
    near: Near<D>,
    cuts: Cuts,
    /// What threads find, each at a time.
    shares: Vec<Share<D>>,
}

/// Points of some elements of the slave.
#[derive(Clone, Debug, Default)]
struct Share<const D: usize> {
    cuts: Cuts,
    points: Vec<MortarPoint<D>>,
}

/// What one element is cut into, while its points are found: memory alone.
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// Places along a segment.
    pub(super) along: Vec<f64>,
    /// Parts of a triangle.
    pub(super) parts: Vec<Part>,
}

impl<const D: usize> MortarPoints<D> {
    /// Finds the points, sharing the elements of the slave among the threads of `team`. `normals` are those of the slave's
    /// sites.
    pub fn find<B: Elements<D, T>, const T: usize>(
        &mut self,
        team: &Team,
        slave: &B,
        normals: &[PointIn<D>],
        master: &B,
        detection: Detection,
        search: Search,
    ) {
        let Self {
            points,
            near,
            cuts,
            shares,
        } = self;
        points.clear();
        near.find(slave, master, search.margin());
        match detection {
            Detection::Mortar if team.count() == 1 => {
                for pairs in near.by_slave() {
                    slave.points_of_element(normals, master, pairs, search, cuts, points);
                }
            }
            Detection::Mortar => {
                let share = SHORTEST_SHARE.max(near.pairs.len() / (4 * team.count()));
                // A share takes what is asked for at least.
                shares.resize_with(near.pairs.len().div_ceil(share), Share::default);
                for share in &mut *shares {
                    share.points.clear();
                }
                let parts = near.in_shares(share).zip(&mut *shares);
                team.each(parts, |(pairs, Share { cuts, points })| {
                    for pairs in by_slave(pairs) {
                        slave.points_of_element(normals, master, pairs, search, cuts, points);
                    }
                });
                // In the order of the elements, whoever found them.
                for share in shares {
                    points.extend_from_slice(&share.points);
                }
            }
            Detection::NodeToSegment => {
                slave.points_of_vertices(normals, master, near, search, points);
            }
        }
    }
}
