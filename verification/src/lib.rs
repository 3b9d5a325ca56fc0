//! Exact solutions, verification cases and observed orders for the MPM kernel.
//!
//! ```text
//! question ──► ladder of rungs ──scene──► simulation ──compare──► errors, orders ──gates──► verdict
//!                                             exact solution ──┘          wrong reference: must fail
//! ```
//!
//! A [`Case`](case::Case) is one value that holds all of this. [`study`] asks the same of every method, [`mill`] draws problems
//! with known answers, [`generated`] checks scenes without one, and [`stability`] finds the largest stable step.
//!
//! ```
//! use proctor_scene::simulation::Options;
//! use proctor_verification::case::{self, Size};
//!
//! let case = case::find("rotation").expect("a case of that name");
//! let mut solved = vec![];
//! for rung in case.rungs(Size::Quick) {
//!     let result = case.solve(&rung, &Options::default(), &mut |_| ())?;
//!     solved.push((rung, result));
//! }
//! assert!(case.judge(Size::Quick, &solved).gates.iter().all(|gate| gate.passed()));
//! # Ok::<(), case::CaseError>(())
//! ```
#![forbid(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod case;
pub mod cases;
pub mod check;
pub mod convergence;
pub mod element;
pub mod exact;
pub mod generated;
pub mod guest;
pub mod mill;
pub mod random;
pub mod refine;
pub mod sensitivity;
pub mod settings;
pub mod stability;
pub mod study;
