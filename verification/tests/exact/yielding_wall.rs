//! The wall that yields: known limits, equilibrium, volume and the elastic wall at its beginning.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::thick_wall::ThickWall;
use proctor_verification::exact::yielding_wall::YieldingWall;

const WALL: YieldingWall = YieldingWall {
    inner: 1.0,
    outer: 2.0,
    strength: 3.0,
    young: 1000.0,
    poisson: 0.3,
};

#[test]
fn pressures_are_those_of_hill() {
    assert_relative_eq!(
        WALL.cylinder_pressure(1.0),
        0.375 * 3.0,
        max_relative = 1e-12
    );
    assert_relative_eq!(
        WALL.cylinder_limit(),
        std::f64::consts::LN_2 * 3.0,
        max_relative = 1e-8
    );
    assert_relative_eq!(
        WALL.sphere_pressure(1.0),
        2.0 / 3.0 * (1.0 - 0.125) * 3.0,
        max_relative = 1e-12
    );
    assert_relative_eq!(
        WALL.sphere_limit(),
        2.0 * std::f64::consts::LN_2 * 3.0,
        max_relative = 1e-8
    );
}

#[test]
fn the_wall_begins_elastic() {
    let elastic = |pressure| ThickWall {
        inner: 1.0,
        outer: 2.0,
        pressure,
        young: 1000.0,
        poisson: 0.3,
    };
    for r in [1.0, 1.3, 2.0] {
        let lame = elastic(WALL.cylinder_pressure(1.0));
        assert_relative_eq!(
            WALL.cylinder_displacement(1.0, r),
            lame.cylinder_displacement(r),
            max_relative = 1e-12
        );
        let lame = elastic(WALL.sphere_pressure(1.0));
        assert_relative_eq!(
            WALL.sphere_displacement(1.0, r),
            lame.sphere_displacement(r),
            max_relative = 1e-12
        );
    }
}

/// On both sides of the front: forces balance, the volume changes by the pressure alone, and the elastic part is that of Lamé.
#[test]
fn the_wall_is_at_rest_and_flows_without_volume() {
    let front = 1.5;
    for r in [1.2, 1.7] {
        let [radial, axial, hoop] = WALL.cylinder_stress(front, r);
        let rise = derivative(|d| WALL.cylinder_stress(front, r + d)[0], 1e-3);
        assert_relative_eq!(rise + (radial - hoop) / r, 0.0, epsilon = 1e-8);
        let widening = derivative(|d| WALL.cylinder_displacement(front, r + d), 1e-3)
            + WALL.cylinder_displacement(front, r) / r;
        assert_relative_eq!(
            widening,
            0.4 / 1000.0 * (radial + axial + hoop),
            epsilon = 1e-10
        );
        // No strain along the axis.
        assert_relative_eq!(axial, 0.3 * (radial + hoop), epsilon = 1e-12);
        let [radial, hoop] = WALL.sphere_stress(front, r);
        let rise = derivative(|d| WALL.sphere_stress(front, r + d)[0], 1e-3);
        assert_relative_eq!(rise + 2.0 * (radial - hoop) / r, 0.0, epsilon = 1e-8);
        let widening = derivative(|d| WALL.sphere_displacement(front, r + d), 1e-3)
            + 2.0 * WALL.sphere_displacement(front, r) / r;
        assert_relative_eq!(
            widening,
            0.4 / 1000.0 * (radial + 2.0 * hoop),
            epsilon = 1e-10
        );
    }
}

#[test]
fn nothing_jumps_at_the_front_and_the_faces_carry_their_loads() {
    let front = 1.5;
    let sides = [front * (1.0 - 1e-13), front * (1.0 + 1e-13)];
    let [inner, outer] = sides.map(|r| WALL.cylinder_stress(front, r));
    for (a, b) in inner.into_iter().zip(outer) {
        assert_relative_eq!(a, b, epsilon = 1e-10);
    }
    let [inner, outer] = sides.map(|r| WALL.sphere_stress(front, r));
    for (a, b) in inner.into_iter().zip(outer) {
        assert_relative_eq!(a, b, epsilon = 1e-10);
    }
    let [inner, outer] = sides.map(|r| WALL.cylinder_displacement(front, r));
    assert_relative_eq!(inner, outer, max_relative = 1e-10);
    let [inner, outer] = sides.map(|r| WALL.sphere_displacement(front, r));
    assert_relative_eq!(inner, outer, max_relative = 1e-10);
    assert_relative_eq!(
        WALL.cylinder_stress(front, 1.0)[0],
        -WALL.cylinder_pressure(front),
        max_relative = 1e-12
    );
    assert_relative_eq!(
        WALL.sphere_stress(front, 1.0)[0],
        -WALL.sphere_pressure(front),
        max_relative = 1e-12
    );
    assert_relative_eq!(WALL.cylinder_stress(front, 2.0)[0], 0.0, epsilon = 1e-12);
    assert_relative_eq!(WALL.sphere_stress(front, 2.0)[0], 0.0, epsilon = 1e-12);
}
