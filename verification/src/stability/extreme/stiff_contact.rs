//! Contact that is much stiffer than the bodies, falls onto corners, and what a fall with contact must keep.

use super::prelude::*;
use crate::cases::{barrier, boundary, open_line, rubbing};
use proctor_contact::geometry::mortar::Point;
use proctor_contact::geometry::surface::Surface;

/// The rows of this file.
pub static ROWS: &[Extreme] = &[
    Extreme::of("stiff-mortar", || stiff_mortar(StressScheme::Usl, 1e2))
        .with("mortar contact, penalty and barrier, 1e2 times as stiff as a cell of the bodies, with USL")
        .must("warned of; momentum to round-off, no growth of energy, thrown back"),
    Extreme::of("stiff-mortar-1e4", || stiff_mortar(StressScheme::Usl, 1e4))
        .with("the same, 1e4 times as stiff")
        .must("the same"),
    Extreme::of("stiff-mortar-musl", || stiff_mortar(StressScheme::Musl, 1e2))
        .with("1e2 times as stiff with MUSL, whose free steps are three times as long")
        .must("the same"),
    Extreme::of("stiff-mortar-apic", || resolved(TransferKind::Apic))
        .with("1e4 times as stiff with APIC and steps of a thousandth of a wave's time through a cell")
        .must("no more energy after the collision than before it"),
    Extreme::of("stiff-mortar-flip", || resolved(TransferKind::Flip))
        .with("the same with FLIP")
        .must("the same"),
    Extreme::of("stiff-penalty", stiff_penalty)
        .with("a penalty of a rigid surface, per particle 1e2 and 1e4 times as stiff as a cell of the body")
        .must("momentum is that of weight and surface, nothing pulls, no growth of energy")
        .because(STRAINED),
    Extreme::of("corner-fall", corner_fall)
        .with("free fall of a cube onto a ridge, and of a square onto its own corner")
        .must("momentum is that of weight and contact, nothing pulls, nothing passes, no growth of energy"),
];

/// Reason for which particles come nearer to a surface than a penalty should let them.
const STRAINED: &str = "a surface holds the face of a particle, so that its centre comes nearer by the strain \
    of the half of it between them, a fortieth of a cell here; the penalty acts where contact gives no impulse";

/// Speed of the blocks that meet \[m/s\].
const SPEED: f64 = 0.05;

/// Two blocks that meet, one a little higher.
fn mortar(enforcement: Enforcement, ratio: f64, friction: f64) -> Scene {
    let mut scene = open([16, 9]);
    for (id, from, velocity) in [(1, [3.1, 3.1], SPEED), (2, [7.5, 3.5], -SPEED)] {
        let shape = rectangle(from, [from[0] + 4.0, from[1] + 3.0]);
        scene.body(shape, elastic(1.0, 0.3), 1.0).velocity = [velocity, 0.0, 0.0];
        scene.mortar.boundaries.push(outline(id));
    }
    let smooth = barrier("contact", [1, 2], 0.2, ratio);
    scene.mortar.contacts = vec![MortarContact {
        enforcement,
        ..rubbing([friction, ratio], smooth)
    }];
    scene
}

fn stiff_mortar(scheme: StressScheme, ratio: f64) -> RowVerdict {
    let mut unbalanced = gate("sum of the forces on both, over the largest push").at_most(
        1e-12,
        "nodes of the one get the momentum that nodes of the other give; sums over many vertices",
    );
    let mut left = gate("energy after the collision over that before it")
        .at_most(1.1, "the blocks have parted and nothing did work; their swing is seen with speeds half a step late");
    let mut kept = Conservation::named("collision");
    let mut slowest = gate("speed at which they part over that at which they met")
        .at_least(f64::MIN_POSITIVE, "elastic bodies part again");
    let mut warnings = gate("warnings of the plan").at_least(
        1.0,
        "contact that is stiffer than the cells behind it is reported before it runs",
    );
    for enforcement in [Enforcement::Barrier, Enforcement::Penalty] {
        for friction in [0.0, 0.3] {
            let scene = mortar(enforcement, ratio, friction).with_scheme(scheme);
            let mut simulation = kept.start(&scene, &options())?;
            warnings.see(simulation.plan().warnings.len() as f64);
            let (mut off, mut push) = (0.0, 0.0_f64);
            // The gap closes in 2 s, waves go through a block and back in 7 s. A run that exploded shows no more.
            while simulation.time() < 25.0 && kept.grown.value < 1e3 {
                step(&mut simulation, 25.0)?;
                kept.look(&simulation);
                let force = |id| simulation.mortar_force(id).unwrap_or([f64::NAN; 3]);
                off = worst(off, apart(&force(1), &force(2).map(|f| -f)));
                push = push.max(force(2)[0]);
            }
            unbalanced.see(off / push);
            left.see(kept.balance.grown(&simulation));
            let [v, w] = [0, 1].map(|set| simulation.center(set).velocity[0]);
            slowest.see((w - v) / (2.0 * SPEED));
        }
    }
    Ok(Finding::of(kept.gates()).and([warnings, unbalanced, left, slowest]))
}

