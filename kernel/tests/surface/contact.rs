//! Contact with rigid surfaces in the cycle.

use crate::surface::slide::{raise, start};
use crate::surface::slope::{GRAVITY, H, Slope, dot};
use proctor_scene::plan::{Plan, PlanOptions};
use proctor_scene::simulation::{Options, Part, SetupError, Simulation, SurfaceContactError};
use proctor_scene::{Damping, History, StressScheme, Transfer, TransferKind};

const SCHEMES: [StressScheme; 3] = [StressScheme::Usl, StressScheme::Usf, StressScheme::Musl];

/// Runs to the end; the acceleration down the slope, fitted over the second half, and the way of the centre of mass.
fn slide(slope: &Slope) -> (f64, f64) {
    let mut simulation = slope.simulation(1);
    let start = simulation.center(0).position;
    let mut samples = vec![];
    while simulation.time() < slope.end {
        simulation.step(slope.end).expect("a step");
        if simulation.time() > 0.5 * slope.end {
            let v = dot(&simulation.center(0).velocity, &slope.down());
            samples.push((simulation.velocity_time(), v));
        }
    }
    let count = samples.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| samples.iter().map(of).sum::<f64>() / count;
    let (t, v) = (mean(&|s| s.0), mean(&|s| s.1));
    let fit = mean(&|s| (s.0 - t) * (s.1 - v)) / mean(&|s| (s.0 - t).powi(2));
    let end = simulation.center(0).position;
    let moved = std::array::from_fn(|axis| end[axis] - start[axis]);
    (fit, dot(&moved, &slope.down()))
}

/// A block slides over a plane at 30 degrees to the grid with g (sin - mu cos). Gravity is switched on at once, so the
/// normal force swings about the weight: the fit over a part of a swing is off by what the swing leaves, the way of
/// the whole run by less.
#[test]
fn a_block_slides_down_a_tilted_plane() {
    for scheme in SCHEMES {
        for friction in [0.0, 0.2, 0.5] {
            let slope = Slope::new(scheme, friction);
            let (fit, way) = slide(&slope);
            let a = slope.acceleration();
            let exact = slope.speed * slope.end + 0.5 * a * slope.end.powi(2);
            let (fit, way) = (fit / a - 1.0, way / exact - 1.0);
            println!("{scheme:?} mu {friction}: acceleration {fit:+.2e}, way {way:+.2e}");
            assert!(way.abs() < 0.01, "{scheme:?} {friction}: way off by {way}");
            // Impulses along the normal alone change nothing along the slope, to round-off.
            let allowed = if friction == 0.0 { 1e-11 } else { 0.01 };
            assert!(
                fit.abs() < allowed,
                "{scheme:?} {friction}: acceleration off by {fit}"
            );
        }
    }
}

/// With mu above tan 30 the block comes to rest and stays: what it still creeps after a while is how it swings in shear on
/// the particles that hold, which dies down.
#[test]
fn a_rough_plane_holds_the_block() {
    for scheme in SCHEMES {
        let slope = Slope {
            speed: 0.0,
            end: 0.8,
            ..Slope::new(scheme, 0.7)
        };
        let mut scene = slope.scene();
        scene.damping = Damping::Local { alpha: 0.3 };
        let mut simulation = start(&scene, 1);
        let begin = simulation.center(0).position;
        let mut middle = begin;
        while simulation.time() < slope.end {
            simulation.step(slope.end).expect("a step");
            if simulation.time() < 0.5 * slope.end {
                middle = simulation.center(0).position;
            }
        }
        let end = simulation.center(0).position;
        let way = |a: &[f64; 3], b: &[f64; 3]| {
            dot(
                &std::array::from_fn(|axis| b[axis] - a[axis]),
                &slope.down(),
            )
        };
        let free = 0.5 * GRAVITY * 0.5 * slope.end.powi(2);
        assert!(
            way(&begin, &end) < 0.01 * free,
            "{scheme:?}: {}",
            way(&begin, &end)
        );
        let creep = way(&middle, &end) / (0.5 * slope.end);
        assert!(creep.abs() < 1e-4, "{scheme:?} creeps at {creep} m/s");
    }
}

/// The block neither sinks nor hovers: its lowest particles stay on the plane, and the force is its weight.
#[test]
fn the_plane_carries_the_weight() {
    for scheme in SCHEMES {
        let slope = Slope {
            end: 0.4,
            speed: 0.0,
            ..Slope::new(scheme, 0.0)
        };
        let mut scene = slope.scene();
        scene.gravity = slope.normal().map(|n| -GRAVITY * n);
        scene.damping = Damping::Local { alpha: 0.2 };
        let mut simulation = start(&scene, 1);
        simulation.run_until(slope.end).expect("a step");
        let gaps: Vec<f64> = (0..simulation.particles())
            .filter_map(|p| simulation.surface_gap(0, 0, p, 0.2 * H))
            .map(|(gap, _)| gap / H)
            .collect();
        assert_eq!(gaps.len(), 32, "the lowest layer");
        assert!(
            gaps.iter().all(|gap| gap.abs() < 1e-3),
            "{scheme:?}: {gaps:?}"
        );
        let weight = simulation.mass() * GRAVITY;
        let normal = dot(&simulation.contact_force(0), &slope.normal());
        assert!(
            (normal / weight - 1.0).abs() < 1e-3,
            "{scheme:?}: {}",
            normal / weight
        );
        let force = simulation.contact_force(0);
        assert_eq!(simulation.surface_force(0), force.map(|f| -f));
    }
}

