//! Mortar contact in the cycle: boundaries that move with bodies and rigid lines, and the part of a step in which
//! contact is found before its time step is chosen.
//!
//! Each body with a boundary has a layer of the grid to itself. A step goes: mapping to the nodes, augmented weights of
//! the vertices, gaps and forces of the pairs, time step, forces to the nodes, equation of motion, vertices.

use super::acting::Acting;
use super::contact::{all, number_of, shared_loads};
use super::error::{SetupError, StepError, StepErrorKind};
use super::passes::{Sums, bodies_onto, total, trial};
use super::{BodyRun, Simulation, history_value};
use crate::grid::{ActiveRows, GHOSTS_BELOW, GridShape, Line};
use crate::mortar::Point;
use crate::mortar::bound::NodalStiffness;
use crate::mortar::boundary::{Boundary, Chain};
use crate::mortar::broad::Bounds;
use crate::mortar::law::{FLOOR, Friction, NormalLaw};
use crate::mortar::motion::{Follow, NodalGradient, vertex_velocity};
use crate::mortar::outline::outline;
use crate::mortar::pair::{PairForces, PairLaw, Slip, Surfaces, contact_forces};
use crate::mortar::segments::Search;
use crate::mortar::weights::VertexWeights;
use crate::particles::{Layout, ParticleSet};
use crate::scene::{Enforcement, History, MortarContact, Scene, Vector, Vertices};
use crate::stage::p2g::Carry;
use crate::stage::solve::{EmptyNode, Forces, PlaneSums};
use crate::weights::{axis_weights_at, base_offset};
use nalgebra::Matrix2;

/// What moves the vertices of a surface.
#[derive(Clone, Debug)]
enum Carrier {
    /// The nodes of a body's layer.
    Body {
        /// Index of the body.
        index: usize,
        follow: Follow,
    },
    /// A prescribed velocity.
    Prescribed(Option<History>),
}

/// A boundary in motion; positions relative to the origin of the mesh.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    pub(crate) id: i64,
    carrier: Carrier,
    pub(crate) boundary: Boundary,
    /// Displacement of the vertices in the last step \[m\].
    pub(crate) moved: Vec<Point>,
    /// Contact force on the vertices in this step \[N\].
    force: Vec<Point>,
    /// Augmented weights and masses of the patches, for surfaces of bodies.
    patches: Vec<Patch>,
}

#[derive(Clone, Copy, Debug)]
struct Patch {
    weights: VertexWeights,
    masses: [f64; 9],
    nodes: [usize; 9],
}

/// A pair of surfaces.
#[derive(Clone, Debug)]
pub(crate) struct MortarPair {
    id: i64,
    slave: usize,
    master: usize,
    law: PairLaw,
    critical_gap: f64,
    pub(crate) slip: Slip,
    forces: PairForces,
}

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

    /// Bodies with a layer.
    pub(super) fn bodies(&self) -> impl Iterator<Item = usize> {
        self.surfaces.iter().filter_map(|s| match s.carrier {
            Carrier::Body { index, .. } => Some(index),
            Carrier::Prescribed(_) => None,
        })
    }
}

fn pair(contact: &MortarContact, surfaces: &[Surface]) -> Option<MortarPair> {
    let index = |id: i64| surfaces.iter().position(|s| s.id == id);
    let (slave, master) = (index(contact.slave)?, index(contact.master)?);
    let rigid = |s: usize| matches!(surfaces[s].carrier, Carrier::Prescribed(_));
    if rigid(slave) && rigid(master) {
        return None;
    }
    let longest = surfaces[slave].boundary.longest_segment();
    let normal = match contact.enforcement {
        Enforcement::Barrier => NormalLaw::Barrier {
            stiffness: contact.normal_stiffness,
            critical_gap: contact.critical_gap,
            floor: FLOOR,
        },
        Enforcement::Penalty => NormalLaw::Penalty {
            stiffness: contact.normal_stiffness,
        },
    };
    Some(MortarPair {
        id: contact.id,
        slave,
        master,
        law: PairLaw {
            normal,
            friction: (contact.friction > 0.0).then_some(Friction {
                coefficient: contact.friction,
                stiffness: contact.tangential_stiffness,
            }),
            detection: contact.detection,
            // Beyond the critical gap for the slip before contact, and as deep as a segment is long.
            search: Search {
                reach: contact.critical_gap + longest,
                depth: contact.critical_gap.max(longest),
            },
        },
        critical_gap: contact.critical_gap,
        slip: Slip(vec![0.0; surfaces[slave].boundary.points.len()]),
        forces: PairForces::default(),
    })
}

