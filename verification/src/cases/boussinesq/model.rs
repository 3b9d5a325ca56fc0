//! The scene of the quarter box, and the exact solution of the whole one.

use crate::cases::prelude::*;
use crate::exact::boussinesq_box::{BoxProblem, BoxSolution, InvalidBox};

/// Side of the cube \[m\].
pub const SIDE: f64 = 1.0;
/// Young's modulus \[Pa\].
pub const YOUNG: f64 = 200e6;
/// Poisson's ratio.
pub const POISSON: f64 = 0.25;
const DENSITY: f64 = 1500.0; // Density [kg/m³]
/// Downward force on the whole top \[N\].
pub const LOAD: f64 = 1.0;
/// Force on the quarter that is solved \[N\].
pub const QUARTER_LOAD: f64 = LOAD / 4.0;
/// Side of the loaded square \[m\].
pub const PATCH: f64 = 0.25;
/// Middle of the top along x and y \[m\].
pub const MIDDLE: f64 = 0.5;

/// Application of the load to the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loading {
    /// Evenly over a square.
    Patch,
    /// Load on one node.
    Node,
}

impl Loading {
    /// Both, in the order in which they are run.
    pub const ALL: [Self; 2] = [Self::Patch, Self::Node];

    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Patch => "patch",
            Self::Node => "node",
        }
    }

    /// The loading of that word; a patch where there is none such.
    pub fn of_word(word: &str) -> Self {
        if word == Self::Node.word() {
            Self::Node
        } else {
            Self::Patch
        }
    }
}

/// Speed of compression waves \[m/s\].
pub fn wave_speed() -> f64 {
    p_wave_speed(YOUNG, POISSON, DENSITY)
}

/// The quarter `[0.5, 1]² x [0, 1]` of the cube in cells of `h` (m), with one layer of empty cells above.
pub fn scene(h: f64, loading: Loading) -> Scene {
    scene_of_side(SIDE, h, loading)
}

/// The same quarter of a cube with another side \[m\].
pub fn scene_of_side(side: f64, h: f64, loading: Loading) -> Scene {
    let (middle, count) = (0.5 * side, cells(side, h));
    let (corner, top) = ([middle, middle, 0.0], [middle, middle, side]);
    let counts = [count / 2, count / 2, count + 1];
    let mut mesh = Mesh::new(Dimension::Three, corner, [h; 3], counts);
    mesh.planes[2][1] = PlaneCondition::Free;
    // The end of a relaxation is the rest, not a time.
    let name = format!("boussinesq_{}", loading.word());
    let mut scene = bare_scene(&name, Dimension::Three, mesh, 1.0);
    scene.scheme = StressScheme::Usl;
    scene.damping = Damping::Kinetic;
    scene.materials = elastic(DENSITY, YOUNG, POISSON);
    scene.bodies = vec![body("quarter box", 1, cuboid(corner, [side; 3]))];
    let far = middle + 0.5 * PATCH;
    match loading {
        Loading::Node => scene.point_loads.push(PointLoad {
            position: top,
            force: [0.0, 0.0, -QUARTER_LOAD],
        }),
        Loading::Patch => {
            let down = [0.0, 0.0, -LOAD / (PATCH * PATCH)];
            scene.tractions = traction(top, [far, far, side], down);
        }
    }
    scene
}

/// The exact solution of the whole cube, with the Poisson's ratio given.
///
/// # Errors
/// [`InvalidBox`] for a ratio outside (-1, 1/2).
pub fn exact(loading: Loading, poisson: f64) -> Result<BoxSolution, InvalidBox> {
    BoxSolution::new(BoxProblem {
        poisson,
        ..problem(SIDE, loading)
    })
}

/// The problem of a whole cube with this side \[m\].
pub fn problem(side: f64, loading: Loading) -> BoxProblem {
    BoxProblem {
        a: side,
        b: side,
        height: side,
        young: YOUNG,
        poisson: POISSON,
        load: LOAD,
        position: [0.5 * side; 2],
        patch: (loading == Loading::Patch).then_some(PATCH),
    }
}
