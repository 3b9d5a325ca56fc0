//! Error bars of a user's scene: runs on several meshes, their quantities, and what is kept and shown of them.

pub mod dense;
pub mod extent;
pub mod judge;
pub(crate) mod kept;
pub mod ladders;
pub mod methods;
pub mod place;
pub mod quantity;
pub mod rows;
pub mod run;
mod stages;
pub mod work;