/// What a vertex of a slave feels, for output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexState {
    /// Position in the coordinates of the scene \[m\].
    pub position: Vector,
    /// Outward normal; zero where nothing is faced.
    pub normal: Vector,
    /// Weighted gap \[m\]; infinite where nothing is faced.
    pub gap: f64,
    /// Contact pressure \[Pa\].
    pub pressure: f64,
    /// Tangential traction \[Pa\].
    pub traction: f64,
    /// Length that belongs to the vertex \[m\].
    pub length: f64,
}

impl Simulation {
    /// Vertices of the slave of a mortar contact as of the last detection, in order of the polyline.
    #[must_use]
    pub fn mortar_vertices(&self, contact: i64) -> Option<Vec<VertexState>> {
        let pair = self.mortar.pairs.iter().find(|p| p.id == contact)?;
        let points = &self.mortar.surfaces[pair.slave].boundary.points;
        let states = points.iter().enumerate().map(|(k, x)| {
            let seen = pair.forces.vertices.get(k).copied().flatten();
            VertexState {
                position: self.in_scene(x),
                normal: seen.map_or([0.0; 3], |v| [v.normal.x, v.normal.y, 0.0]),
                gap: seen.map_or(f64::INFINITY, |v| v.gap),
                pressure: seen.map_or(0.0, |v| v.pressure),
                traction: seen.map_or(0.0, |v| v.traction),
                length: seen.map_or(0.0, |v| v.length),
            }
        });
        Some(states.collect())
    }

    /// Vertices of the boundary of a body or of a rigid line, in the coordinates of the scene \[m\].
    #[must_use]
    pub fn boundary_vertices(&self, id: i64) -> Option<Vec<Vector>> {
        let surface = self.mortar.surfaces.iter().find(|s| s.id == id)?;
        let points = surface.boundary.points.iter();
        Some(points.map(|x| self.in_scene(x)).collect())
    }

    /// Mortar contact force on the vertices of a body or rigid line in the last step \[N\].
    #[must_use]
    pub fn mortar_force(&self, id: i64) -> Option<Vector> {
        let surface = self.mortar.surfaces.iter().find(|s| s.id == id)?;
        let sum: Point = surface.force.iter().sum();
        Some([sum.x, sum.y, 0.0])
    }

    /// Energy stored in the normal laws of mortar contact as of the last detection \[J\].
    #[must_use]
    pub fn mortar_energy(&self) -> f64 {
        self.mortar.pairs.iter().map(|p| p.forces.energy).sum()
    }

    fn in_scene(&self, x: &Point) -> Vector {
        let origin = self.origin();
        [x.x + origin[0], x.y + origin[1], 0.0]
    }

    /// Gives each body with a boundary its layer, after a sort.
    pub(crate) fn set_mortar_layers(&mut self) {
        let mut bodies: Vec<usize> = self.mortar.bodies().collect();
        bodies.sort_by_key(|&i| self.bodies[i].id);
        for &i in &bodies {
            self.bodies[i].in_layer = true;
        }
        self.contact
            .layers
            .set(&bodies, &self.sets, &self.field, self.stencil);
    }

    /// The first part of a step with mortar contact: mapping, weights, gaps and forces, and the time step that they
    /// allow.
    pub(super) fn meet_boundaries(&mut self) -> Result<(), StepError> {
        let acting = self.acting(self.clock.dt_before);
        let mapping = bodies_onto(
            &self.plan,
            &self.sets,
            &self.bodies,
            self.lanes,
            self.stencil,
            Carry::All,
        );
        let groups =
            self.contact
                .layers
                .visit(&mut self.field, self.pool.as_ref(), |mut fields| {
                    let mut groups = 0;
                    for planes in all(&mut fields) {
                        planes.clear();
                    }
                    groups += mapping.run(&mut fields.common);
                    for layer in &mut fields.layers {
                        groups += mapping.map(layer.body, &mut layer.planes);
                    }
                    for planes in all(&mut fields) {
                        planes.fold(&acting.walls, true, true);
                        planes.velocities();
                    }
                    groups
                });
        self.mortar.groups = groups.into_iter().sum();
        self.weigh_vertices()?;
        for surface in &mut self.mortar.surfaces {
            surface.force.fill(Point::zeros());
        }
        for p in 0..self.mortar.pairs.len() {
            self.mortar.meet(p);
            self.judge_pair(p)?;
            let pair = &self.mortar.pairs[p];
            for (surface, forces) in [
                (pair.slave, &pair.forces.slave),
                (pair.master, &pair.forces.master),
            ] {
                let own = &mut self.mortar.surfaces[surface].force;
                for (sum, f) in own.iter_mut().zip(forces) {
                    *sum += f;
                }
            }
        }
        self.mortar.time_step = self.contact_time_step();
        Ok(())
    }

