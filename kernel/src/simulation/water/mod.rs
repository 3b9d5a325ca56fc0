//! The pore water: a velocity field beside that of the skeleton it flows through, on the same particles.
//!
//! Particles move with the skeleton. They carry the velocity w of the water and one pore pressure p (compression positive) too.
//!
//! (1-n) `rho_s` dv/dt = div sigma' - (1-n) grad p + (1-n) `rho_s` g + D (w - v),
//! n `rho_w` dw/dt = -n grad p + n `rho_w` g - D (w - v), dp/dt = -(`K_w`/n) div((1-n) v + n w), D = n² `rho_w` `g_k`/k
//! (Zienkiewicz and Shiomi 1984; van Esch et al. 2011). The term (w - v) . grad w is left out.
//!
//! The pressure is mapped once, without the porosity of particles, and split at the node by the porosity there; the mean velocity
//! whose divergence changes it is formed with the same porosity. So both are transposes of each other, energy is kept, and
//! water at rest stays at rest where the porosity jumps. Drag is the exact solution of the implicit pair of equations of a
//! node, as a correction of trial velocities: no conductivity bounds the step.

mod gather;
mod measure;
mod nodes;
mod open;
mod phases;
mod pressed;

pub(super) use gather::exchanges_per_step;
pub(super) use measure::work_of_held_pressure;
pub(super) use nodes::{drag, porosity_at, share_beyond, split};
pub(super) use open::fold_open;
