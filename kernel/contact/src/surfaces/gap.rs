//! Gaps between particles and surfaces, and the motion of surfaces.

use super::SurfaceContact;
use super::obstacle::{RigidObstacle, SurfaceObstacle};
use super::particle_ellipsoid::{half_lengths, length, reach};
use crate::geometry::surface::NearestPoint;
use proctor_kernel::model::Vector;
use proctor_kernel::simulation::{SetupError, StepView};

/// Share of the smallest cell edge by which a body may overlap a surface at the start.
const OVERLAP: f64 = 0.01;

impl SurfaceContact {
    /// Gap between a particle and a surface \[m\], and the point of the surface, if it is smaller than `within` and the
    /// particle lies over the surface rather than beside it.
    ///
    /// The particle reaches as far as the ellipsoid in its domain: |l n| with the half-lengths l and the normal n.
    #[must_use]
    pub fn gap(
        &self,
        view: &StepView<'_>,
        surface: usize,
        particle: [usize; 2],
        within: f64,
    ) -> Option<(f64, NearestPoint)> {
        surface_gap(view, self.rigid.get(surface)?, particle, within)
    }
}

fn surface_gap(
    view: &StepView<'_>,
    rigid: &RigidObstacle,
    [set, p]: [usize; 2],
    within: f64,
) -> Option<(f64, NearestPoint)> {
    gap_to(view, rigid, [set, p], &rigid.shift(view), within, None)
}

/// The gap of a particle to anything rigid that has moved by `shift`, where the nearest triangle of a surface may be known but
/// for a little.
pub(super) fn gap_to(
    view: &StepView<'_>,
    rigid: &RigidObstacle,
    [set, p]: [usize; 2],
    shift: &Vector,
    within: f64,
    triangle: Option<usize>,
) -> Option<(f64, NearestPoint)> {
    let own = half_lengths(&view.particles[set], &view.bodies[set], p);
    let half = rigid.half_lengths(own);
    let (x, within_centre) = (view.particles[set].position(p), within + length(&half));
    let mut nearest = rigid.nearest(view, &x, shift, within_centre, triangle)?;
    if nearest.on_rim {
        return None;
    }
    let gap = nearest.distance - reach(&half, &nearest.normal);
    let origin = &view.settings.mesh.origin;
    nearest.point = std::array::from_fn(|axis| nearest.point[axis] + origin[axis]);
    (gap < within).then_some((gap, nearest))
}

/// No body may overlap a surface at the start.
pub(super) fn refuse_overlap_with_surfaces(
    view: &StepView<'_>,
    rigid: &[RigidObstacle],
) -> Result<(), SetupError> {
    let allowed = OVERLAP * view.smallest_cell();
    for one in rigid {
        let RigidObstacle::Surface(SurfaceObstacle { given: surface, .. }) = one else {
            continue;
        };
        let mut deepest: Option<(f64, usize, usize)> = None;
        for set in 0..view.particles.len() {
            for p in 0..view.particles[set].len() {
                let threshold = surface.distance_threshold;
                if let Some((gap, _)) = surface_gap(view, one, [set, p], threshold)
                    && gap < -allowed
                    && deepest.is_none_or(|d| gap < d.0)
                {
                    deepest = Some((gap, set, p));
                }
            }
        }
        if let Some((gap, set, p)) = deepest {
            let [x, y, z] = view.position(set, p);
            return Err(SetupError::Body {
                body: view.bodies[set].name.clone(),
                reason: format!(
                    "it reaches {} m through the surface {:?} at the start, at ({x}, {y}, {z}) m; accepted: bodies \
                     on the side to which the normals of the surface point",
                    -gap, surface.name
                ),
            });
        }
    }
    Ok(())
}
