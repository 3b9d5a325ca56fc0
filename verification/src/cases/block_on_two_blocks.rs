//! Does a block that stands on two others share its weight between them, where three bodies meet at a node?
//!
//! Two pillars side by side, which touch, and a block on the middle of both: at the nodes of the joint three bodies and
//! three pairs act at once. The scene is its own mirror image, so that each pillar carries half. It settles under local
//! damping, which then ends; what is judged is the mean over a window of undamped steps.
//!
//! Exact, step by step: the impulse of all contact forces on the block, less that of its weight, is the change of its
//! momentum; the forces on the three bodies add up to nothing. Hence the mean force over the window is W (1 + dv/gT), and
//! the pillars' loads differ by the change of angular momentum over the arm b/4, W (2/3) (1 + H²/b²) dv/gT for a
//! velocity dv of the edges: mirrored bits part where round-off decides whether a node touches.
//! `proctor verify block-on-two-blocks`.

use proctor_kernel::scene::{
    Body, Contact, ContactNormal, Damping, Dimension, Mesh, PlaneCondition, Scene, Shape,
    StressScheme, TimeStep, Vector,
};
use proctor_kernel::simulation::{Options, Simulation};

use super::incline::run;
use super::{NO_RESULTS, elastic, failed};
use crate::case::{Case, CaseError, Gate, Quantity, Relation, Rung, Size, Solved, Verdict};

/// Young's modulus \[Pa\].
const YOUNG: f64 = 1e6;
/// Poisson's ratio.
const POISSON: f64 = 0.3;
/// Density \[kg/m³\].
const DENSITY: f64 = 1e3;
/// Gravity \[m/s²\].
const GRAVITY: f64 = 10.0;
/// Width of a pillar, of the block, and height of the pillars \[m\].
const WIDTH: f64 = 0.4;
/// Height of the block \[m\].
const HEIGHT: f64 = 0.3;
/// Friction of all pairs.
const FRICTION: f64 = 0.2;
/// `c dt/h`.
const COURANT: f64 = 0.3;
/// Factor of local damping while they settle.
const DAMPING: f64 = 0.3;
/// Time to settle: about ten periods of the whole pile, 4 (0.4 + 0.3) m over 32 m/s \[s\].
const SETTLING: f64 = 0.9;
/// Length of the window \[s\].
const WINDOW: f64 = 0.5;

/// Name of the force on the block.
const TOTAL: &str = "contact force on the block over its weight";
/// Name of the difference of the pillars' shares.
const SHARES: &str = "difference of the pillars' loads, over the weight";
/// Name of the balance of momentum.
const MOMENTUM: &str = "impulse less change of momentum, over that of the weight";
/// Name of the sum of the forces on all bodies.
const SUM: &str = "sum of the forces on all bodies, over the weight";

/// Gates by quantity, with their reasons.
const GATES: [(&str, f64, &str); 4] = [
    (
        TOTAL,
        5e-3,
        "dv/gT: 0.016 if the pile swung between no load and twice its weight for the whole window",
    ),
    (
        SHARES,
        5e-3,
        "the same for the rocking: change of angular momentum over g T times the arm of the pillars",
    ),
    (
        MOMENTUM,
        1e-10,
        "an identity of the cycle; round-off is left",
    ),
    (
        SUM,
        1e-12,
        "every force has its opposite; round-off is left",
    ),
];

/// A block on two blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockOnTwoBlocks {
    /// Where the block stands from the joint, over its width \[1\]. Anything but 0 breaks the mirror, to prove that the
    /// gate on it notices.
    pub shift: f64,
    /// Density of the block over that of the exact weight. Anything but 1 is a wrong weight.
    pub heavier: f64,
}

/// Variants.
const VARIANTS: [(&str, Dimension, StressScheme); 4] = [
    ("2D USL", Dimension::Two, StressScheme::Usl),
    ("2D USF", Dimension::Two, StressScheme::Usf),
    ("2D MUSL", Dimension::Two, StressScheme::Musl),
    ("3D USL", Dimension::Three, StressScheme::Usl),
];

/// Sums over the window \[N s\].
#[derive(Clone, Copy, Debug, Default)]
struct Window {
    /// Upward impulse of contact on left pillar, right pillar and block.
    impulse: [f64; 3],
    /// Length \[s\].
    time: f64,
    /// Largest sum of the forces on all bodies \[N\].
    sum: f64,
}

impl BlockOnTwoBlocks {
    /// The case as it is meant.
    pub const GIVEN: Self = Self {
        shift: 0.0,
        heavier: 1.0,
    };

    fn variant(rung: &Rung) -> (Dimension, StressScheme) {
        let found = VARIANTS.iter().find(|v| v.0 == rung.variant);
        let &(_, dimension, scheme) = found.unwrap_or(&VARIANTS[0]);
        (dimension, scheme)
    }

    fn quantities(&self, simulation: &Simulation, window: &Window, before: f64) -> Vec<Quantity> {
        let up = simulation.scene().dimension.axes() - 1;
        let (mass, _, velocity) = simulation.center(2);
        let weight = mass * GRAVITY;
        let exact = weight / self.heavier;
        let all = weight * window.time;
        let [left, right, block] = window.impulse;
        let change = mass * (velocity[up] - before);
        let of_zero = |name, value: f64| Quantity {
            name,
            value,
            exact: Some(0.0),
            error: Some(value.abs()),
            unit: "1",
        };
        let total = block / window.time / exact;
        vec![
            Quantity {
                name: TOTAL,
                value: total,
                exact: Some(1.0),
                error: Some((total - 1.0).abs()),
                unit: "1",
            },
            of_zero(SHARES, (left - right) / all),
            of_zero(MOMENTUM, (block - all - change) / all),
            of_zero(SUM, window.sum / weight),
        ]
    }
}

