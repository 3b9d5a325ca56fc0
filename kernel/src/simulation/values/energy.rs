//! Energies of a simulation.

/// Energies of a simulation \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy at the time of the positions.
    pub kinetic: f64,
    /// Strain energy.
    pub strain: f64,
    /// What interactions store, such as the normal laws of mortar contact.
    pub contact: f64,
    /// Work of gravity, loads, moving planes and whatever else has a prescribed velocity since the start.
    pub external_work: f64,
    /// What is missing: the energy of the start plus external work less what is there now. It is the sum of the six that
    /// follow.
    pub dissipated: f64,
    /// What local, viscous and kinetic damping took.
    pub damping: f64,
    /// What friction took, of contact on the grid and of rigid surfaces.
    pub friction: f64,
    /// What the same contacts took along their normals, where bodies meet: at a node they meet without bouncing.
    pub impact: f64,
    /// Plastic work, and whatever else laws dissipate.
    pub plastic: f64,
    /// What removed particles took along, and what had been dissipated in them.
    pub removed: f64,
    /// What no channel accounts for; negative where energy came from nowhere.
    pub remainder: f64,
    /// What returns to yield surfaces leave of the work of the strain of the particles that are there, stored and plastic work
    /// apart: see [`Law::algorithmic`](crate::laws::Law::algorithmic). It is no channel of its own: the remainder has it.
    pub algorithmic: f64,
}

/// Where the work of the strain of a body that yields went \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyEnergy {
    /// What its stress stores.
    pub stored: f64,
    /// Plastic work, which never falls.
    pub plastic: f64,
    /// What the finite step leaves of neither: see [`Law::algorithmic`](crate::laws::Law::algorithmic).
    pub algorithmic: f64,
}
