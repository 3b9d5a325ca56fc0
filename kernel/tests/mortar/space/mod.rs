//! The same in three dimensions; the modules mirror `contact/src/geometry/mortar/space`.

mod clip;
mod facets;
mod nodes;
mod pair;
mod projection;
mod refine;
mod ridges;
mod skin;
mod slab;
pub mod support;
