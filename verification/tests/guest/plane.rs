//! Problems in the plane in other shapes: the same traction over a metre, and over slabs of any thickness.

use super::guest;
use proctor_scene::{Dimension, Mesh, PlaneCondition, PointLoad, Scene};
use proctor_verification::guest::Guest;

/// A slab of 2 by 3 cells of 0.5 m, loaded at both faces of one edge with a force (N) each.
fn slab(force: f64) -> Guest {
    let mut mesh = Mesh::new(Dimension::Three, [0.0; 3], [0.5; 3], [2, 3, 1]);
    mesh.planes[2] = [PlaneCondition::Sliding; 2];
    let mut scene = Scene::new(Dimension::Three, mesh, 1.0);
    scene.point_loads = [0.0, 0.5]
        .map(|z| PointLoad {
            position: [1.0, 0.5, z],
            force: [force, 0.0, 0.0],
        })
        .to_vec();
    Guest::new(scene, |_, _| [0.0; 3])
}

#[test]
fn loads_over_a_metre_and_over_thick_slabs_are_the_same_traction() {
    // 2 times 3 N on half a metre are 12 N on a metre.
    let flat = slab(3.0).in_plane().expect("in the plane");
    let loads = &flat.scene.point_loads;
    assert_eq!(loads.len(), 1);
    assert!((loads[0].force[0] - 12.0).abs() < 1e-12, "{loads:?}");
    assert_eq!(
        (flat.scene.dimension, flat.scene.mesh.cells),
        (Dimension::Two, [2, 3, 1])
    );
    assert!((flat.scene.mesh.cell[2] - 1.0).abs() < 1e-15);
    let thick = slab(3.0).thick(4);
    assert_eq!(thick.scene.mesh.cells, [2, 3, 4]);
    let loads = &thick.scene.point_loads;
    let forces: Vec<f64> = loads.iter().map(|load| load.force[0]).collect();
    assert_eq!(forces, [3.0, 6.0, 6.0, 6.0, 3.0]);
    let places: Vec<f64> = loads.iter().map(|load| load.position[2]).collect();
    assert_eq!(places, [0.0, 0.5, 1.0, 1.5, 2.0]);
}

#[test]
fn what_moves_along_z_is_not_in_the_plane() {
    let mut falls = slab(3.0);
    falls.scene.gravity = [0.0, 0.0, -9.81];
    assert!(!falls.is_in_plane() && falls.in_plane().is_none());
    let mut held = slab(3.0);
    held.scene.mesh.planes[2][1] = PlaneCondition::Fixed;
    // It stays as it is.
    assert_eq!(held.thick(4).scene.mesh.cells, [2, 3, 1]);
}

#[test]
fn scenes_of_the_cases_are_sound_in_the_plane_and_as_slabs() {
    for case in [
        "step-bar",
        "bar",
        "axis-aligned",
        "inclined-block",
        "colliding-blocks",
    ] {
        let count = |guest: &Guest| guest.scene.bodies.len();
        let bodies = count(&guest(case).0);
        let flat = guest(case).0.in_plane().unwrap_or_else(|| panic!("{case}"));
        let thick = guest(case).0.thick(3);
        for (guest, axes) in [(&flat, 2), (&thick, 3)] {
            assert_eq!(guest.scene.dimension.axes(), axes, "{case}");
            assert_eq!(count(guest), bodies, "{case}");
            guest
                .scene
                .check()
                .unwrap_or_else(|error| panic!("{case}: {error}"));
        }
        let (slab, _) = guest(case);
        assert!((thick.particles_over(&slab) - 3.0).abs() < 1e-12, "{case}");
        let layers = slab.scene.bodies[0].particles_per_cell[2] as f64;
        assert!(
            (flat.particles_over(&slab) * layers - 1.0).abs() < 1e-12,
            "{case}"
        );
    }
}
