//! Meshes and numbers of particles as no one would choose them: one to 64 particles per cell, cells a hundred times as long
//! as wide, a mesh of one cell across.

use super::prelude::*;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("particles-per-cell", particles_per_cell)
        .with("1 to 64 particles per cell, in the plane and in space")
        .must("the period of a bar is exact to the order of the mesh, and no energy comes from nowhere"),
    Extreme::of("aspect-100", aspect)
        .with("cells of 1 : 100, waves along the long and along the short edge")
        .must("the same of a bar along either edge"),
    Extreme::of("one-cell-across", one_cell_across)
        .with("a mesh of one cell across between walls, in the plane and in space")
        .must("the period of a bar; in space the motion of the plane"),
];

/// Cells along a bar.
const LENGTH: usize = 10;

/// A bar between sliding walls that it touches everywhere, swinging along an axis by its first mode.
struct Bar {
    dimension: Dimension,
    axis: usize,
    /// Cells across.
    across: usize,
    /// Edges of a cell \[m\].
    edges: [f64; 3],
    particles_per_cell: usize,
}

impl Bar {
    fn new(dimension: Dimension) -> Self {
        Self {
            dimension,
            axis: 0,
            across: 2,
            edges: [1.0; 3],
            particles_per_cell: 2,
        }
    }

    fn length(&self) -> f64 {
        LENGTH as f64 * self.edges[self.axis]
    }

    fn scene(&self) -> Scene {
        let axes = self.dimension.axes();
        let mut cells = [self.across; 3];
        cells[self.axis] = LENGTH;
        let mesh = Mesh::new(self.dimension, [0.0; 3], self.edges, cells);
        let mut far: [f64; 3] = std::array::from_fn(|a| cells[a] as f64 * self.edges[a]);
        far[axes..].fill(0.0);
        let mut scene = quiet(Scene::new(self.dimension, mesh, 1.0));
        let mut body = scene.body(cuboid([0.0; 3], far), soft(), 1.0);
        body.particles_per_cell[..axes].fill(self.particles_per_cell);
        scene
    }

    fn initial(&self) -> Options {
        let (axis, length) = (self.axis, self.length());
        from(move |x| {
            let k = PI / length;
            let mut state = AT_REST;
            // Small strains: a ten thousandth of the speed of the waves.
            state.velocity[axis] = 1e-4 * libm::sin(k * x[axis]);
            state.velocity_gradient[axis][axis] = 1e-4 * k * libm::cos(k * x[axis]);
            state
        })
    }

    /// Share of the first mode in the velocities, times its norm.
    fn mode(&self, simulation: &Simulation) -> f64 {
        let k = PI / self.length();
        let share = |seen: &ParticleState| {
            libm::sin(k * seen.position[self.axis]) * seen.velocity[self.axis]
        };
        particles(simulation).iter().map(share).sum()
    }

    /// Relative error of a quarter of the period; the gate is on the energy over that at the start.
    fn swing(&self, method: Method, grown: &mut Gate) -> Result<f64> {
        let mut simulation = start(&with(&self.scene(), method), &self.initial())?;
        // L/(2c), with a density of 1 kg/m³.
        let exact = 0.5 * self.length() / confined(YOUNG, POISSON).sqrt();
        let begin = simulation.kinetic_energy();
        let mut before = (0.0, self.mode(&simulation));
        grown.see(1.0);
        while simulation.time() < 2.0 * exact {
            let (kinetic, strain) = (simulation.kinetic_energy(), simulation.strain_energy());
            steps(&mut simulation, 1)?;
            // Velocities are half a step before and after the strain.
            let mean = 0.5 * (kinetic + simulation.kinetic_energy());
            grown.see((mean + strain) / begin);
            let now = (simulation.velocity_time(), self.mode(&simulation));
            if now.1 <= 0.0 {
                let zero = before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1);
                return Ok((zero / exact - 1.0).abs());
            }
            before = now;
        }
        // It never turned.
        Ok(f64::INFINITY)
    }
}

