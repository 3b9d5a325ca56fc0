//! Drag between water and skeleton that move past each other.

use super::support::{GRAVITY, column, strip, water};
use crate::common::{body, simulation};
use proctor_scene::{ParticleSeed, PlaneCondition, Shape, StressScheme};
use std::sync::Arc;

const POROSITY: f64 = 0.4;
const CONDUCTIVITY: f64 = 1e-2; // [m/s]
const H: f64 = 0.125; // Edge of a cell [m]

/// A block whose water flows along a shut plane past its skeleton slows down by drag alone, everywhere alike: each step divides
/// the difference of both velocities by 1 + dt B (1/`m_s` + 1/`m_w`). Domains of the lowest particles reach beyond the plane,
/// and what they give to nodes there is folded with its drag.
#[test]
fn drag_along_a_shut_plane_is_the_same_everywhere() {
    let per_volume = POROSITY * POROSITY * 1000.0 * GRAVITY / CONDUCTIVITY;
    let inverse = 1.0 / ((1.0 - POROSITY) * 2650.0) + 1.0 / (POROSITY * 1000.0);
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let mut scene = strip(&column(CONDUCTIVITY), CONDUCTIVITY, 8, scheme);
        scene.pore_water = vec![Some(water(POROSITY, CONDUCTIVITY))];
        scene.tractions.clear();
        scene.mesh.cells[0] = 10;
        scene.mesh.planes[0] = [PlaneCondition::Free; 2];
        scene.water_planes = scene.mesh.planes;
        // A tenth of a cell off the plane with domains of a quarter to either side.
        let seeds = (0..8).flat_map(|i| (0..4).map(move |j| [f64::from(i), f64::from(j)]));
        let seeds = seeds.map(|[i, j]| ParticleSeed {
            position: [H * (3.25 + 0.5 * i), H * (0.1 + 0.5 * j), 0.0],
            volume: 0.25 * H * H,
        });
        scene.bodies = vec![body(1, Shape::Particles(Arc::new(seeds.collect())))];
        scene.bodies[0].particles_per_cell[2] = 1;
        scene.check().expect("the scene is sound");
        let mut simulation = simulation(&scene);
        let mut saved = simulation.save();
        let set = &mut saved.state.sets[0];
        let first = set.layout.water.expect("there is water");
        // So slow that no particle changes its place by a thousandth of a cell.
        set.columns[first].fill(1e-3);
        simulation.restore(saved).expect("the same scene");
        let (mut exact, mut dt_before) = (1e-3, 0.0);
        for _ in 0..50 {
            let dt = simulation.step(f64::INFINITY).expect("a step").dt;
            // Velocities are half a step behind positions.
            let kick = 0.5 * (dt_before + dt);
            dt_before = dt;
            exact /= 1.0 + kick * per_volume * inverse;
            let set = &simulation.sets()[0];
            for p in 0..set.len() {
                let relative = set.vector(first, p)[0] - set.velocity(p)[0];
                let off = relative / exact - 1.0;
                assert!(off.abs() < 1e-9, "{scheme:?}, particle {p}: {off:e}");
            }
        }
    }
}
