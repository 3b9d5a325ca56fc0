//! An elastic block on an incline by finite elements: what such a block does under Coulomb friction, whatever the method.
//!
//! No closed form: an independent computation, with nothing in common with the material point method but the equations.
//! Linear elasticity in plane strain, bilinear elements with 2 x 2 points, lumped masses, explicit leapfrog; nodes of the
//! base meet a rigid plane and rub on it. A rigid block sticks for mu >= tan(theta). An elastic one that is released at
//! once swings, slides at the turns of the swing, and may walk: sliding is unstable for mu > 1 (a mode of speed
//! sqrt(2) `c_s` grows on a half-space; Martins, Guimaraes and Faria 1995, Adams 1995), and in a block of finite length,
//! which rocks, at smaller friction too.

/// A block of plane strain with square elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticBlock {
    /// Length along the incline and height, in elements.
    pub elements: [usize; 2],
    /// Edge of an element \[m\].
    pub edge: f64,
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density \[kg/m³\].
    pub density: f64,
}

/// Release of a block that has settled without friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// Gravity along the incline and into it \[m/s²\].
    pub gravity: [f64; 2],
    /// Coefficient of friction.
    pub friction: f64,
    /// Local damping, as a share of the unbalanced force.
    pub damping: f64,
    /// Time over which gravity along the incline grows first, with [`SETTLING_DAMPING`] \[s\]; 0 for a release at once.
    pub tilting: f64,
    /// Time from the release to the end \[s\].
    pub time: f64,
}

/// Motion of the block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slid {
    /// Displacement of the centre of mass along the incline since friction began \[m\].
    pub way: f64,
    /// Its mean velocity over the second half of the time since the release \[m/s\].
    pub creep: f64,
}

/// Local damping before the release.
pub const SETTLING_DAMPING: f64 = 0.6;
/// Periods of vertical motion for which a block settles.
const SETTLING_PERIODS: f64 = 8.0;
/// `c dt/h`.
const COURANT: f64 = 0.5;

/// The state of a run.
struct Run {
    width: usize,
    /// Stiffness of an element, by degrees of freedom.
    stiffness: [[f64; 8]; 8],
    mass: Vec<f64>,
    displacement: Vec<[f64; 2]>,
    velocity: Vec<[f64; 2]>,
    dt: f64,
}

impl ElasticBlock {
    /// Lets the block settle under the gravity into the incline, then releases it.
    #[must_use]
    pub fn slide(&self, release: &Release) -> Slid {
        let mut run = self.start();
        let [along, into] = release.gravity;
        let height = self.elements[1] as f64 * self.edge;
        let settling = SETTLING_PERIODS * 4.0 * height / (self.young / self.density).sqrt();
        run.advance(settling, |_| [0.0, into], 0.0, SETTLING_DAMPING);
        let start = run.center();
        if release.tilting > 0.0 {
            let gravity = |t: f64| [along * (t / release.tilting).min(1.0), into];
            run.advance(release.tilting, gravity, release.friction, SETTLING_DAMPING);
        }
        let half = 0.5 * release.time;
        let mut at = [0.0; 2];
        for at in &mut at {
            run.advance(half, |_| release.gravity, release.friction, release.damping);
            *at = run.center();
        }
        Slid {
            way: at[1] - start,
            creep: (at[1] - at[0]) / half,
        }
    }

