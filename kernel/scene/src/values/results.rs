//! Results to be written.

use proctor_kernel::model::Vector;

/// Results that are written, and their interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    /// Number of equal time intervals at whose ends frames and history rows are written, besides the
    /// initial state. 0: no frames.
    pub print: usize,
    /// Interval of the rows of `history.csv` \[s\]: a row holds the state of the step nearest to a multiple of it, and no step is
    /// cut for it. `None`: a row with each frame.
    pub history_interval: Option<f64>,
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

/// Columns of `history.csv` that follow particles or a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Prefix of the columns.
    pub name: String,
    /// The particles whose values are written.
    pub target: ProbeTarget,
}

/// The particles that a probe follows.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbeTarget {
    /// The particle nearest to this position at the start \[m\].
    Point(Vector),
    /// The particles nearest to evenly spaced points of a line at the start, its ends included.
    Line {
        /// First point \[m\].
        from: Vector,
        /// Last point \[m\].
        to: Vector,
        /// Number of points, 2 or more.
        count: usize,
    },
    /// All particles of the body with this identifier: means of displacement and velocity by mass, of the stress by volume.
    Body(i64),
    /// The particle of a body with the largest value.
    Largest {
        /// Identifier of the body.
        body: i64,
        /// The value.
        quantity: ProbedQuantity,
    },
}

/// A value of a particle whose largest one a probe writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProbedQuantity {
    /// Length of the displacement \[m\].
    Displacement,
    /// Length of the velocity \[m/s\].
    Velocity,
    /// Equivalent stress of von Mises \[Pa\].
    MisesStress,
    /// Mean pressure \[Pa\].
    Pressure,
    /// Plastic strain of the law.
    PlasticStrain,
}

impl ProbedQuantity {
    /// Name of the internal variable that holds the plastic strain.
    pub const PLASTIC_STRAIN: &str = "plastic strain";

    /// Every quantity with its word, which is also the end of its column.
    pub const WORDS: &[(&str, Self)] = &[
        ("displacement", Self::Displacement),
        ("velocity", Self::Velocity),
        ("mises_stress", Self::MisesStress),
        ("pressure", Self::Pressure),
        ("plastic_strain", Self::PlasticStrain),
    ];

    /// Its word.
    #[must_use]
    pub fn word(self) -> &'static str {
        let found = Self::WORDS.iter().find(|(_, quantity)| *quantity == self);
        found.map_or("", |(word, _)| word)
    }
}

impl Probe {
    /// Most points of a line.
    pub const MOST: usize = 1000;

    /// A probe of the particle nearest to a position at the start \[m\].
    #[must_use]
    pub fn at(name: impl Into<String>, position: Vector) -> Self {
        Self {
            name: name.into(),
            target: ProbeTarget::Point(position),
        }
    }

    /// The points that it follows, each with the prefix of its columns; none where it follows a body. Those of a line have the
    /// name of the probe and a number from 1.
    #[must_use]
    pub fn points(&self) -> Vec<(String, Vector)> {
        match &self.target {
            ProbeTarget::Point(position) => vec![(self.name.clone(), *position)],
            ProbeTarget::Line { from, to, count } => (0..*count)
                .map(|i| {
                    let share = i as f64 / (count - 1).max(1) as f64;
                    let at = |axis: usize| from[axis] + share * (to[axis] - from[axis]);
                    (format!("{}_{}", self.name, i + 1), std::array::from_fn(at))
                })
                .collect(),
            ProbeTarget::Body(_) | ProbeTarget::Largest { .. } => vec![],
        }
    }

    /// Prefixes of its columns.
    #[must_use]
    pub fn prefixes(&self) -> Vec<String> {
        match self.target {
            ProbeTarget::Line { .. } => self.points().into_iter().map(|(name, _)| name).collect(),
            _ => vec![self.name.clone()],
        }
    }
}

impl Results {
    /// Most outputs: the names of frames have six digits.
    pub const MOST: usize = 999_999;

    /// Results of which nothing is written.
    pub const NONE: Self = Self {
        print: 0,
        history_interval: None,
        fields: Vec::new(),
        nodal_fields: Vec::new(),
        checkpoint: false,
    };

    /// True where `history.csv` is written.
    #[must_use]
    pub fn writes_history(&self) -> bool {
        self.print > 0 || self.history_interval.is_some()
    }
}

impl Default for Results {
    /// Ten outputs with identifier and displacement, as the manuals' program does, and a checkpoint with each frame.
    fn default() -> Self {
        Self {
            print: 10,
            history_interval: None,
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
