//! Ladders: the runs of a case in short and in full, variant by variant, each coarse to fine.

use super::{Rung, Size};

/// The rungs of each size.
#[derive(Clone, Copy)]
pub struct Ladder(Form);

#[derive(Clone, Copy)]
enum Form {
    /// Numbers of cells along a length \[m\], the same of all variants; short and full.
    Cells {
        variants: Variants,
        /// Between the variant and the word in a label; `None` where the label does without the variant.
        joint: Option<&'static str>,
        word: &'static str,
        length: f64,
        counts: [&'static [u32]; 2],
    },
    /// Cell sizes of variants \[m\]; short and full.
    Sizes([&'static [(&'static str, &'static [f64])]; 2]),
    /// Rungs that a case makes itself.
    Made(fn(Size) -> Vec<Rung>),
}

#[derive(Clone, Copy)]
enum Variants {
    One(&'static str),
    Several(&'static [&'static str]),
}

impl Ladder {
    /// No rung.
    pub const NONE: Self = Self(Form::Sizes([&[], &[]]));

    /// Numbers of cells along a length \[m\] that labels call `word`, of the one variant: `L/h=8`.
    #[must_use]
    pub const fn cells(
        variant: &'static str,
        word: &'static str,
        length: f64,
        short: &'static [u32],
        full: &'static [u32],
    ) -> Self {
        Self(Form::Cells {
            variants: Variants::One(variant),
            joint: None,
            word,
            length,
            counts: [short, full],
        })
    }

    /// The same of several variants, whose names labels have first, then the joint: `small L/h=8`.
    #[must_use]
    pub const fn variants(
        variants: &'static [&'static str],
        joint: &'static str,
        word: &'static str,
        length: f64,
        counts: [&'static [u32]; 2],
    ) -> Self {
        Self(Form::Cells {
            variants: Variants::Several(variants),
            joint: Some(joint),
            word,
            length,
            counts,
        })
    }

    /// Cell sizes \[m\] of variants: `hertz h=0.2`.
    #[must_use]
    pub const fn sizes(
        short: &'static [(&'static str, &'static [f64])],
        full: &'static [(&'static str, &'static [f64])],
    ) -> Self {
        Self(Form::Sizes([short, full]))
    }

    /// Rungs that the case makes itself, of each size.
    #[must_use]
    pub const fn made(rungs: fn(Size) -> Vec<Rung>) -> Self {
        Self(Form::Made(rungs))
    }

    /// The rungs of a size.
    #[must_use]
    pub fn rungs(&self, size: Size) -> Vec<Rung> {
        match self.0 {
            Form::Cells {
                variants,
                joint,
                word,
                length,
                counts,
            } => match &variants {
                Variants::One(one) => std::slice::from_ref(one),
                Variants::Several(several) => several,
            }
            .iter()
            .flat_map(|variant| {
                let word = joint.map_or_else(
                    || word.to_owned(),
                    |joint| format!("{variant}{joint}{word}"),
                );
                Rung::counted(variant, &word, length, counts[size as usize])
            })
            .collect(),
            Form::Sizes(ladders) => Rung::ladders(ladders[size as usize]),
            Form::Made(rungs) => rungs(size),
        }
    }
}
