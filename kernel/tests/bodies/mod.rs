//! Bodies: counts, positions and volumes of the particles of every shape, against counts by hand, formulae
//! and a search of all sub-cells with the definition of the shape.

mod cuboid;
mod errors;
mod list;
mod polygon;
mod round;
mod shape;
mod support;
