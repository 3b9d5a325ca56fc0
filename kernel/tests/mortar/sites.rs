//! Sites: where a boundary has normals.

use crate::mortar::support::{at_rest, chain, floor, point};
use proctor_contact::geometry::mortar::boundary::{Boundary, BoundarySide};
use proctor_contact::geometry::mortar::law::{Friction, NormalLaw};
use proctor_contact::geometry::mortar::pair::{PairLaw, PairSurfaces, Slip, contact_forces};
use proctor_contact::geometry::mortar::points::{Detection, MasterSearch};
use proctor_contact::geometry::mortar::sites::Sites;

/// A closed polygon with equal sides.
fn polygon(sides: usize) -> Boundary {
    let corners: Vec<[f64; 2]> = (0..sides)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / sides as f64).sin_cos();
            [cos, sin]
        })
        .collect();
    Boundary::new(&[chain(&corners, BoundarySide::Outer)]).expect("sound")
}

#[test]
fn corners_that_turn_by_more_than_30_degrees_have_two() {
    for sides in [12, 13, 40] {
        assert_eq!(polygon(sides).sites().vertices().len(), sides);
    }
    for sides in [3, 4, 11] {
        let sharp = polygon(sides);
        assert_eq!(sharp.sites().vertices().len(), 2 * sides);
        for (segment, sites) in sharp.sites().elements().iter().enumerate() {
            assert_eq!(
                sites.map(|site| sharp.sites().vertices()[site]),
                sharp.segments()[segment]
            );
            for site in sites {
                let normal = sharp.normals()[*site];
                assert!((normal - sharp.segment_normal(segment)).norm() < 1e-15);
            }
        }
    }
}

#[test]
fn the_first_site_of_a_vertex_has_its_number() {
    // Four triangles around vertex 0 in two smooth halves, and a vertex that nothing hangs on.
    let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
    let sites = Sites::new(6, &triangles, &[[0, 1], [2, 3]]);
    assert_eq!(sites.vertices(), [0, 1, 2, 3, 4, 5, 0, 3, 1]);
    assert_eq!(
        sites.elements(),
        [[0, 1, 2], [0, 2, 3], [6, 7, 4], [6, 4, 8]]
    );
    // A ring of which each is smooth to the next has one.
    let ring = Sites::new(5, &triangles, &[[0, 1], [1, 2], [2, 3], [3, 0]]);
    assert_eq!(ring.vertices(), [0, 1, 2, 3, 4]);
    assert_eq!(ring.elements(), triangles);
}

/// A block that slides on a line: whichever of both is the slave, the line is rubbed by mu times what presses it, and so is
/// each vertex of the block, the corners too.
#[test]
fn a_block_keeps_to_the_cone_of_the_line_below_it() {
    let (mu, gap) = (0.35, 0.01);
    let block = [
        [-1.0, gap],
        [-0.4, gap],
        [0.3, gap],
        [1.0, gap],
        [1.0, 0.5],
        [1.0, 1.0],
        [-1.0, 1.0],
    ];
    let block = Boundary::new(&[chain(&block, BoundarySide::Outer)]).expect("sound");
    let line = floor(&[-2.3, -0.7, 0.1, 0.9, 2.2], 0.0);
    for detection in [Detection::Mortar, Detection::NodeToSegment] {
        for block_is_slave in [true, false] {
            let (slave, master) = if block_is_slave {
                (&block, &line)
            } else {
                (&line, &block)
            };
            let slide = |of: &Boundary, x: f64| vec![point(x, 0.0); of.points.len()];
            let (ahead, behind) = (slide(&block, 1.0e-2), slide(&line, 0.0));
            let (slave_moved, master_moved) = if block_is_slave {
                (&ahead, &behind)
            } else {
                (&behind, &ahead)
            };
            let law = PairLaw {
                normal: NormalLaw::Barrier {
                    stiffness: 1.0e5,
                    critical_gap: 0.02,
                    floor: 0.05,
                },
                friction: Some(Friction {
                    coefficient: mu,
                    stiffness: 1.0e8,
                }),
                detection,
                search: MasterSearch {
                    reach: 0.7,
                    depth: 0.7,
                },
            };
            let surfaces = PairSurfaces {
                slave,
                master,
                slave_moved,
                master_moved,
                slave_velocity: &at_rest(slave),
                master_velocity: &at_rest(master),
                ahead: None,
            };
            let found = contact_forces(surfaces, &law, &mut Slip::default());
            let on_block = if block_is_slave {
                &found.slave
            } else {
                &found.master
            };
            let total: nalgebra::Vector2<f64> = on_block.iter().sum();
            assert!(
                total.y > 0.0 && (-total.x / (mu * total.y) - 1.0).abs() < 1e-12,
                "{total}"
            );
            for f in on_block {
                assert!(
                    f.x.abs() <= mu * f.y * (1.0 + 1e-12),
                    "{detection:?}, {block_is_slave}: {f}"
                );
            }
        }
    }
}
