//! Three fixed families on short ladders: every gate holds.

use proctor_scene::{StressScheme, TransferKind, Weighting};
use proctor_verification::mill::judge;
use proctor_verification::mill::ladder::Faults;
use proctor_verification::mill::material::Kind;
use proctor_verification::mill::problem::{Family, Problem};
use proctor_verification::settings::Method;

use super::{method, problem};

fn holds(problem: &Problem) {
    let (found, gates) = judge(problem, &Faults::default()).expect("a solution");
    let found = found.expect("runs");
    assert!(gates.len() >= 2, "{}", problem.name);
    for gate in &gates {
        assert!(gate.holds(), "{}: {gate:?}, {found:?}", problem.name);
    }
}

#[test]
fn a_floating_body_keeps_its_orders() {
    for method in [
        method(StressScheme::Usl, TransferKind::Apic),
        method(StressScheme::Musl, TransferKind::Flip),
    ] {
        holds(&problem(Family::Floating, Kind::NeoHookean, method));
    }
}

#[test]
fn a_body_between_planes_keeps_its_orders() {
    for kind in [Kind::Hencky, Kind::Elastic] {
        holds(&problem(
            Family::Box,
            kind,
            method(StressScheme::Usl, TransferKind::Tpic),
        ));
    }
}

/// All points yield: von Mises with hardening, and Drucker-Prager off its apex under a uniform stress.
#[test]
#[ignore = "takes 10 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn a_yielding_body_in_a_frame_keeps_its_orders() {
    let usl = method(StressScheme::Usl, TransferKind::Flip);
    holds(&problem(Family::Frame, Kind::VonMises, usl));
    holds(&problem(Family::Affine, Kind::DruckerPrager, usl));
    let usf = method(StressScheme::Usf, TransferKind::Apic);
    for kind in [Kind::VonMises, Kind::Bingham, Kind::MohrCoulomb] {
        holds(&problem(Family::Affine, kind, usf));
    }
}

/// On a face of the pyramid everywhere.
#[test]
#[ignore = "takes 7 s in a release: `cargo test -- --include-ignored` runs it, as CI does"]
fn a_clay_in_a_frame_keeps_its_orders() {
    let usl = method(StressScheme::Usl, TransferKind::Apic);
    holds(&problem(Family::Frame, Kind::Tresca, usl));
}

/// Two bodies in contact move as the one that was cut.
#[test]
fn a_body_that_is_cut_keeps_its_orders() {
    for method in [
        method(StressScheme::Musl, TransferKind::Apic),
        method(StressScheme::Usf, TransferKind::Flip),
    ] {
        let method = Method {
            weighting: Weighting::UniformGimp,
            ..method
        };
        holds(&problem(Family::Cut, Kind::Elastic, method));
    }
}
