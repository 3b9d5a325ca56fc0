//! Contact with rigid surfaces in the cycle.

mod error;
mod fields;
mod gap;
mod near_particles;
mod nodes;
mod obstacle;
mod particle_ellipsoid;
mod plan_entries;
mod pushed_particle;
mod reached_nodes;
mod shared_touches;
#[doc(hidden)]
pub mod touch;
mod touch_fault;
mod touching_particles;

use crate::kinds::{ContactType, InteractionResult};
use crate::values::{ContactValues, PairValues, RigidSurface};
use fields::change_velocities;
use gap::refuse_overlap_with_surfaces;
use near_particles::NearParticles;
use obstacle::RigidObstacle;
use proctor_geometry::memory::Memory;
use proctor_kernel::model::{CycleSettings, Vector};
use proctor_kernel::simulation::{
    BalanceTraits, BodyRun, Grid, Interaction, InteractionError, NodalConditions, NodalForce,
    Remap, SavedArrays, SetupError, StepUpdate, StepView, at_half_step_after,
};
use proctor_kernel::stage::solve::Planes;
use pushed_particle::{PushedParticle, goes_on};
use touching_particles::{TouchingParticles, touches};

pub use error::SurfaceContactError;

/// Contact with rigid surfaces.
pub(crate) const SURFACES: ContactType = ContactType {
    plan_entries: plan_entries::plan_entries,
    make: SurfaceContact::of,
};

/// Sweeps end when none changes a velocity by more than this share of the largest that an impulse gave before or in the first one.
const TOLERANCE: f64 = 1e-6;
/// Most sweeps of a step. What is left then is made good in the next step: see [`bound`](crate::surfaces::touch::SurfaceTouch::bound) and
/// [`goes_on`].
const SWEEPS: usize = 50;

/// Contact with rigid surfaces and driven shapes: its state in the cycle. Under damping and USL the impulses of the pushed particles are
/// the start of the next step; the list of particles near a surface only spares searches, and the sums of impulses are records.
#[derive(Clone, Debug)]
pub struct SurfaceContact {
    /// Contacts on the grid, those with the shapes of driven bodies among them.
    given: PairValues,
    /// The obstacle that pushes.
    rigid: Vec<RigidObstacle>,
    near: NearParticles,
    /// Touches of the last equation of motion, and those of a second mapping.
    trial: TouchingParticles,
    mapped: TouchingParticles,
    /// Particles that a surface pushes in this step, by surface, set and identifier, in that order.
    pushed: Vec<PushedParticle>,
    /// Impulse on each body from each surface in the last step \[N s\], and its time \[s\].
    last: Vec<Vec<Vector>>,
    last_kick: f64,
    /// The same summed since the start \[N s\].
    total: Vec<Vec<Vector>>,
}

