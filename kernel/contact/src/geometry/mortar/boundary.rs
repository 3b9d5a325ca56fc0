//! Boundaries: polylines of vertices without mass, checked once, and their normals.

use super::sites::{SHARP, Sites};
use super::{Point, cross};
use std::fmt;

/// Region that a chain of vertices bounds. The material lies on the left of the direction of the vertices, so outward is on
/// the right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundarySide {
    /// Outer boundary of a body, closed, counter-clockwise.
    Outer,
    /// Boundary of a hole, closed, clockwise.
    Hole,
    /// Part of a boundary, open.
    Open,
}

/// A chain of vertices in the order of the polyline; the first is not repeated at the end of a closed one.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Vertices \[m\].
    pub points: Vec<Point>,
    /// Region that it bounds.
    pub side: BoundarySide,
}

/// Fault of a boundary. Chains, vertices and segments are counted from 0; segment k begins at vertex k of
/// its chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoundaryError {
    /// Fewer vertices than a polyline needs: 3 if closed, 2 if open.
    TooFew {
        /// Number of the chain.
        chain: usize,
        /// Number of vertices.
        found: usize,
    },
    /// A coordinate is not a finite number.
    NotFinite {
        /// Number of the chain.
        chain: usize,
        /// Number of the vertex.
        vertex: usize,
    },
    /// Two vertices that follow each other coincide.
    Repeated {
        /// Number of the chain.
        chain: usize,
        /// The first of the two.
        vertex: usize,
    },
    /// The chain runs the wrong way around, or encloses nothing.
    Orientation {
        /// Number of the chain.
        chain: usize,
        /// Region that it bounds.
        side: BoundarySide,
        /// Enclosed area, positive when counter-clockwise \[m²\].
        area: f64,
    },
    /// Two segments cross, touch or lie on each other.
    Crossing {
        /// Chain and segment.
        first: [usize; 2],
        /// Chain and segment.
        second: [usize; 2],
    },
}

impl fmt::Display for BoundaryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew { chain, found } => write!(
                f,
                "polyline {chain} has {found} vertices; a closed one needs 3, an open one 2"
            ),
            Self::NotFinite { chain, vertex } => {
                write!(f, "vertex {vertex} of polyline {chain} is not finite")
            }
            Self::Repeated { chain, vertex } => write!(
                f,
                "vertex {vertex} of polyline {chain} and the next one are the same point"
            ),
            Self::Orientation { chain, side, area } => {
                let wanted = match side {
                    BoundarySide::Hole => "clockwise, as a hole does",
                    _ => "counter-clockwise, as an outer boundary does",
                };
                write!(
                    f,
                    "polyline {chain} encloses {area} m2 (positive is counter-clockwise); it must run {wanted}"
                )
            }
            Self::Crossing {
                first: [a, s],
                second: [b, t],
            } => write!(
                f,
                "segment {s} of polyline {a} crosses or touches segment {t} of polyline {b}"
            ),
        }
    }
}

impl std::error::Error for BoundaryError {}

/// Checked polylines of one body. Vertices move; how they are joined never changes.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Positions of the vertices \[m\], chain after chain.
    pub points: Vec<Point>,
    segments: Vec<[usize; 2]>,
    sides: Vec<BoundarySide>,
    around: Vec<[Option<usize>; 2]>,
    sites: Sites<2>,
}

impl Boundary {
    /// Joins chains after checking each of them and all against each other.
    ///
    /// # Errors
    /// The first thing found wrong: number of vertices, values, repeated vertices, orientation, crossings.
    pub fn new(chains: &[Chain]) -> Result<Self, BoundaryError> {
        let mut points = vec![];
        let mut segments = vec![];
        let mut origin = vec![];
        let mut sides = vec![];
        for (index, chain) in chains.iter().enumerate() {
            check_chain(index, chain)?;
            let (first, count) = (points.len(), chain.points.len());
            points.extend_from_slice(&chain.points);
            let joined = if chain.side == BoundarySide::Open {
                count - 1
            } else {
                count
            };
            for k in 0..joined {
                segments.push([first + k, first + (k + 1) % count]);
                origin.push([index, k]);
                sides.push(chain.side);
            }
        }
        if let Some([s, t]) = first_crossing(&points, &segments) {
            return Err(BoundaryError::Crossing {
                first: origin[s],
                second: origin[t],
            });
        }
        let mut around = vec![[None; 2]; points.len()];
        for (s, [a, b]) in segments.iter().enumerate() {
            around[*a][1] = Some(s);
            around[*b][0] = Some(s);
        }
        let mut boundary = Self {
            points,
            segments,
            sides,
            around,
            sites: Sites::default(),
        };
        boundary.sites = boundary.find_sites();
        Ok(boundary)
    }

