//! Does friction turn a disk as much as its impulse says?
//!
//! The disk of `rolling-disk` (R = 0.5 m, 300 kg/m³, nu = 0.3), twenty times as stiff (5 MPa), settles for 0.5 s on a rigid
//! line under the gravity normal to it and is then let go on slopes of 20, 30 and 45 degrees with mu = 0.1: it slides on all
//! of them, and turns by what friction gives it.
//!
//! Exact: d(angular momentum) = arm x d(impulse of friction), whatever the friction was; the arm is R less the approach of
//! the disk to the line (Johnson, eq. 5.57), 0.17 to 0.22 % here. The pressure on a disk that is elastic has no moment about its
//! centre. What is left is that of the method: forces that act elsewhere than at the vertices (by the weights of eq. 56 of
//! Liang et al. 2024 alone they act a tenth of a cell inside), inertia of mass on nodes, and a pressure that is not even about
//! the middle of the contact. `proctor verify slipping-disk`.

use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::mortar::boundary::{BoundarySide, Chain};
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    Damping, Dimension, Mortar, MortarContact, Scene, Shape, TransferKind, Vertices,
};
use std::f64::consts::{PI, TAU};

use super::dynamics::run;
use super::judging::{error_at_most, order_gate, table};
use super::mortar::{NO_GUEST, angular_momentum, barrier, boundary, rigid_line, settings};
use super::{NO_RESULTS, body, elastic, open_plane};
use crate::case::{Case, Curve, CurvePoint, Found, Quantity, Rung, Size, Solved, Verdict};
use crate::exact::hertz::{Hertz, contact_modulus};
use crate::guest::Guest;
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer, Study};

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.5;
const YOUNG: f64 = 5e6;
const POISSON: f64 = 0.3;
const DENSITY: f64 = 300.0;
const FRICTION: f64 = 0.1;
/// Distance below which the barrier pushes \[m\], and its stiffness \[Pa/m\].
const GAP: f64 = 0.04;
const KAPPA: f64 = 1e4;
/// Stiffness of the tangential spring \[Pa/m\].
const KAPPA_T: f64 = 1e6;
/// Local damping while the disk settles, and for how long \[s\].
const SETTLING: f64 = 0.3;
const STAGE: f64 = 0.5;
/// Time from the release to the end \[s\], and its parts after each of which is looked.
const TIME: f64 = 0.5;
const LOOKS: u32 = 20;

const SPIN: &str = "spin per impulse of friction";

/// Slopes \[degrees\], by variant.
const SLOPES: [(&str, f64); 3] = [("20 deg", 20.0), ("30 deg", 30.0), ("45 deg", 45.0)];

/// The disk on three slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlippingDisk {
    /// Arm of the reference over that of the disk. Anything but 1 is a wrong reference, to prove that the gates notice.
    pub reference_arm: f64,
}

impl SlippingDisk {
    /// The case as it is meant.
    pub const GIVEN: Self = Self { reference_arm: 1.0 };

    fn slope(rung: &Rung) -> f64 {
        let slope = SLOPES.iter().find(|(variant, _)| *variant == rung.variant);
        slope.map_or(f64::NAN, |(_, degrees)| degrees.to_radians())
    }

    /// Arm of the friction \[m\]: the radius less the approach of a disk to a rigid plane under its load.
    fn arm(slope: f64) -> f64 {
        let hertz = Hertz {
            radius: RADIUS,
            load: DENSITY * PI * RADIUS * RADIUS * GRAVITY * libm::cos(slope),
            modulus: contact_modulus([YOUNG, f64::INFINITY], [POISSON, 0.0]),
        };
        RADIUS - hertz.approach()
    }
}

impl Case for SlippingDisk {
    fn name(&self) -> &'static str {
        "slipping-disk"
    }

    fn question(&self) -> &'static str {
        "Does friction turn a disk as much as its impulse says?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        let quick: &[(&'static str, &[f64])] = &[("30 deg", &[0.2, 0.1])];
        let cells: &[f64] = &[0.2, 0.1, 0.05];
        match size {
            Size::Quick => Rung::ladders(quick),
            Size::Full => Rung::ladders(&SLOPES.map(|(variant, _)| (variant, cells))),
        }
    }

    with_own_settings!();

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let mut verdict = Verdict::default();
        for (variant, _) in SLOPES {
            if !solved.iter().any(|(rung, _)| rung.variant == variant) {
                continue;
            }
            let table = table(solved, variant, &[SPIN]);
            let (finest, bound) = match size {
                Size::Quick => (0.1, 0.04),
                Size::Full => (0.05, 0.01),
            };
            verdict.gates.push(error_at_most(
                solved,
                &format!("{variant} h={finest}"),
                SPIN,
                bound,
                "one percent at a tenth of the radius, four times as much at a fifth",
            ));
            let order = order_gate(&table, SPIN, 1.8, "inertia of mass on nodes is h² off");
            verdict
                .gates
                .push(super::judging::of_variant(variant, order));
            verdict.tables.push((variant.to_owned(), table));
        }
        verdict
    }
}