impl Case for BlockOnTwoBlocks {
    fn name(&self) -> &'static str {
        "block-on-two-blocks"
    }

    fn question(&self) -> &'static str {
        "Does a block on two others share its weight between them, where three bodies meet at a node?"
    }

    fn rungs(&self, size: Size) -> Vec<Rung> {
        let cells: &[(f64, usize)] = match size {
            Size::Quick => &[(0.1, 3)],
            Size::Full => &[(0.1, 4), (0.05, 3)],
        };
        let of = |&(cell, count): &(f64, usize)| {
            VARIANTS.into_iter().take(count).map(move |v| Rung {
                label: format!("{} h={cell}", v.0),
                cell,
                variant: v.0,
            })
        };
        cells.iter().flat_map(of).collect()
    }

    fn scene(&self, rung: &Rung) -> Scene {
        let (dimension, scheme) = Self::variant(rung);
        let h = rung.cell;
        let up = dimension.axes() - 1;
        let cells = |length: f64| (length / h).round() as usize;
        // Two cells of air on both sides of the pillars, and above the block.
        let air = 2.0 * h;
        let (long, high) = (cells(2.0 * WIDTH) + 4, cells(WIDTH + HEIGHT) + 2);
        let counts = match dimension {
            Dimension::Two => [long, high, 1],
            Dimension::Three => [long, cells(WIDTH) + 4, high],
        };
        let mut mesh = Mesh::new(dimension, [0.0; 3], [h; 3], counts);
        mesh.planes[up][1] = PlaneCondition::Free;
        let mut scene = Scene::new(dimension, mesh, SETTLING + WINDOW);
        scene.name = String::from("block_on_two_blocks");
        scene.results = NO_RESULTS;
        scene.scheme = scheme;
        scene.damping = Damping::Local { alpha: DAMPING };
        scene.gravity[up] = -GRAVITY;
        scene.time_step = TimeStep::Multiplier {
            multiplier: COURANT,
            allow_unstable: false,
        };
        scene.materials = elastic(DENSITY, YOUNG, POISSON);
        let point = |x: f64, y: f64, z: f64| -> Vector {
            match dimension {
                Dimension::Two => [x, z, 0.0],
                Dimension::Three => [x, y, z],
            }
        };
        let body = |id: i64, name: &str, x: f64, z: f64, height: f64| Body {
            name: name.to_owned(),
            id,
            material: 0,
            shape: Shape::Cuboid {
                p1: point(x, air, z),
                p2: point(x + WIDTH, air + WIDTH, z + height),
            },
            particles_per_cell: [2, 2, if up == 1 { 1 } else { 2 }],
            velocity: [0.0; 3],
            motion: None,
        };
        let middle = air + (0.5 + self.shift) * WIDTH;
        scene.bodies = vec![
            body(1, "left", air, 0.0, WIDTH),
            body(2, "right", air + WIDTH, 0.0, WIDTH),
            body(3, "block", middle, WIDTH, HEIGHT),
        ];
        let contact = |id: i64, master: i64, slave: i64, normal| Contact {
            name: format!("bodies {master} and {slave}"),
            id,
            friction: FRICTION,
            master,
            slave,
            normal,
        };
        scene.contacts = vec![
            contact(1, 1, 3, ContactNormal::Master),
            contact(2, 2, 3, ContactNormal::Master),
            contact(3, 1, 2, ContactNormal::Collinear),
        ];
        scene
    }

    fn solve(
        &self,
        rung: &Rung,
        options: &Options,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Solved, CaseError> {
        let scene = self.scene(rung);
        scene.check().map_err(|e| failed(self, rung, &e))?;
        let mut simulation =
            Simulation::new(&scene, options).map_err(|e| failed(self, rung, &e))?;
        let mut observer = |share| progress(share);
        let up = scene.dimension.axes() - 1;
        run(&mut simulation, SETTLING, scene.time, &mut observer, |_| ())
            .map_err(|e| failed(self, rung, &e))?;
        simulation
            .set_local_damping(None)
            .map_err(|e| failed(self, rung, &e))?;
        let before = simulation.center(2).2[up];
        let mut kicked = simulation.velocity_time();
        let mut window = Window::default();
        run(
            &mut simulation,
            scene.time,
            scene.time,
            &mut observer,
            |s| {
                let kick = s.velocity_time() - kicked;
                kicked = s.velocity_time();
                window.time += kick;
                let mut sum = [0.0; 3];
                for body in 0..3 {
                    let force = s.contact_force(body);
                    window.impulse[body] += force[up] * kick;
                    for axis in 0..3 {
                        sum[axis] += force[axis];
                    }
                }
                window.sum = sum.iter().fold(window.sum, |most, f| most.max(f.abs()));
            },
        )
        .map_err(|e| failed(self, rung, &e))?;
        Ok(Solved {
            particles: simulation.particles(),
            steps: simulation.steps(),
            time: simulation.time(),
            quantities: self.quantities(&simulation, &window, before),
            drawings: vec![],
            curve: None,
        })
    }

    fn judge(&self, size: Size, solved: &[(Rung, Solved)]) -> Verdict {
        let mut verdict = Verdict::default();
        for rung in self.rungs(size) {
            let found = solved.iter().find(|(other, _)| *other == rung);
            for (name, bound, reason) in GATES {
                verdict.gates.push(Gate {
                    name: format!("{}: {name}", rung.label),
                    value: found.map_or(f64::NAN, |(_, s)| s.error(name)),
                    relation: Relation::AtMost,
                    bound,
                    reason,
                });
            }
        }
        verdict
    }
}
