//! Pore water from its keys.

use super::build::Build;
use super::keys::{RawScene, RawWaterPlanes, RawWaterPressures};
use super::material_keys::RawMaterial;
use super::materials::entry_path;
use super::words::{PERMEABILITIES, WATER_CONDITIONS};
use proctor_scene::{InitialPressure, PlaneCondition, PoreWater, Scene};

/// Gravity for which conductivities are given \[m/s²\].
const GRAVITY: f64 = 9.81;

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
            for (key, axis, side, word) in [
                ("plane_X0", 0, 0, &planes.x0),
                ("plane_Xn", 0, 1, &planes.xn),
                ("plane_Y0", 1, 0, &planes.y0),
                ("plane_Yn", 1, 1, &planes.yn),
                ("plane_Z0", 2, 0, &planes.z0),
                ("plane_Zn", 2, 1, &planes.zn),
            ] {
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
        if let Some(level) = raw.water_table {
            scene
                .initial_pressures
                .push(InitialPressure::Table { level });
        }
        self.pressures(raw, scene);
    }

    /// Planes at which a pressure is given, and that are free for the water unless they are named otherwise.
    fn plane_pressures(
        &mut self,
        given: &RawWaterPressures,
        named: Option<&RawWaterPlanes>,
        scene: &mut Scene,
    ) {
        let word = |of: fn(&RawWaterPlanes) -> &Option<String>| {
            named.is_some_and(|planes| of(planes).is_some())
        };
        for (key, axis, side, pressure, is_named) in [
            ("plane_X0", 0, 0, given.x0, word(|planes| &planes.x0)),
            ("plane_Xn", 0, 1, given.xn, word(|planes| &planes.xn)),
            ("plane_Y0", 1, 0, given.y0, word(|planes| &planes.y0)),
            ("plane_Yn", 1, 1, given.yn, word(|planes| &planes.yn)),
            ("plane_Z0", 2, 0, given.z0, word(|planes| &planes.z0)),
            ("plane_Zn", 2, 1, given.zn, word(|planes| &planes.zn)),
        ] {
            if pressure.is_none() {
                continue;
            }
            if axis >= self.dimension.axes() {
                let path = format!("mesh.boundary_pressures_fluid.{key}");
                self.add(path, "a plane of z in two dimensions", "planes of x and y");
                continue;
            }
            scene.water_pressures[axis][side] = pressure;
            if !is_named {
                scene.water_planes[axis][side] = PlaneCondition::Free;
            }
        }
    }

    fn pressures(&mut self, raw: &RawScene, scene: &mut Scene) {
        let accepted = "the pore pressure, a number [Pa]";
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
            let pressure = self.number(&format!("{path}.pressure"), raw.pressure, accepted);
            scene
                .initial_pressures
                .push(InitialPressure::Material { id, pressure });
        }
        let key = "initial_pressure_box";
        for (i, (name, raw)) in raw
            .initial_pressure_box
            .iter()
            .flat_map(|all| &all.0)
            .enumerate()
        {
            let path = entry_path(key, i, name.as_deref());
            self.spelt(
                format!("initial_pressures[{}]", scene.initial_pressures.len()),
                path.clone(),
            );
            let key = |key: &str| format!("{path}.{key}");
            let p1 = self.vector(
                &key("point_p1"),
                raw.point_p1.as_ref(),
                "the lower corner [m]",
            );
            let p2 = self.vector(
                &key("point_p2"),
                raw.point_p2.as_ref(),
                "the upper corner [m]",
            );
            let pressure = self.number(&key("pressure"), raw.pressure, accepted);
            scene
                .initial_pressures
                .push(InitialPressure::Box { p1, p2, pressure });
        }
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
            ("water_table", raw.water_table.is_some()),
            (
                "initial_pressure_material",
                raw.initial_pressure_material.is_some(),
            ),
            ("initial_pressure_box", raw.initial_pressure_box.is_some()),
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
