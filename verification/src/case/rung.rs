//! A rung: one run of a case, by its label, its variant, its cell size and the parameters that the case gave it.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// One run of a case: a resolution of a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Name in tables and messages; unique within a case and size.
    pub label: String,
    /// Cell size h \[m\].
    pub cell: f64,
    /// The problem of the case that is solved; a word of the case's own.
    pub variant: &'static str,
    /// Parameters of the problem.
    problem: Problem,
}

/// Parameters of a rung, of a type of its case's own; label and variant tell rungs apart without them.
#[derive(Clone)]
struct Problem(Arc<dyn Any + Send + Sync>);

impl PartialEq for Problem {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("..")
    }
}

impl Rung {
    /// A rung by its label, its variant and its cell size \[m\].
    #[must_use]
    pub fn labelled(label: String, variant: &'static str, cell: f64) -> Self {
        Self {
            label,
            cell,
            variant,
            problem: Problem(Arc::new(())),
        }
    }

    /// The same with parameters of a type of the case's own.
    #[must_use]
    pub fn with<P: Any + Send + Sync>(mut self, problem: P) -> Self {
        self.problem = Problem(Arc::new(problem));
        self
    }

    /// The same cell of another variant.
    #[must_use]
    pub fn as_variant(&self, variant: &'static str) -> Self {
        Self {
            variant,
            ..self.clone()
        }
    }

    /// The parameters that it was given.
    ///
    /// # Panics
    /// If it was given none of that type: the rung of another case.
    #[must_use]
    pub fn problem<P: Any>(&self) -> &P {
        let known = self.problem.0.downcast_ref();
        known.unwrap_or_else(|| panic!("{} is a rung of another case", self.label))
    }

    /// The rungs of a variant with so many cells over a length \[m\], which labels call `word`.
    #[must_use]
    pub fn counted(variant: &'static str, word: &str, length: f64, counts: &[u32]) -> Vec<Self> {
        let of = |&count: &u32| {
            let cell = length / f64::from(count);
            Self::labelled(format!("{word}={count}"), variant, cell)
        };
        counts.iter().map(of).collect()
    }

    /// The rungs of several problems, each with so many cells over a length \[m\]; labels have the name of the problem first.
    #[must_use]
    pub fn of_problems<P: Any + Copy + Send + Sync>(
        problems: &[P],
        name: fn(&P) -> &'static str,
        word: &str,
        length: f64,
        counts: impl Fn(&P) -> &'static [u32],
    ) -> Vec<Self> {
        let of = |problem: &P| {
            let word = format!("{}, {word}", name(problem));
            let rungs = Self::counted(name(problem), &word, length, counts(problem));
            let problem = *problem;
            rungs.into_iter().map(move |rung| rung.with(problem))
        };
        problems.iter().flat_map(of).collect()
    }

    /// A cell size \[m\] of a variant.
    #[must_use]
    pub fn new(variant: &'static str, cell: f64) -> Self {
        Self::labelled(format!("{variant} h={cell}"), variant, cell)
    }

    /// The rungs of several ladders, each a variant with its cell sizes \[m\].
    #[must_use]
    pub fn ladders(ladders: &[(&'static str, &[f64])]) -> Vec<Self> {
        ladders
            .iter()
            .flat_map(|&(variant, cells)| cells.iter().map(move |&cell| Self::new(variant, cell)))
            .collect()
    }
}
