//! Angular momentum of bodies that nothing outside turns.
//!
//! Mapping to the nodes keeps the angular momentum of particles. FLIP then moves them with another velocity than they carry, so
//! that spin turns into noise: half of it in a turn of a disc of five cells, a tenth of ten, a fiftieth of twenty. Affine
//! transfers keep it, and one with a share of PIC loses it as friction would; there it is not looked at.

use crate::layout::Layout;
use crate::model::{Damping, TransferKind, Vector};
use crate::particles::ParticleSet;
use crate::simulation::Cycle;
use crate::simulation::values::{EventKind, Spin};

impl Cycle {
    /// Angular momentum of the particles, where nothing outside can turn them and FLIP moves them.
    pub(crate) fn spin(&self) -> Option<Spin> {
        self.is_left_alone().then_some(())?;
        let [mass, center @ .., px, py, pz] = self.sums(|set, p| {
            let (m, x, v) = (mass_of(set, p), set.position(p), set.velocity(p));
            [
                m,
                m * x[0],
                m * x[1],
                m * x[2],
                m * v[0],
                m * v[1],
                m * v[2],
            ]
        });
        let momentum = [px, py, pz];
        let [x, y, z, scale] = self.sums(|set, p| {
            let (m, x, v) = (mass_of(set, p), set.position(p), set.velocity(p));
            let r: Vector = std::array::from_fn(|axis| x[axis] - center[axis] / mass);
            let u: Vector = std::array::from_fn(|axis| v[axis] - momentum[axis] / mass);
            let [x, y, z] = std::array::from_fn(|axis| {
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                m * (r[a] * u[b] - r[b] * u[a])
            });
            let size = m * (length_squared(&r) * length_squared(&u)).sqrt();
            [x, y, z, size]
        });
        Some(Spin {
            about_centre: [x, y, z],
            scale,
        })
    }

    /// Share of the angular momentum of the start that is gone, over the sum of its magnitudes; `None` where it is not
    /// known to have to stay.
    pub(crate) fn lost_spin(&self) -> Option<f64> {
        let (start, now) = (self.state.start_spin?, self.spin()?);
        let removed =
            |event: &crate::simulation::Event| matches!(event.kind, EventKind::Removed(_));
        if start.scale <= 0.0 || self.model.has_own || self.state.events.iter().any(removed) {
            return None;
        }
        let lost: Vector =
            std::array::from_fn(|axis| start.about_centre[axis] - now.about_centre[axis]);
        Some(length_squared(&lost).sqrt() / start.scale)
    }
}

impl Cycle {
    /// True with FLIP, where gravity and the bodies alone act. Contact may lose angular momentum.
    fn is_left_alone(&self) -> bool {
        let settings = &self.model.settings;
        let planes = (0..settings.dimension.axes())
            .any(|axis| [0, 1].iter().any(|side| settings.plane_acts(axis, *side)));
        let loads = settings.point_loads.is_empty()
            && settings.tractions.is_empty()
            && settings.box_loads.is_empty()
            && settings.standing_waters.is_empty();
        settings.transfer.kind == TransferKind::Flip
            && settings.transfer.pic_fraction == 0.0
            && settings.damping == Damping::None
            && !planes
            && !settings.mesh.axisymmetric
            && loads
            && settings.held_boxes.is_empty()
            && !self.balance_traits().dissipates
            && !settings.drives_bodies
    }
}

fn mass_of(set: &ParticleSet, p: usize) -> f64 {
    set.columns[Layout::MASS][p]
}

fn length_squared(v: &Vector) -> f64 {
    v.iter().map(|c| c * c).sum()
}
