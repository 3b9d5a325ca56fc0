//! Loads and motions that put a body in tension, where FLIP or TPIC with MUSL or USF does not hold it.
//!
//! The estimates are those of a bar and of a beam: a warning asks for no more than the size of the tension. For why such a body is
//! torn see `simulation/tension.rs`.

use crate::values::{Body, Scene};
use proctor_kernel::model::{
    PlaneCondition, Shape, StressScheme, TimeStep, TransferKind, Vector, Weighting,
};
use proctor_kernel::plan::{AUTOMATIC_SHARE, loses_tension, scheme_word, stability_number};

/// Factor by which a way that no strain sees must grow in a run to be worth a warning.
const FACTOR: f64 = 10.0;
/// Least tension over the modulus of confined strain that is worth a warning.
const LEAST: f64 = 1e-3;
/// Growth per step with TPIC over that with FLIP, with GIMP and with B-splines.
const TPIC_SHARE: [f64; 2] = [0.095, 0.125];
/// Damping of TPIC per step.
///
/// `proctor stability` of the bar of 20 kPa, as MUSL TPIC with uGIMP: 0.20 % per step at a tension of 0.149 of the modulus, 0.53 % at
/// 0.297, none at 0.074 or half the step; USF 0.20 and 0.55 %; cpGIMP 0.58 % and B-splines 1.21 % at 0.297.
const TPIC_LOSS: f64 = 1.3e-3;

/// A body that will be in tension, by an estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForeseenTension {
    /// Place of the body in the scene.
    pub body: usize,
    /// Cause.
    pub cause: &'static str,
    /// Tension \[Pa\].
    pub stress: f64,
    /// Tension over the modulus of confined strain.
    pub strain: f64,
}

/// Tension by one cause.
struct TensionCause {
    what: &'static str,
    /// Tension over the modulus of confined strain.
    strain: f64,
}

/// The corners of a body.
#[derive(Clone, Copy)]
struct Extent {
    low: Vector,
    high: Vector,
}

impl Extent {
    fn of(shape: &Shape) -> Option<Self> {
        let around = |points: &mut dyn Iterator<Item = Vector>| {
            let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
            for x in points {
                low = std::array::from_fn(|axis| low[axis].min(x[axis]));
                high = std::array::from_fn(|axis| high[axis].max(x[axis]));
            }
            Self { low, high }
        };
        match shape {
            Shape::Cuboid { p1, p2 } => Some(around(&mut [*p1, *p2].into_iter())),
            Shape::Polygon { points } => Some(around(&mut points.iter().copied())),
            Shape::Particles(seeds) => Some(around(&mut seeds.iter().map(|seed| seed.position))),
            _ => None,
        }
    }

    fn length(&self, axis: usize) -> f64 {
        self.high[axis] - self.low[axis]
    }

    /// Area across an axis; per metre of thickness in the plane.
    fn across(&self, axis: usize, axes: usize) -> f64 {
        let others = (0..axes).filter(|other| *other != axis);
        others.map(|other| self.length(other)).product()
    }

    fn middle(&self, axis: usize) -> f64 {
        0.5 * (self.low[axis] + self.high[axis])
    }

    /// Lower or upper face.
    fn face(&self, axis: usize, side: usize) -> f64 {
        [self.low, self.high][side][axis]
    }

    /// True if it shares space with a box, by more than round-off.
    fn meets(&self, p1: &Vector, p2: &Vector, axes: usize, tolerance: f64) -> bool {
        (0..axes).all(|axis| {
            self.low[axis] <= p2[axis] + tolerance && self.high[axis] >= p1[axis] - tolerance
        })
    }
}

/// The bodies of a scene that loads, weight or driven bodies put in tension, whatever the method.
#[must_use]
pub fn foreseen_tension(scene: &Scene) -> Vec<ForeseenTension> {
    let free = scene.bodies.iter().enumerate();
    let free = free.filter(|(_, body)| body.motion.is_none());
    free.filter_map(|(index, body)| {
        let material = scene.materials.get(body.material)?;
        let speed = material.law.wave_speed(material.density);
        let modulus = material.density * speed * speed;
        let TensionCause { what, strain } = most(scene, body, &Extent::of(&body.shape)?, modulus)?;
        Some(ForeseenTension {
            body: index,
            cause: what,
            stress: strain * modulus,
            strain,
        })
    })
    .collect()
}

