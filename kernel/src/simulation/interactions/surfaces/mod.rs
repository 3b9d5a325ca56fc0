//! Contact with rigid surfaces in the cycle.

mod error;
mod fields;
mod gap;
mod near_particles;
mod nodes;
mod obstacle;
mod particle_ellipsoid;
mod plan_entries;
mod reached_nodes;

use super::InteractionType;
use crate::contact::Tunnelling;
use crate::memory::Memory;
use crate::scene::{Scene, StressScheme, Vector};
use crate::simulation::Simulation;
use crate::simulation::context::{NodalConditions, Remap, at_half_step_after};
use crate::simulation::fields::Grid;
use crate::simulation::interactions::{Interaction, InteractionResult};
use crate::simulation::mapping::node_weights_touching;
use crate::simulation::step_view::{StepUpdate, StepView};
use crate::simulation::values::{BodyRun, InteractionError, SavedArrays, SetupError};
use crate::stage::solve::Planes;
use crate::stage::touch::{SurfaceTouch, SurfaceTouches, TouchedNode};
use crate::surface::NearestPoint;
use crate::team::ItemCost;
use fields::{Fields, change_velocities};
use gap::{gap_to, refuse_overlap_with_surfaces};
use near_particles::{NearParticles, ParticlePlace};
use obstacle::RigidObstacle;
use particle_ellipsoid::{half_lengths, touching_point};
use reached_nodes::{NodeNumbers, ReachedNodes};

pub use error::SurfaceContactError;

/// Contact with rigid surfaces.
pub(super) const SURFACES: InteractionType = InteractionType {
    plan_entries: plan_entries::plan_entries,
    make: SurfaceContact::of,
};

/// Sweeps end when none changes a velocity by more than this share of the largest that an impulse gave before or in the first one.
const TOLERANCE: f64 = 1e-6;
/// Most sweeps of a step. What is left then is made good in the next step: see [`SurfaceTouch::bound`] and
/// [`PushedParticle::impulse`].
const SWEEPS: usize = 50;

/// Contact with rigid surfaces and driven shapes: its state in the cycle. Under damping and USL the impulses of the pushed particles are
/// the start of the next step; the list of particles near a surface only spares searches, and the sums of impulses are records.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceContact {
    /// What pushes.
    rigid: Vec<RigidObstacle>,
    near: NearParticles,
    /// Touches of the last equation of motion, and those of a second mapping.
    trial: TouchingParticles,
    mapped: TouchingParticles,
    /// Particles that a surface pushes in this step, by surface, set and identifier, in that order.
    pushed: Vec<PushedParticle>,
    /// Impulse on each body from each surface in the last step \[N s\], and its time \[s\].
    pub(crate) last: Vec<Vec<Vector>>,
    pub(crate) last_kick: f64,
    /// The same summed since the start \[N s\].
    pub(crate) total: Vec<Vec<Vector>>,
}

/// A particle that a surface pushes.
#[derive(Clone, Copy, Debug)]
struct PushedParticle {
    /// Places of the surface and of the set, and the identifier of the particle.
    key: (usize, usize, u64),
    /// True where friction holds it.
    held: bool,
    /// Normal impulse and tangential impulse of the last step \[N s\].
    ///
    /// Under damping and USL the sweeps of the next step start from it. Modes in which neighbours press in turn hardly change velocities of nodes, and
    /// sweeps that start from zero in each step leave the same rest of them in each: under USL, which strains particles with
    /// these velocities, the stress of the first row then wandered by up to 0.7 of the pressure.
    /// Without damping bodies ring, and the modes are noise that adds up when it is carried on: a block that slid without friction
    /// gained energy.
    impulse: (f64, Vector),
}

impl PushedParticle {
    /// Name of the saved array.
    const NAME: &str = "impulses of pushed particles";
    /// Numbers of a particle in it.
    const SAVED: usize = 7;

    /// The particle in numbers.
    fn saved(&self) -> [f64; Self::SAVED] {
        let ((surface, set, id), (normal, [x, y, z])) = (self.key, self.impulse);
        [surface as f64, set as f64, id as f64, normal, x, y, z]
    }

