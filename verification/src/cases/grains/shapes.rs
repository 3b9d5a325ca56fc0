//! Outlines of the grains.

use super::PART;
use crate::cases::prelude::*;
use crate::random::Random;

const SEED: u64 = 2024; // Seed of the shapes
/// Half the extents of a grain \[m\].
const HALF: [f64; 2] = [1.06, 1.29];
const POINTS: usize = 88; // Points around a grain
/// Largest amplitudes of the waves with 2, 3 and 4 periods over the radius. A wave of k periods makes a circle concave
/// above 1/(k² + 1).
const WAVES: [f64; 3] = [0.1, 0.15, 0.06];

/// Outlines of the grains, counter-clockwise, row by row from the bottom; `side` grains per row and as many rows.
#[must_use]
pub fn outlines(side: usize) -> Vec<Vec<[f64; 2]>> {
    let mut random = Random::new(SEED);
    (0..side * side)
        .map(|grain| {
            let waves = WAVES.map(|most| (most * random.unit(), TAU * random.unit()));
            let around = (0..POINTS).map(|k| {
                let angle = TAU * k as f64 / POINTS as f64;
                let wave = |(i, (a, phase)): (usize, &(f64, f64))| {
                    a * libm::cos((i + 2) as f64 * angle + phase)
                };
                let r = 1.0 + waves.iter().enumerate().map(wave).sum::<f64>();
                [r * libm::cos(angle), r * libm::sin(angle)]
            });
            let points: Vec<[f64; 2]> = around.collect();
            let place = [grain % side, grain / side];
            let scale: [(f64, f64); 2] = std::array::from_fn(|axis| {
                let range = points.iter().fold((f64::MAX, f64::MIN), |(low, high), p| {
                    (low.min(p[axis]), high.max(p[axis]))
                });
                let factor = 2.0 * HALF[axis] / (range.1 - range.0);
                let middle = 0.5 * (range.0 + range.1);
                let center = (place[axis] as f64 + 0.5) * PART[axis];
                (factor, center - factor * middle)
            });
            let placed = points
                .iter()
                .map(|p| std::array::from_fn(|axis| scale[axis].0 * p[axis] + scale[axis].1));
            placed.collect()
        })
        .collect()
}
