//! Exact solutions against tables, limits and their own differential equations; the modules mirror `src/exact`.

#[path = "exact/axis_aligned_mms.rs"]
mod axis_aligned_mms;
#[path = "exact/bar.rs"]
mod bar;
#[path = "exact/bar_impact.rs"]
mod bar_impact;
#[path = "exact/base_column.rs"]
mod base_column;
#[path = "exact/bearing.rs"]
mod bearing;
#[path = "exact/boussinesq_box.rs"]
mod boussinesq_box;
#[path = "exact/boussinesq_half_space.rs"]
mod boussinesq_half_space;
#[path = "exact/cantilever.rs"]
mod cantilever;
#[path = "exact/channel.rs"]
mod channel;
#[path = "exact/elastic_block.rs"]
mod elastic_block;
#[path = "exact/fe.rs"]
mod fe;
#[path = "exact/hertz.rs"]
mod hertz;
#[path = "exact/hertz_layer.rs"]
mod hertz_layer;
#[path = "exact/hertz_sphere.rs"]
mod hertz_sphere;
#[path = "exact/homogeneous.rs"]
mod homogeneous;
#[path = "exact/indented_block.rs"]
mod indented_block;
#[path = "exact/jet.rs"]
mod jet;
#[path = "exact/material_point.rs"]
mod material_point;
#[path = "exact/objective_rate.rs"]
mod objective_rate;
#[path = "exact/plastic_wave.rs"]
mod plastic_wave;
#[path = "exact/ring_impact.rs"]
mod ring_impact;
#[path = "exact/rolling_creep.rs"]
mod rolling_creep;
#[path = "exact/rolling_disk.rs"]
mod rolling_disk;
#[path = "exact/rotation.rs"]
mod rotation;
#[path = "exact/self_weight.rs"]
mod self_weight;
#[path = "exact/sliding.rs"]
mod sliding;
#[path = "exact/softening_bar.rs"]
mod softening_bar;
#[path = "exact/sound.rs"]
mod sound;
#[path = "exact/special.rs"]
mod special;
#[path = "exact/step_bar.rs"]
mod step_bar;
#[path = "exact/sudden_weight.rs"]
mod sudden_weight;
#[path = "exact/turned.rs"]
mod turned;
#[path = "exact/two_slopes.rs"]
mod two_slopes;
#[path = "exact/vortex.rs"]
mod vortex;
#[path = "exact/yielding_column.rs"]
mod yielding_column;
