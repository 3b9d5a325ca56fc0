//! Radial vibration: known numbers, the equation of motion by differences and a surface without load.

use super::derivative;
use approx::assert_relative_eq;
use proctor_verification::exact::breathing::Round;

#[test]
fn frequencies_are_known() {
    for (round, poisson, known) in [
        (Round::Sphere, 0.25, 2.563_434),
        (Round::Sphere, 0.3, 2.670_215),
        (Round::Cylinder, 0.25, 2.069_398),
        (Round::Cylinder, 0.3, 2.125_749),
    ] {
        assert_relative_eq!(round.lowest(poisson), known, epsilon = 6e-7);
    }
}

#[test]
fn shapes_solve_the_equation_and_leave_the_surface_free() {
    for (round, around) in [(Round::Cylinder, 1.0), (Round::Sphere, 2.0)] {
        for x in [0.7, 2.1] {
            let [of, slope] = round.shape(x);
            assert_relative_eq!(
                derivative(|d| round.shape(x + d)[0], 1e-3),
                slope,
                epsilon = 1e-10
            );
            // u'' + n (u'/x - u/x²) + u = 0: the gradient of the divergence is -k² u.
            let second = derivative(|d| round.shape(x + d)[1], 1e-3);
            assert_relative_eq!(
                second + around * (slope / x - of / (x * x)) + of,
                0.0,
                epsilon = 1e-9
            );
        }
        let (nu, x) = (0.3, round.lowest(0.3));
        let [of, slope] = round.shape(x);
        // Radial stress over E/((1 + nu) (1 - 2 nu)).
        assert_relative_eq!(
            (1.0 - nu) * slope + nu * around * of / x,
            0.0,
            epsilon = 1e-12
        );
        let [near, far] = [0.99e-2, 1.01e-2].map(|x| round.shape(x)[0] / x);
        assert_relative_eq!(near, far, max_relative = 1e-5);
    }
}
