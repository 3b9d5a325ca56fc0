//! A pair of boundaries in contact.

use super::surface::{BoundaryCarrier, MovingBoundary};
use crate::geometry::mortar::bound::ClosingRate;
use crate::geometry::mortar::elements::Elements;
use crate::geometry::mortar::law::{FLOOR, Friction, NormalLaw};
use crate::geometry::mortar::pair::{PairForces, PairLaw, Slip, Workspace};
use crate::geometry::mortar::points::MasterSearch;
use crate::values::{Enforcement, MortarContact};

/// A pair of surfaces.
#[derive(Clone, Debug)]
pub(crate) struct MortarPair<const D: usize, const T: usize> {
    pub(super) id: i64,
    pub(super) slave: usize,
    pub(super) master: usize,
    pub(super) law: PairLaw,
    pub(super) critical_gap: f64,
    pub(crate) slip: Slip<T>,
    pub(super) forces: PairForces<D, T>,
    /// Speed at which the pair closes.
    pub(super) closing: ClosingRate,
    pub(super) work: Workspace<D>,
}

/// The pair of an entry; none where both ends are rigid.
pub(super) fn pair<B: Elements<D, T>, const D: usize, const N: usize, const T: usize>(
    contact: &MortarContact,
    surfaces: &[MovingBoundary<B, D, N>],
) -> Option<MortarPair<D, T>> {
    let index = |id: i64| surfaces.iter().position(|s| s.id == id);
    let (slave, master) = (index(contact.slave)?, index(contact.master)?);
    let rigid = |s: usize| matches!(surfaces[s].carrier, BoundaryCarrier::Prescribed(_));
    if rigid(slave) && rigid(master) {
        return None;
    }
    let boundary = &surfaces[slave].boundary;
    let longest = boundary.longest();
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
            friction: friction(contact),
            detection: contact.detection,
            // Beyond the critical gap for the slip before contact, and as deep as a segment is long.
            search: MasterSearch {
                reach: contact.critical_gap + longest,
                depth: contact.critical_gap.max(longest),
            },
        },
        critical_gap: contact.critical_gap,
        slip: Slip(vec![[0.0; T]; boundary.sites().vertices().len()]),
        forces: PairForces::default(),
        closing: ClosingRate::NONE,
        work: Workspace::default(),
    })
}

/// Friction of an entry, if it has any.
pub(super) fn friction(contact: &MortarContact) -> Option<Friction> {
    (contact.friction > 0.0).then_some(Friction {
        coefficient: contact.friction,
        stiffness: contact.tangential_stiffness,
    })
}
