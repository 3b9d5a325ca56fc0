//! One material point without a grid: a law under a path of strain, and the strains that a path of stress asks for.

use nalgebra::Matrix3;
use proctor_kernel::lanes::SelectedLanes;
use proctor_kernel::laws::tensor::Configuration;
use proctor_kernel::laws::{AnyLaw, Block, Component, Gradients, Particle, UNDEFORMED};
use proctor_kernel::layout::{Layout, Optional};
use std::fmt;

/// A point of a material, by the same code that strains particles.
#[derive(Clone, Debug)]
pub struct Point {
    law: AnyLaw,
    axes: usize,
    /// Initial volume \[m³\].
    size: f64,
    layout: Layout,
    columns: Vec<Vec<f64>>,
    density: f64,
    lanes: SelectedLanes,
    time: f64,
}

/// A stress or an internal variable is not finite, or a volume not positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointFault {
    /// Time after the step \[s\].
    pub time: f64,
}

impl fmt::Display for PointFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the material point has no finite stress or no volume at t = {} s",
            self.time
        )
    }
}

impl std::error::Error for PointFault {}

impl Point {
    /// A point in space at rest, of 1 m³ of a law and an initial density \[kg/m³\], under an initial stress xx, yy, zz, yz,
    /// xz, xy \[Pa\].
    #[must_use]
    pub fn new(law: &AnyLaw, density: f64, stress: [f64; 6]) -> Self {
        Self::with_axes(3, law, density, stress)
    }

    /// The same in plane strain: yz and xz of the stress are of no account.
    #[must_use]
    pub fn plane(law: &AnyLaw, density: f64, stress: [f64; 6]) -> Self {
        Self::with_axes(2, law, density, stress)
    }

    fn with_axes(axes: usize, law: &AnyLaw, density: f64, stress: [f64; 6]) -> Self {
        let wanted = Optional {
            deformation: true,
            ..Optional::default()
        };
        let layout = Layout::new(axes, wanted, law.variables());
        let mut point = Self {
            law: law.clone(),
            axes,
            size: 1.0,
            layout,
            columns: vec![vec![0.0]; layout.columns],
            density,
            lanes: SelectedLanes::any(),
            time: 0.0,
        };
        point.begin(stress);
        point
    }

    /// Begins anew, at rest under another initial stress.
    pub fn begin(&mut self, stress: [f64; 6]) {
        self.time = 0.0;
        self.columns[Layout::MASS][0] = self.density * self.size;
        let mean = (stress[0] + stress[1] + stress[2]) / 3.0;
        self.columns[Layout::VOLUME][0] = self.law.initial_volume_ratio(mean) * self.size;
        for (i, component) in self.components().iter().enumerate() {
            self.columns[Layout::stress(self.axes) + i][0] = stress[component.place()];
        }
        if let Some(first) = self.layout.deformation {
            for a in 0..self.axes {
                for b in 0..self.axes {
                    self.columns[first + self.axes * a + b][0] = UNDEFORMED[a][b];
                }
            }
        }
        let mut at = self.layout.variables;
        for variable in self.layout.law {
            for column in &mut self.columns[at..at + variable.components] {
                column[0] = variable.initial;
            }
            at += variable.components;
        }
    }

