//! Laboratory tests in closed form, against yield conditions, flow rules and Hooke's law.

use approx::assert_relative_eq;
use proctor_verification::exact::homogeneous::{Specimen, State, Surface, Test};

const YOUNG: f64 = 100.0;
const POISSON: f64 = 0.3;
const YIELD: f64 = 0.1;
const SOIL: [f64; 3] = [25.0, 0.05, 10.0];
const CONE: [f64; 3] = [0.4, 0.05, 0.15];
const VON_MISES: Surface = Surface::Cone([0.0, YIELD / 1.732_050_807_568_877_2, 0.0]);

fn specimen(test: Test, surface: Surface, pressure: f64) -> Specimen {
    Specimen {
        young: YOUNG,
        poisson: POISSON,
        surface,
        test,
        pressure,
    }
}

/// Strains from nothing to the last in equal steps.
fn strains(last: f64, count: u32) -> Vec<f64> {
    let share = |k| last * f64::from(k) / f64::from(count);
    (0..=count).map(share).collect()
}

/// The last state of a path, and the change of stress and volume per strain over its last step.
fn ends(specimen: &Specimen, strain: f64) -> (State, State) {
    let path = specimen.path(&strains(strain, 400));
    let [.., before, last] = path[..] else {
        panic!("a path has states");
    };
    let step = strain / 400.0;
    let rate = State {
        stress: std::array::from_fn(|i| (last.stress[i] - before.stress[i]) / step),
        volume: (last.volume - before.volume) / step,
    };
    (last, rate)
}

/// Distance of a state beyond a cone.
fn beyond_cone([eta, limit, _]: [f64; 3], s: [f64; 3]) -> f64 {
    let mean = (s[0] + s[1] + s[2]) / 3.0;
    let second: f64 = s.iter().map(|s| 0.5 * (s - mean) * (s - mean)).sum();
    second.sqrt() + eta * mean - limit
}

/// Distance of principal stresses beyond a pyramid.
fn beyond_pyramid([friction, cohesion, _]: [f64; 3], mut s: [f64; 3]) -> f64 {
    s.sort_by(f64::total_cmp);
    let (sine, cosine) = friction.to_radians().sin_cos();
    (1.0 + sine) * s[2] - (1.0 - sine) * s[0] - 2.0 * cohesion * cosine
}

#[test]
fn states_are_elastic_and_then_on_the_surface() {
    for test in [Test::Oedometer, Test::Biaxial, Test::Triaxial] {
        for pressure in [0.0, 0.07] {
            if test == Test::Oedometer && pressure > 0.0 {
                continue;
            }
            let beyond_of = |surface: Surface| {
                move |s: [f64; 3]| match surface {
                    Surface::MohrCoulomb(soil) => beyond_pyramid(soil, s),
                    Surface::Cone(cone) => beyond_cone(cone, s),
                }
            };
            for surface in [
                VON_MISES,
                Surface::MohrCoulomb([0.0, 0.05, 0.0]),
                Surface::MohrCoulomb(SOIL),
                Surface::Cone(CONE),
            ] {
                let mut specimen = specimen(test, surface, pressure);
                specimen.poisson = 0.2;
                let beyond = beyond_of(surface);
                let path = specimen.path(&strains(0.02, 1000));
                let mut yielded = false;
                for state in &path {
                    let beyond = beyond(state.stress);
                    assert!(beyond < 1e-9 * YIELD, "{test:?} {surface:?} {state:?}");
                    assert!(!yielded || beyond > -1e-9 * YIELD, "{test:?} {surface:?}");
                    yielded = beyond > -1e-9 * YIELD;
                    if test != Test::Oedometer {
                        assert_relative_eq!(state.stress[0], -pressure, epsilon = 1e-12);
                    }
                }
                assert!(yielded, "{test:?} {surface:?}");
                // Hooke's law on the first step.
                let e = 0.02 / 1000.0;
                let [x, y, z] = path[1].stress.map(|s| s + pressure);
                assert_relative_eq!(-YOUNG * e, y - 0.2 * (x + z), max_relative = 1e-10);
                let volume = 0.6 * (x + y + z) / YOUNG;
                assert_relative_eq!(path[1].volume, volume, max_relative = 1e-10);
            }
        }
    }
}

