//! Boundaries and pairs after a change between two stages.

use super::MortarState;
use super::boundaries::Boundaries;
use super::pair::{friction, pair};
use super::surface::BoundaryCarrier;
use crate::geometry::mortar::elements::Elements;
use crate::values::MortarContact;
use proctor_kernel::simulation::BodyRun;

impl MortarState {
    /// Moves the boundary of a body, if it has one, as the body moves now: with its nodes or as prescribed.
    pub(super) fn set_carrier(&mut self, body: &BodyRun, index: usize) {
        let boundaries = &self.given.boundaries;
        let Some(given) = boundaries.iter().find(|given| given.body == body.id) else {
            return;
        };
        let carrier = BoundaryCarrier::of(body, index, given.follow);
        self.plane
            .set_carrier(body.id, &carrier, &self.given.contacts);
        self.space
            .set_carrier(body.id, &carrier, &self.given.contacts);
    }

    /// Sets the coefficient of friction of a contact, by its identifier; false where there is none of it.
    pub fn set_friction(&mut self, contact: i64, coefficient: f64) -> bool {
        let mut contacts = self.given.contacts.iter_mut();
        let Some(entry) = contacts.find(|c| c.id == contact) else {
            return false;
        };
        entry.friction = coefficient;
        let friction = friction(entry);
        let plane = self
            .plane
            .pairs
            .iter_mut()
            .map(|pair| (pair.id, &mut pair.law));
        let space = self
            .space
            .pairs
            .iter_mut()
            .map(|pair| (pair.id, &mut pair.law));
        for (_, law) in plane.chain(space).filter(|(id, _)| *id == contact) {
            law.friction = friction;
        }
        true
    }
}

impl<B: Elements<D, T>, const D: usize, const N: usize, const T: usize> Boundaries<B, D, N, T> {
    /// Gives the surface of a body another carrier. Two rigid surfaces make no pair, so there may be other pairs then;
    /// those that stay keep what they remember.
    fn set_carrier(&mut self, id: i64, carrier: &BoundaryCarrier, contacts: &[MortarContact]) {
        for surface in self.surfaces.iter_mut().filter(|s| s.id == id) {
            surface.carrier = carrier.clone();
            surface.patches.clear();
            surface.around = carrier.around();
        }
        let mut known = std::mem::take(&mut self.pairs);
        for contact in contacts {
            if let Some(new) = pair(contact, &self.surfaces) {
                let old = known.iter().position(|old| old.id == new.id);
                self.pairs.push(old.map_or(new, |at| known.swap_remove(at)));
            }
        }
        self.pairs.sort_by_key(|pair| pair.id);
    }
}
