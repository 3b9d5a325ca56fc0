//! The table that the kernel holds, against a sample that is measured anew.

use proctor_scene::plan::AUTOMATIC_SHARE;
use proctor_scene::{Dimension, StressScheme, TransferKind, Weighting};
use proctor_verification::settings::Method;
use proctor_verification::stability::block::{Choice, Form};

use proctor_verification::stability::table::TOO_CAREFUL;

/// Smallest predicted limits of bodies that are more than a cell thick, and of all bodies.
fn found(choice: &Choice) -> [f64; 2] {
    let mut found = [f64::INFINITY; 2];
    for form in Form::all(choice.dimension, choice.particles_per_cell) {
        let courant = choice.worst_of(form).expect("a limit").courant;
        found[1] = found[1].min(courant);
        if form.is_thick() {
            found[0] = found[0].min(courant);
        }
    }
    found
}

fn choice(
    (weighting, scheme, transfer): (Weighting, StressScheme, TransferKind),
    dimension: Dimension,
    particles_per_cell: usize,
) -> Choice {
    Choice {
        method: Method {
            weighting,
            scheme,
            transfer,
        },
        dimension,
        particles_per_cell,
    }
}

/// Safety of a number, and its share of the largest safe one.
fn judge(choice: &Choice) -> f64 {
    let [thick, any] = found(choice);
    let held = choice.method.stability_number(choice.particles_per_cell);
    let name = choice.name();
    assert!(
        held <= thick,
        "{name}: {held} is too much, thick bodies hold to {thick}"
    );
    assert!(
        AUTOMATIC_SHARE * held <= any,
        "{name}: {AUTOMATIC_SHARE} of {held} is too much, any body holds to {any}"
    );
    held / thick.min(any / AUTOMATIC_SHARE)
}

const GIMP: Weighting = Weighting::UniformGimp;
const SPLINE: Weighting = Weighting::QuadraticBSpline;

/// Space has the smaller limits, and so the entries.
#[test]
fn entries_are_safe_and_not_too_careful() {
    use StressScheme::{Musl, Usf, Usl};
    use TransferKind::{Apic, Flip, Tpic};
    for (method, particles) in [
        ((GIMP, Usl, Flip), 1),
        ((GIMP, Usl, Flip), 2),
        ((GIMP, Musl, Flip), 2),
        ((GIMP, Musl, Apic), 1),
        ((GIMP, Usf, Tpic), 2),
        ((SPLINE, Usl, Flip), 1),
        ((SPLINE, Usf, Flip), 1),
        ((SPLINE, Musl, Tpic), 1),
    ] {
        let choice = choice(method, Dimension::Three, particles);
        let share = judge(&choice);
        assert!(
            share >= 1.0 - TOO_CAREFUL,
            "{}: {share} of what is safe",
            choice.name()
        );
    }
}

/// Between the sizes of the table, and below them, its numbers are safe.
#[test]
fn other_sizes_of_particles_are_safe() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        for transfer in [TransferKind::Flip, TransferKind::Apic, TransferKind::Tpic] {
            for particles in [3, 4, 6] {
                judge(&choice((GIMP, scheme, transfer), Dimension::Two, particles));
            }
        }
    }
    for particles in [2, 3, 4] {
        judge(&choice(
            (SPLINE, StressScheme::Usl, TransferKind::Flip),
            Dimension::Two,
            particles,
        ));
    }
}

/// In space, where they are smallest, for particles alone, which cost nothing.
#[test]
fn single_particles_in_space_are_safe() {
    for particles in [1, 2, 3, 4, 5, 8] {
        for (scheme, transfer) in [
            (StressScheme::Usl, TransferKind::Flip),
            (StressScheme::Usl, TransferKind::Apic),
            (StressScheme::Musl, TransferKind::Tpic),
        ] {
            let choice = choice((GIMP, scheme, transfer), Dimension::Three, particles);
            let worst = choice.worst_of(Form::Particle).expect("a limit").courant;
            let held = choice.method.stability_number(particles);
            assert!(
                AUTOMATIC_SHARE * held <= worst,
                "{}: {held}, {worst}",
                choice.name()
            );
        }
    }
}
