//! Scenes that are not linear. Cells are 1 m, densities 1 kg/m³, and waves run at about 1 m/s.

use std::sync::Arc;

use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_laws::{
    AnyLaw, LinearElastic, MohrCoulomb, NeoHookean, Newtonian, ObjectiveRate, VonMises,
};
use proctor_scene::simulation::{InitialField, InitialState};
use proctor_scene::{
    BaseMotion, BodyBoundary, Contact, ContactNormal, Dimension, Enforcement, History, Mesh,
    MortarContact, Motion, Permeability, PlaneCondition, PoreWater, RigidLine, RigidSurface, Scene,
    Vector, Vertices,
};

use crate::cases::{AT_REST, NO_RESULTS, body, cuboid, material};

/// Young's modulus \[Pa\] and Poisson's ratio: a confined modulus of 1.01 Pa.
const YOUNG: f64 = 0.75;
const POISSON: f64 = 0.3;
/// Yield stress \[Pa\], a tenth of what elasticity would make of the strains at the start; cohesion is half of it.
const YIELD: f64 = 0.02;
/// Friction and dilation of a soil \[°\].
const SOIL: [f64; 2] = [30.0, 5.0];
/// Bulk modulus \[Pa\] and viscosity \[Pa s\] of a fluid: (4 mu/3)/(rho c h) is 1, so that the step is bounded by both.
const BULK: f64 = 1.0;
const VISCOSITY: f64 = 0.75;
/// Porosity of wet soil, and bulk modulus of its water \[Pa\]: over the porosity five times the modulus of the skeleton.
const WET: [f64; 2] = [0.4, 2.0];
/// Speed at which bodies meet \[m/s\].
const SPEED: f64 = 0.05;
/// Friction.
const FRICTION: f64 = 0.3;
/// Gap at which mortar contact begins \[m\].
const GAP: f64 = 0.2;
/// Stiffness of mortar contact \[Pa/m\]: ten times that of a cell, as much as the kernel does not warn of.
const NORMAL: f64 = 10.0 * YOUNG;
/// Spacing of the vertices of a boundary \[m\].
const VERTICES: f64 = 0.5;
/// Stiffness of the penalty of a rigid surface, per particle \[N/m\]: a thousand times that of a cell.
const PENALTY: f64 = 1e3 * YOUNG;

/// A scene with its state at the start.
pub struct Set {
    /// The scene.
    pub scene: Scene,
    /// The state of its particles at the start, where it is not at rest.
    pub initial: Option<InitialField>,
    /// Time of the full run \[s\].
    pub time: f64,
}

fn elastic() -> AnyLaw {
    LinearElastic::new(YOUNG, POISSON).into()
}

/// An open mesh without bodies.
fn open(dimension: Dimension, cells: [usize; 3], law: AnyLaw) -> Scene {
    let mut mesh = Mesh::new(dimension, [0.0; 3], [1.0; 3], cells);
    mesh.planes[..dimension.axes()].fill([PlaneCondition::Free; 2]);
    let mut scene = Scene::new(dimension, mesh, 1.0);
    scene.materials = material("elastic", 1.0, law);
    scene.results = NO_RESULTS;
    scene
}

/// A block of four cells, not on the nodes, around `CENTER`.
fn lone(law: AnyLaw, velocity: fn(&Vector) -> Vector, time: f64) -> Set {
    let mut scene = open(Dimension::Two, [14, 14, 1], law);
    let shape = cuboid([5.1, 5.1, 0.0], [9.1, 9.1, 0.0]);
    scene.bodies = vec![body("block", 1, shape)];
    let state = move |x: &Vector| InitialState {
        velocity: velocity(x),
        ..AT_REST
    };
    Set {
        scene,
        initial: Some(Arc::new(state)),
        time,
    }
}

/// Centre of the lone block \[m\].
const CENTER: f64 = 7.1;

fn breathing(x: &Vector) -> Vector {
    [0.12 * (x[0] - CENTER), 0.12 * (x[1] - CENTER), 0.0]
}

fn spinning(x: &Vector) -> Vector {
    let spin = 0.1 / 8.0_f64.sqrt();
    [-spin * (x[1] - CENTER), spin * (x[0] - CENTER), 0.0]
}

