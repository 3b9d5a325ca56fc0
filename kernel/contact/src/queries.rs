//! Forces, gaps and boundaries of the contacts of a simulation, for output.

use crate::geometry::surface::NearestPoint;
use crate::grid::GridContact;
use crate::mortar::{BoundaryDrift, BoundaryVertex, MortarState, VertexState};
use crate::surfaces::SurfaceContact;
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{Interaction, Simulation};

/// Contact force on a body in the last step \[N\]: the sum over its pairs, driven ones among them, and the rigid surfaces. On the
/// two bodies of a pair that have no other it is the same number with opposite signs.
#[must_use]
pub fn contact_force(simulation: &Simulation, set: usize) -> Vector {
    let id = simulation.model().bodies[set].id;
    let mut sum = mortar_force(simulation, id).unwrap_or_default();
    let surfaces = simulation.interaction::<SurfaceContact>();
    let of_shapes = surfaces.map_or([0.0; 3], |s| s.shape_force_on(set));
    sum = std::array::from_fn(|axis| sum[axis] + of_shapes[axis]);
    if let Some(contact) = surfaces {
        for surface in 0..contact.surface_count() {
            let force = contact.force_on(surface, set);
            sum = std::array::from_fn(|axis| sum[axis] + force[axis]);
        }
    }
    if let Some(contact) = simulation.interaction::<GridContact>() {
        contact.add_force_on(set, &mut sum);
    }
    sum
}

/// True for a body in a pair that can touch, or where there are rigid surfaces.
#[must_use]
pub fn has_contact(simulation: &Simulation, set: usize) -> bool {
    let surfaces = simulation.interaction::<SurfaceContact>();
    let on_grid = simulation.interaction::<GridContact>();
    surfaces.is_some_and(|s| s.surface_count() > 0)
        || on_grid.is_some_and(|contact| contact.acts_on(set))
        || mortar_force(simulation, simulation.model().bodies[set].id).is_some()
}

/// Displacement of a rigid surface since the start at a time \[m\].
#[must_use]
pub fn surface_shift(simulation: &Simulation, surface: usize, time: f64) -> Vector {
    let contact = simulation.interaction::<SurfaceContact>();
    contact.map_or([0.0; 3], |contact| contact.shift(surface, time))
}

/// Gap between a particle and a rigid surface: see [`SurfaceContact::gap`].
#[must_use]
pub fn surface_gap(
    simulation: &Simulation,
    surface: usize,
    particle: [usize; 2],
    within: f64,
) -> Option<(f64, NearestPoint)> {
    let contact = simulation.interaction::<SurfaceContact>()?;
    contact.gap(&simulation.view(), surface, particle, within)
}

/// Force of the bodies on a rigid surface in the last step \[N\].
#[must_use]
pub fn surface_force(simulation: &Simulation, surface: usize) -> Vector {
    let mut force = [0.0; 3];
    if let Some(contact) = simulation.interaction::<SurfaceContact>() {
        for set in 0..simulation.sets().len() {
            let own = contact.force_on(surface, set);
            force = std::array::from_fn(|axis| force[axis] - own[axis]);
        }
    }
    force
}

/// Impulse of a rigid surface on a body since the start \[N s\].
#[must_use]
pub fn surface_impulse(simulation: &Simulation, surface: usize, set: usize) -> Vector {
    let contact = simulation.interaction::<SurfaceContact>();
    contact.map_or([0.0; 3], |contact| contact.impulse_on(surface, set))
}

/// The vertex that drifted farthest off its body: see [`MortarState::boundary_drift`].
#[must_use]
pub fn boundary_drift(simulation: &Simulation) -> Option<BoundaryDrift> {
    mortar(simulation)?.boundary_drift(&simulation.view())
}

/// True where anything has a boundary: a body, or a rigid line or surface of mortar contact.
#[must_use]
pub fn has_boundaries(simulation: &Simulation) -> bool {
    mortar(simulation).is_some()
}

/// The vertices of all boundaries, and the edges between them: see [`MortarState::boundaries`].
#[must_use]
pub fn boundaries(simulation: &Simulation) -> (Vec<BoundaryVertex>, Vec<[usize; 2]>) {
    let state = mortar(simulation);
    state.map_or_else(Default::default, |state| {
        state.boundaries(&simulation.origin())
    })
}

/// Vertices of the slave of a mortar contact: see [`MortarState::vertices`].
#[must_use]
pub fn mortar_vertices(simulation: &Simulation, contact: i64) -> Option<Vec<VertexState>> {
    mortar(simulation)?.vertices(contact, &simulation.origin())
}

/// Vertices of a boundary: see [`MortarState::boundary_vertices`].
#[must_use]
pub fn boundary_vertices(simulation: &Simulation, id: i64) -> Option<Vec<Vector>> {
    mortar(simulation)?.boundary_vertices(id, &simulation.origin())
}

/// Mortar contact force on the vertices of a body, or of a rigid line or surface, in the last step \[N\].
#[must_use]
pub fn mortar_force(simulation: &Simulation, id: i64) -> Option<Vector> {
    mortar(simulation)?.force_on(id)
}

/// Energy stored in the normal laws of mortar contact as of the last detection \[J\].
#[must_use]
pub fn mortar_energy(simulation: &Simulation) -> f64 {
    mortar(simulation).map_or(0.0, Interaction::energy)
}

/// Sets the coefficient of friction of a contact on the grid or by mortar; false where there is none of this identifier.
pub fn set_friction(simulation: &mut Simulation, contact: i64, friction: f64) -> bool {
    if let Some(surfaces) = simulation.interaction_mut::<SurfaceContact>() {
        surfaces.set_friction(contact, friction);
    }
    let on_grid = simulation.interaction_mut::<GridContact>();
    if on_grid.is_some_and(|grid| grid.set_friction(contact, friction)) {
        return true;
    }
    let state = simulation.interaction_mut::<MortarState>();
    state.is_some_and(|state| state.set_friction(contact, friction))
}

/// Sets the coefficient of friction of a rigid surface, by its place; false where there is none of it.
pub fn set_surface_friction(simulation: &mut Simulation, surface: usize, friction: f64) -> bool {
    let contact = simulation.interaction_mut::<SurfaceContact>();
    contact.is_some_and(|contact| contact.set_surface_friction(surface, friction))
}

fn mortar(simulation: &Simulation) -> Option<&MortarState> {
    simulation.interaction()
}
