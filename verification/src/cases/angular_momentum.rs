//! How much of its angular momentum does a free body lose that spins?
//!
//! Source: verification notes, 5; Jiang et al. 2015. An elastic square spins about its centre for a turn, free of everything,
//! with corners at 2 % of the wave speed. With quadratic B-splines the moment of inertia of an affine velocity is that
//! of a square of side h·sqrt(3), `m h²/4`, so that its angular momentum can be counted with that of the particles.
//!
//! Stress is symmetric and weights reproduce linear fields: nodes exert no torque on each other. APIC takes from the nodes
//! what they have, affine part and all, and moves particles with the velocity that they carry, so that the sum stays to
//! round-off. FLIP brings all that particles have to the nodes, but moves them with another velocity than they carry,
//! and gets of increments only their mean over the particle: it loses like h². TPIC takes velocity gradients for the
//! affine velocity, which are not the moments that nodes have. What FLIP and TPIC lose is stated, and judged is what theory
//! says, APIC. The energy that each gains at most is stated, too.
//! `proctor verify angular-momentum`.

use std::f64::consts::{SQRT_2, TAU};
use std::sync::Arc;

use proctor_scene::simulation::{InitialState, Options, Simulation};
use proctor_scene::{Dimension, Scene, StressScheme, TransferKind, Weighting};

use super::dynamics::advance;
use super::judging::{error_at_most, value_of};
use super::parts::open_plane;
use super::{AT_REST, NO_RESULTS, body, cuboid, elastic, solve_scene};
use crate::case::{
    Case, CaseError, Curve, CurvePoint, Found, Quantity, Rung, Size, Solved, Verdict,
};
use crate::settings::{Method, Settings};
use crate::study::Study;

/// Side of the block \[m\].
const SIDE: f64 = 0.5;
/// Half the side of the mesh, about the centre of the block \[m\].
const HALF_MESH: f64 = 0.5;
/// Young's modulus \[Pa\].
const YOUNG: f64 = 1e6;
/// Poisson's ratio.
const POISSON: f64 = 0.3;
/// Density \[kg/m³\].
const DENSITY: f64 = 1000.0;
/// Speed of the corners over the wave speed.
const SPEED: f64 = 2e-2;
/// Name of what the angular momentum changes by.
const DRIFT: &str = "angular momentum lost in a turn, over it";
/// The same, as a figure that nothing exact says.
const DRIFT_STATED: &str = "angular momentum lost in a turn";
/// Largest kinetic and strain energy over that of the start, less 1.
const GAIN: &str = "largest energy gained in a turn";
/// Largest change at any time, over it.
const LARGEST: &str = "largest change of the angular momentum";
/// Round-off of some thousand steps.
const ROUND_OFF: f64 = 1e-11;

/// Transfers with the scheme that they are run with, by the word of their variants.
const VARIANTS: [(&str, TransferKind, StressScheme); 9] = [
    ("FLIP USL", TransferKind::Flip, StressScheme::Usl),
    ("FLIP USF", TransferKind::Flip, StressScheme::Usf),
    ("FLIP MUSL", TransferKind::Flip, StressScheme::Musl),
    ("APIC USL", TransferKind::Apic, StressScheme::Usl),
    ("APIC USF", TransferKind::Apic, StressScheme::Usf),
    ("APIC MUSL", TransferKind::Apic, StressScheme::Musl),
    ("TPIC USL", TransferKind::Tpic, StressScheme::Usl),
    ("TPIC USF", TransferKind::Tpic, StressScheme::Usf),
    ("TPIC MUSL", TransferKind::Tpic, StressScheme::Musl),
];

/// A block that spins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularMomentum {
    /// Angular momentum that is referred to over that at the start. Anything but 1 is a wrong reference, to prove that
    /// the gates notice.
    pub reference: f64,
}

impl AngularMomentum {
    /// The case as it is meant.
    pub const GIVEN: Self = Self { reference: 1.0 };

    fn method(rung: &Rung) -> Method {
        let found = VARIANTS.iter().find(|(name, ..)| *name == rung.variant);
        let (_, transfer, scheme) = *found.unwrap_or(&VARIANTS[0]);
        Method {
            weighting: Weighting::QuadraticBSpline,
            scheme,
            transfer,
        }
    }

    /// P-wave speed \[m/s\].
    fn wave_speed() -> f64 {
        let confined = YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
        (confined / DENSITY).sqrt()
    }

    /// Angular velocity \[rad/s\].
    fn spin() -> f64 {
        SPEED * Self::wave_speed() / (0.5 * SIDE * SQRT_2)
    }

    /// Settings, and the number of steps of a turn.
    fn settings(rung: &Rung) -> (Settings, u64) {
        let settings = Settings::new(Self::method(rung));
        let fastest = (1.0 + SPEED) * Self::wave_speed();
        let (_, steps) = settings.equal_steps(TAU / Self::spin(), rung.cell, fastest);
        (settings, steps)
    }

