//! The checked stage: every value of a scene against its accepted range, all problems at once.
//!
//! Paths are spelt with the keys of a scene file, so that one message serves library users and files alike.

mod body;
mod collector;
mod contact;
mod history;
mod load;
mod mortar;
mod results;
mod revolution;
mod standing;
mod strength;
mod surface;
mod water;

use self::collector::Collector;
use crate::values::{Scene, SceneError};
use proctor_geometry::number::Number;
use proctor_kernel::laws::{ConstantDefault, ConstantRange};
use proctor_kernel::layout::Variable;
use proctor_kernel::model::{
    Damping, Dimension, PlaneCondition, TimeStep, VolumetricStrain, Weighting,
};

impl Scene {
    /// Checks every value of the scene.
    ///
    /// # Errors
    /// All problems at once: values that are not finite or out of range, equal identifiers, references to
    /// materials that do not exist, bodies that are empty or leave the mesh, loads that are not on a node.
    pub fn check(&self) -> Result<(), SceneError> {
        let mut problems = Collector::new(self.dimension);
        problems.positive("time", self.time, "s");
        if let Some(until) = self.until {
            problems.positive("until.unbalanced_force", until, "");
        }
        self.check_method(&mut problems);
        problems.vector("gravity", &self.gravity);
        let mesh_is_sound = self.check_mesh(&mut problems);
        self.check_materials(mesh_is_sound, &mut problems);
        body::check(self, mesh_is_sound, &mut problems);
        load::check(self, mesh_is_sound, &mut problems);
        contact::check(self, &mut problems);
        mortar::check(self, &mut problems);
        surface::check(self, &mut problems);
        revolution::check(self, &mut problems);
        strength::check(self, &mut problems);
        water::check(self, &mut problems);
        standing::check(self, &mut problems);
        results::check(self, &mut problems);
        SceneError::unless_empty(problems.found)
    }

    fn check_method(&self, problems: &mut Collector) {
        match self.time_step {
            TimeStep::Automatic => {}
            TimeStep::Multiplier { multiplier, .. } => {
                problems.positive("critical_time_step_multiplier", multiplier, "");
            }
            TimeStep::Fixed { dt, .. } => {
                // Beyond 2^53 steps the time plus a step is the time.
                let least = self.time * f64::EPSILON;
                if dt > 0.0 && dt < least {
                    problems.add(
                        "time_step",
                        format!(
                            "{dt:e}, which is lost beside a time of {} s",
                            Number(self.time)
                        ),
                        format!("a number greater than {least:e} [s]"),
                    );
                } else if dt.is_finite() && self.time > 0.0 && dt > self.time {
                    problems.add(
                        "time_step",
                        format!(
                            "{}, which is longer than the time of {} s",
                            Number(dt),
                            Number(self.time)
                        ),
                        format!("a number, at most {} [s]", Number(self.time)),
                    );
                } else {
                    problems.positive("time_step", dt, "s");
                }
            }
        }
        problems.range("pic_fraction", self.transfer.pic_fraction, 0.0, 1.0);
        self.check_least_squares(problems);
        match self.damping {
            Damping::None | Damping::Kinetic => {}
            Damping::Local { alpha } => problems.range("damping.alpha", alpha, 0.0, 1.0),
            Damping::Viscous { alpha } => problems.not_negative("damping.alpha", alpha),
        }
        if self.threads == Some(0) {
            problems.add("n_threads", "0", "a whole number, 1 or more");
        }
    }

    /// Checks that gradients of least squares are derived for the rest of the method.
    fn check_least_squares(&self, problems: &mut Collector) {
        let transfer = self.transfer.kind.kind();
        if !transfer.least_squares {
            return;
        }
        if self.weighting != Weighting::QuadraticBSpline {
            let word = self.weighting.kind().word;
            problems.add(
                "transfer",
                format!("{} with {word}", transfer.word),
                format!(
                    "{} with `shape_function` \"quadratic_bspline\", or APIC",
                    transfer.word
                ),
            );
        }
        if self.volumetric_strain == VolumetricStrain::CellAverage {
            problems.add(
                "volumetric_strain",
                format!("cell_average with {}", transfer.word),
                "particle, or `transfer` APIC or TPIC: cell means are those of derivatives",
            );
        }
        if self.transfer.pic_fraction != 1.0 {
            problems.add(
                "pic_fraction",
                format!(
                    "{} with {}",
                    Number(self.transfer.pic_fraction),
                    transfer.word
                ),
                "1: its affine velocity carries the part that FLIP keeps in the particles",
            );
        }
    }