/// Von Mises without pressure in biaxial compression: stresses 2Y/sqrt(3) sin u and 2Y/sqrt(3) cos(u - pi/6), which are on the
/// ellipse `s_1² - s_1 s_2 + s_2² = Y²`, and `E e sqrt(3)/2Y = (1 - 2 nu) sin(u + pi/3) + 3/4 ln |tan(u/2 + pi/4)|` but for a constant.
#[test]
fn von_mises_in_biaxial_compression_has_a_closed_form() {
    use std::f64::consts::PI;
    let scale = 2.0 * YIELD / 3.0_f64.sqrt();
    let specimen = specimen(Test::Biaxial, VON_MISES, 0.0);
    let strained = |u: f64| {
        let tan = (0.5 * u + 0.25 * PI).tan();
        scale / YOUNG * ((1.0 - 2.0 * POISSON) * (u + PI / 3.0).sin() + 0.75 * tan.abs().ln())
    };
    let angle = |s: &State| (-s.stress[2] / scale).acos() + PI / 6.0;
    let end = 5e-3;
    let path = specimen.path(&strains(end, 500));
    let on_surface = |s: &&(usize, &State)| -s.1.stress[2] > 1.001 * POISSON * -s.1.stress[1];
    let states: Vec<_> = path.iter().enumerate().collect();
    let first = states.iter().find(on_surface).expect("it yields");
    let last = states[500];
    for (k, state) in states.iter().filter(on_surface) {
        let u = angle(state);
        assert_relative_eq!(-state.stress[1], scale * u.sin(), max_relative = 1e-7);
        let strain = end * (k - first.0) as f64 / 500.0;
        let exact = strained(u) - strained(angle(first.1));
        assert!((strain - exact).abs() < 1e-6 * end, "{strain} {exact}");
        let volume = (1.0 - 2.0 * POISSON) * (state.stress[1] + state.stress[2]) / YOUNG;
        assert_relative_eq!(state.volume, volume, max_relative = 1e-9);
    }
    assert_relative_eq!(-last.1.stress[1], scale, max_relative = 1e-3);
}

/// At flow in plane strain a cone that is matched there has the strength and the dilation of the pyramid.
#[test]
fn a_cone_matched_in_plane_strain_ends_as_the_pyramid() {
    let (sine, cosine) = SOIL[0].to_radians().sin_cos();
    let flow = SOIL[2].to_radians().sin();
    let eta_psi = 3.0 * flow / (9.0 + 3.0 * flow * flow).sqrt();
    let a = (1.0 - eta_psi * eta_psi / 3.0).sqrt() + eta_psi * sine / 3.0;
    let cone = [sine / a, cosine / a * SOIL[1], eta_psi];
    for pressure in [0.0, 0.07] {
        let [of_cone, of_pyramid] = [Surface::Cone(cone), Surface::MohrCoulomb(SOIL)]
            .map(|surface| ends(&specimen(Test::Biaxial, surface, pressure), 0.05));
        let stress = |(state, _): (State, State)| state.stress[1];
        assert_relative_eq!(stress(of_cone), stress(of_pyramid), max_relative = 1e-8);
        let volume = 2.0 * flow / (1.0 - flow);
        assert_relative_eq!(of_cone.1.volume, volume, max_relative = 1e-6);
        assert_relative_eq!(of_pyramid.1.volume, volume, max_relative = 1e-9);
    }
}

/// In triaxial compression the outer cone is the edge of the pyramid.
#[test]
fn the_outer_cone_is_the_pyramid_in_triaxial_compression() {
    let slope = |degrees: f64| {
        let sine = degrees.to_radians().sin();
        6.0 * sine / (3.0_f64.sqrt() * (3.0 - sine))
    };
    let (sine, cosine) = SOIL[0].to_radians().sin_cos();
    let strength = 6.0 * SOIL[1] * cosine / (3.0_f64.sqrt() * (3.0 - sine));
    let cone = [slope(SOIL[0]), strength, slope(SOIL[2])];
    for pressure in [0.0, 0.07] {
        let [of_cone, of_pyramid] = [Surface::Cone(cone), Surface::MohrCoulomb(SOIL)]
            .map(|surface| specimen(Test::Triaxial, surface, pressure).path(&strains(0.02, 20)));
        for (a, b) in of_cone.iter().zip(&of_pyramid) {
            assert_relative_eq!(a.volume, b.volume, max_relative = 1e-9, epsilon = 1e-15);
            for (a, b) in a.stress.iter().zip(b.stress) {
                assert_relative_eq!(*a, b, max_relative = 1e-12);
            }
        }
    }
}
