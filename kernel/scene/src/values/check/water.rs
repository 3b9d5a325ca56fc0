//! Pore water: its constants, where it begins, and what does not go with it yet.

use super::body::check_box;
use super::collector::Collector;
use super::history::check_history;
use crate::values::{InitialPressure, InitialStress, Scene};
use proctor_geometry::number::Number;
use proctor_kernel::model::{
    Damping, PlaneCondition, PlanePressure, StressScheme, TransferKind, Weighting,
};

pub(super) fn check(scene: &Scene, problems: &mut Collector) {
    if !scene.has_water() {
        if !scene.initial_pressures.is_empty() {
            problems.add(
                "initial_pressures",
                "a pore pressure in a scene of one phase",
                "`n_phases` 2",
            );
        }
        if scene.water_pressures.iter().flatten().any(Option::is_some) {
            problems.add(
                "mesh.boundary_pressures_fluid",
                "a pressure of water in a scene of one phase",
                "`n_phases` 2",
            );
        }
        if !scene.held_pressures.is_empty() {
            problems.add(
                "prescribed_pressure_box",
                "a pore pressure in a scene of one phase",
                "`n_phases` 2",
            );
        }
        return;
    }
    check_constants(scene, problems);
    check_planes(scene, problems);
    check_pressures(scene, problems);
    check_held_pressures(scene, problems);
    check_method(scene, problems);
    check_company(scene, problems);
}

/// The constants of each water, and that all have the densities and the ratios of conductivity of the first.
fn check_constants(scene: &Scene, problems: &mut Collector) {
    let axes = scene.dimension.axes();
    let mut first: Option<(usize, f64)> = None;
    for (i, material) in scene.materials.iter().enumerate() {
        let path = |key: &str| format!("materials[{i}].{key}");
        let Some(water) = scene.water_of(i) else {
            problems.add(
                path("porosity"),
                format!("no water in {} with `n_phases` 2", material.name),
                "water in every material: dry bodies beside wet ones are not covered yet",
            );
            continue;
        };
        let n = water.porosity;
        if !(n > 0.0 && n < 1.0) {
            let accepted = "a number greater than 0 and less than 1";
            problems.add(path("porosity"), Number(n).to_string(), accepted);
        }
        problems.positive(path("density_fluid"), water.density, "kg/m³");
        problems.positive(path("bulk_fluid"), water.bulk, "Pa");
        for axis in 0..axes {
            let path = path(&format!("hydraulic_conductivity[{axis}]"));
            problems.positive(path, water.conductivity[axis], "m/s");
        }
        let gravity = path("conductivity_gravity");
        problems.positive(gravity, water.conductivity_gravity, "m/s²");
        let Some((other, grains)) = first else {
            first = Some((i, material.density));
            continue;
        };
        let Some(before) = scene.water_of(other) else {
            continue;
        };
        let alike = [
            ("density", material.density, grains),
            ("density_fluid", water.density, before.density),
        ];
        for (key, value, of_first) in alike {
            if value != of_first {
                problems.add(
                    path(key),
                    format!(
                        "{}, beside {} of materials[{other}]",
                        Number(value),
                        Number(of_first)
                    ),
                    "one density of grains and one of water in a scene",
                );
            }
        }
        let ratio = |k: &[f64; 3], axis: usize| k[axis] / k[0];
        let own = |axis: usize| ratio(&water.conductivity, axis);
        let same = |axis| (own(axis) / ratio(&before.conductivity, axis) - 1.0).abs() < 1e-12;
        if !(1..axes).all(same) {
            problems.add(
                path("hydraulic_conductivity"),
                format!("{:?}", &water.conductivity[..axes]),
                format!("the ratios between the axes that materials[{other}] has"),
            );
        }
    }
}

fn check_planes(scene: &Scene, problems: &mut Collector) {
    for axis in 0..scene.dimension.axes() {
        for side in 0..2 {
            let condition = scene.water_planes[axis][side];
            if matches!(
                condition,
                PlaneCondition::Antisymmetric | PlaneCondition::Absorbing
            ) {
                let (letter, end) = (["X", "Y", "Z"][axis], ["0", "n"][side]);
                problems.add(
                    format!("mesh.boundary_conditions_fluid.plane_{letter}{end}"),
                    condition.word(),
                    "`free`, `sliding` or `fixed`",
                );
            }
            if scene.mesh.planes[axis][side] == PlaneCondition::Antisymmetric
                && condition != PlaneCondition::Free
            {
                let (letter, end) = (["X", "Y", "Z"][axis], ["0", "n"][side]);
                problems.add(
                    format!("mesh.boundary_conditions_fluid.plane_{letter}{end}"),
                    format!(
                        "{} at a plane that is antisymmetric for the skeleton",
                        condition.word()
                    ),
                    "`free`: the skeleton moves through the plane, and the water with it",
                );
            }
            if let Some(pressure) = &scene.water_pressures[axis][side] {
                let (letter, end) = (["X", "Y", "Z"][axis], ["0", "n"][side]);
                let keys = match pressure {
                    PlanePressure::Uniform(_) => "boundary_pressures_fluid",
                    PlanePressure::Level(_) => "boundary_levels_fluid",
                };
                let path = format!("mesh.{keys}.plane_{letter}{end}");
                match pressure {
                    PlanePressure::Uniform(pressure) => {
                        problems.finite(&path, *pressure);
                    }
                    PlanePressure::Level(history) => {
                        check_history(&path, history, problems);
                        if scene.gravity == [0.0; 3] {
                            problems.add(
                                &path,
                                "a level of water without gravity",
                                "`gravity`, or a pressure in `boundary_pressures_fluid`",
                            );
                        }
                    }
                }
                if condition != PlaneCondition::Free {
                    problems.add(
                        path,
                        format!(
                            "a pressure at a plane that is {} for the water",
                            condition.word()
                        ),
                        "a plane that is `free` in `boundary_conditions_fluid`, or not named there",
                    );
                }
            }
        }
    }
}

