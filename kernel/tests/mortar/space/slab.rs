//! A slab of one layer of triangles gives the numbers of the plane.

use super::support::{GC, KAPPA, law};
use crate::mortar::support::{ceiling, floor, point};
use proctor_contact::geometry::mortar::Point as PlanePoint;
use proctor_contact::geometry::mortar::boundary::Boundary;
use proctor_contact::geometry::mortar::outline::outline;
use proctor_contact::geometry::mortar::pair::{
    PairForces, PairLaw, PairSurfaces, Slip, contact_forces,
};
use proctor_contact::geometry::mortar::points::Detection;
use proctor_contact::geometry::mortar::space::Point;
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_scene::Shape;

const THICKNESS: f64 = 0.1;

/// Extrudes a polyline from z = 0 to the thickness. Also says which vertices belong to each vertex of the line.
fn slab(line: &Boundary) -> (Facets, Vec<[usize; 2]>) {
    let mut corners = vec![];
    let at = |k: usize, z: f64| [line.points[k].x, line.points[k].y, z];
    for (s, [a, b]) in line.segments().iter().enumerate() {
        let [p, q, r, t] = [
            at(*a, 0.0),
            at(*b, 0.0),
            at(*b, THICKNESS),
            at(*a, THICKNESS),
        ];
        if s % 2 == 0 {
            corners.extend([[p, q, r], [p, r, t]]);
        } else {
            corners.extend([[p, q, t], [q, r, t]]);
        }
    }
    let facets = Facets::from_corners(&corners).expect("is sound");
    let find = |x: [f64; 3]| {
        let distance = |p: &Point| (p - Point::from(x)).norm();
        facets
            .points
            .iter()
            .position(|p| distance(p) < 1e-12)
            .expect("is there")
    };
    let both = (0..line.points.len())
        .map(|k| [find(at(k, 0.0)), find(at(k, THICKNESS))])
        .collect();
    (facets, both)
}

struct MirroredSlabs {
    plane: PairForces<2, 1>,
    space: PairForces<3, 2>,
    slave: Vec<[usize; 2]>,
    master: Vec<[usize; 2]>,
}

/// Forces after several steps in which the slave was dragged along, in the plane and as slabs.
fn both(slave: &Boundary, master: &Boundary, law: &PairLaw, by: PlanePoint) -> MirroredSlabs {
    let (slave_slab, of_slave) = slab(slave);
    let (master_slab, of_master) = slab(master);
    let (mut slip, mut slip_slab) = (Slip::default(), Slip::default());
    let moved = vec![by; slave.points.len()];
    let at_rest = vec![point(0.0, 0.0); master.points.len()];
    let moved_slab = vec![Point::new(by.x, by.y, 0.0); slave_slab.points.len()];
    let slab_at_rest = vec![Point::zeros(); master_slab.points.len()];
    let mut step = || {
        let plane = contact_forces(
            PairSurfaces {
                slave,
                master,
                slave_moved: &moved,
                master_moved: &at_rest,
                slave_velocity: &moved,
                master_velocity: &at_rest,
                ahead: None,
            },
            law,
            &mut slip,
        );
        let space = contact_forces(
            PairSurfaces {
                slave: &slave_slab,
                master: &master_slab,
                slave_moved: &moved_slab,
                master_moved: &slab_at_rest,
                slave_velocity: &moved_slab,
                master_velocity: &slab_at_rest,
                ahead: None,
            },
            law,
            &mut slip_slab,
        );
        (plane, space)
    };
    step();
    step();
    let (plane, space) = step();
    MirroredSlabs {
        plane,
        space,
        slave: of_slave,
        master: of_master,
    }
}

/// Difference of the forces of the vertices of a line, per metre of thickness, and of those of both vertices of the slab;
/// across the slab there are none.
fn difference(plane: &[PlanePoint], space: &[Point], pairs: &[[usize; 2]]) -> Vec<f64> {
    plane
        .iter()
        .zip(pairs)
        .map(|(f, [a, b])| {
            let sum = (space[*a] + space[*b]) / THICKNESS;
            (sum - Point::new(f.x, f.y, 0.0)).norm()
        })
        .collect()
}