    /// Angular momentum about the origin, affine velocities with it \[kg m²/s\].
    fn of(simulation: &Simulation) -> f64 {
        let set = &simulation.sets()[0];
        let h = simulation.scene().mesh.cell[0];
        let terms = (0..set.len()).map(|p| {
            let (m, x, v) = (
                simulation.mass_and_volume(0, p).0,
                simulation.position(0, p),
                set.velocity(p),
            );
            let affine = set.layout.affine.map_or(0.0, |first| {
                // Row by row: dv_x/dy and dv_y/dx.
                set.columns[first + 2][p] - set.columns[first + 1][p]
            });
            m * (x[0] * v[1] - x[1] * v[0] + 0.25 * h * h * affine)
        });
        terms.sum()
    }
}

impl Case for AngularMomentum {
    fn name(&self) -> &'static str {
        "angular-momentum"
    }

    fn question(&self) -> &'static str {
        "How much of its angular momentum does a free body lose that spins?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        let counts: &[u32] = match size {
            Size::Quick => &[4],
            Size::Full => &[4, 8, 16],
        };
        VARIANTS
            .iter()
            .flat_map(|(name, ..)| Rung::counted(name, &format!("{name} side/h"), SIDE, counts))
            .collect()
    }

    fn scene(&self, rung: &Rung) -> Scene {
        let mesh = open_plane(rung.cell, [-HALF_MESH; 2], [HALF_MESH; 2]);
        let mut scene = Scene::new(Dimension::Two, mesh, TAU / Self::spin());
        scene.name = String::from("angular_momentum");
        let (settings, _) = Self::settings(rung);
        let fastest = (1.0 + SPEED) * Self::wave_speed();
        scene.time_step = settings.equal_steps(scene.time, rung.cell, fastest).0;
        scene.results = NO_RESULTS;
        scene.materials = elastic(DENSITY, YOUNG, POISSON);
        let half = 0.5 * SIDE;
        let block = cuboid([-half, -half, 0.0], [half, half, 0.0]);
        scene.bodies = vec![body("block", 1, block)];
        settings.apply(&mut scene);
        scene
    }

    fn studies(&self) -> Result<Vec<&dyn Study>, &'static str> {
        Err(
            "the moment of inertia of an affine velocity is the same everywhere with B-splines alone",
        )
    }

    fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError> {
        let spin = Self::spin();
        let options = Options {
            initial: Some(Arc::new(move |x| InitialState {
                velocity: [-spin * x[1], spin * x[0], 0.0],
                velocity_gradient: [[0.0, -spin, 0.0], [spin, 0.0, 0.0], [0.0; 3]],
                ..AT_REST
            })),
            ..options.clone()
        };
        let (_, steps) = Self::settings(rung);
        solve_scene(self, rung, &options, |simulation| {
            let start = Self::of(simulation);
            let energy =
                |simulation: &Simulation| simulation.kinetic_energy() + simulation.strain_energy();
            let (first, mut gain) = (energy(simulation), 0.0_f64);
            let every = (steps / 100).max(1);
            let (mut points, mut largest) = (vec![], 0.0_f64);
            while simulation.steps() < steps {
                let next = (simulation.steps() + every).min(steps);
                advance(simulation, next, &mut |_| ())?;
                let change = Self::of(simulation) / start - self.reference;
                largest = largest.max(change.abs());
                gain = gain.max(energy(simulation) / first - 1.0);
                points.push(CurvePoint {
                    at: spin * simulation.time() / TAU,
                    computed: change,
                    exact: 0.0,
                });
                progress(simulation.steps() as f64 / steps as f64);
            }
            let drift = self.reference - Self::of(simulation) / start;
            let mut quantities = if Self::method(rung).transfer == TransferKind::Apic {
                vec![
                    Quantity::of_zero(DRIFT, drift),
                    Quantity::of_zero(LARGEST, largest),
                ]
            } else {
                vec![Quantity::figure(DRIFT_STATED, drift, "1")]
            };
            quantities.push(Quantity::figure(GAIN, gain, "1"));
            let curve = Curve {
                title: format!("change of the angular momentum, {}", rung.label),
                abscissa: "turns",
                ordinate: "change / initial",
                points,
            };
            Ok(Found::new(quantities, Some(curve)))
        })
    }

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let mut verdict = Verdict::default();
        for rung in self.rungs(size) {
            if Self::method(&rung).transfer == TransferKind::Apic {
                for name in [DRIFT, LARGEST] {
                    let reason = "what nodes have particles get, and give back; round-off is left";
                    let gate = error_at_most(solved, &rung.label, name, ROUND_OFF, reason);
                    verdict.gates.push(gate);
                }
            } else {
                let drift = value_of(solved, &rung.label, DRIFT_STATED);
                verdict.for_the_record.push(format!(
                    "{}: {:.2} % of the angular momentum is lost in a turn",
                    rung.label,
                    100.0 * drift
                ));
            }
            let gain = value_of(solved, &rung.label, GAIN);
            verdict.for_the_record.push(format!(
                "{}: {:.2} % of energy gained at most",
                rung.label,
                100.0 * gain
            ));
        }
        verdict
    }
}
