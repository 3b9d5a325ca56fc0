//! Meshes and numbers of particles as no one would choose them: one to 64 particles per cell, cells a hundred times as long
//! as wide, a mesh of one cell across.

use std::sync::Arc;

use proctor_scene::simulation::{InitialField, InitialState, Simulation};
use proctor_scene::{Dimension, Mesh, PlaneCondition, Scene, StressScheme};

use super::runs::{
    POISSON, YOUNG, apart, filled, from, methods, open, particles, soft, start, steps, with,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::cases::{AT_REST, NO_RESULTS, cuboid, material};
use crate::settings::Method;
use crate::stability::nonlinear::METHODS;
use std::f64::consts::PI;

pub const ROWS: &[Extreme] = &[
    Extreme {
        name: "particles-per-cell",
        what: "1 to 64 particles per cell, in the plane and in space",
        required: "the period of a bar is exact to the order of the mesh, and no energy comes from nowhere",
        cause: None,
        judge: particles_per_cell,
    },
    Extreme {
        name: "aspect-100",
        what: "cells of 1 : 100, waves along the long and along the short edge",
        required: "the same of a bar along either edge",
        cause: None,
        judge: aspect,
    },
    Extreme {
        name: "one-cell-across",
        what: "a mesh of one cell across between walls, in the plane and in space",
        required: "the period of a bar; in space the motion of the plane",
        cause: None,
        judge: one_cell_across,
    },
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
        let mut scene = Scene::new(self.dimension, mesh, 1.0);
        scene.materials = material("elastic", 1.0, soft());
        scene.results = NO_RESULTS;
        scene.bodies = vec![filled(self.dimension, 1, cuboid([0.0; 3], far))];
        scene.bodies[0].particles_per_cell[..axes].fill(self.particles_per_cell);
        scene
    }

    fn initial(&self) -> InitialField {
        let (axis, length) = (self.axis, self.length());
        Arc::new(move |x| {
            let k = PI / length;
            let mut state = InitialState { ..AT_REST };
            // Small strains: a ten thousandth of the speed of the waves.
            state.velocity[axis] = 1e-4 * libm::sin(k * x[axis]);
            state.velocity_gradient[axis][axis] = 1e-4 * k * libm::cos(k * x[axis]);
            state
        })
    }

    /// Share of the first mode in the velocities, times its norm.
    fn mode(&self, simulation: &Simulation) -> f64 {
        let k = PI / self.length();
        let seen = particles(simulation);
        seen.iter()
            .map(|seen| libm::sin(k * seen.position[self.axis]) * seen.velocity[self.axis])
            .sum()
    }

    /// Relative error of a quarter of the period, and the highest energy over that at the start.
    fn swing(&self, method: Method) -> Result<[f64; 2], Unexpected> {
        let what = format!(
            "{method}, cells of {:?} m, {} particles per cell and axis",
            self.edges, self.particles_per_cell
        );
        let scene = with(&self.scene(), method);
        let mut simulation = start(&what, &scene, &from(self.initial()))?;
        let modulus = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
        // L/(2c), with a density of 1 kg/m³.
        let exact = 0.5 * self.length() / modulus.sqrt();
        let begin = simulation.kinetic_energy();
        let (mut before, mut highest) = ((0.0, self.mode(&simulation)), 1.0_f64);
        while simulation.time() < 2.0 * exact {
            let (kinetic, strain) = (simulation.kinetic_energy(), simulation.strain_energy());
            steps(&what, &mut simulation, 1)?;
            // Velocities are half a step before and after the strain.
            let mean = 0.5 * (kinetic + simulation.kinetic_energy());
            highest = highest.max((mean + strain) / begin);
            let now = (simulation.velocity_time(), self.mode(&simulation));
            if now.1 <= 0.0 {
                let zero = before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1);
                return Ok([(zero / exact - 1.0).abs(), highest]);
            }
            before = now;
        }
        // It never turned.
        Ok([f64::INFINITY, highest])
    }
}

/// Swings bars with some methods and takes the worst.
fn gates(bars: &[Bar], methods: &[Method]) -> Result<Vec<Gate>, Unexpected> {
    let mut worst = [0.0_f64; 2];
    for bar in bars {
        for &method in methods {
            for (worst, found) in worst.iter_mut().zip(bar.swing(method)?) {
                *worst = if found.is_nan() {
                    f64::INFINITY
                } else {
                    worst.max(found)
                };
            }
        }
    }
    let kh = PI / LENGTH as f64;
    Ok(vec![
        Gate::at_most(
            "period of a bar of ten cells, relative error".to_owned(),
            worst[0],
            kh * kh / 3.0,
            "a quadratic B-spline, the widest function, is a filter of variance h²/4; a step applies it four times, which \
             costs (kh)²/4 of the frequency; the time step and few particles may cost a third of that again",
        ),
        Gate::at_most(
            "highest energy over that at the start".to_owned(),
            worst[1],
            1.0 + kh * kh,
            "none is given; strain energy beside the mean of the kinetic energies half a step before and after, and the filter, are \
             of order (kh)²",
        ),
    ])
}

