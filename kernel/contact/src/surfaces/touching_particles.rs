//! Particles that touch a surface in a step: the search for them.

use super::fields::Fields;
use super::gap::gap_to;
use super::near_particles::{NearParticles, ParticlePlace};
use super::obstacle::RigidObstacle;
use super::particle_ellipsoid::{half_lengths, touching_point};
use super::pushed_particle::TouchKey;
use super::reached_nodes::{NodeNumbers, ReachedNodes};
use super::shared_touches;
use super::touch_fault::TouchFault;
use crate::geometry::surface::NearestPoint;
use crate::surfaces::touch::{SurfaceTouch, SurfaceTouches};
use proctor_geometry::team::ItemCost;
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{
    InteractionError, NodalConditions, StepView, node_weights_touching,
};

/// Particles that touch, with where they belong.
#[derive(Clone, Debug, Default)]
pub(super) struct TouchingParticles {
    pub(super) touches: SurfaceTouches,
    pub(super) keys: Vec<TouchKey>,
    known: NodeNumbers,
    /// Gap and nearest point of each particle near a surface.
    gaps: Vec<Option<(f64, NearestPoint)>>,
}

/// Finds the particles within the threshold of a surface, with their velocities over it from the lanes of the nodes
/// that begin at `lane`, and the nodes that they reach. After an error `found` holds those found before it,
/// which no one looks at.
pub(super) fn touches(
    view: &StepView<'_>,
    rigid: &[RigidObstacle],
    near: &mut NearParticles,
    (nodal, lane): (&NodalConditions, usize),
    found: &mut TouchingParticles,
) -> Result<(), InteractionError> {
    let TouchingParticles {
        touches,
        keys,
        known,
        gaps,
    } = found;
    keys.clear();
    near.find(view, rigid, nodal);
    let fields = Fields::of_step(view);
    let mut reached = known.begin(touches);
    // Each search by whatever thread; nodes are numbered by one, in the order of the particles.
    let gap = |i: usize| {
        let place = near.particles[i];
        let (rigid, shift) = (&rigid[place.surface], &near.now[place.surface].shift);
        let margin = rigid.widest_threshold() + view.smallest_cell();
        let triangle = Some(near.triangles[i]);
        gap_to(view, rigid, [place.set, place.p], shift, margin, triangle)
    };
    let team = view.team();
    team.fill(0..near.particles.len(), ItemCost::Search, gap, &None, gaps);
    let mut fault = None;
    for (i, place) in near.particles.iter().enumerate() {
        let Some(gap) = gaps[i] else {
            continue;
        };
        near.triangles[i] = gap.1.triangle;
        let key = TouchKey {
            surface: place.surface,
            set: place.set,
            id: view.particles[place.set].id[place.p],
        };
        let (rigid, v_s) = (&rigid[place.surface], &near.now[place.surface].velocity);
        let touch = touch(
            view,
            (rigid, *place),
            gap,
            v_s,
            (nodal, lane),
            &fields,
            &mut reached,
        );
        let touch = match touch {
            Ok(touch) => touch,
            Err(error) => {
                fault = Some((key, error));
                break;
            }
        };
        if let Some(touch) = touch {
            reached.touches.list.push(touch);
            keys.push(key);
        }
    }
    let fault = match view.ranks {
        None => fault,
        Some(ranks) => shared_touches::share(ranks, (keys, touches), fault.as_ref()),
    };
    match fault {
        None => Ok(()),
        Some((key, fault)) => Err(fault.error(&rigid[key.surface], view)),
    }
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
) -> Result<Option<SurfaceTouch>, TouchFault> {
    let ParticlePlace { set, p, .. } = place;
    if let (RigidObstacle::Surface(_), true) = (rigid, nearest.distance < 0.0) {
        return Err(TouchFault {
            particle: view.particle_at(set, p),
            point: nearest.point,
            approach: None,
            distance: -nearest.distance,
        });
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
    let threshold = rigid.threshold(&normal);
    if approach > gap.max(0.0) && approach > threshold && !rigid.is_bonded() {
        return Err(TouchFault {
            particle: view.particle_at(set, p),
            point: nearest.point,
            approach: Some(approach),
            distance: threshold,
        });
    }
    if !rigid.touches(gap, &normal) {
        return Ok(None);
    }
    let weights = reached.reach(shape, nodal, fields, field, &weights);
    let m_p = view.mass(set, p);
    let stiffness = match rigid {
        RigidObstacle::Surface(surface) => surface.given.penalty_stiffness,
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
        friction: rigid.friction(),
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
