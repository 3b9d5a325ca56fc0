//! Two elastic bars that collide end to end: waves in one dimension (Saint-Venant 1867; Goldsmith, Impact, ch. 4).
//!
//! The interface moves with `(Z1 v1 + Z2 v2)/(Z1 + Z2)`, Z the impedance rho c, under the stress
//! `Z1 Z2/(Z1 + Z2) (v1 - v2)`, until the first reflection from a free end comes back. The solution is closed in two
//! families: *equal transit times*, where both bars are free of stress at that moment and part with the velocities of
//! an elastic impact of points, whatever their masses; and *equal impedances*, where the shorter bar has given its
//! velocity to the part of the longer one that the wave has reached, and the longer one keeps a wave: restitution is
//! the ratio of the lengths. Other bars are followed wave by wave, which is exact too: at the interface `v - sigma/Z` of what
//! comes along the first bar and `v + sigma/Z` along the second are what left it two transits before, since a free end sends
//! a wave back with its velocity. Bars part where they would pull, and meet again where their ends come together.

/// An elastic bar in uniform motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingBar {
    /// Length, m.
    pub length: f64,
    /// Modulus along the bar, Pa.
    pub modulus: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Velocity before the impact, m/s.
    pub velocity: f64,
}

impl MovingBar {
    /// Wave speed, m/s.
    #[must_use]
    pub fn wave_speed(&self) -> f64 {
        (self.modulus / self.density).sqrt()
    }

    /// Impedance, Pa s/m.
    #[must_use]
    pub fn impedance(&self) -> f64 {
        self.density * self.wave_speed()
    }

    /// Time that a wave takes along the bar, s.
    #[must_use]
    pub fn transit(&self) -> f64 {
        self.length / self.wave_speed()
    }

    /// Mass per cross-section, kg/m².
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * self.length
    }

    /// Answer of the bar to a rigid wall that it runs into: the limit of a second bar of any impedance.
    #[must_use]
    pub fn at_a_wall(&self) -> WallImpact {
        WallImpact {
            stress: self.impedance() * self.velocity.abs(),
            duration: 2.0 * self.transit(),
            velocity: -self.velocity,
        }
    }
}

/// The impact of a bar on a rigid wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallImpact {
    /// Pressure on the wall while they touch, Pa: rho c v.
    pub stress: f64,
    /// Time for which they touch, s: twice the transit.
    pub duration: f64,
    /// Velocity after the rebound, m/s.
    pub velocity: f64,
}

/// A bar that runs into another in front of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarImpact {
    /// The two bars, the one behind first.
    pub bars: [MovingBar; 2],
}

impl BarImpact {
    /// Compressive stress at the interface while the bars touch, Pa.
    #[must_use]
    pub fn stress(&self) -> f64 {
        let [a, b] = &self.bars;
        let (z_a, z_b) = (a.impedance(), b.impedance());
        z_a * z_b / (z_a + z_b) * (a.velocity - b.velocity)
    }

    /// Force between the bars; `None` where they do not come nearer.
    #[must_use]
    pub fn press(&self) -> Option<Press> {
        let [a, b] = &self.bars;
        let same = |p: f64, q: f64| (p - q).abs() <= 1e-9 * p.max(q);
        let closed = same(a.transit(), b.transit()) || same(a.impedance(), b.impedance());
        let duration = 2.0 * a.transit().min(b.transit());
        (a.velocity > b.velocity).then(|| {
            if closed {
                Press {
                    impulse: self.stress() * duration,
                    duration,
                    parted: duration,
                }
            } else {
                self.follow()
            }
        })
    }

    /// Follows the waves of bars of any kind.
    fn follow(&self) -> Press {
        // Later contacts would need ends that come together after so many echoes.
        const TRANSITS: f64 = 12.0;
        let [a, b] = &self.bars;
        let [z_a, z_b] = [a.impedance(), b.impedance()];
        let end = TRANSITS * a.transit().max(b.transit());
        let pull = 1e-12 * self.stress();
        let mut ends = self.bars.map(|bar| Echo {
            delay: 2.0 * bar.transit(),
            before: bar.velocity,
            sent: vec![],
        });
        let (mut time, mut touching, mut gap) = (0.0, true, 0.0_f64);
        let (mut impulse, mut moment, mut parted) = (0.0, 0.0, 0.0);
        while time < end {
            let [from_a, from_b] = [ends[0].back(time), ends[1].back(time)];
            let stress = (from_b - from_a) / (1.0 / z_a + 1.0 / z_b);
            touching = if touching {
                stress < -pull
            } else {
                gap <= 0.0 && from_b < from_a
            };
            let (stress, apart) = if touching {
                (stress, 0.0)
            } else {
                (0.0, from_b - from_a)
            };
            // v is from_a + stress/Z_a = from_b - stress/Z_b.
            ends[0].sent.push((time, from_a + 2.0 * stress / z_a));
            ends[1].sent.push((time, from_b - 2.0 * stress / z_b));
            let mut next = end.min(ends[0].next(time)).min(ends[1].next(time));
            if !touching && apart < 0.0 {
                next = next.min(time - gap / apart);
            }
            if touching {
                impulse -= stress * (next - time);
                moment -= stress * 0.5 * (next * next - time * time);
                parted = next;
            } else {
                gap = if next < end && time - gap / apart == next {
                    0.0
                } else {
                    gap + apart * (next - time)
                };
            }
            time = next;
        }
        Press {
            impulse,
            duration: 2.0 * moment / impulse,
            parted,
        }
    }

    /// Mean velocities of the bars after the impact, m/s: each changes by the impulse over its mass.
    #[must_use]
    pub fn velocities(&self) -> Option<[f64; 2]> {
        let impulse = self.press()?.impulse;
        let [a, b] = &self.bars;
        Some([
            a.velocity - impulse / a.mass(),
            b.velocity + impulse / b.mass(),
        ])
    }

    /// Coefficient of restitution: speed of parting over speed of approach.
    #[must_use]
    pub fn restitution(&self) -> Option<f64> {
        let [after_a, after_b] = self.velocities()?;
        let [a, b] = &self.bars;
        Some((after_b - after_a) / (a.velocity - b.velocity))
    }
}

/// Force between two bars.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// Impulse per cross-section, Pa s.
    pub impulse: f64,
    /// Twice the centroid of the pressure in time, s: how long a pressure that does not change acts.
    pub duration: f64,
    /// Time at which they have parted for good, s.
    pub parted: f64,
}

/// Wave that comes back from the other end of a bar after it left this one.
struct Echo {
    /// Two transits, s.
    delay: f64,
    /// Velocity before anything has come back, m/s.
    before: f64,
    /// Waves that were sent, with the times since which they are, m/s.
    sent: Vec<(f64, f64)>,
}

impl Echo {
    /// Wave that comes back from a time on.
    fn back(&self, time: f64) -> f64 {
        let sent = self.sent.iter().rev();
        let due = sent
            .into_iter()
            .find(|(since, _)| since + self.delay <= time);
        due.map_or(self.before, |(_, velocity)| *velocity)
    }

    /// Time of its next change, s.
    fn next(&self, time: f64) -> f64 {
        let due = self.sent.iter().map(|(since, _)| since + self.delay);
        due.filter(|due| *due > time).fold(f64::INFINITY, f64::min)
    }
}
