//! The tests of the manual's `benchmark-configuration.json`: single stages on particles that lie at random in the
//! first cell of the mesh, as MPM-Geomechanics has them.
//!
//! Its program does one thing per pass where ours does several: the four nodal sums are one pass (`p2g`), and strain,
//! spin, density and stress are one pass (`g2p`). Each test is the pass that does its work, on the state that its
//! section asks for.

use super::check::Check;
use super::raw::RawConfig;
use oorandom::Rand64;
use proctor_laws::LinearElastic;
use proctor_scene::simulation::{InitialField, InitialState, Part};
use proctor_scene::{
    Body, BoxLoad, Dimension, InitialStress, Material, Mesh, ParticleSeed, Scene, Shape, TimeStep,
    Vector,
};
use std::sync::Arc;

/// Default number of particles, that of the manual's program.
pub(super) const PARTICLES: usize = 150_000;

/// Settings that all tests share.
#[derive(Clone, Debug, PartialEq)]
struct Global {
    size: Vector,
    mass: f64,
    cell: Vector,
    cells: [usize; 3],
    seed: u64,
}

/// State of the particles at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// One velocity \[m/s\].
    Uniform(Vector),
    /// Velocity that grows along each axis \[1/s\].
    Stretching(Vector),
    /// Rotation about the origin \[1/s\].
    Spinning(Vector),
    /// One stress \[Pa\], the same along all axes.
    Stressed(f64),
}

/// A test of a single stage.
#[derive(Clone, Debug, PartialEq)]
pub struct ManualTest {
    /// Section and name in the configuration.
    pub name: &'static str,
    /// The stage that does its work.
    pub part: Part,
    global: Global,
    state: State,
    dt: f64,
    young: f64,
    poisson: f64,
    density: Option<f64>,
    force: Vector,
}

/// A scene with the state of its particles.
pub struct TestScene {
    /// The scene.
    pub scene: Scene,
    /// The state at the start.
    pub initial: InitialField,
}

