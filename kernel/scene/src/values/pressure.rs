//! Pore pressures that are given: at the start, and held.

use proctor_kernel::model::Vector;

/// Pore pressure at the start of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InitialPressure {
    /// Pressure of all particles of a material, by its identifier \[Pa\].
    Material {
        /// Identifier.
        id: i64,
        /// Pressure \[Pa\].
        pressure: f64,
    },
    /// Pressure of water at rest below a level, in all particles; none above it.
    Table {
        /// Coordinate of the level along the axis of gravity \[m\].
        level: f64,
    },
    /// Pressure of particles whose centres lie in a box \[Pa\].
    Box {
        /// Lower corner \[m\].
        p1: Vector,
        /// Upper corner \[m\].
        p2: Vector,
        /// Pressure \[Pa\].
        pressure: f64,
    },
}

/// Pore pressure that the particles whose centres lie in a box at the start keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldPressure {
    /// Lower corner \[m\].
    pub p1: Vector,
    /// Upper corner \[m\].
    pub p2: Vector,
    /// Pressure \[Pa\].
    pub pressure: f64,
}
