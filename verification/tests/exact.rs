//! Exact solutions against tables, limits and their own differential equations; the modules mirror `src/exact`.

mod axis_aligned_mms;
mod bar;
mod bar_impact;
mod base_column;
mod bearing;
mod boussinesq_box;
mod boussinesq_half_space;
mod breathing;
mod cam_clay;
mod cantilever;
mod cavity;
mod channel;
mod consolidation;
mod elastic_block;
mod fe;
mod half_space;
mod hertz;
mod hertz_layer;
mod hertz_sphere;
mod homogeneous;
mod indented_block;
mod jet;
mod lysmer;
mod material_point;
mod objective_rate;
mod plastic_wave;
mod revolved_mms;
mod ring_impact;
mod rolling_creep;
mod rolling_disk;
mod rotation;
mod seepage_slope;
mod self_weight;
mod sliding;
mod softening_bar;
mod sound;
mod special;
mod squeezed_layer;
mod step_bar;
mod sudden_weight;
mod swirl;
mod thick_wall;
mod turned;
mod two_phase_column;
mod two_slopes;
mod vortex;
mod wavy_layer;
mod yielding_column;
mod yielding_wall;

/// Derivative by central differences of fourth order.
fn derivative(f: impl Fn(f64) -> f64, h: f64) -> f64 {
    (f(-2.0 * h) - 8.0 * f(-h) + 8.0 * f(h) - f(2.0 * h)) / (12.0 * h)
}
