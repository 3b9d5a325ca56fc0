//! Contact of one pair of boundaries: weighted gaps, pressures, friction, and the forces on the vertices of both.

use super::elements::Elements;
use super::law::{Friction, NormalLaw};
use super::points::{Detection, MasterSearch, MortarPoints};
use super::{Point, PointIn, cross};
use proctor_geometry::team::Team;
use std::array;

/// Behaviour of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairLaw {
    /// Pressure against gap.
    pub normal: NormalLaw,
    /// Friction; `None` for smooth surfaces.
    pub friction: Option<Friction>,
    /// Detection of contact.
    pub detection: Detection,
    /// Search of the master.
    pub search: MasterSearch,
}

/// Elastic slip of each site of the slave along its T tangents \[m\], kept from step to step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slip<const T: usize>(pub Vec<[f64; T]>);

/// Contact at a site of the slave that faces the master.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexContact<const D: usize, const T: usize> {
    /// The vertex that it is at.
    pub vertex: usize,
    /// Weighted gap (eq. 46) \[m\].
    pub gap: f64,
    /// Outward normal of the slave.
    pub normal: PointIn<D>,
    /// Contact pressure lambda_n \[Pa\].
    pub pressure: f64,
    /// Tangential traction lambda_tau \[Pa\] along the tangents of the site, in the plane the normal turned by
    /// +90 degrees; positive where the slave slips in that direction, and then it is pushed back.
    pub traction: [f64; T],
    /// Length, in space area, of the slave that belongs to the site: the row sum of D \[m, in space m²\].
    pub measure: f64,
    /// Approach of slave and master in the last step \[m\].
    pub approach: f64,
    /// Speed at which they come closer now \[m/s\].
    pub closing: f64,
}

/// Forces of contact on a pair in one step. In the plane all is per metre of thickness: forces in N/m, and so on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairForces<const D: usize, const T: usize> {
    /// Force on each vertex of the slave \[N\].
    pub slave: Vec<PointIn<D>>,
    /// Force on each vertex of the master \[N\].
    pub master: Vec<PointIn<D>>,
    /// Stiffness of the contact at each vertex of the slave, sum w N slope \[N/m\], for the time step.
    pub slave_stiffness: Vec<f64>,
    /// The same for the master.
    pub master_stiffness: Vec<f64>,
    /// Contact at each site of the slave, where it faces the master.
    pub sites: Vec<Option<VertexContact<D, T>>>,
    /// Energy stored in the normal law \[J\].
    pub energy: f64,
}

impl<const D: usize, const T: usize> PairForces<D, T> {
    /// Nothing acts, on so many vertices of slave and master and sites of the slave.
    pub fn clear(&mut self, slave: usize, master: usize, sites: usize) {
        let zero = |forces: &mut Vec<PointIn<D>>, stiffness: &mut Vec<f64>, count: usize| {
            forces.clear();
            forces.resize(count, PointIn::zeros());
            stiffness.clear();
            stiffness.resize(count, 0.0);
        };
        zero(&mut self.slave, &mut self.slave_stiffness, slave);
        zero(&mut self.master, &mut self.master_stiffness, master);
        self.sites.clear();
        self.sites.resize(sites, None);
        self.energy = 0.0;
    }

