//! Does a specimen in the tests of the laboratory have the stress and the volume of its law, through the whole cycle?
//!
//! A square or a cube stands on a roller between rollers and is pressed from above by a
//! smooth plane. In the oedometer there are rollers all round; in biaxial (plane strain) and triaxial compression the sides
//! opposite to the rollers are free, or bear a constant pressure that the specimen has within from the start. Stress and
//! strain are the same everywhere, so that each particle is compared with the path of its law (`exact/homogeneous.rs`).
//!
//! A plane of nodes presses: all of them get one velocity v along the axis and keep those across, so that the logarithmic axial
//! strain below it grows by v/H per time. There is no damping. Where it yields a specimen widens faster at once, by the speed
//! of the plane, and so the plane comes to rest there: it strains the specimen to the yield surface and then beyond it, each
//! time from rest to rest and in some hundred times that of a wave through it. Strains are 1e-5, with strengths in proportion,
//! so that particles stay in their cells and pressed sides on the nodes at which the pressure acts: what the laws do is the
//! same at any size. `proctor verify homogeneous`.

use super::prelude::*;
use super::vocabulary::moved::smooth;
use super::vocabulary::press::Press;
use super::vocabulary::yielding::{DRUCKER_PRAGER, MOHR_COULOMB, PlasticSolid, TRESCA, VON_MISES};
use crate::exact::homogeneous::{Specimen, State, Surface, Test};

const HEIGHT: f64 = 1.0; // Height and width [m]
const YOUNG: f64 = 10e6; // Young's modulus [Pa]
/// Yield stress of von Mises \[Pa\]; the others yield at about the same stress.
const STRENGTH: f64 = 50.0;
const PRESSURE: f64 = 25.0; // Pressure on the sides where there is one [Pa]
const DENSITY: f64 = 2000.0; // Density [kg/m³]
const BEYOND: f64 = 5.0; // Axial strain at the end over that at which the law yields
const TIME: f64 = 4.5; // Duration of a test [s]: a wave takes some 14 ms through the specimen
/// Share of it until the law yields: beyond it the plane has four times as far to go and accelerates as much.
const FIRST: f64 = 1.0 / 3.0;
const STATES: u32 = 60; // States of a path that are compared
const AIR: usize = 1; // Empty cells beside free sides

/// Names of the quantities.
const STRESS: &str = "difference of stress over the strength";
const VOLUME: &str = "difference of volume strain over the largest";

/// Problem of a rung.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Variant {
    name: &'static str,
    test: Test,
    law: &'static str,
    /// True if the free sides bear a pressure.
    pressed: bool,
}

/// A test with free sides without a load.
const fn free(name: &'static str, test: Test, law: &'static str) -> Variant {
    Variant {
        name,
        test,
        law,
        pressed: false,
    }
}

/// A test with free sides that bear a pressure.
const fn pressed(name: &'static str, test: Test, law: &'static str) -> Variant {
    Variant {
        pressed: true,
        ..free(name, test, law)
    }
}

const VARIANTS: [Variant; 16] = {
    use Test::{Biaxial, Oedometer, Triaxial};
    [
        free("oedometer, von Mises", Oedometer, VON_MISES),
        free("oedometer, Tresca", Oedometer, TRESCA),
        free("oedometer, Mohr-Coulomb", Oedometer, MOHR_COULOMB),
        free("oedometer, Drucker-Prager", Oedometer, DRUCKER_PRAGER),
        free("biaxial, von Mises", Biaxial, VON_MISES),
        free("biaxial, Tresca", Biaxial, TRESCA),
        free("biaxial, Mohr-Coulomb", Biaxial, MOHR_COULOMB),
        free("biaxial, Drucker-Prager", Biaxial, DRUCKER_PRAGER),
        pressed("biaxial, Mohr-Coulomb, pressed", Biaxial, MOHR_COULOMB),
        pressed("biaxial, Drucker-Prager, pressed", Biaxial, DRUCKER_PRAGER),
        free("triaxial, von Mises", Triaxial, VON_MISES),
        free("triaxial, Tresca", Triaxial, TRESCA),
        free("triaxial, Mohr-Coulomb", Triaxial, MOHR_COULOMB),
        free("triaxial, Drucker-Prager", Triaxial, DRUCKER_PRAGER),
        pressed("triaxial, Mohr-Coulomb, pressed", Triaxial, MOHR_COULOMB),
        pressed(
            "triaxial, Drucker-Prager, pressed",
            Triaxial,
            DRUCKER_PRAGER,
        ),
    ]
};

impl Variant {
    fn solid(self) -> PlasticSolid {
        PlasticSolid {
            variant: self.law,
            young: YOUNG,
            strength: STRENGTH,
        }
    }

    fn dimension(self) -> Dimension {
        match self.test {
            Test::Triaxial => Dimension::Three,
            _ => Dimension::Two,
        }
    }

