//! Nearly incompressible bodies.

use super::prelude::*;
use crate::exact::sudden_weight::SuddenWeight;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("nearly-incompressible", nearly_incompressible)
        .with("Poisson's ratio of 0.4999 and 0.49999: waves 40.8 and 129 times as fast as sqrt(E/rho)")
        .must("the step from that speed; confined compression exact; a free block stable"),
    Extreme::of("locking", || locking(Weighting::UniformGimp))
        .with("a square that swings in a mode without change of volume, in which Poisson's ratio has no part, with GIMP")
        .must("with means over cells its swing at 0.4999 and 0.49999 as exact as at 0.3, times two; without, locked"),
    Extreme::of("locking-linear", || locking(Weighting::Linear))
        .with("the same with linear functions")
        .must("the same"),
    Extreme::of("locking-b-splines", smooth_does_not_lock)
        .with("the same with quadratic B-splines, which hardly lock")
        .must("as exact as at 0.3, times two, with means over cells and without"),
];

/// Poisson's ratios, the first to compare with.
const RATIOS: [f64; 3] = [0.3, 0.4999, 0.49999];
/// Height of the column \[m\], in cells of 1 m.
const HEIGHT: f64 = 8.0;
/// Largest relative difference of two runs of one equation with the constants of two materials. Stress swings with an
/// amplitude that is round-off of the modulus at most, and 1/(1 - 2 nu) loses five digits.
const SAME: f64 = 1e-9;