/// The tests that the flags of `global` switch on; none without one of the manual's sections.
pub(super) fn tests(check: &mut Check<'_>, raw: &RawConfig, by_manual: bool) -> Vec<ManualTest> {
    if !by_manual {
        return vec![];
    }
    let global = raw.global.as_ref();
    let own = |get: fn(&super::raw::RawGlobal) -> Option<Vec<f64>>| global.and_then(get);
    let shared = Global {
        size: vector(
            check,
            "global.particleSize",
            own(|g| g.particle_size.clone()),
            [1.0; 3],
            true,
        ),
        mass: number(
            check,
            "global.particleMass",
            global.and_then(|g| g.particle_mass),
            1.0,
            true,
        ),
        cell: vector(
            check,
            "global.cellDimension",
            own(|g| g.cell_dimension.clone()),
            [1.0; 3],
            true,
        ),
        cells: cells(check, global.and_then(|g| g.num_cells.clone())),
        seed: check.value("global.randomSeed", global.and_then(|g| g.random_seed), 42),
    };
    let interpolation = raw.interpolation.as_ref();
    let update = raw.update.as_ref();
    let test = |name, part, state| ManualTest {
        name,
        part,
        global: shared.clone(),
        state,
        dt: 0.01,
        young: 1000.0,
        poisson: 0.3,
        density: None,
        force: [0.0; 3],
    };
    let still = State::Uniform([0.0; 3]);
    let mut tests = vec![];
    if check.value(
        "global.interpolationTest",
        global.and_then(|g| g.interpolation_test),
        true,
    ) {
        let momentum = interpolation.and_then(|i| i.nodal_momentum.as_ref());
        let external = interpolation.and_then(|i| i.nodal_external_force.as_ref());
        let strain = interpolation.and_then(|i| i.strain_increment.as_ref());
        let spin = interpolation.and_then(|i| i.vorticity_increment.as_ref());
        let at = "interpolation.";
        let velocity = vector(
            check,
            &format!("{at}NodalMomentum_nParticles.particleVelocity"),
            momentum.and_then(|t| t.particle_velocity.clone()),
            [1.0, 2.0, 3.0],
            false,
        );
        let force = vector(
            check,
            &format!("{at}NodalExternalForce_nParticles.appliedForce"),
            external.and_then(|t| t.applied_force.clone()),
            [1.0, 2.0, 3.0],
            false,
        );
        let stretching = vector(
            check,
            &format!("{at}ParticleStrainIncrement_nParticles.nodalVelocity"),
            strain.and_then(|t| t.nodal_velocity.clone()),
            [1.0, 2.0, 3.0],
            false,
        );
        let spinning = vector(
            check,
            &format!("{at}ParticleVorticityIncrement_nParticles.omega"),
            spin.and_then(|t| t.omega.clone()),
            [1.0, 2.0, 3.0],
            false,
        );
        let dt01 = format!("{at}ParticleStrainIncrement_nParticles.dt01");
        let dt01 = number(check, &dt01, strain.and_then(|t| t.dt01), 0.01, true);
        let dt02 = format!("{at}ParticleVorticityIncrement_nParticles.dt02");
        let dt02 = number(check, &dt02, spin.and_then(|t| t.dt02), 0.01, true);
        let p2g = Part::P2g;
        let g2p = Part::G2p;
        tests.push(test("NodalMass", p2g, still));
        tests.push(test("NodalMomentum", p2g, State::Uniform(velocity)));
        tests.push(test("NodalInternalForce", p2g, State::Stressed(1.0)));
        tests.push(ManualTest {
            force,
            ..test("NodalExternalForce", p2g, still)
        });
        tests.push(ManualTest {
            dt: dt01,
            ..test(
                "ParticleStrainIncrement",
                g2p,
                State::Stretching(stretching),
            )
        });
        tests.push(ManualTest {
            dt: dt02,
            ..test("ParticleVorticityIncrement", g2p, State::Spinning(spinning))
        });
    }
    if check.value(
        "global.updateTest",
        global.and_then(|g| g.update_test),
        true,
    ) {
        let density = update.and_then(|u| u.density.as_ref());
        let stress = update.and_then(|u| u.stress.as_ref());
        let at = "update.UpdatePerformance_ParticleDensity_nParticles";
        let initial = density.and_then(|t| t.initial_density);
        let initial = number(
            check,
            &format!("{at}.initialDensity"),
            initial,
            2000.0,
            true,
        );
        let trace = density.and_then(|t| t.trace_strain);
        let trace = number(check, &format!("{at}.traceStrain"), trace, 0.05, false);
        let at = "update.ParticleStress_nParticles";
        let young = number(
            check,
            &format!("{at}.E"),
            stress.and_then(|t| t.young),
            1000.0,
            true,
        );
        let poisson = number(
            check,
            &format!("{at}.nu"),
            stress.and_then(|t| t.poisson),
            0.3,
            false,
        );
        if !(-1.0..0.5).contains(&poisson) {
            check.add(
                format!("{at}.nu"),
                poisson.to_string(),
                "a number above -1 and below 0.5",
            );
        }
        let epsilon = number(
            check,
            &format!("{at}.epsilon0"),
            stress.and_then(|t| t.strain),
            0.01,
            false,
        );
        tests.push(test("ContributionNodes", Part::Weights, still));
        let dt = 0.01;
        let rate = trace / 3.0 / dt;
        tests.push(ManualTest {
            density: Some(initial),
            ..test("ParticleDensity", Part::G2p, State::Stretching([rate; 3]))
        });
        let along_x = State::Stretching([epsilon / dt, 0.0, 0.0]);
        tests.push(ManualTest {
            young,
            poisson,
            ..test("ParticleStress", Part::G2p, along_x)
        });
    }
    tests
}

fn number(
    check: &mut Check<'_>,
    path: &str,
    given: Option<f64>,
    usual: f64,
    positive: bool,
) -> f64 {
    if let Some(x) = given.filter(|x| positive && *x <= 0.0) {
        check.add(path, x.to_string(), "a number above 0");
    }
    check.value(path, given, usual)
}