    /// Augmented weights of the vertices of all bodies.
    fn weigh_vertices(&mut self) -> Result<(), StepError> {
        let shape = &self.field.shape;
        let mut lost = None;
        for surface in &mut self.mortar.surfaces {
            let Carrier::Body { index, .. } = surface.carrier else {
                continue;
            };
            let Some(layer) = self.contact.layers.list.iter().find(|l| l.body == index) else {
                continue;
            };
            let mapping = &self.bodies[index].mapping;
            let half_length = mapping.half_length[0].min(mapping.half_length[1]).min(0.5);
            surface.patches.clear();
            for (vertex, x) in surface.boundary.points.iter().enumerate() {
                let xi = Point::new(x.x * mapping.inverse_cell[0], x.y * mapping.inverse_cell[1]);
                let raw = VertexWeights::new(mapping.family, &xi, half_length);
                let nodes = nodes_of_patch(raw.base, shape);
                let masses = std::array::from_fn(|k| {
                    nodes[k].map_or(0.0, |n| mass_of(n, shape, &layer.rows, layer.nodes.lines()))
                });
                if let Ok(weights) = raw.augmented(&masses) {
                    surface.patches.push(Patch {
                        weights,
                        masses,
                        nodes: nodes.map(Option::unwrap_or_default),
                    });
                } else {
                    lost = lost.or(Some((surface.id, vertex, *x)));
                    break;
                }
            }
        }
        match lost {
            None => Ok(()),
            Some((body, vertex, x)) => Err(self.error(StepErrorKind::VertexLost {
                body,
                vertex,
                position: self.in_scene(&x),
            })),
        }
    }

    /// Stops where a pair approached by more than half the critical gap in the last step, and may do so again, or is
    /// deeper in each other than the critical gap.
    fn judge_pair(&self, p: usize) -> Result<(), StepError> {
        let pair = &self.mortar.pairs[p];
        let (slave, master) = (
            &self.mortar.surfaces[pair.slave],
            &self.mortar.surfaces[pair.master],
        );
        let error = |vertex: usize, approach: f64| {
            self.error(StepErrorKind::Tunnelling {
                bodies: [master.id, slave.id],
                position: Some(self.in_scene(&slave.boundary.points[vertex])),
                approach,
                distance: 0.5 * pair.critical_gap,
            })
        };
        if let Some((vertex, approach)) = pair.forces.largest_approach()
            && approach > 0.5 * pair.critical_gap
        {
            return Err(error(vertex, approach));
        }
        if let Some((vertex, gap)) = pair.forces.smallest_gap()
            && gap < -pair.critical_gap
        {
            return Err(self.error(StepErrorKind::Penetration {
                bodies: [master.id, slave.id],
                position: self.in_scene(&slave.boundary.points[vertex]),
                gap,
            }));
        }
        Ok(())
    }

    /// Time step that the stiffness of all contacts allows \[s\].
    fn contact_time_step(&self) -> f64 {
        let mut most = f64::INFINITY;
        for (s, surface) in self.mortar.surfaces.iter().enumerate() {
            let mut nodes = NodalStiffness::default();
            for pair in &self.mortar.pairs {
                for (of, stiffness) in [
                    (pair.slave, &pair.forces.slave_stiffness),
                    (pair.master, &pair.forces.master_stiffness),
                ] {
                    if of != s {
                        continue;
                    }
                    for (patch, k) in surface.patches.iter().zip(stiffness) {
                        nodes.add(&patch.weights, &patch.masses, *k);
                    }
                }
            }
            most = most.min(nodes.time_step());
        }
        most
    }

