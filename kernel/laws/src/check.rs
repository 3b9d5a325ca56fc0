//! Check of a law: what every law must hold, in one line of its author's test.

use crate::point::{Point, PointFault};
use proctor_kernel::lanes::{LaneChoice, SelectedLanes};
use proctor_kernel::laws::{AnyLaw, Component};
use std::fmt;

/// A matrix, row by row.
type Matrix = [[f64; 3]; 3];

/// Steps of a path.
const STEPS: usize = 40;
/// Largest component of a strain increment.
const INCREMENT: f64 = 5e-5;
/// Accepted error of what is exact but for round-off, over the largest value.
const ROUND_OFF: f64 = 1e-9;
/// Accepted part of the work of a path by which energies may be off: some strains of the path and some steps.
const ENERGY: f64 = 0.02;
/// Accepted part by which a wave may be faster than the law says.
const WAVE_SPEED: f64 = 1e-3;

/// Properties that every law must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawProperty {
    /// The bits of its results are the same on all lanes.
    Lanes,
    /// A motion in the plane gives the same stress in the plane and in space.
    Plane,
    /// Turned axes of space give the stress in turned axes.
    Axes,
    /// A rigid rotation turns the stress with it, and changes nothing else.
    Rotation,
    /// Stress does not depend on the volume of a particle, and its energies \[J\] are proportional to it.
    Volume,
    /// No more energy is stored and dissipated than the work of the stress; a law without memory and viscosity stores all of it.
    Energy,
    /// No small strain at rest travels faster than the wave speed from which the first time step follows.
    WaveSpeed,
}

impl fmt::Display for LawProperty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lanes => "other lanes give other bits",
            Self::Plane => "its stress in the plane is not that of the same motion in space",
            Self::Axes => "its stress in turned axes is not the turned stress",
            Self::Rotation => "a rigid rotation does not turn its stress, or does more than that",
            Self::Volume => {
                "its stress depends on the volume of a particle, or its energies do not grow with it"
            }
            Self::Energy => "its energies do not balance the work of its stress",
            Self::WaveSpeed => "its waves are faster than its wave speed",
        })
    }
}

/// A property that a law lacks.
#[derive(Clone, Debug, PartialEq)]
pub enum LawFault {
    /// A property that was measured.
    Property {
        /// Name of the law.
        law: String,
        /// The property.
        property: LawProperty,
        /// Error relative to the largest value.
        error: f64,
        /// Largest error that is accepted.
        accepted: f64,
    },
    /// No finite stress, or no volume, under a small strain.
    Point {
        /// Name of the law.
        law: String,
        /// The fault.
        fault: PointFault,
    },
}

impl fmt::Display for LawFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Property {
                law,
                property,
                error,
                accepted,
            } => write!(
                f,
                "law `{law}`: {property}: relative error {error:.1e}; accepted: {accepted:.0e}"
            ),
            Self::Point { law, fault } => write!(f, "law `{law}`: {fault}"),
        }
    }
}

impl std::error::Error for LawFault {}

/// Checks a law of an initial density \[kg/m³\] on small strains of a material point: [`LawProperty`] lists what it must hold.
///
/// The law is taken to be isotropic. A law that is not must pass all but [`LawProperty::Axes`].
///
/// ```
/// use proctor_laws::{Hencky, check_law};
///
/// check_law(Hencky::new(1e6, 0.3), 1000.0)?;
/// # Ok::<(), proctor_laws::LawFault>(())
/// ```
///
/// # Errors
/// The first property that the law lacks.
pub fn check_law(law: impl Into<AnyLaw>, density: f64) -> Result<(), LawFault> {
    let law = law.into();
    let check = Check {
        dt: 0.1 / law.wave_speed(density),
        law,
        density,
    };
    check.lanes()?;
    check.plane()?;
    check.axes()?;
    check.rotation()?;
    check.volume()?;
    check.energy()?;
    check.wave_speed()
}

/// A law under check.
struct Check {
    law: AnyLaw,
    density: f64,
    /// Time step \[s\].
    dt: f64,
}

impl Check {
    /// Stress of the start \[Pa\], where the law remembers one: pressure with some shear in the plane.
    fn initial_stress(&self) -> [f64; 6] {
        if self.law.needs_deformation() || self.law.is_fluid() {
            return [0.0; 6];
        }
        let unit = 1e-3 * self.law.young();
        [-1.2, -1.0, -0.9, 0.0, 0.0, 0.1].map(|s| s * unit)
    }

