//! The columns of probes, and their values of one state.

use proctor_kernel::layout::Layout;
use proctor_kernel::particles::ParticleSet;
use proctor_scene::simulation::Simulation;
use proctor_scene::{ProbeTarget, ProbedQuantity, Vector};

/// Components of the stress, in the order of the particles.
pub(super) const STRESS: [&str; 6] = ["XX", "YY", "ZZ", "YZ", "XZ", "XY"];

/// Pore pressure of a particle \[Pa\], compression positive, where it has water.
pub(super) fn pore_pressure(set: &ParticleSet, p: usize) -> Option<f64> {
    let column = set.layout.pore_pressure()?;
    Some(set.columns[column][p])
}

/// Total stress of a particle with water \[Pa\], tension positive: the effective stress less the pore pressure in all normal
/// components.
pub(super) fn total_stress(set: &ParticleSet, p: usize) -> Option<[f64; 6]> {
    let pressure = pore_pressure(set, p)?;
    let [xx, yy, zz, yz, xz, xy] = set.stress(p);
    Some([xx - pressure, yy - pressure, zz - pressure, yz, xz, xy])
}

/// A probe with the particles that it follows in a simulation.
pub(super) struct FollowedProbe {
    name: String,
    set: usize,
    target: FollowedTarget,
}

/// The particles that a probe follows.
enum FollowedTarget {
    /// The particle with this identifier.
    Particle(u64),
    /// Means over the body.
    Body,
    /// The particle of the body with the largest value.
    Largest(ProbedQuantity),
}

impl FollowedProbe {
    /// The probes of a scene; those of points follow the particle that is nearest at the start.
    pub(super) fn all(simulation: &Simulation) -> Vec<Self> {
        let mut all = vec![];
        for probe in &simulation.scene().probes {
            for (name, position) in probe.points() {
                if let Some((set, id)) = nearest(simulation, &position) {
                    let target = FollowedTarget::Particle(id);
                    all.push(Self { name, set, target });
                }
            }
            let (body, target) = match probe.target {
                ProbeTarget::Body(body) => (body, FollowedTarget::Body),
                ProbeTarget::Largest { body, quantity } => {
                    (body, FollowedTarget::Largest(quantity))
                }
                ProbeTarget::Point(_) | ProbeTarget::Line { .. } => continue,
            };
            let mut sets = 0..simulation.sets().len();
            if let Some(set) = sets.find(|set| simulation.body(*set).id == body) {
                let name = probe.name.clone();
                all.push(Self { name, set, target });
            }
        }
        all
    }

    /// Names of its columns.
    pub(super) fn columns(&self, simulation: &Simulation) -> Vec<String> {
        let letters = &["x", "y", "z"][..simulation.plan().axes];
        let name = &self.name;
        if let FollowedTarget::Largest(quantity) = self.target {
            let value = format!("{name}_{}", quantity.word());
            let place = letters.iter().map(|l| format!("{name}_{l}"));
            return [value, format!("{name}_particle")]
                .into_iter()
                .chain(place)
                .collect();
        }
        let mut names: Vec<String> = letters.iter().map(|l| format!("{name}_u{l}")).collect();
        names.extend(letters.iter().map(|l| format!("{name}_v{l}")));
        names.extend(STRESS.map(|s| format!("{name}_s{}", s.to_lowercase())));
        let layout = simulation.sets()[self.set].layout;
        if layout.water.is_some() {
            names.push(format!("{name}_pore_pressure"));
            names.extend(STRESS.map(|s| format!("{name}_total_s{}", s.to_lowercase())));
        }
        if let FollowedTarget::Particle(_) = self.target {
            names.extend(layout.components().map(|(variable, i, _)| {
                format!("{name}_{}", variable.component(i).replace(' ', "_"))
            }));
        }
        names
    }

    /// Values of its columns; not a number where the particle was removed or the body has none left.
    pub(super) fn values(&self, simulation: &Simulation) -> Vec<f64> {
        let found = match self.target {
            FollowedTarget::Particle(id) => self.particle(simulation, id),
            FollowedTarget::Body => self.means(simulation),
            FollowedTarget::Largest(quantity) => self.largest(simulation, quantity),
        };
        found.unwrap_or_else(|| vec![f64::NAN; self.columns(simulation).len()])
    }

    fn particle(&self, simulation: &Simulation, id: u64) -> Option<Vec<f64>> {
        let axes = simulation.plan().axes;
        let set = &simulation.sets()[self.set];
        let own = simulation.own_particles(set);
        let row = own.iter().find(|p| set.id[*p] == id).map(|p| {
            let u = simulation.displacement(self.set, p);
            let mut row = u.unwrap_or([f64::NAN; 3])[..axes].to_vec();
            row.extend_from_slice(&set.velocity(p)[..axes]);
            row.extend_from_slice(&set.stress(p));
            row.extend(pore_pressure(set, p));
            row.extend(total_stress(set, p).into_iter().flatten());
            row.extend(set.variables(p));
            row
        });
        let Some(ranks) = simulation.ranks() else {
            return row;
        };
        let words: Vec<u64> = row.iter().flatten().map(|value| value.to_bits()).collect();
        let mut all = ranks.all_gather(&words).into_iter();
        let found = all.find(|words| !words.is_empty())?;
        Some(found.into_iter().map(f64::from_bits).collect())
    }