/// Momentum changes by weight and impulse alone, in each direction that no wall holds.
#[test]
fn impulse_is_change_of_momentum() {
    for scheme in SCHEMES {
        for kind in [TransferKind::Flip, TransferKind::Apic] {
            let slope = Slope {
                end: 0.1,
                ..Slope::new(scheme, 0.3)
            };
            let mut scene = slope.scene();
            scene.transfer = Transfer::new(kind);
            let mut simulation = start(&scene, 1);
            let before = simulation.momentum();
            simulation.run_until(slope.end).expect("a step");
            let (after, impulse) = (simulation.momentum(), simulation.surface_impulse(0, 0));
            let scale = simulation.mass() * (slope.speed + GRAVITY * slope.end);
            for axis in [0, 2] {
                let weight = simulation.mass() * scene.gravity[axis] * simulation.velocity_time();
                let lost = after[axis] - before[axis] - weight - impulse[axis];
                assert!(lost.abs() < 1e-12 * scale, "{scheme:?} {kind:?}: {lost}");
            }
            assert!(dot(&impulse, &slope.normal()) > 0.1 * scale);
        }
    }
}

/// The force lies in the friction cone and never pulls, in every step.
#[test]
fn the_force_lies_in_the_cone() {
    for friction in [0.0, 0.3, 1.0] {
        let slope = Slope {
            end: 0.05,
            lift: -0.5,
            ..Slope::new(StressScheme::Usl, friction)
        };
        let mut simulation = slope.simulation(1);
        while simulation.time() < slope.end {
            simulation.step(slope.end).expect("a step");
            let force = simulation.contact_force(0);
            let normal = dot(&force, &slope.normal());
            let across = (dot(&force, &force) - normal * normal).max(0.0).sqrt();
            assert!(normal >= 0.0);
            assert!(across <= friction * normal * (1.0 + 1e-9) + 1e-7 * normal);
        }
    }
}

#[test]
fn no_force_on_a_body_that_leaves() {
    for scheme in SCHEMES {
        let slope = Slope {
            gravity: 0.0,
            speed: 0.2,
            lift: 1.0,
            end: 0.05,
            ..Slope::new(scheme, 0.5)
        };
        let mut with = slope.simulation(1);
        let mut scene = slope.scene();
        scene.surfaces.clear();
        let mut without = start(&scene, 1);
        while with.time() < slope.end {
            with.step(slope.end).expect("a step");
            without.step(slope.end).expect("a step");
            assert_eq!(with.contact_force(0), [0.0; 3]);
        }
        assert_eq!(with.state_hash(), without.state_hash(), "{scheme:?}");
    }
}

#[test]
fn bits_do_not_depend_on_threads() {
    for scheme in SCHEMES {
        let slope = Slope {
            end: 0.05,
            ..Slope::new(scheme, 0.3)
        };
        let run = |threads: usize| {
            let mut simulation = slope.simulation(threads);
            simulation.run_until(slope.end).expect("a step");
            (simulation.state_hash(), simulation.surface_impulse(0, 0))
        };
        let one = run(1);
        assert_eq!(run(2), one);
        assert_eq!(run(5), one);
    }
}

/// A plane that moves with the block, both without gravity: no force; a plane that rises carries it along.
#[test]
fn a_surface_that_moves() {
    let steady = |velocity: [f64; 3]| History {
        times: vec![0.0],
        values: vec![velocity],
    };
    let slope = Slope {
        gravity: 0.0,
        end: 0.02,
        lift: 0.3,
        ..Slope::new(StressScheme::Usl, 0.5)
    };
    let mut scene = slope.scene();
    let along = scene.bodies[0].velocity;
    scene.surfaces[0].motion = Some(steady(along));
    let mut simulation = start(&scene, 1);
    simulation.run_until(slope.end).expect("a step");
    let impulse = simulation.surface_impulse(0, 0);
    let scale = simulation.mass() * slope.speed;
    assert!(dot(&impulse, &impulse).sqrt() < 1e-9 * scale, "{impulse:?}");

    // A ramp of the velocity: 1 m/s after 0.1 s, then steady; the block ends with that velocity on average, and the
    // surface did the work.
    let up = slope.normal();
    let slope = Slope {
        end: 0.3,
        speed: 0.0,
        lift: 0.0,
        ..slope
    };
    let mut scene = slope.scene();
    scene.damping = Damping::Local { alpha: 0.05 };
    scene.surfaces[0].motion = Some(History {
        times: vec![0.0, 0.1],
        values: vec![[0.0; 3], up],
    });
    let mut simulation = start(&scene, 1);
    while simulation.time() < slope.end {
        simulation.step(slope.end).expect("a step");
        if let Some((gap, _)) = (0..simulation.particles())
            .filter_map(|p| simulation.surface_gap(0, 0, p, H))
            .min_by(|a, b| a.0.total_cmp(&b.0))
        {
            assert!(gap > -1e-3 * H, "{gap}");
        }
    }
    let shift = simulation.surface_shift(0, simulation.time());
    assert!((dot(&shift, &up) - (0.05 + 0.2)).abs() < 1e-12);
    let speed = dot(&simulation.center(0).velocity, &up);
    assert!(speed > 0.99, "{speed}");
    let energy = simulation.energy();
    assert!(energy.external_work > energy.kinetic);
}

