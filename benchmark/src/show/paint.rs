//! Colour on a terminal, and a symbol beside every colour.

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};

/// Meaning of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// It holds.
    Held,
    /// It does not.
    Failed,
    /// Something to know, or work that was not finished.
    Attention,
}

impl Mark {
    /// Text for it without colour.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Held => "✓",
            Self::Failed => "✗",
            Self::Attention => "!",
        }
    }

    fn style(self) -> Style {
        let colour = match self {
            Self::Held => AnsiColor::Green,
            Self::Failed => AnsiColor::Red,
            Self::Attention => AnsiColor::Yellow,
        };
        colour.on_default().bold()
    }
}

/// Choice of colour for printed text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    /// True for colour.
    pub colour: bool,
}

impl Paint {
    /// No colour.
    pub const NONE: Self = Self { colour: false };

    /// Paint as standard output takes it: colour on a terminal, unless `NO_COLOR` is set or `TERM` says that it has none, and
    /// elsewhere where `CLICOLOR_FORCE` asks for it.
    #[must_use]
    pub fn of_standard_output() -> Self {
        Self {
            colour: AutoStream::choice(&std::io::stdout()) != ColorChoice::Never,
        }
    }

    /// Text in the colour of a mark.
    #[must_use]
    pub fn text(self, mark: Mark, text: &str) -> String {
        if self.colour {
            let style = mark.style();
            format!("{style}{text}{style:#}")
        } else {
            text.to_owned()
        }
    }

    /// The symbol of a mark, one character wide.
    #[must_use]
    pub fn symbol(self, mark: Mark) -> String {
        self.text(mark, mark.symbol())
    }
}
