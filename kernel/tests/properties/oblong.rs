//! Cells that are no cubes: what is per cell along an axis takes the edge along that axis.

use crate::common::{
    APIC, DENSITY, DIMENSIONS, NEVER, SCHEMES, TPIC, YOUNG, body, cuboid, empty, particles,
    simulation, simulation_from, weightings_and_schemes,
};
use proctor_kernel::grid::{ActiveRows, GridShape, Nodes};
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::layout::{Layout, Optional};
use proctor_kernel::particles::ParticleSet;
use proctor_kernel::sorting::Sorter;
use proctor_kernel::stage::Mapping;
use proctor_kernel::stage::p2g::{self, Carry, P2g};
use proctor_kernel::team::Team;
use proctor_kernel::weights::Family;
use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{Dimension, Scene, StressScheme, Traction, Vector};
use std::sync::Arc;

/// Edges of a cell \[m\].
const EDGES: [f64; 3] = [0.1, 0.2, 0.05];

/// A block off the nodes of a mesh of such cells.
fn block(dimension: Dimension) -> Scene {
    let mut scene = empty(dimension, [9, 8, 7], 0.1);
    let axes = dimension.axes();
    scene.mesh.cell[..axes].copy_from_slice(&EDGES[..axes]);
    scene.bodies = vec![body(1, cuboid([0.21, 0.42, 0.12], [0.61, 1.02, 0.24]))];
    scene
}

/// A velocity gradient \[1/s\] without any symmetry.
fn gradient(dimension: Dimension, size: f64) -> [[f64; 3]; 3] {
    let axes = dimension.axes();
    let full = [[0.3, -0.7, 0.2], [0.5, 0.4, -0.6], [-0.1, 0.8, -0.2]];
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            if a < axes && b < axes {
                size * full[a][b]
            } else {
                0.0
            }
        })
    })
}

fn times(a: &[[f64; 3]; 3], x: &Vector) -> Vector {
    std::array::from_fn(|i| (0..3).map(|j| a[i][j] * x[j]).sum())
}

/// The velocity A x.
fn linear(a: [[f64; 3]; 3]) -> InitialField {
    Arc::new(move |x| InitialState {
        velocity: times(&a, x),
        velocity_gradient: a,
        ..InitialState::default()
    })
}

/// A linear velocity lies in the space of the functions: an affine transfer gives it back, with its gradient, and the
/// volume changes by det(1 + dt A).
#[test]
fn a_linear_velocity_is_carried_to_round_off() {
    for dimension in DIMENSIONS {
        let a = gradient(dimension, 1.0);
        for (weighting, scheme) in weightings_and_schemes() {
            for transfer in [APIC, TPIC] {
                let mut scene = block(dimension);
                (scene.weighting, scene.scheme, scene.transfer) = (weighting, scheme, transfer);
                let what = format!("{dimension:?} {weighting:?} {scheme:?} {transfer:?}");
                let mut simulation = simulation_from(&scene, linear(a));
                let before = particles(&simulation);
                let volume = simulation.particle_volume(0, 0);
                let dt = simulation.step(NEVER).expect("the step is sound").dt;
                let set = &simulation.sets()[0];
                let affine = set.layout.affine.expect("it is carried");
                let axes = dimension.axes();
                let f = stretch(&a, dt);
                for p in 0..set.len() {
                    let exact = times(&a, &before[set.id[p] as usize].1);
                    let v = set.velocity(p);
                    assert!(
                        crate::common::distance(&v, &exact) < 1.0e-12,
                        "{what}: {v:?} {exact:?}"
                    );
                    for i in 0..axes {
                        for j in 0..axes {
                            let found = set.columns[affine + i * axes + j][p];
                            assert!(
                                (found - a[i][j]).abs() < 1.0e-10,
                                "{what}: {i}{j} {found} {}",
                                a[i][j]
                            );
                        }
                    }
                    // USF strains at the new positions, where this velocity is not linear to round-off any more.
                    if scheme != StressScheme::Usf {
                        let ratio = simulation.particle_volume(0, p) / volume;
                        assert!((ratio - f).abs() < 1.0e-12, "{what}: {ratio} {f}");
                    }
                }
            }
        }
    }
}

/// det(1 + dt A).
fn stretch(a: &[[f64; 3]; 3], dt: f64) -> f64 {
    let m: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| dt * a[i][j] + if i == j { 1.0 } else { 0.0 })
    });
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
}