/// A neo-Hookean block that breathes by large strains.
#[must_use]
pub fn large_strain() -> Set {
    lone(NeoHookean::new(YOUNG, POISSON).into(), breathing, 200.0)
}

/// The same with the elastic law of Hughes and Winget.
#[must_use]
pub fn hypoelastic() -> Set {
    lone(elastic(), breathing, 200.0)
}

/// A block that spins, with the law of Hughes and Winget.
#[must_use]
pub fn rotation() -> Set {
    lone(elastic(), spinning, 200.0)
}

/// A block that spins, with Jaumann's forward rate.
#[must_use]
pub fn rotation_jaumann() -> Set {
    let law = LinearElastic::with_rate(YOUNG, POISSON, ObjectiveRate::JaumannForward);
    lone(law.into(), spinning, 200.0)
}

fn shearing(x: &Vector) -> Vector {
    [0.06 * (x[0] - CENTER), -0.06 * (x[1] - CENTER), 0.0]
}

/// A block of von Mises' law, sheared until it yields.
#[must_use]
pub fn von_mises() -> Set {
    let law = VonMises::new(YOUNG, POISSON, YIELD, 0.0);
    lone(law.into(), shearing, 200.0)
}

/// A block of Mohr-Coulomb's law, sheared until it yields.
#[must_use]
pub fn mohr_coulomb() -> Set {
    let [friction, dilation] = SOIL;
    let law = MohrCoulomb::new(YOUNG, POISSON, [friction, 0.5 * YIELD, dilation]);
    lone(law.into(), shearing, 200.0)
}

/// A block of two phases of one density and of water five times as stiff as its skeleton, sheared, with a conductivity \[m/s\]
/// for a gravity of 1 m/s².
fn wet(conductivity: f64) -> Set {
    let mut set = lone(elastic(), shearing, 200.0);
    set.scene.pore_water = vec![Some(PoreWater {
        porosity: WET[0],
        grain_density: 1.0,
        density: 1.0,
        bulk: WET[1],
        conductivity: [conductivity; 3],
        permeability: Permeability::Constant,
        conductivity_gravity: 1.0,
    })];
    set.scene.water_planes = set.scene.mesh.planes;
    set
}

/// A block whose water flows nearly freely: its drag takes a step of the block's waves to stop it.
#[must_use]
pub fn wet_open() -> Set {
    wet(1.0)
}

/// A block whose water moves with its skeleton.
#[must_use]
pub fn wet_tight() -> Set {
    wet(1e-9)
}

/// A viscous fluid that breathes.
#[must_use]
pub fn newtonian() -> Set {
    lone(Newtonian::new(BULK, VISCOSITY).into(), breathing, 200.0)
}

/// Two blocks, one a little higher, that meet.
fn pair() -> Scene {
    let mut scene = open(Dimension::Two, [18, 10, 1], elastic());
    let left = cuboid([3.1, 3.1, 0.0], [7.1, 6.1, 0.0]);
    let right = cuboid([8.6, 3.9, 0.0], [12.6, 6.9, 0.0]);
    scene.bodies = vec![body("left", 1, left), body("right", 2, right)];
    scene.bodies[0].velocity = [SPEED, 0.0, 0.0];
    scene.bodies[1].velocity = [-SPEED, 0.0, 0.0];
    scene
}

/// Two bodies in contact on the grid.
#[must_use]
pub fn grid_contact() -> Set {
    let mut scene = pair();
    scene.contacts = vec![Contact {
        name: "contact".to_owned(),
        id: 1,
        friction: FRICTION,
        master: 1,
        slave: 2,
        normal: ContactNormal::Collinear,
    }];
    Set {
        scene,
        initial: None,
        time: 100.0,
    }
}

fn mortar(master: i64, slave: i64, enforcement: Enforcement) -> MortarContact {
    MortarContact {
        name: "contact".to_owned(),
        id: 1,
        master,
        slave,
        friction: FRICTION,
        critical_gap: GAP,
        normal_stiffness: NORMAL,
        tangential_stiffness: NORMAL,
        enforcement,
        detection: Detection::Mortar,
    }
}

fn boundary(body: i64) -> BodyBoundary {
    BodyBoundary {
        body,
        vertices: Vertices::Spacing(VERTICES),
        follow: FollowMode::Spin,
    }
}