    /// Components of the stress that it keeps, in the order of its columns.
    fn components(&self) -> &'static [Component] {
        if self.axes == 2 {
            &[Component::XX, Component::YY, Component::ZZ, Component::XY]
        } else {
            &Component::ALL
        }
    }

    /// The same, at rest, with another initial volume \[m³\].
    #[must_use]
    pub fn of_volume(mut self, volume: f64) -> Self {
        let stress = self.stress();
        self.size = volume;
        self.begin(stress);
        self
    }

    /// The same on other lanes.
    #[must_use]
    pub fn on(self, lanes: SelectedLanes) -> Self {
        Self { lanes, ..self }
    }

    /// A step of `dt` \[s\] at the configuration before it, with a velocity gradient \[1/s\], row by row; in the plane its leading
    /// 2 x 2 block counts.
    ///
    /// # Errors
    /// If the law gives no finite stress, or no volume is left.
    pub fn step(&mut self, gradient: &[[f64; 3]; 3], dt: f64) -> Result<(), PointFault> {
        let mut gradients = Gradients::zero();
        for a in 0..self.axes {
            for b in 0..self.axes {
                gradients.0[self.axes * a + b][0] = gradient[a][b];
            }
        }
        let mut columns: Vec<&mut [f64]> = self.columns.iter_mut().map(Vec::as_mut_slice).collect();
        let strained = self.law.strain(
            self.lanes,
            Block {
                columns: &mut columns,
                layout: &self.layout,
                range: 0..1,
                gradients: &gradients,
                dt,
                configuration: Configuration::Beginning,
                density: self.density,
                volume_of_deformation: false,
            },
        );
        self.time += dt;
        match strained.fault {
            Some(_) => Err(PointFault { time: self.time }),
            None => Ok(()),
        }
    }

    /// A step of `dt` \[s\] without spin, whose strain increment in the configuration half way is exactly this: xx, yy, zz,
    /// yz, xz, xy, the last three as they stand in the tensor. Increments add up to the logarithmic strain where axes stay.
    ///
    /// # Errors
    /// As [`Point::step`].
    pub fn strain(&mut self, increment: &[f64; 6], dt: f64) -> Result<(), PointFault> {
        let [xx, yy, zz, yz, xz, xy] = increment.map(|e| e / dt);
        let d = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        // G_mid = 2 (f - 1)(f + 1)^-1 with f = 1 + G is d dt for G = (1 - d dt/2)^-1 d dt.
        let Some(inverse) = (Matrix3::identity() - 0.5 * dt * d).try_inverse() else {
            return Err(PointFault {
                time: self.time + dt,
            });
        };
        let gradient = inverse * d;
        self.step(
            &std::array::from_fn(|i| std::array::from_fn(|j| gradient[(i, j)])),
            dt,
        )
    }

    /// Cauchy stress xx, yy, zz, yz, xz, xy \[Pa\].
    #[must_use]
    pub fn stress(&self) -> [f64; 6] {
        let mut stress = [0.0; 6];
        for (i, component) in self.components().iter().enumerate() {
            stress[component.place()] = self.columns[Layout::stress(self.axes) + i][0];
        }
        stress
    }

    /// Deformation gradient.
    #[must_use]
    pub fn deformation(&self) -> [[f64; 3]; 3] {
        let Some(first) = self.layout.deformation else {
            return UNDEFORMED;
        };
        let mut deformation = UNDEFORMED;
        for a in 0..self.axes {
            for b in 0..self.axes {
                deformation[a][b] = self.columns[first + self.axes * a + b][0];
            }
        }
        deformation
    }

    /// Volume over initial volume.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.columns[Layout::VOLUME][0] / self.size
    }

    /// Internal variables, the components of the law's one after the other.
    #[must_use]
    pub fn variables(&self) -> Vec<f64> {
        let variables = &self.columns[self.layout.variables..];
        variables.iter().map(|column| column[0]).collect()
    }

    /// Stored energy per initial volume \[J/m³\].
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.particle(|law, particle| law.energy(particle))
    }

    /// Dissipated energy per initial volume \[J/m³\].
    #[must_use]
    pub fn dissipated(&self) -> f64 {
        self.particle(|law, particle| law.dissipated(particle))
    }

    /// Algorithmic work per initial volume \[J/m³\]: see [`Law::algorithmic`](proctor_kernel::laws::Law::algorithmic).
    #[must_use]
    pub fn algorithmic(&self) -> f64 {
        self.particle(|law, particle| law.algorithmic(particle))
    }

    fn particle(&self, ask: impl Fn(&AnyLaw, &Particle<'_>) -> f64) -> f64 {
        let of_point = ask(
            &self.law,
            &Particle {
                mass: self.columns[Layout::MASS][0],
                volume: self.columns[Layout::VOLUME][0],
                density: self.density,
                stress: self.stress(),
                deformation: self.deformation(),
                variables: &self.variables(),
            },
        );
        of_point / self.size
    }
}
