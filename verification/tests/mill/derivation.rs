//! Motions, stresses and forces against differences and against the kernel's laws.

use proctor_laws::{Hencky, Law, NeoHookean, Point};
use proctor_scene::{StressScheme, TransferKind, Weighting};
use proctor_verification::mill::check::{Derivation, derivation};
use proctor_verification::mill::draw::{self, Choice};
use proctor_verification::mill::judge;
use proctor_verification::mill::ladder::Faults;
use proctor_verification::mill::material::{Kind, Material, determinant_of};
use proctor_verification::mill::motion::{Matrix, product};
use proctor_verification::mill::problem::Family;

use super::{method, problem};

const METHOD: proctor_verification::settings::Method =
    method(StressScheme::Usl, TransferKind::Flip);

/// F is the gradient of the places, and Div P the divergence of P, in every family, with every law, in the plane and in space.
#[test]
fn derivatives_are_those_of_differences() {
    for axes in [2, 3] {
        for family in Family::ALL {
            for kind in Kind::ALL {
                let of_frame = kind.yields() && !family.has_frame();
                let of_plane = kind.has_edges() && axes == 3;
                let cut = family == Family::Cut && kind != Kind::Elastic;
                if of_frame || of_plane || cut {
                    continue;
                }
                let choice = Choice {
                    axes,
                    family,
                    kind,
                    method: METHOD,
                };
                let problem = draw::of(&mut draw::dice(1, 0, 0), &choice, String::new());
                let Ok(problem) = problem else { continue };
                let found = derivation(&problem);
                assert!(found.holds(), "{choice:?}: {found:?}");
            }
        }
    }
}

#[test]
fn what_is_not_a_number_is_no_derivation() {
    for [deformation, force] in [[f64::NAN, 0.0], [0.0, f64::NAN], [1e-3, 0.0], [0.0, 1e-3]] {
        assert!(!Derivation { deformation, force }.holds());
    }
}

/// Velocity and acceleration are the derivatives of the place by time.
#[test]
fn velocities_and_accelerations_are_those_of_differences() {
    let problem = problem(Family::Floating, Kind::NeoHookean, METHOD);
    let motion = &problem.motion;
    let (x0, t) = ([0.21, -0.13, 0.0], 0.4 * problem.end);
    let step = 1e-4 * problem.end;
    let at = |t: f64| motion.place(&x0, t);
    let [before, now, after] = [at(t - step), at(t), at(t + step)];
    let [_, velocity, acceleration] = motion.at(t).motion(&motion.of(&x0));
    let (speed, change) = (1.0 / problem.end, problem.end.powi(-2));
    for axis in 0..2 {
        let v = (after[axis] - before[axis]) / (2.0 * step);
        let a = (after[axis] - 2.0 * now[axis] + before[axis]) / (step * step);
        assert!((v - velocity[axis]).abs() < 1e-7 * speed);
        assert!((a - acceleration[axis]).abs() < 1e-5 * change);
    }
}

/// Every motion begins where the body is filled.
#[test]
fn places_at_the_start_are_those_of_the_body() {
    for family in Family::ALL {
        let problem = problem(family, Kind::Hencky, METHOD);
        for x0 in problem.samples(5) {
            let x = problem.motion.place(&x0, 0.0);
            for axis in 0..3 {
                assert!((x[axis] - x0[axis]).abs() < 1e-15);
            }
        }
    }
}

/// Closed forms of elastic laws give the stress that the kernel's laws give.
#[test]
fn stresses_are_those_of_the_kernel() {
    // F = (1 + a)(1 + b)...: three steps, none of them symmetric.
    let gradients: [Matrix; 3] = [
        [[0.10, 0.08, -0.03], [0.02, -0.07, 0.04], [0.05, 0.01, 0.06]],
        [
            [-0.04, 0.03, 0.09],
            [-0.08, 0.05, 0.02],
            [0.01, -0.06, 0.03],
        ],
        [
            [0.07, -0.02, 0.01],
            [0.09, 0.04, -0.05],
            [-0.03, 0.02, -0.08],
        ],
    ];
    for kind in [Kind::NeoHookean, Kind::Hencky] {
        let material = Material {
            kind,
            young: 3e6,
            poisson: 0.3,
            strength: 1.0,
            hardening: 0.0,
            viscosity: 0.0,
            density: 1000.0,
            stress: [0.0; 6],
        };
        let mut point = Point::new(&material.law(), 1000.0, [0.0; 6]);
        let mut f = proctor_laws::UNDEFORMED;
        for gradient in &gradients {
            point.step(gradient, 1.0).expect("a finite stress");
            let mut relative = *gradient;
            for axis in 0..3 {
                relative[axis][axis] += 1.0;
            }
            f = product(&relative, &f);
        }
        let tau = material.kirchhoff::<f64, 3>(&f, &[[0.0; 3]; 3]);
        let jacobian = determinant_of::<f64, 3>(&f);
        let of = |i: usize, j: usize| tau[i][j] / jacobian;
        let expected = [of(0, 0), of(1, 1), of(2, 2), of(1, 2), of(0, 2), of(0, 1)];
        for (found, expected) in point.stress().iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12 * 3e6, "{kind:?}");
        }
    }
    assert_eq!(
        Law::name(&NeoHookean::new(1.0, 0.0)),
        Kind::NeoHookean.word()
    );
    assert_eq!(Law::name(&Hencky::new(1.0, 0.0)), Kind::Hencky.word());
}

