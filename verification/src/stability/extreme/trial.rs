//! The common parts of rows: open scenes of the plane, and runs in which any error is one that should not come.

use proctor_laws::LinearElastic;
use proctor_scene::simulation::{InitialField, Options, Simulation, StepInfo};
use proctor_scene::{Contact, ContactNormal, History, PlaneCondition, Scene, Vector};

use super::Unexpected;
use crate::case::{Case, Gate, Size};
use crate::cases::NO_RESULTS;

/// Round-off of some thousand steps, over what it is compared with.
pub(super) const ROUND_OFF: f64 = 1e-12;
/// Why what should not change may change by [`ROUND_OFF`].
pub(super) const ONLY_ROUND_OFF: &str = "exact but for the round-off of some thousand steps";
/// Why the kernel's critical step must be that of the formula.
pub(super) const STEP_OF_FASTEST: &str =
    "the critical step is C h/(c + |v|) with the fastest wave of any particle";
/// Energy over that at the start from which a run is unstable.
pub(super) const GROWN: f64 = 2.0;
/// Why energy may not double.
pub(super) const NO_GROWTH: &str = "energy may swing by what half a step between speeds and forces does to it; an unstable run \
     doubles it again and again";

/// An open mesh of the plane with cells of 1 m and nothing in it, which writes nothing.
pub(super) fn open(cells: [usize; 2]) -> Scene {
    quiet(Scene::plane(cells, 1.0).with_planes(PlaneCondition::Free))
}

/// The same in space.
pub(super) fn open_space(cells: [usize; 3]) -> Scene {
    quiet(Scene::space(cells, 1.0).with_planes(PlaneCondition::Free))
}

fn quiet(mut scene: Scene) -> Scene {
    scene.results = NO_RESULTS;
    // Rows end a run where they like; no step is shortened for it.
    scene.time = 1e9;
    scene
}

/// Linear elasticity of Young's modulus \[Pa\] and Poisson's ratio.
pub(super) fn elastic(young: f64, poisson: f64) -> LinearElastic {
    LinearElastic::new(young, poisson)
}

/// Contact on the grid with the normal of the master.
pub(super) fn pair(id: i64, master: i64, slave: i64, friction: f64) -> Contact {
    Contact {
        name: format!("contact {id}"),
        id,
        friction,
        master,
        slave,
        normal: ContactNormal::Master,
    }
}

/// A prescribed velocity that stays \[m/s\].
pub(super) fn always(velocity: Vector) -> History {
    History {
        times: vec![0.0],
        values: vec![velocity],
    }
}

/// Sets a scene in motion, on one thread.
pub(super) fn start(
    scene: &Scene,
    initial: Option<InitialField>,
) -> Result<Simulation, Unexpected> {
    let simulation = scene.simulate(&options(initial));
    simulation.map_err(|error| Unexpected(format!("refused: {error}")))
}

/// One thread, and this start.
pub(super) fn options(initial: Option<InitialField>) -> Options {
    Options {
        threads: Some(1),
        displacement: true,
        initial,
        ..Options::default()
    }
}

/// A step that must not fail.
pub(super) fn step(simulation: &mut Simulation, stop: f64) -> Result<StepInfo, Unexpected> {
    let stepped = simulation.step(stop);
    stepped.map_err(|error| Unexpected(format!("{}: {error}", method(simulation.scene()))))
}

/// Runs to a time \[s\] and looks at every step.
pub(super) fn run_to(
    simulation: &mut Simulation,
    time: f64,
    mut look: impl FnMut(&Simulation, &StepInfo),
) -> Result<(), Unexpected> {
    while simulation.time() < time {
        let info = step(simulation, time)?;
        look(simulation, &info);
    }
    Ok(())
}

/// Runs some steps and looks at each.
pub(super) fn run_steps(
    simulation: &mut Simulation,
    count: u64,
    mut look: impl FnMut(&Simulation, &StepInfo),
) -> Result<(), Unexpected> {
    for _ in 0..count {
        let info = step(simulation, f64::INFINITY)?;
        look(simulation, &info);
    }
    Ok(())
}

