//! The scenes that are measured, made for a wanted number of particles.
//!
//! They are written in the language of scene files, so that any other program that reads it can run the same scene.
//! A new one is one more entry of [`BUILT_IN`].

use proctor_kernel::scene::Vector;
use proctor_verification::exact::sudden_weight::SuddenWeight;
use proctor_verification::random::Random;
use serde_json::{Value, json};

/// Cell size of every built-in scene \[m\].
const H: f64 = 0.1;
/// Young's modulus \[Pa\], density \[kg/m³\] and Poisson's ratio of the material.
const YOUNG: f64 = 1.0e6;
const DENSITY: f64 = 1000.0;
const POISSON: f64 = 0.3;
/// c dt / h of the constant time step, c with the speed of the particles: below the bound of every combination of
/// scheme, weighting function and transfer that has one, so that all of them do the same steps.
const COURANT: f64 = 0.3;
/// Steps after which a scene is over: what moves stays clear of the walls until then.
const STEPS: f64 = 40.0;
/// Empty cells around a body that must not touch a wall.
const MARGIN: usize = 3;

/// Exact displacement \[m\] of the particle that began at a position \[m\], at a time \[s\].
pub type Exact = Box<dyn Fn(&Vector, f64) -> Vector + Send + Sync>;

/// A scene with its answer, where it has one.
pub struct Made {
    /// The scene, as in a scene file.
    pub scene: Value,
    /// Its exact solution: where it comes from, and the displacement.
    pub exact: Option<(&'static str, Exact)>,
}

/// A built-in scene.
pub struct BuiltIn {
    /// Name in configurations: `NAME-2d` or `NAME-3d`.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    make: fn(&Block) -> Made,
}

/// All built-in scenes.
pub const BUILT_IN: &[BuiltIn] = &[
    BuiltIn {
        name: "rest",
        what: "a block at rest, clear of all walls",
        make: rest,
    },
    BuiltIn {
        name: "moving",
        what: "a block that flies through four cells in 40 steps",
        make: moving,
    },
    BuiltIn {
        name: "disordered",
        what: "the moving block, its particles sheared and jittered by half of their distance",
        make: disordered,
    },
    BuiltIn {
        name: "sheared",
        what: "a block on a fixed base, sheared by its weight sideways",
        make: sheared,
    },
    BuiltIn {
        name: "sparse",
        what: "the moving block in a mesh 64 times too large",
        make: sparse,
    },
    BuiltIn {
        name: "column",
        what: "a confined column whose weight acts suddenly; exact solution known",
        make: column,
    },
    BuiltIn {
        name: "contact",
        what: "a block on a fixed base and one that slides on it",
        make: contact,
    },
];

/// Names of all built-in scenes with their dimension.
pub fn names() -> impl Iterator<Item = String> {
    BUILT_IN
        .iter()
        .flat_map(|scene| [2, 3].map(|axes| format!("{}-{axes}d", scene.name)))
}

/// The built-in scene of a name such as `moving-3d`, and its number of axes.
#[must_use]
pub fn find(name: &str) -> Option<(&'static BuiltIn, usize)> {
    let (name, axes) = match name.rsplit_once('-')? {
        (name, "2d") => (name, 2),
        (name, "3d") => (name, 3),
        _ => return None,
    };
    let scene = BUILT_IN.iter().find(|scene| scene.name == name)?;
    Some((scene, axes))
}

impl BuiltIn {
    /// The scene with about `particles` particles, two per cell and axis, in `axes` dimensions.
    #[must_use]
    pub fn make(&self, axes: usize, particles: usize) -> Made {
        let slender = if self.name == "column" { 4.0 } else { 1.0 };
        (self.make)(&Block::new(axes, particles, slender))
    }
}

/// A block of whole cells that holds about the wanted number of particles.
struct Block {
    axes: usize,
    cells: Vec<usize>,
}

impl Block {
    /// `slender` is the height over the width.
    fn new(axes: usize, particles: usize, slender: f64) -> Self {
        let wanted = particles as f64 / f64::from(1 << axes);
        let width = (wanted / slender).powf(1.0 / axes as f64).round().max(1.0);
        let base = width.powi(axes as i32 - 1);
        let mut cells = vec![width as usize; axes - 1];
        cells.push((wanted / base).round().max(1.0) as usize);
        Self { axes, cells }
    }

