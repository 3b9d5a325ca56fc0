//! The files of the kernel: what it is told, and what it leaves behind.
//!
//! ```text
//! scene.json ──► json ──► Scene ──► Simulation ──► run ──► output ──► particles.pvd, history.csv,
//! record.csv ──► records ──┘  │                     │                 summary.json, checkpoint.bin
//! surface.stl ─► stl ─────────┤                     └──► Saved ◄──► checkpoint
//! terrain.asc ─► terrain ─────┘
//! ```
//!
//! [`json`] reads a scene with a place in the text for every problem, [`records`] accelerograms and particle lists, [`stl`]
//! surfaces, [`terrain`] surfaces of ground, all of them through [`reading`], which refuses what does not fit into memory. [`output`] knows the formats
//! and nothing of simulations; [`run`] drives a simulation from output time to output time and hands its state over.
//!
//! The kernel knows nothing of this package. What a checkpoint holds it gives as one plain value,
//! [`SavedState`](proctor_scene::simulation::SavedState), and everything else through what any user of the library can ask.
//!
//! ```
//! use proctor_files::json;
//! use std::path::Path;
//!
//! let scene = r#"{
//!   "dimension": 2, "time": 0.1, "gravity": [0, -9.81],
//!   "mesh": {"cells_dimension": [0.25, 0.25], "cells_number": [4, 4]},
//!   "material": [{"type": "elastic", "id": 1, "young": 1e5, "density": 1000, "poisson": 0.3}],
//!   "body": [{"type": "rectangle", "id": 1, "material_id": 1, "point_p1": [0, 0], "point_p2": [1, 0.5]}]
//! }"#;
//! assert_eq!(json::from_json(scene, "column.json", Path::new(""))?.name, "column");
//!
//! let error = json::from_json(&scene.replace("young", "jung"), "column.json", Path::new("")).unwrap_err();
//! println!("{error}"); // column.json, line, column, the key, what was found, what is accepted
//! # Ok::<(), proctor_scene::SceneError>(())
//! ```

#![forbid(unsafe_code)]
// What is kept must not hang on the platform: see clippy.toml. Tests may compare with its functions.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod json;
pub mod output;
pub mod reading;
pub mod records;
pub mod run;
pub mod stl;
pub mod terrain;
