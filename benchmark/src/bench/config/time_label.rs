//! The meaning of the time of a frame.

/// Meaning of a solver's time label of a frame for the particles in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeLabel {
    /// The time of the particles.
    #[default]
    Frame,
    /// The particles are one step further than the label says.
    OneStepLate,
    /// The particles are one step behind the label.
    OneStepEarly,
}

impl TimeLabel {
    /// All of them, by their words in a configuration.
    pub const ALL: [(&str, Self); 3] = [
        ("frame", Self::Frame),
        ("one step late", Self::OneStepLate),
        ("one step early", Self::OneStepEarly),
    ];

    /// Steps by which the particles are ahead of the label.
    #[must_use]
    pub fn ahead(self) -> f64 {
        match self {
            Self::Frame => 0.0,
            Self::OneStepLate => 1.0,
            Self::OneStepEarly => -1.0,
        }
    }

    /// Its word in a configuration.
    #[must_use]
    pub fn word(self) -> &'static str {
        let own = Self::ALL.iter().find(|(_, label)| *label == self);
        own.map_or("frame", |(word, _)| word)
    }
}