    fn in_space(&self) -> Point {
        Point::new(&self.law, self.density, self.initial_stress())
    }

    /// Velocity gradient of a step \[1/s\]: strains and spins that go to and fro, in the plane or in space.
    fn gradient(&self, step: usize, axes: usize) -> Matrix {
        let phase = 0.25 * step as f64;
        let of = |a: usize, b: usize| {
            if a.max(b) < axes {
                libm::cos(phase + 0.7 * (3 * a + b) as f64)
            } else {
                0.0
            }
        };
        let size = INCREMENT / self.dt;
        std::array::from_fn(|a| std::array::from_fn(|b| size * of(a, b)))
    }

    /// Moves a point along the path.
    fn follow(
        &self,
        mut point: Point,
        gradient: impl Fn(usize) -> Matrix,
    ) -> Result<Point, LawFault> {
        for step in 0..STEPS {
            self.step(&mut point, &gradient(step))?;
        }
        Ok(point)
    }

    fn step(&self, point: &mut Point, gradient: &Matrix) -> Result<(), LawFault> {
        let result = point.step(gradient, self.dt);
        result.map_err(|fault| LawFault::Point {
            law: self.law.name().into(),
            fault,
        })
    }

    fn require(&self, property: LawProperty, error: f64, accepted: f64) -> Result<(), LawFault> {
        // NaN is no error that is accepted.
        if error <= accepted {
            return Ok(());
        }
        Err(LawFault::Property {
            law: self.law.name().into(),
            property,
            error,
            accepted,
        })
    }

    fn lanes(&self) -> Result<(), LawFault> {
        let at_end = |lanes: SelectedLanes| {
            let point = self.follow(self.in_space().on(lanes), |step| self.gradient(step, 3))?;
            let stress = point.stress().into_iter();
            Ok(stress
                .chain(point.variables())
                .chain([point.volume()])
                .map(f64::to_bits)
                .collect::<Vec<u64>>())
        };
        let reference = at_end(SelectedLanes::plain())?;
        for choice in [LaneChoice::Scalar, LaneChoice::Avx2, LaneChoice::Avx512] {
            let Ok(lanes) = SelectedLanes::new(choice) else {
                continue;
            };
            let differs = at_end(lanes)? != reference;
            self.require(LawProperty::Lanes, f64::from(u8::from(differs)), 0.0)?;
        }
        Ok(())
    }

    fn plane(&self) -> Result<(), LawFault> {
        let gradient = |step| self.gradient(step, 2);
        let in_space = self.follow(self.in_space(), gradient)?;
        let plane = Point::plane(&self.law, self.density, self.initial_stress());
        let in_plane = self.follow(plane, gradient)?;
        let error = apart(&in_plane.stress(), &in_space.stress());
        self.require(LawProperty::Plane, error, ROUND_OFF)
    }

    fn axes(&self) -> Result<(), LawFault> {
        let q = rotation(0.6);
        let plain = self.follow(self.in_space(), |step| self.gradient(step, 3))?;
        let start = Point::new(&self.law, self.density, turned(&q, &self.initial_stress()));
        let along_turned = |step| turned_matrix(&q, &self.gradient(step, 3));
        let in_turned = self.follow(start, along_turned)?;
        let error = apart(&in_turned.stress(), &turned(&q, &plain.stress()));
        self.require(LawProperty::Axes, error, ROUND_OFF)
    }

    fn rotation(&self) -> Result<(), LawFault> {
        let mut still = self.follow(self.in_space(), |step| self.gradient(step, 3))?;
        let mut turning = still.clone();
        let q = rotation(0.2);
        // f = 1 + dt L is the rotation itself.
        let spin = std::array::from_fn(|a| {
            std::array::from_fn(|b| (q[a][b] - f64::from(u8::from(a == b))) / self.dt)
        });
        for _ in 0..4 {
            self.step(&mut still, &[[0.0; 3]; 3])?;
            self.step(&mut turning, &spin)?;
        }
        let mut expected = still.stress();
        for _ in 0..4 {
            expected = turned(&q, &expected);
        }
        let error = apart(&turning.stress(), &expected);
        self.require(LawProperty::Rotation, error, ROUND_OFF)
    }

