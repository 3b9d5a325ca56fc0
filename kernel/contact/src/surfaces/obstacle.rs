//! Rigid things that push particles: surfaces of the scene, and the shapes of driven bodies.
//!
//! A body whose motion is prescribed keeps its shape: it acts on a partner of contact with the surface of that shape, at the
//! points where particles touch it, and not at the nodes that both reach. Nodes cannot do it: under one stress a body whose
//! face lies at theta in its cell has the internal forces 1 - theta and theta at the two nodes around the face, and a driven
//! body that prescribes both velocities holds a cell that is not its own.

use super::particle_ellipsoid::{length, on_surface};
use crate::geometry::surface::{Feature, NearestPoint, Surface};
use crate::grid::{acts_by_shape, pairs_of};
use crate::pairs::Pair;
use crate::values::{PairValues, RigidSurface};
use proctor_kernel::model::{CycleSettings, Shape, Vector};
use proctor_kernel::ranks::{Ranks, Words};
use proctor_kernel::simulation::{BodyRun, Displacement, NodalConditions, StepView};
use std::sync::Arc;

/// Share of the distance of contact within which a bonded body holds particles: three quarters of the half of a particle where
/// those of both bodies are alike, so that the second row is not held before a third of the strain of the first is lost.
const HELD: f64 = 0.375;

/// Share of the depth by which a particle that lies with its centre in a driven body moves out of it in a step.
const OUTWARD: f64 = 0.01;

/// A rigid thing that pushes particles.
#[derive(Clone, Debug)]
pub(super) enum RigidObstacle {
    /// A surface of the scene. It pushes all bodies.
    Surface(SurfaceObstacle),
    /// A driven body.
    Driven(Box<DrivenObstacle>),
}

/// Motion of a rigid thing in one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct RigidMotion {
    /// Displacement since the start, at the beginning of the step \[m\].
    pub(super) shift: Vector,
    /// Mean velocity in the step \[m/s\].
    pub(super) velocity: Vector,
}

/// A surface of the scene that pushes all bodies.
#[derive(Clone, Debug)]
pub(super) struct SurfaceObstacle {
    /// Place of the surface in the scene.
    pub(super) place: usize,
    /// The surface as it is given.
    pub(super) given: RigidSurface,
    /// The surface relative to the origin of the mesh at the start, as particles are: a coordinate of 1e6 m is good to
    /// 1e-10 m only.
    local: Arc<Surface>,
    /// Its displacement, where it moves.
    motion: Option<Arc<Displacement>>,
}

impl SurfaceObstacle {
    fn new(rigid: &RigidSurface, place: usize, origin: &Vector) -> Self {
        let local = if *origin == [0.0; 3] {
            Arc::clone(&rigid.surface)
        } else {
            Arc::new(rigid.surface.relative_to(origin))
        };
        let motion = rigid.motion.as_ref().map(Displacement::new);
        Self {
            place,
            given: rigid.clone(),
            local,
            motion: motion.map(Arc::new),
        }
    }

    /// Displacement since the start \[m\].
    pub(super) fn shift(&self, time: f64) -> Vector {
        let motion = self.motion.as_ref();
        motion.map_or([0.0; 3], |motion| motion.at(time))
    }
}

/// A driven body that pushes a partner of contact.
#[derive(Clone, Debug)]
pub(super) struct DrivenObstacle {
    /// Place of the body in the scene.
    pub(super) body: usize,
    /// Field of its partner.
    pub(super) partner: usize,
    /// The pair.
    pub(super) pair: Pair,
    /// Shape at the start, relative to the origin of the mesh.
    shape: Shape,
    /// Half-lengths with which particles of the partner touch \[m\], where the scene gives the distance of contact; else
    /// those of their domains.
    half: Option<Vector>,
    /// A particle of the body and its position at the start, relative to the origin of the mesh \[m\].
    start: Option<(u64, Vector)>,
}

