//! Contact of one pair of boundaries: weighted gaps, pressures, friction, and the forces on the vertices of both.

use super::boundary::Boundary;
use super::law::{Friction, NormalLaw};
use super::segments::{Detection, Search, mortar_points};
use super::{Point, cross};

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

/// Elastic slip of each vertex of the slave \[m\], kept from step to step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slip(pub Vec<f64>);

/// Contact at a vertex of the slave that faces the master.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexContact {
    /// Weighted gap (eq. 46) \[m\].
    pub gap: f64,
    /// Outward normal of the slave.
    pub normal: Point,
    /// Contact pressure lambda_n \[Pa\].
    pub pressure: f64,
    /// Tangential traction lambda_tau \[Pa\], along the normal turned by +90 degrees; positive where the slave slips in
    /// that direction, and then it is pushed back.
    pub traction: f64,
    /// Length of the slave that belongs to the vertex, the row sum of D \[m\].
    pub length: f64,
    /// By how much slave and master came closer in the last step \[m\].
    pub approach: f64,
    /// Speed at which they come closer now \[m/s\].
    pub closing: f64,
}

/// What contact does to a pair in one step. Forces are per unit of thickness.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairForces {
    /// Force on each vertex of the slave \[N/m\].
    pub slave: Vec<Point>,
    /// Force on each vertex of the master \[N/m\].
    pub master: Vec<Point>,
    /// Stiffness of the contact at each vertex of the slave, sum w N slope \[N/m²\], for the time step.
    pub slave_stiffness: Vec<f64>,
    /// The same for the master.
    pub master_stiffness: Vec<f64>,
    /// Contact at each vertex of the slave, where it faces the master.
    pub vertices: Vec<Option<VertexContact>>,
    /// Energy stored in the normal law \[J/m\].
    pub energy: f64,
}

impl PairForces {
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
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    /// Slave: normals, gaps and pressures are its own.
    pub slave: &'a Boundary,
    /// Master.
    pub master: &'a Boundary,
    /// Displacement of the slave's vertices.
    pub slave_moved: &'a [Point],
    /// Displacement of the master's vertices.
    pub master_moved: &'a [Point],
    /// Velocity of the slave's vertices.
    pub slave_velocity: &'a [Point],
    /// Velocity of the master's vertices.
    pub master_velocity: &'a [Point],
}

/// Gap, pressure and friction at the slave's vertices (eq. 40, 46, 48, 50, 51) and the forces f_s = -D lambda and
/// f_m = M^T lambda (eq. 54, 55).
///
/// The slip of a vertex is forgotten where there is no pressure.
#[must_use]
pub fn contact_forces(surfaces: Surfaces<'_>, law: &PairLaw, slip: &mut Slip) -> PairForces {
    let Surfaces { slave, master, .. } = surfaces;
    let count = slave.points.len();
    slip.0.resize(count, 0.0);
    let normals = slave.normals();
    let points = mortar_points(slave, &normals, master, law.detection, law.search);

    // Rows of D and of the differences that the rows of D and M give.
    let mut length = vec![0.0; count];
    let mut apart = vec![Point::zeros(); count];
    let mut moved = vec![Point::zeros(); count];
    let mut speed = vec![Point::zeros(); count];
    for point in &points {
        let distance = point.on_master(&master.points) - point.on_slave(&slave.points);
        let relative =
            point.on_slave(surfaces.slave_moved) - point.on_master(surfaces.master_moved);
        let velocity =
            point.on_slave(surfaces.slave_velocity) - point.on_master(surfaces.master_velocity);
        for (k, share) in point.slave {
            let w = share * point.weight;
            length[k] += w;
            apart[k] += w * distance;
            moved[k] += w * relative;
            speed[k] += w * velocity;
        }
    }

    let mut forces = PairForces {
        slave: vec![Point::zeros(); count],
        master: vec![Point::zeros(); master.points.len()],
        slave_stiffness: vec![0.0; count],
        master_stiffness: vec![0.0; master.points.len()],
        vertices: vec![None; count],
        energy: 0.0,
    };
    let mut lambda = vec![Point::zeros(); count];
    let mut slope = vec![0.0; count];
    for k in 0..count {
        if length[k] <= 0.0 {
            slip.0[k] = 0.0;
            continue;
        }
        let n = normals[k];
        let tangent = Point::new(-n.y, n.x);
        let gap = n.dot(&apart[k]) / length[k];
        let relative = moved[k] / length[k];
        let pressure = law.normal.pressure(gap);
        slope[k] = law.normal.slope(gap);
        let mut traction = 0.0;
        match &law.friction {
            Some(friction) if pressure > 0.0 => {
                (traction, slip.0[k]) =
                    friction.traction(slip.0[k] + tangent.dot(&relative), pressure);
                // Normal and tangential springs act at right angles, so the stiffer of them rules the time step.
                slope[k] = slope[k].max(friction.stiffness);
            }
            _ => slip.0[k] = 0.0,
        }
        lambda[k] = pressure * n + traction * tangent;
        forces.energy += length[k] * law.normal.energy(gap);
        forces.vertices[k] = Some(VertexContact {
            gap,
            normal: n,
            pressure,
            traction,
            length: length[k],
            approach: n.dot(&relative),
            closing: n.dot(&speed[k]) / length[k],
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
