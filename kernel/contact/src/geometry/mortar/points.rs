//! The points at which integrals over a contact are evaluated.
//!
//! D and M are both sums over these points and no others, so that the forces on the two bodies cancel whatever part
//! of an element is covered.

use super::PointIn;
use super::broad::{NearElements, by_slave};
use super::elements::Elements;
use super::space::projection::CoveredPart;
use proctor_geometry::team::Team;

/// Detection of contact along the slave.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detection {
    /// Integrals over the parts of elements that face each other.
    #[default]
    Mortar,
    /// Search at the sites of the slave, each with its share of its elements.
    NodeToSegment,
}

/// Search of the master along the slave's normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MasterSearch {
    /// Largest gap \[m\].
    pub reach: f64,
    /// Deepest penetration \[m\].
    pub depth: f64,
}

impl MasterSearch {
    /// True if a gap lies within the search.
    #[must_use]
    pub fn contains(&self, gap: f64) -> bool {
        (-self.depth..=self.reach).contains(&gap)
    }

    /// Largest distance from the slave at which a master is found \[m\].
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
    near: NearElements<D>,
    /// Results of threads, each at a time, along the slave.
    shares: Vec<SlaveShare<D>>,
}

/// Points of some elements of the slave.
#[derive(Clone, Debug, Default)]
struct SlaveShare<const D: usize> {
    pairs: Vec<[usize; 2]>,
    cuts: Cuts,
    points: Vec<MortarPoint<D>>,
    apart: Vec<PointDifferences<D>>,
}

/// Distance of master and slave at a point, and similar differences.
pub type PointDifferences<const D: usize> = [PointIn<D>; 4];

/// Pieces of one element, while its points are found: memory alone.
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// Places along a segment.
    pub(super) along: Vec<f64>,
    /// Parts of a triangle.
    pub(super) parts: Vec<CoveredPart>,
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
        search: MasterSearch,
    ) {
        let Self { near, shares } = self;
        for share in &mut *shares {
            share.points.clear();
        }
        if detection == Detection::NodeToSegment {
            near.find(slave, master, search.margin());
            shares.resize_with(shares.len().max(1), SlaveShare::default);
            return slave.points_of_vertices(normals, master, near, search, &mut shares[0].points);
        }
        near.look(slave, master, search.margin());
        let near = &*near;
        let slaves = near.slaves();
        let share = match team.count() {
            1 => slaves.len().max(1),
            threads => slaves.len().div_ceil(4 * threads).max(SHORTEST_SHARE),
        };
        let count = slaves.len().div_ceil(share);
        shares.resize_with(shares.len().max(count), SlaveShare::default);
        team.each(slaves.chunks(share).zip(shares), |(slaves, share)| {
            let SlaveShare {
                pairs,
                cuts,
                points,
                ..
            } = share;
            pairs.clear();
            near.pairs_of(slaves, pairs);
            for pairs in by_slave(pairs) {
                slave.points_of_element(normals, master, pairs, search, cuts, points);
            }
        });
    }

    /// The points, in order along the slave, whoever found them.
    pub fn iter(&self) -> impl Iterator<Item = &MortarPoint<D>> {
        self.shares.iter().flat_map(|share| &share.points)
    }

    /// Finds differences at each point, shared among the threads.
    pub fn compare(
        &mut self,
        team: &Team,
        differences: impl Fn(&MortarPoint<D>) -> PointDifferences<D> + Send + Sync,
    ) {
        team.each(self.shares.iter_mut(), |share| {
            share.apart.clear();
            share.apart.extend(share.points.iter().map(&differences));
        });
    }

    /// The points with what was found at each.
    pub fn compared(&self) -> impl Iterator<Item = (&MortarPoint<D>, &PointDifferences<D>)> {
        let shares = self.shares.iter();
        shares.flat_map(|share| share.points.iter().zip(&share.apart))
    }
}
