//! The plane that separates the particles of two bodies near a node.

use crate::common::cases;
use proctor_contact::pairs::separation::Cloud;
use proctor_scene::Vector;
use proptest::prelude::*;

fn dot(a: &Vector, b: &Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn unit(v: &Vector) -> Vector {
    let size = dot(v, v).sqrt();
    v.map(|c| c / size)
}

/// The shortest way, sought from the particles that bound the hulls along a direction.
fn way(cloud: &Cloud, towards: [f64; 3]) -> Option<[f64; 3]> {
    cloud.way(cloud.nearest_along(&towards)?, 0.0)
}

fn cloud(master: &[Vector], slave: &[Vector]) -> Cloud {
    Cloud {
        points: [master.to_vec(), slave.to_vec()],
    }
}

proptest! {
    #![proptest_config(cases(200))]

    /// No direction separates the particles by more than that of the shortest way between their hulls, and that way is the
    /// same from the other side, in the plane and in space.
    #[test]
    fn the_shortest_way_separates_best(
        master in prop::collection::vec(prop::array::uniform3(0.0..1.0_f64), 1..40),
        slave in prop::collection::vec(prop::array::uniform3(0.0..1.0_f64), 1..40),
        apart in 0.6..2.0_f64, others in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 20),
        flat in any::<bool>(),
    ) {
        let place = |all: &[Vector], apart: f64| -> Vec<Vector> {
            all.iter().map(|x| [x[0] + apart, x[1], if flat { 0.0 } else { x[2] }]).collect()
        };
        let (master, slave) = (place(&master, 0.0), place(&slave, apart));
        let found = way(&cloud(&master, &slave), [1.0, 0.0, 0.0]);
        let back = way(&cloud(&slave, &master), [-1.0, 0.0, 0.0]);
        let widest = others.iter().map(|n| cloud(&master, &slave).margin(&unit(n)));
        let widest = widest.fold(f64::NEG_INFINITY, f64::max);
        let size = found.map_or(0.0, |way| dot(&way, &way).sqrt());
        prop_assert!(widest <= size + 1e-9, "{widest} over {size}");
        if let Some(way) = found {
            let margin = cloud(&master, &slave).margin(&unit(&way));
            prop_assert!((margin - size).abs() <= 1e-9, "{margin} of {size}");
            let back = back.expect("they are apart from the other side, too");
            prop_assert!((0..3).all(|k| (way[k] + back[k]).abs() <= 1e-9), "{way:?} {back:?}");
        }
    }

    /// A flat wall that ends anywhere beside a flat body, from one row of particles on, has the normal of its face.
    #[test]
    fn the_end_of_a_wall_turns_no_normal(
        ends in prop::array::uniform2(-1.2..1.2_f64), turn in 0.0..6.3_f64, space in any::<bool>(),
    ) {
        let (sin, cos) = turn.sin_cos();
        let turned = |x: &Vector| [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1], x[2]];
        let (mut master, mut slave) = (vec![], vec![]);
        for i in 0..3 {
            for j in 0..6 {
                for k in 0..if space { 6 } else { 1 } {
                    let place = |n: i32| 0.5 * f64::from(n) - 1.25;
                    let x = [0.25 + 0.5 * f64::from(i), place(j), if space { place(k) } else { 0.0 }];
                    slave.push(turned(&x));
                    if x[1] > ends[0] && (!space || x[2] > ends[1]) {
                        master.push(turned(&[-x[0], x[1], x[2]]));
                    }
                }
            }
        }
        // The mass gradient at the corner.
        let gradient = turned(&[0.6, -0.6, if space { -0.5 } else { 0.0 }]);
        let way = way(&cloud(&master, &slave), gradient).expect("they are apart");
        let face = turned(&[0.5, 0.0, 0.0]);
        prop_assert!((0..3).all(|k| (way[k] - face[k]).abs() <= 1e-12), "{way:?} {face:?}");
    }
}

#[test]
fn particles_among_each_other_are_not_separated() {
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
    ];
    let inside = [[0.5, 0.4, 0.0], [3.0, 0.5, 0.0]];
    assert_eq!(way(&cloud(&square, &inside), [1.0, 0.0, 0.0]), None);
    assert_eq!(cloud(&square, &[]).way([1.0, 0.0, 0.0], 0.0), None);
}