    /// Checks the mesh; whether positions can be compared with it.
    fn check_mesh(&self, problems: &mut Collector) -> bool {
        let before = problems.found.len();
        let mesh = &self.mesh;
        problems.vector("mesh.origin", &mesh.origin);
        for axis in 0..self.dimension.axes() {
            problems.positive(
                format!("mesh.cells_dimension[{axis}]"),
                mesh.cell[axis],
                "m",
            );
            if mesh.cells[axis] == 0 {
                problems.add(
                    format!("mesh.cells_number[{axis}]"),
                    "0",
                    "a whole number, 1 or more",
                );
            }
        }
        if self.dimension == Dimension::Two
            && (mesh.cells[2] != 1
                || mesh.cell[2] != 1.0
                || mesh.planes[2] != [PlaneCondition::Free; 2])
        {
            problems.add(
                "mesh",
                "a third axis",
                "one cell of 1 m with free planes along the third axis in two dimensions, as `Mesh::new` makes it",
            );
        }
        let nodes = mesh
            .cells
            .iter()
            .try_fold(1_usize, |n, &cells| n.checked_mul(cells.checked_add(1)?));
        // A node number has 32 bits in files and in stencils; a mesh beyond that does not fit into memory either.
        if nodes.is_none_or(|n| u32::try_from(n).is_err()) {
            problems.add(
                "mesh.cells_number",
                format!("{:?}", mesh.cells),
                format!("a mesh of at most {} nodes", u32::MAX),
            );
        }
        if problems.found.len() == before && mesh.upper().iter().any(|x| !x.is_finite()) {
            problems.add("mesh", "an upper corner that is not finite", "finite edges");
        }
        problems.found.len() == before
    }

    fn check_materials(&self, mesh_is_sound: bool, problems: &mut Collector) {
        if self.materials.is_empty() {
            problems.add("materials", "none", "at least one material");
        }
        for (i, material) in self.materials.iter().enumerate() {
            let path = format!("materials[{i}]");
            problems.positive(format!("{path}.density"), material.density, "kg/m³");
            let constants = material.law.constants();
            let taken_from = |key: &str| constants.iter().find(|(other, _)| other.key == key);
            for (constant, value) in &constants {
                // What is no more than a copy of another constant is told once, for that one.
                if let ConstantDefault::As(key) = constant.given
                    && taken_from(key).is_some_and(|(_, other)| other.to_bits() == value.to_bits())
                {
                    continue;
                }
                let value = *value;
                let path = format!("{path}.{}", constant.key);
                match constant.accepted {
                    ConstantRange::Positive => problems.positive(path, value, constant.unit),
                    accepted if accepted.holds(value) => {}
                    _ => problems.add(path, Number(value).to_string(), constant.words()),
                }
            }
            let in_cells = mesh_is_sound.then(|| material.law.in_cells(self.size_of_cell()));
            let law = in_cells.flatten().unwrap_or_else(|| material.law.clone());
            for unfit in law.problems() {
                problems.add(format!("{path}.{}", unfit.key), unfit.found, unfit.accepted);
            }
            if let Some(twice) = named_twice(material.law.variables()) {
                problems.add(
                    format!("{path}.law"),
                    format!(
                        "{}, whose internal variable {twice:?} is there twice",
                        material.law.name()
                    ),
                    "internal variables of different names",
                );
            }
            if let Some(first) = self.materials[..i].iter().position(|m| m.id == material.id) {
                problems.add(
                    format!("{path}.id"),
                    format!(
                        "{}, the id of {} too",
                        material.id, self.materials[first].name
                    ),
                    "an id that no other material has",
                );
            }
        }
    }
}

/// The first name that two internal variables, or components of them, have.
fn named_twice(variables: &[Variable]) -> Option<String> {
    let of = |variable: &Variable| {
        let variable = *variable;
        (0..variable.components).map(move |i| variable.component(i))
    };
    let mut names: Vec<String> = variables.iter().flat_map(of).collect();
    names.sort_unstable();
    let twice = names.windows(2).find(|pair| pair[0] == pair[1])?;
    Some(twice[0].clone())
}