    /// Axes whose upper side is free.
    fn free(self) -> &'static [usize] {
        match self.test {
            Test::Oedometer => &[],
            Test::Biaxial => &[0],
            Test::Triaxial => &[0, 2],
        }
    }

    fn pressure(self) -> f64 {
        if self.pressed { PRESSURE } else { 0.0 }
    }

    /// uGIMP, as what chooses nothing; linear functions where nodes bear a pressure: a domain that reaches past these nodes,
    /// by however little, has others without a load there, and its particle comes to rest without stress.
    fn weighting(self) -> Weighting {
        if self.pressed {
            Weighting::Linear
        } else {
            Weighting::UniformGimp
        }
    }

    /// Corners of the specimen \[m\].
    fn corners(self) -> [[f64; 3]; 2] {
        let mut upper = [HEIGHT, HEIGHT, 0.0];
        upper[..self.dimension().axes()].fill(HEIGHT);
        [[0.0; 3], upper]
    }

    /// The pressure on the free sides.
    fn tractions(self) -> Vec<Traction> {
        let on = |&axis: &usize| {
            let [mut p1, p2] = self.corners();
            p1[axis] = p2[axis];
            let mut traction = [0.0; 3];
            traction[axis] = -PRESSURE;
            let traction = traction.into();
            Traction { p1, p2, traction }
        };
        let sides = if self.pressed { self.free() } else { &[] };
        sides.iter().map(on).collect()
    }
}

/// Strain and rate of strain \[1/s\] below the smooth plane that presses, nodes at the top of the specimen, at a time \[s\]: to the
/// strain at which the specimen yields and then beyond it, each time from rest to rest.
fn strained(yields: f64, time: f64) -> [f64; 2] {
    let first = FIRST * TIME;
    let (from, by, begins, takes) = if time < first {
        (0.0, yields, 0.0, first)
    } else {
        (yields, (BEYOND - 1.0) * yields, first, TIME - first)
    };
    let [share, rate] = smooth((time - begins) / takes);
    [from + by * share, by * (rate / takes)]
}

const WRONG_STRENGTH: Wrong = Wrong::factor("strength", 1.2).breaks(|gate| gate.contains("stress"));
const WRONG_DILATION: Wrong = Wrong::factor("dilation", 1.1)
    .breaks(|gate| gate.contains("volume") && dilates(gate) && !gate.contains("oedometer"))
    .spares(|gate| gate.contains("volume"));
const WRONG_STRAIN: Wrong =
    Wrong::factor("strain", 1.03).breaks(|gate| gate.contains("volume") && dilates(gate));

/// Homogeneous tests.
pub static HOMOGENEOUS: Case = Case::new(
    "homogeneous",
    "Does a specimen in the tests of the laboratory have the stress and the volume of its law?",
)
.ladder(Ladder::made(rungs))
.scene(scene)
.options(options)
.run(compare)
.gates_of_rungs(&[
    error(STRESS).at_most(5e-3, "half a percent: no stress varies in space"),
    error(VOLUME).at_most(1e-2, "one percent: Hooke's law and dilation"),
])
.wrong_references(&[WRONG_STRENGTH, WRONG_DILATION, WRONG_STRAIN])
.no_study("stress and strain are the same everywhere, so that no cell size has a say")
.no_guest("moved planes strain it, and the scenes of other solvers have none but a moving base");

/// Largest deviation of the particles along a path.
struct Off {
    /// Volumes at the start \[m³\].
    volumes: Vec<f64>,
    /// Scales of the stresses \[Pa\] and of the volume strains.
    scales: [f64; 2],
    /// Stress and volume strain, over their scales.
    most: [f64; 2],
}

impl Off {
    /// Nothing yet, of a specimen at the start, with the strength at the end of the exact path and the largest volume strain
    /// on it.
    fn new(simulation: &Simulation, path: &[(f64, State)]) -> Self {
        let end = path.last().map_or_else(State::default, |(_, end)| *end);
        let strength = (end.stress[1] - end.stress[0]).abs();
        let largest = largest(path.iter().map(|(_, state)| state.volume.abs()));
        let particles = 0..simulation.sets()[0].len();
        let volumes = particles.map(|p| simulation.particle_volume(0, p));
        Self {
            volumes: volumes.collect(),
            scales: [strength, largest],
            most: [0.0; 2],
        }
    }

    /// Compares all particles with a state.
    fn compare(&mut self, simulation: &Simulation, state: &State) {
        for (p, volume) in self.volumes.iter().enumerate() {
            let grown = libm::log(simulation.particle_volume(0, p) / volume);
            let off = ((grown - state.volume) / self.scales[1]).abs();
            self.most[1] = larger(self.most[1], off);
            let stress = simulation.sets()[0].stress(p);
            // There is no shear.
            let exact = state.stress.into_iter().chain([0.0; 3]);
            for (s, exact) in stress.into_iter().zip(exact) {
                self.most[0] = larger(self.most[0], ((s - exact) / self.scales[0]).abs());
            }
        }
    }

