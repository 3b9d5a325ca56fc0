//! Topology of a list of triangles: vertices, edges and pseudo-normals.

use super::error::SurfaceErrorKind;
use super::{Point, cross, dot, minus, unit};
use std::collections::{BTreeMap, HashMap};

/// Corners closer than this share of the diagonal are one vertex: the resolution of 32-bit coordinates.
const WELD: f64 = 1e-7;
/// Height over longest edge below which a triangle has no area to 32-bit coordinates.
const FLAT: f64 = 1e-6;

/// Edges that belong to one triangle only.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenEdges {
    /// Their number.
    pub count: usize,
    /// Triangle with the first of them, counted from 1 as in the file.
    pub triangle: usize,
    /// Ends of the first of them \[m\].
    pub first: [Point; 2],
}

/// Topology by the edges.
pub(super) struct Topology {
    pub vertices: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
    pub normals: Vec<Point>,
    pub edge_normals: Vec<[Point; 3]>,
    pub edge_is_open: Vec<[bool; 3]>,
    pub vertex_normals: Vec<Point>,
    pub vertex_is_open: Vec<bool>,
    pub open: Option<OpenEdges>,
}

/// A triangle at an edge: the triangle, which of its edges, and whether it runs from the lower vertex number to the
/// higher.
type EdgeUse = (usize, usize, bool);

impl Topology {
    pub fn new(corners: &[[Point; 3]]) -> Result<Self, SurfaceErrorKind> {
        if corners.is_empty() {
            return Err(SurfaceErrorKind::Empty);
        }
        if corners.len() >= 1 << 31 {
            return Err(SurfaceErrorKind::TooMany {
                triangles: corners.len(),
            });
        }
        for (i, corners) in corners.iter().enumerate() {
            if corners.iter().flatten().any(|x| !x.is_finite()) {
                return Err(SurfaceErrorKind::NotFinite {
                    triangle: i + 1,
                    corners: *corners,
                });
            }
        }
        let (vertices, triangles) = weld(corners);
        let mut normals = Vec::with_capacity(triangles.len());
        for (i, t) in triangles.iter().enumerate() {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            let (ab, ac, bc) = (minus(&b, &a), minus(&c, &a), minus(&c, &b));
            let longest = dot(&ab, &ab).max(dot(&ac, &ac)).max(dot(&bc, &bc));
            let n = cross(&ab, &ac);
            let twice_area = dot(&n, &n).sqrt();
            // False too for an area that overflowed.
            let has_area = twice_area > FLAT * longest && twice_area.is_finite();
            if !has_area {
                return Err(SurfaceErrorKind::Degenerate {
                    triangle: i + 1,
                    corners: corners[i],
                });
            }
            normals.push(n.map(|c| c / twice_area));
        }
        let edges = edges(&vertices, &triangles)?;
        let mut topology = Self {
            edge_normals: vec![[[0.0; 3]; 3]; triangles.len()],
            edge_is_open: vec![[false; 3]; triangles.len()],
            vertex_normals: vertex_normals(&vertices, &triangles),
            vertex_is_open: vec![false; vertices.len()],
            open: None,
            vertices,
            triangles,
            normals,
        };
        topology.take_edges(&edges);
        Ok(topology)
    }

    /// Pseudo-normals of the edges, the mean of the normals beside them, and which are open.
    fn take_edges(&mut self, edges: &BTreeMap<(u32, u32), Vec<EdgeUse>>) {
        let mut open: Vec<(usize, usize)> = vec![];
        for uses in edges.values() {
            let mut sum = [0.0; 3];
            for &(t, _, _) in uses {
                for axis in 0..3 {
                    sum[axis] += self.normals[t][axis];
                }
            }
            // Of a fold of half a turn, whose normals cancel, either side will do.
            let normal = if dot(&sum, &sum) > 1e-24 {
                unit(&sum)
            } else {
                self.normals[uses[0].0]
            };
            for &(t, edge, _) in uses {
                self.edge_normals[t][edge] = normal;
                if uses.len() == 1 {
                    self.edge_is_open[t][edge] = true;
                    open.push((t, edge));
                    for v in [self.triangles[t][edge], self.triangles[t][(edge + 1) % 3]] {
                        self.vertex_is_open[v as usize] = true;
                    }
                }
            }
        }
        self.open = open.iter().min().map(|&(t, edge)| OpenEdges {
            count: open.len(),
            triangle: t + 1,
            first: [edge, (edge + 1) % 3].map(|i| self.vertices[self.triangles[t][i] as usize]),
        });
    }
}