    /// A scene with this block, its lower corner `below` cells above that of the mesh, `above` cells of room on the
    /// other side, all times `larger`.
    fn scene(&self, below: &[usize], above: &[usize], larger: usize, velocity: &[f64]) -> Value {
        let room = |axis: usize| (below[axis] + self.cells[axis] + above[axis]) * larger;
        let corner = |axis: usize| below[axis] as f64 * H;
        let lower: Vec<f64> = (0..self.axes).map(corner).collect();
        let upper: Vec<f64> = (0..self.axes)
            .map(|axis| (below[axis] + self.cells[axis]) as f64 * H)
            .collect();
        let speed = velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
        let dt = COURANT * H / (wave_speed() + speed);
        json!({
            "dimension": self.axes,
            "time": STEPS * dt,
            "time_step": dt,
            "particles_per_cell": 2,
            "results": { "print": 1, "fields": ["id", "displacement", "velocity"] },
            "mesh": {
                "cells_dimension": vec![H; self.axes],
                "cells_number": (0..self.axes).map(room).collect::<Vec<_>>(),
                "origin": vec![0.0; self.axes],
            },
            "material": [{
                "type": "elastic", "id": 1, "young": YOUNG, "density": DENSITY, "poisson": POISSON,
            }],
            "body": [{
                "type": "cuboid", "id": 1, "material_id": 1,
                "point_p1": lower, "point_p2": upper, "initial_velocity": velocity,
            }],
        })
    }
}

/// Speed of compression waves \[m/s\], c² = E (1 - ν) / (ρ (1 + ν) (1 - 2 ν)).
fn wave_speed() -> f64 {
    let modulus = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    (modulus / DENSITY).sqrt()
}

fn rest(block: &Block) -> Made {
    let margin = [MARGIN; 3];
    let scene = block.scene(&margin, &margin, 1, &vec![0.0; block.axes]);
    Made { scene, exact: None }
}

/// Velocity of the moving block \[m/s\].
const FLIGHT: [f64; 3] = [20.0, 10.0, 5.0];

fn flying(block: &Block, larger: usize) -> Made {
    let above = [MARGIN + 5; 3];
    let scene = block.scene(&[MARGIN; 3], &above, larger, &FLIGHT[..block.axes]);
    let axes = block.axes;
    let exact: Exact = Box::new(move |_, t| {
        std::array::from_fn(|axis| if axis < axes { FLIGHT[axis] * t } else { 0.0 })
    });
    Made {
        scene,
        exact: Some(("free flight, u = v t", exact)),
    }
}

fn moving(block: &Block) -> Made {
    flying(block, 1)
}

fn sparse(block: &Block) -> Made {
    // 8² = 4³ = 64.
    flying(block, if block.axes == 2 { 8 } else { 4 })
}

/// Seed of the places of its particles.
const SEED: u64 = 2026;
/// How far the particles of the disordered block are displaced along the first axis, per height.
const SHEAR: f64 = 0.5;

fn disordered(block: &Block) -> Made {
    let mut made = flying(block, 1);
    let axes = block.axes;
    let distance = H / 2.0;
    let number: Vec<usize> = block.cells.iter().map(|cells| 2 * cells).collect();
    let up = axes - 1;
    let lean = SHEAR * block.cells[up] as f64 * H;
    let mut random = Random::new(SEED);
    let particles: Vec<Value> = (0..number.iter().product())
        .map(|p| {
            let mut rest = p;
            let mut x: Vec<f64> = number
                .iter()
                .map(|&along| {
                    let place = (rest % along) as f64 + 0.5 + (random.unit() - 0.5);
                    rest /= along;
                    MARGIN as f64 * H + place * distance
                })
                .collect();
            x[0] += SHEAR * (x[up] - MARGIN as f64 * H);
            x.push(distance.powi(axes as i32));
            x.into()
        })
        .collect();
    let body = &made.scene["body"][0];
    made.scene["body"] = json!([{
        "type": "particles", "id": 1, "material_id": 1, "particles": particles,
        "initial_velocity": body["initial_velocity"],
    }]);
    let cells = &mut made.scene["mesh"]["cells_number"][0];
    *cells = (cells.as_u64().unwrap_or(0) + (lean / H).ceil() as u64).into();
    made
}

fn sheared(block: &Block) -> Made {
    let (mut below, mut above) = ([MARGIN; 3], [MARGIN + 1; 3]);
    let up = block.axes - 1;
    (below[up], above[up]) = (0, MARGIN);
    let mut scene = block.scene(&below, &above, 1, &vec![0.0; block.axes]);
    let mut gravity = vec![0.0; block.axes];
    // The free parts reach 6 m/s and move by nine tenths of a cell in 40 steps.
    gravity[0] = 180.0;
    scene["gravity"] = gravity.into();
    let plane = ["plane_Y0", "plane_Z0"][block.axes - 2];
    scene["mesh"]["boundary_conditions"] = json!({ plane: "fixed" });
    Made { scene, exact: None }
}

fn column(block: &Block) -> Made {
    let mut above = [0; 3];
    let up = block.axes - 1;
    above[up] = 2;
    let mut scene = block.scene(&[0; 3], &above, 1, &vec![0.0; block.axes]);
    let height = block.cells[up] as f64 * H;
    let c = wave_speed();
    // A strain of 1e-3 at the base: large enough for round-off, small enough for small strains.
    let weight = SuddenWeight {
        height,
        wave_speed: c,
        gravity: 1e-3 * c * c / height,
    };
    let mut gravity = vec![0.0; block.axes];
    gravity[up] = -weight.gravity;
    scene["gravity"] = gravity.into();
    // Until the wave from the base has come to the top.
    scene["time"] = (height / c).into();
    let exact: Exact = Box::new(move |x, t| {
        let mut u = [0.0; 3];
        u[up] = weight.displacement(x[up], t);
        u
    });
    Made {
        scene,
        exact: Some(("sudden weight, d'Alembert", exact)),
    }
}

/// Coefficient of friction between the two blocks, and the speed of the upper one \[m/s\].
const FRICTION: f64 = 0.3;
const SLIDE: f64 = 2.0;

fn contact(block: &Block) -> Made {
    let up = block.axes - 1;
    let mut cells = block.cells.clone();
    // Each of the two is one cell high at least.
    cells[up] = cells[up].max(2);
    let block = &Block {
        axes: block.axes,
        cells,
    };
    let (mut below, above) = ([MARGIN; 3], [MARGIN; 3]);
    below[up] = 0;
    let mut slide = vec![0.0; block.axes];
    slide[0] = SLIDE;
    let mut scene = block.scene(&below, &above, 1, &slide);
    let mut gravity = vec![0.0; block.axes];
    gravity[up] = -10.0;
    scene["gravity"] = gravity.into();
    let plane = ["plane_Y0", "plane_Z0"][up - 1];
    scene["mesh"]["boundary_conditions"] = json!({ plane: "fixed" });
    let middle = (block.cells[up] / 2) as f64 * H;
    let mut upper = scene["body"][0].clone();
    upper["id"] = 2.into();
    upper["point_p1"][up] = middle.into();
    let lower = &mut scene["body"][0];
    lower["point_p2"][up] = middle.into();
    lower["initial_velocity"] = vec![0.0; block.axes].into();
    if let Some(bodies) = scene["body"].as_array_mut() {
        bodies.push(upper);
    }
    scene["contact"] = json!([{
        "id": 1, "friction": FRICTION, "master_id": 1, "slave_id": 2, "normal_type": "collinear",
    }]);
    Made { scene, exact: None }
}
