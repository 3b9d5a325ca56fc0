//! Ties of the vertices of a boundary to particles of its body, from the start to the end.
//!
//! A vertex is where the particles that were around it at the start say, X_v + sum_p w_p (x_p - X_p), with weights that
//! reproduce every affine motion ([`affine_weights`]). They belong to the places at the start, so that nothing is
//! integrated and nothing can drift. Beside planes that mirror the body its images count.

use super::mirrors::Mirrors;
use crate::geometry::mortar::PointIn;
use crate::geometry::mortar::tie::affine_weights;
use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::simulation::BodyRun;
use std::collections::HashMap;
use std::ops::Range;

/// Support of the weights in spacings of the particles: it reaches two rows. With 2 the pressure under a ball of 2.4 cells
/// is smoothed, with 4/3 that under a disk of 3.4 cells is noisy (`proctor verify --quick hertz hertz-sphere`).
const SUPPORT: f64 = 1.5;

/// Least variance of the places of particles over the square of that support, for them to span a direction.
const LEAST: f64 = 0.01;

/// Factors on the width of the support, tried in this order until the particles in it span all directions.
const WIDER: [f64; 3] = [1.0, 2.0, 4.0];

/// Farthest that the first row of particles of a body that a plane cuts is from it, in half-lengths of a particle.
const TOUCHES: f64 = 1.01;

/// Stands for particles that no vertex is tied to.
const UNTIED: u32 = u32::MAX;

/// The particles that each vertex of a boundary is tied to.
#[derive(Clone, Debug, Default)]
pub(super) struct VertexTies<const D: usize> {
    /// Identifier of the first particle of the body.
    first: u64,
    /// Number among the tied particles of each particle of the body, by its identifier.
    numbers: Vec<u32>,
    /// Places of the tied particles at the start, relative to the mesh \[m\].
    start: Vec<PointIn<D>>,
    list: Vec<VertexTie<D>>,
    /// The ties of each vertex; none where the particles around it do not span all directions.
    of_vertices: Vec<Range<usize>>,
}

/// Share of a particle in a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexTie<const D: usize> {
    /// Number among the tied particles.
    pub(super) particle: usize,
    /// Weight of its displacement along each axis: those of its images beyond planes have other signs.
    pub(super) weights: PointIn<D>,
}

/// A particle or its image.
struct Candidate<const D: usize> {
    p: usize,
    at: PointIn<D>,
    /// Factor on the displacement of the particle.
    signs: PointIn<D>,
}

impl<const D: usize> VertexTies<D> {
    /// Ties vertices to the particles of a body at the start.
    pub(super) fn new(
        vertices: &[PointIn<D>],
        (set, body): (&ParticleSet, &BodyRun),
        mirrors: &Mirrors,
    ) -> Self {
        let support =
            PointIn::<D>::from_fn(|axis, _| SUPPORT * 2.0 * body.particle_half_length[axis]);
        let candidates = candidates::<D>(set, body, &support, mirrors);
        let mut in_cells: HashMap<[i64; D], Vec<usize>> = HashMap::new();
        let cell_of =
            |x: &PointIn<D>| std::array::from_fn(|axis| (x[axis] / support[axis]).floor() as i64);
        for (c, candidate) in candidates.iter().enumerate() {
            in_cells.entry(cell_of(&candidate.at)).or_default().push(c);
        }
        let first = set.id.iter().copied().min().unwrap_or(0);
        let last = set.id.iter().copied().max().unwrap_or(0);
        let mut ties = Self {
            first,
            numbers: vec![
                UNTIED;
                if set.is_empty() {
                    0
                } else {
                    (last - first) as usize + 1
                }
            ],
            ..Self::default()
        };
        for x_v in vertices {
            let begin = ties.list.len();
            for wider in WIDER {
                let reach = (1.5 * wider).ceil() as i64;
                let mut near: Vec<usize> = around(cell_of(x_v), reach)
                    .filter_map(|cell| in_cells.get(&cell))
                    .flatten()
                    .copied()
                    .collect();
                // In the order of the identifiers, whatever the cells are.
                near.sort_unstable_by_key(|&c| (set.id[candidates[c].p], c));
                let points: Vec<PointIn<D>> = near.iter().map(|&c| candidates[c].at).collect();
                let least = LEAST / (wider * wider);
                let found = affine_weights(&points, x_v, &(support * wider), least);
                if let Some(weights) = found {
                    for (&c, w) in near.iter().zip(weights).filter(|(_, w)| *w != 0.0) {
                        ties.add(set, &candidates[c], w);
                    }
                    break;
                }
            }
            ties.of_vertices.push(begin..ties.list.len());
        }
        ties
    }

