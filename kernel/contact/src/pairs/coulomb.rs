//! Contact at one node: impenetrability and Coulomb friction.
//!
//! With trial velocities v_M and v_S, normal n from master to slave and the manual's contact force
//! f_c = (m_M p_S - m_S p_M) / ((m_M + m_S) dt) on the master (eq. 7, see the errata), contact acts where
//! (v_M - v_S) . n > 0 (eq. 1); its normal part is f_n = (f_c . n) n (eq. 5), its tangential part that of f_c, at most
//! mu |f_n| (eq. 6). The slave gets the opposite of the same number.
//!
//! Three and more bodies: all pairs take their impulse from the same velocities, at once, scaled by the largest number
//! of pairs that one body has here, and sweep until none changes. An accumulated impulse keeps to its cone
//! (0 <= J_n, |J_t| <= mu J_n) in every sweep, so contact never pulls. Since no pair comes before another the result
//! does not depend on their order, but for round-off of sums; those are formed in the order given.

use proctor_kernel::model::Vector;

/// Largest number of sweeps. Two bodies need one; more need about as many as their ratio of masses where a light body is
/// squeezed between heavy ones. What then remains of the approach is left to the next step.
const MOST_SWEEPS: usize = 2000;
/// Change of velocity, as a share of the fastest approach, below which a sweep changes nothing.
const SMALLEST_CHANGE: f64 = 1e-15;

/// Share of an impulse below which its normal part is round-off of the tangential one.
const ROUND_OFF: f64 = 1e-14;

/// A velocity field at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Mass \[kg\]; infinite where the velocity is prescribed.
    pub mass: f64,
    /// Velocity \[m/s\].
    pub velocity: Vector,
    /// Increment of the velocity in this step \[m/s\].
    pub increment: Vector,
}

impl Member {
    fn add(&mut self, axis: usize, change: f64) {
        self.velocity[axis] += change;
        self.increment[axis] += change;
    }
}

/// Sign of the velocity before the step, against which local damping acts, where it does.
fn direction(member: &Member, axis: usize) -> Option<f64> {
    let before = member.velocity[axis] - member.increment[axis];
    (member.mass.is_finite() && before != 0.0).then_some(before.signum())
}

/// Two fields that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldTouch {
    /// Index of the master among the fields.
    pub master: usize,
    /// Index of the slave.
    pub slave: usize,
    /// Unit normal from master to slave.
    pub normal: Vector,
    /// The motions that they may take.
    pub law: FrictionLaw,
}

/// The motions of two fields that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionLaw {
    /// Part, slide and stick: Coulomb friction with this coefficient.
    Coulomb(f64),
    /// Slide, but neither approach nor part.
    Slide,
    /// Nothing: they share their velocity.
    Stick,
}

/// The groups that touch.
#[derive(Clone, Copy, Debug)]
struct TouchEnds {
    master: usize,
    slave: usize,
    /// Change of their relative velocity for an impulse of one, over the smallest mass; zero where nothing can change it.
    weight: f64,
}

/// Resolves contact at one node after the other, with the memory for it.
#[derive(Clone, Debug, Default)]
pub struct Coulomb {
    /// Group of each field: the smallest index among the fields that share its velocity.
    group: Vec<usize>,
    /// Mass and velocity of each group, and smallest mass over mass.
    mass: Vec<f64>,
    trial: Vec<Vector>,
    increment: Vec<Vector>,
    velocity: Vec<Vector>,
    inverse: Vec<f64>,
    /// Groups of each touch.
    ends: Vec<TouchEnds>,
    /// Impulse of each touch over the smallest mass \[m/s\].
    impulse: Vec<Vector>,
    change: Vec<Vector>,
    /// Fields as they are damped without contact, and with that damping taken back.
    damped: Vec<Member>,
    free: Vec<Member>,
}

