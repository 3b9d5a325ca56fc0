//! Domains that end on nodes to round-off: lengths scaled and shifted by numbers that are no powers of two give the same
//! result, scaled back.

use crate::common::{
    APIC, DIMENSIONS, NEVER, body, cuboid, elastic, empty, material, run_towards, simulation,
};
use proctor_scene::{
    Contact, ContactNormal, Dimension, History, Scene, StressScheme, TimeStep, Weighting,
};

/// Stress over Young's modulus and velocity \[m/s\] of each particle of the block, in the order of its identifiers.
fn fallen(scene: &Scene, steps: usize) -> Vec<f64> {
    let mut simulation = simulation(scene);
    run_towards(&mut simulation, steps, NEVER);
    let set = &simulation.sets()[1];
    let mut order: Vec<usize> = (0..set.len()).collect();
    order.sort_by_key(|&p| set.id[p]);
    let of = |p: usize| {
        set.stress(p)
            .into_iter()
            .map(|s| s / 1e6)
            .chain(set.velocity(p))
    };
    order.into_iter().flat_map(of).collect()
}

/// A block that falls on a driven plate; both end on nodes. Lengths are those of the plain scene times `scale`, and `shift`
/// \[m\] more along all axes; with time scaled alike, speeds and stresses stay as they are.
fn on_plate(dimension: Dimension, contact: bool, scale: f64, shift: f64) -> Scene {
    let flat = dimension == Dimension::Two;
    let h = 0.125 * scale;
    let mut scene = empty(dimension, [3, 9, 3], h);
    let at = |cells: [f64; 3]| {
        let mut x = cells.map(|c| c * h + shift);
        if flat {
            x[2] = 0.0;
        }
        x
    };
    scene.mesh.origin = at([0.0; 3]);
    let side = if flat { 0.0 } else { 3.0 };
    let mut plate = body(1, cuboid(at([0.0; 3]), at([3.0, 2.0, side])));
    let block = body(2, cuboid(at([0.0, 2.0, 0.0]), at([2.0, 6.0, side])));
    plate.motion = Some(History {
        times: vec![0.0],
        values: vec![[0.0; 3]],
    });
    scene.bodies = vec![plate, block];
    for one in &mut scene.bodies {
        one.particles_per_cell = if flat { [2, 2, 1] } else { [2; 3] };
    }
    scene.materials = vec![material(elastic(1e6, 0.25))];
    scene.gravity[1] = -10.0 / scale;
    scene.scheme = StressScheme::Musl;
    scene.transfer = APIC;
    scene.time_step = TimeStep::Fixed {
        dt: 5e-4 * scale,
        allow_unstable: false,
    };
    if contact {
        scene.contacts = vec![Contact {
            name: "block on plate".into(),
            id: 1,
            friction: 0.3,
            master: 1,
            slave: 2,
            normal: ContactNormal::Master,
        }];
    }
    scene
}

#[test]
fn odd_scales_and_shifts_change_nothing() {
    for dimension in DIMENSIONS {
        for contact in [false, true] {
            for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
                let found = |scale: f64, shift: f64| {
                    let mut scene = on_plate(dimension, contact, scale, shift);
                    scene.weighting = weighting;
                    // As many steps as keep the round-off of scales that are no powers of two below 1e-12.
                    fallen(&scene, 60)
                };
                let plain = found(1.0, 0.0);
                let size = plain.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                assert!(size > 1e-3, "the block falls");
                for scale in [3.0, 1.0 / 3.0, 0.7, 1e3] {
                    for shift in [0.0, 0.1, 1.0 / 3.0, 1e3] {
                        let other = found(scale, shift);
                        let off = plain.iter().zip(&other).map(|(a, b)| (a - b).abs());
                        let off = off.fold(0.0, f64::max) / size;
                        // Coordinates are good to the last bit of the shift, and contact divides a gap by a step.
                        let exact = 1e-12 + 400.0 * f64::EPSILON * shift / (0.125 * scale);
                        let which =
                            format!("{dimension:?} {weighting:?} {contact}, x {scale} + {shift}");
                        assert!(off < exact, "{which}: {off:e} of {exact:e}");
                    }
                }
            }
        }
    }
}