    fn quantities(&self) -> [Quantity; 2] {
        let [stress, volume] = self.most;
        [
            Quantity::of_zero(STRESS, stress),
            Quantity::of_zero(VOLUME, volume),
        ]
    }
}

/// True if the law of a gate dilates.
fn dilates(gate: &str) -> bool {
    gate.contains("Mohr") || gate.contains("Drucker")
}

/// The exact specimen, as the case refers to it.
fn exact(reference: Reference, variant: Variant) -> Specimen {
    let solid = PlasticSolid {
        strength: reference.of(&WRONG_STRENGTH) * STRENGTH,
        ..variant.solid()
    };
    let surface = match solid.surface() {
        Surface::MohrCoulomb([friction, cohesion, dilation]) => {
            Surface::MohrCoulomb([friction, cohesion, reference.of(&WRONG_DILATION) * dilation])
        }
        Surface::Cone([eta, limit, flow]) => {
            Surface::Cone([eta, limit, reference.of(&WRONG_DILATION) * flow])
        }
    };
    Specimen {
        young: YOUNG,
        poisson: solid.poisson(),
        surface,
        test: variant.test,
        pressure: variant.pressure(),
    }
}

/// Axial strain at which the specimen of a rung yields.
fn yields_at(rung: &Rung) -> f64 {
    exact(Reference::CORRECT, *rung.problem::<Variant>()).yields_at()
}

/// Axial strains and states of the exact specimen at equal shares of the time.
fn path(reference: Reference, rung: &Rung) -> Vec<(f64, State)> {
    let yields = yields_at(rung);
    let strain = |k| strained(yields, TIME * f64::from(k) / f64::from(STATES))[0];
    let strains: Vec<f64> = (0..=STATES).map(strain).collect();
    let wrong = strains.iter().map(|e| reference.of(&WRONG_STRAIN) * e);
    let wrong: Vec<f64> = wrong.collect();
    let states = exact(reference, *rung.problem::<Variant>()).path(&wrong);
    strains.into_iter().zip(states).collect()
}

/// Runs the test and compares the states on its way.
fn compare(run: Run<'_>) -> Result<Measurements, Failure> {
    let (rung, simulation, observer) = (run.rung, run.simulation, run.observer);
    let path = path(run.reference, rung);
    let mut off = Off::new(simulation, &path);
    let mut points = vec![];
    let look = |simulation: &Simulation, k: usize| {
        let (strain, state) = path[k];
        off.compare(simulation, &state);
        let stress = simulation.sets()[0].stress(0);
        points.push(CurvePoint::new(
            1e6 * strain,
            stress[0] - stress[1],
            state.stress[0] - state.stress[1],
        ));
        Ok(())
    };
    at_intervals(simulation, TIME / f64::from(STATES), observer, |_| {}, look)?;
    let curve = Curve::new(
        format!("stress over strain, {}", rung.label),
        ["axial strain (1e-6)", "axial less lateral compression (Pa)"],
        points,
    );
    Ok(Measurements::of(off.quantities()).drawn(curve))
}

fn rungs(size: Size) -> Vec<Rung> {
    let counts: &'static [u32] = size.pick(&[2], &[2, 4]);
    Rung::of_problems(&VARIANTS, |v| v.name, "H/h", HEIGHT, |_| counts)
}

fn scene(rung: &Rung, _: &Settings) -> Scene {
    let (h, variant) = (rung.cell, *rung.problem::<Variant>());
    let dimension = variant.dimension();
    let cells = (HEIGHT / h).round() as usize;
    let mut mesh = Mesh::new(dimension, [0.0; 3], [h; 3], [1; 3]);
    mesh.cells[..dimension.axes()].fill(cells);
    for axis in variant.free().iter().copied().chain([1]) {
        mesh.cells[axis] += AIR;
        mesh.planes[axis][1] = PlaneCondition::Free;
    }
    let mut scene = bare_scene("homogeneous", dimension, mesh, TIME);
    scene.materials = material(variant.law, DENSITY, variant.solid().perfect());
    let [lower, upper] = variant.corners();
    let mut specimen = body("specimen", 1, cuboid(lower, upper));
    if variant.pressed {
        specimen.initial_stress = InitialStress::Isotropic(-PRESSURE);
    }
    scene.bodies = vec![specimen];
    scene.tractions = variant.tractions();
    let method = Method::DEFAULT.with_weighting(variant.weighting());
    Settings::new(method).apply(&mut scene);
    scene
}

fn options(rung: &Rung, _: Reference, mut options: Options) -> Options {
    let yields = yields_at(rung);
    let velocity = move |time| -HEIGHT * strained(yields, time)[1];
    let press = Press::smooth(HEIGHT, rung.cell, velocity);
    options.conditions.push(Arc::new(press));
    options
}
