//! Quantities of a run over several meshes.

use proctor_benchmark::measure::Spent;
use proctor_benchmark::refine::quantity::{Quantity, QuantityTime, nearest, unit};
use proctor_benchmark::refine::run::MeshRun;
use std::collections::BTreeMap;

#[test]
fn a_quantity_is_a_name_a_column_and_a_time() {
    let found = Quantity::parse("tip=tip_uy@end").expect("a quantity");
    assert_eq!(
        (found.name.as_str(), found.when),
        ("tip", QuantityTime::End)
    );
    let found = Quantity::parse("push=body1_contact_fx@0.25").expect("a quantity");
    assert_eq!((found.unit(), found.when), ("N", QuantityTime::At(0.25)));
    for wrong in [
        "tip",
        "tip=tip_uy",
        "=tip_uy@end",
        "a=b@soon",
        "a=b@-1",
        "a=@max",
    ] {
        assert!(Quantity::parse(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn columns_tell_their_unit() {
    for (column, found) in [
        ("tip_uy", "m"),
        ("body12_x", "m"),
        ("body12_vx", "m/s"),
        ("body1_front_x", "m"),
        ("strain_energy", "J"),
        ("energy_friction", "J"),
        ("body1_contact_fy", "N"),
        ("body1_impulse_y", "N s"),
        ("tip_sxy", "Pa"),
        ("boundary_drift", ""),
        ("most_displacement", "m"),
        ("most_mises_stress", "Pa"),
        ("most_particle", ""),
    ] {
        assert_eq!(unit(column), found, "{column}");
    }
}

#[test]
fn means_are_over_time() {
    let run = MeshRun {
        cell: 1.0,
        cells: vec![1, 1],
        particles: 4,
        steps: 2,
        spent: Spent::default(),
        times: vec![0.0, 1.0, 3.0],
        columns: BTreeMap::from([("a".to_owned(), vec![0.0, 2.0, 2.0])]),
        bounds: [[0.0; 3]; 2],
        snapshot: None,
        fault: None,
        interrupted: false,
    };
    let mean = Quantity::parse("mean=a@mean").expect("a quantity");
    assert_eq!(mean.value(&run, 3), 5.0 / 3.0);
    assert_eq!(nearest(&[0.0, 1.0, 2.0], 1.4), 1);
    assert_eq!(nearest(&[0.0, 1.0, 2.0], 9.0), 2);
}