fn check_pressures(scene: &Scene, problems: &mut Collector) {
    for (i, given) in scene.initial_pressures.iter().enumerate() {
        let path = format!("initial_pressures[{i}]");
        match given {
            InitialPressure::Material { id, pressure } => {
                problems.finite(format!("{path}.pressure"), *pressure);
                if scene.materials.iter().all(|material| material.id != *id) {
                    problems.add(
                        format!("{path}.material_id"),
                        id.to_string(),
                        "the `id` of a material",
                    );
                }
            }
            InitialPressure::Table { level } => {
                problems.finite("water_table", *level);
                let axes = scene.dimension.axes();
                let along = scene.gravity[..axes].iter().filter(|g| **g != 0.0).count();
                if along != 1 {
                    problems.add(
                        "water_table",
                        format!("a level with the gravity {:?}", &scene.gravity[..axes]),
                        "gravity along one axis, which the level is a coordinate of",
                    );
                }
            }
            InitialPressure::Box { p1, p2, pressure } => {
                problems.vector(format!("{path}.point_p1"), p1);
                problems.vector(format!("{path}.point_p2"), p2);
                problems.finite(format!("{path}.pressure"), *pressure);
            }
        }
    }
}

fn check_held_pressures(scene: &Scene, problems: &mut Collector) {
    for (i, held) in scene.held_pressures.iter().enumerate() {
        let path = format!("held_pressures[{i}]");
        check_box(&path, &held.p1, &held.p2, scene.dimension.axes(), problems);
        problems.finite(format!("{path}.pressure"), held.pressure);
    }
}

/// The parts of the method that water has a form of.
fn check_method(scene: &Scene, problems: &mut Collector) {
    let mut refuse = |path: &str, is: bool, found: &str, accepted: &str| {
        if is {
            problems.add(path, format!("{found} with `n_phases` 2"), accepted);
        }
    };
    let axisymmetric = scene.mesh.axisymmetric;
    refuse(
        "mesh.axisymmetric",
        axisymmetric,
        "true",
        "the plane or space",
    );
    let usf = scene.scheme == StressScheme::Usf;
    refuse("stress_scheme_update", usf, "USF", "USL or MUSL");
    let flip = scene.transfer.kind == TransferKind::Flip;
    refuse("transfer", !flip, "an affine transfer", "FLIP");
    let domains = matches!(
        scene.weighting,
        Weighting::UniformGimp | Weighting::ContiguousGimp(_)
    );
    refuse(
        "shape_function",
        !domains,
        "this function",
        "GIMP or cpGIMP",
    );
    let damped = scene.damping.slows() || scene.damping == Damping::Kinetic;
    refuse(
        "damping",
        damped,
        "damping",
        "no damping: drag of the water damps",
    );
}

/// Other parts of the scene.
fn check_company(scene: &Scene, problems: &mut Collector) {
    let planes = scene.mesh.planes.iter().flatten();
    let absorbs = planes
        .into_iter()
        .any(|plane| *plane == PlaneCondition::Absorbing);
    let mortar = &scene.mortar;
    for (path, is, found) in [
        ("contacts", !scene.contacts.is_empty(), "contact"),
        (
            "mortar",
            !(mortar.boundaries.is_empty() && mortar.contacts.is_empty()),
            "mortar contact",
        ),
        ("surfaces", !scene.surfaces.is_empty(), "a rigid surface"),
        ("earthquake", scene.base_motion.is_some(), "a moving plane"),
        ("held_boxes", !scene.held_boxes.is_empty(), "a held box"),
        ("mesh.boundary_conditions", absorbs, "an absorbing plane"),
    ] {
        if is {
            let found = format!("{found} with `n_phases` 2");
            problems.add(path, found, "none: it is not covered for pore water yet");
        }
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        if body.motion.is_some() {
            problems.add(
                format!("bodies[{i}].prescribed_velocity"),
                "a prescribed motion with `n_phases` 2",
                "a body that moves freely",
            );
        }
        let mut porosities = scene
            .pore_water
            .iter()
            .flatten()
            .map(|water| water.porosity);
        let first = porosities.next();
        let alike = porosities.all(|porosity| Some(porosity) == first);
        let below_table = (scene.initial_pressures.iter())
            .all(|given| matches!(given, InitialPressure::Table { .. }));
        let by_weight = match body.initial_stress {
            InitialStress::None | InitialStress::Isotropic(_) => false,
            InitialStress::AtRest { .. } => !below_table,
            InitialStress::Overburden(_) => !(below_table && alike),
        };
        if by_weight {
            problems.add(
                format!("bodies[{i}].initial_stress"),
                "stress by the weight above with `n_phases` 2",
                "`isotropic` effective stress, or `at_rest` with one porosity and the pore pressures of a `water_table`",
            );
        }
    }
}
