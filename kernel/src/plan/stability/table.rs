//! Largest stable C = (c + |v|) dt / min(h), as `proctor stability --table` printed it on 2026-11-26. Not edited by hand.

/// GIMP by scheme (USL, USF, MUSL), transfer (FLIP, APIC, TPIC) and half-length of a particle domain in cells
/// (1/2, 1/4, 1/8: one, two, four particles per cell and axis).
pub(super) const GIMP: [[[f64; 3]; 3]; 3] = [
    [
        [0.529, 0.424, 0.313],
        [0.630, 0.502, 0.365],
        [0.705, 0.570, 0.441],
    ],
    [
        [1.467, 1.280, 1.199],
        [0.917, 0.648, 0.458],
        [0.748, 0.600, 0.443],
    ],
    [
        [1.467, 1.280, 1.199],
        [0.917, 0.648, 0.458],
        [0.748, 0.600, 0.443],
    ],
];

/// Quadratic B-splines by scheme and transfer.
pub(super) const B_SPLINE: [[f64; 3]; 3] = [
    [0.529, 0.630, 0.705],
    [1.467, 0.891, 0.748],
    [1.467, 0.891, 0.748],
];

/// Quadratic B-splines with MLS by scheme.
pub(super) const LEAST_SQUARES: [f64; 3] = [0.897, 0.898, 0.898];

/// Linear functions by scheme and transfer. USL, APIC and TPIC have none that is safe for every body; theirs is for bodies
/// that fill their cells.
pub(super) const LINEAR: [[f64; 3]; 3] = [
    [0.662, 0.662, 0.662],
    [0.217, 0.662, 0.662],
    [0.698, 0.662, 0.662],
];
