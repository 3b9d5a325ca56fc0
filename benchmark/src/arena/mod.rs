//! The arena: several solvers on all open cases, each whole process measured and each error judged by the exact solution.
//!
//! [`run`] measures and writes rows of a record; [`Board`] reads them back, so that tables, picture and page show the same.

mod board;
mod run;
pub mod speed;

pub use board::{Board, Cell, Mesh, Solver};
pub use run::{METHODS, Problem, Solvers, Start, open, run};
