//! Simulation of a scene: the scene and its explicit cycle, with the queries of contact.

use crate::setup::{Options, set_up};
use crate::start_error::StartError;
use crate::values::Scene;
use proctor_contact::geometry::surface::NearestPoint;
use proctor_contact::{
    BoundaryDrift, BoundaryHandle, BoundaryMesh, ContactHandle, SurfaceHandle, VertexState, queries,
};
use proctor_kernel::model::{Damping, History, PlaneCondition, Vector};
use proctor_kernel::simulation::{BodyHandle, Cycle, SetupError};
use std::ops::{Deref, DerefMut};

/// Simulation of a scene: the scene, and the explicit [`Cycle`] of the kernel that was made of it.
///
/// A change between two stages changes the scene with it, so that a checkpoint of a later stage belongs to the changed scene.
pub struct Simulation {
    scene: Scene,
    cycle: Cycle,
}

impl Deref for Simulation {
    type Target = Cycle;

    fn deref(&self) -> &Cycle {
        &self.cycle
    }
}

impl DerefMut for Simulation {
    fn deref_mut(&mut self) -> &mut Cycle {
        &mut self.cycle
    }
}

impl Scene {
    /// Checks the scene and sets it in motion.
    ///
    /// # Errors
    /// If the scene has faults, each with the path of its value, or cannot be set up.
    pub fn simulate(&self, options: &Options) -> Result<Simulation, StartError> {
        self.check().map_err(StartError::Scene)?;
        Simulation::new(self, options).map_err(StartError::Setup)
    }
}

