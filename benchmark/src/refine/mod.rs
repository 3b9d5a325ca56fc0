//! Error bars of a user's scene, from runs on several meshes.

pub mod ladders;
