//! Normal contact pressure as a function of the gap, and Coulomb friction.

/// Pressure against gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NormalLaw {
    /// Barrier -kappa (g - g_c)² ln(g/g_c) below the critical gap (eq. 47, 48), continued below `floor` g_c along its
    /// tangent so that slope and time step stay finite and a gap below zero still pushes.
    Barrier {
        /// kappa \[Pa/m\].
        stiffness: f64,
        /// g_c \[m\].
        critical_gap: f64,
        /// Share of the critical gap below which the pressure is linear, between 0 and 1.
        floor: f64,
    },
    /// Pressure proportional to penetration.
    Penalty {
        /// \[Pa/m\].
        stiffness: f64,
    },
}

/// Share of the critical gap below which the pressure of the barrier is linear. With 0.001 explicit steps pump energy
/// into a fast impact; with 0.2 the layer is too soft for it.
pub const FLOOR: f64 = 0.05;

impl NormalLaw {
    /// The barrier with the usual floor.
    #[must_use]
    pub fn barrier(stiffness: f64, critical_gap: f64) -> Self {
        Self::Barrier {
            stiffness,
            critical_gap,
            floor: FLOOR,
        }
    }

    /// Gap below which there is pressure \[m\].
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self {
            Self::Barrier { critical_gap, .. } => *critical_gap,
            Self::Penalty { .. } => 0.0,
        }
    }

    /// Contact pressure lambda_n \[Pa\], zero or positive.
    #[must_use]
    pub fn pressure(&self, gap: f64) -> f64 {
        match *self {
            Self::Barrier {
                stiffness,
                critical_gap,
                floor,
            } => {
                let g_f = floor * critical_gap;
                if gap >= critical_gap {
                    0.0
                } else if gap >= g_f {
                    barrier_pressure(stiffness, critical_gap, gap)
                } else {
                    barrier_pressure(stiffness, critical_gap, g_f)
                        + barrier_slope(stiffness, critical_gap, g_f) * (g_f - gap)
                }
            }
            Self::Penalty { stiffness } => stiffness * (-gap).max(0.0),
        }
    }

    /// The smallest gap \[m\], down to none, at which the pressure is no more than a value \[Pa\] greater than 0.
    #[must_use]
    pub fn gap_at(&self, pressure: f64) -> f64 {
        let Self::Barrier { critical_gap, .. } = *self else {
            return 0.0;
        };
        let (mut pressed, mut free) = (0.0, critical_gap);
        if self.pressure(pressed) <= pressure {
            return pressed;
        }
        // The pressure falls from none to the critical gap, where it is zero.
        loop {
            let middle = 0.5 * (pressed + free);
            if middle <= pressed || middle >= free {
                return free;
            }
            if self.pressure(middle) > pressure {
                pressed = middle;
            } else {
                free = middle;
            }
        }
    }

    /// Slope -d lambda_n/dg \[Pa/m\], zero or positive.
    #[must_use]
    pub fn slope(&self, gap: f64) -> f64 {
        match *self {
            Self::Barrier {
                stiffness,
                critical_gap,
                floor,
            } => {
                if gap >= critical_gap {
                    0.0
                } else {
                    barrier_slope(stiffness, critical_gap, gap.max(floor * critical_gap))
                }
            }
            Self::Penalty { stiffness } if gap < 0.0 => stiffness,
            Self::Penalty { .. } => 0.0,
        }
    }

    /// Stored energy per area \[J/m²\], of which the pressure is the negative derivative.
    #[must_use]
    pub fn energy(&self, gap: f64) -> f64 {
        match *self {
            Self::Barrier {
                stiffness,
                critical_gap,
                floor,
            } => {
                let g_f = floor * critical_gap;
                if gap >= critical_gap {
                    return 0.0;
                }
                let g = gap.max(g_f);
                let below = (g_f - gap).max(0.0);
                let barrier = -stiffness * (g - critical_gap).powi(2) * libm::log(g / critical_gap);
                barrier
                    + below
                        * (barrier_pressure(stiffness, critical_gap, g_f)
                            + 0.5 * below * barrier_slope(stiffness, critical_gap, g_f))
            }
            Self::Penalty { stiffness } => 0.5 * stiffness * gap.min(0.0).powi(2),
        }
    }
}

/// Eq. 48 for 0 < g <= g_c.
fn barrier_pressure(stiffness: f64, g_c: f64, g: f64) -> f64 {
    stiffness * (g - g_c) * (2.0 * libm::log(g / g_c) - g_c / g + 1.0)
}

/// Its slope with the sign turned.
fn barrier_slope(stiffness: f64, g_c: f64, g: f64) -> f64 {
    let r = g_c / g;
    -stiffness * ((2.0 * libm::log(g / g_c) - r + 1.0) + (g - g_c) * (2.0 / g + r / g))
}

/// Coulomb friction with a tangential spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Coefficient mu.
    pub coefficient: f64,
    /// Stiffness kappa_t of the spring \[Pa/m\].
    pub stiffness: f64,
}

impl Friction {
    /// Tangential traction \[Pa\] for an elastic slip \[m\] under a normal pressure \[Pa\], and the elastic slip that
    /// remains: kappa_t u, mapped back to the cone |lambda_t| <= mu lambda_n. Without the mapping the spring would go
    /// on to stretch while the surfaces slide, and would have to be unloaded by as much when they turn back. Both have a
    /// component for each tangent of the surface.
    #[must_use]
    pub fn traction<const T: usize>(&self, slip: [f64; T], pressure: f64) -> ([f64; T], [f64; T]) {
        let most = self.coefficient * pressure;
        let trial = slip.map(|u| self.stiffness * u);
        let size = trial.iter().map(|t| t * t).sum::<f64>().sqrt();
        if size <= most {
            (trial, slip)
        } else {
            let traction = trial.map(|t| most * (t / size));
            (traction, traction.map(|t| t / self.stiffness))
        }
    }
}
