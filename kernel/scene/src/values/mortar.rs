//! Stiffness of mortar contacts beside that of their bodies.

use crate::values::{Body, Scene};
use proctor_contact::MortarContact;
use std::f64::consts::PI;

/// Largest part of its way by which a round body may lag behind it with the default of the tangential stiffness.
pub const MOST_CREEP: f64 = 5e-3;

impl Scene {
    /// Largest lag of a round body behind its way of rolling that the tangential spring of a mortar contact allows, over the
    /// way; `None` where none of its bodies is round and free to move.
    ///
    /// Traction grows by kappa_t xi over the contact of 2 b, so that a force of 2 b² kappa_t xi creeps by xi. Hertz gives
    /// b² = 4 N R/(pi E*), friction is mu N at most, and E* no more than 4 E/3: xi <= pi mu E/(6 R kappa_t).
    #[must_use]
    pub fn rolling_creep(&self, contact: &MortarContact) -> Option<f64> {
        let round = self.ends(contact).filter_map(|body| {
            let young = self.materials.get(body.material)?.law.young();
            Some(young / body.shape.radius()?)
        });
        let stiffest = round.max_by(f64::total_cmp)?;
        Some(creep(contact.friction, stiffest) / contact.tangential_stiffness)
    }

    /// The tangential stiffness with which round bodies as large as those of a contact creep by no more than [`MOST_CREEP`]
    /// \[Pa/m\]; `None` where none of its bodies is free to move.
    #[must_use]
    pub fn usual_tangential_stiffness(&self, contact: &MortarContact) -> Option<f64> {
        let bodies = self.ends(contact).filter_map(|body| {
            let young = self.materials.get(body.material)?.law.young();
            Some(young / body.shape.half_size(self.dimension))
        });
        let stiffest = bodies.max_by(f64::total_cmp)?;
        Some(creep(contact.friction, stiffest) / MOST_CREEP)
    }

    /// Young's modulus of the softest body of a mortar contact \[Pa\]; `None` where none of its bodies is free to move.
    #[must_use]
    pub fn softest(&self, contact: &MortarContact) -> Option<f64> {
        let young = |body: &Body| Some(self.materials.get(body.material)?.law.young());
        self.ends(contact).filter_map(young).min_by(f64::total_cmp)
    }

    /// The bodies of a contact that are free to move.
    fn ends(&self, contact: &MortarContact) -> impl Iterator<Item = &Body> {
        let ends = [contact.master, contact.slave];
        let bodies = self.bodies.iter();
        bodies.filter(move |body| ends.contains(&body.id) && body.motion.is_none())
    }
}

/// Creep times tangential stiffness \[Pa/m\] of friction and Young's modulus over radius \[Pa/m\].
fn creep(friction: f64, young_over_radius: f64) -> f64 {
    PI / 6.0 * friction * young_over_radius
}
