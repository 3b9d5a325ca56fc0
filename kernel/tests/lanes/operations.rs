//! All backends agree bit by bit, on ordinary numbers, signed zeros, infinities, NaN and denormals.

use proctor_kernel::lanes::{Backend, Kernel, LaneChoice, Lanes, Quad, SelectedLanes};

/// Every operation on eight pairs of numbers, through the natural vector of the backend.
struct EveryOperation<'a> {
    a: &'a [f64; 8],
    b: &'a [f64; 8],
    c: &'a [f64; 8],
}

impl Kernel for EveryOperation<'_> {
    type Output = Vec<u64>;

    #[inline(always)]
    fn run<B: Backend>(self) -> Vec<u64> {
        let mut out = every_operation::<B::Native>(self.a, self.b, self.c);
        out.extend(every_operation::<B::Line>(self.a, self.b, self.c));
        out
    }
}

#[inline(always)]
fn every_operation<L: Lanes>(a: &[f64; 8], b: &[f64; 8], c: &[f64; 8]) -> Vec<u64> {
    const OPERATIONS: usize = 18;
    let mut results = vec![[0.0_f64; 8]; OPERATIONS];
    let mut mask_bits = [0_u64; 2];
    let mut i = 0;
    while i < 8 {
        let (x, y, z) = (L::load(&a[i..]), L::load(&b[i..]), L::load(&c[i..]));
        let values = [
            x + y,
            x - y,
            x * y,
            x / y,
            -x,
            x.mul_add(y, z),
            x.min(y),
            x.max(y),
            x.floor(),
            x.abs().sqrt(),
            L::select(x.lt(y), x, z),
            L::select(x.eq(y), y, z),
            x.abs(),
            L::splat(a[0]),
            x.map(f64::cbrt),
            x.mantissa_and_exponent().0,
            x.mantissa_and_exponent().1,
            x.floor().power_of_two(),
        ];
        for (result, value) in results.iter_mut().zip(values) {
            value.store(&mut result[i..]);
        }
        mask_bits[0] |= u64::from(L::bits(x.lt(y))) << i;
        mask_bits[1] |= u64::from(L::bits(x.eq(y))) << i;
        i += L::WIDTH;
    }
    // A NaN has many bit patterns and its payload is not part of the promise.
    let canonical = |x: f64| {
        if x.is_nan() {
            f64::NAN.to_bits()
        } else {
            x.to_bits()
        }
    };
    let mut out: Vec<u64> = results.iter().flatten().map(|&x| canonical(x)).collect();
    out.extend(mask_bits);
    out
}

fn available() -> Vec<SelectedLanes> {
    [LaneChoice::Avx512, LaneChoice::Avx2, LaneChoice::Scalar]
        .into_iter()
        .filter_map(|choice| SelectedLanes::new(choice).ok())
        .collect()
}

/// A fixed sequence of numbers over many magnitudes (xorshift).
fn numbers(seed: u64, n: usize) -> Vec<f64> {
    let mut state = seed;
    (0..n)
        .map(|_| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let unit = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            unit * 2.0_f64.powi((state % 61) as i32 - 30)
        })
        .collect()
}

fn check(a: &[f64; 8], b: &[f64; 8], c: &[f64; 8]) {
    let expected = SelectedLanes::plain().run(EveryOperation { a, b, c });
    for backend in available() {
        let found = backend.run(EveryOperation { a, b, c });
        assert_eq!(
            found,
            expected,
            "{} differs on {a:?} {b:?} {c:?}",
            backend.name()
        );
    }
}

#[test]
fn all_backends_agree_bitwise_on_ordinary_numbers() {
    let values = numbers(0x9e37_79b9_7f4a_7c15, 24 * 500);
    for chunk in values.chunks_exact(24) {
        let part = |i: usize| -> [f64; 8] { std::array::from_fn(|k| chunk[8 * i + k]) };
        check(&part(0), &part(1), &part(2));
    }
}

#[test]
fn all_backends_agree_bitwise_on_special_numbers() {
    let special = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        5e-324,
    ];
    for shift in 0..8 {
        let rotated: [f64; 8] = std::array::from_fn(|i| special[(i + shift) % 8]);
        check(&special, &rotated, &rotated);
        check(&special, &rotated, &special);
    }
}

struct Parts;

impl Kernel for Parts {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        parts::<B::Native>();
        parts::<B::Line>();
    }
}

#[inline(always)]
fn parts<L: Lanes>() {
    let source = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    for count in 0..=L::WIDTH {
        let value = L::load_part(&source[..count], count);
        let mut all = [9.0; 8];
        value.store(&mut all);
        for (i, &x) in all.iter().enumerate() {
            let expected = if i < count {
                source[i]
            } else if i < L::WIDTH {
                0.0
            } else {
                9.0
            };
            assert_eq!(x, expected, "lane {i} of {count}");
        }
        let mut some = [9.0; 8];
        (value + L::splat(1.0)).store_part(&mut some, count);
        for (i, &x) in some.iter().enumerate() {
            assert_eq!(
                x,
                if i < count { source[i] + 1.0 } else { 9.0 },
                "lane {i} of {count}"
            );
        }
    }
    for lanes in 0..=255 {
        let mut two = [0.0; 8];
        L::splat_two(1.0, 2.0, lanes).store(&mut two);
        for (i, &x) in two[..L::WIDTH].iter().enumerate() {
            assert_eq!(
                x,
                if lanes >> i & 1 == 1 { 2.0 } else { 1.0 },
                "lane {i} of {lanes:b}"
            );
        }
    }
}

#[test]
fn partial_loads_and_stores_touch_only_their_lanes() {
    for backend in available() {
        backend.run(Parts);
    }
}

struct Transposition;

impl Kernel for Transposition {
    type Output = ();

    #[inline(always)]
    fn run<B: Backend>(self) {
        assert_eq!(B::Half::WIDTH, 4);
        let entry = |row: usize, lane: usize| (10 * row + lane) as f64;
        let rows =
            [0, 1, 2, 3].map(|row| B::Half::load(&[0, 1, 2, 3].map(|lane| entry(row, lane))));
        for (row, found) in B::Half::transpose(rows).into_iter().enumerate() {
            let mut lanes = [0.0; 4];
            found.store(&mut lanes);
            assert_eq!(
                lanes,
                [0, 1, 2, 3].map(|lane| entry(lane, row)),
                "row {row}"
            );
        }
    }
}

#[test]
fn four_rows_of_four_lanes_are_transposed() {
    for backend in available() {
        backend.run(Transposition);
    }
}

#[test]
fn a_missing_backend_is_named() {
    for choice in [LaneChoice::Avx512, LaneChoice::Avx2] {
        if let Err(error) = SelectedLanes::new(choice) {
            assert!(error.to_string().contains("scalar"), "{error}");
        }
    }
    assert!(SelectedLanes::new(LaneChoice::Auto).is_ok());
}
