//! Time of a simulation, and a step that it took.

/// Time and step counter of a simulation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Steps done.
    pub step: u64,
    /// Time of positions and stresses \[s\].
    pub time: f64,
    /// Last time step \[s\]; 0 at the start and after velocities were reset, when they are at `time`.
    pub dt_before: f64,
    /// Smallest step so far \[s\].
    pub dt_min: f64,
    /// Largest step so far \[s\].
    pub dt_max: f64,
    /// Smallest critical step so far \[s\].
    pub dt_critical: f64,
}

/// Rule that decided the time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// The stability bound of the scheme, C min(h)/(c + |v|).
    Stability,
    /// No particle crosses more than half a cell.
    Travel,
    /// The multiplier of the scene.
    Multiplier,
    /// The stiffness of contact.
    Contact,
    /// No gap of contact closes further than it may in a step.
    Closing,
    /// Viscous or local damping, beside the stability bound of the scheme or of contact.
    Damping,
    /// The viscosity of a material, beside the stability bound of the scheme.
    Viscosity,
    /// The scene's constant step.
    Fixed,
    /// Equal steps up to a time at which something is written.
    OutputTime,
}

/// A successful step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepInfo {
    /// Number of the step, from 1.
    pub step: u64,
    /// Time reached \[s\].
    pub time: f64,
    /// Time step \[s\].
    pub dt: f64,
    /// Critical time step \[s\].
    pub dt_critical: f64,
    /// Rule that decided the time step.
    pub bound: Bound,
    /// Kinetic energy at the nodes \[J\] and norm of the unbalanced nodal forces \[N\], where measured.
    pub measured: Option<(f64, f64)>,
    /// Number of nodes at which a contact force acts.
    pub contact_nodes: usize,
}

/// The displacement increment of a step.
#[derive(Clone, Copy, Debug)]
pub struct Drift {
    /// Time over which positions move \[s\].
    pub time: f64,
    /// Displacement increment of the mesh, to which positions are relative \[m\].
    pub mesh_shift: [f64; 3],
    /// True if velocities are set to zero after it.
    pub reset: bool,
}
