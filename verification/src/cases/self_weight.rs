//! Does a soft column settle under its own weight to its exact height and stress?
//!
//! Source: verification notes, A5 (the column of AMPLE and of many MPM papers). A neo-Hookean column between rollers,
//! load number S = rho g H/M = 0.4, comes to rest by dynamic relaxation; its top sinks by a sixth of its height, so
//! that most particles have changed their cell when they are judged. Neo-Hookean, because then the answer does not
//! depend on the way.
//!
//! Expected: order 1 or better of GIMP ("approximately linear", AMPLE); 2 of cpGIMP, as its domains stay contiguous.
//! Linear functions need not come to rest at all. `proctor verify self-weight`.

use proctor_laws::NeoHookean;
use proctor_scene::simulation::{Options, Simulation};
use proctor_scene::{
    Damping, Dimension, DomainUpdate, Mesh, PlaneCondition, Scene, Vector, Weighting,
};

use super::dynamics::{DISPLACEMENT, STRESS, along, errors};
use super::judging::{error_gate, order_gate, table};
use super::statics::{most_steps, relax};
use super::{FIELDS, NO_RESULTS, body, cuboid, material};
use crate::case::{Case, Curve, Found, Rung, Size, Solved, Verdict};
use crate::exact::self_weight::{Law as ExactLaw, SelfWeightColumn};
use crate::guest::{self, Guest};
use crate::settings::{Method, Settings};
use crate::study::{Failure, Measure, Observer, Study};

/// Height \[m\].
const HEIGHT: f64 = 1.0;
/// Neo-Hookean; confined modulus 30 kPa.
const LAW: NeoHookean = NeoHookean::new(25e3, 0.25);
/// Density \[kg/m³\].
const DENSITY: f64 = 1200.0;
/// Gravity \[m/s²\].
const GRAVITY: f64 = 10.0;
/// Cells across the column. The answer does not vary across it.
const WIDTH: usize = 1;
/// Norm of the unbalanced force over the weight at which the column is at rest.
const RESIDUAL: f64 = 1e-7;
/// The one variant.
const VARIANT: &str = "column";

/// The column under its own weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfWeight {
    /// Gravity of the exact solution over that of the scene. Anything but 1 is a wrong reference, to prove that the
    /// gates notice.
    pub reference_gravity: f64,
}

impl SelfWeight {
    /// The case as it is meant.
    pub const GIVEN: Self = Self {
        reference_gravity: 1.0,
    };

    fn exact(self) -> SelfWeightColumn {
        SelfWeightColumn {
            law: ExactLaw::NeoHookean,
            height: HEIGHT,
            density: DENSITY,
            gravity: self.reference_gravity * GRAVITY,
            lambda: LAW.elasticity().lambda,
            mu: LAW.elasticity().shear,
        }
    }

    fn rungs_of(counts: &[u32]) -> Vec<Rung> {
        Rung::counted(VARIANT, "H/h", HEIGHT, counts)
    }

    /// Vertical stress over the initial height.
    fn curve(simulation: &Simulation, exact: &SelfWeightColumn, rung: &Rung) -> Option<Curve> {
        let set = &simulation.sets()[0];
        let points = along(simulation, 1, |p, y| {
            [set.stress(p)[1] / 1e3, exact.vertical_stress(y) / 1e3]
        })?;
        Some(Curve {
            title: format!("vertical stress over the column, {}", rung.label),
            abscissa: "initial height (m)",
            ordinate: "vertical stress (kPa)",
            points,
        })
    }
}

