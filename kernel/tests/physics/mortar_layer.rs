//! The rows of particles behind a face that mortar contact presses on carry the pressure, wherever the face lies in its cell.

use crate::common::{APIC, TPIC, body, cuboid, elastic, empty, material, simulation};
use crate::physics::mortar::{contact, line, run_until};
use proctor_contact::geometry::mortar::motion::FollowMode;
use proctor_contact::geometry::surface::Surface;
use proctor_scene::simulation::Simulation;
use proctor_scene::{
    BodyBoundary, BoxLoad, Damping, Dimension, DomainUpdate, MortarContact, PlaneCondition,
    RigidFacets, Scene, StressScheme, Vertices, Weighting,
};
use std::sync::Arc;

const PRESSURE: f64 = 2000.0;
const HEIGHT: f64 = 0.4;
/// Distance below which the barrier pushes, and that at which the block starts, near that at which it rests \[m\].
const CRITICAL: f64 = 0.005;
const START: f64 = 0.0034;
/// Height of the part that is loaded, at the top \[m\].
const LOADED: f64 = 0.05;

/// A column without Poisson's ratio between sliding planes, whose top is loaded, over a rigid plane; its face is at a share
/// `at` of its cell.
fn column(dimension: Dimension, h: f64, at: f64, follow: FollowMode) -> Scene {
    let axes = dimension.axes();
    let up = axes - 1;
    let across = if axes == 2 { 4.0 } else { 2.0 } * h;
    let bottom = (2.0 + at) * h;
    let tall = (0.7 / h).round() as usize;
    let mut cells = [(across / h).round() as usize; 3];
    cells[up] = tall;
    let mut scene = empty(dimension, cells, h);
    for axis in 0..up {
        scene.mesh.planes[axis] = [PlaneCondition::Sliding; 2];
    }
    scene.scheme = StressScheme::Musl;
    scene.transfer = APIC;
    scene.damping = Damping::Viscous { alpha: 0.05 };
    scene.materials = vec![material(elastic(1.0e6, 0.0))];
    let corner = |height: f64, side: f64| -> [f64; 3] {
        std::array::from_fn(|axis| match axis {
            _ if axis == up => height,
            _ if axis < up => side,
            _ => 0.0,
        })
    };
    let top = bottom + HEIGHT;
    scene.bodies = vec![body(1, cuboid(corner(bottom, 0.0), corner(top, across)))];
    if axes == 2 {
        scene.bodies[0].particles_per_cell = [2, 2, 1];
    }
    let mut force = [0.0; 3];
    force[up] = -PRESSURE * across.powi(up as i32);
    scene.box_loads = vec![BoxLoad {
        p1: corner(top - LOADED, 0.0),
        p2: corner(top, across),
        force,
    }];
    scene.mortar.boundaries = vec![BodyBoundary {
        body: 1,
        vertices: Vertices::Spacing(0.5 * h),
        follow,
    }];
    let (low, beyond) = (bottom - START, across + 0.1);
    if axes == 2 {
        scene.mortar.lines = vec![line(&[[beyond, low], [-0.1, low]])];
    } else {
        let at = |x: f64, y: f64| [x, y, low];
        let corners = [
            [at(-0.1, -0.1), at(beyond, -0.1), at(beyond, beyond)],
            [at(-0.1, -0.1), at(beyond, beyond), at(-0.1, beyond)],
        ];
        scene.mortar.facets = vec![RigidFacets {
            name: "plane".into(),
            id: 9,
            surface: Arc::new(Surface::new(&corners).expect("a surface")),
            motion: None,
        }];
    }
    scene.mortar.contacts = vec![MortarContact {
        critical_gap: CRITICAL,
        normal_stiffness: 5.0e6,
        ..contact(9, 1, 0.0)
    }];
    scene
}

/// Stress along the column over the pressure, of the particles of the first three rows: the farthest from -1.
fn farthest_off(scene: &Scene, h: f64) -> f64 {
    let up = scene.dimension.axes() - 1;
    let mut simulation: Simulation = simulation(scene);
    let lowest = |s: &Simulation| {
        let heights = (0..s.particles()).map(|p| s.position(0, p)[up]);
        heights.fold(f64::INFINITY, f64::min)
    };
    run_until(&mut simulation, 1.5);
    let rows = lowest(&simulation) + 1.25 * h;
    let low = |p: &usize| simulation.position(0, *p)[up] < rows;
    let seen = (0..simulation.particles()).filter(low);
    let off = seen.map(|p| (simulation.sets()[0].stress(p)[up] / PRESSURE + 1.0).abs());
    off.fold(0.0, f64::max)
}

/// Modes that go by nodes alone. Ties to particles give the rows 0.86 and 1.14 of the pressure at 0.36 of a cell.
const ALL: [FollowMode; 3] = [FollowMode::Velocity, FollowMode::Spin, FollowMode::Gradient];

