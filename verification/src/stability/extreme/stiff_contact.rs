//! Contact that is much stiffer than the bodies.

use std::sync::Arc;

use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::{
    BodyBoundary, Enforcement, MortarContact, RigidSurface, Scene, Shape, StressScheme, TimeStep,
    Transfer, TransferKind, Vertices,
};

use super::corner::{Fall, fair, watch_fall};
use super::trial::{
    Kept, ONLY_ROUND_OFF, ROUND_OFF, apart, elastic, energy, kept, open, open_space, run_to, start,
    step, worst,
};
use super::{Extreme, Finding, Unexpected};
use crate::case::Gate;
use crate::stability::map::SCHEMES;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme {
        name: "stiff-mortar",
        what: "mortar contact, penalty and barrier, 1e2 times as stiff as a cell of the bodies, with USL",
        required: "warned of; momentum to round-off, no growth of energy, thrown back",
        cause: None,
        judge: || stiff_mortar(StressScheme::Usl, 1e2),
    },
    Extreme {
        name: "stiff-mortar-1e4",
        what: "the same, 1e4 times as stiff",
        required: "the same",
        cause: None,
        judge: || stiff_mortar(StressScheme::Usl, 1e4),
    },
    Extreme {
        name: "stiff-mortar-musl",
        what: "1e2 times as stiff with MUSL, whose free steps are three times as long",
        required: "the same",
        cause: None,
        judge: || stiff_mortar(StressScheme::Musl, 1e2),
    },
    Extreme {
        name: "stiff-mortar-apic",
        what: "1e4 times as stiff with APIC and steps of a thousandth of a wave's time through a cell",
        required: "no more energy after the collision than before it",
        cause: None,
        judge: || resolved(TransferKind::Apic),
    },
    Extreme {
        name: "stiff-mortar-flip",
        what: "the same with FLIP",
        required: "the same",
        cause: None,
        judge: || resolved(TransferKind::Flip),
    },
    Extreme {
        name: "stiff-penalty",
        what: "a penalty of a rigid surface, per particle 1e2 and 1e4 times as stiff as a cell of the body",
        required: "momentum is what weight and surface gave, nothing pulls, no growth of energy",
        cause: Some(STRAINED),
        judge: stiff_penalty,
    },
];

/// Why particles come nearer to a surface than a penalty should let them.
const STRAINED: &str = "a surface holds the face of a particle, so that its centre comes nearer by what the half of it between them is \
             strained, a fortieth of a cell here; the penalty acts where contact gives no impulse";

/// Stiffness of contact over that of a cell.
const RATIOS: [f64; 2] = [1e2, 1e4];
const SPEED: f64 = 0.05;

/// Two blocks that meet, one a little higher.
fn mortar(enforcement: Enforcement, ratio: f64, friction: f64) -> Scene {
    let mut scene = open([16, 9]);
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    for (from, velocity) in [([3.1, 3.1], SPEED), ([7.5, 3.5], -SPEED)] {
        let shape = Shape::rectangle(from, [from[0] + 4.0, from[1] + 3.0]);
        let mut body = scene.add_body(shape, material);
        body.velocity = [velocity, 0.0, 0.0];
        let id = body.id;
        scene.mortar.boundaries.push(BodyBoundary {
            body: id,
            vertices: Vertices::Spacing(0.5),
            follow: FollowMode::Spin,
        });
    }
    scene.mortar.contacts = vec![MortarContact {
        name: String::from("contact"),
        id: 1,
        master: 1,
        slave: 2,
        friction,
        critical_gap: 0.2,
        normal_stiffness: ratio,
        tangential_stiffness: ratio,
        enforcement,
        detection: Detection::Mortar,
    }];
    scene
}