    /// The second part: forces of the contacts to the nodes, equation of motion; the number of vertices under pressure.
    pub(super) fn solve_with_mortar(&mut self, acting: &Acting) -> Result<usize, StepError> {
        for surface in &self.mortar.surfaces {
            let Carrier::Body { index, .. } = surface.carrier else {
                continue;
            };
            let layers = &mut self.contact.layers.list;
            let Some(layer) = layers.iter_mut().find(|l| l.body == index) else {
                continue;
            };
            let lines = layer.nodes.lines_mut();
            for (patch, force) in surface.patches.iter().zip(&surface.force) {
                if *force == Point::zeros() {
                    continue;
                }
                for k in 0..9 {
                    let w = patch.weights.weights[k];
                    if w > 0.0 {
                        let line = &mut lines[patch.nodes[k]];
                        line[4] += w * force.x;
                        line[5] += w * force.y;
                    }
                }
            }
        }
        let forces = Forces {
            gravity: self.scene.gravity,
            loads: &self.loads,
            local_damping: self.plan.local_damping,
            kick: acting.kick,
        };
        let measure = self.plan.measure;
        let driven = vec![false; self.bodies.len()];
        let results =
            self.contact
                .layers
                .visit(&mut self.field, self.pool.as_ref(), |mut fields| {
                    let loads = shared_loads(&fields, forces.loads, &driven)?;
                    let mut sums = vec![PlaneSums::default(); fields.common.range.len()];
                    for (number, own) in loads.iter().enumerate() {
                        let forces = Forces {
                            loads: own,
                            ..forces
                        };
                        let nodes_driven = if number == 0 { &acting.driven[..] } else { &[] };
                        let planes = number_of(&mut fields, number);
                        trial(planes, acting, nodes_driven, &forces, &mut sums)?;
                        planes.unfold(&acting.walls, true);
                        planes.add_sums(&forces, measure, &mut sums);
                    }
                    Ok(Sums { sums, groups: 0 })
                });
        let mut sums = vec![];
        for result in results {
            sums.push(result.map_err(|EmptyNode(node)| self.load_on_empty_node(node))?);
        }
        self.ledger.sums = total(sums).total;
        self.groups.count(self.mortar.groups);
        let vertices = self.mortar.pairs.iter().flat_map(|p| &p.forces.vertices);
        Ok(vertices
            .flatten()
            .filter(|vertex| vertex.pressure > 0.0)
            .count())
    }

    /// Moves all vertices with the velocity after the solve (eq. 29, 30).
    pub(super) fn move_vertices(&mut self, drift: f64, half_step: f64) {
        let shape = &self.field.shape;
        let cell = Point::new(shape.cell[0], shape.cell[1]);
        for surface in &mut self.mortar.surfaces {
            match &surface.carrier {
                Carrier::Prescribed(motion) => {
                    let v = motion
                        .as_ref()
                        .map_or([0.0; 3], |m| history_value(m, half_step));
                    surface.moved.fill(Point::new(v[0], v[1]) * drift);
                }
                Carrier::Body { index, follow } => {
                    let Some(lines) = self.contact.layers.nodes_of(*index) else {
                        continue;
                    };
                    let gradients = if *follow == Follow::Velocity {
                        NodalGradients::none()
                    } else {
                        NodalGradients::new(
                            &surface.patches,
                            &self.sets[*index],
                            &self.bodies[*index],
                            shape,
                            lines,
                            self.stencil,
                        )
                    };
                    for (moved, patch) in surface.moved.iter_mut().zip(&surface.patches) {
                        let velocities = std::array::from_fn(|k| {
                            let line = &lines[patch.nodes[k]];
                            Point::new(line[1], line[2])
                        });
                        let around = std::array::from_fn(|k| gradients.at(patch.nodes[k]));
                        let v =
                            vertex_velocity(&patch.weights, &velocities, &around, *follow, &cell);
                        *moved = v * drift;
                    }
                }
            }
            for (x, moved) in surface.boundary.points.iter_mut().zip(&surface.moved) {
                *x += moved;
            }
        }
    }
}

