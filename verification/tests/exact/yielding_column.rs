//! The column that yields under its weight, against integration slice by slice.

use approx::assert_relative_eq;
use proctor_verification::exact::two_slopes::TwoSlopes;
use proctor_verification::exact::yielding_column::YieldingColumn;

const COLUMN: fn(TwoSlopes) -> YieldingColumn = |solid| YieldingColumn {
    solid,
    height: 2.0,
    density: 2000.0,
    gravity: 10.0,
};

fn soil() -> TwoSlopes {
    TwoSlopes::mohr_coulomb(1e6, 0.2, [20.0, 2e3, 5.0])
}

#[test]
fn slices_add_up() {
    let column = COLUMN(soil());
    assert!((0.1..1.9).contains(&column.yield_depth()));
    let n = 100_000;
    let dy = column.height / f64::from(n);
    let (mut u, mut work) = (0.0, 0.0);
    for i in 0..n {
        let y = (f64::from(i) + 0.5) * dy;
        if i % 10_000 == 0 {
            let exact = column.displacement(f64::from(i) * dy);
            assert!((u - exact).abs() < 1e-10, "{y}: {u} {exact}");
        }
        let q = column.compression(y);
        u += (libm::exp(-column.solid.strain(q)) - 1.0) * dy;
        work += column.solid.plastic_work(q) * dy;
    }
    assert_relative_eq!(u, column.displacement(column.height), max_relative = 1e-8);
    assert_relative_eq!(work, column.plastic_work(), max_relative = 1e-8);
}

/// Where nothing yields it is the elastic column of the rate law, (1 - exp(-S))/S high.
#[test]
fn a_strong_column_is_elastic() {
    let column = COLUMN(TwoSlopes::von_mises(1e6, 0.3, 1e6, 0.0));
    let s = column.compression(0.0) / column.solid.confined_modulus();
    let height = column.height * (1.0 - libm::exp(-s)) / s;
    let found = column.height + column.displacement(column.height);
    assert_relative_eq!(found, height, max_relative = 1e-12);
    assert_eq!(column.plastic_work(), 0.0);
}

/// Below the yield depth the rollers carry the active pressure, K_a q - 2 c sqrt(K_a).
#[test]
fn rollers_carry_the_active_pressure() {
    let column = COLUMN(soil());
    let sine = 20.0_f64.to_radians().sin();
    let active = (1.0 - sine) / (1.0 + sine);
    let q = column.compression(0.0);
    assert_relative_eq!(
        column.lateral_compression(0.0),
        active * q - 2.0 * 2e3 * active.sqrt(),
        max_relative = 1e-12
    );
    let above = column.height - 0.5 * column.yield_depth();
    let elastic = column.lateral_compression(above) / column.compression(above);
    assert_relative_eq!(elastic, 0.25, max_relative = 1e-12);
}