impl Study for SlippingDisk {
    fn path(&self, size: Size) -> Vec<Rung> {
        let cells: &[f64] = match size {
            Size::Quick => &[0.2, 0.1],
            Size::Full => &[0.2, 0.1, 0.05],
        };
        Rung::ladders(&[("30 deg", cells)])
    }

    fn measures(&self) -> Vec<Measure> {
        vec![Measure::new("spin", SPIN)]
    }

    fn refined_axes(&self) -> usize {
        2
    }

    fn own_settings(&self, _rung: &Rung) -> Settings {
        let method = Method {
            transfer: TransferKind::Apic,
            ..Method::DEFAULT
        };
        settings(method, 5)
    }

    fn scene_with(&self, rung: &Rung, settings: &Settings) -> Scene {
        let slope = Self::slope(rung);
        let (sin, cos) = libm::sincos(slope);
        let way = 0.5 * GRAVITY * (sin - FRICTION * cos) * TIME * TIME;
        let (from, to) = (-1.2, (way + 1.2).ceil());
        let mesh = open_plane(rung.cell, [from, -0.4], [to, 1.4]);
        let count = ((to - from - 0.4) / 0.1).round();
        let line = Chain {
            points: (0..=count as usize)
                .map(|k| {
                    let share = k as f64 / count;
                    Point::new(to - 0.2 - (to - from - 0.4) * share, 0.0)
                })
                .collect(),
            side: BoundarySide::Open,
        };
        let mut scene = Scene {
            name: rung.label.clone(),
            time_step: settings.multiplier(),
            gravity: [0.0, -GRAVITY * cos, 0.0],
            materials: elastic(DENSITY, YOUNG, POISSON),
            bodies: vec![body(
                "disk",
                1,
                Shape::Sphere {
                    center: [0.0, RADIUS + 0.5 * GAP, 0.0],
                    radius: RADIUS,
                },
            )],
            damping: Damping::Local { alpha: SETTLING },
            results: NO_RESULTS,
            mortar: Mortar {
                boundaries: vec![boundary(1, Vertices::Spacing(TAU * RADIUS / 64.0))],
                lines: vec![rigid_line("plane", 2, line, None)],
                contacts: vec![MortarContact {
                    friction: FRICTION,
                    tangential_stiffness: KAPPA_T,
                    ..barrier("disk on plane", [2, 1], GAP, KAPPA)
                }],
                ..Mortar::default()
            },
            ..Scene::new(Dimension::Two, mesh, STAGE + TIME)
        };
        settings.apply(&mut scene);
        scene
    }

    fn guest(&self, _rung: &Rung) -> Result<Guest, &'static str> {
        Err(NO_GUEST)
    }

    fn run(
        &self,
        rung: &Rung,
        _settings: &Settings,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<Found, Failure> {
        let slope = Self::slope(rung);
        let arm = self.reference_arm * Self::arm(slope);
        run(simulation, STAGE, &mut *observer, |_| ())?;
        let (sin, cos) = libm::sincos(slope);
        simulation.set_local_damping(None)?;
        simulation.set_gravity([GRAVITY * sin, -GRAVITY * cos, 0.0])?;
        let start = angular_momentum(simulation, 0);
        let (mut impulse, mut points) = (0.0, vec![]);
        for k in 1..=LOOKS {
            let time = f64::from(k) / f64::from(LOOKS) * TIME;
            let mut before = simulation.velocity_time();
            run(simulation, STAGE + time, &mut *observer, |simulation| {
                // A force kicks over the time between the velocities before and after it.
                let after = simulation.velocity_time();
                let force = simulation.mortar_force(1).map_or(f64::NAN, |f| f[0]);
                impulse -= force * (after - before);
                before = after;
            })?;
            points.push(CurvePoint {
                at: time,
                computed: start - angular_momentum(simulation, 0),
                exact: arm * impulse,
            });
        }
        let gained = points.last().map_or(f64::NAN, |p| p.computed);
        let quantities = vec![Quantity::compared(SPIN, gained / impulse, arm, "m")];
        let curve = Curve {
            title: format!("{}: angular momentum", rung.label),
            abscissa: "t in s",
            ordinate: "L in kg m²/s per m",
            points,
        };
        Ok(Found::new(quantities, Some(curve)))
    }
}
