//! Laws of the conductivity: a skeleton that is strained drags as one of the conductivity that the law has there.

use super::support::{column, strip};
use crate::common::simulation;
use proctor_kernel::layout::Layout;
use proctor_scene::{Permeability, StressScheme};

/// Velocity of the water after one step of the column whose volumes are J times those of the start, with noise in it.
fn flow(law: Permeability, k: f64, strained: f64) -> Vec<f64> {
    let of = column(k);
    let mut scene = strip(&of, k, 8, StressScheme::Usl);
    for water in scene.pore_water.iter_mut().flatten() {
        water.permeability = law;
    }
    let mut simulation = simulation(&scene);
    let mut saved = simulation.save();
    let set = &mut saved.state.sets[0];
    let first = set.layout.water.expect("there is water");
    for p in 0..set.len() {
        set.columns[Layout::VOLUME][p] *= strained;
        set.columns[first + 1][p] = ((p * 7919) % 1000) as f64 / 500.0 - 1.0;
    }
    simulation.restore(saved).expect("the same scene");
    simulation.step(1e9).expect("the step is stable");
    simulation.sets()[0].columns[first + 1].clone()
}

#[test]
fn a_law_is_the_constant_that_it_has_there() {
    let (k, start) = (1e-3, 0.4);
    for strained in [0.8, 1.0, 1.3] {
        // Grains keep their volume.
        let porosity = 1.0 - (1.0 - start) / strained;
        let square = strained * strained;
        let kozeny = |n: f64| n * n * n / ((1.0 - n) * (1.0 - n));
        for (law, factor) in [
            (Permeability::Square, square),
            (Permeability::KozenyCarman, kozeny(porosity) / kozeny(start)),
        ] {
            let own = flow(law, k, strained);
            let constant = flow(Permeability::Constant, k * factor, strained);
            let largest = own.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
            assert!(largest > 1e-6, "water flows: {largest}");
            for (own, constant) in own.iter().zip(&constant) {
                let off = (own - constant).abs() / largest;
                assert!(off < 1e-9, "{law:?} at {strained}: {own} beside {constant}");
            }
        }
        if strained != 1.0 {
            let constant = flow(Permeability::Constant, k, strained);
            assert_ne!(flow(Permeability::Square, k, strained), constant);
        }
    }
}
