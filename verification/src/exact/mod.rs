//! Closed-form solutions as plain functions of position and time, and finite elements of our own where there are none.
//!
//! Nothing here knows the kernel: the references must not share a line of code with what they judge.

pub mod axis_aligned_mms;
pub mod bar;
pub mod bar_impact;
pub mod base_column;
pub mod bearing;
pub mod boussinesq_box;
pub mod boussinesq_half_space;
pub mod cam_clay;
pub mod cantilever;
pub mod channel;
pub mod consolidation;
pub mod disk_impact;
pub mod elastic_block;
pub mod fe;
pub mod half_space;
pub mod hertz;
pub mod hertz_layer;
pub mod hertz_sphere;
pub mod homogeneous;
pub mod indented_block;
pub mod jet;
pub mod material_point;
pub mod objective_rate;
pub mod plastic_wave;
pub mod ring_impact;
pub mod rolling_creep;
pub mod rolling_disk;
pub mod rotation;
pub mod seepage_slope;
pub mod self_weight;
pub mod sliding;
pub mod softening_bar;
pub mod sound;
pub mod special;
pub mod step_bar;
pub mod sudden_weight;
pub mod thick_wall;
pub mod turned;
pub mod two_phase_column;
pub mod two_slopes;
pub mod vortex;
pub mod yielding_column;