impl Simulation {
    /// Sets a scene that was checked in motion.
    ///
    /// # Errors
    /// Input that shows its fault only here: see [`SetupError`].
    pub fn new(scene: &Scene, options: &Options) -> Result<Self, SetupError> {
        let cycle = set_up(scene, options)?;
        Ok(Self {
            scene: scene.clone(),
            cycle,
        })
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Sets the acceleration of gravity \[m/s²\] from here on: see [`set_gravity`](Cycle::set_gravity).
    ///
    /// # Errors
    /// A component that is not finite, or one along an axis that does not exist.
    pub fn set_gravity(&mut self, gravity: Vector) -> Result<(), SetupError> {
        self.cycle.set_gravity(gravity)?;
        self.scene.gravity = gravity;
        Ok(())
    }

    /// Sets the conditions of the boundary planes of the mesh from here on: see [`set_planes`](Cycle::set_planes).
    ///
    /// # Errors
    /// A plane that becomes or ceases to be absorbing or antisymmetric; a scene with mortar contact, whose boundaries are cut by the
    /// planes of the start.
    pub fn set_planes(&mut self, planes: [[PlaneCondition; 2]; 3]) -> Result<(), SetupError> {
        if !self.scene.mortar.boundaries.is_empty() {
            return Err(refused(
                "a boundary plane",
                "its boundaries are cut by the planes of the start; accepted: a scene without mortar contact",
            ));
        }
        self.cycle.set_planes(planes)?;
        self.scene.mesh.planes = planes;
        Ok(())
    }

    /// Sets the coefficient of friction of a contact from here on, on the grid or by mortar.
    ///
    /// # Errors
    /// No such contact, or a coefficient that is negative or not a number; for mortar contact also an infinite one.
    pub fn set_friction(
        &mut self,
        contact: impl Into<ContactHandle>,
        friction: f64,
    ) -> Result<(), SetupError> {
        let contact = contact.into();
        if friction.is_nan() || friction < 0.0 {
            return Err(refused(
                "friction",
                &format!("{friction}; accepted: a number, 0 or greater"),
            ));
        }
        let mut on_grid = self.scene.contacts.iter_mut();
        if let Some(entry) = on_grid.find(|c| c.id == contact.id()) {
            entry.friction = friction;
        } else {
            let mut by_mortar = self.scene.mortar.contacts.iter_mut();
            let Some(entry) = by_mortar.find(|c| c.id == contact.id()) else {
                return Err(refused(
                    "contact",
                    &format!("{}, which no contact has as its id", contact.id()),
                ));
            };
            if friction.is_infinite() {
                return Err(refused(
                    "friction",
                    &format!("{friction}; accepted: a finite number, 0 or greater"),
                ));
            }
            entry.friction = friction;
        }
        queries::set_friction(&mut self.cycle, contact, friction);
        Ok(())
    }

    /// Sets the coefficient of friction of a rigid surface from here on.
    ///
    /// # Errors
    /// No such surface, or a coefficient that is negative or not finite.
    pub fn set_surface_friction(
        &mut self,
        surface: impl Into<SurfaceHandle>,
        friction: f64,
    ) -> Result<(), SetupError> {
        let surface = surface.into();
        if !friction.is_finite() || friction < 0.0 {
            return Err(refused(
                "friction",
                &format!("{friction}; accepted: a finite number, 0 or greater"),
            ));
        }
        let count = self.scene.surfaces.len();
        let Some(entry) = self.scene.surfaces.get_mut(surface.place()) else {
            return Err(refused(
                "surface",
                &format!(
                    "{}; accepted: below {count}, the number of surfaces",
                    surface.place()
                ),
            ));
        };
        entry.friction = friction;
        queries::set_surface_friction(&mut self.cycle, surface, friction);
        Ok(())
    }

    /// Prescribes the velocity of a body from here on, or with `None` releases it: see
    /// [`set_motion`](Cycle::set_motion).
    ///
    /// # Errors
    /// No such body, or a history that is empty or not finite or whose times do not increase.
    pub fn set_motion(
        &mut self,
        body: BodyHandle,
        motion: Option<History>,
    ) -> Result<(), SetupError> {
        self.cycle.set_motion(body, motion.clone())?;
        self.scene.bodies[body.place()].motion = motion;
        Ok(())
    }

    /// Sets the factor of local damping from here on; `None` for no damping.
    ///
    /// # Errors
    /// A factor outside 0 to 1, or a scene with another kind of damping.
    pub fn set_local_damping(&mut self, alpha: Option<f64>) -> Result<(), SetupError> {
        self.cycle.set_local_damping(alpha)?;
        self.scene.damping = alpha.map_or(Damping::None, |alpha| Damping::Local { alpha });
        Ok(())
    }

    /// Contact force on a body in the last step \[N\]: see [`contact_force`](queries::contact_force).
    #[must_use]
    pub fn contact_force(&self, body: impl Into<BodyHandle>) -> Vector {
        queries::contact_force(self, body.into())
    }

    /// True for a body in a pair that can touch, or where there are rigid surfaces.
    #[must_use]
    pub fn has_contact(&self, body: impl Into<BodyHandle>) -> bool {
        queries::has_contact(self, body.into())
    }

    /// Displacement of a rigid surface since the start at a time \[m\].
    #[must_use]
    pub fn surface_shift(&self, surface: impl Into<SurfaceHandle>, time: f64) -> Vector {
        queries::surface_shift(self, surface.into(), time)
    }

    /// Gap between a particle and a rigid surface \[m\], and the point of the surface, where it is less than `within`.
    #[must_use]
    pub fn surface_gap(
        &self,
        surface: impl Into<SurfaceHandle>,
        body: impl Into<BodyHandle>,
        p: usize,
        within: f64,
    ) -> Option<(f64, NearestPoint)> {
        queries::surface_gap(self, surface.into(), body.into(), p, within)
    }

    /// Force of the bodies on a rigid surface in the last step \[N\].
    #[must_use]
    pub fn surface_force(&self, surface: impl Into<SurfaceHandle>) -> Vector {
        queries::surface_force(self, surface.into())
    }

    /// Impulse of a rigid surface on a body since the start \[N s\].
    #[must_use]
    pub fn surface_impulse(
        &self,
        surface: impl Into<SurfaceHandle>,
        body: impl Into<BodyHandle>,
    ) -> Vector {
        queries::surface_impulse(self, surface.into(), body.into())
    }

    /// The vertex that drifted farthest off its body, of those of bodies that move freely; `None` where there is none.
    #[must_use]
    pub fn boundary_drift(&self) -> Option<BoundaryDrift> {
        queries::boundary_drift(self)
    }

    /// True where anything has a boundary: a body, or a rigid line or surface of mortar contact.
    #[must_use]
    pub fn has_boundaries(&self) -> bool {
        queries::has_boundaries(self)
    }

    /// The vertices of all boundaries, rigid lines and rigid surfaces of mortar contact, and the edges between them.
    #[must_use]
    pub fn boundaries(&self) -> BoundaryMesh {
        queries::boundaries(self)
    }

    /// Vertices of the slave of a mortar contact as of the last detection.
    #[must_use]
    pub fn mortar_vertices(&self, contact: impl Into<ContactHandle>) -> Option<Vec<VertexState>> {
        queries::mortar_vertices(self, contact.into())
    }

    /// Vertices of the boundary of a body, or of a rigid line or surface, in the coordinates of the scene \[m\].
    #[must_use]
    pub fn boundary_vertices(&self, boundary: impl Into<BoundaryHandle>) -> Option<Vec<Vector>> {
        queries::boundary_vertices(self, boundary.into())
    }

    /// Mortar contact force on the vertices of a body, or of a rigid line or surface, in the last step \[N\].
    #[must_use]
    pub fn mortar_force(&self, boundary: impl Into<BoundaryHandle>) -> Option<Vector> {
        queries::mortar_force(self, boundary.into())
    }

    /// Energy stored in the normal laws of mortar contact as of the last detection \[J\].
    #[must_use]
    pub fn mortar_energy(&self) -> f64 {
        queries::mortar_energy(self)
    }
}

fn refused(what: &str, reason: &str) -> SetupError {
    SetupError::Change {
        what: what.into(),
        reason: reason.into(),
    }
}
