//! Axes and text of charts; whole charts have their tests in `figures`.

mod axis;
mod text;
