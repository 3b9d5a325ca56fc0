//! Motions that the grid does not see: stresses that give no force, and cells that are crossed at a creep.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("creeping-cells", creeping)
        .with("a stressed bar that creeps through a cell in 1e4 steps")
        .must("the noise of the stress by cell crossing told; of linear functions at least ten times that of GIMP"),
    Extreme::of("null-space", null_space)
        .with("16 particles in a cell with stresses of alternating sign, which give no force at any node")
        .must("a mode that the grid does not see stays as it is, and makes no energy"),
];

/// Root mean square of the stress less that at the start, over it, in a bar that creeps through a cell.
fn creep(weighting: Weighting, scheme: StressScheme) -> Result<f64> {
    const STEPS: u64 = 10_000;
    const STRESS: f64 = -1e-3;
    // Three columns of particles over two cells: the number in a cell changes as they move.
    const SPACING: f64 = 2.0 / 3.0;
    const LAYERS: u32 = 3;
    let bar = |speed: f64| {
        let mut scene = open([20, 2])
            .between(1)
            .with_weighting(weighting)
            .with_scheme(scheme);
        let material = scene.add_material(elastic(1.0, 0.0), 1.0);
        // Ends that are driven keep the bar as long as it is.
        for columns in [5..15_u32, 0..5, 15..20] {
            let driven = columns.len() < 10;
            let at = |k: u32| SPACING * (f64::from(k) + 0.5);
            let seeds = columns.flat_map(|column| {
                let place = move |row| [2.0 + at(column), at(row), 0.0];
                (0..LAYERS).map(move |row| (place(row), SPACING * SPACING))
            });
            let mut body = scene.add_body(listed(seeds), material);
            body.velocity = [speed, 0.0, 0.0];
            body.particles_per_cell = [1; 3];
            body.motion = driven.then(|| [speed, 0.0, 0.0].into());
        }
        scene
    };
    let dt = step(&mut start(&bar(0.0), &options())?, f64::INFINITY)?.dt;
    let speed = 1.0 / (STEPS as f64 * dt);
    let pressed = from(move |_| InitialState {
        stress: uniaxial(STRESS),
        ..moving_along_x(speed, 0.0)
    });
    let mut simulation = start(&bar(speed), &pressed)?;
    let (mut squares, mut count) = (0.0, 0_u32);
    run_to(&mut simulation, 1.0 / speed, |s, info| {
        if info.step.is_multiple_of(10) {
            for seen in of_body(s, 0) {
                squares += (seen.stress[0] / STRESS - 1.0).powi(2);
                count += 1;
            }
        }
    })?;
    Ok((squares / f64::from(count)).sqrt())
}

fn creeping() -> RowVerdict {
    let mut ratio = gate("noise of the stress, root mean square, of linear functions over that of GIMP")
        .at_least(10.0, "domains that fill the bar give a uniform stress no force inside it; points that cross a node do at once");
    let mut of_gimp = gate("noise with GIMP over the stress").at_most(
        1e-3,
        "domains keep filling the bar but for its strain, which is 1e-3",
    );
    let mut of_linear = gate("noise with linear functions over the stress")
        .at_least(0.01, "a point that crosses a node takes half of the force of two particles with it: without noise nothing crossed");
    for scheme in [StressScheme::Usf, StressScheme::Musl] {
        let linear = creep(Weighting::Linear, scheme)?;
        for weighting in [Weighting::UniformGimp, CONTIGUOUS] {
            let gimp = creep(weighting, scheme)?;
            of_gimp.see(gimp);
            ratio.see(linear / gimp);
        }
        of_linear.see(linear);
    }
    Ok(Finding::of([ratio, of_gimp, of_linear]))
}

/// Norm of what is left of the stresses along x less their means over each column of cells \[Pa\]: particles whose domains
/// lie within a cell feel one velocity gradient, and act on its nodes by the mean alone.
fn unseen(simulation: &Simulation, cells: usize) -> f64 {
    let mut by_cell = vec![vec![]; cells];
    for seen in of_body(simulation, 0) {
        by_cell[seen.position[0] as usize].push(seen.stress[0]);
    }
    let squares = by_cell.iter().map(|all| {
        let mean = all.iter().sum::<f64>() / all.len().max(1) as f64;
        all.iter().map(|s| (s - mean).powi(2)).sum::<f64>()
    });
    squares.sum::<f64>().sqrt()
}

fn null_space() -> RowVerdict {
    const CELLS: usize = 8;
    let mut changed = gate("change of the stresses that no node sees, over their norm")
        .at_most(1e-6, "particles in a cell feel one velocity gradient; a swing of 1e-11 of a cell takes that share of a domain across a face, in \
         each of 5000 steps");
    let mut bar = bar(CELLS);
    bar.bodies[0].particles_per_cell = [4, 4, 1];
    let wave = PI / CELLS as f64;
    let alternating = from(move |x| {
        let quarter = (4.0 * x[0]) as i64;
        let sign = if quarter % 2 == 0 { 1.0 } else { -1.0 };
        InitialState {
            stress: uniaxial(1e-12 * sign),
            // A swing that the grid sees, beside what it does not.
            ..moving_along_x(1e-12 * libm::sin(wave * x[0]), 0.0)
        }
    });
    // B-splines see more than means, and linear functions have no safe step with USL.
    for scene in each_scheme(&bar, &FILLING) {
        let mut simulation = start(&scene, &alternating)?;
        let before = unseen(&simulation, CELLS);
        each_of(&mut simulation, [5000, 50], |s| {
            changed.see((unseen(s, CELLS) / before - 1.0).abs());
        })?;
    }
    // 16 particles in a cell whose stresses alternate and whose velocities are noise.
    let mut free = block([8, 8], [2.6, 2.3], [4.6, 4.3], elastic(1.0, 0.3));
    free.bodies[0].particles_per_cell = [4, 4, 1];
    let rough = from(|x| {
        let quarters = (4.0 * x[0]) as i64 + (4.0 * x[1]) as i64;
        let sign = if quarters % 2 == 0 { 1e-6 } else { -1e-6 };
        InitialState {
            velocity: shaken(x, 1e-7),
            stress: [sign, sign, 0.0, 0.0, 0.0, sign],
            ..AT_REST
        }
    });
    let what = "free block with stresses that alternate and noise";
    Ok(Finding::of([changed]).and(conserved(what, &free, &rough, [3000, 10])?))
}