    fn find_sites(&self) -> Sites<2> {
        let smooth: Vec<[usize; 2]> = self
            .around
            .iter()
            .filter_map(|around| {
                let [s, t] = [around[0]?, around[1]?];
                let cosine = self.segment_normal(s).dot(&self.segment_normal(t));
                (cosine >= SHARP).then_some([s, t])
            })
            .collect();
        Sites::new(self.points.len(), &self.segments, &smooth)
    }

    /// Sites of the normals of polylines: each vertex, and one where they turned by more than 30 degrees at the start once for
    /// each side.
    #[must_use]
    pub fn sites(&self) -> &Sites<2> {
        &self.sites
    }

    /// Vertices of each segment, in the direction of the polyline.
    #[must_use]
    pub fn segments(&self) -> &[[usize; 2]] {
        &self.segments
    }

    /// Region that the chain of a segment bounds.
    #[must_use]
    pub fn side(&self, segment: usize) -> BoundarySide {
        self.sides[segment]
    }

    /// The segments that end and begin at a vertex.
    #[must_use]
    pub fn around(&self, vertex: usize) -> [Option<usize>; 2] {
        self.around[vertex]
    }

    /// End minus start of a segment \[m\].
    #[must_use]
    pub fn edge(&self, segment: usize) -> Point {
        let [a, b] = self.segments[segment];
        self.points[b] - self.points[a]
    }

    /// Length of the longest segment \[m\].
    #[must_use]
    pub fn longest_segment(&self) -> f64 {
        (0..self.segments.len())
            .map(|s| self.edge(s).norm())
            .fold(0.0, f64::max)
    }

    /// Half the length of the segments at each site \[m\].
    #[must_use]
    pub fn tributary_lengths(&self) -> Vec<f64> {
        let mut lengths = vec![0.0; self.sites.vertices().len()];
        for (s, [a, b]) in self.sites.elements().iter().enumerate() {
            let half = 0.5 * self.edge(s).norm();
            lengths[*a] += half;
            lengths[*b] += half;
        }
        lengths
    }

    /// Outward unit normal of a segment.
    #[must_use]
    pub fn segment_normal(&self, segment: usize) -> Point {
        right_of(&self.edge(segment)).normalize()
    }

    /// Outward unit normals of the sites: mean of those of their segments, weighted by length (eq. 41). A site
    /// whose two segments fold onto each other has none (zero).
    #[must_use]
    pub fn normals(&self) -> Vec<Point> {
        let mut normals = vec![];
        self.normals_to(&mut normals);
        normals
    }

    /// [`Boundary::normals`] into a list that is used again.
    pub fn normals_to(&self, sums: &mut Vec<Point>) {
        sums.clear();
        sums.resize(self.sites.vertices().len(), Point::zeros());
        for (s, [a, b]) in self.sites.elements().iter().enumerate() {
            // The unit normal times the length is the edge turned.
            let turned = right_of(&self.edge(s));
            sums[*a] += turned;
            sums[*b] += turned;
        }
        for n in sums {
            *n = n.try_normalize(0.0).unwrap_or_default();
        }
    }

    /// Enclosed area of all closed chains together \[m²\]; holes count negative. Open chains are closed for it.
    #[must_use]
    pub fn area(&self) -> f64 {
        // Relative to a vertex, so that a body far from the origin loses no digits.
        let origin = self.points.first().copied().unwrap_or_default();
        let of = |k: usize| self.points[k] - origin;
        0.5 * self
            .segments
            .iter()
            .map(|[a, b]| cross(&of(*a), &of(*b)))
            .sum::<f64>()
    }
}