impl Coulomb {
    /// Joins the fields `i`, `j` for which `joined(i, j)`, then lets the groups touch. Joined fields get the velocity
    /// and the increment that they would have in one field; contact changes both alike. Changes the fields, and writes the impulse on the slave of each touch \[N s\] to `impulses`.
    pub fn resolve(
        &mut self,
        members: &mut [Member],
        joined: impl Fn(usize, usize) -> bool,
        touches: &[FieldTouch],
        impulses: &mut Vec<Vector>,
    ) {
        self.join(members, joined);
        let smallest = self.mass.iter().copied().fold(f64::INFINITY, f64::min);
        self.inverse.clear();
        self.inverse.extend(self.mass.iter().map(
            |m| {
                if m.is_infinite() { 0.0 } else { smallest / m }
            },
        ));
        self.sweep(touches);
        for (member, &group) in members.iter_mut().zip(&self.group) {
            let (after, trial) = (self.velocity[group], self.trial[group]);
            member.velocity = after;
            for axis in 0..3 {
                member.increment[axis] = self.increment[group][axis] + (after[axis] - trial[axis]);
            }
        }
        impulses.clear();
        // Where every velocity is prescribed there is nothing to push.
        let unit = if smallest.is_finite() { smallest } else { 0.0 };
        impulses.extend(self.impulse.iter().map(|j| j.map(|c| c * unit)));
    }

    /// Local damping resists by `alpha` times the unbalanced force, and contact is a part of what balances: damped
    /// without it, a body at rest would be carried by its damping, by a share alpha of its weight. So the damping in the
    /// trial velocities is taken back, contact found, and what then is unbalanced damped. Changes the fields to those
    /// trial velocities and returns `true`; `false`, and nothing changed, where no contact acts.
    pub fn damp_again(
        &mut self,
        members: &mut [Member],
        joined: impl Fn(usize, usize) -> bool,
        touches: &[FieldTouch],
        alpha: f64,
        impulses: &mut Vec<Vector>,
    ) -> bool {
        let (mut damped, mut free) = (
            std::mem::take(&mut self.damped),
            std::mem::take(&mut self.free),
        );
        damped.clear();
        damped.extend_from_slice(members);
        for member in &mut *members {
            for axis in 0..3 {
                let dv = member.increment[axis];
                if let Some(direction) = direction(member, axis) {
                    let kept = 1.0 - alpha * direction * dv.signum();
                    // A factor of 1 took everything; then there is nothing to give back.
                    if kept > 0.0 {
                        member.add(axis, dv / kept - dv);
                    }
                }
            }
        }
        free.clear();
        free.extend_from_slice(members);
        self.resolve(members, joined, touches, impulses);
        let acts = impulses.iter().any(|j| *j != [0.0; 3]);
        for ((member, free), damped) in members.iter_mut().zip(&free).zip(&damped) {
            if !acts {
                *member = *damped;
                continue;
            }
            let unbalanced = member.increment;
            *member = *free;
            for axis in 0..3 {
                if let Some(direction) = direction(damped, axis) {
                    member.add(axis, -alpha * direction * unbalanced[axis].abs());
                }
            }
        }
        (self.damped, self.free) = (damped, free);
        acts
    }

    /// Groups with their mass and velocity. A prescribed velocity is that of its group; of two the later decides.
    fn join(&mut self, members: &[Member], joined: impl Fn(usize, usize) -> bool) {
        let n = members.len();
        self.group.clear();
        self.group.extend(0..n);
        for i in 0..n {
            for j in i + 1..n {
                let (a, b) = (self.group[i], self.group[j]);
                if a != b && joined(i, j) {
                    let (low, high) = (a.min(b), a.max(b));
                    for group in &mut self.group {
                        if *group == high {
                            *group = low;
                        }
                    }
                }
            }
        }
        self.mass.clear();
        self.mass.resize(n, 0.0);
        self.trial.clear();
        self.trial.resize(n, [0.0; 3]);
        self.increment.clear();
        self.increment.resize(n, [0.0; 3]);
        for group in 0..n {
            let own = || {
                members
                    .iter()
                    .zip(&self.group)
                    .filter(|(_, g)| **g == group)
                    .map(|(m, _)| m)
            };
            let mass: f64 = own().map(|m| m.mass).sum();
            self.mass[group] = if own().next().is_none() {
                f64::INFINITY
            } else {
                mass
            };
            let mean = |of: fn(&Member) -> &Vector| -> Vector {
                if mass.is_infinite() {
                    own()
                        .rfind(|m| m.mass.is_infinite())
                        .map_or([0.0; 3], |m| *of(m))
                } else if own().count() == 1 {
                    // A field that is alone keeps its bits.
                    *of(&members[group])
                } else {
                    std::array::from_fn(|axis| {
                        own().map(|m| m.mass * of(m)[axis]).sum::<f64>() / mass
                    })
                }
            };
            self.trial[group] = mean(|m| &m.velocity);
            self.increment[group] = mean(|m| &m.increment);
        }
    }

