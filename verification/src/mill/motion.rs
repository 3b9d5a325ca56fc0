//! Smooth motions with known derivatives: x(X, t) = c + s(t) + M(t) (X - c + g(t) w(X)), with x(X, 0) = X.

use crate::exact::jet::{Jet, Scalar};

/// A vector of numbers of any kind.
pub type Vector<T = f64> = [T; 3];
/// A matrix of numbers of any kind.
pub type Matrix<T = f64> = [[T; 3]; 3];

/// Half the edge of the square or cube around the centre in which the field differs from zero \[m\].
pub const HALF: f64 = 0.5;
/// Coefficients of a polynomial of second degree: 1, x, y, z, x², y², z², xy, yz, zx.
pub const TERMS: usize = 10;

/// The factor that takes a field to zero at |x_i| = 1/2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bubble {
    /// Product of cos(pi x_i), zero on the faces: for a body between fixed planes.
    Cosine,
    /// Product of (1 - 4 x_i²)^n: with it the first n - 1 derivatives are zero on the faces, and all beyond them.
    Power(usize),
}

/// The field w(X) \[m\]: a bubble times a polynomial for each component. `axes` of them count.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Number of axes.
    pub axes: usize,
    /// Bubble.
    pub bubble: Bubble,
    /// Coefficients of each component \[m\], of coordinates in units of half an edge.
    pub polynomials: [[f64; TERMS]; 3],
}

impl Field {
    /// The field at a place relative to the centre \[m\].
    pub fn at<T: Scalar>(&self, x: &Vector<T>) -> Vector<T> {
        let zero = T::of(0.0);
        let bubble = match self.bubble {
            Bubble::Cosine => x[..self.axes].iter().fold(T::of(1.0), |product, x| {
                product * (*x * T::of(std::f64::consts::PI)).cos()
            }),
            Bubble::Power(n) => {
                let outside = |x: &T| x.value().abs() >= HALF;
                if x[..self.axes].iter().any(outside) {
                    return [zero; 3];
                }
                x[..self.axes].iter().fold(T::of(1.0), |product, x| {
                    product * (T::of(1.0) - *x * *x * T::of(4.0)).power(n)
                })
            }
        };
        let [x, y, z] = x.map(|x| x * T::of(1.0 / HALF));
        let terms = [
            T::of(1.0),
            x,
            y,
            z,
            x * x,
            y * y,
            z * z,
            x * y,
            y * z,
            z * x,
        ];
        std::array::from_fn(|axis| {
            if axis >= self.axes {
                return zero;
            }
            let all = terms.iter().zip(&self.polynomials[axis]);
            bubble * all.fold(zero, |sum, (term, factor)| sum + *term * T::of(*factor))
        })
    }
}

/// Motion of the frame that the field is carried by, and the pulse of the field.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Centre c \[m\].
    pub center: Vector,
    /// Field w.
    pub field: Field,
    /// Angular frequency of the pulse g = sin(w t) \[rad/s\].
    pub pulse: f64,
    /// Velocity of the shift s = v t \[m/s\].
    pub drift: Vector,
    /// Axis of the turn, a unit vector.
    pub axis: Vector,
    /// Rate of the turn \[rad/s\].
    pub spin: f64,
    /// Rate H of the stretch and shear, M = R(t) (1 + t H) \[1/s\].
    pub stretch: Matrix,
}

/// A function of time with its first two derivatives.
type TimeFunction = Jet<1, Jet<1>>;

/// The parts of a motion that depend on time alone, with derivatives of first and second order.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// M, M', M''.
    pub frame: [Matrix; 3],
    /// g, g', g''.
    pub pulse: [f64; 3],
    /// s, s'.
    pub shift: [Vector; 2],
}

/// The parts that depend on the place alone.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// X - c \[m\].
    pub from_center: Vector,
    /// w \[m\].
    pub field: Vector,
    /// dw_i/dX_j.
    pub gradient: Matrix,
    /// d²w_i/dX_j dX_k \[1/m\].
    pub second: [Matrix; 3],
}

impl Motion {
    /// Number of axes.
    #[must_use]
    pub fn axes(&self) -> usize {
        self.field.axes
    }

    /// M(t).
    pub fn frame<T: Scalar>(&self, t: T) -> Matrix<T> {
        let angle = t * T::of(self.spin);
        let (sin, rest) = (angle.sin(), T::of(1.0) - angle.cos());
        let [a, b, c] = self.axis;
        // Rodrigues: R = 1 + sin K + (1 - cos) K².
        let k = [[0.0, -c, b], [c, 0.0, -a], [-b, a, 0.0]];
        let square = product(&k, &k);
        let one = |i: usize, j: usize| T::of(f64::from(u8::from(i == j)));
        let rotation: Matrix<T> =
            matrix(|i, j| one(i, j) + sin * T::of(k[i][j]) + rest * T::of(square[i][j]));
        product(
            &rotation,
            &matrix(|i, j| one(i, j) + t * T::of(self.stretch[i][j])),
        )
    }

    /// x(X, t) \[m\].
    pub fn place<T: Scalar>(&self, x0: &Vector<T>, t: T) -> Vector<T> {
        let from_center: Vector<T> =
            std::array::from_fn(|axis| x0[axis] - T::of(self.center[axis]));
        let field = self.field.at(&from_center);
        let pulse = (t * T::of(self.pulse)).sin();
        let frame = self.frame(t);
        let inner: Vector<T> = std::array::from_fn(|axis| from_center[axis] + pulse * field[axis]);
        let turned = apply(&frame, &inner);
        std::array::from_fn(|axis| {
            T::of(self.center[axis]) + t * T::of(self.drift[axis]) + turned[axis]
        })
    }