/// Parallel lines of any division, sticking and sliding: every force is the same.
#[test]
fn parallel_lines() {
    let slave = ceiling(&[0.0, 0.13, 0.5, 0.77, 1.0], 0.05);
    let master = floor(&[-0.3, 0.2, 0.6, 1.4], 0.0);
    for (mu, by) in [(0.0, 0.0), (0.5, 1.0e-5), (0.3, 0.01)] {
        let found = both(&slave, &master, &law(Detection::Mortar, mu), point(by, 0.0));
        let scale = KAPPA * GC;
        for d in difference(&found.plane.slave, &found.space.slave, &found.slave)
            .into_iter()
            .chain(difference(
                &found.plane.master,
                &found.space.master,
                &found.master,
            ))
        {
            assert!(d < 1e-12 * scale, "{d}");
        }
        assert!(
            (found.plane.energy - found.space.energy / THICKNESS).abs()
                < 1e-12 * found.plane.energy
        );
        let stiffness = |k: &[f64]| k.iter().sum::<f64>();
        let (a, b) = (
            stiffness(&found.plane.master_stiffness),
            stiffness(&found.space.master_stiffness) / THICKNESS,
        );
        assert!((a - b).abs() < 1e-12 * a);
    }
}

/// A line that leans: gaps grow along it. The mean over the triangles around a vertex is the value at the vertex, as it
/// is over its two segments; only at the ends, where the triangles of the two corners differ, it is not.
#[test]
fn a_leaning_line() {
    let xs: Vec<f64> = (0..=12).map(|k| 0.1 * f64::from(k)).collect();
    let mut slave = ceiling(&xs, 0.0);
    for p in &mut slave.points {
        p.y = 0.01 + 0.06 * p.x;
    }
    let master = floor(&[-0.3, 0.2, 0.6, 1.5], 0.0);
    let found = both(
        &slave,
        &master,
        &law(Detection::Mortar, 0.3),
        point(3.0e-6, 0.0),
    );
    let inner = 2..xs.len() - 2;
    for k in inner.clone() {
        let flat = found.plane.sites[k].expect("faces the floor");
        for v in found.slave[k] {
            let solid = found.space.sites[v].expect("faces the floor");
            assert!(
                (solid.gap - flat.gap).abs() < 1e-14,
                "{} {}",
                solid.gap,
                flat.gap
            );
            assert!((solid.pressure - flat.pressure).abs() < 1e-12 * KAPPA * GC);
        }
    }
    let slave = difference(&found.plane.slave, &found.space.slave, &found.slave);
    assert!(
        inner.clone().all(|k| slave[k] < 1e-11 * KAPPA * GC),
        "{slave:?}"
    );
}

/// A disc as slave: the projections differ by the square of the angle between segments, and so do the forces.
#[test]
fn a_disc() {
    let error = |segment: f64| {
        let shape = Shape::Sphere {
            center: [0.0, 0.53, 0.0],
            radius: 0.5,
        };
        let slave = Boundary::new(&outline(&shape, segment).expect("positive")).expect("sound");
        assert_eq!(slave.points.len() % 2, 0);
        let master = floor(&[-1.0, 1.0], 0.0);
        let found = both(
            &slave,
            &master,
            &law(Detection::Mortar, 0.0),
            point(0.0, 0.0),
        );
        let total = |f: &[PlanePoint]| f.iter().map(|f| f.y).sum::<f64>();
        let slab: f64 = found.space.slave.iter().map(|f| f.y).sum::<f64>() / THICKNESS;
        let across: f64 = found.space.slave.iter().map(|f| f.z).sum();
        assert!(across.abs() < 1e-12 * slab);
        (slab / total(&found.plane.slave) - 1.0).abs()
    };
    let quarter = std::f64::consts::FRAC_PI_4;
    assert!(error(quarter / 5.0) < 0.005);
    let (coarse, fine) = (error(quarter / 20.0), error(quarter / 40.0));
    assert!(coarse < 1.0e-4 && coarse / fine > 2.5, "{coarse} {fine}");
}
