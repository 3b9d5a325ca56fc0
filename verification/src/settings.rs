//! The settings of the method, apart from the problem: the axes of a study of error against run time.

use std::fmt;

use proctor_scene::plan::{AUTOMATIC_SHARE, has_safe_step, stability_number};
use proctor_scene::{Scene, StressScheme, TimeStep, Transfer, TransferKind, Weighting};

/// Weighting function, stress scheme and transfer: a line of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    /// Weighting function.
    pub weighting: Weighting,
    /// Stress scheme.
    pub scheme: StressScheme,
    /// Transfer, with its usual share of PIC.
    pub transfer: TransferKind,
}

/// A method with its resolution of time and of particles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Method.
    pub method: Method,
    /// `c dt/h`, c the wave speed at rest; `None` leaves the step to the kernel.
    pub courant: Option<f64>,
    /// Particles per cell and axis.
    pub particles_per_cell: usize,
    /// True if a step above the stability bound of the method is tried.
    pub allow_unstable: bool,
}

impl Method {
    /// Settings of a scene that chooses none.
    pub const DEFAULT: Self = Self {
        weighting: Weighting::UniformGimp,
        scheme: StressScheme::Usl,
        transfer: TransferKind::Flip,
    };

    /// Sets another weighting function.
    #[must_use]
    pub const fn with_weighting(self, weighting: Weighting) -> Self {
        Self { weighting, ..self }
    }

    /// Sets another stress scheme.
    #[must_use]
    pub const fn with_scheme(self, scheme: StressScheme) -> Self {
        Self { scheme, ..self }
    }

    /// Sets another transfer.
    #[must_use]
    pub const fn with_transfer(self, transfer: TransferKind) -> Self {
        Self { transfer, ..self }
    }

    /// Word for the weighting function.
    #[must_use]
    pub fn weighting_word(self) -> &'static str {
        self.weighting.kind().name
    }

    /// Word for the stress scheme.
    #[must_use]
    pub fn scheme_word(self) -> &'static str {
        match self.scheme {
            StressScheme::Usf => "USF",
            StressScheme::Usl => "USL",
            StressScheme::Musl => "MUSL",
        }
    }

    /// Word for the transfer.
    #[must_use]
    pub fn transfer_word(self) -> &'static str {
        self.transfer.kind().word
    }

    /// True if weighting function and transfer go together.
    #[must_use]
    pub fn goes_together(self) -> bool {
        !self.transfer.kind().least_squares || self.weighting == Weighting::QuadraticBSpline
    }

    /// True if the kernel knows a time step that is safe for every body.
    #[must_use]
    pub fn has_safe_step(self) -> bool {
        has_safe_step(self.weighting, self.scheme, self.transfer)
    }

    /// Largest stable `c dt/h` that the kernel knows for this many particles per cell and axis; where there is none
    /// that is safe for every body, the one that holds while no node is nearly empty.
    #[must_use]
    pub fn stability_number(self, particles_per_cell: usize) -> f64 {
        let half_length = 0.5 / particles_per_cell as f64;
        stability_number(self.weighting, self.scheme, self.transfer, half_length)
    }
}

/// Words joined by blanks, as in `cpGIMP MUSL FLIP`.
impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} {} {}",
            self.weighting_word(),
            self.scheme_word(),
            self.transfer_word()
        )
    }
}

impl Settings {
    /// A method with two particles per cell and axis and the step that the kernel chooses.
    #[must_use]
    pub fn new(method: Method) -> Self {
        Self {
            method,
            courant: None,
            particles_per_cell: 2,
            allow_unstable: false,
        }
    }

    /// The same with a constant `c dt/h`.
    #[must_use]
    pub fn courant(mut self, courant: f64) -> Self {
        self.courant = Some(courant);
        self
    }

    /// Gives a scene the method and all its bodies the particles per cell. The time step stays: it depends on the
    /// wave speed and the end of a case.
    pub fn apply(&self, scene: &mut Scene) {
        scene.weighting = self.method.weighting;
        scene.scheme = self.method.scheme;
        scene.transfer = Transfer::new(self.method.transfer);
        let axes = scene.dimension.axes();
        for body in &mut scene.bodies {
            body.particles_per_cell[..axes].fill(self.particles_per_cell);
        }
    }

    /// A scene with the method, all its bodies with the particles per cell.
    #[must_use]
    pub fn applied(&self, mut scene: Scene) -> Scene {
        self.apply(&mut scene);
        scene
    }

    /// `c dt/h` that is asked for, or the share of the bound that the kernel takes by itself.
    #[must_use]
    pub fn courant_or_automatic(&self) -> f64 {
        self.courant
            .unwrap_or(AUTOMATIC_SHARE * self.method.stability_number(self.particles_per_cell))
    }

    /// Steps of the Courant number times `h/(c + |v|)` as they are now; the kernel's own where there is none.
    #[must_use]
    pub fn multiplier(&self) -> TimeStep {
        self.courant
            .map_or(TimeStep::Automatic, |multiplier| TimeStep::Multiplier {
                multiplier,
                allow_unstable: self.allow_unstable,
            })
    }

    /// Equal steps that end at `end` (s), of at most the Courant number for cells of `cell` (m) and waves of
    /// `wave_speed` (m/s); and their number.
    #[must_use]
    pub fn equal_steps(&self, end: f64, cell: f64, wave_speed: f64) -> (TimeStep, u64) {
        let most = self.courant_or_automatic() * cell / wave_speed;
        let steps = (end / most * (1.0 - 1e-12)).ceil().max(1.0);
        let step = TimeStep::Fixed {
            dt: end / steps,
            allow_unstable: self.allow_unstable,
        };
        (step, steps as u64)
    }
}
