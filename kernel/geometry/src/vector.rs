//! Vectors of space.

/// A vector in SI units, in axis order x, y, z. In two dimensions the third component is zero.
pub type Vector = [f64; 3];
