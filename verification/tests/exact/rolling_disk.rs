//! The rolling disk against its equations of motion, integrated with Coulomb friction at the point of contact.

use proctor_verification::exact::rolling_disk::RollingDisk;

fn disk(friction: f64) -> RollingDisk {
    RollingDisk {
        gravity: 9.81,
        inclination: 30.0_f64.to_radians(),
        friction,
        radius: 0.5,
    }
}

/// Semi-implicit steps with the friction force that brings the slip of the contact point to zero, or the most that
/// there is; per mass, with the moment of inertia R²/2.
fn integrate(disk: &RollingDisk, time: f64, steps: u32) -> (f64, f64) {
    let dt = time / f64::from(steps);
    let (sin, cos) = disk.inclination.sin_cos();
    let (mut x, mut turn, mut v, mut omega) = (0.0, 0.0, 0.0, 0.0);
    for _ in 0..steps {
        let slip = v + disk.gravity * sin * dt - omega * disk.radius;
        // A force f changes the slip by -(1 + 2) f dt.
        let most = disk.friction * disk.gravity * cos;
        let force = (slip / (3.0 * dt)).clamp(-most, most);
        v += (disk.gravity * sin - force) * dt;
        omega += 2.0 * force / disk.radius * dt;
        x += v * dt;
        turn += omega * dt;
    }
    (x, turn)
}

#[test]
fn it_is_the_solution_of_the_equations_of_motion() {
    for friction in [0.0, 0.1, 0.19, 0.2, 0.3] {
        let disk = disk(friction);
        let (x, turn) = integrate(&disk, 2.0, 20_000);
        let exact = disk.way_and_turn(2.0);
        assert!(
            (x - exact.0).abs() < 1e-4 * exact.0,
            "{friction} {x} {exact:?}"
        );
        assert!(
            (turn - exact.1).abs() < 1e-4 * exact.1.max(1e-300) + 1e-12,
            "{friction}"
        );
    }
}

#[test]
fn slip_and_stick_meet_where_friction_just_suffices() {
    let limit = 30.0_f64.to_radians().tan() / 3.0;
    assert!(disk(limit * (1.0 + 1e-12)).sticks() && !disk(limit * (1.0 - 1e-12)).sticks());
    let (below, above) = (disk(limit * (1.0 - 1e-9)), disk(limit * (1.0 + 1e-9)));
    assert!((below.accelerations().0 - above.accelerations().0).abs() < 1e-7);
    assert!((below.rolling_ratio() - 1.0).abs() < 1e-7);
    assert_eq!(above.rolling_ratio(), 1.0);
    // The paper's two cases: slip at 0.1, stick at 0.3.
    assert!(!disk(0.1).sticks() && disk(0.3).sticks());
}

/// Energy: what gravity gives is motion and what friction takes along the slip.
#[test]
fn energy_is_balanced() {
    for friction in [0.1, 0.3] {
        let disk = disk(friction);
        let time = 1.7;
        let (x, turn) = disk.way_and_turn(time);
        let (a, alpha) = disk.accelerations();
        let motion = 0.5 * (a * time).powi(2) + 0.25 * (disk.radius * alpha * time).powi(2);
        let (sin, cos) = disk.inclination.sin_cos();
        let lost = if disk.sticks() {
            0.0
        } else {
            friction * disk.gravity * cos * (x - turn * disk.radius)
        };
        assert!((disk.gravity * sin * x - motion - lost).abs() < 1e-12 * motion);
    }
}
