//! What scenes are made of: materials, bodies and meshes as most cases have them.

use proctor_laws::{AnyLaw, LinearElastic};
use proctor_scene::simulation::InitialState;
use proctor_scene::{
    Body, Dimension, InitialStress, Material, Mesh, PlaneCondition, Results, Shape, Vector,
};

/// Nothing is written: a case reads the simulation itself.
pub const NO_RESULTS: Results = Results {
    print: 0,
    fields: Vec::new(),
    nodal_fields: Vec::new(),
    checkpoint: false,
};

/// A body at rest and without stress.
pub const AT_REST: InitialState = InitialState {
    velocity: [0.0; 3],
    velocity_gradient: [[0.0; 3]; 3],
    stress: [0.0; 6],
    deformation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
};

/// A linear elastic law \[Pa\].
pub fn elastic_law(young: f64, poisson: f64) -> AnyLaw {
    LinearElastic::new(young, poisson).into()
}

/// The one material of a case \[kg/m³\].
pub fn material(name: &str, density: f64, law: impl Into<AnyLaw>) -> Vec<Material> {
    vec![Material {
        name: name.to_owned(),
        id: 1,
        density,
        law: law.into(),
    }]
}

/// The one linear elastic material of a case \[kg/m³, Pa\].
pub fn elastic(density: f64, young: f64, poisson: f64) -> Vec<Material> {
    material("elastic", density, elastic_law(young, poisson))
}

/// A body of the first material, at rest; [`Settings::apply`](crate::settings::Settings::apply) gives it its particles.
pub fn body(name: impl Into<String>, id: i64, shape: Shape) -> Body {
    Body {
        name: name.into(),
        id,
        material: 0,
        shape,
        particles_per_cell: [1; 3],
        velocity: [0.0; 3],
        motion: None,
        initial_stress: InitialStress::None,
    }
}

/// A rectangle or a cuboid.
pub fn cuboid(p1: Vector, p2: Vector) -> Shape {
    Shape::Cuboid { p1, p2 }
}

/// A mesh of the plane in square cells, from one corner to the other, free at all sides \[m\].
pub fn open_plane(cell: f64, [left, below]: [f64; 2], [right, above]: [f64; 2]) -> Mesh {
    let cells = |length: f64| (length / cell).round() as usize;
    let mut mesh = Mesh::new(
        Dimension::Two,
        [left, below, 0.0],
        [cell; 3],
        [cells(right - left), cells(above - below), 1],
    );
    mesh.planes[..2].fill([PlaneCondition::Free; 2]);
    mesh
}
