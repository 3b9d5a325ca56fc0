//! Memory of boundaries, taken before they are allocated.
//!
//! Estimates, on the high side: what an array holds, and a copy where a checkpoint makes one.

use proctor_geometry::memory::{Memory, OutOfMemory};
use proctor_kernel::simulation::SetupError;

/// Bytes of a vertex of a boundary in the plane with its segment, its normal, its nodes and what a pair keeps of it.
const VERTEX: f64 = 1024.0;
/// Particles along each axis that a vertex is tied to, those beyond a plane of symmetry included.
const TIED: f64 = 5.0;
/// Bytes of what ties a vertex to a particle.
const TIE: f64 = 32.0;
/// Bytes of a triangle of a boundary in space with its share of vertices, edges, nodes and of what a pair keeps.
const TRIANGLE: f64 = 2048.0;

/// Takes the memory of a boundary of so many vertices in the plane.
///
/// # Errors
/// [`SetupError::Memory`].
pub(super) fn vertices(count: f64, path: &str, memory: &mut Memory) -> Result<(), SetupError> {
    let each = VERTEX + TIED.powi(2) * TIE;
    memory
        .take(format!("a boundary of {count:.0} vertices"), count * each)
        .map_err(|error| at(path, error))
}

/// Takes the memory of a boundary of so many triangles in space.
///
/// # Errors
/// [`SetupError::Memory`].
pub(super) fn triangles(count: f64, path: &str, memory: &mut Memory) -> Result<(), SetupError> {
    memory
        .take(
            format!("a boundary of {count:.0} triangles"),
            count * (TRIANGLE + 0.5 * TIED.powi(3) * TIE),
        )
        .map_err(|error| at(path, error))
}

fn at(path: &str, error: OutOfMemory) -> SetupError {
    SetupError::Memory {
        path: path.to_owned(),
        error,
    }
}