#[test]
fn rows_at_the_face_carry_the_pressure() {
    for h in [0.05, 0.025] {
        for at in [0.03, 0.2, 0.36, 0.55, 0.7, 0.9] {
            let off = farthest_off(&column(Dimension::Two, h, at, FollowMode::Spin), h);
            assert!(off < 0.1, "face at {at} of a cell of {h} m: {off}");
        }
    }
}

#[test]
fn rows_carry_it_however_vertices_follow() {
    for follow in ALL {
        for at in [0.36, 0.9] {
            let off = farthest_off(&column(Dimension::Two, 0.05, at, follow), 0.05);
            assert!(off < 0.1, "{follow:?}, face at {at} of a cell: {off}");
        }
    }
}

/// Linear functions are left out: a row of particles does not end anywhere, and the stress of a cell depends on how many of them
/// are in it.
#[test]
fn rows_carry_it_with_every_weighting() {
    let weightings = [
        Weighting::ContiguousGimp(DomainUpdate::Stretch),
        Weighting::ContiguousGimp(DomainUpdate::Determinant),
        Weighting::QuadraticBSpline,
    ];
    for weighting in weightings {
        for (scheme, at) in [(StressScheme::Usl, 0.36), (StressScheme::Musl, 0.9)] {
            let mut scene = column(Dimension::Two, 0.05, at, FollowMode::Spin);
            (scene.weighting, scene.scheme) = (weighting, scheme);
            let off = farthest_off(&scene, 0.05);
            assert!(off < 0.1, "{weighting:?}, face at {at} of a cell: {off}");
        }
    }
}

#[test]
fn rows_carry_it_in_space() {
    for follow in [FollowMode::Spin, FollowMode::Gradient] {
        for at in [0.36, 0.9] {
            let off = farthest_off(&column(Dimension::Three, 0.05, at, follow), 0.05);
            assert!(off < 0.1, "{follow:?}, face at {at} of a cell: {off}");
        }
    }
}

/// A face that sinks below the nodes that it was at reaches these by next to nothing: the mass says by how much.
#[test]
fn rows_carry_it_where_a_face_sinks_below_a_node() {
    for scheme in [StressScheme::Usl, StressScheme::Musl] {
        for transfer in [APIC, TPIC] {
            for at in [0.0, 1e-5, 1e-3] {
                let mut scene = column(Dimension::Two, 0.05, at, FollowMode::Spin);
                (scene.scheme, scene.transfer) = (scheme, transfer);
                let off = farthest_off(&scene, 0.05);
                assert!(off < 0.1, "{scheme:?}, face at {at} of a cell: {off}");
            }
        }
    }
}

/// A block under one pressure on another of a hundredth of its stiffness: all rows of both carry it. On common nodes the rows
/// at the interface have 0.73, 3.17 and -0.70 of it.
#[test]
fn rows_of_a_stiff_block_on_a_soft_one_carry_it() {
    const APART: f64 = 0.0046;
    let (h, across) = (0.05, 0.2);
    for at in [0.0, 0.36, 0.7] {
        let mut scene = empty(Dimension::Two, [4, 17, 1], h);
        scene.mesh.planes[0] = [PlaneCondition::Sliding; 2];
        scene.mesh.planes[1][0] = PlaneCondition::Sliding;
        scene.scheme = StressScheme::Musl;
        scene.transfer = APIC;
        scene.damping = Damping::Local { alpha: 0.5 };
        let materials = [1.0e6, 1.0e8].map(|young| material(elastic(young, 0.0)));
        scene.materials = materials.to_vec();
        let middle = 0.3 + at * h;
        let (foot, top) = (middle + APART, 0.6 + at * h + APART);
        scene.bodies = vec![
            body(1, cuboid([0.0; 3], [across, middle, 0.0])),
            body(2, cuboid([0.0, foot, 0.0], [across, top, 0.0])),
        ];
        scene.bodies[1].material = 1;
        for body in &mut scene.bodies {
            body.particles_per_cell = [2, 2, 1];
            scene.mortar.boundaries.push(BodyBoundary {
                body: body.id,
                vertices: Vertices::Spacing(0.5 * h),
                follow: FollowMode::Spin,
            });
        }
        scene.box_loads = vec![BoxLoad {
            p1: [0.0, top - LOADED, 0.0],
            p2: [across, top, 0.0],
            force: [0.0, -PRESSURE * across, 0.0],
        }];
        scene.mortar.contacts = vec![MortarContact {
            critical_gap: CRITICAL,
            normal_stiffness: 5.0e7,
            ..contact(2, 1, 0.0)
        }];
        let mut simulation = simulation(&scene);
        run_until(&mut simulation, 1.0);
        for set in 0..2 {
            for p in 0..simulation.sets()[set].len() {
                let y = simulation.position(set, p)[1];
                if y < top - 3.0 * h {
                    let stress = simulation.sets()[set].stress(p)[1] / PRESSURE;
                    assert!((stress + 1.0).abs() < 0.05, "{at}: {stress} at {y} m");
                }
            }
        }
    }
}