/// Swings bars with some methods and takes the worst.
fn swings(bars: impl IntoIterator<Item = Bar>) -> RowVerdict {
    let kh = PI / LENGTH as f64;
    let mut period = gate("period of a bar of ten cells, relative error")
        .at_most(kh * kh / 3.0, "a quadratic B-spline, the widest function, is a filter of variance h²/4; a step applies it four times, which \
         costs (kh)²/4 of the frequency; the time step and few particles may cost a third of that again");
    let mut grown = gate("highest energy over that at the start")
        .at_most(1.0 + kh * kh, "none is given; strain energy beside the mean of the kinetic energies half a step before and after, and the filter, are \
         of order (kh)²");
    for bar in bars {
        for method in METHODS {
            period.see(bar.swing(method, &mut grown)?);
        }
    }
    Ok(Finding::of([period, grown]))
}

fn particles_per_cell() -> RowVerdict {
    let plane = [1, 2, 4, 8].map(|n| (Dimension::Two, n));
    let space = [1, 2, 4].map(|n| (Dimension::Three, n));
    let all = plane.into_iter().chain(space);
    swings(all.map(|(dimension, particles_per_cell)| Bar {
        particles_per_cell,
        across: 1,
        ..Bar::new(dimension)
    }))
}

fn aspect() -> RowVerdict {
    let all = [
        (Dimension::Two, 0, [1.0, 0.01, 1.0]),
        (Dimension::Two, 1, [1.0, 0.01, 1.0]),
        (Dimension::Three, 1, [1.0, 0.01, 0.1]),
        (Dimension::Three, 2, [1.0, 1.0, 0.01]),
    ];
    swings(all.map(|(dimension, axis, edges)| Bar {
        axis,
        edges,
        ..Bar::new(dimension)
    }))
}

/// A block that turns and breathes in an open plane, or between two walls a cell apart that make a plane of space.
fn flat(dimension: Dimension) -> Scene {
    let (mut scene, deep) = match dimension {
        Dimension::Two => (open([10, 10]), 0.0),
        Dimension::Three => (open_space([10, 10, 1]).between(2), 1.0),
    };
    scene.body(cuboid([3.2, 3.3, 0.0], [6.2, 6.3, deep]), soft(), 1.0);
    scene
}

fn one_cell_across() -> RowVerdict {
    let mut flatter = gate("a cell of space between two walls against plane strain, relative")
        .at_most(1e-12, "both are plane strain; 40 steps of a hundred roundings each, with a node's mass as little as a hundredth");
    let gradient = [[0.02, -0.03, 0.0], [0.03, -0.01, 0.0], [0.0; 3]];
    let initial = from(move |x| {
        let along = |a: usize| (0..2).map(|b| gradient[a][b] * (x[b] - 4.7)).sum();
        moving(std::array::from_fn(along), gradient)
    });
    for method in methods() {
        // Round-off at nodes of next to no mass is multiplied in each step, and is no matter of the walls.
        let calm = method.scheme != StressScheme::Usl || method.transfer == TransferKind::Flip;
        if !calm || !method.has_safe_step() {
            continue;
        }
        let run = |dimension| -> Result<Vec<ParticleState>> {
            let simulation = after(&with(&flat(dimension), method), &initial, 40)?;
            Ok(particles(&simulation))
        };
        let (plane, space) = (run(Dimension::Two)?, run(Dimension::Three)?);
        for seen in space {
            // Two layers of particles lie over those of the plane.
            let lateral = |seen: &ParticleState| [seen.position[0], seen.position[1]];
            let near = |other: &&ParticleState| apart(&lateral(other), &lateral(&seen)) < 1e-3;
            let Some(same) = plane.iter().find(near) else {
                flatter.see(f64::INFINITY);
                continue;
            };
            flatter.see(apart(&lateral(&seen), &lateral(same)) / 10.0);
            flatter.see(apart(&seen.velocity, &same.velocity) / 0.1);
            flatter.see(apart(&seen.stress, &same.stress) / 0.1);
        }
    }
    let across = |dimension| Bar {
        across: 1,
        ..Bar::new(dimension)
    };
    Ok(swings([Dimension::Two, Dimension::Three].map(across))?.and([flatter]))
}