/// The vector turned by -90 degrees.
fn right_of(v: &Point) -> Point {
    Point::new(v.y, -v.x)
}

fn check_chain(chain: usize, c: &Chain) -> Result<(), BoundaryError> {
    let closed = c.side != BoundarySide::Open;
    let found = c.points.len();
    if found < if closed { 3 } else { 2 } {
        return Err(BoundaryError::TooFew { chain, found });
    }
    if let Some(vertex) = c
        .points
        .iter()
        .position(|p| !(p.x.is_finite() && p.y.is_finite()))
    {
        return Err(BoundaryError::NotFinite { chain, vertex });
    }
    let joined = if closed { found } else { found - 1 };
    if let Some(vertex) = (0..joined).find(|k| c.points[*k] == c.points[(k + 1) % found]) {
        return Err(BoundaryError::Repeated { chain, vertex });
    }
    if closed {
        let origin = c.points[0];
        let area = 0.5
            * (1..found - 1)
                .map(|k| cross(&(c.points[k] - origin), &(c.points[k + 1] - origin)))
                .sum::<f64>();
        let right = match c.side {
            BoundarySide::Hole => area < 0.0,
            _ => area > 0.0,
        };
        if !right {
            return Err(BoundaryError::Orientation {
                chain,
                side: c.side,
                area,
            });
        }
    }
    Ok(())
}

/// Slope of the sweep for crossings: no side of a usual shape is at right angles to it, or all of the side's segments
/// would be compared with each other.
const SWEEP: f64 = 0.618_033_988_749_895;

/// The first pair of segments that share a point other than the vertex that joins them. Sweeps along a slanting line, so
/// that only segments whose ranges overlap are compared.
fn first_crossing(points: &[Point], segments: &[[usize; 2]]) -> Option<[usize; 2]> {
    let range = |s: usize| {
        let [a, b] = segments[s].map(|k| points[k].x + SWEEP * points[k].y);
        [a.min(b), a.max(b)]
    };
    let mut order: Vec<usize> = (0..segments.len()).collect();
    order.sort_by(|s, t| range(*s)[0].total_cmp(&range(*t)[0]).then(s.cmp(t)));
    for (i, &s) in order.iter().enumerate() {
        for &t in order[i + 1..]
            .iter()
            .take_while(|t| range(**t)[0] <= range(s)[1])
        {
            if meet(points, segments[s], segments[t]) {
                return Some([s.min(t), s.max(t)]);
            }
        }
    }
    None
}

/// True if two segments share a point beyond a common vertex.
fn meet(points: &[Point], [a, b]: [usize; 2], [c, d]: [usize; 2]) -> bool {
    let shared = [a, b]
        .into_iter()
        .filter(|v| *v == c || *v == d)
        .collect::<Vec<_>>();
    if let [joint] = shared[..] {
        // Neighbours overlap only where they fold back onto each other.
        let p = points[if a == joint { b } else { a }] - points[joint];
        let q = points[if c == joint { d } else { c }] - points[joint];
        return cross(&p, &q) == 0.0 && p.dot(&q) > 0.0;
    }
    let [pa, pb, pc, pd] = [a, b, c, d].map(|k| points[k]);
    let side = |p: &Point, q: &Point, r: &Point| cross(&(q - p), &(r - p));
    let (s1, s2) = (side(&pa, &pb, &pc), side(&pa, &pb, &pd));
    let (s3, s4) = (side(&pc, &pd, &pa), side(&pc, &pd, &pb));
    let apart = |u: f64, v: f64| (u > 0.0 && v > 0.0) || (u < 0.0 && v < 0.0);
    if apart(s1, s2) || apart(s3, s4) {
        return false;
    }
    // On one line, or touching: the boxes decide.
    let overlap = |p: f64, q: f64, r: f64, s: f64| p.min(q) <= r.max(s) && r.min(s) <= p.max(q);
    overlap(pa.x, pb.x, pc.x, pd.x) && overlap(pa.y, pb.y, pc.y, pd.y)
}
