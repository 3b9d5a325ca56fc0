//! Stress of a body that turns as a rigid one: `R sigma R^T` with a rotation R about a fixed axis.
//!
//! Components in the order xx, yy, zz, yz, xz, xy, in the units of the stress that is given.

/// A symmetric tensor: xx, yy, zz, yz, xz, xy.
pub type Tensor = [f64; 6];
/// A matrix by rows.
pub type Matrix = [[f64; 3]; 3];

/// The rotation by an angle (radians) about an axis of length 1.
#[must_use]
pub fn rotation(axis: [f64; 3], angle: f64) -> Matrix {
    let mut rotation = turn(axis, angle);
    for (i, row) in rotation.iter_mut().enumerate() {
        row[i] += 1.0;
    }
    rotation
}

/// The rotation less the identity, by Rodrigues' formula `R - I = sin a [n] + 2 sin²(a/2) (n n^T - I)`, where no digits of a
/// small angle are lost.
#[must_use]
pub fn turn(axis: [f64; 3], angle: f64) -> Matrix {
    let half = libm::sin(0.5 * angle);
    let (sin, rest) = (libm::sin(angle), 2.0 * half * half);
    let [x, y, z] = axis;
    let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    // n n^T - I has -(y² + z²) and so on where it would lose digits.
    let across = [y * y + z * z, z * z + x * x, x * x + y * y];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let second = if i == j {
                -across[i]
            } else {
                axis[i] * axis[j]
            };
            rest * second + sin * cross[i][j]
        })
    })
}

fn full([xx, yy, zz, yz, xz, xy]: Tensor) -> Matrix {
    [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
}

/// A tensor that has turned with its body by a rotation.
#[must_use]
pub fn turned(tensor: Tensor, rotation: &Matrix) -> Tensor {
    let given = full(tensor);
    let of = |i: usize, j: usize| {
        let mut sum = 0.0;
        for (k, row) in given.iter().enumerate() {
            for (l, value) in row.iter().enumerate() {
                sum += rotation[i][k] * value * rotation[j][l];
            }
        }
        sum
    };
    [of(0, 0), of(1, 1), of(2, 2), of(1, 2), of(0, 2), of(0, 1)]
}

/// Length of a tensor, `sqrt(sigma : sigma)`.
#[must_use]
pub fn length([xx, yy, zz, yz, xz, xy]: Tensor) -> f64 {
    (xx * xx + yy * yy + zz * zz + 2.0 * (yz * yz + xz * xz + xy * xy)).sqrt()
}

/// Invariants, each to the power at which it is in proportion to the tensor: trace, length of the deviator, and the cube root
/// of its determinant. Tensors have the same principal values where these are the same.
#[must_use]
pub fn invariants(tensor: Tensor) -> [f64; 3] {
    let [xx, yy, zz, yz, xz, xy] = tensor;
    let trace = xx + yy + zz;
    let mean = trace / 3.0;
    let [a, b, c] = [xx - mean, yy - mean, zz - mean];
    let third = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    [trace, length([a, b, c, yz, xz, xy]), libm::cbrt(third)]
}
