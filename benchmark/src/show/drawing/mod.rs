//! Drawings of lines, rectangles and text around an image of pixels, as PNG or as SVG.
//!
//! Both forms come from one list of items, so that they show the same. The image holds particles, which are too many for one element
//! each.

pub mod letters;
mod pixels;
mod svg;

pub use letters::{TextSize, width};
pub use pixels::{Pixels, animation, png};
pub use svg::svg;

/// A colour as red, green and blue.
pub type Rgb = [u8; 3];

/// Colour of text and axes.
pub const INK: Rgb = [27, 31, 36];
/// Colour of grid lines.
pub const GRID: Rgb = [213, 217, 222];
/// Colour of paper.
pub const PAPER: Rgb = [255, 255, 255];

/// A drawing, its places in pixels from the upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Width and height.
    pub size: [usize; 2],
    /// Words for screen readers.
    pub title: String,
    /// Items behind the image.
    pub behind: Vec<Item>,
    /// The image, as large as the drawing.
    pub pixels: Pixels,
    /// Items before it.
    pub before: Vec<Item>,
}

/// An element of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A straight line.
    Line {
        /// First end.
        from: [f64; 2],
        /// Last end.
        to: [f64; 2],
        /// Colour.
        colour: Rgb,
        /// Width.
        width: f64,
    },
    /// A filled rectangle.
    Rectangle {
        /// Upper left corner.
        corner: [f64; 2],
        /// Width and height.
        size: [f64; 2],
        /// Colour.
        colour: Rgb,
    },
    /// A text.
    Text {
        /// The words.
        text: String,
        /// Place of the letters: a point of the base line.
        at: [f64; 2],
        /// The part of the text that is there.
        anchor: Anchor,
        /// Size of the letters.
        size: TextSize,
    },
}

/// The part of a text that lies at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

impl Anchor {
    /// The left end of a text of so many pixels.
    fn left(self, at: f64, width: f64) -> f64 {
        match self {
            Self::Start => at,
            Self::Middle => at - 0.5 * width,
            Self::End => at - width,
        }
    }
}