impl SurfaceContact {
    /// Rigid surfaces and driven shapes, where a model has any.
    pub(crate) fn of(
        values: &ContactValues,
        settings: &CycleSettings,
        bodies: &[BodyRun],
        _: &mut Memory,
    ) -> Option<InteractionResult> {
        let given = values.pairs();
        let rigid = obstacle::all((&given, &values.surfaces), settings, bodies);
        if rigid.is_empty() {
            return None;
        }
        let zero = vec![vec![[0.0; 3]; bodies.len()]; rigid.len()];
        Some(Ok(Box::new(Self {
            given,
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
    fn not_local(&self) -> Option<&'static str> {
        None
    }

    fn settles_across_ranks(&self) -> bool {
        true
    }

    fn start(&self, view: &StepView<'_>) -> Result<(), SetupError> {
        refuse_overlap_with_surfaces(view, &self.rigid)
    }

    fn sorted(&mut self, view: &StepView<'_>) {
        self.near.forget();
        obstacle::note_starts(&mut self.rigid, view);
    }

    /// Particles may have other places than those of the list.
    fn fields_given(&mut self, _: &StepView<'_>) {
        self.near.forget();
    }

    /// A body that is no longer driven, or moves in another way, may act on its partners at the nodes from now on.
    fn motion_changed(&mut self, view: &StepView<'_>, _: usize) {
        let surfaces: Vec<RigidSurface> = self.surfaces().cloned().collect();
        let now = obstacle::all((&self.given, &surfaces), view.settings, view.bodies);
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

    fn balance(&self) -> BalanceTraits {
        let any = self.surfaces().next().is_some();
        BalanceTraits {
            moves_damping: any,
            dissipates: any,
            may_be_stiff: false,
            moves: self.surfaces().any(RigidSurface::moves),
        }
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

    fn nodal_forces(&self, grid: &Grid, give: &mut dyn FnMut(NodalForce)) {
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

impl SurfaceContact {
    /// The rigid surfaces, without the shapes of driven bodies.
    fn surfaces(&self) -> impl Iterator<Item = &RigidSurface> {
        self.rigid.iter().filter_map(|rigid| match rigid {
            RigidObstacle::Surface(surface) => Some(&surface.given),
            RigidObstacle::Driven(_) => None,
        })
    }

    /// Number of rigid surfaces, without the shapes of driven bodies.
    #[must_use]
    pub fn surface_count(&self) -> usize {
        self.surfaces().count()
    }

    /// Sets the coefficient of friction of a rigid surface, by its place; false where there is none of it.
    pub fn set_surface_friction(&mut self, place: usize, friction: f64) -> bool {
        let Some(RigidObstacle::Surface(surface)) = self.rigid.get_mut(place) else {
            return false;
        };
        surface.given.friction = friction;
        true
    }

    /// Sets the coefficient of friction of the driven bodies of a contact, by its identifier.
    pub fn set_friction(&mut self, contact: i64, friction: f64) {
        for entry in self.given.contacts.iter_mut().filter(|c| c.id == contact) {
            entry.friction = friction;
        }
        for rigid in &mut self.rigid {
            if let RigidObstacle::Driven(driven) = rigid
                && driven.pair.id == contact
                && !driven.pair.bonded
            {
                driven.pair.friction = friction;
            }
        }
    }

    /// Displacement of a surface since the start at a time \[m\].
    #[must_use]
    pub fn shift(&self, surface: usize, time: f64) -> Vector {
        match self.rigid.get(surface) {
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
        let TouchingParticles { touches, keys, .. } = &mut self.trial;
        if goes_on(view.settings) {
            let factor = nodal.kick / self.last_kick;
            for (touch, key) in touches.list.iter_mut().zip(&*keys) {
                let pushed = PushedParticle::find(&self.pushed, *key);
                if let (Some(pushed), true) = (pushed, touch.friction == 0.0) {
                    touch.normal_impulse = factor * pushed.impulse;
                }
            }
        }
        let lanes = view.lanes;
        let damping = match nodal.local_damping {
            None => {
                touches.resolve(lanes, TOLERANCE, SWEEPS);
                0.0
            }
            Some(alpha) => touches.resolve_damped(lanes, alpha, TOLERANCE, SWEEPS),
        };
        for bodies in &mut self.last {
            bodies.fill([0.0; 3]);
        }
        self.last_kick = nodal.kick;
        self.pushed.clear();
        let mut by_bodies = 0;
        for (touch, key) in touches.list.iter().zip(&*keys) {
            if let (true, held) = touch.pushes_and_holds() {
                self.pushed.push(PushedParticle {
                    key: *key,
                    held,
                    impulse: touch.normal_impulse,
                });
                by_bodies +=
                    usize::from(matches!(self.rigid[key.surface], RigidObstacle::Driven(_)));
            }
            let impulse = touch.impulse();
            for axis in 0..3 {
                self.last[key.surface][key.set][axis] += impulse[axis];
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
        let (mut friction, mut impact) = (0.0, 0.0);
        for touch in &touches.list {
            let [across, along] = touches.taken(touch);
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
        let TouchingParticles { touches, keys, .. } = &mut self.mapped;
        let pushed = &self.pushed;
        let mut held = keys.iter().map(|key| {
            let found = PushedParticle::find(pushed, *key);
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