/// Runs collisions with steps that resolve everything.
fn resolved(transfer: TransferKind) -> RowVerdict {
    // The gap closes in 2 s, waves go through a block and back in 7 s.
    const END: f64 = 15.0;
    let mut left = gate("energy after the collision over that before it")
        .at_most(1.01, "nothing does work, and steps of a thousandth of a wave's time through a cell put speeds and stresses together");
    let mut pressed = gate("energy that contact still stores, over that of the start")
        .at_most(0.0, "the blocks have parted");
    let mut kept = Conservation::named("collision");
    kept.drift.name = String::from("change of momentum, over the momentum in all directions");
    for enforcement in [Enforcement::Barrier, Enforcement::Penalty] {
        let scene = mortar(enforcement, 1e4, 0.0)
            .with_transfer(Transfer::new(transfer))
            .with_time_step(fixed(1e-3));
        let mut simulation = kept.start(&scene, &options())?;
        to_time(&mut simulation, END)?;
        kept.look(&simulation);
        left.see(kept.balance.grown(&simulation));
        pressed.see(simulation.mortar_energy() / kept.balance.energy);
    }
    Ok(Finding::of([kept.drift, pressed, left]))
}

fn stiff_penalty() -> RowVerdict {
    let cube = [[2.5, 2.5, 2.1], [4.5, 4.5, 4.1]];
    let at = |x: f64, y: f64| [x, y, 1.8];
    let plane = [
        [at(0.5, 0.5), at(6.5, 0.5), at(6.5, 6.5)],
        [at(0.5, 0.5), at(6.5, 6.5), at(0.5, 6.5)],
    ];
    let mut finding = Finding::default();
    // Stiffness of contact over that of a cell.
    for ratio in [1e2, 1e4] {
        let name = format!("{ratio:e} times as stiff");
        let scenes = with_schemes(&onto_surface([7, 7, 8], cube, &plane, Some(ratio))?);
        let (gates, deepest) = falls(&name, 2, &scenes, 25.0, from_surface)?;
        let depth = gate(format!("{name}: deepest penetration over a cell"))
            .at_most(1e-3, "sweeps of contact leave 1e-6 of the velocity of the fall, which the penalty pushes out again")
            .found(deepest);
        finding = finding.and(gates).and([depth]);
    }
    Ok(finding)
}

/// Falls with contact along the axis `up`: gates on the worst of some scenes, and the deepest penetration of a particle
/// into a rigid surface \[m\]; `force` is that of contact on the body in a step \[N\].
fn falls(
    name: &str,
    up: usize,
    scenes: &[Scene],
    time: f64,
    force: impl Fn(&Simulation) -> Vector,
) -> Result<([Gate; 5], f64)> {
    let of = |what: &str| gate(format!("{name}: {what}"));
    let mut pushed = of("impulse of contact over the momentum of the fall").at_least(
        1.0,
        "a stopped body has got at least the momentum that it fell with",
    );
    let mut lost =
        of("momentum that neither weight nor contact gave").at_most(ROUND_OFF, ONLY_ROUND_OFF);
    let mut pulled = of("pull over push").at_most(ROUND_OFF, "contact never pulls");
    let mut sideways = of("impulse sideways over that upwards")
        .at_most(1e-5, "the scene is its own mirror image; sweeps of contact end at 1e-6 of the change of the first one");
    let mut grown = of("energy over what start and weight gave").at_most(GROWN, NO_GROWTH);
    let mut depth = 0.0;
    for scene in scenes {
        let mut simulation = start(scene, &options())?;
        let (mass, before) = (simulation.mass(), simulation.momentum());
        let begin = energy(&simulation);
        let from = simulation.center(0).position[up];
        let (mut impulse, mut kicks, mut dt_before) = ([0.0; 3], 0.0, 0.0);
        let (mut pull, mut push) = (0.0_f64, 0.0_f64);
        run_to(&mut simulation, time, |s, info| {
            // Velocities are half a step behind positions.
            let kick = 0.5 * (dt_before + info.dt);
            dt_before = info.dt;
            kicks += kick;
            let now = force(s);
            for axis in 0..3 {
                impulse[axis] += now[axis] * kick;
            }
            push = push.max(now[up]);
            pull = pull.max(-now[up]);
            let exact: Vector =
                std::array::from_fn(|k| before[k] + impulse[k] + mass * scene.gravity[k] * kicks);
            lost.see(apart(&s.momentum(), &exact) / momentum_scale(s));
            let surface = scene.surfaces.first();
            let gaps = surface.into_iter().flat_map(|_| 0..s.particles());
            for (gap, _) in gaps.filter_map(|p| s.surface_gap(0, 0, p, 1.0)) {
                depth = worst(depth, -gap);
            }
            let fallen = from - s.center(0).position[up];
            let given = begin - mass * scene.gravity[up] * fallen;
            grown.see(energy(s) / given.max(begin));
        })?;
        for axis in (0..3).filter(|axis| *axis != up) {
            sideways.see((impulse[axis] / impulse[up]).abs());
        }
        pulled.see(pull / push);
        pushed.see(impulse[up] / before[up].abs());
    }
    Ok(([pushed, lost, pulled, sideways, grown], depth))
}