fn mortar_pair(enforcement: Enforcement) -> Set {
    let mut scene = pair();
    scene.mortar.boundaries = vec![boundary(1), boundary(2)];
    scene.mortar.contacts = vec![mortar(1, 2, enforcement)];
    Set {
        scene,
        initial: None,
        time: 100.0,
    }
}

/// Two bodies in mortar contact by a barrier.
#[must_use]
pub fn mortar_barrier() -> Set {
    mortar_pair(Enforcement::Barrier)
}

/// Two bodies in mortar contact by a penalty.
#[must_use]
pub fn mortar_penalty() -> Set {
    mortar_pair(Enforcement::Penalty)
}

/// A body in mortar contact with a rigid line.
#[must_use]
pub fn mortar_line() -> Set {
    let mut scene = open(Dimension::Two, [12, 12, 1], elastic());
    let shape = cuboid([4.1, 2.6, 0.0], [8.1, 6.6, 0.0]);
    scene.bodies = vec![body("block", 1, shape)];
    scene.bodies[0].velocity = [0.5 * SPEED, -SPEED, 0.0];
    // The material is on the left of a line, so it lies below one that runs to the left.
    let points = [[11.0, 2.0], [1.0, 2.0]];
    scene.mortar.lines = vec![RigidLine {
        name: "line".to_owned(),
        id: 9,
        chains: vec![Chain {
            points: points.iter().map(|p| Point::from(*p)).collect(),
            side: BoundarySide::Open,
        }],
        motion: None,
    }];
    scene.mortar.boundaries = vec![boundary(1)];
    scene.mortar.contacts = vec![mortar(9, 1, Enforcement::Barrier)];
    Set {
        scene,
        initial: None,
        time: 100.0,
    }
}

fn on_triangles(penalty: Option<f64>) -> Set {
    let mut scene = open(Dimension::Three, [8, 8, 9], elastic());
    let shape = cuboid([3.1, 3.1, 2.6], [5.1, 5.1, 4.6]);
    scene.bodies = vec![body("block", 1, shape)];
    scene.bodies[0].velocity = [0.5 * SPEED, 0.0, -SPEED];
    // A plane that rises by a tenth along x, its normals upwards.
    let z = |x: f64| 1.8 + 0.1 * x;
    let at = |x: f64, y: f64| [x, y, z(x)];
    let corners = [
        [at(0.5, 0.5), at(7.5, 0.5), at(7.5, 7.5)],
        [at(0.5, 0.5), at(7.5, 7.5), at(0.5, 7.5)],
    ];
    // Both triangles are sound, as their tests know.
    scene.surfaces = Surface::new(&corners.map(|t| t.map(Into::into)))
        .map(|surface| RigidSurface {
            name: "plane".to_owned(),
            surface: Arc::new(surface),
            friction: FRICTION,
            distance_threshold: 1.0,
            penalty_stiffness: penalty,
            motion: None,
        })
        .into_iter()
        .collect();
    Set {
        scene,
        initial: None,
        time: 60.0,
    }
}

/// A body on a rigid surface.
#[must_use]
pub fn rigid_surface() -> Set {
    on_triangles(None)
}

/// A body on a rigid surface by a penalty.
#[must_use]
pub fn rigid_penalty() -> Set {
    on_triangles(Some(PENALTY))
}

/// A body on a base that moves.
#[must_use]
pub fn moving_base() -> Set {
    let mut scene = open(Dimension::Two, [2, 12, 1], elastic());
    scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
    scene.mesh.planes[1][0] = PlaneCondition::Sliding;
    let shape = cuboid([0.0, 0.0, 0.0], [2.0, 8.1, 0.0]);
    scene.bodies = vec![body("column", 1, shape)];
    let times: Vec<f64> = (0..=400).map(|i| 0.5 * f64::from(i)).collect();
    let values = times
        .iter()
        .map(|t| [0.0, 0.02 * libm::sin(0.4 * t), 0.0])
        .collect();
    scene.base_motion = Some(BaseMotion {
        axis: 1,
        side: 0,
        motion: Motion::Velocity(History { times, values }),
    });
    Set {
        scene,
        initial: None,
        time: 200.0,
    }
}
