//! Gaps between particles and surfaces, and the motion of surfaces.

use super::near_particles::ParticlePlace;
use super::obstacle::RigidObstacle;
use crate::layout::Layout;
use crate::particles::ParticleSet;
use crate::scene::{RigidSurface, Scene, Vector};
use crate::simulation::error::SetupError;
use crate::simulation::{BodyRun, Simulation};
use crate::surface::{NearestPoint, Surface};
use std::sync::Arc;

/// Share of the smallest cell edge by which a body may overlap a surface at the start.
const OVERLAP: f64 = 0.01;

impl Simulation {
    /// Gap between a particle and a surface \[m\], and the point of the surface, if it is smaller than `within` and the
    /// particle lies over the surface rather than beside it.
    ///
    /// The particle reaches as far as the ellipsoid in its domain: |l n| with the half-lengths l and the normal n.
    #[must_use]
    pub fn surface_gap(
        &self,
        surface: usize,
        set: usize,
        p: usize,
        within: f64,
    ) -> Option<(f64, NearestPoint)> {
        let shift = self.surface_shift(surface, self.state.clock.time);
        let place = ParticlePlace { surface, set, p };
        self.gap_to(
            &RigidObstacle::Surface(surface),
            place,
            &shift,
            within,
            None,
        )
    }

    /// The same for anything rigid that has moved by `shift`, where the nearest triangle of a surface may be known but for a
    /// little.
    pub(super) fn gap_to(
        &self,
        rigid: &RigidObstacle,
        ParticlePlace { set, p, .. }: ParticlePlace,
        shift: &Vector,
        within: f64,
        triangle: Option<usize>,
    ) -> Option<(f64, NearestPoint)> {
        let own = half_lengths(&self.state.sets[set], &self.model.bodies[set], p);
        let half = rigid.half_lengths(own);
        let (x, within_centre) = (self.state.sets[set].position(p), within + length(&half));
        let mut nearest = rigid.nearest(self, &x, shift, within_centre, triangle)?;
        if nearest.on_rim {
            return None;
        }
        let gap = nearest.distance - reach(&half, &nearest.normal);
        let origin = &self.model.scene.mesh.origin;
        nearest.point = std::array::from_fn(|axis| nearest.point[axis] + origin[axis]);
        (gap < within).then_some((gap, nearest))
    }

    /// A position relative to the mesh as it is in the coordinates of a local surface that has moved by `shift`.
    pub(super) fn on_surface(&self, x: &Vector, shift: &Vector) -> Vector {
        std::array::from_fn(|axis| x[axis] + self.state.mesh_shift[axis] - shift[axis])
    }

    /// No body may overlap a surface at the start.
    pub(super) fn refuse_overlap_with_surfaces(&self) -> Result<(), SetupError> {
        let allowed = OVERLAP * self.smallest_cell();
        for surface in 0..self.model.scene.surfaces.len() {
            let mut deepest: Option<(f64, usize, usize)> = None;
            for set in 0..self.state.sets.len() {
                for p in 0..self.state.sets[set].len() {
                    let threshold = self.model.scene.surfaces[surface].distance_threshold;
                    if let Some((gap, _)) = self.surface_gap(surface, set, p, threshold)
                        && gap < -allowed
                        && deepest.is_none_or(|d| gap < d.0)
                    {
                        deepest = Some((gap, set, p));
                    }
                }
            }
            if let Some((gap, set, p)) = deepest {
                let [x, y, z] = self.position(set, p);
                return Err(SetupError::Body {
                    body: self.model.scene.bodies[set].name.clone(),
                    reason: format!(
                        "it reaches {} m through the surface {:?} at the start, at ({x}, {y}, {z}) m; accepted: bodies \
                         on the side to which the normals of the surface point",
                        -gap, self.model.scene.surfaces[surface].name
                    ),
                });
            }
        }
        Ok(())
    }
}

/// The surfaces of a scene relative to the origin of its mesh.
pub(in crate::simulation) fn local(scene: &Scene) -> Vec<Arc<Surface>> {
    let origin = &scene.mesh.origin;
    let one = |rigid: &RigidSurface| {
        if *origin == [0.0; 3] {
            Arc::clone(&rigid.surface)
        } else {
            Arc::new(rigid.surface.relative_to(origin))
        }
    };
    scene.surfaces.iter().map(one).collect()
}

/// How far the ellipsoid with these half-lengths reaches along a unit normal \[m\].
fn reach(half: &Vector, normal: &Vector) -> f64 {
    length(&std::array::from_fn(|axis| half[axis] * normal[axis]))
}

/// Where the ellipsoid with these half-lengths touches a surface, from its centre \[m\]. Of a particle that is pressed together
/// to less than half of it the point comes nearer to the centre, and ends there: so no strain brings a centre through a
/// surface. For less strain it stays where a row of particles ends that a wall presses on.
pub(super) fn touching_point(half: &Vector, nearest: &NearestPoint) -> Vector {
    let normal = &nearest.normal;
    let reach = reach(half, normal);
    let pressed = (2.0 * nearest.distance / reach).clamp(0.0, 1.0);
    std::array::from_fn(|axis| -pressed * half[axis] * half[axis] * normal[axis] / reach)
}

/// Half-lengths of the domain of a particle \[m\]. Weighting functions without a domain leave its volume, a cube.
pub(super) fn half_lengths(set: &ParticleSet, body: &BodyRun, p: usize) -> Vector {
    if let Some(half) = body.reach {
        return half;
    }
    match body.mapping.half_length_column {
        Some(first) => std::array::from_fn(|axis| {
            if axis < set.layout.axes {
                set.columns[first + axis][p] * body.mapping.cell[axis]
            } else {
                0.0
            }
        }),
        None => [0.5 * libm::cbrt(set.columns[Layout::VOLUME][p]); 3],
    }
}

pub(super) fn length(v: &Vector) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