    fn start(&self) -> Run {
        let [nx, ny] = self.elements;
        let count = (nx + 1) * (ny + 1);
        let mut mass = vec![0.0; count];
        for element in 0..nx * ny {
            for node in corners(element, nx) {
                mass[node] += 0.25 * self.density * self.edge * self.edge;
            }
        }
        let stiff =
            self.young * (1.0 - self.poisson) / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson));
        Run {
            width: nx,
            stiffness: self.stiffness(),
            mass,
            displacement: vec![[0.0; 2]; count],
            velocity: vec![[0.0; 2]; count],
            dt: COURANT * self.edge / (stiff / self.density).sqrt(),
        }
    }

    /// Integral of B^T D B over an element; in plane strain it does not depend on the edge.
    fn stiffness(&self) -> [[f64; 8]; 8] {
        let shear = self.young / (2.0 * (1.0 + self.poisson));
        let lame = self.young * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson));
        let at = 1.0 / 3.0_f64.sqrt();
        let mut k = [[0.0; 8]; 8];
        for (a, b) in [(-at, -at), (at, -at), (at, at), (-at, at)] {
            // Gradients of the shape functions times the edge.
            let gradient: [[f64; 2]; 4] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(x, y)| [0.5 * x * (1.0 + y * b), 0.5 * y * (1.0 + x * a)]);
            for i in 0..8 {
                for j in 0..8 {
                    let (p, q) = (gradient[i / 2], gradient[j / 2]);
                    let (c, d) = (i % 2, j % 2);
                    let same = if c == d {
                        p[0] * q[0] + p[1] * q[1]
                    } else {
                        0.0
                    };
                    k[i][j] += 0.25 * (lame * p[c] * q[d] + shear * (p[d] * q[c] + same));
                }
            }
        }
        k
    }
}

/// Nodes of an element, round about.
fn corners(element: usize, width: usize) -> [usize; 4] {
    let low = element / width * (width + 1) + element % width;
    [low, low + 1, low + width + 2, low + width + 1]
}

impl Run {
    /// Steps for a time (s); `gravity` by the time since the call.
    fn advance(
        &mut self,
        time: f64,
        gravity: impl Fn(f64) -> [f64; 2],
        friction: f64,
        damping: f64,
    ) {
        let steps = (time / self.dt).ceil().max(1.0);
        let dt = time / steps;
        for step in 0..steps as usize {
            let [along, into] = gravity(step as f64 * dt);
            let force = self.internal_force();
            for (node, force) in force.iter().enumerate() {
                let m = self.mass[node];
                let free = [force[0] / m + along, force[1] / m - into];
                let before = self.velocity[node];
                // Contact is a part of what is damped: found without damping first.
                let touched = self.touch(node, before, free, friction, dt);
                let damped = std::array::from_fn(|k| {
                    let unbalanced = (touched[k] - before[k]) / dt;
                    let sign = if before[k] == 0.0 {
                        0.0
                    } else {
                        before[k].signum()
                    };
                    free[k] - damping * unbalanced.abs() * sign
                });
                self.velocity[node] = self.touch(node, before, damped, friction, dt);
            }
            for (u, v) in self.displacement.iter_mut().zip(&self.velocity) {
                *u = [u[0] + dt * v[0], u[1] + dt * v[1]];
            }
        }
    }

    /// Velocity after a step with an acceleration, on the plane without approach and with friction.
    fn touch(
        &self,
        node: usize,
        before: [f64; 2],
        acceleration: [f64; 2],
        friction: f64,
        dt: f64,
    ) -> [f64; 2] {
        let v = [0, 1].map(|k| before[k] + dt * acceleration[k]);
        let base = node <= self.width;
        if !base || self.displacement[node][1] > 1e-12 || v[1] >= 0.0 {
            return v;
        }
        let most = -friction * v[1];
        [v[0] - v[0].clamp(-most, most), 0.0]
    }

    fn internal_force(&self) -> Vec<[f64; 2]> {
        let mut force = vec![[0.0; 2]; self.mass.len()];
        let rows = self.mass.len() / (self.width + 1) - 1;
        for element in 0..self.width * rows {
            let nodes = corners(element, self.width);
            let u: [f64; 8] = std::array::from_fn(|i| self.displacement[nodes[i / 2]][i % 2]);
            for (i, row) in self.stiffness.iter().enumerate() {
                force[nodes[i / 2]][i % 2] -= row.iter().zip(&u).map(|(k, u)| k * u).sum::<f64>();
            }
        }
        force
    }

    /// Displacement of the centre of mass along the incline \[m\].
    fn center(&self) -> f64 {
        let moment: f64 = self
            .mass
            .iter()
            .zip(&self.displacement)
            .map(|(m, u)| m * u[0])
            .sum();
        moment / self.mass.iter().sum::<f64>()
    }
}