/// All of a scene: its surfaces, then driven bodies pair by pair.
pub(super) fn all(
    (given, surfaces): (&PairValues, &[RigidSurface]),
    settings: &CycleSettings,
    bodies: &[BodyRun],
) -> Vec<RigidObstacle> {
    let origin = &settings.mesh.origin;
    let surfaces = surfaces
        .iter()
        .enumerate()
        .map(|(place, rigid)| RigidObstacle::Surface(SurfaceObstacle::new(rigid, place, origin)));
    let pairs = pairs_of(given, settings, bodies).into_iter();
    let driven = pairs.filter(|pair| pair.by_shape).map(|pair| {
        let [body, partner] = if acts_by_shape(settings, bodies, [pair.master, pair.slave]) {
            [pair.master, pair.slave]
        } else {
            [pair.slave, pair.master]
        };
        let has_distance = given.distance.is_some_and(|lambda| lambda > 0.0);
        let own = &bodies[body].particle_half_length;
        let half = std::array::from_fn(|axis| (pair.distance[axis] - own[axis]).max(0.0));
        RigidObstacle::Driven(Box::new(DrivenObstacle {
            body,
            partner,
            shape: bodies[body].shape.relative_to(origin),
            half: has_distance.then_some(half),
            start: None,
            pair,
        }))
    });
    surfaces.chain(driven).collect()
}

/// Notes where driven bodies are at the start, each by the first of its particles: where ranks share the step, the first
/// on any rank.
pub(super) fn note_starts(rigid: &mut [RigidObstacle], view: &StepView<'_>) {
    for one in rigid {
        let RigidObstacle::Driven(driven) = one else {
            continue;
        };
        if driven.start.is_some() {
            continue;
        }
        let set = &view.particles[driven.body];
        let first = view.own_particles(driven.body).iter().next();
        driven.start = match view.ranks {
            None => first.map(|p| (set.id[p], set.position(p))),
            Some(ranks) => {
                let place = |p: usize| set.base_row(p, &view.grid.shape) as u64;
                let here = first.map(|p| (place(p), set.id[p], set.position(p)));
                first_of(ranks, here)
            }
        };
    }
}

/// Puts the displacements of driven bodies, each from a rank that holds the particle by which it is known, in the place of those
/// that this rank found.
pub(super) fn join_shifts(
    ranks: &dyn Ranks,
    view: &StepView<'_>,
    rigid: &[RigidObstacle],
    now: &mut [RigidMotion],
) {
    for (one, now) in rigid.iter().zip(now) {
        if let RigidObstacle::Driven(driven) = one {
            let here = driven.known_shift(view).map(|shift| (0, 0, shift));
            now.shift = first_of(ranks, here).map_or([0.0; 3], |(_, shift)| shift);
        }
    }
}

/// An identifier and a vector from the rank that has them at the first place.
fn first_of(ranks: &dyn Ranks, here: Option<(u64, u64, Vector)>) -> Option<(u64, Vector)> {
    let mut words = vec![];
    if let Some((place, id, vector)) = here {
        words.extend([place, id]);
        words.extend(vector.map(f64::to_bits));
    }
    let all = ranks.all_gather(&words);
    let found = all.iter().filter(|words| !words.is_empty());
    let mut first = Words::of(&found.min_by_key(|words| words[0])?[1..]);
    Some((first.word(), [(); 3].map(|()| first.number())))
}

impl DrivenObstacle {
    /// Displacement since the start, relative to the mesh \[m\]: that of one of its particles; `None` where it is not here.
    fn known_shift(&self, view: &StepView<'_>) -> Option<Vector> {
        let set = &view.particles[self.body];
        let (id, start) = self.start.as_ref()?;
        let p = set.id.iter().position(|one| one == id)?;
        let now = set.position(p);
        Some(std::array::from_fn(|axis| now[axis] - start[axis]))
    }

    /// Displacement since the start, relative to the mesh \[m\].
    fn shift(&self, view: &StepView<'_>) -> Vector {
        self.known_shift(view).unwrap_or_default()
    }
}

impl RigidObstacle {
    /// Displacement since the start \[m\]: of a surface in space, of a body relative to the mesh.
    pub(super) fn shift(&self, view: &StepView<'_>) -> Vector {
        match self {
            Self::Surface(surface) => surface.shift(view.clock.time),
            Self::Driven(driven) => driven.shift(view),
        }
    }