impl Case for SelfWeight {
    fn name(&self) -> &'static str {
        "self-weight"
    }

    fn question(&self) -> &'static str {
        "Does a soft column settle under its own weight to its exact height and stress?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        Self::rungs_of(match size {
            Size::Quick => &[8, 16, 32],
            Size::Full => &[8, 16, 32, 64],
        })
    }

    with_own_settings!();

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let table = table(solved, VARIANT, &[DISPLACEMENT, STRESS]);
        let order = "GIMP is known to be approximately linear here";
        let bound = match size {
            Size::Quick => 2e-2,
            Size::Full => 1e-2,
        };
        let rungs = self.rungs(size);
        let error = "one percent at 64 cells, two at 32, as order 1 allows";
        Verdict {
            gates: vec![
                error_gate(&rungs, solved, DISPLACEMENT, bound, error),
                order_gate(&table, DISPLACEMENT, 0.9, order),
                order_gate(&table, STRESS, 0.9, order),
            ],
            tables: vec![("self-weight, cpGIMP, USL, FLIP".to_owned(), table)],
            ..Verdict::default()
        }
    }
}

impl Study for SelfWeight {
    fn path(&self, size: Size) -> Vec<Rung> {
        Self::rungs_of(match size {
            Size::Quick => &[8, 16, 32],
            Size::Full => &[8, 16, 32, 64, 128],
        })
    }

    fn measures(&self) -> Vec<Measure> {
        FIELDS.to_vec()
    }

    fn refined_axes(&self) -> usize {
        1
    }

    fn own_settings(&self, _: &Rung) -> Settings {
        Settings::new(Method {
            weighting: Weighting::ContiguousGimp(DomainUpdate::Stretch),
            ..Method::DEFAULT
        })
    }

    fn scene_with(&self, rung: &Rung, settings: &Settings) -> Scene {
        let h = rung.cell;
        let cells = (HEIGHT / h).round() as usize;
        let mut mesh = Mesh::new(Dimension::Two, [0.0; 3], [h; 3], [WIDTH, cells + 1, 1]);
        mesh.planes[1][1] = PlaneCondition::Free;
        // The end of a relaxation is the rest, not a time.
        let mut scene = Scene::new(Dimension::Two, mesh, 1.0);
        scene.name = String::from("self_weight");
        scene.gravity = [0.0, -GRAVITY, 0.0];
        scene.damping = Damping::Kinetic;
        scene.time_step = settings.multiplier();
        scene.results = NO_RESULTS;
        scene.materials = material("neo-Hookean", DENSITY, LAW);
        scene.bodies = vec![body(
            "column",
            1,
            cuboid([0.0; 3], [WIDTH as f64 * h, HEIGHT, 0.0]),
        )];
        settings.apply(&mut scene);
        scene
    }

    fn options(&self, _rung: &Rung, options: Options) -> Options {
        Options {
            displacement: true,
            measure: true,
            ..options
        }
    }

    fn guest(&self, rung: &Rung) -> Result<Guest, &'static str> {
        let speed = ((LAW.elasticity().lambda + 2.0 * LAW.elasticity().shear) / DENSITY).sqrt();
        let mut scene = guest::slab(self.scene_with(rung, &guest::settings()));
        scene.time = guest::RELAXATION * HEIGHT / speed;
        // The column sinks fast, and its waves get faster: by two thirds together.
        let step = 0.5 * guest::COURANT * rung.cell / speed;
        let scene = guest::prepared(scene, 1, step);
        let exact = self.exact();
        let sunk = move |x: &Vector, _| [0.0, exact.position(x[1]) - x[1], 0.0];
        Ok(Guest::new(scene, sunk).at_the_end())
    }

    fn run(
        &self,
        rung: &Rung,
        settings: &Settings,
        simulation: &mut Simulation,
        observer: &mut dyn Observer,
    ) -> Result<Found, Failure> {
        let weight = DENSITY * GRAVITY * HEIGHT * WIDTH as f64 * rung.cell;
        let most = most_steps(settings, HEIGHT / rung.cell);
        relax(simulation, weight, RESIDUAL, most, observer)?;
        let exact = self.exact();
        let quantities = errors(
            simulation,
            |x| [0.0, exact.position(x[1]) - x[1], 0.0],
            |x| {
                let lateral = exact.lateral_stress(x[1]);
                [lateral, exact.vertical_stress(x[1]), lateral, 0.0, 0.0, 0.0]
            },
        );
        Ok(Found::new(
            quantities,
            Self::curve(simulation, &exact, rung),
        ))
    }
}
