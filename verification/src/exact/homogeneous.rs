//! Laboratory tests of a homogeneous specimen that yields: stress and volume over the axial strain.
//!
//! Source: soil notes, 2.1 to 2.3. A specimen is pressed along y. Between rollers all round (oedometer) it has two slopes
//! ([`TwoSlopes`]). With a constant pressure across it follows Hooke's law up to its strength and keeps that: in triaxial
//! compression, with two stresses across that are equal, `sigma_x - sigma_y = E e`; in biaxial compression, with the
//! pressure along x and no strain along z, `E e/(1 - nu²)`, and `sigma_z` grows by nu times that. Beyond the strength only
//! plastic strain is added, whose volume is a constant share of the axial strain. The exception is a smooth surface in
//! biaxial compression: `sigma_z` goes on to change there until the flow has no part along z. That path is the solution of two
//! rate equations, which are integrated by the method of Runge and Kutta in small steps; without friction it has a closed
//! form, against which a test holds it.
//!
//! All laws are those of rates without rotation, so that strains are logarithmic and stresses are Cauchy's. Tension is
//! positive; pressures, strengths and the axial strain e are positive in compression.

use super::two_slopes::TwoSlopes;

/// Steps of the integration between two states of a path.
const STEPS: u32 = 200;

/// Condition across the axis y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Test {
    /// No strain along x and z.
    Oedometer,
    /// Constant pressure along x, no strain along z.
    Biaxial,
    /// Constant pressure along x and z.
    Triaxial,
}

/// Yield surface of a specimen, and its flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Angle of friction (degrees), cohesion (Pa) and angle of dilation (degrees); Tresca where both angles are zero.
    MohrCoulomb([f64; 3]),
    /// eta, xi c (Pa) and eta_psi of `sqrt(J_2) + eta p <= xi c` (p the mean stress) with flow along `sqrt(J_2) + eta_psi p`;
    /// von Mises with the yield stress Y where the slopes are zero and `xi c = Y/sqrt(3)`.
    Cone([f64; 3]),
}

/// A specimen in a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specimen {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Surface and flow.
    pub surface: Surface,
    /// The test.
    pub test: Test,
    /// Pressure from all sides at the start, Pa, which is kept where the test keeps one. An oedometer starts without.
    pub pressure: f64,
}

/// A state on the path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Normal stresses along x, y and z, Pa; there is no shear.
    pub stress: [f64; 3],
    /// Logarithm of the volume over that at the start.
    pub volume: f64,
}

impl Surface {
    /// Difference of the stresses along the axis and across at which it yields in triaxial compression under a pressure
    /// across, Pa; with a pyramid also in biaxial compression, since the stress along z is between the others.
    fn strength(&self, pressure: f64) -> f64 {
        match *self {
            Self::MohrCoulomb([friction, cohesion, _]) => {
                let (sine, cosine) = libm::sincos(friction.to_radians());
                2.0 * (cohesion * cosine + pressure * sine) / (1.0 - sine)
            }
            Self::Cone([eta, limit, _]) => {
                (limit + eta * pressure) / (1.0 / 3.0_f64.sqrt() - eta / 3.0)
            }
        }
    }

    /// Growth of the volume over the axial compression, of plastic strain in the same tests.
    fn dilation(&self) -> f64 {
        match *self {
            Self::MohrCoulomb([.., dilation]) => {
                let flow = libm::sin(dilation.to_radians());
                2.0 * flow / (1.0 - flow)
            }
            Self::Cone([.., flow]) => flow / (1.0 / 3.0_f64.sqrt() - flow / 3.0),
        }
    }
}

impl Specimen {
    /// Lamé's constants, Pa.
    fn lame(&self) -> (f64, f64) {
        let shear = self.young / (2.0 * (1.0 + self.poisson));
        let lambda = 2.0 * shear * self.poisson / (1.0 - 2.0 * self.poisson);
        (lambda, shear)
    }

    /// Axial strain at which it yields.
    #[must_use]
    pub fn yields_at(&self) -> f64 {
        match (self.test, self.surface) {
            (Test::Oedometer, surface) => {
                let solid = self.two_slopes(surface);
                solid.limit / solid.confined_modulus()
            }
            (Test::Biaxial, Surface::Cone([eta, limit, _])) => {
                let nu = self.poisson;
                // sqrt(J_2) of (0, q, nu q) is q sqrt((1 - nu + nu²)/3), and its mean compression q (1 + nu)/3.
                let slope = ((1.0 - nu + nu * nu) / 3.0).sqrt() - eta * (1.0 + nu) / 3.0;
                (limit + eta * self.pressure) / slope / self.stiffness()
            }
            (_, surface) => surface.strength(self.pressure) / self.stiffness(),
        }
    }

    /// States after axial strains, which do not decrease.
    #[must_use]
    pub fn path(&self, strains: &[f64]) -> Vec<State> {
        let strains = strains.iter().copied();
        match (self.test, self.surface) {
            (Test::Oedometer, surface) => {
                let solid = self.two_slopes(surface);
                strains.map(|e| confined(&solid, e)).collect()
            }
            (Test::Biaxial, Surface::Cone(cone)) => self.biaxial_of(cone, strains),
            _ => strains.map(|e| self.flowing(e)).collect(),
        }
    }