    /// Means over the body: displacement and velocity by mass, stress and pore pressure by volume. The sums are exact, so that they do not depend on
    /// how particles are stored.
    fn means(&self, simulation: &Simulation) -> Option<Vec<f64>> {
        let axes = simulation.plan().axes;
        let set = &simulation.sets()[self.set];
        set.layout.displacement_origin?;
        let wet = set.layout.water.is_some();
        let sums: [f64; 15] = simulation.sums_of(self.set, |p| {
            let m = set.columns[Layout::MASS][p];
            let volume = simulation.particle_volume(self.set, p);
            let [ux, uy, uz] = simulation
                .displacement(self.set, p)
                .unwrap_or([f64::NAN; 3]);
            let [vx, vy, vz] = set.velocity(p);
            let [xx, yy, zz, yz, xz, xy] = set.stress(p).map(|s| volume * s);
            let [ux, uy, uz, vx, vy, vz] = [ux, uy, uz, vx, vy, vz].map(|c| m * c);
            let pressure = volume * pore_pressure(set, p).unwrap_or(0.0);
            [
                m, volume, ux, uy, uz, vx, vy, vz, xx, yy, zz, yz, xz, xy, pressure,
            ]
        });
        let (mass, volume) = (sums[0], sums[1]);
        let [u, v, stress] = [&sums[2..5], &sums[5..8], &sums[8..14]];
        (mass > 0.0).then(|| {
            let mut row: Vec<f64> = u[..axes].iter().map(|c| c / mass).collect();
            row.extend(v[..axes].iter().map(|c| c / mass));
            row.extend(stress.iter().map(|c| c / volume));
            if wet {
                let pressure = sums[14] / volume;
                row.push(pressure);
                let of = |i: usize| if i < 3 { pressure } else { 0.0 };
                row.extend((0..6).map(|i| stress[i] / volume - of(i)));
            }
            row
        })
    }

    /// The largest value, the identifier of its particle, and where that is. Of equal ones the smallest identifier.
    fn largest(&self, simulation: &Simulation, quantity: ProbedQuantity) -> Option<Vec<f64>> {
        let set = &simulation.sets()[self.set];
        let column = match quantity {
            ProbedQuantity::PlasticStrain => Some(set.column(ProbedQuantity::PLASTIC_STRAIN)?),
            _ => None,
        };
        let value = |p: usize| match quantity {
            ProbedQuantity::Displacement => {
                let u = simulation.displacement(self.set, p);
                length(u.unwrap_or([f64::NAN; 3]))
            }
            ProbedQuantity::Velocity => length(set.velocity(p)),
            ProbedQuantity::MisesStress => mises(set.stress(p)),
            ProbedQuantity::Pressure => {
                let [xx, yy, zz, ..] = set.stress(p);
                -(xx + yy + zz) / 3.0
            }
            ProbedQuantity::PlasticStrain => column.map_or(f64::NAN, |column| column[p]),
        };
        let mut best: Option<(f64, usize)> = None;
        for p in simulation.own_particles(set).iter() {
            let own = value(p);
            let is_larger =
                best.is_none_or(|(most, q)| own > most || (own == most && set.id[p] < set.id[q]));
            if own.is_finite() && is_larger {
                best = Some((own, p));
            }
        }
        let row = best.map(|(most, p)| {
            let mut row = vec![most, set.id[p] as f64];
            row.extend_from_slice(&simulation.position(self.set, p)[..simulation.plan().axes]);
            row
        });
        let Some(ranks) = simulation.ranks() else {
            return row;
        };
        let words: Vec<u64> = row.iter().flatten().map(|value| value.to_bits()).collect();
        let all = ranks.all_gather(&words).into_iter();
        let rows = all.map(|words| words.into_iter().map(f64::from_bits).collect::<Vec<f64>>());
        rows.filter(|row| !row.is_empty()).reduce(|best, row| {
            let is_larger = row[0] > best[0] || (row[0] == best[0] && row[1] < best[1]);
            if is_larger { row } else { best }
        })
    }
}

fn length(v: Vector) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Equivalent stress of von Mises, of components in the order of the particles.
fn mises([xx, yy, zz, yz, xz, xy]: [f64; 6]) -> f64 {
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    let shear = yz * yz + xz * xz + xy * xy;
    (0.5 * normal + 3.0 * shear).sqrt()
}

/// Set and identifier of the particle that is nearest to a position at the start.
fn nearest(simulation: &Simulation, position: &Vector) -> Option<(usize, u64)> {
    let mut best: Option<(f64, u64, usize)> = None;
    for (s, set) in simulation.sets().iter().enumerate() {
        for p in simulation.own_particles(set).iter() {
            let x = simulation
                .initial_position(s, p)
                .unwrap_or_else(|| simulation.position(s, p));
            let square: f64 = (0..simulation.plan().axes)
                .map(|axis| (x[axis] - position[axis]).powi(2))
                .sum();
            // Of equally near particles the one with the smallest identifier, whatever their order.
            if best.is_none_or(|(d, id, _)| (square, set.id[p]) < (d, id)) {
                best = Some((square, set.id[p], s));
            }
        }
    }
    if let Some(ranks) = simulation.ranks() {
        let words = best.map(|(square, id, set)| vec![square.to_bits(), id, set as u64]);
        for words in ranks.all_gather(&words.unwrap_or_default()) {
            let &[square, id, set] = words.as_slice() else {
                continue;
            };
            let one = (f64::from_bits(square), id, set as usize);
            if best.is_none_or(|(d, id, _)| (one.0, one.1) < (d, id)) {
                best = Some(one);
            }
        }
    }
    best.map(|(_, id, set)| (set, id))
}