    fn add(&mut self, set: &ParticleSet, candidate: &Candidate<D>, weight: f64) {
        let number = &mut self.numbers[(set.id[candidate.p] - self.first) as usize];
        if *number == UNTIED {
            *number = self.start.len() as u32;
            self.start.push(position(set, candidate.p));
        }
        self.list.push(VertexTie {
            particle: *number as usize,
            weights: candidate.signs * weight,
        });
    }

    /// Number of tied particles.
    pub(super) fn particles(&self) -> usize {
        self.start.len()
    }

    /// Number of vertices.
    pub(super) fn vertices(&self) -> usize {
        self.of_vertices.len()
    }

    /// Ties of a vertex.
    pub(super) fn of(&self, vertex: usize) -> &[VertexTie<D>] {
        &self.list[self.of_vertices[vertex].clone()]
    }

    /// The sum of what the tied particles have at a vertex.
    pub(super) fn sum(&self, vertex: usize, values: &[PointIn<D>]) -> PointIn<D> {
        let mut sum = PointIn::zeros();
        for tie in self.of(vertex) {
            sum += tie.weights.component_mul(&values[tie.particle]);
        }
        sum
    }

    /// Adds what a vertex has to the tied particles: the transpose of [`VertexTies::sum`].
    pub(super) fn spread(&self, vertex: usize, value: &PointIn<D>, values: &mut [PointIn<D>]) {
        for tie in self.of(vertex) {
            values[tie.particle] += tie.weights.component_mul(value);
        }
    }

    /// Finds the place of each tied particle in its set now, `None` for those that were removed. `places` is what was found
    /// before: nothing is searched as long as it holds.
    pub(super) fn find(&self, set: &ParticleSet, places: &mut Vec<Option<usize>>) {
        let number = |p: usize| {
            let at = set.id.get(p)?.checked_sub(self.first)? as usize;
            self.numbers.get(at).copied()
        };
        let holds = places.len() == self.start.len()
            && (places.iter().enumerate())
                .all(|(k, place)| place.is_some_and(|p| number(p) == Some(k as u32)));
        if holds {
            return;
        }
        places.clear();
        places.resize(self.start.len(), None);
        for p in 0..set.len() {
            if let Some(k) = number(p)
                && k != UNTIED
            {
                places[k as usize] = Some(p);
            }
        }
    }

    /// Finds how far the tied particles are from where they were at the start \[m\]; NaN for those that were removed.
    pub(super) fn displacements(
        &self,
        set: &ParticleSet,
        places: &[Option<usize>],
        displacements: &mut Vec<PointIn<D>>,
    ) {
        let of = |(place, start): (&Option<usize>, &PointIn<D>)| match place {
            Some(p) => position::<D>(set, *p) - start,
            None => PointIn::repeat(f64::NAN),
        };
        displacements.clear();
        displacements.extend(places.iter().zip(&self.start).map(of));
    }
}

fn position<const D: usize>(set: &ParticleSet, p: usize) -> PointIn<D> {
    PointIn::from_fn(|axis, _| set.columns[Layout::POSITION + axis][p])
}

/// The particles of a body and their images beyond the planes that cut it.
fn candidates<const D: usize>(
    set: &ParticleSet,
    body: &BodyRun,
    support: &PointIn<D>,
    mirrors: &Mirrors,
) -> Vec<Candidate<D>> {
    // A vertex in the plane reaches no farther.
    let farthest = 1.5 * WIDER[WIDER.len() - 1] * support;
    let mut all: Vec<Candidate<D>> = (0..set.len())
        .map(|p| Candidate {
            p,
            at: position(set, p),
            signs: PointIn::repeat(1.0),
        })
        .collect();
    for axis in 0..D {
        let cell = body.mapping.cell[axis];
        let touching = TOUCHES * body.particle_half_length[axis];
        let mut images = vec![];
        for (plane, signs) in mirrors.along::<D>(axis, cell) {
            let distance = |c: &Candidate<D>| (c.at[axis] - plane).abs();
            if !all.iter().any(|c| distance(c) <= touching) {
                continue;
            }
            for c in all.iter().filter(|c| distance(c) < farthest[axis]) {
                let mut at = c.at;
                at[axis] = 2.0 * plane - at[axis];
                images.push(Candidate {
                    p: c.p,
                    at,
                    signs: c.signs.component_mul(&signs),
                });
            }
        }
        all.append(&mut images);
    }
    all
}

/// The cells of a cube around one, the last axis fastest.
fn around<const D: usize>(middle: [i64; D], reach: i64) -> impl Iterator<Item = [i64; D]> {
    let width = 2 * reach + 1;
    (0..width.pow(D as u32)).map(move |k| {
        std::array::from_fn(|axis| {
            middle[axis] - reach + k / width.pow((D - 1 - axis) as u32) % width
        })
    })
}
