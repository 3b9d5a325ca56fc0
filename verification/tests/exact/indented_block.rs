//! The indented block: the pressure of a column against its closed form, convergence, and damping.

use approx::assert_relative_eq;
use proctor_verification::exact::fe::{Barrier, Indenter, Mesh, Model, NeoHookean};
use proctor_verification::exact::indented_block::IndentedBlock;

const BARRIER: Barrier = Barrier {
    stiffness: 1e3,
    critical_gap: 0.04,
    floor: 0.05,
};

fn soft() -> NeoHookean {
    NeoHookean::from_young(600.0, 0.32, 2000.0)
}

#[test]
fn a_column_under_a_plate_comes_to_rest_at_the_pressure_of_uniaxial_strain() {
    const LOW: f64 = 0.85;
    let mut mesh = Mesh::rectangle([1.0, 1.0], [4, 4]);
    mesh.outer = (0..4).map(|i| [5 * i + 9, 5 * i + 4]).collect();
    let mut model = Model::new(mesh, soft()).unwrap();
    for n in 0..25 {
        model.held[n] = [true, n % 5 == 0];
    }
    // So large a circle is a plane.
    model.indenter = Some(Indenter {
        barrier: BARRIER,
        radius: 1e6,
        center: |time| [0.5, 1e6 + LOW + 0.2 * (1.0 - time / 20.0).max(0.0)],
    });
    model.damping = 1.0;
    model.advance_to(60.0).unwrap();

    // sigma = (mu (l² - 1) + lambda ln l)/l at the stretch l, and the gap is what is left.
    let pressure = |l: f64| -(soft().shear * (l * l - 1.0) + soft().lambda * l.ln()) / l;
    let (mut low, mut high) = (0.7_f64, LOW);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if pressure(middle) > BARRIER.at(LOW - middle).1 {
            low = middle;
        } else {
            high = middle;
        }
    }
    assert_relative_eq!(model.positions[4][1], low, max_relative = 1e-6);
    assert_relative_eq!(
        model.indenter_force()[1],
        pressure(low),
        max_relative = 1e-5
    );
}

#[test]
fn force_settles_with_the_mesh_and_nothing_acts_before_contact() {
    let block = IndentedBlock {
        size: [12.0, 4.0],
        material: soft(),
        damping: 0.14,
        indenter: Indenter {
            barrier: BARRIER,
            radius: 1.0,
            center: |time| [1.2, 5.2 - 0.02 * time],
        },
    };
    // 0.16 m at 0.02 m/s.
    let times = [7.9, 20.0, 25.0, 30.0];
    let [coarse, middle, fine] = [10, 20, 40].map(|n| block.forces(n, &times).unwrap());
    assert_eq!([coarse[0], middle[0], fine[0]], [0.0; 3]);
    for k in 1..4 {
        let (first, second) = ((coarse[k] - middle[k]).abs(), (middle[k] - fine[k]).abs());
        assert!(second < 0.02 * fine[k], "{middle:?} {fine:?}");
        assert!(second < 0.7 * first, "{coarse:?} {middle:?} {fine:?}");
    }
    assert!(fine[1] < fine[2] && fine[2] < fine[3]);
}

#[test]
fn damping_is_exponential() {
    let mesh = Mesh::rectangle([1.0, 1.0], [20, 20]);
    let mut model = Model::new(mesh, soft()).unwrap();
    model.velocities.fill([1.0, 0.0]);
    model.damping = 0.5;
    model.advance_to(2.0).unwrap();
    // It starts with half a step.
    let moved = model.positions[0][0];
    assert_relative_eq!(moved, (1.0 - (-1.0_f64).exp()) / 0.5, max_relative = 5e-3);
}
