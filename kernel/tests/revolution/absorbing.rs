//! Absorbing planes around an axis: dashpots have the areas of rings, and waves leave along the axis.

use super::revolved;
use crate::common::{DENSITY, SCHEMES, body, cuboid, elastic, material, simulation};
use proctor_kernel::grid::GridShape;
use proctor_scene::{BaseMotion, History, Motion, PlaneCondition, Scene, Weighting};
use std::f64::consts::{PI, TAU};

const YOUNG: f64 = 1.0e6;
const POISSON: f64 = 0.25;
const CELL: f64 = 0.1;
/// Cells of the cylinder along its radius.
const RADIUS: usize = 4;
/// Cells of a pulse.
const PULSE: usize = 20;

/// Speeds of compression and of shear \[m/s\].
fn speeds() -> [f64; 2] {
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let lambda = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    [(lambda + 2.0 * shear) / DENSITY, shear / DENSITY].map(f64::sqrt)
}

/// A cylinder that fills a mesh of so many cells along the axis, whose ends absorb; its mantle slides.
fn rod(cells: usize) -> Scene {
    let mut scene = revolved([RADIUS, cells], CELL);
    scene.mesh.planes[0][1] = PlaneCondition::Sliding;
    scene.mesh.planes[1] = [PlaneCondition::Absorbing; 2];
    let upper = [RADIUS as f64 * CELL, cells as f64 * CELL, 0.0];
    scene.bodies = vec![body(1, cuboid([0.0; 3], upper))];
    scene.bodies[0].particles_per_cell[2] = 1;
    scene.materials = vec![material(elastic(YOUNG, POISSON))];
    scene
}

/// Sums of rho c A over the nodes of a plane, of compression and of shear; shear without the nodes on the axis, which do not move
/// along the radius \[kg/s\].
fn impedances(scene: &Scene, axis: usize, side: usize) -> [f64; 2] {
    scene.check().expect("the scene is sound");
    let simulation = simulation(scene);
    let shape = GridShape::new(&scene.mesh, scene.dimension);
    let place = (side * shape.cells[axis]) as f64 * CELL;
    let mut sums = [0.0; 2];
    for one in simulation.save().state.absorbing {
        let x = shape.position(one.node);
        if (x[axis] - place).abs() < 1e-9 {
            sums[0] += one.impedance[axis];
            sums[1] += one.impedance[1 - axis];
            assert!(x[0] > 0.0 || one.impedance[0] == 0.0, "the axis is held");
        }
    }
    sums
}

/// The dashpots of a disc have its area together, those of a mantle that of the mantle, whatever the functions. A node on the axis
/// stands for h² (1/6 + 1/(12 n²)) per radian with n = 2 particles per cell, with B-splines for 0.2109 h². What splines give to a
/// node beyond the axis, 0.5 per thousand of the disc, has no dashpot.
#[test]
fn dashpots_have_the_areas_of_rings() {
    let [compression, shear] = speeds().map(|c| DENSITY * c);
    let radius = RADIUS as f64 * CELL;
    for (weighting, of_axis) in [
        (Weighting::UniformGimp, 1.0 / 6.0 + 1.0 / 48.0),
        (Weighting::Linear, 0.1875),
        (Weighting::QuadraticBSpline, 0.210_937_5),
    ] {
        let round_off = if weighting == Weighting::QuadraticBSpline {
            1e-3
        } else {
            1e-12
        };
        let same = |found: [f64; 2], exact: [f64; 2]| {
            for (found, exact) in found.into_iter().zip(exact) {
                let off = (found / exact - 1.0).abs();
                assert!(off < round_off, "{weighting:?}: {found}, not {exact}");
            }
        };
        // Nodes of splines lie a cell beyond a body, and are those of the mesh where it goes on.
        let mut disc = rod(6);
        disc.weighting = weighting;
        disc.mesh.cells[0] += 2;
        disc.mesh.planes[0][1] = PlaneCondition::Free;
        let area = PI * radius * radius;
        let beside = area - TAU * CELL * CELL * of_axis;
        for side in [0, 1] {
            same(
                impedances(&disc, 1, side),
                [compression * area, shear * beside],
            );
        }
        let mut mantle = rod(8);
        mantle.weighting = weighting;
        mantle.mesh.planes[0][1] = PlaneCondition::Absorbing;
        mantle.mesh.planes[1] = [PlaneCondition::Free; 2];
        mantle.bodies = vec![body(1, cuboid([0.0, CELL, 0.0], [radius, 7.0 * CELL, 0.0]))];
        mantle.bodies[0].particles_per_cell[2] = 1;
        let area = TAU * radius * 6.0 * CELL;
        same(
            impedances(&mantle, 0, 1),
            [compression * area, shear * area],
        );
    }
}

/// A pulse along the axis leaves as in the plane: the bounds are those of *pulses_leave* there.
#[test]
fn a_pulse_along_the_axis_leaves() {
    let period = PULSE as f64 * CELL / speeds()[0];
    let count = 2000;
    let times: Vec<f64> = (0..=count)
        .map(|i| 3.0 * period * f64::from(i) / f64::from(count))
        .collect();
    let values = times.iter().map(|t| {
        let a = (PI * (t / period - 1.5)).powi(2);
        [
            0.0,
            1e-6 * CELL / period * (1.0 - 2.0 * a) * (-a).exp(),
            0.0,
        ]
    });
    let values = values.collect();
    let wave = History { values, times };
    for (scheme, most) in SCHEMES.into_iter().zip([2e-4, 2e-3, 2e-3]) {
        let mut scene = rod(3 * PULSE);
        scene.scheme = scheme;
        scene.ground_beyond.incoming = Some(BaseMotion {
            axis: 1,
            side: 0,
            motion: Motion::Velocity(wave.clone()),
        });
        scene.check().expect("the scene is sound");
        let mut simulation = simulation(&scene);
        simulation.run_until(3.0 * period).expect("all steps");
        let before = simulation.energy();
        simulation.run_until(6.0 * period).expect("all steps");
        let after = simulation.energy();
        let incident = before.kinetic + before.strain;
        let reflected = (after.kinetic + after.strain) / incident;
        assert!(incident > 0.0);
        assert!(reflected < most, "{scheme:?}: {reflected}");
    }
}
