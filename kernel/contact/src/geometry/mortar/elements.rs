//! Elements: the interface of a boundary to contact, in either dimension.

use super::PointIn;
use super::broad::NearElements;
use super::points::{Cuts, MasterSearch, MortarPoint};
use super::sites::Sites;

/// A boundary made of straight elements with D vertices each in D dimensions, and T = D - 1 tangents: segments in the
/// plane, triangles in space.
pub trait Elements<const D: usize, const T: usize>: Sync {
    /// Positions of the vertices \[m\].
    fn points(&self) -> &[PointIn<D>];

    /// The same, to move them.
    fn points_mut(&mut self) -> &mut [PointIn<D>];

    /// Vertices of each element.
    fn elements(&self) -> &[[usize; D]];

    /// Length of the longest segment or edge \[m\].
    fn longest(&self) -> f64;

    /// Sites of the normals of this boundary.
    fn sites(&self) -> &Sites<D>;

    /// Outward unit normals of the sites, means of those of their elements (eq. 41), into a list that is used again.
    fn normals_to(&self, normals: &mut Vec<PointIn<D>>);

    /// Unit vectors at a site at right angles to its normal and to each other. They turn with the boundary, so that
    /// numbers kept along them do too.
    fn tangents(&self, site: usize, normal: &PointIn<D>) -> [PointIn<D>; T];

    /// Adds the points at which integrals over the contact of one element of this slave are evaluated. `pairs` are that
    /// element and those of the master near it, `normals` those of the slave's sites, `cuts` is memory.
    fn points_of_element(
        &self,
        normals: &[PointIn<D>],
        master: &Self,
        pairs: &[[usize; 2]],
        search: MasterSearch,
        cuts: &mut Cuts,
        points: &mut Vec<MortarPoint<D>>,
    );

    /// Adds a point at each site of this slave that faces the master, with the site's share of its elements.
    fn points_of_vertices(
        &self,
        normals: &[PointIn<D>],
        master: &Self,
        near: &NearElements<D>,
        search: MasterSearch,
        points: &mut Vec<MortarPoint<D>>,
    );

    /// The velocity of a vertex without what would take it off a plane of symmetry that it lies in \[m/s\].
    fn held(&self, _vertex: usize, velocity: PointIn<D>) -> PointIn<D> {
        velocity
    }

    /// Overlap of this slave and a master, in words; nothing where they are apart or touch. In space only
    /// faces that face each other are compared, by their gap.
    fn lies_in(&self, _master: &Self) -> Option<String> {
        None
    }

    /// Place where edges of this slave and a master meet at a distance between `-depth` and `reach` \[m\], which contact of
    /// elements does not see, and the distance. In the plane there are none.
    fn edges_that_meet(
        &self,
        _master: &Self,
        _reach: f64,
        _depth: f64,
    ) -> Option<(PointIn<D>, f64)> {
        None
    }
}
