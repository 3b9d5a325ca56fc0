//! Parts of scenes: materials, bodies, meshes and initial states as most cases have them.

use proctor_contact::geometry::surface::Surface;
use proctor_laws::{AnyLaw, LinearElastic};
use proctor_scene::simulation::{InitialState, Options};
use proctor_scene::{
    Body, Contact, ContactNormal, Dimension, InitialStress, Material, Mesh, PlaneCondition,
    Results, RigidSurface, Scene, Shape, TimeStep, Traction, Vector,
};
use std::sync::Arc;

/// Nothing is written: a case reads the simulation itself.
pub const NO_RESULTS: Results = Results::NONE;

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

/// A disk or a ball, by its centre and radius \[m\].
pub const fn ball(center: Vector, radius: f64) -> Shape {
    Shape::Sphere { center, radius }
}

/// The one contact of two bodies, with a coefficient of friction.
pub fn contact(
    name: &str,
    [master, slave]: [i64; 2],
    friction: f64,
    normal: ContactNormal,
) -> Vec<Contact> {
    vec![Contact {
        name: name.to_owned(),
        id: 1,
        friction,
        master,
        slave,
        normal,
    }]
}

/// The one traction of a scene \[Pa\], constant in time, on a line or a rectangle by two corners \[m\].
pub fn traction(p1: Vector, p2: Vector, traction: Vector) -> Vec<Traction> {
    let traction = traction.into();
    vec![Traction { p1, p2, traction }]
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

/// The state of a body at rest that moves with a velocity \[m/s\] of a gradient \[1/s\].
pub const fn moving(velocity: Vector, velocity_gradient: [[f64; 3]; 3]) -> InitialState {
    InitialState {
        velocity,
        velocity_gradient,
        ..AT_REST
    }
}

/// The same along x, where the velocity varies along x alone.
pub const fn moving_along_x(velocity: f64, gradient: f64) -> InitialState {
    moving(
        [velocity, 0.0, 0.0],
        [[gradient, 0.0, 0.0], [0.0; 3], [0.0; 3]],
    )
}

/// Stress along one axis alone \[Pa\].
pub const fn uniaxial(stress: f64) -> [f64; 6] {
    [stress, 0.0, 0.0, 0.0, 0.0, 0.0]
}

/// A mesh of the plane in square cells from the origin on, with sliding planes at all sides \[m\].
pub fn strip(cell: f64, [along, up]: [usize; 2]) -> Mesh {
    Mesh::new(Dimension::Two, [0.0; 3], [cell; 3], [along, up, 1])
}

/// The same around an axis of revolution, the left side.
pub fn revolved_strip(cell: f64, [along, up]: [usize; 2]) -> Mesh {
    let mut mesh = strip(cell, [along, up]);
    mesh.axisymmetric = true;
    mesh
}

/// The same, free outside and above.
pub fn open_quarter(cell: f64, [along, up]: [usize; 2]) -> Mesh {
    let mut mesh = revolved_strip(cell, [along, up]);
    mesh.planes[0][1] = PlaneCondition::Free;
    mesh.planes[1][1] = PlaneCondition::Free;
    mesh
}

/// Number of cells along a length \[m\].
pub fn cells(length: f64, cell: f64) -> usize {
    (length / cell).round() as usize
}

/// A rectangle of the plane, by two corners \[m\].
pub fn rectangle([left, below]: [f64; 2], [right, above]: [f64; 2]) -> Shape {
    cuboid([left, below, 0.0], [right, above, 0.0])
}

/// A scene in the plane without results, to be filled \[s\].
pub fn plane_scene(name: &str, mesh: Mesh, time: f64) -> Scene {
    bare_scene(name, Dimension::Two, mesh, time)
}

/// A scene without results, to be filled \[s\].
pub fn bare_scene(name: &str, dimension: Dimension, mesh: Mesh, time: f64) -> Scene {
    Scene {
        name: name.to_owned(),
        results: NO_RESULTS,
        ..Scene::new(dimension, mesh, time)
    }
}

/// Options with an initial state, by the place at the start \[m\].
pub fn starting(
    options: Options,
    state: impl Fn(&Vector) -> InitialState + Send + Sync + 'static,
) -> Options {
    Options {
        initial: Some(Arc::new(state)),
        ..options
    }
}

/// Options with a body force per mass \[m/s²\], by the place at the start \[m\] and the time \[s\].
pub fn driven(
    options: Options,
    force: impl Fn(&Vector, f64) -> Vector + Send + Sync + 'static,
) -> Options {
    Options {
        body_force: Some(Arc::new(move |x0, _, t| force(x0, t))),
        ..options
    }
}

/// Equal steps of a length \[s\] within the bound of the method.
pub const fn equal_steps_of(dt: f64) -> TimeStep {
    TimeStep::Fixed {
        dt,
        allow_unstable: false,
    }
}

/// Speed of shear waves in an elastic solid \[m/s; Pa, kg/m³\].
pub fn s_wave_speed(young: f64, poisson: f64, density: f64) -> f64 {
    (young / (2.0 * (1.0 + poisson)) / density).sqrt()
}

/// A rigid surface by an STL text that is sound, on which bodies rub, and the distance within which it acts \[m\]. Were the text
/// not sound, a scene without the surface would fail every gate.
pub fn stl_surface(
    name: &str,
    text: &[u8],
    friction: f64,
    distance_threshold: f64,
) -> Option<RigidSurface> {
    let corners = proctor_files::stl::parse(text).ok()?;
    Some(RigidSurface {
        name: name.to_owned(),
        surface: Arc::new(Surface::new(&corners).ok()?),
        friction,
        distance_threshold,
        penalty_stiffness: None,
        motion: None,
    })
}

/// The larger of two numbers, and NaN where one of them is NaN.
pub fn larger(most: f64, next: f64) -> f64 {
    if next > most || next.is_nan() {
        next
    } else {
        most
    }
}

/// The largest of some numbers: zero of an empty list, NaN where one of them is NaN.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, larger)
}

/// Stress over strain along one axis, where there is no strain along the others \[Pa\].
pub fn confined_modulus(young: f64, poisson: f64) -> f64 {
    young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson))
}

/// Speed of pressure waves in an elastic solid \[m/s; Pa, kg/m³\].
pub fn p_wave_speed(young: f64, poisson: f64, density: f64) -> f64 {
    (confined_modulus(young, poisson) / density).sqrt()
}
