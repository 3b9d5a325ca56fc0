//! The cube root of lanes. The other functions are tested beside the laws that use them.

use crate::common::all_lanes;
use proctor_kernel::lanes::{Backend, Kernel, Lanes, functions};

struct Root(f64);

impl Kernel for Root {
    type Output = f64;

    #[inline(always)]
    fn run<B: Backend>(self) -> f64 {
        let mut all = [0.0; 8];
        functions::cbrt(B::Native::splat(self.0)).store(&mut all);
        all[0]
    }
}

/// The root of the library is rounded as the exact one is. This one has its bits, over all magnitudes, near 1, where the
/// determinants of deformations lie, at cubes and beside them; on all lanes.
#[test]
fn a_cube_root_has_the_bits_of_the_exact_one() {
    let mut state = 7_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let mut arguments = vec![
        0.0,
        -0.0,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        5e-324,
    ];
    arguments.extend([f64::MIN_POSITIVE, -f64::MIN_POSITIVE, 1.0, -1.0, 8.0, 0.125]);
    for _ in 0..40_000 {
        let any = f64::from_bits(next());
        let unit = (next() >> 11) as f64 / (1_u64 << 53) as f64;
        let cube = (1.0 + unit).powi(3);
        arguments.extend([any, 0.5 + unit, 1.0 + 1e-6 * (unit - 0.5), 8.0 * unit]);
        arguments.extend([cube, f64::from_bits(cube.to_bits() + 1)]);
        arguments.push(f64::from((next() % 2_000) as u32).powi(3));
    }
    for x in arguments.into_iter().filter(|x| !x.is_nan()) {
        for lanes in all_lanes() {
            let (found, exact) = (lanes.run(Root(x)), libm::cbrt(x));
            assert_eq!(
                found.to_bits(),
                exact.to_bits(),
                "cbrt({x}) = {found} not {exact} with {} lanes",
                lanes.name()
            );
        }
    }
    assert!(
        all_lanes()
            .iter()
            .all(|lanes| lanes.run(Root(f64::NAN)).is_nan())
    );
}