/// The method of a scene in words.
pub(super) fn method(scene: &Scene) -> String {
    crate::stability::scene::method_of(scene).to_string()
}

/// The larger of two, or what is not a number.
pub(super) fn worst(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Kinetic and strain energy, and what contact stores \[J\].
pub(super) fn energy(simulation: &Simulation) -> f64 {
    simulation.kinetic_energy() + simulation.strain_energy() + simulation.mortar_energy()
}

/// Sum of the magnitudes of the momenta of all particles \[kg m/s\].
pub(super) fn momentum_scale(simulation: &Simulation) -> f64 {
    let mut sum = 0.0;
    for (index, set) in simulation.sets().iter().enumerate() {
        for p in 0..set.len() {
            let m = simulation.particle_mass(index, p);
            sum += set.velocity(p).iter().map(|v| (m * v).abs()).sum::<f64>();
        }
    }
    sum
}

/// Largest difference of two vectors along any axis.
pub(super) fn apart(a: &Vector, b: &Vector) -> f64 {
    let differences = (0..3).map(|axis| (a[axis] - b[axis]).abs());
    differences.fold(0.0, worst)
}

/// How far the nearest particle is from where a quarter turn about a point brings each, over `scale` \[m\].
pub(super) fn off_by_a_quarter_turn(simulation: &Simulation, center: [f64; 2], scale: f64) -> f64 {
    let places: Vec<Vector> = (0..simulation.particles())
        .map(|p| simulation.position(0, p))
        .collect();
    let mut most = 0.0;
    for x in &places {
        let turned = [
            center[0] - (x[1] - center[1]),
            center[1] + (x[0] - center[0]),
            0.0,
        ];
        let near = places.iter().map(|y| apart(y, &turned));
        most = worst(most, near.fold(f64::INFINITY, f64::min) / scale);
    }
    most
}

/// Momentum and energy of a run on which nothing acts from outside.
pub(super) struct Kept {
    momentum: Vector,
    scale: f64,
    energy: f64,
    /// Largest change of momentum, over that of all particles in all directions.
    pub drift: f64,
    /// Largest energy over that at the start.
    pub grown: f64,
}

impl Kept {
    pub(super) fn of(simulation: &Simulation) -> Self {
        Self {
            momentum: simulation.momentum(),
            scale: momentum_scale(simulation),
            energy: energy(simulation),
            drift: 0.0,
            grown: 0.0,
        }
    }

    /// Looks at a run again.
    pub(super) fn look(&mut self, simulation: &Simulation) {
        let drift = apart(&simulation.momentum(), &self.momentum) / self.scale;
        self.drift = worst(self.drift, drift);
        self.grown = worst(self.grown, energy(simulation) / self.energy);
    }
}

/// What must hold of the worst of several runs on which nothing acts from outside.
pub(super) fn kept(what: &str, drift: f64, grown: f64) -> [Gate; 2] {
    [
        Gate::at_most(
            format!("{what}: change of momentum, over the momentum in all directions"),
            drift,
            ROUND_OFF,
            ONLY_ROUND_OFF,
        ),
        Gate::at_most(
            format!("{what}: highest energy over that at the start"),
            grown,
            GROWN,
            NO_GROWTH,
        ),
    ]
}

/// The gates of a verification case with its short ladder.
pub(super) fn of_case(case: &Case) -> Result<Vec<Gate>, Unexpected> {
    let mut solved = vec![];
    for rung in case.rungs(Size::Quick) {
        let found = case.solve(&rung, &options(None), &mut |_| ());
        let found = found.map_err(|error| Unexpected(error.to_string()))?;
        solved.push((rung, found));
    }
    let named = |gate: Gate| Gate {
        name: format!("{}: {}", case.name(), gate.name),
        ..gate
    };
    let gates = case.judge(Size::Quick, &solved).gates;
    Ok(gates.into_iter().map(named).collect())
}

/// Noise between -1 and 1 that depends on the bits of a place and a number alone.
pub(super) fn noise(x: &Vector, number: u64) -> f64 {
    let mut word = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for c in x {
        word = (word ^ c.to_bits()).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word ^= word >> 29;
    }
    (word >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}
