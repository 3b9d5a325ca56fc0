//! Results to be written.

use proctor_kernel::model::Vector;

/// What is written, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// Number of equal time intervals at whose ends frames and history rows are written, besides the
    /// initial state. 0: nothing but the summary.
    pub print: usize,
    /// Particle fields in the frames.
    pub fields: Vec<Field>,
    /// Nodal fields in the grid frames; none: no grid frames.
    pub nodal_fields: Vec<NodalField>,
    /// Write a checkpoint with each frame (the last one is kept).
    pub checkpoint: bool,
}

/// A particle field that frames can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// Particle identifier.
    Id,
    /// Material identifier.
    Material,
    /// Body identifier.
    Body,
    /// 1 for every particle that is written.
    Active,
    /// Mass \[kg\].
    Mass,
    /// Volume \[m³\].
    Volume,
    /// Mass density \[kg/m³\].
    Density,
    /// Displacement since the start \[m\].
    Displacement,
    /// Velocity \[m/s\].
    Velocity,
    /// Cauchy stress \[Pa\], six components.
    Stress,
    /// Mean pressure -tr(sigma)/3 \[Pa\].
    Pressure,
    /// Deformation gradient, nine components; only where the plan keeps it.
    DeformationGradient,
    /// External force on the particle \[N\]: weight and box loads.
    ExternalForce,
    /// Internal variables of the laws, each by its name; not a number where the law of a particle has no such variable.
    InternalVariables,
}

/// A nodal field that grid frames can hold. A node has one point for each velocity field that has mass there: one for
/// all bodies that are not near a partner of contact, and one for each body that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NodalField {
    /// Mass \[kg\].
    Mass,
    /// Velocity half a step before the time of the frame \[m/s\].
    Velocity,
    /// Body identifier, of the velocity fields that belong to one body; the smallest integer for the common field.
    Body,
    /// Contact force on the body \[N\].
    ContactForce,
    /// Distance to the nearest partner less the distance at which contact acts \[m\]; not a number where no partner
    /// is near.
    ContactGap,
}

impl NodalField {
    /// Every field, in the order in which frames hold them.
    pub const ALL: [Self; 5] = [
        Self::Mass,
        Self::Velocity,
        Self::Body,
        Self::ContactForce,
        Self::ContactGap,
    ];
}

/// A particle whose state is written to `history.csv`.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Prefix of the columns.
    pub name: String,
    /// The particle nearest to this position at the start is followed \[m\].
    pub position: Vector,
}

impl Results {
    /// Most outputs: the names of frames have six digits.
    pub const MOST: usize = 999_999;
}

impl Default for Results {
    /// Ten outputs with identifier and displacement, as the manuals' program does, and a checkpoint with each frame.
    fn default() -> Self {
        Self {
            print: 10,
            fields: vec![Field::Id, Field::Displacement],
            nodal_fields: vec![],
            checkpoint: true,
        }
    }
}

impl Field {
    /// Every field, in the order in which frames hold them.
    pub const ALL: [Self; 14] = [
        Self::Id,
        Self::Material,
        Self::Body,
        Self::Active,
        Self::Mass,
        Self::Volume,
        Self::Density,
        Self::Displacement,
        Self::Velocity,
        Self::Stress,
        Self::Pressure,
        Self::DeformationGradient,
        Self::ExternalForce,
        Self::InternalVariables,
    ];
}
