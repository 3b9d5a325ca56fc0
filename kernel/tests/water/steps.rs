//! The largest stable step: it does not fall with the conductivity.

use super::support::{column, strip};
use crate::common::simulation;
use proctor_scene::{StressScheme, TimeStep};

/// True where noise in the pressure stays bounded with a step of so many times h/c1; `None` for the critical one.
fn holds(k: f64, scheme: StressScheme, multiplier: Option<f64>) -> bool {
    let of = column(k);
    let mut scene = strip(&of, k, 20, scheme);
    scene.tractions.clear();
    let critical = simulation(&scene).stability_number();
    scene.time_step = TimeStep::Multiplier {
        multiplier: multiplier.unwrap_or(critical),
        allow_unstable: true,
    };
    let mut simulation = simulation(&scene);
    let mut saved = simulation.save();
    let set = &mut saved.state.sets[0];
    let column = set.layout.pore_pressure().expect("there is water");
    for p in 0..set.len() {
        set.columns[column][p] = ((p * 7919) % 1000) as f64 / 500.0 - 1.0;
    }
    simulation.restore(saved).expect("the same scene");
    for _ in 0..3000 {
        if simulation.step(1e9).is_err() {
            return false;
        }
    }
    let pressures = &simulation.sets()[0].columns[column];
    pressures.iter().all(|p| p.abs() < 10.0)
}

/// A linear analysis of twenty cells has USL lost above 0.75 to 0.85 of h/c1, from large conductivities to small ones.
#[test]
fn the_limit_holds_for_every_conductivity() {
    for k in [1e-1, 1e-3, 1e-5, 1e-10] {
        for scheme in [StressScheme::Usl, StressScheme::Musl] {
            assert!(holds(k, scheme, None), "{scheme:?}, k = {k}");
        }
        assert!(!holds(k, StressScheme::Usl, Some(0.95)), "k = {k}");
    }
}

/// The fastest wave of skeleton and water that do not drag each other, by power iteration on M^-1 K with the stiffness of both
/// and the masses of a volume.
fn fast_wave(of: &super::series::Column) -> f64 {
    let n = of.porosity;
    let (skeleton, water) = ((1.0 - n) * of.grains, n * of.water);
    let coupled = (1.0 - n) * of.bulk;
    let stiffness = [
        [of.modulus + coupled * (1.0 - n) / n, coupled],
        [coupled, n * of.bulk],
    ];
    let (mut mode, mut square) = ([1.0, 1.0], 0.0);
    for _ in 0..200 {
        let force = stiffness.map(|row| row[0] * mode[0] + row[1] * mode[1]);
        let next = [force[0] / skeleton, force[1] / water];
        square = next[0].hypot(next[1]);
        mode = next.map(|one| one / square);
    }
    square.sqrt()
}

/// The step is that of the fast wave, in which water and skeleton move past each other, whatever the drag.
#[test]
fn the_fast_wave_bounds_the_step() {
    for k in [1e-1, 1e-5] {
        let of = column(k);
        let mut scene = strip(&of, k, 20, StressScheme::Usl);
        scene.tractions.clear();
        let mut simulation = simulation(&scene);
        let exact = simulation.stability_number() * of.height / 20.0 / fast_wave(&of);
        let found = simulation.step(1e9).expect("a step").dt_critical;
        assert!((found / exact - 1.0).abs() < 1e-12, "{found:e} {exact:e}");
    }
}
