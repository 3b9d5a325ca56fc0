//! Mortar contact: boundaries, weights, projection, laws and forces against geometry and balance; the modules mirror
//! `src/mortar`.

mod bound;
mod boundary;
mod broad;
mod law;
mod motion;
mod outline;
mod overlap;
mod pair;
mod segments;
mod sites;
mod space;
mod support;
mod tie;
mod weights;