    /// The share that depends on time.
    #[must_use]
    pub fn at(&self, t: f64) -> Moment {
        let time = TimeFunction::variable(Jet::variable(t, 0), 0);
        let frame = self.frame(time);
        let pulse = (time * TimeFunction::of(self.pulse)).sin();
        let derivatives = |x: TimeFunction| {
            [
                x.value.value,
                x.partials[0].value,
                x.partials[0].partials[0],
            ]
        };
        Moment {
            frame: std::array::from_fn(|order| matrix(|i, j| derivatives(frame[i][j])[order])),
            pulse: derivatives(pulse),
            shift: [self.drift.map(|v| v * t), self.drift],
        }
    }

    /// The share that depends on the place X \[m\].
    #[must_use]
    pub fn of(&self, x0: &Vector) -> Place {
        let from_center: Vector = std::array::from_fn(|axis| x0[axis] - self.center[axis]);
        let x: Vector<Jet<3, Jet<3>>> =
            std::array::from_fn(|axis| Jet::variable(Jet::variable(from_center[axis], axis), axis));
        let field = self.field.at(&x);
        Place {
            from_center,
            field: field.map(|w| w.value.value),
            gradient: matrix(|i, j| field[i].partials[j].value),
            second: std::array::from_fn(|i| matrix(|j, k| field[i].partials[j].partials[k])),
        }
    }
}

impl Moment {
    /// Position less that of the centre at the start, velocity and acceleration of a place \[m, m/s, m/s²\].
    #[must_use]
    pub fn motion(&self, place: &Place) -> [Vector; 3] {
        let [g, g1, g2] = self.pulse;
        let [m, m1, m2] = &self.frame;
        let y: Vector = std::array::from_fn(|axis| place.from_center[axis] + g * place.field[axis]);
        let [y1, y2] = [g1, g2].map(|rate| place.field.map(|w| rate * w));
        let (x, v) = (apply(m, &y), [apply(m1, &y), apply(m, &y1)]);
        let a = [apply(m2, &y), apply(m1, &y1), apply(m, &y2)];
        [
            std::array::from_fn(|i| self.shift[0][i] + x[i]),
            std::array::from_fn(|i| self.shift[1][i] + v[0][i] + v[1][i]),
            std::array::from_fn(|i| a[0][i] + 2.0 * a[1][i] + a[2][i]),
        ]
    }

    /// Deformation gradient of a place, F = M (1 + g grad w).
    #[must_use]
    pub fn deformation(&self, place: &Place) -> Matrix {
        let g = self.pulse[0];
        let inner = matrix(|i, j| f64::from(u8::from(i == j)) + g * place.gradient[i][j]);
        product(&self.frame[0], &inner)
    }

    /// The same with its derivatives by X: dF/dX_k = M g d(grad w)/dX_k.
    #[must_use]
    pub fn deformation_jet<const D: usize>(&self, place: &Place) -> Matrix<Jet<D>> {
        let f = self.deformation(place);
        let (m, g) = (&self.frame[0], self.pulse[0]);
        matrix(|i, j| Jet {
            value: f[i][j],
            partials: std::array::from_fn(|k| {
                let sum: f64 = (0..D).map(|l| m[i][l] * place.second[l][j][k]).sum();
                g * sum
            }),
        })
    }

    /// Rate of F \[1/s\]: at the start, where F = 1, the velocity gradient.
    #[must_use]
    pub fn rate(&self, place: &Place) -> Matrix {
        self.rate_jet::<3>(place).map(|row| row.map(|f| f.value))
    }

    /// The same with its derivatives by X, F' = M' + (g' M + g M') grad w.
    #[must_use]
    pub fn rate_jet<const D: usize>(&self, place: &Place) -> Matrix<Jet<D>> {
        let ([m, m1, _], [g, g1, _]) = (&self.frame, self.pulse);
        let carries = matrix(|i, j| g1 * m[i][j] + g * m1[i][j]);
        let carried = product(&carries, &place.gradient);
        matrix(|i, j| Jet {
            value: m1[i][j] + carried[i][j],
            partials: std::array::from_fn(|k| {
                (0..D).map(|l| carries[i][l] * place.second[l][j][k]).sum()
            }),
        })
    }
}

/// The matrix of these entries.
pub fn matrix<T>(entry: impl Fn(usize, usize) -> T) -> Matrix<T> {
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// Product of two matrices.
pub fn product<T: Scalar>(a: &Matrix<T>, b: &Matrix<T>) -> Matrix<T> {
    matrix(|i, j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
}

/// A matrix times a vector.
pub fn apply<T: Scalar>(a: &Matrix<T>, x: &Vector<T>) -> Vector<T> {
    std::array::from_fn(|i| a[i][0] * x[0] + a[i][1] * x[1] + a[i][2] * x[2])
}

/// Determinant.
pub fn determinant<T: Scalar>(m: &Matrix<T>) -> T {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
}

/// Inverse.
pub fn inverse<T: Scalar>(m: &Matrix<T>) -> Matrix<T> {
    let share = T::of(1.0) / determinant(m);
    matrix(|i, j| {
        let (a, b) = ((j + 1) % 3, (j + 2) % 3);
        let (c, d) = ((i + 1) % 3, (i + 2) % 3);
        (m[a][c] * m[b][d] - m[a][d] * m[b][c]) * share
    })
}
