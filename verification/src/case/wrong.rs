//! Wrong references: numbers of a reference that are off, to prove that the gates of a case notice.

use super::Rung;

/// A number of the reference, or of the scene, that is wrong, and the gates that must fail then.
#[derive(Clone, Copy, Debug)]
pub struct Wrong {
    /// The number, in a word.
    pub name: &'static str,
    /// The correct value.
    pub correct: f64,
    /// The wrong value.
    pub wrong: f64,
    /// True for the name of a gate that must fail.
    breaks: fn(&str) -> bool,
    /// True for the name of another gate that must hold.
    spares: fn(&str) -> bool,
    /// The rungs that show it, where a rung must be run again for it.
    on: fn(&Rung) -> bool,
}

impl Wrong {
    /// A factor on a number, which breaks every gate.
    #[must_use]
    pub const fn factor(name: &'static str, factor: f64) -> Self {
        Self::value(name, 1.0, factor)
    }

    /// A wrong value in place of the correct one, which breaks every gate.
    #[must_use]
    pub const fn value(name: &'static str, correct: f64, wrong: f64) -> Self {
        Self {
            name,
            correct,
            wrong,
            breaks: |_| true,
            spares: |_| false,
            on: |_| true,
        }
    }

    /// The same, which must break certain gates, by their names.
    #[must_use]
    pub const fn breaks(mut self, gates: fn(&str) -> bool) -> Self {
        self.breaks = gates;
        self
    }

    /// This wrong reference, which must break certain gates and no other.
    #[must_use]
    pub const fn breaks_only(mut self, gates: fn(&str) -> bool) -> Self {
        self.breaks = gates;
        self.spares = |_| true;
        self
    }

    /// The same, which must leave alone certain gates of those that it need not break.
    #[must_use]
    pub const fn spares(mut self, gates: fn(&str) -> bool) -> Self {
        self.spares = gates;
        self
    }

    /// The same, shown by certain rungs alone.
    #[must_use]
    pub const fn on(mut self, rungs: fn(&Rung) -> bool) -> Self {
        self.on = rungs;
        self
    }

    /// True for a rung that shows it.
    #[must_use]
    pub fn is_shown_by(&self, rung: &Rung) -> bool {
        (self.on)(rung)
    }

    /// True for the name of a gate that must fail, false for one that must hold; `None` where either is right.
    #[must_use]
    pub fn must_fail(&self, gate: &str) -> Option<bool> {
        let fails = (self.breaks)(gate);
        (fails || (self.spares)(gate)).then_some(fails)
    }
}

/// The reference of a run: the correct one, or one with a wrong number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reference(Option<Wrong>);

impl Reference {
    /// The correct one.
    pub const CORRECT: Self = Self(None);

    /// The one with a wrong number.
    #[must_use]
    pub const fn with(wrong: Wrong) -> Self {
        Self(Some(wrong))
    }

    /// True where no number of it is wrong.
    #[must_use]
    pub fn is_correct(self) -> bool {
        self.0.is_none()
    }

    /// A number of it: the correct value unless it is the wrong one.
    #[must_use]
    pub fn of(self, number: &Wrong) -> f64 {
        match self.0 {
            Some(wrong) if wrong.name == number.name => wrong.wrong,
            _ => number.correct,
        }
    }
}