/// Indices of the nodes of a patch; none outside the mesh, also for ghosts, which repeat what lies inside.
fn nodes_of_patch(base: [i64; 2], shape: &GridShape) -> [Option<usize>; 9] {
    std::array::from_fn(|k| {
        let at = [base[0] + (k / 3) as i64, base[1] + (k % 3) as i64];
        let inside = (0..2).all(|axis| at[axis] >= 0 && at[axis] <= shape.cells[axis] as i64);
        inside.then(|| shape.index(shape.mesh_node([at[0] as usize, at[1] as usize, 0])))
    })
}

/// Mass of a node in use; a node outside the active rows still holds what it had when a particle was near.
fn mass_of(node: usize, shape: &GridShape, rows: &ActiveRows, lines: &[Line]) -> f64 {
    let [plane, row, k] = shape.indices(node);
    if rows.span(plane, row).contains(&k) {
        lines[node][0]
    } else {
        0.0
    }
}

/// Velocity gradients at the nodes that the vertices need (eq. 28).
struct NodalGradients {
    /// Place of each node of the grid in `sums`, plus one; zero for nodes that no vertex needs.
    slots: Vec<u32>,
    sums: Vec<NodalGradient>,
}

impl NodalGradients {
    fn at(&self, node: usize) -> Matrix2<f64> {
        match self.slots.get(node) {
            Some(&slot) if slot > 0 => self.sums[slot as usize - 1].mean(),
            _ => Matrix2::zeros(),
        }
    }

    /// None, for vertices that follow velocities alone.
    fn none() -> Self {
        Self {
            slots: vec![],
            sums: vec![],
        }
    }

    /// Sums over the particles that reach a node of a patch; they are found by their base, without their weights.
    fn new(
        patches: &[Patch],
        set: &ParticleSet,
        body: &BodyRun,
        shape: &GridShape,
        lines: &[Line],
        stencil: usize,
    ) -> Self {
        let mut slots = vec![0_u32; lines.len()];
        let mut sums = vec![];
        let bases = shape.bases();
        let mut near = vec![false; bases[0] * bases[2]];
        for patch in patches {
            for k in 0..9 {
                let node = patch.nodes[k];
                if patch.weights.weights[k] > 0.0 && slots[node] == 0 {
                    sums.push(NodalGradient::default());
                    slots[node] = sums.len() as u32;
                    let [i, _, j] = shape.indices(node);
                    for a in i.saturating_sub(stencil - 1)..=i.min(bases[0] - 1) {
                        for b in j.saturating_sub(stencil - 1)..=j.min(bases[2] - 1) {
                            near[a * bases[2] + b] = true;
                        }
                    }
                }
            }
        }
        let mapping = &body.mapping;
        let offset = base_offset(stencil);
        for p in 0..set.len() {
            let xi = [0, 1]
                .map(|axis| set.columns[Layout::POSITION + axis][p] * mapping.inverse_cell[axis]);
            let base = xi.map(|xi| ((xi - offset).floor() + GHOSTS_BELOW as f64) as usize);
            if !near[base[0] * bases[2] + base[1]] {
                continue;
            }
            let axes = [0, 1].map(|axis| {
                let l = mapping
                    .half_length_column
                    .map_or(mapping.half_length[axis], |c| set.columns[c + axis][p]);
                if stencil == 3 {
                    let (_, w, g) = axis_weights_at::<3>(mapping.family, xi[axis], l);
                    ([w[0], w[1], w[2], 0.0], [g[0], g[1], g[2], 0.0])
                } else {
                    let (_, w, g) = axis_weights_at::<4>(mapping.family, xi[axis], l);
                    (w, g)
                }
            });
            let [(w_x, g_x), (w_y, g_y)] = axes;
            let first = |a: usize| (base[0] + a) * shape.nodes[2] + base[1];
            let mut gradient = Matrix2::zeros();
            for a in 0..stencil {
                for (b, line) in lines[first(a)..][..stencil].iter().enumerate() {
                    let slope = Point::new(
                        g_x[a] * w_y[b] * mapping.inverse_cell[0],
                        w_x[a] * g_y[b] * mapping.inverse_cell[1],
                    );
                    gradient += Point::new(line[1], line[2]) * slope.transpose();
                }
            }
            let mass = set.columns[Layout::MASS][p];
            for a in 0..stencil {
                for (b, &slot) in slots[first(a)..][..stencil].iter().enumerate() {
                    if slot > 0 {
                        sums[slot as usize - 1].add(w_x[a] * w_y[b], mass, &gradient);
                    }
                }
            }
        }
        Self { slots, sums }
    }
}