fn stiff_mortar(scheme: StressScheme, ratio: f64) -> Result<Finding, Unexpected> {
    let [mut drift, mut grown, mut unbalanced, mut left] = [0.0; 4];
    let (mut slowest, mut warnings) = (f64::INFINITY, f64::INFINITY);
    for enforcement in [Enforcement::Barrier, Enforcement::Penalty] {
        for friction in [0.0, 0.3] {
            let mut scene = mortar(enforcement, ratio, friction);
            scene.scheme = scheme;
            let mut simulation = start(&scene, None)?;
            warnings = warnings.min(simulation.plan().warnings.len() as f64);
            let mut balance = Kept::of(&simulation);
            let begin = energy(&simulation);
            let (mut off, mut push) = (0.0, 0.0_f64);
            // The gap closes in 2 s, waves go through a block and back in 7 s. A run that exploded shows no more.
            while simulation.time() < 25.0 && balance.grown < 1e3 {
                step(&mut simulation, 25.0)?;
                balance.look(&simulation);
                let force = |id| simulation.mortar_force(id).unwrap_or([f64::NAN; 3]);
                off = worst(off, apart(&force(1), &force(2).map(|f| -f)));
                push = push.max(force(2)[0]);
            }
            drift = worst(drift, balance.drift);
            grown = worst(grown, balance.grown);
            unbalanced = worst(unbalanced, off / push);
            left = worst(left, energy(&simulation) / begin);
            let [v, w] = [0, 1].map(|set| simulation.center(set).velocity[0]);
            let back = (w - v) / (2.0 * SPEED);
            slowest = if back < slowest || back.is_nan() {
                back
            } else {
                slowest
            };
        }
    }
    let mut gates = kept("collision", drift, grown).to_vec();
    gates.extend([
        Gate::at_least(
            String::from("warnings of the plan"),
            warnings,
            1.0,
            "contact that is stiffer than the cells behind it is told before it runs",
        ),
        Gate::at_most(
            String::from("sum of the forces on both, over the largest push"),
            unbalanced,
            1e-12,
            "what nodes of the one get the nodes of the other give; sums over many vertices",
        ),
        Gate::at_most(
            String::from("energy after the collision over that before it"),
            left,
            1.1,
            "the blocks have parted and nothing did work; what swings in them is seen with speeds half a step late",
        ),
        Gate::at_least(
            String::from("speed at which they part over that at which they met"),
            slowest,
            f64::MIN_POSITIVE,
            "elastic bodies part again",
        ),
    ]);
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}

/// Runs collisions with steps that resolve everything.
fn resolved(transfer: TransferKind) -> Result<Finding, Unexpected> {
    // The gap closes in 2 s, waves go through a block and back in 7 s.
    const END: f64 = 15.0;
    let [mut left, mut pressed, mut drift] = [0.0; 3];
    for enforcement in [Enforcement::Barrier, Enforcement::Penalty] {
        let mut scene = mortar(enforcement, 1e4, 0.0);
        scene.transfer = Transfer::new(transfer);
        scene.time_step = TimeStep::Fixed {
            dt: 1e-3,
            allow_unstable: false,
        };
        let mut simulation = start(&scene, None)?;
        let mut balance = Kept::of(&simulation);
        let begin = energy(&simulation);
        run_to(&mut simulation, END, |_, _| ())?;
        balance.look(&simulation);
        drift = worst(drift, balance.drift);
        left = worst(left, energy(&simulation) / begin);
        pressed = worst(pressed, simulation.mortar_energy() / begin);
    }
    Ok(Finding {
        gates: vec![
            Gate::at_most(
                String::from("change of momentum, over the momentum in all directions"),
                drift,
                ROUND_OFF,
                ONLY_ROUND_OFF,
            ),
            Gate::at_most(
                String::from("energy that contact still stores, over that of the start"),
                pressed,
                0.0,
                "the blocks have parted",
            ),
            Gate::at_most(
                String::from("energy after the collision over that before it"),
                left,
                1.01,
                "nothing does work, and steps of a thousandth of a wave's time through a cell put speeds and stresses together",
            ),
        ],
        refusals: vec![],
    })
}

fn onto_plane(scheme: StressScheme, ratio: f64) -> Result<Fall, Unexpected> {
    let mut scene = open_space([7, 7, 8]).with_gravity([0.0, 0.0, -1e-3]);
    scene.scheme = scheme;
    let material = scene.add_material(elastic(1.0, 0.3), 1.0);
    let block = Shape::Cuboid {
        p1: [2.5, 2.5, 2.1],
        p2: [4.5, 4.5, 4.1],
    };
    scene.add_body(block, material).velocity = [0.0, 0.0, -SPEED];
    let at = |x: f64, y: f64| [x, y, 1.8];
    let corners = [
        [at(0.5, 0.5), at(6.5, 0.5), at(6.5, 6.5)],
        [at(0.5, 0.5), at(6.5, 6.5), at(0.5, 6.5)],
    ];
    let surface = Surface::new(&corners).map_err(|error| Unexpected(error.to_string()))?;
    scene.surfaces = vec![RigidSurface {
        name: String::from("plane"),
        surface: Arc::new(surface),
        friction: 0.0,
        distance_threshold: 1.0,
        penalty_stiffness: Some(ratio),
        motion: None,
    }];
    watch_fall(&scene, 2, 25.0, |s| s.surface_force(0).map(|f| -f))
}

fn stiff_penalty() -> Result<Finding, Unexpected> {
    let mut gates = vec![];
    for ratio in RATIOS {
        let mut falls = vec![];
        for scheme in SCHEMES {
            falls.push(onto_plane(scheme, ratio)?);
        }
        let name = format!("{ratio:e} times as stiff");
        gates.extend(fair(&name, &falls.iter().collect::<Vec<_>>()));
        gates.push(Gate::at_most(
            format!("{name}: deepest penetration over a cell"),
            falls.iter().map(|fall| fall.depth).fold(0.0, worst),
            1e-3,
            "sweeps of contact leave 1e-6 of the velocity of the fall, which the penalty pushes out again",
        ));
    }
    Ok(Finding {
        gates,
        refusals: vec![],
    })
}
