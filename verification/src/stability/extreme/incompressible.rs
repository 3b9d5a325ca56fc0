//! Nearly incompressible bodies.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState, Simulation};
use proctor_scene::{
    DomainUpdate, PlaneCondition, Scene, Shape, Vector, VolumetricStrain, Weighting,
};

use super::trial::{
    Kept, STEP_OF_FASTEST, elastic, kept, noise, open, run_steps, run_to, start, step, worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::AT_REST;
use crate::exact::sudden_weight::SuddenWeight;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "nearly-incompressible",
        what: "Poisson's ratio of 0.4999 and 0.49999: waves 40.8 and 129 times as fast as sqrt(E/rho)",
        required: "the step from that speed; confined compression exact; a free block stable",
        cause: None,
        judge: nearly_incompressible,
    },
    Extreme {
        name: "locking",
        what: "a square that swings in a mode without change of volume, in which Poisson's ratio has no part, with GIMP",
        required: "with means over cells its swing at 0.4999 and 0.49999 as exact as at 0.3, times two; without, locked",
        cause: None,
        judge: || locking(Weighting::UniformGimp),
    },
    Extreme {
        name: "locking-linear",
        what: "the same with linear functions",
        required: "the same",
        cause: None,
        judge: || locking(Weighting::Linear),
    },
    Extreme {
        name: "locking-b-splines",
        what: "the same with quadratic B-splines, which hardly lock",
        required: "as exact as at 0.3, times two, with means over cells and without",
        cause: None,
        judge: smooth_does_not_lock,
    },
];

/// Poisson's ratios, the first to compare with.
const RATIOS: [f64; 3] = [0.3, 0.4999, 0.49999];
/// Height of the column \[m\], in cells of 1 m.
const HEIGHT: f64 = 8.0;
/// Largest relative difference of two runs of one equation with the constants of two materials. Stress swings with an
/// amplitude that is round-off of the modulus at most, and 1/(1 - 2 nu) loses five digits.
const SAME: f64 = 1e-9;