    /// The particle of these numbers. Friction is found anew before it is asked.
    fn restored(&[surface, set, id, normal, x, y, z]: &[f64; Self::SAVED]) -> Self {
        Self {
            key: (surface as usize, set as usize, id as u64),
            held: false,
            impulse: (normal, [x, y, z]),
        }
    }

    /// The one of a key in a list.
    fn find(list: &[Self], key: (usize, usize, u64)) -> Option<&Self> {
        let found = list.binary_search_by_key(&key, |pushed| pushed.key);
        found.ok().map(|at| &list[at])
    }
}

/// True where contact goes on from the impulses of the last step: see [`PushedParticle::impulse`]. With MUSL and USF, which strain
/// with velocities of a second mapping, walls that move under damping held the ground up by 2.4 % so. Nor with friction: a block that
/// sticks to a slope on which it is put at once then crept with 0.5 % of the velocity of a free one.
fn goes_on(scene: &Scene) -> bool {
    scene.scheme == StressScheme::Usl && scene.damping.slows()
}

/// Particles that touch, with where they belong.
#[derive(Clone, Debug, Default)]
struct TouchingParticles {
    touches: SurfaceTouches,
    places: Vec<ParticlePlace>,
    known: NodeNumbers,
    /// Gap and nearest point of each particle near a surface.
    gaps: Vec<Option<(f64, NearestPoint)>>,
}

impl SurfaceContact {
    /// Rigid surfaces, where a scene has any.
    pub(super) fn of(
        scene: &Scene,
        bodies: &[BodyRun],
        _: &mut Memory,
    ) -> Option<InteractionResult> {
        let rigid = obstacle::all(scene, bodies);
        if rigid.is_empty() {
            return None;
        }
        let zero = vec![vec![[0.0; 3]; scene.bodies.len()]; rigid.len()];
        Some(Ok(Box::new(Self {
            rigid,
            near: NearParticles::default(),
            trial: TouchingParticles::default(),
            mapped: TouchingParticles::default(),
            pushed: vec![],
            last: zero.clone(),
            last_kick: 0.0,
            total: zero,
        })))
    }
}

impl Interaction for SurfaceContact {
    fn boxed(&self) -> Box<dyn Interaction> {
        Box::new(self.clone())
    }

    fn start(&self, view: &StepView<'_>) -> Result<(), SetupError> {
        refuse_overlap_with_surfaces(view, &self.rigid)
    }

    fn sorted(&mut self, view: &StepView<'_>) {
        self.near.forget();
        for rigid in &mut self.rigid {
            if let RigidObstacle::Driven(driven) = rigid {
                driven.note_start(view);
            }
        }
    }

    /// A body that is no longer driven, or moves in another way, may act on its partners at the nodes from now on.
    fn motion_changed(&mut self, view: &StepView<'_>, _: usize) {
        let now = obstacle::all(view.scene, view.bodies);
        let mut place = 0;
        self.rigid.retain(|rigid| {
            let keep = now.iter().any(|one| one.is_same(rigid));
            if keep {
                place += 1;
            } else {
                self.last.remove(place);
                self.total.remove(place);
            }
            keep
        });
        self.near.forget();
        self.trial = TouchingParticles::default();
        self.pushed.clear();
    }

    fn settles(&self) -> bool {
        true
    }

    fn settle(
        &mut self,
        update: &mut StepUpdate<'_>,
        nodal: &NodalConditions,
    ) -> Result<usize, InteractionError> {
        self.push(update, nodal)
    }

    fn settle_remapped(
        &mut self,
        update: &mut StepUpdate<'_>,
        nodal: &NodalConditions,
        remap: Remap,
    ) -> Result<(), InteractionError> {
        self.hold(update, nodal, remap.lane())
    }

    fn nodal_forces(&self, grid: &Grid, give: &mut dyn FnMut(usize, usize, Vector, f64)) {
        self.forces_at_nodes(grid, give);
    }