fn particles_per_cell() -> Result<Finding, Unexpected> {
    let plane = [1, 2, 4, 8].map(|n| (Dimension::Two, n));
    let space = [1, 2, 4].map(|n| (Dimension::Three, n));
    let bars: Vec<Bar> = plane
        .into_iter()
        .chain(space)
        .map(|(dimension, particles_per_cell)| Bar {
            particles_per_cell,
            across: 1,
            ..Bar::new(dimension)
        })
        .collect();
    Ok(Finding {
        gates: gates(&bars, &METHODS)?,
        refusals: vec![],
    })
}

fn aspect() -> Result<Finding, Unexpected> {
    let of = |dimension, axis, edges| Bar {
        axis,
        edges,
        ..Bar::new(dimension)
    };
    let bars = [
        of(Dimension::Two, 0, [1.0, 0.01, 1.0]),
        of(Dimension::Two, 1, [1.0, 0.01, 1.0]),
        of(Dimension::Three, 1, [1.0, 0.01, 0.1]),
        of(Dimension::Three, 2, [1.0, 1.0, 0.01]),
    ];
    Ok(Finding {
        gates: gates(&bars, &METHODS)?,
        refusals: vec![],
    })
}

/// A block that turns and breathes in an open plane, or between two walls a cell apart that make a plane of space.
fn flat(dimension: Dimension) -> Scene {
    let mut scene = open(dimension, [10, 10, 1], soft());
    let deep = if dimension == Dimension::Two {
        0.0
    } else {
        1.0
    };
    if dimension == Dimension::Three {
        scene.mesh.planes[2].fill(PlaneCondition::Sliding);
    }
    let shape = cuboid([3.2, 3.3, 0.0], [6.2, 6.3, deep]);
    scene.bodies = vec![filled(dimension, 1, shape)];
    scene
}

fn one_cell_across() -> Result<Finding, Unexpected> {
    let across = |dimension| Bar {
        across: 1,
        ..Bar::new(dimension)
    };
    let mut gates = gates(
        &[across(Dimension::Two), across(Dimension::Three)],
        &METHODS,
    )?;
    let gradient = [[0.02, -0.03, 0.0], [0.03, -0.01, 0.0], [0.0; 3]];
    let initial: InitialField = Arc::new(move |x| InitialState {
        velocity: std::array::from_fn(|a| (0..2).map(|b| gradient[a][b] * (x[b] - 4.7)).sum()),
        velocity_gradient: gradient,
        ..AT_REST
    });
    let mut worst = 0.0_f64;
    for method in methods() {
        // Round-off at nodes of next to no mass is multiplied in each step, and is no matter of the walls.
        if !method.has_safe_step()
            || method.scheme == StressScheme::Usl && method.transfer != METHODS[0].transfer
        {
            continue;
        }
        let what = format!("{method}, a plane in space");
        let run = |dimension| -> Result<Simulation, Unexpected> {
            let scene = with(&flat(dimension), method);
            let mut simulation = start(&what, &scene, &from(Arc::clone(&initial)))?;
            steps(&what, &mut simulation, 40)?;
            Ok(simulation)
        };
        let (plane, space) = (run(Dimension::Two)?, run(Dimension::Three)?);
        let plane = particles(&plane);
        for seen in particles(&space) {
            // Two layers of particles lie over those of the plane.
            let near = |other: &&super::runs::Seen| {
                (0..2).all(|axis| (other.position[axis] - seen.position[axis]).abs() < 1e-3)
            };
            let Some(same) = plane.iter().find(near) else {
                worst = f64::INFINITY;
                continue;
            };
            let lateral = |x: &[f64; 3]| [x[0], x[1], 0.0];
            worst = worst
                .max(apart([&lateral(&seen.position)], [&lateral(&same.position)]) / 10.0)
                .max(apart([&seen.velocity], [&same.velocity]) / 0.1)
                .max(apart([&seen.stress], [&same.stress]) / 0.1);
        }
    }
    gates.push(Gate::at_most(
        "a cell of space between two walls against plane strain, relative".to_owned(),
        worst,
        1e-12,
        "both are plane strain; 40 steps of a hundred roundings each, with a node's mass as little as a hundredth",
    ));
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
