//! Mortar contact in the cycle: boundaries that move with bodies and rigid lines, and the part of a step in which
//! contact is found before its time step is chosen.
//!
//! Each body with a boundary has a layer of the grid to itself. A step goes: mapping to the nodes, augmented weights of
//! the vertices, gaps and forces of the pairs, time step, forces to the nodes, equation of motion, vertices.

mod cycle;
mod gradients;
mod pair;
mod surface;
mod vertices;

pub use vertices::VertexState;

use super::BodyRun;
use super::error::SetupError;
use crate::mortar::Point;
use crate::mortar::boundary::{Boundary, Chain};
use crate::mortar::broad::Bounds;
use crate::mortar::outline::outline;
use crate::mortar::pair::{PairForces, Surfaces, contact_forces};
use crate::scene::{Scene, Vertices};
use pair::{MortarPair, pair};
use surface::{Carrier, Surface};

/// What mortar contact keeps from step to step.
#[derive(Clone, Debug)]
pub(crate) struct MortarState {
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) pairs: Vec<MortarPair>,
    /// Largest time step that the contact allows now \[s\].
    pub(super) time_step: f64,
    groups: usize,
}

impl Default for MortarState {
    fn default() -> Self {
        Self {
            surfaces: vec![],
            pairs: vec![],
            time_step: f64::INFINITY,
            groups: 0,
        }
    }
}

impl MortarState {
    /// Boundaries and pairs of a scene.
    pub(super) fn new(scene: &Scene, bodies: &[BodyRun]) -> Result<Self, SetupError> {
        let mut surfaces = vec![];
        let shift = Point::new(scene.mesh.origin[0], scene.mesh.origin[1]);
        let mut add = |path: String, id: i64, chains: &[Chain], carrier: Carrier| {
            let mut boundary = Boundary::new(chains).map_err(|e| SetupError::Mortar {
                path,
                reason: e.to_string(),
            })?;
            for p in &mut boundary.points {
                *p -= shift;
            }
            let count = boundary.points.len();
            surfaces.push(Surface {
                id,
                carrier,
                boundary,
                moved: vec![Point::zeros(); count],
                force: vec![Point::zeros(); count],
                patches: vec![],
            });
            Ok::<(), SetupError>(())
        };
        for b in &scene.mortar.boundaries {
            let path = format!("boundary of body {}", b.body);
            let (Some(index), Some(body)) = (
                bodies.iter().position(|run| run.id == b.body),
                scene.bodies.iter().find(|body| body.id == b.body),
            ) else {
                continue;
            };
            let chains = match &b.vertices {
                Vertices::Given(chains) => chains.clone(),
                Vertices::Spacing(length) => {
                    outline(&body.shape, *length).map_err(|e| SetupError::Mortar {
                        path: path.clone(),
                        reason: e.to_string(),
                    })?
                }
            };
            let carrier = match &bodies[index].motion {
                Some(motion) => Carrier::Prescribed(Some(motion.clone())),
                None => Carrier::Body {
                    index,
                    follow: b.follow,
                },
            };
            add(path, b.body, &chains, carrier)?;
        }
        for line in &scene.mortar.lines {
            let carrier = Carrier::Prescribed(line.motion.clone());
            add(line.name.clone(), line.id, &line.chains, carrier)?;
        }
        let mut pairs: Vec<MortarPair> = scene
            .mortar
            .contacts
            .iter()
            .filter_map(|contact| pair(contact, &surfaces))
            .collect();
        pairs.sort_by_key(|pair| pair.id);
        let mut state = Self {
            surfaces,
            pairs,
            ..Self::default()
        };
        state.refuse_overlap(scene)?;
        Ok(state)
    }

    /// Refuses pairs whose surfaces overlap at the start.
    fn refuse_overlap(&mut self, scene: &Scene) -> Result<(), SetupError> {
        for p in 0..self.pairs.len() {
            self.meet(p);
            let pair = &self.pairs[p];
            if let Some((vertex, gap)) = pair.forces.smallest_gap()
                && gap < 0.0
            {
                let name = scene.mortar.contacts.iter().find(|c| c.id == pair.id);
                let at = self.surfaces[pair.slave].boundary.points[vertex];
                return Err(SetupError::Mortar {
                    path: name.map_or_else(String::new, |c| c.name.clone()),
                    reason: format!(
                        "the gap is {gap} m at vertex {vertex} of {}, ({}, {}) m; accepted: surfaces that are apart",
                        self.surfaces[pair.slave].id,
                        at.x + scene.mesh.origin[0],
                        at.y + scene.mesh.origin[1],
                    ),
                });
            }
        }
        Ok(())
    }

    /// Gaps and forces of a pair.
    fn meet(&mut self, p: usize) {
        let pair = &mut self.pairs[p];
        let (slave, master) = (&self.surfaces[pair.slave], &self.surfaces[pair.master]);
        let box_of = |s: &Surface, margin| Bounds::around(&s.boundary.points, margin);
        let margin = pair.law.search.reach.max(pair.law.search.depth);
        if box_of(slave, margin).overlaps(&box_of(master, 0.0)) {
            pair.forces = contact_forces(
                Surfaces {
                    slave: &slave.boundary,
                    master: &master.boundary,
                    slave_moved: &slave.moved,
                    master_moved: &master.moved,
                },
                &pair.law,
                &mut pair.slip,
            );
        } else {
            pair.forces = PairForces::default();
            pair.slip.0.fill(0.0);
        }
    }

    /// Whether anything has a boundary. Vertices follow their body also where nothing is in contact with it.
    pub(crate) fn acts(&self) -> bool {
        !self.surfaces.is_empty()
    }

    /// Bodies with a layer.
    pub(super) fn bodies(&self) -> impl Iterator<Item = usize> {
        self.surfaces.iter().filter_map(|s| match s.carrier {
            Carrier::Body { index, .. } => Some(index),
            Carrier::Prescribed(_) => None,
        })
    }
}