    fn save(&self) -> SavedArrays {
        let flat =
            |impulses: &[Vec<Vector>]| impulses.iter().flatten().flatten().copied().collect();
        vec![
            ("time of the last impulses".into(), vec![self.last_kick]),
            ("last impulses of surfaces".into(), flat(&self.last)),
            ("impulses of surfaces".into(), flat(&self.total)),
            (
                PushedParticle::NAME.into(),
                self.pushed.iter().flat_map(PushedParticle::saved).collect(),
            ),
        ]
    }

    fn entry_length(&self, name: &str) -> Option<usize> {
        (name == PushedParticle::NAME).then_some(PushedParticle::SAVED)
    }

    fn restore(&mut self, saved: &SavedArrays) {
        self.last_kick = saved[0].1[0];
        for (impulses, (_, values)) in [&mut self.last, &mut self.total]
            .into_iter()
            .zip(&saved[1..])
        {
            for (impulse, value) in impulses.iter_mut().flatten().flatten().zip(values) {
                *impulse = *value;
            }
        }
        let (pushed, _) = saved[3].1.as_chunks();
        self.pushed = pushed.iter().map(PushedParticle::restored).collect();
    }
}

impl Simulation {
    /// Displacement of a surface since the start \[m\].
    #[must_use]
    pub fn surface_shift(&self, surface: usize, time: f64) -> Vector {
        let contact = self.interaction::<SurfaceContact>();
        match contact.and_then(|contact| contact.rigid.get(surface)) {
            Some(RigidObstacle::Surface(surface)) => surface.shift(time),
            _ => [0.0; 3],
        }
    }
}

impl SurfaceContact {
    /// Corrects the nodal velocities after the solve so that no particle goes through a surface or into a driven body; the
    /// number of particles that driven bodies push.
    fn push(
        &mut self,
        update: &mut StepUpdate<'_>,
        nodal: &NodalConditions,
    ) -> Result<usize, InteractionError> {
        let view = update.view();
        touches(
            &view,
            &self.rigid,
            &mut self.near,
            (nodal, 1),
            &mut self.trial,
        )?;
        let TouchingParticles {
            touches, places, ..
        } = &mut self.trial;
        let key = |place: &ParticlePlace| {
            let id = view.particles[place.set].id[place.p];
            (place.surface, place.set, id)
        };
        for (touch, place) in touches.list.iter_mut().zip(&*places) {
            if !goes_on(view.scene) {
                break;
            }
            if touch.friction != 0.0 {
                continue;
            }
            if let Some(pushed) = PushedParticle::find(&self.pushed, key(place)) {
                touch.start_from(pushed.impulse, nodal.kick / self.last_kick);
            }
        }
        let lanes = view.lanes;
        let damping = match nodal.local_damping {
            None => {
                touches.resolve(lanes, TOLERANCE, SWEEPS);
                0.0
            }
            Some(alpha) => {
                let fields = Fields::of_step(&view);
                // Fields that move together have one velocity and one increment.
                let line = |t: &TouchedNode| &fields.lines(t.field)[t.node];
                touches.resolve_damped(lanes, line, alpha, TOLERANCE, SWEEPS)
            }
        };
        for bodies in &mut self.last {
            bodies.fill([0.0; 3]);
        }
        self.last_kick = nodal.kick;
        self.pushed.clear();
        let mut by_bodies = 0;
        for (touch, place) in touches.list.iter().zip(&*places) {
            if let (true, held) = touch.pushes_and_holds() {
                self.pushed.push(PushedParticle {
                    key: key(place),
                    held,
                    impulse: (touch.normal_impulse, touch.tangential_impulse),
                });
                by_bodies += usize::from(matches!(
                    self.rigid[place.surface],
                    RigidObstacle::Driven(_)
                ));
            }
            let impulse = touch.impulse();
            for axis in 0..3 {
                self.last[place.surface][place.set][axis] += impulse[axis];
            }
        }
        let mut power = 0.0;
        for surface in 0..self.last.len() {
            let v = self.near.now[surface].velocity;
            for set in 0..view.particles.len() {
                for axis in 0..3 {
                    let impulse = self.last[surface][set][axis];
                    self.total[surface][set][axis] += impulse;
                    power += impulse * v[axis] / nodal.kick;
                }
            }
        }
        let fields = Fields::of_step(&view);
        let line = |t: &TouchedNode| &fields.lines(t.field)[t.node];
        let (mut friction, mut impact) = (0.0, 0.0);
        for touch in &touches.list {
            let [across, along] = touches.taken(touch, line);
            friction += across;
            impact += along;
        }
        update.sums.damping += damping;
        update.sums.friction += friction;
        update.sums.impact += impact;
        change_velocities(update.grid, touches, 1, true);
        update.sums.power += power;
        Ok(by_bodies)
    }