/// A surface that comes from three cells away to a body at rest takes it along: it is found though nothing but the surface
/// has moved.
#[test]
fn a_surface_that_comes_from_afar() {
    let slope = Slope {
        gravity: 0.0,
        speed: 0.0,
        ..Slope::new(StressScheme::Usl, 0.0)
    };
    let (mut scene, up, way) = (slope.scene(), slope.normal(), 3.0 * H);
    raise(&mut scene, &slope, way);
    scene.time = way + 0.2;
    scene.damping = Damping::Local { alpha: 0.05 };
    scene.surfaces[0].motion = Some(History {
        times: vec![0.0],
        values: vec![up],
    });
    let mut simulation = start(&scene, 1);
    while simulation.time() < scene.time {
        simulation.step(scene.time).expect("a step");
        let gaps = (0..simulation.particles()).filter_map(|p| simulation.surface_gap(0, 0, p, H));
        let deepest = gaps.fold(0.0_f64, |least, (gap, _)| least.min(gap));
        assert!(deepest > -1e-2 * H, "{deepest}");
    }
    let speed = dot(&simulation.center(0).velocity, &up);
    assert!(speed > 0.9, "{speed}");
}

/// A body that starts inside a surface is named with depth and place.
#[test]
fn overlap_at_the_start() {
    let slope = Slope::new(StressScheme::Usl, 0.0);
    let mut scene = slope.scene();
    scene.bodies[0].velocity = [0.0; 3];
    raise(&mut scene, &slope, -0.02);
    match Simulation::new(&scene, &Options::default()) {
        Err(SetupError::Body { body, reason }) => {
            assert_eq!(body, "block");
            assert!(
                reason.contains("0.02 m") || reason.contains("0.0200"),
                "{reason}"
            );
            assert!(reason.contains("slope"), "{reason}");
        }
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("the overlap was not seen"),
    }
}

/// A step longer than the threshold is refused, with particle, way and threshold.
#[test]
fn a_particle_that_would_jump_the_threshold() {
    let slope = Slope {
        lift: -2.0,
        ..Slope::new(StressScheme::Musl, 0.0)
    };
    let mut scene = slope.scene();
    scene.surfaces[0].distance_threshold = 1e-4 * H;
    let mut simulation = start(&scene, 1);
    let error = simulation.step(slope.end).expect_err("too fast");
    match error.kind.fault() {
        Some(SurfaceContactError::TooFastForSurface {
            approach,
            threshold,
            surface,
            particle,
        }) => {
            assert!(approach > threshold);
            assert_eq!((surface.as_str(), particle.body), ("slope", 1));
        }
        other => panic!("{other:?}"),
    }
    assert!(error.to_string().contains("distance_threshold"), "{error}");
}

#[test]
fn the_plan_keeps_it_or_says_why_not() {
    let mut scene = Slope::new(StressScheme::Usl, 0.0).scene();
    let entry = |plan: &Plan| {
        let found = plan
            .entries
            .iter()
            .find(|e| e.name == "contact with rigid surfaces");
        found.expect("an entry").clone()
    };
    let with = entry(&proctor_scene::simulation::plan(
        &scene,
        PlanOptions::default(),
    ));
    assert!(
        with.kept && with.because.contains("2 triangles, 4 open edges"),
        "{with:?}"
    );
    scene.surfaces.clear();
    let without = entry(&proctor_scene::simulation::plan(
        &scene,
        PlanOptions::default(),
    ));
    assert!(!without.kept);
}

/// The work of a surface is the same after a rehearsal as before it.
#[test]
fn a_rehearsal_leaves_the_impulses_of_surfaces() {
    for scheme in SCHEMES {
        let slope = Slope::new(scheme, 0.2);
        let mut plain = slope.simulation(1);
        let mut rehearsed = slope.simulation(1);
        for simulation in [&mut plain, &mut rehearsed] {
            for _ in 0..20 {
                simulation.step(slope.end).expect("a step");
            }
        }
        for part in Part::ALL {
            let mut rehearsal = rehearsed.rehearse(part).expect("a sound step");
            for _ in 0..3 {
                rehearsal.set().expect("a sound step");
                rehearsal.play().expect("a sound step");
            }
            drop(rehearsal);
            let of = |s: &mut Simulation| (s.surface_impulse(0, 0), s.contact_force(0), s.energy());
            assert_eq!(of(&mut plain), of(&mut rehearsed), "{scheme:?} {part:?}");
        }
        assert_ne!(plain.surface_impulse(0, 0), [0.0; 3], "no contact");
    }
}
