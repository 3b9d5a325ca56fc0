//! What simulations do: vibrate, settle, fall, push, break; and what they refuse.

#[path = "../common/mod.rs"]
mod common;

mod balance;
mod bar;
mod beside;
mod books;
mod carried;
mod caution;
mod contact;
mod contact_normals;
mod contact_symmetry;
mod crowd;
mod damping;
mod dilation;
mod dimension;
mod driven;
mod driven_shapes;
mod faults;
mod fluids;
mod hencky;
mod initial_stress;
mod left_behind;
mod limits;
mod loads;
mod mortar;
mod mortar_drift;
mod mortar_layer;
mod mortar_limits;
mod mortar_space;
mod moving_base;
mod own_law;
mod parted;
mod planes;
mod reach;
mod rotation;
mod stages;
mod start;
mod trust;
mod tunnelling;