    /// Gives the velocities of a second mapping, which strain the particles, to the surfaces as the boundary planes do:
    /// without a record, and only where a surface pushes in this step. There the normal velocity is prescribed, and
    /// the tangential one too where friction holds. A bound instead, which lets noise away from the surface pass and
    /// stops noise towards it, would swell the layer of particles on the surface step by step.
    ///
    /// `lane` is where the nodes hold the velocities.
    fn hold(
        &mut self,
        update: &mut StepUpdate<'_>,
        nodal: &NodalConditions,
        lane: usize,
    ) -> Result<(), InteractionError> {
        let view = update.view();
        touches(
            &view,
            &self.rigid,
            &mut self.near,
            (nodal, lane),
            &mut self.mapped,
        )?;
        let TouchingParticles {
            touches, places, ..
        } = &mut self.mapped;
        let pushed = &self.pushed;
        let mut held = places.iter().map(|place| {
            let id = view.particles[place.set].id[place.p];
            let found = PushedParticle::find(pushed, (place.surface, place.set, id));
            found.map(|pushed| pushed.held)
        });
        touches.list.retain_mut(|touch| {
            let Some(held) = held.next().flatten() else {
                return false;
            };
            (touch.floor, touch.penalty) = (f64::NEG_INFINITY, 0.0);
            touch.friction = if held { f64::INFINITY } else { 0.0 };
            true
        });
        touches.resolve(view.lanes, TOLERANCE, SWEEPS);
        change_velocities(update.grid, touches, lane, false);
        let still = at_half_step_after(&nodal.walls);
        let keep = |planes: &mut Planes<'_>| {
            if lane == 4 {
                planes.constrain_remapped(&still);
            } else {
                planes.unfold(&still, false);
            }
        };
        update.grid.visit(|mut slab| slab.planes().for_each(keep));
        Ok(())
    }
}

/// Finds the particles within the threshold of a surface, with their velocities over it from the lanes of the nodes
/// that begin at `lane`, and the nodes that they reach. After an error `found` holds those found before it,
/// which no one looks at.
fn touches(
    view: &StepView<'_>,
    rigid: &[RigidObstacle],
    near: &mut NearParticles,
    (nodal, lane): (&NodalConditions, usize),
    found: &mut TouchingParticles,
) -> Result<(), InteractionError> {
    let TouchingParticles {
        touches,
        places,
        known,
        gaps,
    } = found;
    places.clear();
    near.find(view, rigid, nodal);
    let fields = Fields::of_step(view);
    let mut reached = known.begin(touches);
    // Each search by whatever thread; nodes are numbered by one, in the order of the particles.
    let gap = |i: usize| {
        let place = near.particles[i];
        let (rigid, shift) = (&rigid[place.surface], &near.now[place.surface].shift);
        let margin = rigid.widest_threshold(view) + view.smallest_cell();
        let triangle = Some(near.triangles[i]);
        gap_to(view, rigid, [place.set, place.p], shift, margin, triangle)
    };
    let team = view.team();
    team.fill(0..near.particles.len(), ItemCost::Search, gap, &None, gaps);
    for (i, place) in near.particles.iter().enumerate() {
        let Some(gap) = gaps[i] else {
            continue;
        };
        near.triangles[i] = gap.1.triangle;
        let (rigid, v_s) = (&rigid[place.surface], &near.now[place.surface].velocity);
        let touch = touch(
            view,
            (rigid, *place),
            gap,
            v_s,
            (nodal, lane),
            &fields,
            &mut reached,
        )?;
        if let Some(touch) = touch {
            reached.touches.list.push(touch);
            places.push(*place);
        }
    }
    Ok(())
}

