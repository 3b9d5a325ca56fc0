//! Softening that scales with the cell.

use crate::laws::support::{DENSITY, close};
use proctor_laws::{AnyLaw, Band, MohrCoulomb, Point, Residual, Softening, VonMises};

const YOUNG: f64 = 1.0e6;
const STRENGTH: f64 = 100.0;
/// Plastic strain at which nothing softens any more.
const END: f64 = 0.002;
const WIDTH: f64 = 0.1;

/// A material that parts: its tension falls to a hundredth along a line.
fn parts(band: Band) -> MohrCoulomb {
    let residual = Residual {
        tensile: Some(0.01 * STRENGTH),
        ..Residual::default()
    };
    let softening = Softening::Linear { from: 0.0, to: END };
    MohrCoulomb::new(YOUNG, 0.0, [30.0, 100.0 * STRENGTH, 0.0])
        .with_tensile(STRENGTH)
        .softening(softening, residual)
        .in_band(band)
}

/// Energy per area that a band as wide as a cell takes \[J/m²\] until nothing softens any more.
fn energy(law: &AnyLaw, cell: f64) -> f64 {
    let law = law.in_cells(cell).unwrap_or_else(|| law.clone());
    let mut point = Point::new(&law, DENSITY, [0.0; 6]);
    // dk is 2/3 of the plastic strain; with the elastic part of the end.
    let end = 1.5
        * END
        * if law.constants().last().is_some_and(|c| c.1 > 0.0) {
            WIDTH / cell
        } else {
            1.0
        };
    let steps = 20_000;
    for _ in 0..steps {
        let e = end / f64::from(steps);
        point
            .strain(&[e, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0)
            .expect("a finite stress");
    }
    point.dissipated() * cell
}

/// Half of the strength times the plastic strain of the end, times the width of the band: the same in cells of any size.
#[test]
fn a_band_takes_the_same_energy_in_any_cell() {
    let exact = 0.5 * 1.01 * STRENGTH * 1.5 * END * WIDTH;
    let law: AnyLaw = parts(Band::of_width(WIDTH)).into();
    for cell in [0.05, 0.1, 0.2] {
        close(energy(&law, cell), exact, 5e-3, exact);
    }
    let law: AnyLaw = parts(Band::NONE).into();
    for cell in [0.05, 0.1, 0.2] {
        close(energy(&law, cell), exact * cell / WIDTH, 5e-3, exact);
    }
}

#[test]
fn hardening_does_not_scale_and_softening_does() {
    let band = Band::of_width(WIDTH);
    let hard: AnyLaw = VonMises::new(YOUNG, 0.3, STRENGTH, 1.0e5)
        .in_band(band)
        .into();
    let soft: AnyLaw = VonMises::new(YOUNG, 0.3, STRENGTH, -1.0e4)
        .in_band(band)
        .into();
    let stress = |law: &AnyLaw| {
        let mut point = Point::new(law, DENSITY, [0.0; 6]);
        for _ in 0..1000 {
            point
                .strain(&[0.0, 0.0, 0.0, 0.0, 0.0, 1e-6], 1.0)
                .expect("a finite stress");
        }
        point.stress()[5]
    };
    let fine = |law: &AnyLaw| law.in_cells(0.5 * WIDTH).expect("it has a band");
    assert_eq!(stress(&hard).to_bits(), stress(&fine(&hard)).to_bits());
    assert!(stress(&fine(&soft)) > stress(&soft));
    let same = soft.in_cells(WIDTH).expect("it has a band");
    assert_eq!(stress(&same).to_bits(), stress(&soft).to_bits());
}

/// Where a cell is so wide that stress would have to fall faster than elasticity lets it, the largest cell is named.
#[test]
fn a_cell_that_is_too_wide_is_named() {
    let law = parts(Band::of_width(WIDTH));
    let slope = 0.99 * STRENGTH / END;
    let most = WIDTH * 1.5 * YOUNG / slope;
    let problems = |cell: f64| {
        let law: AnyLaw = law.into();
        law.in_cells(cell).expect("it has a band").problems()
    };
    assert_eq!(problems(0.999 * most), []);
    let found = problems(1.001 * most);
    assert_eq!(found[0].key, "regularisation.width");
    assert!(
        found[0]
            .accepted
            .starts_with(&format!("cells of less than {most:.6}")[..24]),
        "{found:?}"
    );
    // Without a band the slope itself is refused.
    let steep = MohrCoulomb::new(YOUNG, 0.0, [0.0, STRENGTH, 0.0]).softening(
        Softening::Exponential { eta: 20_000.0 },
        Residual {
            cohesion: Some(0.0),
            ..Residual::default()
        },
    );
    let law: AnyLaw = steep.into();
    assert_eq!(law.problems()[0].key, "softening.cohesion.residual");
}

/// Tresca's cohesion that falls along a line: a point bears a slope up to sqrt(3) G.
#[test]
fn cohesion_may_fall_as_fast_as_shear_unloads() {
    let shear = 0.5 * YOUNG;
    let falls = |slope: f64| {
        let law: AnyLaw = MohrCoulomb::new(YOUNG, 0.0, [0.0, STRENGTH, 0.0])
            .softening(
                Softening::Linear {
                    from: 0.0,
                    to: STRENGTH / slope,
                },
                Residual {
                    cohesion: Some(0.0),
                    ..Residual::default()
                },
            )
            .into();
        law.problems().is_empty()
    };
    let most = 3.0_f64.sqrt() * shear;
    assert!(falls(0.999 * most) && !falls(1.001 * most));
}
