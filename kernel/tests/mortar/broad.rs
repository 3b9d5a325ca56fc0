//! The broad phase finds what a search through all pairs finds.

use crate::common::cases;
use crate::mortar::support::{moved, point};
use proctor_contact::geometry::mortar::boundary::Boundary;
use proctor_contact::geometry::mortar::broad::{Bounds, NearElements};
use proctor_contact::geometry::mortar::outline::outline;
use proctor_scene::Shape;
use proptest::prelude::*;

fn disc(radius: f64, segment: f64) -> Boundary {
    let shape = Shape::Sphere {
        center: [0.0; 3],
        radius,
    };
    Boundary::new(&outline(&shape, segment).expect("positive")).expect("sound")
}

#[test]
fn boxes_with_half_the_critical_gap_meet_when_the_gap_is_the_critical_one() {
    let gc = 0.1;
    let (a, b) = ([point(0.0, 0.0), point(1.0, 1.0)], [point(1.0999, 0.5)]);
    let at = |margin| Bounds::around(&a, margin).overlaps(&Bounds::around(&b, margin));
    assert!(at(0.5 * gc));
    assert!(!at(0.4 * gc));
    assert!(!Bounds::around([], 1.0).overlaps(&Bounds::around(&a, 1.0)));
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn no_pair_is_missed_and_none_invented(
        x in -2.5..2.5_f64, y in -2.5..2.5_f64, reach in 0.0..0.4_f64, fine in 0.05..0.4_f64,
    ) {
        let slave = disc(1.0, 0.2);
        let master = moved(&disc(1.2, fine), 0.3, point(x, y));
        let box_of = |b: &Boundary, s: usize, margin| Bounds::around(b.segments()[s].map(|k| &b.points[k]), margin);
        let mut all = vec![];
        for s in 0..slave.segments().len() {
            all.extend((0..master.segments().len())
                .filter(|m| box_of(&slave, s, 0.0).overlaps(&box_of(&master, *m, reach)))
                .map(|m| [s, m]));
        }
        let mut near = NearElements::default();
        // Twice: what is left of another search must not matter.
        near.find(&master, &slave, 2.0 * reach);
        near.find(&slave, &master, reach);
        prop_assert_eq!(&near.pairs, &all);
        prop_assert!(near.by_slave().all(|own| own.iter().all(|pair| pair[0] == own[0][0])));
    }
}
