//! Lines and slopes of charts; whole charts have their tests in `figures`.

mod runs;
mod slopes;