    /// The smallest gap with its vertex \[m\]; `None` where nothing faces anything.
    #[must_use]
    pub fn smallest_gap(&self) -> Option<(usize, f64)> {
        self.sites
            .iter()
            .flatten()
            .map(|site| (site.vertex, site.gap))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The two boundaries, how their vertices moved in the last step \[m\] and move now \[m/s\].
#[derive(Debug)]
pub struct PairSurfaces<'a, B, const D: usize> {
    /// Slave: normals, gaps and pressures are its own.
    pub slave: &'a B,
    /// Master.
    pub master: &'a B,
    /// Displacement of the slave's vertices.
    pub slave_moved: &'a [PointIn<D>],
    /// Displacement of the master's vertices.
    pub master_moved: &'a [PointIn<D>],
    /// Velocity of the slave's vertices.
    pub slave_velocity: &'a [PointIn<D>],
    /// Velocity of the master's vertices.
    pub master_velocity: &'a [PointIn<D>],
    /// The motion until forces act again; `None` to look at the present state alone.
    pub ahead: Option<StepAhead<'a, D>>,
}

/// The longest next step. Where a gap would close in it, its stiffness counts already: a long free step would leave
/// surfaces deep in each other that no force has stopped, and one kick over half of it would throw them apart.
#[derive(Clone, Copy, Debug)]
pub struct StepAhead<'a, const D: usize> {
    /// Its length \[s\].
    pub time: f64,
    /// Change of the velocity of the slave's vertices at its beginning where nothing touches them \[m/s\].
    pub slave_kick: &'a [PointIn<D>],
    /// The same of the master's vertices.
    pub master_kick: &'a [PointIn<D>],
}

// By hand, since a boundary need not be.
impl<B, const D: usize> Clone for PairSurfaces<'_, B, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B, const D: usize> Copy for PairSurfaces<'_, B, D> {}

/// Sums over the points of one site of the slave.
#[derive(Clone, Copy, Debug)]
struct SiteSums<const D: usize> {
    /// Row sum of D \[m, in space m²\].
    measure: f64,
    /// Differences that the rows of D and M give: place, displacement, velocity and its change in the longest next step.
    apart: PointIn<D>,
    moved: PointIn<D>,
    speed: PointIn<D>,
    kick: PointIn<D>,
    /// Traction on the slave with the sign turned \[Pa\], and slope of the law \[Pa/m\].
    lambda: PointIn<D>,
    slope: f64,
}

impl<const D: usize> SiteSums<D> {
    fn empty() -> Self {
        let zero = PointIn::zeros();
        Self {
            measure: 0.0,
            apart: zero,
            moved: zero,
            speed: zero,
            kick: zero,
            lambda: zero,
            slope: 0.0,
        }
    }
}

/// Work arrays for the forces of a pair; kept from step to step for its memory alone.
#[derive(Clone, Debug, Default)]
pub struct Workspace<const D: usize> {
    found: MortarPoints<D>,
    normals: Vec<PointIn<D>>,
    rows: Vec<SiteSums<D>>,
}

/// [`contact_forces_to`] with memory of its own.
#[must_use]
pub fn contact_forces<const D: usize, const T: usize, B: Elements<D, T>>(
    surfaces: PairSurfaces<'_, B, D>,
    law: &PairLaw,
    slip: &mut Slip<T>,
) -> PairForces<D, T> {
    let mut forces = PairForces::default();
    contact_forces_to(
        &mut forces,
        surfaces,
        law,
        slip,
        &mut Workspace::default(),
        &Team::ALONE,
    );
    forces
}

