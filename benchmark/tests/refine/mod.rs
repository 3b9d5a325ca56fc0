//! Error bars of a scene of a user: methods, quantities, extents, histories.

mod dense;
mod extent;
mod methods;
mod quantity;