    /// Iterates the impulses of all touches.
    fn sweep(&mut self, touches: &[FieldTouch]) {
        let (group, inverse) = (&self.group, &self.inverse);
        self.ends.clear();
        self.ends.extend(touches.iter().map(|touch| {
            let [master, slave] = [group[touch.master], group[touch.slave]];
            let weight = if master == slave {
                0.0
            } else {
                inverse[master] + inverse[slave]
            };
            TouchEnds {
                master,
                slave,
                weight,
            }
        }));
        self.velocity.clone_from(&self.trial);
        self.impulse.clear();
        self.impulse.resize(touches.len(), [0.0; 3]);
        self.change.clear();
        self.change.resize(touches.len(), [0.0; 3]);
        let apart = || self.ends.iter().filter(|ends| ends.master != ends.slave);
        let of_group = |group: usize| {
            let own = apart().filter(|ends| ends.master == group || ends.slave == group);
            own.count()
        };
        let most = (0..self.group.len()).map(of_group).max().unwrap_or(0);
        if most == 0 {
            return;
        }
        let share = 1.0 / most as f64;
        let mut scale = 0.0_f64;
        for sweep in 0..MOST_SWEEPS {
            let mut largest = 0.0_f64;
            let sought = self.impulse.iter_mut().zip(&mut self.change);
            for ((touch, ends), (impulse, change)) in touches.iter().zip(&self.ends).zip(sought) {
                let weight = ends.weight;
                if weight == 0.0 {
                    continue;
                }
                let (master, slave) = (&self.velocity[ends.master], &self.velocity[ends.slave]);
                let approach: Vector = std::array::from_fn(|k| master[k] - slave[k]);
                if sweep == 0 {
                    scale = scale.max(length(&approach));
                }
                let wanted = std::array::from_fn(|k| impulse[k] + share * approach[k] / weight);
                let next = admitted(&wanted, touch);
                *change = std::array::from_fn(|k| next[k] - impulse[k]);
                largest = largest.max(weight * length(change));
                *impulse = next;
            }
            if most == 1 {
                break;
            }
            self.apply();
            if largest <= SMALLEST_CHANGE * scale {
                break;
            }
        }
        // Once more from the whole impulses, so that the round-off of many sweeps does not add up.
        self.velocity.clone_from(&self.trial);
        self.change.clone_from(&self.impulse);
        self.apply();
    }

    /// Adds the changes of the impulses to the velocities.
    fn apply(&mut self) {
        for (ends, change) in self.ends.iter().zip(&self.change) {
            if *change == [0.0; 3] {
                continue;
            }
            let [of_master, of_slave] = [ends.master, ends.slave].map(|group| self.inverse[group]);
            for k in 0..3 {
                self.velocity[ends.master][k] -= of_master * change[k];
                self.velocity[ends.slave][k] += of_slave * change[k];
            }
        }
    }
}

/// The nearest impulse that the law of a touch admits. Coulomb: the normal part is not negative and the tangential one
/// at most friction times that.
fn admitted(impulse: &Vector, touch: &FieldTouch) -> Vector {
    let normal = &touch.normal;
    let along: f64 = (0..3).map(|k| impulse[k] * normal[k]).sum();
    let friction = match touch.law {
        FrictionLaw::Coulomb(friction) => friction,
        FrictionLaw::Slide => return normal.map(|n| along * n),
        FrictionLaw::Stick => return *impulse,
    };
    if along <= ROUND_OFF * length(impulse) {
        return [0.0; 3];
    }
    let tangential: Vector = std::array::from_fn(|k| impulse[k] - along * normal[k]);
    let size = length(&tangential);
    let most = friction * along;
    let share = if size <= most { 1.0 } else { most / size };
    std::array::from_fn(|k| along * normal[k] + share * tangential[k])
}

fn length(v: &Vector) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}
