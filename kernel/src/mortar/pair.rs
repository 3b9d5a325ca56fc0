//! Contact of one pair of boundaries: weighted gaps, pressures, friction, and the forces on the vertices of both.

use super::elements::Elements;
use super::law::{Friction, NormalLaw};
use super::points::{Detection, Search};
use super::{Point, PointIn, cross};
use std::array;

/// How a pair behaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairLaw {
    /// Pressure against gap.
    pub normal: NormalLaw,
    /// Friction; `None` for smooth surfaces.
    pub friction: Option<Friction>,
    /// How contact is found.
    pub detection: Detection,
    /// Where the master is looked for.
    pub search: Search,
}

/// Elastic slip of each vertex of the slave along its T tangents \[m\], kept from step to step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slip<const T: usize>(pub Vec<[f64; T]>);

/// Contact at a vertex of the slave that faces the master.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexContact<const D: usize, const T: usize> {
    /// Weighted gap (eq. 46) \[m\].
    pub gap: f64,
    /// Outward normal of the slave.
    pub normal: PointIn<D>,
    /// Contact pressure lambda_n \[Pa\].
    pub pressure: f64,
    /// Tangential traction lambda_tau \[Pa\] along the tangents of the vertex, in the plane the normal turned by
    /// +90 degrees; positive where the slave slips in that direction, and then it is pushed back.
    pub traction: [f64; T],
    /// Length, in space area, of the slave that belongs to the vertex: the row sum of D \[m, in space m²\].
    pub measure: f64,
    /// By how much slave and master came closer in the last step \[m\].
    pub approach: f64,
    /// Speed at which they come closer now \[m/s\].
    pub closing: f64,
}

/// What contact does to a pair in one step. In the plane all is per metre of thickness: forces in N/m, and so on.
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
    /// Contact at each vertex of the slave, where it faces the master.
    pub vertices: Vec<Option<VertexContact<D, T>>>,
    /// Energy stored in the normal law \[J\].
    pub energy: f64,
}

impl<const D: usize, const T: usize> PairForces<D, T> {
    /// The smallest gap with its vertex \[m\]; `None` where nothing faces anything.
    #[must_use]
    pub fn smallest_gap(&self) -> Option<(usize, f64)> {
        self.vertices
            .iter()
            .enumerate()
            .filter_map(|(k, v)| v.as_ref().map(|v| (k, v.gap)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The two boundaries, how their vertices moved in the last step \[m\] and move now \[m/s\].
#[derive(Debug)]
pub struct Surfaces<'a, B, const D: usize> {
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
}

// By hand, since a boundary need not be.
impl<B, const D: usize> Clone for Surfaces<'_, B, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B, const D: usize> Copy for Surfaces<'_, B, D> {}

/// Gap, pressure and friction at the slave's vertices (eq. 40, 46, 48, 50, 51) and the forces f_s = -D lambda and
/// f_m = M^T lambda (eq. 54, 55).
///
/// The slip of a vertex is forgotten where there is no pressure.
#[must_use]
pub fn contact_forces<const D: usize, const T: usize, B: Elements<D, T>>(
    surfaces: Surfaces<'_, B, D>,
    law: &PairLaw,
    slip: &mut Slip<T>,
) -> PairForces<D, T> {
    let Surfaces { slave, master, .. } = surfaces;
    let count = slave.points().len();
    slip.0.resize(count, [0.0; T]);
    let normals = slave.normals();
    let points = slave.facing(&normals, master, law.detection, law.search);

    // Rows of D and of the differences that the rows of D and M give.
    let mut measure = vec![0.0; count];
    let mut apart = vec![PointIn::zeros(); count];
    let mut moved = vec![PointIn::zeros(); count];
    let mut speed = vec![PointIn::zeros(); count];
    for point in &points {
        let distance = point.on_master(master.points()) - point.on_slave(slave.points());
        let relative =
            point.on_slave(surfaces.slave_moved) - point.on_master(surfaces.master_moved);
        let velocity =
            point.on_slave(surfaces.slave_velocity) - point.on_master(surfaces.master_velocity);
        for (k, share) in point.slave {
            let w = share * point.weight;
            measure[k] += w;
            apart[k] += w * distance;
            moved[k] += w * relative;
            speed[k] += w * velocity;
        }
    }

    let mut forces = PairForces {
        slave: vec![PointIn::zeros(); count],
        master: vec![PointIn::zeros(); master.points().len()],
        slave_stiffness: vec![0.0; count],
        master_stiffness: vec![0.0; master.points().len()],
        vertices: vec![None; count],
        energy: 0.0,
    };
    let mut lambda = vec![PointIn::zeros(); count];
    let mut slope = vec![0.0; count];
    for k in 0..count {
        if measure[k] <= 0.0 {
            slip.0[k] = [0.0; T];
            continue;
        }
        let n = normals[k];
        let tangents = slave.tangents(k, &n);
        let gap = n.dot(&apart[k]) / measure[k];
        let relative = moved[k] / measure[k];
        let pressure = law.normal.pressure(gap);
        slope[k] = law.normal.slope(gap);
        let mut traction = [0.0; T];
        match &law.friction {
            Some(friction) if pressure > 0.0 => {
                let trial = array::from_fn(|t| slip.0[k][t] + tangents[t].dot(&relative));
                (traction, slip.0[k]) = friction.traction(trial, pressure);
                // Normal and tangential springs act at right angles, so the stiffer of them rules the time step.
                slope[k] = slope[k].max(friction.stiffness);
            }
            _ => slip.0[k] = [0.0; T],
        }
        lambda[k] = tangents
            .iter()
            .zip(traction)
            .fold(pressure * n, |sum, (tangent, t)| sum + t * tangent);
        forces.energy += measure[k] * law.normal.energy(gap);
        forces.vertices[k] = Some(VertexContact {
            gap,
            normal: n,
            pressure,
            traction,
            measure: measure[k],
            approach: n.dot(&relative),
            closing: n.dot(&speed[k]) / measure[k],
        });
    }

    for point in &points {
        let traction = point.weight * point.on_slave(&lambda);
        let stiffness = point.weight
            * point
                .slave
                .iter()
                .map(|(k, share)| share * slope[*k])
                .sum::<f64>();
        for (k, share) in point.slave {
            forces.slave[k] -= share * traction;
            forces.slave_stiffness[k] += share * stiffness;
        }
        for (k, share) in point.master {
            forces.master[k] += share * traction;
            forces.master_stiffness[k] += share * stiffness;
        }
    }
    forces
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