/// Joins corners at the same place. Of the corners that are joined the first of the file gives the coordinates.
fn weld(corners: &[[Point; 3]]) -> (Vec<Point>, Vec<[u32; 3]>) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for x in corners.iter().flatten() {
        for axis in 0..3 {
            low[axis] = low[axis].min(x[axis]);
            high[axis] = high[axis].max(x[axis]);
        }
    }
    let size = minus(&high, &low);
    let tolerance = WELD * dot(&size, &size).sqrt();
    // Boxes of twice the tolerance: what is close lies in the same box or in one beside it.
    let cell = |x: &Point| -> [i64; 3] {
        std::array::from_fn(|axis| {
            if tolerance > 0.0 {
                ((x[axis] - low[axis]) / (2.0 * tolerance)).floor() as i64
            } else {
                0
            }
        })
    };
    let mut boxes: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut vertices: Vec<Point> = vec![];
    let mut index = |x: &Point| -> u32 {
        let home = cell(x);
        let lower = cell(&x.map(|c| c - tolerance));
        let upper = cell(&x.map(|c| c + tolerance));
        let mut found: Option<u32> = None;
        for i in lower[0]..=upper[0] {
            for j in lower[1]..=upper[1] {
                for k in lower[2]..=upper[2] {
                    for &v in boxes.get(&[i, j, k]).into_iter().flatten() {
                        let d = minus(&vertices[v as usize], x);
                        if dot(&d, &d) <= tolerance * tolerance {
                            found = Some(found.map_or(v, |f| f.min(v)));
                        }
                    }
                }
            }
        }
        found.unwrap_or_else(|| {
            let v = vertices.len() as u32;
            vertices.push(*x);
            boxes.entry(home).or_default().push(v);
            v
        })
    };
    let triangles = corners
        .iter()
        .map(|t| [0, 1, 2].map(|i| index(&t[i])))
        .collect();
    (vertices, triangles)
}

/// All edges with the triangles at them, or the first that more than two share, or that two run through in the same
/// direction.
fn edges(
    vertices: &[Point],
    triangles: &[[u32; 3]],
) -> Result<BTreeMap<(u32, u32), Vec<EdgeUse>>, SurfaceErrorKind> {
    let mut edges: BTreeMap<(u32, u32), Vec<EdgeUse>> = BTreeMap::new();
    for (t, triangle) in triangles.iter().enumerate() {
        for edge in 0..3 {
            let (a, b) = (triangle[edge], triangle[(edge + 1) % 3]);
            edges
                .entry((a.min(b), a.max(b)))
                .or_default()
                .push((t, edge, a < b));
        }
    }
    let ends = |&(a, b): &(u32, u32)| [a, b].map(|v| vertices[v as usize]);
    let numbers = |uses: &[EdgeUse]| -> Vec<usize> { uses.iter().map(|u| u.0 + 1).collect() };
    let crowded = edges.iter().filter(|(_, uses)| uses.len() > 2);
    if let Some((edge, uses)) = crowded.min_by_key(|(_, uses)| numbers(uses)) {
        return Err(SurfaceErrorKind::NonManifold {
            triangles: numbers(uses),
            edge: ends(edge),
        });
    }
    let pairs = edges.iter().filter(|(_, uses)| uses.len() == 2);
    // Of two neighbours that share all three vertices one is the other again, or its back.
    let same = |uses: &[EdgeUse]| {
        let sorted = |t: usize| {
            let mut v = triangles[t];
            v.sort_unstable();
            v
        };
        sorted(uses[0].0) == sorted(uses[1].0)
    };
    let twice = pairs.clone().filter(|(_, uses)| same(uses));
    if let Some((edge, uses)) = twice.min_by_key(|(_, uses)| numbers(uses)) {
        return Err(SurfaceErrorKind::NonManifold {
            triangles: numbers(uses),
            edge: ends(edge),
        });
    }
    let turned = pairs.filter(|(_, uses)| uses[0].2 == uses[1].2);
    if let Some((edge, uses)) = turned.min_by_key(|(_, uses)| numbers(uses)) {
        return Err(SurfaceErrorKind::Orientation {
            triangles: [uses[0].0 + 1, uses[1].0 + 1],
            edge: ends(edge),
        });
    }
    Ok(edges)
}

/// Normals of the triangles at each vertex, weighted by their angle there, so that they do not depend on how a
/// surface is cut into triangles (Bærentzen and Aanæs 2005).
fn vertex_normals(vertices: &[Point], triangles: &[[u32; 3]]) -> Vec<Point> {
    let mut sums = vec![[0.0; 3]; vertices.len()];
    for triangle in triangles {
        let x = triangle.map(|v| vertices[v as usize]);
        let n = unit(&cross(&minus(&x[1], &x[0]), &minus(&x[2], &x[0])));
        for i in 0..3 {
            let (a, b) = (minus(&x[(i + 1) % 3], &x[i]), minus(&x[(i + 2) % 3], &x[i]));
            let across = cross(&a, &b);
            let angle = libm::atan2(dot(&across, &across).sqrt(), dot(&a, &b));
            for axis in 0..3 {
                sums[triangle[i] as usize][axis] += angle * n[axis];
            }
        }
    }
    // Normals that cancel, at the tip of a fold of half a turn, leave no direction; any unit vector will do there.
    sums.iter()
        .map(|sum| {
            if dot(sum, sum) > 1e-24 {
                unit(sum)
            } else {
                [0.0, 0.0, 1.0]
            }
        })
        .collect()
}