#[test]
fn a_problem_follows_from_seed_and_number() {
    let drawn = |seed, number| draw::problem(seed, number, 0);
    for number in 0..20 {
        assert_eq!(drawn(3, number), drawn(3, number));
        assert_ne!(drawn(3, number), drawn(4, number));
    }
}

/// A motion that inverts or stretches too far is refused with the reason.
#[test]
fn what_has_no_solution_is_refused() {
    let mut wild = problem(Family::Box, Kind::NeoHookean, METHOD);
    for coefficient in wild.motion.field.polynomials.iter_mut().flatten() {
        *coefficient *= 10.0;
    }
    let refused = draw::solvable(&wild).expect_err("a body that is stretched too far");
    assert!(refused.contains("stretches from"), "{refused}");
    let mut pressed = problem(Family::Affine, Kind::NeoHookean, METHOD);
    pressed.motion.stretch = [[0.0; 3]; 3];
    for axis in 0..2 {
        pressed.motion.stretch[axis][axis] = -2.0 / pressed.end;
    }
    let refused = draw::solvable(&pressed).expect_err("a body that inverts");
    assert!(refused.contains("det F"), "{refused}");
}

/// Problem 266 of seed 8: its step is stable without viscosity, and the kernel refuses it with it.
#[test]
fn a_step_above_that_of_viscosity_is_refused() {
    let refused = draw::problem(8, 266, 0).expect_err("a step above the critical one");
    assert!(refused.contains("under viscosity"), "{refused}");
    let kinds = [TransferKind::Flip, TransferKind::Apic];
    for method in kinds.map(|transfer| method(StressScheme::Usf, transfer)) {
        let mut fluid = problem(Family::Box, Kind::Newtonian, method);
        draw::solvable(&fluid).expect("a stable step");
        fluid.material.viscosity *= 100.0;
        let refused = draw::solvable(&fluid).expect_err("a step above the critical one");
        assert!(refused.contains("under viscosity"), "{refused}");
        fluid.share_of_step = 1e-3;
        draw::solvable(&fluid).expect("a short step");
    }
}

/// A float with FLIP turns by no more than its strain allows, one in rate form by 0.4 rad; fluids strain by 0.1 at most; bodies that
/// yield or flow between domains that follow them have three particles per cell and axis.
#[test]
fn draws_keep_their_limits() {
    let mut found = [0; 4];
    for number in 0..300 {
        let Ok(problem) = draw::problem(11, number, 0) else {
            continue;
        };
        let motion = &problem.motion;
        let steepest = (problem.samples(21).iter())
            .map(|x| {
                motion
                    .of(x)
                    .gradient
                    .iter()
                    .flatten()
                    .map(|x| x * x)
                    .sum::<f64>()
            })
            .fold(0.0, f64::max)
            .sqrt();
        let turn = (motion.spin * problem.end).abs();
        let follows = matches!(problem.method.weighting, Weighting::ContiguousGimp(_));
        let (kind, floats) = (problem.material.kind, problem.family == Family::Floating);
        if floats && problem.method.transfer == TransferKind::Flip {
            found[0] += 1;
            assert!(
                turn <= 5.0 * steepest * (1.0 + 1e-9),
                "{number}: {turn} at {steepest}"
            );
        }
        if floats && kind == Kind::Elastic {
            found[1] += 1;
            assert!(turn <= 0.4, "{number}: {turn}");
        }
        if kind == Kind::Newtonian && problem.family == Family::Box {
            found[2] += 1;
            assert!(steepest <= 0.1 + 1e-9, "{number}: {steepest}");
        }
        if kind.yields() && follows {
            found[3] += 1;
        }
        let bears_none = kind.yields() || kind == Kind::Newtonian;
        let particles = if bears_none && follows { 3 } else { 2 };
        assert_eq!(problem.particles_per_cell, particles, "{number}");
    }
    assert!(found.iter().all(|count| *count > 0), "{found:?}");
}

/// A frame that strains back unloads points that yield: the body force would jump.
#[test]
fn what_stops_to_yield_is_refused() {
    let mut frame = problem(Family::Frame, Kind::VonMises, METHOD);
    for rate in frame.motion.stretch.iter_mut().flatten() {
        *rate = -*rate;
    }
    let refused = judge(&frame, &Faults::default()).expect_err("points that unload");
    assert!(refused.contains("stops to yield"), "{refused}");
}