fn vector(
    check: &mut Check<'_>,
    path: &str,
    given: Option<Vec<f64>>,
    usual: Vector,
    positive: bool,
) -> Vector {
    let given = check.value(path, given, usual.to_vec());
    let Ok(vector) = Vector::try_from(given.as_slice()) else {
        check.add(path, format!("{} numbers", given.len()), "3 numbers");
        return usual;
    };
    if positive && vector.iter().any(|x| *x <= 0.0) {
        check.add(path, format!("{vector:?}"), "3 numbers above 0");
    }
    vector
}

fn cells(check: &mut Check<'_>, given: Option<Vec<usize>>) -> [usize; 3] {
    let given = check.value("global.numCells", given, vec![1; 3]);
    match <[usize; 3]>::try_from(given.as_slice()) {
        Ok(cells) if cells.iter().all(|&n| n > 0) => cells,
        _ => {
            check.add(
                "global.numCells",
                format!("{given:?}"),
                "3 whole numbers, 1 or more",
            );
            [1; 3]
        }
    }
}

impl ManualTest {
    /// The scene with a number of particles.
    #[must_use]
    pub fn make(&self, particles: usize) -> TestScene {
        let Global {
            size,
            mass,
            cell,
            cells,
            seed,
        } = &self.global;
        let mesh = Mesh::new(Dimension::Three, [0.0; 3], *cell, *cells);
        let extent: Vector = std::array::from_fn(|axis| cells[axis] as f64 * cell[axis]);
        let first_cell = cell.iter().copied().fold(0.0, f64::max);
        let volume: f64 = size.iter().product();
        let mut random = Rand64::new(u128::from(*seed));
        let seeds: Vec<ParticleSeed> = (0..particles)
            .map(|_| ParticleSeed {
                position: std::array::from_fn(|axis| {
                    random.rand_float() * first_cell.min(extent[axis])
                }),
                volume,
            })
            .collect();
        let mut scene = Scene::new(Dimension::Three, mesh, 1.0);
        self.name.clone_into(&mut scene.name);
        scene.time_step = TimeStep::Fixed {
            dt: self.dt,
            // One stage alone cannot become unstable.
            allow_unstable: true,
        };
        scene.results.print = 0;
        scene.materials = vec![Material {
            name: "elastic".into(),
            id: 1,
            density: self.density.unwrap_or(mass / volume),
            law: LinearElastic::new(self.young, self.poisson).into(),
        }];
        scene.bodies = vec![Body {
            name: "particles".into(),
            id: 1,
            material: 0,
            shape: Shape::Particles(Arc::new(seeds)),
            particles_per_cell: [2; 3],
            velocity: [0.0; 3],
            motion: None,
            initial_stress: InitialStress::None,
        }];
        if self.force != [0.0; 3] {
            scene.box_loads = vec![BoxLoad {
                p1: [0.0; 3],
                p2: extent,
                force: self.force.map(|f| f * particles as f64),
            }];
        }
        let state = self.state;
        let initial: InitialField = Arc::new(move |x: &Vector| {
            let mut start = InitialState {
                velocity: [0.0; 3],
                velocity_gradient: [[0.0; 3]; 3],
                stress: [0.0; 6],
                deformation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            };
            match state {
                State::Uniform(v) => start.velocity = v,
                State::Stretching(rate) => {
                    start.velocity = std::array::from_fn(|axis| rate[axis] * x[axis]);
                    for axis in 0..3 {
                        start.velocity_gradient[axis][axis] = rate[axis];
                    }
                }
                State::Spinning(w) => {
                    start.velocity = std::array::from_fn(|i| {
                        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                        w[j] * x[k] - w[k] * x[j]
                    });
                    for i in 0..3 {
                        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                        start.velocity_gradient[i][k] = w[j];
                        start.velocity_gradient[i][j] = -w[k];
                    }
                }
                State::Stressed(p) => start.stress = [p, p, p, 0.0, 0.0, 0.0],
            }
            start
        });
        TestScene { scene, initial }
    }
}
