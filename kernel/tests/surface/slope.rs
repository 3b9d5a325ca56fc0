//! A block on a plane that is tilted against the grid.

use proctor_contact::geometry::surface::Surface;
use proctor_laws::LinearElastic;
use proctor_scene::{
    Body, Dimension, InitialStress, Material, Mesh, ParticleSeed, RigidSurface, Scene, Shape,
    StressScheme, Vector,
};
use std::sync::Arc;

pub const GRAVITY: f64 = 10.0;
/// Cell edge \[m\]; the block is four cells long, two high and two wide.
pub const H: f64 = 0.125;

/// Choices of the block.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    pub scheme: StressScheme,
    pub friction: f64,
    /// Speed down the slope at the start \[m/s\].
    pub speed: f64,
    /// Speed away from the slope at the start \[m/s\].
    pub lift: f64,
    pub gravity: f64,
    /// Angle of the plane with the grid \[rad\]; gravity is at 30 degrees to the normal of the plane in any case.
    pub tilt: f64,
    pub end: f64,
}

impl Slope {
    pub fn new(scheme: StressScheme, friction: f64) -> Self {
        Self {
            scheme,
            friction,
            speed: 1.0,
            lift: 0.0,
            gravity: GRAVITY,
            tilt: 30.0_f64.to_radians(),
            end: 0.5,
        }
    }

    /// Down the slope.
    pub fn down(&self) -> Vector {
        [self.tilt.cos(), 0.0, -self.tilt.sin()]
    }

    /// Away from the slope.
    pub fn normal(&self) -> Vector {
        [self.tilt.sin(), 0.0, self.tilt.cos()]
    }

    /// A point on the plane below the lower rear edge of the block, by its way down from there.
    fn at(&self, way: f64, y: f64) -> Vector {
        let t = self.down();
        [0.437 + way * t[0], y, 2.091 + way * t[2]]
    }

    pub fn scene(&self) -> Scene {
        let mesh = Mesh::new(Dimension::Three, [0.0; 3], [H; 3], [26, 2, 24]);
        let mut scene = Scene::new(Dimension::Three, mesh, self.end);
        scene.scheme = self.scheme;
        let (t, n) = (self.down(), self.normal());
        let angle = 30.0_f64.to_radians();
        scene.gravity = std::array::from_fn(|axis| {
            self.gravity * (angle.sin() * t[axis] - angle.cos() * n[axis])
        });
        scene.materials.push(Material {
            name: "elastic".into(),
            id: 1,
            density: 1000.0,
            law: LinearElastic::new(1e7, 0.3).into(),
        });
        let step = 0.5 * H;
        let mut seeds = vec![];
        for (i, j, k) in
            (0..8).flat_map(|i| (0..4).flat_map(move |j| (0..4).map(move |k| (i, j, k))))
        {
            let center = |i: i32| (f64::from(i) + 0.5) * step;
            let foot = self.at(center(i), center(j));
            seeds.push(ParticleSeed {
                position: std::array::from_fn(|axis| foot[axis] + center(k) * n[axis]),
                volume: step.powi(3),
            });
        }
        scene.bodies.push(Body {
            name: "block".into(),
            id: 1,
            material: 0,
            shape: Shape::Particles(Arc::new(seeds)),
            particles_per_cell: [2; 3],
            velocity: std::array::from_fn(|axis| self.speed * t[axis] + self.lift * n[axis]),
            motion: None,
            initial_stress: InitialStress::None,
        });
        let corners = [
            [self.at(-0.4, -1.0), self.at(4.0, -1.0), self.at(4.0, 1.0)],
            [self.at(-0.4, -1.0), self.at(4.0, 1.0), self.at(-0.4, 1.0)],
        ];
        scene.surfaces.push(RigidSurface {
            name: "slope".into(),
            surface: Arc::new(Surface::new(&corners).expect("a plane")),
            friction: self.friction,
            distance_threshold: H,
            penalty_stiffness: None,
            motion: None,
        });
        scene
    }
}

pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
