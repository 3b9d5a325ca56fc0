//! The explicit MPM/GIMP cycle: particles, grid, transfers, conditions, and the traits of laws and of interactions.
//!
//! ```text
//! particles ──p2g──► mass, momentum, force ──solve──► velocity ──g2p──► velocity, position
//!     ▲                   of the nodes     conditions, of the nodes             │
//!     │                                      contact                            │
//!     └──────── stress ◄──law── strain ◄── velocity gradient of the particles ◄─┘
//! ```
//!
//! This is a step with USL. USF moves the stress update before the solution, and MUSL maps the new velocities of the particles
//! a second time before it.
//!
//! Flow: [`simulation::Model`] (settings, plan, bodies) and [`simulation::Start`] (particles, interactions) ->
//! [`simulation::Cycle`] (state and explicit cycle). A cycle gives its results by queries, and its whole state as a
//! [`simulation::SavedState`].
//!
//! The stages, the grid, the particles and the trait of laws are in `proctor-stages`, which is handed on here under the same names:
//! a program names one package.
//!
//! It knows no scene, no law of a material, no contact and no file. Laws, conditions and interactions come by the traits
//! [`laws::Law`], [`simulation::Condition`] and [`simulation::Interaction`]; `proctor-laws`, `proctor-contact` and
//! `proctor-scene` beside it implement them, and have nothing that a program's own does not have.
//!
//! ```
//! use proctor_scene::prelude::*;
//!
//! // A column of 2 m sinks into its place: packages above this one fill it with particles and know its law.
//! let mut scene = Scene::plane([2, 10], 0.25).with_gravity([0.0, -10.0]);
//! let clay = scene.add_material(LinearElastic::new(1e6, 0.3), 2000.0);
//! scene.add_body(Shape::rectangle([0.0, 0.0], [0.5, 2.0]), clay);
//!
//! let mut simulation = scene.simulate(&Options::default())?;
//! let info = simulation.step(1.0)?;
//! assert_eq!((info.step, simulation.particles()), (1, 64));
//! assert!(info.dt > 0.0 && simulation.time() == info.dt);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![deny(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod plan;
pub mod simulation;

pub use proctor_geometry::{
    bodies, enclosed, exact_sum, memory, number, shape, sheet, solid, stratum, team,
};

pub use proctor_stages::{
    history, lanes, laws, layout, model, particles, ranks, transfers, weighting,
};

// What the cycle is made of: open to the tests and benchmarks beside it, and not meant for a user. What a user's own
// condition or interaction meets of it is in `simulation`.
#[doc(hidden)]
pub use proctor_stages::{fields, grid, sorting, stage, weights};
