//! Pore water from its keys.

use super::build::Build;
use super::keys::{RawPressureBox, RawScene, RawWaterLevels, RawWaterPlanes, RawWaterPressures};
use super::lists::NumberOrTable;
use super::material_keys::RawMaterial;
use super::materials::entry_path;
use super::words::{PERMEABILITIES, PLANES, WATER_CONDITIONS};
use proctor_scene::{
    HeldPressure, History, InitialPressure, PlaneCondition, PlanePressure, PoreWater, Scene, Shore,
    StandingWater,
};

/// Names of the planes, with the axis of their normal and their side.
const PLANES_OF_WATER: [(&str, usize, usize); 6] = [
    ("plane_X0", 0, 0),
    ("plane_Xn", 0, 1),
    ("plane_Y0", 1, 0),
    ("plane_Yn", 1, 1),
    ("plane_Z0", 2, 0),
    ("plane_Zn", 2, 1),
];

/// Gravity for which conductivities are given \[m/s²\].
const GRAVITY: f64 = 9.81;

/// Density of water that stands beside bodies, where none is given \[kg/m³\].
const WATER: f64 = 1000.0;

/// The words for a pore pressure that is missing.
const PORE_PRESSURE: &str = "the pore pressure, a number [Pa]";

impl Build<'_> {
    /// The water of all materials, where there are two phases.
    pub(super) fn water(&mut self, raw: &RawScene, scene: &mut Scene) {
        let given = raw.material.as_ref().map(|entries| ("material", entries));
        let given = given.or(raw.materials.as_ref().map(|entries| ("materials", entries)));
        let two = match raw.n_phases {
            None | Some(1) => false,
            Some(2) => true,
            Some(other) => {
                self.add_choice("n_phases", other.to_string(), "1 or 2");
                return;
            }
        };
        if !two {
            self.refuse_water_of_one_phase(
                raw,
                given.iter().flat_map(|(key, entries)| {
                    let all = entries.0.iter().enumerate();
                    all.map(|(i, (name, raw))| (entry_path(key, i, name.as_deref()), raw))
                }),
            );
            return;
        }
        if let Some((key, entries)) = given {
            for (i, (name, raw)) in entries.0.iter().enumerate() {
                let path = entry_path(key, i, name.as_deref());
                let water = self.water_of(&path, raw);
                scene.pore_water.push(Some(water));
            }
        }
        let planes = raw.mesh.as_ref();
        if let Some(planes) = planes.and_then(|mesh| mesh.boundary_conditions_fluid.as_ref()) {
            let words = [
                &planes.x0, &planes.xn, &planes.y0, &planes.yn, &planes.z0, &planes.zn,
            ];
            for ((key, axis, side), word) in PLANES_OF_WATER.into_iter().zip(words) {
                let Some(word) = word else { continue };
                let path = format!("mesh.boundary_conditions_fluid.{key}");
                if axis >= self.dimension.axes() {
                    self.add(path, "a plane of z in two dimensions", "planes of x and y");
                } else if let Some(condition) = self.word(&path, word, WATER_CONDITIONS) {
                    scene.water_planes[axis][side] = condition;
                }
            }
        }
        let given = planes.and_then(|mesh| mesh.boundary_pressures_fluid.as_ref());
        if let Some(given) = given {
            let named = planes.and_then(|mesh| mesh.boundary_conditions_fluid.as_ref());
            self.plane_pressures(given, named, scene);
        }
        let given = planes.and_then(|mesh| mesh.boundary_levels_fluid.as_ref());
        if let Some(given) = given {
            let named = planes.and_then(|mesh| mesh.boundary_conditions_fluid.as_ref());
            self.plane_levels(given, named, scene);
        }
        if let Some(level) = raw.water_table {
            scene
                .initial_pressures
                .push(InitialPressure::Table { level });
        }
        self.pressures(raw, scene);
        self.held_pressures(raw, scene);
    }

    /// Planes at which a pressure is given.
    fn plane_pressures(
        &mut self,
        given: &RawWaterPressures,
        named: Option<&RawWaterPlanes>,
        scene: &mut Scene,
    ) {
        let all = [given.x0, given.xn, given.y0, given.yn, given.z0, given.zn];
        let all = all.map(|pressure| pressure.map(PlanePressure::Uniform));
        self.pressed_planes("boundary_pressures_fluid", all, named, scene);
    }

    /// Planes beyond which water stands.
    fn plane_levels(
        &mut self,
        given: &RawWaterLevels,
        named: Option<&RawWaterPlanes>,
        scene: &mut Scene,
    ) {
        let all = [
            &given.x0, &given.xn, &given.y0, &given.yn, &given.z0, &given.zn,
        ];
        let mut levels = all.map(|_| None);
        for (i, level) in all.into_iter().enumerate() {
            let Some(level) = level else { continue };
            let path = format!("mesh.boundary_levels_fluid.{}", PLANES_OF_WATER[i].0);
            levels[i] = Some(PlanePressure::Level(self.level(&path, level)));
        }
        self.pressed_planes("boundary_levels_fluid", levels, named, scene);
    }

    /// Waters that stand beside bodies.
    pub(super) fn standing_waters(&mut self, raw: &RawScene, scene: &mut Scene) {
        for (i, raw) in raw.standing_water.iter().flatten().enumerate() {
            let key = |key: &str| format!("standing_water[{i}].{key}");
            let level = if let Some(level) = &raw.level {
                self.level(&key("level"), level)
            } else {
                let accepted = "the level [m], or rows of a time [s] and a level";
                self.missing(key("level"), accepted);
                [f64::NAN, 0.0, 0.0].into()
            };
            let side = raw.side.as_ref();
            let side = side.and_then(|word| self.word(&key("side"), word, PLANES));
            let shore = match (side, raw.between.as_deref()) {
                (Some((axis, side)), Some(between)) => {
                    self.length(&key("between"), between, 2).then(|| Shore {
                        axis,
                        side,
                        between: [between[0], between[1]],
                    })
                }
                (Some(_), None) => {
                    let accepted = "two coordinates between which the pressure fades [m]";
                    self.missing(key("between"), accepted);
                    None
                }
                (None, Some(_)) if raw.side.is_none() => {
                    self.missing(key("side"), "the side on which the water stands");
                    None
                }
                (None, _) => None,
            };
            scene.standing_waters.push(StandingWater {
                level,
                density: raw.density.unwrap_or(WATER),
                bodies: raw.body_ids.clone().unwrap_or_default(),
                shore,
            });
        }
    }

    /// A level of water over time, in the first component.
    fn level(&mut self, path: &str, given: &NumberOrTable) -> History {
        let rows = match given {
            NumberOrTable::Number(level) => return [*level, 0.0, 0.0].into(),
            NumberOrTable::Table(rows) => rows,
        };
        let mut history = History {
            times: vec![],
            values: vec![],
        };
        for (i, row) in rows.iter().enumerate() {
            if self.length(&format!("{path}[{i}]"), row, 2) {
                history.times.push(row[0]);
                history.values.push([row[1], 0.0, 0.0]);
            }
        }
        history
    }

    /// Planes at which a key gives the pressure, and that are free for the water unless they are named otherwise.
    fn pressed_planes(
        &mut self,
        key: &str,
        given: [Option<PlanePressure>; 6],
        named: Option<&RawWaterPlanes>,
        scene: &mut Scene,
    ) {
        let named = named.map_or([false; 6], |planes| {
            [
                &planes.x0, &planes.xn, &planes.y0, &planes.yn, &planes.z0, &planes.zn,
            ]
            .map(Option::is_some)
        });
        let all = given.into_iter().zip(PLANES_OF_WATER).zip(named);
        for ((pressure, (plane, axis, side)), is_named) in all {
            if pressure.is_none() {
                continue;
            }
            let path = format!("mesh.{key}.{plane}");
            if axis >= self.dimension.axes() {
                self.add(path, "a plane of z in two dimensions", "planes of x and y");
                continue;
            }
            if scene.water_pressures[axis][side].is_some() {
                self.add(
                    path,
                    "a level at a plane that has a pressure",
                    "one of `boundary_pressures_fluid` and `boundary_levels_fluid`",
                );
                continue;
            }
            scene.water_pressures[axis][side] = pressure;
            if !is_named {
                scene.water_planes[axis][side] = PlaneCondition::Free;
            }
        }
    }

    fn pressures(&mut self, raw: &RawScene, scene: &mut Scene) {
        let key = "initial_pressure_material";
        for (i, (name, raw)) in raw
            .initial_pressure_material
            .iter()
            .flat_map(|all| &all.0)
            .enumerate()
        {
            let path = entry_path(key, i, name.as_deref());
            self.spelt(
                format!("initial_pressures[{}]", scene.initial_pressures.len()),
                path.clone(),
            );
            let id = raw.material_id.unwrap_or_else(|| {
                self.missing(format!("{path}.material_id"), "the `id` of a material");
                i64::MIN
            });
            let pressure = self.number(&format!("{path}.pressure"), raw.pressure, PORE_PRESSURE);
            scene
                .initial_pressures
                .push(InitialPressure::Material { id, pressure });
        }
        for (i, (name, raw)) in raw
            .initial_pressure_box
            .iter()
            .flat_map(|all| &all.0)
            .enumerate()
        {
            let path = entry_path("initial_pressure_box", i, name.as_deref());
            self.spelt(
                format!("initial_pressures[{}]", scene.initial_pressures.len()),
                path.clone(),
            );
            let ([p1, p2], pressure) = self.pressure_box(&path, raw);
            scene
                .initial_pressures
                .push(InitialPressure::Box { p1, p2, pressure });
        }
    }

    /// Pore pressures that particles keep.
    fn held_pressures(&mut self, raw: &RawScene, scene: &mut Scene) {
        let all = raw.prescribed_pressure_box.iter().flat_map(|all| &all.0);
        for (i, (name, raw)) in all.enumerate() {
            let path = entry_path("prescribed_pressure_box", i, name.as_deref());
            self.spelt(format!("held_pressures[{i}]"), path.clone());
            let ([p1, p2], pressure) = self.pressure_box(&path, raw);
            (scene.held_pressures).push(HeldPressure { p1, p2, pressure });
        }
    }

    /// The corners of a box and the pore pressure in it.
    fn pressure_box(&mut self, path: &str, raw: &RawPressureBox) -> ([[f64; 3]; 2], f64) {
        let key = |key: &str| format!("{path}.{key}");
        let (lower, upper) = ("the lower corner [m]", "the upper corner [m]");
        let p1 = self.vector(&key("point_p1"), raw.point_p1.as_ref(), lower);
        let p2 = self.vector(&key("point_p2"), raw.point_p2.as_ref(), upper);
        let pressure = self.number(&key("pressure"), raw.pressure, PORE_PRESSURE);
        ([p1, p2], pressure)
    }

    fn water_of(&mut self, path: &str, raw: &RawMaterial) -> PoreWater {
        let key = |key: &str| format!("{path}.{key}");
        let accepted = "a number greater than 0 and less than 1";
        let conductivity = raw.hydraulic_conductivity.as_ref();
        let law = raw.permeability.as_ref();
        let law = law.and_then(|word| self.word(&key("permeability"), word, PERMEABILITIES));
        PoreWater {
            porosity: self.number(&key("porosity"), raw.porosity, accepted),
            // That of the material.
            grain_density: f64::NAN,
            density: self.number(
                &key("density_fluid"),
                raw.density_fluid,
                "a number greater than 0 [kg/m³]",
            ),
            bulk: self.number(
                &key("bulk_fluid"),
                raw.bulk_fluid,
                "a number greater than 0 [Pa]",
            ),
            conductivity: self.vector(
                &key("hydraulic_conductivity"),
                conductivity,
                "the hydraulic conductivity [m/s]",
            ),
            permeability: law.unwrap_or_default(),
            conductivity_gravity: raw.conductivity_gravity.unwrap_or(GRAVITY),
        }
    }

    /// Keys of water where there is one phase.
    fn refuse_water_of_one_phase<'m>(
        &mut self,
        raw: &RawScene,
        materials: impl Iterator<Item = (String, &'m RawMaterial)>,
    ) {
        let mut paths = vec![];
        for (path, raw) in materials {
            for (key, is) in [
                ("porosity", raw.porosity.is_some()),
                ("density_fluid", raw.density_fluid.is_some()),
                ("bulk_fluid", raw.bulk_fluid.is_some()),
                (
                    "hydraulic_conductivity",
                    raw.hydraulic_conductivity.is_some(),
                ),
                ("conductivity_gravity", raw.conductivity_gravity.is_some()),
                ("permeability", raw.permeability.is_some()),
            ] {
                if is {
                    paths.push(format!("{path}.{key}"));
                }
            }
        }
        let mesh = raw.mesh.as_ref();
        for (path, is) in [
            (
                "mesh.boundary_conditions_fluid",
                mesh.is_some_and(|mesh| mesh.boundary_conditions_fluid.is_some()),
            ),
            (
                "mesh.boundary_pressures_fluid",
                mesh.is_some_and(|mesh| mesh.boundary_pressures_fluid.is_some()),
            ),
            (
                "mesh.boundary_levels_fluid",
                mesh.is_some_and(|mesh| mesh.boundary_levels_fluid.is_some()),
            ),
            ("water_table", raw.water_table.is_some()),
            (
                "initial_pressure_material",
                raw.initial_pressure_material.is_some(),
            ),
            ("initial_pressure_box", raw.initial_pressure_box.is_some()),
            (
                "prescribed_pressure_box",
                raw.prescribed_pressure_box.is_some(),
            ),
        ] {
            if is {
                paths.push(path.to_owned());
            }
        }
        for path in paths {
            self.add(
                path,
                "a key of pore water in a scene of one phase",
                "no such key, or `n_phases` 2",
            );
        }
    }
}
