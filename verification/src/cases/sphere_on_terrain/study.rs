//! The bounce with any settings.

use std::sync::Arc;

use proctor_contact::geometry::surface::Surface;
use proctor_files::stl::parse;
use proctor_scene::simulation::Simulation;
use proctor_scene::{Body, Dimension, Mesh, RigidSurface, Scene, Shape, TimeStep, Vector};

use super::height::HeightField;
use super::{
    BOUNCE, CENTER, FRICTION, GRAVITY, KEPT, RADIUS, STEP, Seen, SphereOnTerrain, Start, TERRAIN,
    TIME, TIME_BOUNCE, TIME_FAST, VELOCITY,
};
use crate::case::{Found, Rung, Size};
use crate::cases::dynamics::run;
use crate::cases::{NO_RESULTS, body, elastic};
use crate::guest::Guest;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer, Study, few};

/// Density \[kg/m³\], Young's modulus \[Pa\] and Poisson's ratio of the scene.
const MATERIAL: [f64; 3] = [1000.0, 1e7, 0.3];

/// Speed of pressure waves \[m/s\].
fn wave_speed() -> f64 {
    let [density, young, poisson] = MATERIAL;
    let modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    (modulus / density).sqrt()
}

impl Study for SphereOnTerrain {
    fn path(&self, size: Size) -> Vec<Rung> {
        Rung::ladders(match size {
            Size::Quick => &[(BOUNCE.0, &[0.2, 0.1])],
            Size::Full => &[(BOUNCE.0, &[0.2, 0.1, 0.05])],
        })
    }

    fn measures(&self) -> Vec<Measure> {
        vec![Measure::new("energy", KEPT)]
    }

    fn tries(&self, size: Size, method: Method) -> bool {
        few(size, method)
    }

    fn refined_axes(&self) -> usize {
        3
    }

    fn own_settings(&self, rung: &Rung) -> Settings {
        Settings::new(Method {
            scheme: Self::variant(rung).1,
            ..Method::DEFAULT
        })
    }

    fn scene_with(&self, rung: &Rung, settings: &Settings) -> Scene {
        let (_, _, factor, smooth) = Self::variant(rung);
        let h = rung.cell;
        let cells = [2.0, 2.0, 1.6].map(|length: f64| (length / h).round() as usize);
        let mesh = Mesh::new(Dimension::Three, [0.0; 3], [h; 3], cells);
        let time = if rung.variant == BOUNCE.0 {
            TIME_BOUNCE
        } else if factor > 1.0 {
            TIME_FAST
        } else {
            TIME
        };
        let mut scene = Scene::new(Dimension::Three, mesh, time);
        scene.name = String::from("sphere_on_terrain");
        scene.gravity = [0.0, 0.0, -self.pull * GRAVITY];
        scene.time_step = match settings.courant {
            // The energy of the leapfrog is that of equal steps.
            None if smooth => TimeStep::Fixed {
                dt: STEP * h,
                allow_unstable: false,
            },
            None => TimeStep::Automatic,
            Some(_) => settings.equal_steps(time, h, wave_speed()).0,
        };
        scene.results = NO_RESULTS;
        scene.materials = elastic(MATERIAL[0], MATERIAL[1], MATERIAL[2]);
        let sphere = Shape::Sphere {
            center: CENTER,
            radius: RADIUS,
        };
        scene.bodies.push(Body {
            velocity: VELOCITY.map(|v| factor * v),
            ..body("sphere", 1, sphere)
        });
        // The file is part of the program; were it not sound, a scene without a terrain fails the gates.
        let corners = parse(TERRAIN).ok();
        scene.surfaces.extend(corners.and_then(|corners| {
            Some(RigidSurface {
                name: "terrain".to_owned(),
                surface: Arc::new(Surface::new(&corners).ok()?),
                friction: if smooth { 0.0 } else { FRICTION },
                distance_threshold: h,
                penalty_stiffness: None,
                motion: None,
            })
        }));
        settings.apply(&mut scene);
        scene
    }

    fn guest(&self, _rung: &Rung) -> Result<Guest, &'static str> {
        Err("what is known exactly are energies step by step, and frames hold none")
    }

    fn run(
        &self,
        rung: &Rung,
        settings: &Settings,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<Found, Failure> {
        let rigid = simulation.scene().surfaces.first();
        let surface = rigid.ok_or("there is no terrain")?.surface.clone();
        let velocity = simulation.scene().bodies[0].velocity;
        let seeds: Vec<Vector> = (0..simulation.particles())
            .map(|p| simulation.position(0, p))
            .collect();
        let half = 0.5 * rung.cell / settings.particles_per_cell as f64;
        // The study does not ask for it, and it takes longer than a short run.
        let is_asked = rung.variant != BOUNCE.0;
        let touch = is_asked.then(|| Self::touch(&surface, &seeds, half, &velocity));
        let center = simulation.center(0).1;
        let start = Start { center, velocity };
        let terrain = HeightField::new(&surface);
        let mut seen = Seen::default();
        let end = simulation.scene().time;
        run(simulation, end, observer, |simulation| {
            Self::look(simulation, &terrain, &start, &mut seen);
        })?;
        let quantities = Self::quantities(rung, simulation, &seen, &start, touch);
        Ok(Found::new(quantities, None))
    }
}