    fn volume(&self) -> Result<(), LawFault> {
        let gradient = |step| self.gradient(step, 3);
        let unit = self.follow(self.in_space(), gradient)?;
        let small = self.follow(self.in_space().of_volume(1e-3), gradient)?;
        let energies = |p: &Point| [p.energy(), p.dissipated(), p.algorithmic()];
        let of_energies = apart(&energies(&small), &energies(&unit));
        let error = apart(&small.stress(), &unit.stress()).max(of_energies);
        self.require(LawProperty::Volume, error, ROUND_OFF)
    }

    fn energy(&self) -> Result<(), LawFault> {
        let mut point = self.in_space();
        let energy = |p: &Point| p.energy() + p.dissipated() + p.algorithmic();
        let start = energy(&point);
        let (mut work, mut exchanged) = (0.0, 0.0);
        for step in 0..STEPS {
            // Without spin the stresses before and after a step are along the same axes.
            let g = self.gradient(step, 3);
            let increment = Component::ALL.map(|component| {
                let (a, b) = PLACES[component.place()];
                0.5 * (g[a][b] + g[b][a]) * self.dt
            });
            let (before, volume) = (point.stress(), point.volume());
            let result = point.strain(&increment, self.dt);
            result.map_err(|fault| LawFault::Point {
                law: self.law.name().into(),
                fault,
            })?;
            let after = point.stress();
            let of_step: f64 = (Component::ALL.into_iter())
                .map(|component| {
                    let i = component.place();
                    let times = if component.is_normal() { 1.0 } else { 2.0 };
                    0.5 * times * (before[i] + after[i]) * increment[i]
                })
                .sum();
            let of_step = 0.5 * (volume + point.volume()) * of_step;
            work += of_step;
            exchanged += of_step.abs();
        }
        let gain = (energy(&point) - start - work) / exchanged;
        let keeps_all = self.law.variables().is_empty() && self.law.viscosity() == 0.0;
        let error = if keeps_all { gain.abs() } else { gain.max(0.0) };
        self.require(LawProperty::Energy, error, ENERGY)
    }

    fn wave_speed(&self) -> Result<(), LawFault> {
        let strain = 1e-2 * INCREMENT;
        let mut point = self.in_space();
        let [before, ..] = point.stress();
        let mut gradient = [[0.0; 3]; 3];
        gradient[0][0] = -strain / self.dt;
        self.step(&mut point, &gradient)?;
        let [after, ..] = point.stress();
        let modulus = (before - after) / strain - self.law.viscosity() / self.dt;
        let speed = self.law.wave_speed(self.density);
        let faster = (modulus / self.density).max(0.0).sqrt() / speed - 1.0;
        self.require(LawProperty::WaveSpeed, faster.max(0.0), WAVE_SPEED)
    }
}

/// Places of the components in a matrix.
const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// Largest difference of two lists of numbers, over the largest value of both.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let largest = (a.iter().chain(b)).fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let off = (a.iter().zip(b)).fold(0.0_f64, |most, (x, y)| most.max((x - y).abs()));
    off / largest
}

/// Rotation by an angle about an axis that lies in no plane of the axes.
fn rotation(angle: f64) -> Matrix {
    let n = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
    let (s, c) = (libm::sin(angle), libm::cos(angle));
    let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            let one = f64::from(u8::from(a == b));
            c * one + s * cross[a][b] + (1.0 - c) * n[a] * n[b]
        })
    })
}

/// Q M Q^T.
fn turned_matrix(q: &Matrix, m: &Matrix) -> Matrix {
    let entry = |a: usize, b: usize| {
        let each = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        each.map(|(i, j)| q[a][i] * m[i][j] * q[b][j]).sum()
    };
    std::array::from_fn(|a| std::array::from_fn(|b| entry(a, b)))
}

/// A stress xx, yy, zz, yz, xz, xy in turned axes.
fn turned(q: &Matrix, stress: &[f64; 6]) -> [f64; 6] {
    let [xx, yy, zz, yz, xz, xy] = *stress;
    let m = turned_matrix(q, &[[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
    PLACES.map(|(a, b)| m[a][b])
}
