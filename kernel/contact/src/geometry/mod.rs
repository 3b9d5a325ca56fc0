//! Geometry of contact: boundaries of bodies with the points where two of them meet, and triangulated surfaces.

pub mod mortar;
pub mod surface;
