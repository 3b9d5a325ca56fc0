//! Energies of a simulation.

/// Energies of a simulation \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy at the time of the positions.
    pub kinetic: f64,
    /// Strain energy.
    pub strain: f64,
    /// Energy that interactions store, such as the normal laws of contact.
    pub contact: f64,
    /// Energy that compressed pore water stores.
    pub water: f64,
    /// Work of gravity, loads, moving planes and whatever else has a prescribed velocity since the start.
    pub external_work: f64,
    /// Missing energy: that of the start plus external work less what is there now. It is the sum of the eight that
    /// follow.
    pub dissipated: f64,
    /// Energy taken by local, viscous and kinetic damping.
    pub damping: f64,
    /// Energy taken by friction, of contact.
    pub friction: f64,
    /// Energy that the same contacts took along their normals, where bodies meet: at a node they meet without bouncing.
    pub impact: f64,
    /// Plastic work, and whatever else laws dissipate.
    pub plastic: f64,
    /// Energy that left through absorbing planes.
    pub absorbed: f64,
    /// Energy that the drag between pore water and skeleton took.
    pub drag: f64,
    /// Energy that left with removed particles, with what had been dissipated in them.
    pub removed: f64,
    /// Energy that no channel accounts for; negative where energy came from nowhere.
    pub remainder: f64,
    /// Rest that returns to yield surfaces leave of the work of the strain of the particles that are there, stored and plastic work
    /// apart: see [`Law::algorithmic`](crate::laws::Law::algorithmic). It is no channel of its own: the remainder has it.
    pub algorithmic: f64,
}

/// Work of the strain of a body that yields, by its destination \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyEnergy {
    /// Energy that its stress stores.
    pub stored: f64,
    /// Plastic work, which never falls.
    pub plastic: f64,
    /// Rest of the finite step that is neither: see [`Law::algorithmic`](crate::laws::Law::algorithmic).
    pub algorithmic: f64,
}
