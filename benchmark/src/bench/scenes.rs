//! The scenes that are measured, made for a wanted number of particles.
//!
//! They are written in the language of scene files, so that any other program that reads it can run the same scene.
//! A new one is one more entry of [`BUILT_IN`].

mod touching;
mod wet;
mod yielding;

use proctor_scene::Vector;
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
/// Particles of a scene in which there is little to share out.
const TINY: usize = 1000;
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
    /// Description of the scene.
    pub what: &'static str,
    /// Numbers of axes in which it can be made.
    pub axes: &'static [usize],
    /// Its number of particles, where it has one of its own.
    pub particles: Option<usize>,
    /// True where its axes are radius and height.
    revolved: bool,
    make: fn(&Block) -> Made,
}

/// A scene in the plane and in space, of as many particles as are wanted.
const fn built_in(name: &'static str, what: &'static str, make: fn(&Block) -> Made) -> BuiltIn {
    BuiltIn {
        name,
        what,
        axes: &[2, 3],
        particles: None,
        revolved: false,
        make,
    }
}

/// A scene of the plane whose axes are radius and height.
const fn revolved(name: &'static str, what: &'static str, make: fn(&Block) -> Made) -> BuiltIn {
    BuiltIn {
        axes: &[2],
        revolved: true,
        ..built_in(name, what, make)
    }
}

/// All built-in scenes.
pub const BUILT_IN: &[BuiltIn] = &[
    built_in("rest", "a block at rest, clear of all walls", rest),
    built_in(
        "moving",
        "a block that flies through four cells in 40 steps",
        moving,
    ),
    built_in(
        "disordered",
        "the moving block, its particles sheared and jittered by half of their distance",
        disordered,
    ),
    built_in(
        "wide",
        "the moving block, its particles a little wider than a cell",
        wide,
    ),
    built_in(
        "sheared",
        "a block on a fixed base, sheared by its weight sideways",
        sheared,
    ),
    built_in(
        "sparse",
        "the moving block in a mesh 64 times too large",
        sparse,
    ),
    built_in(
        "column",
        "a confined column whose weight acts suddenly; exact solution known",
        column,
    ),
    built_in(
        "contact",
        "a block on a fixed base and one that slides on it",
        touching::contact,
    ),
    BuiltIn {
        particles: Some(TINY),
        ..built_in("tiny", "the moving block of a thousand particles", moving)
    },
    built_in(
        "mixed",
        "a block on a fixed base, and two on it that touch each other and slide",
        touching::mixed,
    ),
    BuiltIn {
        axes: &[3],
        ..built_in(
            "stl",
            "a block that slides on a rigid surface of triangles",
            touching::stl,
        )
    },
    built_in(
        "mortar",
        "a block on a fixed base and one that slides on it, in mortar contact",
        touching::mortar,
    ),
    built_in(
        "consolidation",
        "a layer of soil and water that settles under its weight and drains at its top",
        wet::consolidation,
    ),
    built_in(
        "consolidation_dry",
        "the layer without its water, with the same steps",
        wet::dry,
    ),
    built_in(
        "slabs-elastic",
        "a block of slabs that slide along each other and share a velocity where they meet, all of it sheared",
        |block| yielding::slabs(block, "elastic", false),
    ),
    built_in(
        "slabs-von_mises-below",
        "the slabs with a yield surface that no particle reaches",
        |block| yielding::slabs(block, "von_mises", false),
    ),
    built_in(
        "slabs-von_mises-yields",
        "the slabs with one that all particles are beyond",
        |block| yielding::slabs(block, "von_mises", true),
    ),
    built_in(
        "slabs-drucker_prager-below",
        "the slabs with a yield surface that no particle reaches",
        |block| yielding::slabs(block, "drucker_prager", false),
    ),
    built_in(
        "slabs-drucker_prager-yields",
        "the slabs with one that all particles are beyond",
        |block| yielding::slabs(block, "drucker_prager", true),
    ),
    built_in(
        "slabs-mohr_coulomb-below",
        "the slabs with a yield surface that no particle reaches",
        |block| yielding::slabs(block, "mohr_coulomb", false),
    ),
    built_in(
        "slabs-mohr_coulomb-yields",
        "the slabs with one that all particles are beyond",
        |block| yielding::slabs(block, "mohr_coulomb", true),
    ),
    built_in(
        "slabs-cam_clay-below",
        "the slabs of a clay that has borne so much that no particle yields",
        |block| yielding::slabs(block, "cam_clay", false),
    ),
    built_in(
        "slabs-cam_clay-yields",
        "the slabs of a clay that has borne no more, and yields",
        |block| yielding::slabs(block, "cam_clay", true),
    ),
    revolved(
        "revolved",
        "the block at rest as a ring about an axis of revolution",
        rest,
    ),
    revolved(
        "slabs-elastic-revolved",
        "the slabs as rings about an axis of revolution",
        |block| yielding::slabs(block, "elastic", false),
    ),
    revolved(
        "slabs-von_mises-yields-revolved",
        "the slabs as rings, with a yield surface that all particles are beyond",
        |block| yielding::slabs(block, "von_mises", true),
    ),
];

