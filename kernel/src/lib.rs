//! The explicit MPM/GIMP cycle and what it needs.
//!
//! Flow: [`scene::Scene`] (checked values) -> [`plan::Plan`] (only what is needed) ->
//! [`simulation::Simulation`] (state and explicit cycle) -> what can be asked of it, and
//! [`simulation::Saved`], its state as one plain value.
//!
//! ```
//! use proctor_kernel::prelude::*;
//! use proctor_laws::LinearElastic;
//!
//! // A block of 0.2 m falls freely for a tenth of a second.
//! let mut scene = Scene::plane([8, 16], 0.05).with_gravity([0.0, -10.0, 0.0]);
//! let rubber = scene.add_material(LinearElastic::new(1e6, 0.3), 1000.0);
//! scene.add_body(Shape::rectangle([0.1, 0.5], [0.3, 0.7]), rubber);
//!
//! let mut simulation = scene.simulate(&Options::default())?;
//! while simulation.time() < 0.1 {
//!     simulation.step(0.1)?;
//! }
//! let (mass, center, _) = simulation.center(0);
//! assert!((mass - 40.0).abs() < 1e-9);
//! assert!((center[1] - (0.6 - 0.5 * 10.0 * 0.1 * 0.1)).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! It reads and writes no files: `proctor-files`, the package beside it, does, and needs nothing of the kernel that another
//! user of the library could not have.

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod lanes;
pub mod laws;
pub mod layout;
pub mod particles;
pub mod plan;
pub mod prelude;
pub mod scene;
pub mod simulation;
pub mod transfers;
pub mod weighting;

// What the cycle is made of: open to the tests and benchmarks beside it, and not meant for a user. What a user's own
// condition or interaction meets of it is in `simulation`.
#[doc(hidden)]
pub mod contact;
#[doc(hidden)]
pub mod grid;
#[doc(hidden)]
pub mod sorting;
#[doc(hidden)]
pub mod stage;
#[doc(hidden)]
pub mod weights;

pub use proctor_geometry::{bodies, memory, mortar, number, shape, solid, surface, team};