/// Warnings about bodies that will be in tension.
pub(super) fn warnings(scene: &Scene) -> Vec<String> {
    if !loses_tension(scene.transfer, scene.scheme) && !tpic_grows(scene) {
        return vec![];
    }
    let foreseen = foreseen_tension(scene).into_iter();
    foreseen
        .filter_map(|tension| warning(scene, &tension))
        .collect()
}

/// True for TPIC where strain is not that of the way.
fn tpic_grows(scene: &Scene) -> bool {
    scene.transfer.kind == TransferKind::Tpic && scene.scheme != StressScheme::Usl
}

/// Growth per step of a way that no strain sees, at a tension over the modulus and a Courant number.
fn growth(scene: &Scene, strain: f64, courant: f64) -> f64 {
    let flip = strain * courant * courant;
    if !tpic_grows(scene) {
        return flip;
    }
    let splines = scene.weighting == Weighting::QuadraticBSpline;
    (TPIC_SHARE[usize::from(splines)] * flip - TPIC_LOSS).max(0.0)
}

fn warning(scene: &Scene, tension: &ForeseenTension) -> Option<String> {
    let body = scene.bodies.get(tension.body)?;
    let material = scene.materials.get(body.material)?;
    let speed = material.law.wave_speed(material.density);
    let cell = smallest_cell(scene);
    let courant = match scene.time_step {
        TimeStep::Automatic => AUTOMATIC_SHARE * bound(scene, body),
        TimeStep::Multiplier { multiplier, .. } => multiplier,
        TimeStep::Fixed { dt, .. } => speed * dt / cell,
    };
    let growth = growth(scene, tension.strain, courant);
    let steps = libm::log(FACTOR) / growth;
    let run = scene.time * speed / (courant * cell);
    (tension.strain > LEAST && steps < run).then(|| {
        let (name, what) = (&body.name, tension.cause);
        let scheme = scheme_word(scene.scheme);
        let transfer = if tpic_grows(scene) { "TPIC" } else { "FLIP" };
        let stress = tension.stress;
        format!(
            "{name}: {what} puts it in tension, about {stress:.2e} Pa, which {transfer} with {scheme} does not hold: particles go a \
             way that no strain sees, and that grows by about {:.2} % per step, tenfold in {:.0} steps, and a \
             smaller step only delays it; \"USL\" and \"APIC\" hold",
            100.0 * growth,
            steps.ceil()
        )
    })
}

/// C of the critical step of a body.
fn bound(scene: &Scene, body: &Body) -> f64 {
    let axes = scene.dimension.axes();
    let per_cell = body.particles_per_cell[..axes].iter().max().copied();
    let half_length = 0.5 / per_cell.unwrap_or(1).max(1) as f64;
    let transfer = scene.transfer.kind;
    stability_number(scene.weighting, scene.scheme, transfer, half_length)
}

fn smallest_cell(scene: &Scene) -> f64 {
    let cell = &scene.mesh.cell[..scene.dimension.axes()];
    cell.iter().copied().fold(f64::INFINITY, f64::min)
}

/// The largest tension that loads, weight and driven bodies give a body.
fn most(scene: &Scene, body: &Body, extent: &Extent, modulus: f64) -> Option<TensionCause> {
    let loads = TensionCause {
        what: "a load that pulls",
        strain: pulled_by_loads(scene, extent) / modulus,
    };
    let [hangs, bends] = pulled_by_weight(scene, body, extent);
    let hangs = TensionCause {
        what: "its weight, which hangs from a plane,",
        strain: hangs / modulus,
    };
    let bends = TensionCause {
        what: "its weight, which bends it,",
        strain: bends / modulus,
    };
    let driven = TensionCause {
        what: "a driven body that moves away",
        strain: pulled_by_bodies(scene, extent),
    };
    let all = [loads, hangs, bends, driven].into_iter();
    let all = all.filter(|pulled| pulled.strain > 0.0);
    all.max_by(|a, b| a.strain.total_cmp(&b.strain))
}

