//! Predictions against numbers of a laboratory that shares nothing with the kernel: dense matrices of the linearised step,
//! their spectral radius by a library for eigenvalues, smallest and largest over offsets; and against closed forms.

use proctor_laws::LinearElastic;
use proctor_scene::{
    Dimension, PlaneCondition, Scene, Shape, StressScheme, Transfer, TransferKind, Weighting,
};
use proctor_verification::settings::Method;
use proctor_verification::stability::block::{Choice, Form, HAIR, Place, offsets};
use proctor_verification::stability::predicted::{grid_bound, predict};

fn block(scheme: StressScheme, particles_per_cell: usize) -> Choice {
    Choice {
        method: Method {
            weighting: Weighting::UniformGimp,
            scheme,
            transfer: TransferKind::Flip,
        },
        dimension: Dimension::Two,
        particles_per_cell,
    }
}

fn at(offset: f64) -> Place {
    Place {
        form: Form::LARGE,
        offset,
    }
}

/// Smallest and largest over the offsets.
fn span(of: impl Fn(f64) -> f64, particles_per_cell: usize) -> [f64; 2] {
    let all = offsets(particles_per_cell);
    let all = all.into_iter().map(of);
    all.fold([f64::INFINITY, 0.0], |[a, b], c| [a.min(c), b.max(c)])
}

fn close(found: f64, wanted: f64, what: &str) {
    assert!(
        (found / wanted - 1.0).abs() < 0.004,
        "{what}: {found}, not {wanted}"
    );
}

#[test]
fn blocks_in_the_plane() {
    for (particles, grid) in [(1, [0.811, 1.174]), (2, [0.746, 0.964])] {
        let choice = block(StressScheme::Usl, particles);
        let bound = |offset| {
            grid_bound(&choice.scene(at(offset)))
                .expect("a bound")
                .expect("one")
        };
        let found = span(bound, particles);
        close(found[0], grid[0], "grid, smallest");
        // The laboratory's offsets are others; the largest depends on them.
        assert!(found[1] > 0.97 * grid[1], "{found:?}");
    }
    let choice = block(StressScheme::Usl, 1);
    let [least, most] = span(|o| choice.predict(at(o)).expect("a limit"), 1);
    close(least, 0.582, "USL");
    close(most, 0.869, "USL");
    for scheme in [StressScheme::Usf, StressScheme::Musl] {
        for (particles, wanted) in [(1, 1.964), (2, 1.646)] {
            let choice = block(scheme, particles);
            let [least, _] = span(|o| choice.predict(at(o)).expect("a limit"), particles);
            close(least, wanted, "projected");
        }
    }
}

/// A column between rollers, one cell wide, that ends `past` a node: one dimension. Poisson's ratio is zero.
fn column(weighting: Weighting, scheme: StressScheme, particles: usize, past: f64) -> Scene {
    let mut scene = Scene::plane([1, 12], 1.0);
    scene.mesh.planes[1] = [PlaneCondition::Free; 2];
    scene.weighting = weighting;
    scene.scheme = scheme;
    scene.transfer = Transfer::new(TransferKind::Flip);
    let material = scene.add_material(LinearElastic::new(1.0, 0.0), 1.0);
    let shape = Shape::rectangle([0.0, 3.0 + past], [1.0, 9.0 + past]);
    scene.add_body(shape, material).particles_per_cell = [particles, particles, 1];
    scene
}

/// An isolated node that only a sliver of mass reaches swings with w² = c²/(eps h²): the step of the grid is
/// 2 sqrt(eps) h/c, of USL sqrt(2) sqrt(eps) h/c or more. The projection of USF and MUSL does not feel it.
#[test]
fn a_light_node_of_linear_functions() {
    for eps in [1e-2, 1e-4, HAIR] {
        let particles = 2;
        // The last particle lies eps past the node at 9.
        let past = 0.25 + eps;
        let usl = column(Weighting::Linear, StressScheme::Usl, particles, past);
        let grid = grid_bound(&usl).expect("a bound").expect("one");
        let wanted = 2.0 * eps.sqrt();
        assert!(
            (grid / wanted - 1.0).abs() < 0.02,
            "{eps}: {grid}, not {wanted}"
        );
        let limit = predict(&usl).expect("a limit").expect("one").courant;
        assert!(
            (0.98 * grid / 2.0_f64.sqrt()..=grid).contains(&limit),
            "{eps}: {limit} of {grid}"
        );
        let musl = column(Weighting::Linear, StressScheme::Musl, particles, past);
        let limit = predict(&musl).expect("a limit").expect("one").courant;
        assert!(limit > 1.3, "{eps}: {limit}");
    }
}

#[test]
fn a_column_is_one_dimension() {
    for (particles, grid, usl, projected) in [
        (1, 0.866, 0.620, 2.0),
        (2, 0.803, 0.590, 1.73),
        (4, 0.664, 0.477, 1.66),
    ] {
        let limit = |scheme, past| {
            let scene = column(Weighting::UniformGimp, scheme, particles, past);
            predict(&scene).expect("a limit").expect("one").courant
        };
        let bound = |past| {
            let scene = column(Weighting::UniformGimp, StressScheme::Usl, particles, past);
            grid_bound(&scene).expect("a bound").expect("one")
        };
        // The laboratory took offsets of a coarser kind, so that its smallest may lie above these.
        for (what, found, wanted) in [
            ("grid", span(bound, particles)[0], grid),
            (
                "USL",
                span(|o| limit(StressScheme::Usl, o), particles)[0],
                usl,
            ),
            (
                "MUSL",
                span(|o| limit(StressScheme::Musl, o), particles)[0],
                projected,
            ),
        ] {
            assert!(
                (0.9 * wanted..1.01 * wanted).contains(&found),
                "{what}, {particles}: {found}, not {wanted}"
            );
        }
    }
}

/// sqrt(2)/w <= dt <= 2/w for USL, whatever the projected motion is.
#[test]
fn usl_lies_between_its_bounds() {
    for particles in [1, 2, 4] {
        let choice = block(StressScheme::Usl, particles);
        for offset in offsets(particles) {
            let grid = grid_bound(&choice.scene(at(offset)))
                .expect("a bound")
                .expect("one");
            let share = choice.predict(at(offset)).expect("a limit") / grid;
            assert!((0.7070..=1.0).contains(&share), "{offset}: {share}");
        }
    }
}