/// An elastic cube that falls at a speed onto a rigid surface without friction; the weight is a thousandth of a cell per
/// square second.
fn onto_surface(
    cells: [usize; 3],
    [p1, p2]: [Vector; 2],
    corners: &[[Vector; 3]],
    penalty_stiffness: Option<f64>,
) -> Result<Scene> {
    let mut scene = open_space(cells).with_gravity([0.0, 0.0, -1e-3]);
    scene.body(cuboid(p1, p2), elastic(1.0, 0.3), 1.0).velocity = [0.0, 0.0, -0.05];
    let surface = Surface::new(corners).map_err(|error| RowFault(error.to_string()))?;
    scene.surfaces = vec![RigidSurface {
        name: String::from("surface"),
        surface: Arc::new(surface),
        friction: 0.0,
        distance_threshold: 1.0,
        penalty_stiffness,
        motion: None,
    }];
    Ok(scene)
}

/// The boundary of a body, with a vertex every half cell.
fn outline(body: i64) -> BodyBoundary {
    boundary(body, Vertices::Spacing(0.5))
}

/// A cube that falls on a ridge of two triangles' width below its middle.
fn ridge() -> Result<Scene> {
    const MIDDLE: f64 = 4.0;
    let cube = [[MIDDLE - 1.0, 3.0, 3.1], [MIDDLE + 1.0, 5.0, 5.1]];
    let (a, b) = ([MIDDLE, 0.5, 2.8], [MIDDLE, 7.5, 2.8]);
    let [left, right] = [0.5, 7.5].map(|x| [[x, 0.5, 0.6], [x, 7.5, 0.6]]);
    let corners = [
        [a, b, left[0]],
        [b, left[1], left[0]],
        [a, right[0], b],
        [right[0], right[1], b],
    ];
    onto_surface([8, 8, 9], cube, &corners, None)
}

/// A square that falls on its own corner onto a rigid line.
fn own_corner() -> Scene {
    let points = [[6.0, 4.2], [8.0, 6.2], [6.0, 8.2], [4.0, 6.2]];
    let points = points.map(|[x, y]| [x, y, 0.0]).to_vec();
    let square = Shape::Polygon { points };
    let mut scene = alone([12, 12], square, elastic(1.0, 0.3)).with_gravity([0.0, -1e-3]);
    scene.bodies[0].velocity = [0.0, -0.05, 0.0];
    // The material is on the left of a line, so it lies below one that runs to the left.
    let ground = [Point::new(11.0, 4.0), Point::new(1.0, 4.0)];
    scene.mortar.lines = vec![open_line("ground", 9, ground, None)];
    scene.mortar.boundaries = vec![outline(1)];
    let smooth = barrier("contact", [9, 1], 0.15, 10.0);
    scene.mortar.contacts = vec![rubbing([0.0, 10.0], smooth)];
    scene
}

/// The force of the first rigid surface on a body \[N\].
fn from_surface(simulation: &Simulation) -> Vector {
    simulation.surface_force(0).map(|f| -f)
}

fn corner_fall() -> RowVerdict {
    let cubes = with_schemes(&ridge()?);
    let (cube, _) = falls("cube on a ridge", 2, &cubes, 30.0, from_surface)?;
    // Mortar contact is refused with USF.
    let squares = [StressScheme::Usl, StressScheme::Musl].map(|s| own_corner().with_scheme(s));
    let from_line = |s: &Simulation| s.mortar_force(1).unwrap_or([f64::NAN; 3]);
    let (square, _) = falls("square on its corner", 1, &squares, 40.0, from_line)?;
    Ok(Finding::of(cube).and(square))
}
