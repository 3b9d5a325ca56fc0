//! Sites of normals, gaps and pressures on a slave: one at each vertex, one for each side of a sharp corner.
//!
//! The mean normal of a sharp corner (eq. 41) belongs to neither of its sides: the leading corner of a sliding block would
//! press and rub along a slanted plane, beyond Coulomb's cone of the plane that it slides on.

/// Cosine between the normals of neighbours, below which what is between them is sharp: 30 degrees, which twelve equal
/// sides of a round body do not turn by.
pub const SHARP: f64 = 0.866_025_403_784_438_6 - 1.0e-9;

/// The sites of a boundary of elements with D vertices each. The first site of a vertex has its number; those of the other
/// sides of sharp corners follow after all vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sites<const D: usize> {
    vertices: Vec<usize>,
    elements: Vec<[usize; D]>,
}

impl<const D: usize> Sites<D> {
    /// Sites of a number of vertices with elements between them. `smooth` are neighbours that have a normal in common at the
    /// vertices that both have.
    #[must_use]
    pub fn new(vertices: usize, elements: &[[usize; D]], smooth: &[[usize; 2]]) -> Self {
        // Corners of elements that share a site point to one before them.
        let mut first: Vec<usize> = (0..elements.len() * D).collect();
        for &[s, t] in smooth {
            for (i, v) in elements[s].iter().enumerate() {
                for (j, w) in elements[t].iter().enumerate() {
                    if v == w {
                        let (a, b) = (root(&first, s * D + i), root(&first, t * D + j));
                        first[a.max(b)] = a.min(b);
                    }
                }
            }
        }
        let mut sites = Self {
            vertices: (0..vertices).collect(),
            elements: elements.to_vec(),
        };
        let mut taken = vec![false; vertices];
        for corner in 0..first.len() {
            let (element, end) = (corner / D, corner % D);
            let vertex = elements[element][end];
            let head = root(&first, corner);
            sites.elements[element][end] = if head != corner {
                sites.elements[head / D][head % D]
            } else if taken[vertex] {
                sites.vertices.push(vertex);
                sites.vertices.len() - 1
            } else {
                taken[vertex] = true;
                vertex
            };
        }
        sites
    }

    /// The vertex of each site.
    #[must_use]
    pub fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The sites of each element, in the order of its vertices.
    #[must_use]
    pub fn elements(&self) -> &[[usize; D]] {
        &self.elements
    }
}

/// The first of the corners that share a site with one.
fn root(first: &[usize], mut corner: usize) -> usize {
    while first[corner] != corner {
        corner = first[corner];
    }
    corner
}
