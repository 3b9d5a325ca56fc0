//! The problems of a scene: all of them at once, each with its path and, where it came from a file, its
//! place there.

use std::fmt;

/// Place in a text file, counted from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// File as the caller named it.
    pub file: String,
    /// Line.
    pub line: usize,
    /// Column in characters.
    pub column: usize,
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// One thing that is wrong with a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Key in the scene, such as `materials[0].young`; spelt as in the file where there is one.
    pub path: String,
    /// Value that was found.
    pub found: String,
    /// Values that would be accepted.
    pub accepted: String,
    /// Value that was probably meant, such as the nearest known key.
    pub hint: Option<String>,
    /// Place in the file; `None` for a scene that was not read from a file.
    pub location: Option<Location>,
}

impl Problem {
    /// A problem without hint and place.
    #[must_use]
    pub fn new(
        path: impl Into<String>,
        found: impl Into<String>,
        accepted: impl Into<String>,
    ) -> Self {
        Self {
            path: path.into(),
            found: found.into(),
            accepted: accepted.into(),
            hint: None,
            location: None,
        }
    }

    /// The same with a hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// The same with a place.
    #[must_use]
    pub fn at(mut self, location: Location) -> Self {
        self.location = Some(location);
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(location) = &self.location {
            write!(f, "{location}: ")?;
        }
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        write!(f, "found {}; accepted: {}", self.found, self.accepted)?;
        if let Some(hint) = &self.hint {
            write!(f, " ({hint})")?;
        }
        Ok(())
    }
}

/// A scene that cannot be run: everything that is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// At least one problem, in the order in which they were found.
    pub problems: Vec<Problem>,
}

impl SceneError {
    /// `Ok` if there is no problem.
    ///
    /// # Errors
    /// All the problems, if there is one.
    pub fn unless_empty(problems: Vec<Problem>) -> Result<(), Self> {
        if problems.is_empty() {
            Ok(())
        } else {
            Err(Self { problems })
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for SceneError {}