    fn two_slopes(&self, surface: Surface) -> TwoSlopes {
        match surface {
            Surface::MohrCoulomb(soil) => TwoSlopes::mohr_coulomb(self.young, self.poisson, soil),
            Surface::Cone(cone) => TwoSlopes::drucker_prager(self.young, self.poisson, cone),
        }
    }

    /// Elastic state of a difference `q` (Pa) of the stresses along y and x.
    fn elastic(&self, q: f64) -> State {
        let along_z = match self.test {
            Test::Biaxial => self.poisson * q,
            _ => 0.0,
        };
        State {
            stress: [0.0, q, along_z].map(|s| -self.pressure - s),
            volume: -(1.0 - 2.0 * self.poisson) * (q + along_z) / self.young,
        }
    }

    /// Axial stiffness with a constant pressure across, Pa.
    fn stiffness(&self) -> f64 {
        match self.test {
            Test::Biaxial => self.young / (1.0 - self.poisson * self.poisson),
            _ => self.young,
        }
    }

    /// The state after an axial strain where no stress changes any more once it yields.
    fn flowing(&self, strain: f64) -> State {
        let elastic = strain.min(self.yields_at());
        let mut state = self.elastic(self.stiffness() * elastic);
        state.volume += self.surface.dilation() * (strain - elastic);
        state
    }

    /// States of a cone in biaxial compression at increasing axial strains.
    fn biaxial_of(&self, cone: [f64; 3], strains: impl Iterator<Item = f64>) -> Vec<State> {
        let yields = self.yields_at();
        let mut state = self.elastic(self.stiffness() * yields);
        let mut at = yields;
        let mut states = vec![];
        for strain in strains {
            if strain <= yields {
                states.push(self.elastic(self.stiffness() * strain));
                continue;
            }
            let step = (strain - at) / f64::from(STEPS);
            for _ in 0..STEPS {
                state = self.runge_kutta(cone, state, step);
            }
            at = strain;
            states.push(state);
        }
        states
    }

    /// One step of order 4.
    fn runge_kutta(&self, cone: [f64; 3], from: State, step: f64) -> State {
        let moved = |rate: State, by: f64| State {
            stress: std::array::from_fn(|i| from.stress[i] + by * rate.stress[i]),
            volume: from.volume + by * rate.volume,
        };
        let first = self.rate(cone, from);
        let second = self.rate(cone, moved(first, 0.5 * step));
        let third = self.rate(cone, moved(second, 0.5 * step));
        let fourth = self.rate(cone, moved(third, step));
        let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * (b + c) + d) / 6.0;
        let rate = State {
            stress: std::array::from_fn(|i| {
                let [a, b, c, d] = [first, second, third, fourth].map(|rate| rate.stress[i]);
                mean(a, b, c, d)
            }),
            volume: mean(first.volume, second.volume, third.volume, fourth.volume),
        };
        moved(rate, step)
    }

    /// Change of a state that yields per axial strain in biaxial compression: with the strain rate a along x and the
    /// multiplier g, the stress along x stays, `(C (e - g m))_x = 0`, and so does the state on the surface,
    /// `n C (e - g m) = 0`, with the normals n of the surface and m of the flow.
    fn rate(&self, [eta, _, eta_psi]: [f64; 3], state: State) -> State {
        let (lambda, shear) = self.lame();
        let hooke = |e: [f64; 3]| e.map(|own| lambda * (e[0] + e[1] + e[2]) + 2.0 * shear * own);
        let mean = state.stress.iter().sum::<f64>() / 3.0;
        let deviator = state.stress.map(|s| s - mean);
        let root = (0.5 * deviator.iter().map(|s| s * s).sum::<f64>()).sqrt();
        let normal = |slope: f64| deviator.map(|s| s / (2.0 * root) + slope / 3.0);
        let (surface, flow) = (hooke(normal(eta)), normal(eta_psi));
        let back = hooke(flow);
        let resisting: f64 = surface.iter().zip(flow).map(|(n, m)| n * m).sum();
        let a = (lambda - back[0] * surface[1] / resisting)
            / (lambda + 2.0 * shear - back[0] * surface[0] / resisting);
        let multiplier = (a * surface[0] - surface[1]) / resisting;
        let trial = hooke([a, -1.0, 0.0]);
        State {
            stress: std::array::from_fn(|i| trial[i] - multiplier * back[i]),
            volume: a - 1.0,
        }
    }
}

/// The state of confined compression after an axial strain.
fn confined(solid: &TwoSlopes, strain: f64) -> State {
    let yields = solid.limit / solid.confined_modulus();
    let q = solid.confined_modulus() * strain.min(yields)
        + solid.plastic_modulus * (strain - yields).max(0.0);
    let across = -solid.across(q);
    State {
        stress: [across, -q, across],
        volume: -strain,
    }
}
