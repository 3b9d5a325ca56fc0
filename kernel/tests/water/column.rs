//! A column under a load on its drained top, against the exact series with the inertia of both phases.

use super::series::Column;
use super::support::{column, means, run, strip};
use crate::common::simulation;
use proctor_kernel::layout::Layout;
use proctor_scene::simulation::Simulation;
use proctor_scene::{DomainUpdate, StressScheme, TimeStep, Weighting};

/// Largest errors of pressure and effective stress over cells, as shares of the undrained pressure and of the load.
fn errors(of: &Column, k: f64, cells: usize, scheme: StressScheme, time: f64) -> [f64; 2] {
    errors_of(&run(of, k, cells, scheme, time), of, cells, time)
}

fn errors_of(simulation: &Simulation, of: &Column, cells: usize, time: f64) -> [f64; 2] {
    let exact = of.at(time, 500);
    let h = of.height / cells as f64;
    let mut most = [0.0_f64; 2];
    for (cell, [p, stress]) in means(simulation, h, cells).into_iter().enumerate() {
        let (low, high) = (cell as f64 * h, (cell + 1) as f64 * h);
        most[0] = most[0].max((p - exact.mean(low, high)).abs() / of.undrained());
        most[1] = most[1].max((stress - exact.mean_stress(low, high)).abs() / of.load);
    }
    most
}

#[test]
fn the_column_follows_the_series_with_order_two() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        let of = column(1e-3);
        let [coarse, fine] = [16, 32].map(|cells| errors(&of, 1e-3, cells, scheme, 0.1));
        println!("{scheme:?}: {coarse:?}, {fine:?}");
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            let order = (coarse / fine).log2();
            assert!(fine < 1e-3, "{scheme:?}: {fine}");
            assert!((1.9..=2.1).contains(&order), "{scheme:?}: order {order}");
        }
        // Where the water flows so easily the waves of the ramp show in coarse meshes.
        for error in errors(&column(1e-2), 1e-2, 32, scheme, 0.1) {
            assert!(error < 3e-4, "{scheme:?}: {error}");
        }
    }
}

/// Domains that follow the skeleton have the column as those that keep their length.
#[test]
fn the_column_follows_the_series_with_domains_that_follow() {
    let (k, cells, time) = (1e-3, 32, 0.1);
    let of = column(k);
    let mut scene = strip(&of, k, cells, StressScheme::Usl);
    scene.weighting = Weighting::ContiguousGimp(DomainUpdate::Stretch);
    let mut simulation = simulation(&scene);
    simulation.run_until(time).expect("the step is stable");
    for error in errors_of(&simulation, &of, cells, time) {
        assert!(error < 1e-3, "{error}");
    }
}

/// Far below the drained top nothing has flowed yet: the pressure is that of the undrained column.
#[test]
fn water_that_has_not_flowed_has_the_undrained_pressure() {
    let (cells, time) = (20, 0.1);
    let h = 1.0 / 20.0;
    for k in [1e-6, 1e-7] {
        let of = column(k);
        let simulation = run(&of, k, cells, StressScheme::Usl, time);
        let exact = of.at(time, 2000);
        let diffusion =
            k / (of.water * super::support::GRAVITY) / (1.0 / of.modulus + of.porosity / of.bulk);
        let layer = (diffusion * time).sqrt();
        for (cell, [p, _]) in means(&simulation, h, cells).into_iter().enumerate() {
            let high = (cell + 1) as f64 * h;
            if high < of.height - 2.0 * h - 4.0 * layer {
                let error = (p - exact.mean(high - h, high)).abs() / of.undrained();
                assert!(error < 1e-4, "k = {k}, cell {cell}: {error}");
            }
        }
    }
}

/// Soil that is squeezed with its water has less room for it: the pressure is K ln(n_0/(J - 1 + n_0)) at a volume J of that of
/// the start, and not K ln(1/J)/n_0. Steps strain a particle by about 1e-4, of which half over the porosity is lost.
#[test]
fn pressure_rises_by_the_porosity_of_now() {
    let k = 1e-12;
    let of = column(k);
    let mut scene = strip(&of, k, 8, StressScheme::Usl);
    scene.tractions.clear();
    scene.gravity = [0.0, -1e4, 0.0];
    scene.time_step = TimeStep::Multiplier {
        multiplier: 0.03,
        allow_unstable: false,
    };
    let mut simulation = simulation(&scene);
    let before: Vec<f64> = simulation.sets()[0].columns[Layout::VOLUME].clone();
    let number: Vec<u64> = simulation.sets()[0].id.clone();
    // A wave goes up to the top from the base, and the weight swings to twice what it is at rest.
    simulation.run_until(of.height / 500.0).expect("all steps");
    let set = &simulation.sets()[0];
    let column = set.layout.pore_pressure().expect("there is water");
    let mut least = 1.0_f64;
    for p in 0..set.len() {
        let own = number.iter().position(|id| *id == set.id[p]);
        let volume = set.columns[Layout::VOLUME][p] / before[own.expect("the same particles")];
        least = least.min(volume);
        let exact = of.bulk * (of.porosity / (volume - 1.0 + of.porosity)).ln();
        let off = (set.columns[column][p] - exact) / of.bulk;
        assert!(off.abs() < 2e-4, "J = {volume}: {off:e} of K");
    }
    assert!(least < 0.97, "hardly squeezed: {least}");
}
