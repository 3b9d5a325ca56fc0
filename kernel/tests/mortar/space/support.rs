//! Triangulated boundaries that the tests share.

use nalgebra::Rotation3;
use proctor_contact::geometry::mortar::elements::Elements;
use proctor_contact::geometry::mortar::law::{Friction, NormalLaw};
use proctor_contact::geometry::mortar::pair::{
    PairForces, PairLaw, PairSurfaces, Slip, contact_forces,
};
use proctor_contact::geometry::mortar::points::{Detection, MasterSearch};
use proctor_contact::geometry::mortar::space::Point;
use proctor_contact::geometry::mortar::space::facets::Facets;
use proctor_contact::geometry::mortar::space::skin::skin;
use proctor_scene::Shape;

pub const KAPPA: f64 = 1.0e4;
pub const GC: f64 = 0.1;

pub fn point(x: f64, y: f64, z: f64) -> Point {
    Point::new(x, y, z)
}

pub fn of_shape(shape: &Shape, segment: f64) -> Facets {
    Facets::from_corners(&skin(shape, segment).expect("has a surface")).expect("is sound")
}

pub fn ball(center: [f64; 3], radius: f64, segment: f64) -> Facets {
    of_shape(&Shape::Sphere { center, radius }, segment)
}

/// A rectangle at a height with vertices at all x and y, its outside up. `turned` says which cells have the other
/// diagonal.
pub fn floor(xs: &[f64], ys: &[f64], z: f64, turned: impl Fn(usize, usize) -> bool) -> Facets {
    let at = |i: usize, j: usize| [xs[i], ys[j], z];
    let mut corners = vec![];
    for i in 0..xs.len() - 1 {
        for j in 0..ys.len() - 1 {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if turned(i, j) {
                corners.extend([[a, b, d], [b, c, d]]);
            } else {
                corners.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    Facets::from_corners(&corners).expect("is sound")
}

/// The same with its outside down.
pub fn ceiling(xs: &[f64], ys: &[f64], z: f64, turned: impl Fn(usize, usize) -> bool) -> Facets {
    let mirror: Vec<f64> = xs.iter().rev().map(|x| -x).collect();
    let turn = Rotation3::from_axis_angle(&nalgebra::Vector3::y_axis(), std::f64::consts::PI);
    moved(&floor(&mirror, ys, -z, turned), &turn, &Point::zeros())
}

pub fn moved(facets: &Facets, turn: &Rotation3<f64>, shift: &Point) -> Facets {
    let mut out = facets.clone();
    for p in &mut out.points {
        *p = turn * *p + shift;
    }
    out
}

pub fn law(detection: Detection, mu: f64) -> PairLaw {
    PairLaw {
        normal: NormalLaw::barrier(KAPPA, GC),
        friction: (mu > 0.0).then_some(Friction {
            coefficient: mu,
            stiffness: 1.0e6,
        }),
        detection,
        search: MasterSearch {
            reach: 0.3,
            depth: 0.2,
        },
    }
}

/// Forces after every vertex of the slave moved by `by`, those of the master not.
pub fn dragged(
    slave: &Facets,
    master: &Facets,
    law: &PairLaw,
    by: &Point,
    slip: &mut Slip<2>,
) -> PairForces<3, 2> {
    let moved = vec![*by; slave.points().len()];
    let at_rest = vec![Point::zeros(); master.points().len()];
    contact_forces(
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
        slip,
    )
}

pub fn at_rest(slave: &Facets, master: &Facets, law: &PairLaw) -> PairForces<3, 2> {
    dragged(slave, master, law, &Point::zeros(), &mut Slip::default())
}
