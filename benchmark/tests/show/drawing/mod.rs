//! Drawings of lines, text and pixels.

mod letters;
mod pixels;