/// The touch of one particle with this gap, if it is within the threshold; `v_s` is the velocity of the surface \[m/s\].
fn touch(
    view: &StepView<'_>,
    (rigid, place): (&RigidObstacle, ParticlePlace),
    (gap, nearest): (f64, NearestPoint),
    v_s: &Vector,
    (nodal, lane): (&NodalConditions, usize),
    fields: &Fields<'_>,
    reached: &mut ReachedNodes<'_>,
) -> Result<Option<SurfaceTouch>, InteractionError> {
    let ParticlePlace { set, p, .. } = place;
    if let (RigidObstacle::Surface(surface), true) = (rigid, nearest.distance < 0.0) {
        return Err(SurfaceContactError::ThroughSurface {
            particle: view.particle_at(set, p),
            surface: view.scene.surfaces[surface.place].name.clone(),
            depth: -nearest.distance,
        }
        .into());
    }
    let shape = &view.grid.shape;
    let (particles, body) = (&view.particles[set], &view.bodies[set]);
    let normal = nearest.normal;
    let half = half_lengths(particles, body, p);
    let touching = [&touching_point(&half, &nearest), &half];
    let weights = node_weights_touching(particles, body, shape, view.stencil, p, touching);
    let field = fields.of(set);
    let lines = fields.lines(field);
    let mut relative = v_s.map(|v| -v);
    for &(node, w) in weights.iter() {
        for axis in 0..3 {
            relative[axis] += w * lines[node][lane + axis];
        }
    }
    let approach = -nodal.drift
        * (0..3)
            .map(|axis| normal[axis] * relative[axis])
            .sum::<f64>();
    let threshold = rigid.threshold(view, &normal);
    if approach > gap.max(0.0) && approach > threshold && !rigid.is_bonded() {
        return Err(match rigid {
            RigidObstacle::Surface(surface) => SurfaceContactError::TooFastForSurface {
                particle: view.particle_at(set, p),
                surface: view.scene.surfaces[surface.place].name.clone(),
                approach,
                threshold,
            }
            .into(),
            RigidObstacle::Driven(driven) => Tunnelling {
                bodies: [driven.pair.master, driven.pair.slave].map(|b| view.bodies[b].id),
                position: Some(nearest.point),
                approach,
                distance: threshold,
            }
            .into(),
        });
    }
    if !rigid.touches(view, gap, &normal) {
        return Ok(None);
    }
    let weights = reached.reach(shape, nodal, fields, field, &weights);
    let m_p = view.mass(set, p);
    let stiffness = match rigid {
        RigidObstacle::Surface(surface) => view.scene.surfaces[surface.place].penalty_stiffness,
        RigidObstacle::Driven(_) => None,
    };
    let penalty = penalty_impulse(stiffness.unwrap_or(0.0), m_p, -gap, nodal);
    Ok(Some(SurfaceTouch {
        weights,
        normal,
        relative,
        gap,
        bound: rigid.bound(gap, nearest.distance, nodal.drift),
        floor: if rigid.is_bonded() {
            f64::NEG_INFINITY
        } else {
            0.0
        },
        penalty,
        friction: rigid.friction(view),
        normal_impulse: 0.0,
        tangential_impulse: [0.0; 3],
    }))
}

/// Impulse of the penalty force on a particle of mass `m_p` \[kg\] that reaches through by `depth` \[m\] \[N s\]: k depth dt,
/// but no more than what brings it out within the step, so that no stiffness makes a step unstable. Particles that share a
/// node push it with the sum of both over the same weights.
fn penalty_impulse(stiffness: f64, m_p: f64, depth: f64, nodal: &NodalConditions) -> f64 {
    (stiffness * nodal.kick).min(m_p / nodal.drift) * depth.max(0.0)
}
