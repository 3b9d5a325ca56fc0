//! Does a spinning block turn as a rigid body?
//!
//! Source: verification notes, A9, without the prestress, which a free block could not hold. An elastic square spins
//! about its centre for half a turn, free of everything, its edges and particles crossing the mesh in all directions.
//! A rigid motion is exact but for the centrifugal stretch, of order (w R/c)²: corners at 1 % of the wave speed keep
//! it at 1e-4.
//!
//! Expected: APIC carries the spin in its affine velocity and keeps angular momentum (Jiang et al. 2015); FLIP keeps
//! it up to what lumping the mass loses. `proctor verify rotation`.

use std::f64::consts::PI;
use std::sync::Arc;

use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Dimension, Mesh, PlaneCondition, Scene, StressScheme, TransferKind};

use super::dynamics::{DISPLACEMENT, advance, l2, ratio};
use super::judging::{error_gate, table};
use super::{AT_REST, NO_RESULTS, body, cuboid, elastic};
use crate::case::{Case, Found, Rung, Size, Solved, Verdict};
use crate::guest::Guest;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer, Study};

/// Side of the mesh \[m\].
const MESH: f64 = 1.0;
/// Middle of the mesh and of the block \[m\].
const MIDDLE: f64 = 0.5;
/// Half the side of the block \[m\].
const HALF: f64 = 0.25;
/// Young's modulus \[Pa\].
const YOUNG: f64 = 1e6;
/// Poisson's ratio.
const POISSON: f64 = 0.3;
/// Density \[kg/m³\].
const DENSITY: f64 = 1000.0;
/// Speed of the corners over the wave speed.
const SPEED: f64 = 1e-2;
/// Name of the error of the velocity among the quantities.
const VELOCITY: &str = "L2(v)";
/// The one variant.
const VARIANT: &str = "half turn";

/// The spinning block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Spin of the exact solution over that of the scene. Anything but 1 is a wrong reference, to prove that the
    /// gates notice.
    pub reference_spin: f64,
}

impl Rotation {
    /// The case as it is meant.
    pub const GIVEN: Self = Self {
        reference_spin: 1.0,
    };

    /// P-wave speed \[m/s\].
    fn wave_speed() -> f64 {
        let confined = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
        (confined / DENSITY).sqrt()
    }

    /// Wave speed and speed of the corners, which the critical step counts with \[m/s\].
    fn fastest() -> f64 {
        (1.0 + SPEED) * Self::wave_speed()
    }

    /// Angular velocity \[rad/s\].
    fn spin() -> f64 {
        SPEED * Self::wave_speed() / (HALF * std::f64::consts::SQRT_2)
    }

    /// Velocity (m/s) of a point of a body that spins with `spin` (rad/s).
    fn velocity(x: [f64; 3], spin: f64) -> [f64; 3] {
        [-spin * (x[1] - MIDDLE), spin * (x[0] - MIDDLE), 0.0]
    }

    /// Where the point `x` (m) is after a turn by `angle` (rad).
    fn turned(x: [f64; 3], angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle);
        let (a, b) = (x[0] - MIDDLE, x[1] - MIDDLE);
        [MIDDLE + cos * a - sin * b, MIDDLE + sin * a + cos * b, x[2]]
    }

    fn rungs_of(counts: &[u32]) -> Vec<Rung> {
        Rung::counted(VARIANT, "side/h", 2.0 * HALF, counts)
    }
}

impl Case for Rotation {
    fn name(&self) -> &'static str {
        "rotation"
    }

    fn question(&self) -> &'static str {
        "Does a spinning block turn as a rigid body?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        Self::rungs_of(match size {
            Size::Quick => &[4, 8],
            Size::Full => &[4, 8, 16],
        })
    }

    with_own_settings!();

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let reason = "one percent of the path of half a turn";
        let rungs = self.rungs(size);
        Verdict {
            gates: vec![
                error_gate(&rungs, solved, DISPLACEMENT, 1e-2, reason),
                error_gate(&rungs, solved, VELOCITY, 1e-2, reason),
            ],
            tables: vec![(
                "rotation, uGIMP, MUSL, APIC".to_owned(),
                table(solved, VARIANT, &[DISPLACEMENT, VELOCITY]),
            )],
            ..Verdict::default()
        }
    }
}

impl Study for Rotation {
    fn path(&self, size: Size) -> Vec<Rung> {
        Self::rungs_of(match size {
            Size::Quick => &[4, 8],
            Size::Full => &[4, 8, 16, 32],
        })
    }

    fn measures(&self) -> Vec<Measure> {
        vec![
            Measure::new("displacement", DISPLACEMENT),
            Measure::new("velocity", VELOCITY),
        ]
    }

    fn refined_axes(&self) -> usize {
        2
    }

    fn own_settings(&self, _: &Rung) -> Settings {
        Settings::new(Method {
            transfer: TransferKind::Apic,
            scheme: StressScheme::Musl,
            ..Method::DEFAULT
        })
    }

    fn scene_with(&self, rung: &Rung, settings: &Settings) -> Scene {
        let h = rung.cell;
        let cells = (MESH / h).round() as usize;
        let mut mesh = Mesh::new(Dimension::Two, [0.0; 3], [h; 3], [cells, cells, 1]);
        mesh.planes[..2].fill([PlaneCondition::Free; 2]);
        let mut scene = Scene::new(Dimension::Two, mesh, PI / Self::spin());
        scene.name = String::from("rotation");
        scene.time_step = settings.equal_steps(scene.time, h, Self::fastest()).0;
        scene.results = NO_RESULTS;
        scene.materials = elastic(DENSITY, YOUNG, POISSON);
        scene.bodies = vec![body(
            "block",
            1,
            cuboid(
                [MIDDLE - HALF, MIDDLE - HALF, 0.0],
                [MIDDLE + HALF, MIDDLE + HALF, 0.0],
            ),
        )];
        settings.apply(&mut scene);
        scene
    }

    fn options(&self, _rung: &Rung, options: Options) -> Options {
        Options {
            displacement: true,
            initial: Some(Arc::new(|x| InitialState {
                velocity: Self::velocity(*x, Self::spin()),
                velocity_gradient: [
                    [0.0, -Self::spin(), 0.0],
                    [Self::spin(), 0.0, 0.0],
                    [0.0; 3],
                ],
                ..AT_REST
            })),
            ..options
        }
    }

    fn guest(&self, _rung: &Rung) -> Result<Guest, &'static str> {
        Err(
            "it begins with a velocity that is another at every place, and a scene file has one for a body",
        )
    }

    fn run(
        &self,
        rung: &Rung,
        settings: &Settings,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<Found, Failure> {
        let (_, steps) = settings.equal_steps(simulation.scene().time, rung.cell, Self::fastest());
        advance(simulation, steps, observer)?;
        let spin = self.reference_spin * Self::spin();
        let (t, before) = (simulation.time(), simulation.velocity_time());
        let displacement = l2(simulation, |p, x| {
            let turned = Self::turned(x, spin * t);
            let exact = std::array::from_fn(|axis| turned[axis] - x[axis]);
            Some((simulation.displacement(0, p)?, exact))
        });
        let velocity = l2(simulation, |p, x| {
            let exact = Self::velocity(Self::turned(x, spin * before), spin);
            Some((simulation.sets()[0].velocity(p), exact))
        });
        let quantities = vec![ratio(DISPLACEMENT, displacement), ratio(VELOCITY, velocity)];
        Ok(Found::new(quantities, None))
    }
}
