//! Properties of every scene, whatever the weighting function, the scheme and the dimension.

mod bits;
mod conditions;
mod conservation;
mod contact;
mod contact_bits;
mod far_origin;
mod handles;
mod histories;
mod interactions;
mod least_squares;
mod mapping;
mod mortar_work;
mod motion;
mod oblong;
mod rehearsal;
mod round_off;
mod saved;
mod scaling;
mod separation;
mod slabs;
mod sorting;
mod sums;
mod symmetry;
mod touching;
mod weights;