/// Gap, pressure and friction at the slave's sites (eq. 40, 46, 48, 50, 51) and the forces f_s = -D lambda and
/// f_m = M^T lambda (eq. 54, 55).
///
/// The threads of `team` share the search and what is found at each point; sums are formed by one, in the order of the
/// points. The slip of a site is forgotten where there is no pressure.
pub fn contact_forces_to<const D: usize, const T: usize, B: Elements<D, T>>(
    forces: &mut PairForces<D, T>,
    surfaces: PairSurfaces<'_, B, D>,
    law: &PairLaw,
    slip: &mut Slip<T>,
    work: &mut Workspace<D>,
    team: &Team,
) {
    let PairSurfaces { slave, master, .. } = surfaces;
    let vertices = slave.sites().vertices();
    let count = vertices.len();
    slip.0.resize(count, [0.0; T]);
    let Workspace {
        found,
        normals,
        rows,
    } = work;
    slave.normals_to(normals);
    found.find(team, slave, normals, master, law.detection, law.search);
    found.compare(team, |point| {
        let apart = point.on_master(master.points()) - point.on_slave(slave.points());
        let moved = point.on_slave(surfaces.slave_moved) - point.on_master(surfaces.master_moved);
        let speed =
            point.on_slave(surfaces.slave_velocity) - point.on_master(surfaces.master_velocity);
        let kick = surfaces.ahead.map_or(PointIn::zeros(), |ahead| {
            point.on_slave(ahead.slave_kick) - point.on_master(ahead.master_kick)
        });
        [apart, moved, speed, kick]
    });

    rows.clear();
    rows.resize(count, SiteSums::empty());
    for (point, [apart, moved, speed, kick]) in found.compared() {
        for (k, (_, share)) in point.sites.into_iter().zip(point.slave) {
            let (row, w) = (&mut rows[k], share * point.weight);
            row.measure += w;
            row.apart += w * apart;
            row.moved += w * moved;
            row.speed += w * speed;
            row.kick += w * kick;
        }
    }

    forces.clear(slave.points().len(), master.points().len(), count);
    for (k, row) in rows.iter_mut().enumerate() {
        let measure = row.measure;
        if measure <= 0.0 {
            slip.0[k] = [0.0; T];
            continue;
        }
        let n = normals[k];
        let tangents = slave.tangents(k, &n);
        let gap = n.dot(&row.apart) / measure;
        let relative = row.moved / measure;
        let pressure = law.normal.pressure(gap);
        let closing = n.dot(&row.speed) / measure;
        // What opens may turn within the step. What is pressed is held by more than the forces without contact.
        let pulled = if pressure > 0.0 {
            0.0
        } else {
            (n.dot(&row.kick) / measure).max(0.0)
        };
        let time = surfaces.ahead.map_or(0.0, |ahead| ahead.time);
        let soon = gap - (closing.abs() + pulled) * time;
        row.slope = law.normal.slope(gap).max(law.normal.slope(soon));
        let mut traction = [0.0; T];
        match &law.friction {
            Some(friction) if pressure > 0.0 => {
                let trial = array::from_fn(|t| slip.0[k][t] + tangents[t].dot(&relative));
                (traction, slip.0[k]) = friction.traction(trial, pressure);
            }
            _ => slip.0[k] = [0.0; T],
        }
        if let Some(friction) = law.friction.filter(|_| row.slope > 0.0) {
            // Normal and tangential springs act at right angles, so the stiffer of them rules the time step.
            row.slope = row.slope.max(friction.stiffness);
        }
        row.lambda = tangents
            .iter()
            .zip(traction)
            .fold(pressure * n, |sum, (tangent, t)| sum + t * tangent);
        forces.energy += measure * law.normal.energy(gap);
        forces.sites[k] = Some(VertexContact {
            vertex: vertices[k],
            gap,
            normal: n,
            pressure,
            traction,
            measure,
            approach: n.dot(&relative),
            closing,
        });
    }

    for point in found.iter() {
        let (mut traction, mut stiffness) = (PointIn::zeros(), 0.0);
        for (k, (_, share)) in point.sites.into_iter().zip(point.slave) {
            traction += point.weight * share * rows[k].lambda;
            stiffness += point.weight * share * rows[k].slope;
        }
        if stiffness == 0.0 {
            continue;
        }
        for (k, share) in point.slave {
            forces.slave[k] -= share * traction;
            forces.slave_stiffness[k] += share * stiffness;
        }
        for (k, share) in point.master {
            forces.master[k] += share * traction;
            forces.master_stiffness[k] += share * stiffness;
        }
    }
}

/// Resultant of forces on vertices \[N/m\], and their moment about a point \[N\].
#[must_use]
pub fn resultant(points: &[Point], forces: &[Point], about: &Point) -> (Point, f64) {
    points
        .iter()
        .zip(forces)
        .fold((Point::zeros(), 0.0), |(sum, moment), (x, f)| {
            (sum + f, moment + cross(&(x - about), f))
        })
}