/// A column between sliding planes that is let go under its weight, and run while a wave goes through it.
fn let_go(young: f64, poisson: f64, weighting: Weighting) -> Result<Simulation> {
    let modulus = confined(young, poisson);
    let gravity = 1e-6 * modulus / HEIGHT;
    let cells = [2, HEIGHT as usize + 2];
    let scene = block(cells, [0.0, 0.0], [2.0, HEIGHT], elastic(young, poisson))
        .with_gravity([0.0, -gravity])
        .with_weighting(weighting)
        .between(0)
        .with_plane(1, 0, PlaneCondition::Sliding);
    at_time(&scene, &options(), HEIGHT / modulus.sqrt())
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

fn nearly_incompressible() -> RowVerdict {
    // Mean displacement of the column [m].
    let sunk = |s: &Simulation| sum(s, |seen| seen.displacement[1]) / s.particles() as f64;
    let mut finding = Finding::default();
    for poisson in RATIOS {
        let name = format!("nu = {poisson}");
        let modulus = confined(1.0, poisson);
        let of = |what: &str| gate(format!("{name}: {what}"));
        let mut sides = of("stress on the sides, over the vertical one, less nu/(1 - nu)").at_most(
            SAME,
            "uniaxial strain: both stresses are the same strain times a constant",
        );
        let mut same = of("settlement against a column of nu = 0 with the confined modulus")
            .at_most(SAME, "both obey one equation; they differ by round-off, to which 1/(1 - 2 nu) adds five digits");
        let mut off = of("settlement against the exact one")
            .at_most(0.02, "eight cells: a front that is spread over (h² H)^(1/3) brings the mean off by its share of the height squared");
        let scene = block([6, 6], [2.0, 2.0], [4.0, 4.0], elastic(1.0, poisson));
        let mut simulation = start(&scene, &options())?;
        let number = simulation.stability_number();
        let speed = number / step(&mut simulation, NEVER)?.dt_critical;
        // 1 - 2 nu loses five digits.
        let speed = of("wave speed behind the step")
            .at_most(1e-10, STEP_OF_FASTEST)
            .found((speed / modulus.sqrt() - 1.0).abs());
        for weighting in [Weighting::UniformGimp, Weighting::QuadraticBSpline] {
            let column = let_go(1.0, poisson, weighting)?;
            let largest = largest(of_body(&column, 0).map(|seen| seen.stress[1]));
            for s in of_body(&column, 0).map(|seen| seen.stress) {
                let exact = poisson / (1.0 - poisson) * s[1];
                sides.see((s[0] - exact).abs() / largest);
            }
            let plain = let_go(modulus, 0.0, weighting)?;
            same.see((sunk(&column) / sunk(&plain) - 1.0).abs());
            off.see((sunk(&column) / exactly_sunk(modulus) - 1.0).abs());
        }
        let scene = block([10, 10], [3.1, 3.3], [6.1, 6.3], elastic(1.0, poisson));
        let noisy = flying(|x| shaken(x, 1e-6));
        let free = format!("{name}, free block with noise");
        let kept = conserved(&free, &scene, &noisy, [1000, 1])?;
        finding = finding.and([speed, sides, same, off]).and(kept);
    }
    Ok(finding)
}

/// Displacement over the exact one, less one, of a square that swings in its first Lamé mode, u = (cos kx sin ky,
/// -sin kx cos ky) with k = pi/a, after a quarter of its period: its share in the mode. The mode has no divergence and no
/// traction at the edges, so that omega = sqrt(2) k c_s whatever lambda is.
fn off(poisson: f64, weighting: Weighting, strain: VolumetricStrain) -> Result<f64> {
    const SIDE: f64 = 8.0;
    const CORNER: f64 = 2.0;
    const SPEED: f64 = 1e-6;
    let wave = PI / SIDE;
    let frequency = 2.0_f64.sqrt() * wave * (0.5 / (1.0 + poisson)).sqrt();
    let mode = move |x: &Vector| -> [f64; 2] {
        let [(sin_x, cos_x), (sin_y, cos_y)] = [0, 1].map(|k| libm::sincos(wave * (x[k] - CORNER)));
        [cos_x * sin_y, -sin_x * cos_y]
    };
    let law = elastic(1.0, poisson);
    let mut scene = block([12, 12], [CORNER; 2], [CORNER + SIDE; 2], law).with_weighting(weighting);
    scene.volumetric_strain = strain;
    let swings = flying(move |x| {
        let [u, v] = mode(x);
        [SPEED * u, SPEED * v, 0.0]
    });
    let simulation = at_time(&scene, &swings, FRAC_PI_2 / frequency)?;
    let (mut share, mut whole) = (0.0, 0.0);
    for seen in of_body(&simulation, 0) {
        let [u, v] = mode(&seen.position);
        share += u * seen.displacement[0] + v * seen.displacement[1];
        whole += u * u + v * v;
    }
    Ok((share / whole * frequency / SPEED - 1.0).abs())
}

/// Gates that the swing is as exact at all ratios.
fn as_exact(name: &str, weighting: Weighting, strain: VolumetricStrain) -> Result<[Gate; 3]> {
    let name = |nu| format!("{name}, nu = {nu}: swing over the exact one, less one");
    let [own, near, nearer] = RATIOS.map(|nu| off(nu, weighting, strain));
    let own = own?;
    let first = gate(name(RATIOS[0]))
        .at_most(0.05, "eight cells: (k h)²/24 of the grid along both axes, and a rim of half a cell that weighs or holds too little");
    let no_part = "Poisson's ratio has no part in the exact mode";
    Ok([
        first.found(own),
        gate(name(RATIOS[1]))
            .at_most(2.0 * own, no_part)
            .found(near?),
        gate(name(RATIOS[2]))
            .at_most(2.0 * own, no_part)
            .found(nearer?),
    ])
}

fn locking(weighting: Weighting) -> RowVerdict {
    let averaged = as_exact("means over cells", weighting, VolumetricStrain::CellAverage)?;
    let nu = RATIOS[1];
    let [own, locked] = [RATIOS[0], nu].map(|nu| off(nu, weighting, VolumetricStrain::Particle));
    let name = format!("strain of each particle, nu = {nu}: locked, off by");
    let reason = "a square that did not lock without means over cells would prove nothing of them";
    let locked = gate(name).at_least(2.0 * own?, reason).found(locked?);
    Ok(Finding::of(averaged).and([locked]))
}

fn smooth_does_not_lock() -> RowVerdict {
    let of = |name, strain| as_exact(name, Weighting::QuadraticBSpline, strain);
    let averaged = of("means over cells", VolumetricStrain::CellAverage)?;
    let each = of("strain of each particle", VolumetricStrain::Particle)?;
    Ok(Finding::of(averaged).and(each))
}
