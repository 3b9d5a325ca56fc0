//! Contact that is much stiffer than the bodies.

use super::corner::{Falls, boundary, mortar_pair, onto_surface};
use super::prelude::*;

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
];

/// Reason for which particles come nearer to a surface than a penalty should let them.
const STRAINED: &str = "a surface holds the face of a particle, so that its centre comes nearer by the strain \
    of the half of it between them, a fortieth of a cell here; the penalty acts where contact gives no impulse";

/// Stiffness of contact over that of a cell.
const RATIOS: [f64; 2] = [1e2, 1e4];
const SPEED: f64 = 0.05;

/// Two blocks that meet, one a little higher.
fn mortar(enforcement: Enforcement, ratio: f64, friction: f64) -> Scene {
    let mut scene = open([16, 9]);
    for (id, from, velocity) in [(1, [3.1, 3.1], SPEED), (2, [7.5, 3.5], -SPEED)] {
        let shape = rectangle(from, [from[0] + 4.0, from[1] + 3.0]);
        scene.body(shape, elastic(1.0, 0.3), 1.0).velocity = [velocity, 0.0, 0.0];
        scene.mortar.boundaries.push(boundary(id));
    }
    scene.mortar.contacts = vec![MortarContact {
        friction,
        ..mortar_pair([1, 2], 0.2, ratio, enforcement)
    }];
    scene
}

fn stiff_mortar(scheme: StressScheme, ratio: f64) -> RowVerdict {
    let mut unbalanced = gate("sum of the forces on both, over the largest push")
        .at_most(1e-12)
        .because("nodes of the one get the momentum that nodes of the other give; sums over many vertices");
    let mut left = gate("energy after the collision over that before it")
        .at_most(1.1)
        .because("the blocks have parted and nothing did work; their swing is seen with speeds half a step late");
    let mut kept = Conservation::named("collision");
    let mut slowest = gate("speed at which they part over that at which they met")
        .at_least(f64::MIN_POSITIVE)
        .because("elastic bodies part again");
    let mut warnings = gate("warnings of the plan")
        .at_least(1.0)
        .because("contact that is stiffer than the cells behind it is reported before it runs");
    for enforcement in [Enforcement::Barrier, Enforcement::Penalty] {
        for friction in [0.0, 0.3] {
            let scene = mortar(enforcement, ratio, friction).with_scheme(scheme);
            let mut simulation = kept.start(&scene, &options())?;
            warnings.see(simulation.plan().warnings.len() as f64);
            let begin = energy(&simulation);
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
            left.see(energy(&simulation) / begin);
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
        .at_most(1.01)
        .because("nothing does work, and steps of a thousandth of a wave's time through a cell put speeds and stresses together");
    let mut pressed = gate("energy that contact still stores, over that of the start")
        .at_most(0.0)
        .because("the blocks have parted");
    let mut kept = Conservation::named("collision");
    kept.drift.name = String::from("change of momentum, over the momentum in all directions");
    for enforcement in [Enforcement::Barrier, Enforcement::Penalty] {
        let scene = mortar(enforcement, 1e4, 0.0)
            .with_transfer(Transfer::new(transfer))
            .with_time_step(fixed(1e-3));
        let mut simulation = kept.start(&scene, &options())?;
        let begin = energy(&simulation);
        to_time(&mut simulation, END)?;
        kept.look(&simulation);
        left.see(energy(&simulation) / begin);
        pressed.see(simulation.mortar_energy() / begin);
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
    for ratio in RATIOS {
        let name = format!("{ratio:e} times as stiff");
        let mut falls = Falls::named(&name, 2);
        for scheme in SCHEMES {
            let scene = onto_surface([7, 7, 8], cube, &plane, Some(ratio))?.with_scheme(scheme);
            falls.watch(&scene, 25.0, |s| s.surface_force(0).map(|f| -f))?;
        }
        let depth = gate(format!("{name}: deepest penetration over a cell"))
            .at_most(1e-3)
            .because("sweeps of contact leave 1e-6 of the velocity of the fall, which the penalty pushes out again")
            .found(falls.depth);
        finding = finding.and(falls.gates()).and([depth]);
    }
    Ok(finding)
}
