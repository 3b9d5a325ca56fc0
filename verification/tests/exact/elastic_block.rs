//! The elastic block by finite elements: its limits are those of sliding blocks and of a wide block in shear.

use approx::assert_relative_eq;
use proctor_verification::exact::elastic_block::{ElasticBlock, Release};
use proctor_verification::exact::sliding::Slope;

const GRAVITY: f64 = 7.07;
const BLOCK: ElasticBlock = ElasticBlock {
    elements: [20, 4],
    edge: 0.5,
    young: 100e6,
    poisson: 0.3,
    density: 2500.0,
};

fn at_once(friction: f64, damping: f64) -> Release {
    Release {
        gravity: [GRAVITY; 2],
        friction,
        damping,
        tilting: 0.0,
        time: 1.0,
    }
}

#[test]
fn it_slides_as_an_elastic_block_does() {
    for friction in [0.0, 0.2, 0.4] {
        let slope = Slope {
            along: GRAVITY,
            into: GRAVITY,
            friction,
        };
        let shear_speed = (BLOCK.young / (2.0 * (1.0 + BLOCK.poisson)) / BLOCK.density).sqrt();
        let exact = slope.elastic_displacement(1.0, 2.0, shear_speed);
        let slid = BLOCK.slide(&at_once(friction, 0.0));
        assert_relative_eq!(slid.way, exact, max_relative = 5e-3);
    }
}

/// A wide block that sticks shears: its centre of mass moves by rho g H²/3G.
#[test]
fn it_shears_where_it_sticks() {
    let wide = ElasticBlock {
        elements: [160, 8],
        edge: 0.25,
        poisson: 0.0,
        ..BLOCK
    };
    let tilted = Release {
        gravity: [0.1 * GRAVITY, GRAVITY],
        tilting: 0.5,
        ..at_once(0.6, 0.1)
    };
    let slid = wide.slide(&tilted);
    let exact = wide.density * 0.1 * GRAVITY * 4.0 / (3.0 * 0.5 * wide.young);
    // The free ends give way over about a height of the length of twenty.
    assert_relative_eq!(slid.way, exact, max_relative = 0.04);
    assert!(slid.creep.abs() < 1e-6, "creeps by {}", slid.creep);
}

#[test]
fn it_sticks_where_it_is_tilted_or_rough_and_walks_where_it_is_neither() {
    let creep = |release: &Release| (BLOCK.slide(release).creep / GRAVITY).abs();
    let tilted = Release {
        tilting: 1.0,
        ..at_once(1.2, 0.1)
    };
    assert!(creep(&tilted) < 1e-6);
    assert!(creep(&at_once(2.5, 0.1)) < 1e-6);
    assert!(creep(&at_once(1.2, 0.0)) > 1e-2);
}