    /// Velocity over the step that is being done \[m/s\].
    pub(super) fn velocity(&self, view: &StepView<'_>, nodal: &NodalConditions) -> Vector {
        match self {
            Self::Surface(surface) => {
                let (motion, time) = (surface.motion.as_ref(), view.clock.time);
                motion.map_or([0.0; 3], |motion| motion.mean_velocity(time, nodal.drift))
            }
            Self::Driven(driven) => nodal.prescribed[driven.body].map_or([0.0; 3], |[_, v]| v),
        }
    }

    /// True for the same rigid thing, which pushes the same body.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Surface(one), Self::Surface(two)) => one.place == two.place,
            (Self::Driven(one), Self::Driven(two)) => {
                (one.body, one.partner) == (two.body, two.partner)
            }
            _ => false,
        }
    }

    /// True if it pushes a body.
    pub(super) fn pushes(&self, view: &StepView<'_>, set: usize) -> bool {
        match self {
            Self::Surface(_) => view.bodies[set].motion.is_none(),
            Self::Driven(driven) => driven.partner == set,
        }
    }

    /// Coefficient of friction.
    pub(super) fn friction(&self) -> f64 {
        match self {
            Self::Surface(surface) => surface.given.friction,
            Self::Driven(driven) => {
                if driven.pair.bonded {
                    return f64::INFINITY;
                }
                // Without end a particle would stick that nothing presses.
                driven.pair.friction.min(f64::MAX)
            }
        }
    }

    /// Gap along a normal below which contact is looked for, and the longest way that a particle may approach in a step \[m\].
    pub(super) fn threshold(&self, normal: &Vector) -> f64 {
        match self {
            Self::Surface(surface) => surface.given.distance_threshold,
            Self::Driven(driven) => driven.pair.distance_along(normal),
        }
    }

    /// True for a particle that touches, with a gap along a normal \[m\].
    pub(super) fn touches(&self, gap: f64, normal: &Vector) -> bool {
        let share = if self.is_bonded() { HELD } else { 1.0 };
        gap < share * self.threshold(normal)
    }

    /// True for a driven body that holds what touches it.
    pub(super) fn is_bonded(&self) -> bool {
        matches!(self, Self::Driven(driven) if driven.pair.bonded)
    }

    /// The largest of them along any normal \[m\].
    pub(super) fn widest_threshold(&self) -> f64 {
        match self {
            Self::Surface(surface) => surface.given.distance_threshold,
            Self::Driven(driven) => length(&driven.pair.distance),
        }
    }

    /// Half-lengths within which a particle touches \[m\], of which the domain has the half-lengths `own`.
    pub(super) fn half_lengths(&self, own: Vector) -> Vector {
        match self {
            Self::Surface(_) => own,
            Self::Driven(driven) => driven.half.unwrap_or(own),
        }
    }

    /// Smallest normal velocity of a touching point over the surface \[m/s\], over a step of length `dt` \[s\].
    pub(super) fn bound(&self, gap: f64, distance: f64, dt: f64) -> f64 {
        match self {
            Self::Driven(driven) if driven.pair.bonded => 0.0,
            Self::Driven(_) if distance < 0.0 => -OUTWARD * distance / dt,
            _ => -gap.max(0.0) / dt,
        }
    }

    /// The nearest point to `x` within some distance, for a thing that has moved by `shift`, relative to the mesh; `guess` is
    /// the triangle of a surface near which it was.
    pub(super) fn nearest(
        &self,
        view: &StepView<'_>,
        x: &Vector,
        shift: &Vector,
        within: f64,
        guess: Option<usize>,
    ) -> Option<NearestPoint> {
        match self {
            Self::Surface(surface) => {
                let local = on_surface(view, x, shift);
                let surface = &surface.local;
                match guess {
                    None => surface.nearest(&local, within),
                    Some(triangle) => surface.nearest_from(triangle, &local, within),
                }
            }
            Self::Driven(driven) => {
                let local: Vector = std::array::from_fn(|axis| x[axis] - shift[axis]);
                let found = driven.shape.nearest(view.settings.dimension, &local)?;
                (found.distance < within).then_some(NearestPoint {
                    triangle: 0,
                    feature: Feature::Face,
                    point: found.point,
                    distance: found.distance,
                    normal: found.normal,
                    on_rim: false,
                })
            }
        }
    }
}
