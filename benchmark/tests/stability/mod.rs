//! Stability: the stiff and extreme scenes.

mod extreme;
