//! Explicit finite elements in plane strain: the reference where there is no closed form.
//!
//! Four-node quadrilaterals with 2 x 2 Gauss points, total Lagrangian, so that nothing is carried along with the mesh
//! and nothing can drift: forces follow from the stored energy of the present positions alone. Lumped mass, central
//! differences. It is as small as the cantilever, the ring and the indenter need, and shares nothing with the kernel.
//!
//! Left out are: contact other than with a mirror plane or a circle, locking (bending and nearly incompressible materials need
//! fine meshes, or extrapolation over two).

mod barrier;
mod indenter;
mod material;
mod mesh;
mod model;

pub use barrier::Barrier;
pub use indenter::Indenter;
pub use material::NeoHookean;
pub use mesh::Mesh;
pub use model::{Failure, Model};