/// Confined modulus over Young's modulus.
fn confined(poisson: f64) -> f64 {
    (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
}

/// A column between sliding planes that is let go under its weight, and run while a wave goes through it.
fn let_go(young: f64, poisson: f64, weighting: Weighting) -> Result<Simulation, Unexpected> {
    let modulus = young * confined(poisson);
    let gravity = 1e-6 * modulus / HEIGHT;
    let mut scene: Scene = open([2, HEIGHT as usize + 2]).with_gravity([0.0, -gravity, 0.0]);
    scene.weighting = weighting;
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    let material = scene.add_material(elastic(young, poisson), 1.0);
    scene.add_body(Shape::rectangle([0.0, 0.0], [2.0, HEIGHT]), material);
    let mut simulation = start(&scene, None)?;
    run_to(&mut simulation, HEIGHT / modulus.sqrt(), |_, _| ())?;
    Ok(simulation)
}

/// Mean displacement of the column \[m\].
fn sunk(simulation: &Simulation) -> f64 {
    let all = 0..simulation.particles();
    let sum: f64 = all
        .filter_map(|p| simulation.displacement(0, p))
        .map(|u| u[1])
        .sum();
    sum / simulation.particles() as f64
}

/// Mean displacement of the exact column after a wave has gone through it \[m\].
fn exactly_sunk(modulus: f64) -> f64 {
    const PARTS: usize = 1000;
    let exact = SuddenWeight {
        height: HEIGHT,
        wave_speed: modulus.sqrt(),
        gravity: 1e-6 * modulus / HEIGHT,
    };
    let t = HEIGHT / modulus.sqrt();
    let at = |i: usize| exact.displacement((i as f64 + 0.5) * HEIGHT / PARTS as f64, t);
    (0..PARTS).map(at).sum::<f64>() / PARTS as f64
}

/// Momentum lost and energy gained by a free block with noise, the worst over methods.
fn noisy(poisson: f64) -> Result<(f64, f64), Unexpected> {
    let (mut drift, mut grown) = (0.0, 0.0);
    for weighting in [
        Weighting::UniformGimp,
        Weighting::ContiguousGimp(DomainUpdate::Stretch),
        Weighting::QuadraticBSpline,
    ] {
        for scheme in SCHEMES {
            let mut scene = open([10, 10]);
            (scene.weighting, scene.scheme) = (weighting, scheme);
            let material = scene.add_material(elastic(1.0, poisson), 1.0);
            scene.add_body(Shape::rectangle([3.1, 3.3], [6.1, 6.3]), material);
            let rough: InitialField = Arc::new(|x| InitialState {
                velocity: [1e-6 * noise(x, 1), 1e-6 * noise(x, 2), 0.0],
                ..AT_REST
            });
            let mut simulation = start(&scene, Some(rough))?;
            let mut balance = Kept::of(&simulation);
            run_steps(&mut simulation, 1000, |s, _| balance.look(s))?;
            drift = worst(drift, balance.drift);
            grown = worst(grown, balance.grown);
        }
    }
    Ok((drift, grown))
}

fn nearly_incompressible() -> Result<Finding, Unexpected> {
    let mut gates = vec![];
    for poisson in RATIOS {
        let name = format!("nu = {poisson}");
        let modulus = confined(poisson);
        let mut scene = open([6, 6]);
        let material = scene.add_material(elastic(1.0, poisson), 1.0);
        scene.add_body(Shape::rectangle([2.0, 2.0], [4.0, 4.0]), material);
        let mut simulation = start(&scene, None)?;
        let number = simulation.stability_number();
        let speed = number / step(&mut simulation, f64::INFINITY)?.dt_critical;
        gates.push(Gate::at_most(
            format!("{name}: wave speed behind the step"),
            (speed / modulus.sqrt() - 1.0).abs(),
            // 1 - 2 nu loses five digits.
            1e-10,
            STEP_OF_FASTEST,
        ));
        let (mut sides, mut same, mut off) = (0.0, 0.0, 0.0);
        for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
            let column = let_go(1.0, poisson, weighting)?;
            let set = &column.sets()[0];
            let largest = (0..set.len()).map(|p| set.stress(p)[1].abs());
            let largest = largest.fold(0.0, f64::max);
            for p in 0..set.len() {
                let s = set.stress(p);
                let exact = poisson / (1.0 - poisson) * s[1];
                sides = worst(sides, (s[0] - exact).abs() / largest);
            }
            let plain = let_go(modulus, 0.0, weighting)?;
            same = worst(same, (sunk(&column) / sunk(&plain) - 1.0).abs());
            off = worst(off, (sunk(&column) / exactly_sunk(modulus) - 1.0).abs());
        }
        gates.push(Gate::at_most(
            format!("{name}: stress on the sides, over the vertical one, less nu/(1 - nu)"),
            sides,
            SAME,
            "uniaxial strain: both stresses are the same strain times a constant",
        ));
        gates.push(Gate::at_most(
            format!("{name}: settlement against a column of nu = 0 with the confined modulus"),
            same,
            SAME,
            "both obey one equation; what differs is round-off, to which 1/(1 - 2 nu) adds five digits",
        ));
        gates.push(Gate::at_most(
            format!("{name}: settlement against the exact one"),
            off,
            0.02,
            "eight cells: a front that is spread over (h² H)^(1/3) brings the mean off by its share of the height squared",
        ));
        let (drift, grown) = noisy(poisson)?;
        gates.extend(kept(
            &format!("{name}, free block with noise"),
            drift,
            grown,
        ));
    }
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

/// Displacement over the exact one of a square that swings in its first Lamé mode, u = (cos kx sin ky, -sin kx cos ky) with
/// k = pi/a, after a quarter of its period: its share in the mode. The mode has no divergence and no traction at the
/// edges, so that omega = sqrt(2) k c_s whatever lambda is.
fn swing(
    poisson: f64,
    weighting: Weighting,
    volumetric_strain: VolumetricStrain,
) -> Result<f64, Unexpected> {
    const SIDE: f64 = 8.0;
    const CORNER: f64 = 2.0;
    const SPEED: f64 = 1e-6;
    let wave = std::f64::consts::PI / SIDE;
    let frequency = 2.0_f64.sqrt() * wave * (0.5 / (1.0 + poisson)).sqrt();
    let mode = move |x: &Vector| -> [f64; 2] {
        let [(sin_x, cos_x), (sin_y, cos_y)] = [0, 1].map(|k| libm::sincos(wave * (x[k] - CORNER)));
        [cos_x * sin_y, -sin_x * cos_y]
    };
    let mut scene = open([12, 12]);
    scene.weighting = weighting;
    scene.volumetric_strain = volumetric_strain;
    let material = scene.add_material(elastic(1.0, poisson), 1.0);
    let square = Shape::rectangle([CORNER; 2], [CORNER + SIDE; 2]);
    scene.add_body(square, material);
    let swings: InitialField = Arc::new(move |x| {
        let [u, v] = mode(x);
        InitialState {
            velocity: [SPEED * u, SPEED * v, 0.0],
            ..AT_REST
        }
    });
    let mut simulation = start(&scene, Some(swings))?;
    let quarter = std::f64::consts::FRAC_PI_2 / frequency;
    run_to(&mut simulation, quarter, |_, _| ())?;
    let (mut share, mut whole) = (0.0, 0.0);
    for p in 0..simulation.particles() {
        let [u, v] = mode(&simulation.position(0, p));
        let moved = simulation.displacement(0, p).unwrap_or([f64::NAN; 3]);
        share += u * moved[0] + v * moved[1];
        whole += u * u + v * v;
    }
    Ok(share / whole * frequency / SPEED)
}

/// How far the swing is off at each ratio, over its exact value.
fn off(weighting: Weighting, volumetric_strain: VolumetricStrain) -> Result<[f64; 3], Unexpected> {
    let mut all = [0.0; 3];
    for (off, poisson) in all.iter_mut().zip(RATIOS) {
        *off = (swing(poisson, weighting, volumetric_strain)? - 1.0).abs();
    }
    Ok(all)
}

/// That the swing is as exact at all ratios.
fn as_exact(name: &str, [own, others @ ..]: [f64; 3]) -> Vec<Gate> {
    let mut gates = vec![Gate::at_most(
        format!(
            "{name}, nu = {}: swing over the exact one, less one",
            RATIOS[0]
        ),
        own,
        0.05,
        "eight cells: (k h)²/24 of the grid along both axes, and a rim of half a cell that weighs or holds too little",
    )];
    gates.extend(RATIOS[1..].iter().zip(others).map(|(poisson, off)| {
        Gate::at_most(
            format!("{name}, nu = {poisson}: swing over the exact one, less one"),
            off,
            2.0 * own,
            "Poisson's ratio has no part in the exact mode",
        )
    }));
    gates
}

fn locking(weighting: Weighting) -> Result<Finding, Unexpected> {
    let mut gates = as_exact(
        "means over cells",
        off(weighting, VolumetricStrain::CellAverage)?,
    );
    let [own, locked, _] = off(weighting, VolumetricStrain::Particle)?;
    gates.push(Gate::at_least(
        format!(
            "strain of each particle, nu = {}: locked, off by",
            RATIOS[1]
        ),
        locked,
        2.0 * own,
        "a square that did not lock without means over cells would prove nothing of them",
    ));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

fn smooth_does_not_lock() -> Result<Finding, Unexpected> {
    let weighting = Weighting::QuadraticBSpline;
    let mut gates = as_exact(
        "means over cells",
        off(weighting, VolumetricStrain::CellAverage)?,
    );
    gates.extend(as_exact(
        "strain of each particle",
        off(weighting, VolumetricStrain::Particle)?,
    ));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
