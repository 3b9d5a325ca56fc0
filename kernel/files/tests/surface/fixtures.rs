//! The surfaces of the fixtures: made from formulas, byte for byte; and the scenes that use them.

use crate::surface::slope::{Slope, dot};
use proctor_files::json::read;
use proctor_files::stl;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{Scene, StressScheme, Vector};
use std::fmt::Write;
use std::path::{Path, PathBuf};

fn fixture(name: &str) -> PathBuf {
    Path::new("../../fixtures").join(name)
}

/// Compares a fixture with its formula. `WRITE_FIXTURES` in the environment writes it instead.
fn compare(name: &str, bytes: &[u8]) {
    let path = fixture(name);
    if std::env::var_os("WRITE_FIXTURES").is_some() {
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, bytes).expect("written");
    }
    let found = std::fs::read(&path).expect("the fixture");
    assert!(found == bytes, "{name} is not what its formula gives");
}

fn ascii(name: &str, triangles: &[[Vector; 3]]) -> String {
    let mut text = format!("solid {name}\n");
    for corners in triangles {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in corners {
            writeln!(text, "vertex {x} {y} {z}").expect("memory");
        }
        text.push_str("endloop\nendfacet\n");
    }
    writeln!(text, "endsolid {name}").expect("memory");
    text
}

fn binary(triangles: &[[Vector; 3]]) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        bytes.extend(
            corners
                .iter()
                .flatten()
                .flat_map(|x| (*x as f32).to_le_bytes()),
        );
        bytes.extend([0; 2]);
    }
    bytes
}

/// The plane z = 3 m - x tan 30, from x = 0 to 4.5 m.
fn slope() -> Vec<[Vector; 3]> {
    let low = 3.0 - 4.5 / 3.0_f64.sqrt();
    let (a, b) = ([0.0, -0.5, 3.0], [4.5, -0.5, low]);
    let (c, d) = ([4.5, 0.75, low], [0.0, 0.75, 3.0]);
    vec![[a, b, c], [a, c, d]]
}

/// A bowl of 2.4 m with bumps of 4 cm, in integers, so that every machine makes the same bytes.
fn terrain() -> Vec<[Vector; 3]> {
    let x = |i: i32, j: i32| -> Vector {
        let bump = f64::from((7 * i + 11 * j + 3 * i * j).rem_euclid(13) - 6) / 6.0;
        let bowl = f64::from((i - 8).pow(2) + (j - 8).pow(2)) / 64.0;
        [
            0.15 * f64::from(i) - 0.2,
            0.15 * f64::from(j) - 0.2,
            0.4 + 0.02 * bump + 0.1 * bowl,
        ]
    };
    let squares = (0..16).flat_map(|i| (0..16).map(move |j| (i, j)));
    squares
        .flat_map(|(i, j)| {
            let (a, b, c, d) = (x(i, j), x(i + 1, j), x(i + 1, j + 1), x(i, j + 1));
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// Particles of a block on the slope, 1 m long, 0.25 m wide and 0.5 m high, a sixteenth of a metre apart.
fn block() -> String {
    let angle = 30.0_f64.to_radians();
    let (t, n) = ([angle.cos(), -angle.sin()], [angle.sin(), angle.cos()]);
    let step = 0.0625;
    let mut text = String::from("x,y,z,volume\n");
    for (i, j, k) in (0..16).flat_map(|i| (0..4).flat_map(move |j| (0..8).map(move |k| (i, j, k))))
    {
        let [a, y, b] = [i, j, k].map(|i| (f64::from(i) + 0.5) * step);
        let (x, z) = (
            0.6 + a * t[0] + b * n[0],
            3.0 - 0.6 / 3.0_f64.sqrt() + a * t[1] + b * n[1],
        );
        writeln!(text, "{x:.9},{y},{z:.9},{}", step * step * step).expect("memory");
    }
    text
}

#[test]
fn the_files_are_what_their_formulas_give() {
    compare("surfaces/slope.stl", ascii("slope", &slope()).as_bytes());
    compare("surfaces/terrain.stl", &binary(&terrain()));
    let degenerate = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]];
    compare(
        "surfaces/degenerate.stl",
        ascii("degenerate", &[slope()[0], degenerate]).as_bytes(),
    );
    compare("records/tilted_block.csv", block().as_bytes());
}

#[test]
fn the_surfaces_are_sound_and_open() {
    let slope = stl::read(&fixture("surfaces/slope.stl")).expect("sound");
    assert_eq!(slope.open_edges().map(|o| o.count), Some(4));
    let terrain = stl::read(&fixture("surfaces/terrain.stl")).expect("sound");
    assert_eq!(
        (terrain.triangle_count(), terrain.vertex_count()),
        (512, 289)
    );
    assert_eq!(terrain.open_edges().map(|o| o.count), Some(64));
}

fn run(scene: &Scene, mut after: impl FnMut(&Simulation)) -> Simulation {
    let options = Options {
        threads: Some(1),
        ..Options::default()
    };
    let mut simulation = Simulation::new(scene, &options).expect("a scene that can start");
    while simulation.time() < scene.time {
        simulation.step(scene.time).expect("a step");
        after(&simulation);
    }
    simulation
}

#[test]
fn the_sliding_block_of_the_fixtures() {
    let scene = read(&fixture("scenes/sliding_block.json")).expect("a sound scene");
    let begin = Simulation::new(&scene, &Options::default())
        .expect("a start")
        .center(0)
        .position;
    let simulation = run(&scene, |_| {});
    let end = simulation.center(0).position;
    let slope = Slope::new(StressScheme::Usl, scene.surfaces[0].friction);
    let moved = std::array::from_fn(|axis| end[axis] - begin[axis]);
    let way = dot(&moved, &slope.down());
    // Gravity of 9.81 m/s² along z, at 30 degrees to the normal.
    let angle = 30.0_f64.to_radians();
    let exact = 0.5 * 9.81 * (angle.sin() - slope.friction * angle.cos()) * scene.time.powi(2);
    assert!((way / exact - 1.0).abs() < 0.01, "{way} {exact}");
}

/// A sphere at one and at ten times its speed: no particle goes deeper than half a cell, in any step.
#[test]
fn a_sphere_falls_on_the_terrain() {
    for factor in [1.0, 10.0] {
        for scheme in [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl] {
            let mut scene = read(&fixture("scenes/sphere_on_terrain.json")).expect("a sound scene");
            scene.scheme = scheme;
            scene.bodies[0].velocity = scene.bodies[0].velocity.map(|v| factor * v);
            scene.time = 0.08;
            let h = scene.mesh.cell[0];
            let mut deepest = 0.0_f64;
            let simulation = run(&scene, |simulation| {
                for p in 0..simulation.particles() {
                    if let Some((gap, _)) = simulation.surface_gap(0, 0, p, h) {
                        deepest = deepest.min(gap);
                    }
                }
            });
            println!(
                "{scheme:?}, {factor} times the speed: deepest {:.2e} cells",
                deepest / h
            );
            assert!(
                deepest > -0.5 * h,
                "{scheme:?} {factor}: {} cells",
                deepest / h
            );
            let impulse = simulation.surface_impulse(0, 0);
            assert!(impulse[2] > 0.0, "it never touched");
        }
    }
}
