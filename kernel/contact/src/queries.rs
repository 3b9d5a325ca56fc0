//! Forces, gaps and boundaries of contacts, for output.

use crate::geometry::surface::NearestPoint;
use crate::grid::GridContact;
use crate::mortar::{BoundaryDrift, BoundaryMesh, MortarState, VertexState};
use crate::surfaces::SurfaceContact;
use crate::values::{BoundaryHandle, ContactHandle, SurfaceHandle};
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{BodyHandle, Cycle, Interaction};

/// Contact force on a body in the last step \[N\]: the sum over its pairs, driven ones among them, and the rigid surfaces. On the
/// two bodies of a pair that have no other it is the same number with opposite signs.
#[must_use]
pub fn contact_force(cycle: &Cycle, body: BodyHandle) -> Vector {
    let set = body.place();
    let mut sum = mortar_force(cycle, body.into()).unwrap_or_default();
    let surfaces = cycle.interaction::<SurfaceContact>();
    let of_shapes = surfaces.map_or([0.0; 3], |s| s.shape_force_on(set));
    sum = std::array::from_fn(|axis| sum[axis] + of_shapes[axis]);
    if let Some(contact) = surfaces {
        for surface in 0..contact.surface_count() {
            let force = contact.force_on(surface, set);
            sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
        }
    }
    if let Some(contact) = cycle.interaction::<GridContact>() {
        contact.add_force_on(set, &mut sum);
    }
    sum
}

/// True for a body in a pair that can touch, or where there are rigid surfaces.
#[must_use]
pub fn has_contact(cycle: &Cycle, body: BodyHandle) -> bool {
    let surfaces = cycle.interaction::<SurfaceContact>();
    let on_grid = cycle.interaction::<GridContact>();
    surfaces.is_some_and(|s| s.surface_count() > 0)
        || on_grid.is_some_and(|contact| contact.acts_on(body.place()))
        || mortar_force(cycle, body.into()).is_some()
}

/// Displacement of a rigid surface since the start at a time \[m\].
#[must_use]
pub fn surface_shift(cycle: &Cycle, surface: SurfaceHandle, time: f64) -> Vector {
    let contact = cycle.interaction::<SurfaceContact>();
    contact.map_or([0.0; 3], |contact| contact.shift(surface.place(), time))
}

/// Gap between a particle and a rigid surface: see [`SurfaceContact::gap`].
#[must_use]
pub fn surface_gap(
    cycle: &Cycle,
    surface: SurfaceHandle,
    body: BodyHandle,
    p: usize,
    within: f64,
) -> Option<(f64, NearestPoint)> {
    let contact = cycle.interaction::<SurfaceContact>()?;
    let particle = [body.place(), p];
    contact.gap(&cycle.view(), surface.place(), particle, within)
}

/// Force of the bodies on a rigid surface in the last step \[N\].
#[must_use]
pub fn surface_force(cycle: &Cycle, surface: SurfaceHandle) -> Vector {
    let mut force = [0.0; 3];
    if let Some(contact) = cycle.interaction::<SurfaceContact>() {
        for set in 0..cycle.sets().len() {
            let own = contact.force_on(surface.place(), set);
            force = std::array::from_fn(|axis| force[axis] - own[axis]);
        }
    }
    force
}

/// Impulse of a rigid surface on a body since the start \[N s\].
#[must_use]
pub fn surface_impulse(cycle: &Cycle, surface: SurfaceHandle, body: BodyHandle) -> Vector {
    let contact = cycle.interaction::<SurfaceContact>();
    contact.map_or([0.0; 3], |contact| {
        contact.impulse_on(surface.place(), body.place())
    })
}

/// The vertex that drifted farthest off its body: see [`MortarState::boundary_drift`].
#[must_use]
pub fn boundary_drift(cycle: &Cycle) -> Option<BoundaryDrift> {
    mortar(cycle)?.boundary_drift(&cycle.view())
}

/// True where anything has a boundary: a body, or a rigid line or surface of mortar contact.
#[must_use]
pub fn has_boundaries(cycle: &Cycle) -> bool {
    mortar(cycle).is_some()
}

/// The vertices of all boundaries, and the edges between them: see [`MortarState::boundaries`].
#[must_use]
pub fn boundaries(cycle: &Cycle) -> BoundaryMesh {
    let state = mortar(cycle);
    state.map_or_else(Default::default, |state| state.boundaries(&cycle.origin()))
}

/// Vertices of the slave of a mortar contact: see [`MortarState::vertices`].
#[must_use]
pub fn mortar_vertices(cycle: &Cycle, contact: ContactHandle) -> Option<Vec<VertexState>> {
    mortar(cycle)?.vertices(contact.id(), &cycle.origin())
}

/// Vertices of a boundary: see [`MortarState::boundary_vertices`].
#[must_use]
pub fn boundary_vertices(cycle: &Cycle, boundary: BoundaryHandle) -> Option<Vec<Vector>> {
    mortar(cycle)?.boundary_vertices(boundary.id(cycle), &cycle.origin())
}

/// Mortar contact force on the vertices of a body, or of a rigid line or surface, in the last step \[N\].
#[must_use]
pub fn mortar_force(cycle: &Cycle, boundary: BoundaryHandle) -> Option<Vector> {
    mortar(cycle)?.force_on(boundary.id(cycle))
}

/// Energy stored in the normal laws of mortar contact as of the last detection \[J\].
#[must_use]
pub fn mortar_energy(cycle: &Cycle) -> f64 {
    mortar(cycle).map_or(0.0, Interaction::energy)
}

/// Sets the coefficient of friction of a contact on the grid or by mortar; false where there is no such contact.
pub fn set_friction(cycle: &mut Cycle, contact: ContactHandle, friction: f64) -> bool {
    let contact = contact.id();
    if let Some(surfaces) = cycle.interaction_mut::<SurfaceContact>() {
        surfaces.set_friction(contact, friction);
    }
    let on_grid = cycle.interaction_mut::<GridContact>();
    if on_grid.is_some_and(|grid| grid.set_friction(contact, friction)) {
        return true;
    }
    let state = cycle.interaction_mut::<MortarState>();
    state.is_some_and(|state| state.set_friction(contact, friction))
}

/// Sets the coefficient of friction of a rigid surface; false where there is no such surface.
pub fn set_surface_friction(cycle: &mut Cycle, surface: SurfaceHandle, friction: f64) -> bool {
    let contact = cycle.interaction_mut::<SurfaceContact>();
    contact.is_some_and(|contact| contact.set_surface_friction(surface.place(), friction))
}

fn mortar(cycle: &Cycle) -> Option<&MortarState> {
    cycle.interaction()
}