/// Tension by box loads and tractions that point away from the middle of a body \[Pa\].
fn pulled_by_loads(scene: &Scene, extent: &Extent) -> f64 {
    let axes = scene.dimension.axes();
    let tolerance = 1e-6 * smallest_cell(scene);
    let mut most = 0.0_f64;
    for load in &scene.box_loads {
        if !extent.meets(&load.p1, &load.p2, axes, -tolerance) {
            continue;
        }
        for axis in 0..axes {
            let arm = 0.5 * (load.p1[axis] + load.p2[axis]) - extent.middle(axis);
            if arm * load.force[axis] > tolerance * load.force[axis].abs() {
                most = most.max(load.force[axis].abs() / extent.across(axis, axes));
            }
        }
    }
    for load in &scene.tractions {
        if !extent.meets(&load.p1, &load.p2, axes, tolerance) {
            continue;
        }
        for axis in (0..axes).filter(|&axis| load.p1[axis] == load.p2[axis]) {
            let arm = load.p1[axis] - extent.middle(axis);
            let outward = load.traction.values.iter().map(|t| t[axis] * arm.signum());
            most = most.max(outward.fold(0.0, f64::max));
        }
    }
    most
}

/// Tension of a body that hangs from a plane, and of one that a plane at its side holds, a beam \[Pa\].
fn pulled_by_weight(scene: &Scene, body: &Body, extent: &Extent) -> [f64; 2] {
    let axes = scene.dimension.axes();
    let Some(material) = scene.materials.get(body.material) else {
        return [0.0; 2];
    };
    // A plane along which a body slides does not carry it.
    let touches = |axis: usize, side: usize, condition: fn(PlaneCondition) -> bool| {
        let mesh = &scene.mesh;
        let far = mesh.origin[axis] + mesh.cells[axis] as f64 * mesh.cell[axis];
        let plane = [mesh.origin[axis], far][side];
        let near = (extent.face(axis, side) - plane).abs() <= 1e-6 * mesh.cell[axis];
        near && condition(mesh.planes[axis][side])
    };
    let holds =
        |condition| condition == PlaneCondition::Fixed || condition == PlaneCondition::Sliding;
    let fixes = |condition| condition == PlaneCondition::Fixed;
    let alone = scene.bodies.len() == 1 && scene.surfaces.is_empty() && scene.held_boxes.is_empty();
    let (mut hangs, mut bends) = (0.0_f64, 0.0_f64);
    for axis in (0..axes).filter(|&axis| scene.gravity[axis] != 0.0) {
        let below = usize::from(scene.gravity[axis] > 0.0);
        let weight = material.density * scene.gravity[axis].abs();
        if touches(axis, below, holds) {
            continue;
        }
        if touches(axis, 1 - below, holds) {
            hangs = hangs.max(weight * extent.length(axis));
        }
        for side in (0..axes).filter(|&side| side != axis) {
            let held = [0, 1].map(|end| touches(side, end, fixes));
            if alone && held[0] != held[1] && !touches(axis, 1 - below, fixes) {
                let (length, height) = (extent.length(side), extent.length(axis));
                bends = bends.max(3.0 * weight * length * length / height);
            }
        }
    }
    [hangs, bends]
}

/// Strain of a body by driven ones beside it that move away and share its nodes.
fn pulled_by_bodies(scene: &Scene, extent: &Extent) -> f64 {
    let axes = scene.dimension.axes();
    let tolerance = 1e-6 * smallest_cell(scene);
    let pairs = scene.contacts.iter().flat_map(|c| [c.master, c.slave]);
    let apart: Vec<i64> = pairs.collect();
    let mut most = 0.0_f64;
    for other in &scene.bodies {
        let (Some(motion), Some(at)) = (&other.motion, Extent::of(&other.shape)) else {
            continue;
        };
        if apart.contains(&other.id) || !extent.meets(&at.low, &at.high, axes, tolerance) {
            continue;
        }
        for axis in 0..axes {
            let sign = if (at.low[axis] - extent.high[axis]).abs() <= tolerance {
                1.0
            } else if (at.high[axis] - extent.low[axis]).abs() <= tolerance {
                -1.0
            } else {
                continue;
            };
            let mut way = 0.0;
            let velocity: Vec<f64> = motion.values.iter().map(|v| sign * v[axis]).collect();
            for (times, ends) in motion.times.windows(2).zip(velocity.windows(2)) {
                let part = (scene.time.min(times[1]) - times[0]).max(0.0);
                way += 0.5 * (ends[0] + ends[1]) * part;
                most = most.max(way / extent.length(axis));
            }
            let (last, end) = (motion.times.last(), velocity.last());
            if let (Some(last), Some(end)) = (last, end) {
                way += end * (scene.time - last).max(0.0);
                most = most.max(way / extent.length(axis));
            }
        }
    }
    // A body gives way before it is pulled to twice its length.
    most.min(1.0)
}