/// The critical step is C min(h)/(c + |v|) with the fastest particle and c² = M V/m, which follows the volume; no particle
/// crosses more than half of a cell.
#[test]
fn the_critical_step_knows_the_smallest_edge_the_speed_and_the_volume() {
    let modulus = YOUNG * (1.0 - 0.3) / ((1.0 + 0.3) * (1.0 - 2.0 * 0.3));
    for dimension in DIMENSIONS {
        let axes = dimension.axes();
        let h = EDGES[..axes].iter().copied().fold(f64::INFINITY, f64::min);
        for scheme in SCHEMES {
            let mut scene = block(dimension);
            scene.scheme = scheme;
            // As fast as the waves, and in the first step the volume changes by a hundredth.
            let mut simulation = simulation_from(&scene, linear(gradient(dimension, 50.0)));
            let mut volumes = 0.0_f64;
            for step in 0..3 {
                let (mut speed, mut wave) = (0.0_f64, 0.0_f64);
                for p in 0..simulation.particles() {
                    let v = simulation.sets()[0].velocity(p);
                    let (mass, volume) = (
                        simulation.particle_mass(0, p),
                        simulation.particle_volume(0, p),
                    );
                    speed = speed.max((v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt());
                    wave = wave.max((modulus * volume / mass).sqrt());
                    volumes = volumes.max((volume * DENSITY / mass - 1.0).abs());
                }
                let exact =
                    (simulation.stability_number() * h / (wave + speed)).min(0.5 * h / speed);
                let found = simulation
                    .step(NEVER)
                    .expect("the step is sound")
                    .dt_critical;
                assert!(
                    (found / exact - 1.0).abs() < 1.0e-12,
                    "{dimension:?} {scheme:?} step {step}: {found} {exact}"
                );
            }
            assert!(volumes > 1.0e-3, "{volumes}");
        }
    }
}

/// The sum of x_I (x) m grad S_I over the nodes is the mass times unity, since the functions reproduce positions.
#[test]
fn the_mass_gradient_has_the_moment_of_the_mass() {
    for dimension in DIMENSIONS {
        let axes = dimension.axes();
        let scene = block(dimension);
        let shape = GridShape::new(&scene.mesh, dimension);
        for stencil in [3, 4] {
            let layout = Layout::new(axes, Optional::default(), &[]);
            let mut set = ParticleSet::zeros(layout, 0, 23);
            for p in 0..set.len() {
                set.columns[Layout::MASS][p] = 1.0 + p as f64;
                for axis in 0..axes {
                    let share = (0.37 * (p + 1) as f64 * (axis + 1) as f64).fract();
                    set.columns[Layout::POSITION + axis][p] =
                        share * scene.mesh.cells[axis] as f64 * EDGES[axis];
                }
            }
            let mass: f64 = set.columns[Layout::MASS].iter().sum();
            Sorter::default().sort(
                std::slice::from_mut(&mut set),
                &shape,
                (Family::Gimp, stencil),
                SelectedLanes::any(),
                &Team::ALONE,
                &mut ActiveRows::default(),
            );
            let half_length = if stencil == 3 { 0.3 } else { 0.7 };
            let mapping = Mapping::new(&shape, Family::Gimp, [half_length; 3], None);
            let mut nodes = Nodes::new(shape.nodes.iter().product());
            p2g::instance(axes, false, stencil, false, Carry::MassGradient)(
                SelectedLanes::any(),
                P2g {
                    columns: &set.columns,
                    layout: &set.layout,
                    mapping: &mapping,
                    layers: &mut (0..shape.bases()[0])
                        .map(|layer| (set.in_layers(layer..layer + 1), true)),
                    planes: 0..shape.nodes[0],
                    nodes: nodes.lines_mut(),
                    carry: Carry::MassGradient,
                    viscous_rate: 0.0,
                },
            );
            if axes == 2 {
                nodes.lines_mut().iter_mut().for_each(p2g::join);
            }
            for a in 0..axes {
                for b in 0..axes {
                    let lines = nodes.lines().iter().enumerate();
                    let found: f64 = lines
                        .map(|(node, line)| line[4 + a] * shape.position(node)[b])
                        .sum();
                    let exact = if a == b { mass } else { 0.0 };
                    assert!(
                        (found - exact).abs() < 1.0e-10 * mass,
                        "{dimension:?} {stencil} nodes, {a}{b}: {found} {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_traction_gives_area_times_traction() {
    for dimension in DIMENSIONS {
        let three = dimension == Dimension::Three;
        let mut scene = block(dimension);
        // Whole cells, so that the nodes of the surface carry mass.
        scene.bodies = vec![body(1, cuboid([0.2, 0.4, 0.1], [0.7, 1.0, 0.3]))];
        let traction = [30.0, -70.0, if three { 20.0 } else { 0.0 }];
        scene.tractions = vec![Traction {
            p1: [0.25, 1.0, if three { 0.12 } else { 0.0 }],
            p2: [0.62, 1.0, if three { 0.27 } else { 0.0 }],
            traction: traction.into(),
        }];
        let area = 0.37 * if three { 0.15 } else { 1.0 };
        let mut simulation = simulation(&scene);
        let dt = simulation.step(NEVER).expect("the step is sound").dt;
        for (axis, p) in simulation.momentum().iter().enumerate() {
            let (force, exact) = (p / (0.5 * dt), traction[axis] * area);
            assert!(
                (force - exact).abs() < 1.0e-12 * 70.0 * area,
                "{dimension:?} {axis}: {force} {exact}"
            );
        }
    }
}