/// Scenes without a configuration: each shows another cost. Single stages are measured in the first.
pub const USUAL: [&str; 12] = [
    "moving-3d",
    "rest-3d",
    "disordered-3d",
    "sheared-3d",
    "sparse-3d",
    "tiny-3d",
    "mixed-3d",
    "stl-3d",
    "mortar-3d",
    "moving-2d",
    "disordered-2d",
    "mortar-2d",
];

/// Names of all built-in scenes with their dimension.
pub fn names() -> impl Iterator<Item = String> {
    BUILT_IN.iter().flat_map(|scene| {
        let axes = scene.axes.iter();
        axes.map(|axes| format!("{}-{axes}d", scene.name))
    })
}

/// The built-in scene of a name such as `moving-3d`, and its number of axes.
#[must_use]
pub fn find(name: &str) -> Option<(&'static BuiltIn, usize)> {
    let (name, axes) = match name.rsplit_once('-')? {
        (name, "2d") => (name, 2),
        (name, "3d") => (name, 3),
        _ => return None,
    };
    let made = |scene: &&BuiltIn| scene.name == name && scene.axes.contains(&axes);
    let scene = BUILT_IN.iter().find(made)?;
    Some((scene, axes))
}

impl BuiltIn {
    /// The scene with about `particles` particles, or as many as it always has, two per cell and axis, in `axes`
    /// dimensions.
    #[must_use]
    pub fn make(&self, axes: usize, particles: usize) -> Made {
        let particles = self.particles.unwrap_or(particles);
        let slender = if self.name == "column" { 4.0 } else { 1.0 };
        let mut made = (self.make)(&Block::new(axes, particles, slender));
        if self.revolved {
            made.scene["mesh"]["axisymmetric"] = true.into();
        }
        made
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

    /// Particles of a list, as wide as that: the lattice, each coordinate moved by some of its distances, and sheared along the
    /// first axis by `shear` per height.
    fn particles(&self, width: f64, shear: f64, mut jitter: impl FnMut() -> f64) -> Value {
        let up = self.axes - 1;
        let number: Vec<usize> = self.cells.iter().map(|cells| 2 * cells).collect();
        (0..number.iter().product())
            .map(|p| {
                let mut rest = p;
                let mut x: Vec<f64> = number
                    .iter()
                    .map(|&along| {
                        let place = (rest % along) as f64 + 0.5 + jitter();
                        rest /= along;
                        MARGIN as f64 * H + place * (H / 2.0)
                    })
                    .collect();
                x[0] += shear * (x[up] - MARGIN as f64 * H);
                x.push(width.powi(self.axes as i32));
                Value::from(x)
            })
            .collect()
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
/// Displacement of the particles of the disordered block along the first axis, per height.
const SHEAR: f64 = 0.5;

fn disordered(block: &Block) -> Made {
    let mut made = flying(block, 1);
    let mut random = Random::new(SEED);
    let particles = block.particles(H / 2.0, SHEAR, || random.unit() - 0.5);
    of_list(&mut made, &particles);
    let lean = SHEAR * block.cells[block.axes - 1] as f64 * H;
    let cells = &mut made.scene["mesh"]["cells_number"][0];
    *cells = (cells.as_u64().unwrap_or(0) + (lean / H).ceil() as u64).into();
    made
}

/// Half-length of a particle of the wide block over that of a cell: contiguous particle domains that are wider than one cell
/// reach four nodes.
const WIDE: f64 = 1.01;

fn wide(block: &Block) -> Made {
    let mut made = flying(block, 1);
    of_list(&mut made, &block.particles(WIDE * H, 0.0, || 0.0));
    made
}

/// Makes the body of a scene a list of particles.
fn of_list(made: &mut Made, particles: &Value) {
    let body = &mut made.scene["body"][0];
    *body = json!({
        "type": "particles", "id": 1, "material_id": 1, "particles": particles,
        "initial_velocity": body["initial_velocity"],
    });
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
