//! Lamé's cylinder and sphere: numbers, equilibrium and ends.

use approx::assert_relative_eq;
use proctor_verification::exact::thick_wall::ThickWall;

const WALL: ThickWall = ThickWall {
    inner: 1.0,
    outer: 2.0,
    pressure: 1.0,
    young: 1000.0,
    poisson: 0.3,
};

#[test]
fn they_have_the_known_numbers() {
    assert_relative_eq!(
        WALL.cylinder_displacement(1.0),
        1.906_667e-3,
        max_relative = 1e-6
    );
    assert_relative_eq!(
        WALL.cylinder_displacement(2.0),
        1.213_333e-3,
        max_relative = 1e-6
    );
    assert_relative_eq!(
        WALL.cylinder_stress(1.0)[2],
        5.0 / 3.0,
        max_relative = 1e-12
    );
    assert_relative_eq!(WALL.sphere_displacement(1.0), 8e-4, max_relative = 1e-12);
    assert_relative_eq!(WALL.sphere_displacement(2.0), 3e-4, max_relative = 1e-12);
    assert_relative_eq!(WALL.sphere_stress(1.0)[1], 5.0 / 7.0, max_relative = 1e-12);
}

#[test]
fn the_walls_are_at_rest() {
    let (r, h) = (1.37, 1e-4);
    let slope = |f: &dyn Fn(f64) -> f64| (f(r + h) - f(r - h)) / (2.0 * h);
    let [radial, _, hoop] = WALL.cylinder_stress(r);
    let rise = slope(&|r| WALL.cylinder_stress(r)[0]);
    assert_relative_eq!(rise + (radial - hoop) / r, 0.0, epsilon = 1e-7);
    let [radial, hoop] = WALL.sphere_stress(r);
    let rise = slope(&|r| WALL.sphere_stress(r)[0]);
    assert_relative_eq!(rise + 2.0 * (radial - hoop) / r, 0.0, epsilon = 1e-7);
    for (r, pressure) in [(1.0, -1.0), (2.0, 0.0)] {
        assert_relative_eq!(WALL.cylinder_stress(r)[0], pressure, epsilon = 1e-14);
        assert_relative_eq!(WALL.sphere_stress(r)[0], pressure, epsilon = 1e-14);
    }
}

/// The hoop strain of the law is the displacement over the radius.
#[test]
fn displacement_belongs_to_the_stress() {
    let r = 1.6;
    let [radial, axial, hoop] = WALL.cylinder_stress(r);
    let strain = (hoop - 0.3 * (radial + axial)) / 1000.0;
    assert_relative_eq!(
        strain,
        WALL.cylinder_displacement(r) / r,
        max_relative = 1e-12
    );
    let [radial, hoop] = WALL.sphere_stress(r);
    let strain = (hoop - 0.3 * (radial + hoop)) / 1000.0;
    assert_relative_eq!(
        strain,
        WALL.sphere_displacement(r) / r,
        max_relative = 1e-12
    );
}
