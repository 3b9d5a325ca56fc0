//! A scene on coarser and finer meshes: what changes with the cell, what stays, and what cannot be refined.

use proctor_scene::{
    Dimension, Enforcement, MortarContact, PlaneCondition, Problem, Scene, Shape, TimeStep,
    Vertices,
};

/// Largest relative change of a cell where its number does not divide.
const MOST_CHANGE: f64 = 0.02;
/// Fewest cells across a body on the coarsest mesh.
const FEWEST_ACROSS: f64 = 2.0;
/// Cells across a body below which a note says so.
const FEW_ACROSS: f64 = 4.0;

/// The meshes of a refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meshes {
    /// Number of meshes, 3 at least.
    pub count: usize,
    /// Ratio of neighbouring cell sizes, above 1.
    pub ratio: f64,
    /// Number of meshes that are finer than the scene's own.
    pub finer: usize,
}

impl Meshes {
    /// Cell sizes over that of the scene, coarse to fine.
    #[must_use]
    pub fn factors(&self) -> Vec<f64> {
        let of = |k: usize| libm::pow(self.ratio, (self.count - 1 - k) as f64 - self.finer as f64);
        (0..self.count).map(of).collect()
    }

    /// The scenes, coarse to fine.
    ///
    /// # Errors
    /// Everything in the scene that cannot be refined.
    pub fn scenes(&self, scene: &Scene) -> Result<Vec<Scene>, Vec<Problem>> {
        let factors = self.factors();
        let mut problems = self.refused(scene, factors[0]);
        let mut scenes = vec![];
        for factor in factors {
            match self.on_mesh(scene, factor) {
                Ok(scene) => scenes.push(scene),
                Err(problem) if problems.iter().all(|known| known.path != problem.path) => {
                    problems.push(*problem);
                }
                Err(_) => {}
            }
        }
        if problems.is_empty() {
            Ok(scenes)
        } else {
            Err(problems)
        }
    }

    /// The scene on cells that are larger by a factor. Origin and far planes, particles per cell, loads and the Courant number
    /// stay; spacings of boundaries and a constant time step scale with the cell.
    fn on_mesh(&self, scene: &Scene, factor: f64) -> Result<Scene, Box<Problem>> {
        let mut scene = scene.clone();
        for axis in 0..scene.dimension.axes() {
            let mesh = &mut scene.mesh;
            let count = mesh.cells[axis] as f64 / factor;
            let nearest = count.round().max(1.0);
            let change = (nearest / count - 1.0).abs();
            if change < 1e-9 {
                mesh.cell[axis] *= mesh.cells[axis] as f64 / nearest;
                mesh.cells[axis] = nearest as usize;
            } else if mesh.planes[axis][1] == PlaneCondition::Free {
                // Nothing is at a free plane: it moves out by part of a cell.
                mesh.cell[axis] *= factor;
                mesh.cells[axis] = count.ceil() as usize;
            } else if change < MOST_CHANGE {
                mesh.cell[axis] *= mesh.cells[axis] as f64 / nearest;
                mesh.cells[axis] = nearest as usize;
            } else {
                return Err(self.does_not_divide(mesh.cells[axis], axis, count));
            }
        }
        if factor != 1.0 {
            if let TimeStep::Fixed { dt, .. } = &mut scene.time_step {
                *dt *= factor;
            }
            for boundary in &mut scene.mortar.boundaries {
                if let Vertices::Spacing(length) = &mut boundary.vertices {
                    *length *= factor;
                }
            }
        }
        Ok(scene)
    }

    /// A number of cells that the coarser meshes do not divide, and those nearby that they do.
    fn does_not_divide(&self, cells: usize, axis: usize, count: f64) -> Box<Problem> {
        let letter = ["x", "y", "z"][axis];
        let coarser = self.count - 1 - self.finer.min(self.count - 1);
        let multiple = libm::pow(self.ratio, coarser as f64);
        let fits = if multiple.fract() == 0.0 {
            let low = (cells as f64 / multiple).floor() * multiple;
            let below = if low > 0.0 {
                format!("{low} or ")
            } else {
                String::new()
            };
            format!("{below}{} cells along {letter}", low + multiple)
        } else {
            format!("another number of cells along {letter}")
        };
        Box::new(Problem::new(
            "mesh.cells_number",
            format!(
                "{cells} cells along {letter}, {} on one of the meshes",
                (1e3 * count).round() / 1e3
            ),
            format!("{fits}, `--finer {}`, or another --ratio", self.finer + 1),
        ))
    }

    /// Everything but the number of cells that cannot be refined.
    fn refused(&self, scene: &Scene, coarsest: f64) -> Vec<Problem> {
        let mut problems = vec![];
        for (index, body) in scene.bodies.iter().enumerate() {
            let path = format!("bodies[{index}]");
            if matches!(body.shape, Shape::Particles(_)) {
                problems.push(Problem::new(
                    path,
                    "a body from a list of particles, which no finer mesh can fill anew",
                    "bodies with a shape",
                ));
                continue;
            }
            let Some(across) = cells_across(scene, index, coarsest) else {
                continue;
            };
            if across < FEWEST_ACROSS {
                let missing = libm::log(FEWEST_ACROSS / across) / libm::log(self.ratio);
                let finer = self.finer + (missing - 1e-9).ceil().max(1.0) as usize;
                problems.push(Problem::new(
                    path,
                    format!("{across:.2} cells across it on the coarsest mesh"),
                    format!("{FEWEST_ACROSS} cells or more: `--finer {finer}`, or smaller cells"),
                ));
            }
        }
        for (index, material) in scene.materials.iter().enumerate() {
            let warnings = material.law.warnings();
            if warnings
                .iter()
                .any(|warning| warning.contains("crack_band"))
            {
                problems.push(Problem::new(
                    format!("materials[{index}]"),
                    "a law that softens without a length of its own: no mesh is fine enough",
                    "\"regularisation\": \"crack_band\", or strength that does not fall",
                ));
            }
        }
        problems
    }

    /// Cautions about a scene before it is refined; each a sentence without its end.
    #[must_use]
    pub fn notes(&self, scene: &Scene, offsets: usize) -> Vec<String> {
        let coarsest = self.factors()[0];
        let mut notes = vec![];
        let mut off_lines = vec![];
        let mut staircases = vec![];
        for (index, body) in scene.bodies.iter().enumerate() {
            match cells_across(scene, index, coarsest) {
                Some(across) if across < FEW_ACROSS => notes.push(format!(
                    "body {}: {across:.1} cells across it on the coarsest mesh are few",
                    body.id
                )),
                _ => {}
            }
            match &body.shape {
                Shape::Cuboid { p1, p2 } if !on_lines(scene, coarsest, &[*p1, *p2]) => {
                    off_lines.push(body.id.to_string());
                }
                Shape::Cuboid { .. } | Shape::Particles(_) => {}
                _ if body.motion.is_none() => staircases.push(body.id.to_string()),
                _ => {}
            }
        }
        if !off_lines.is_empty() {
            notes.push(format!(
                "edges of body {} lie between cell lines of the coarsest mesh: order 1 at best",
                off_lines.join(", ")
            ));
        }
        if !staircases.is_empty() {
            notes.push(format!(
                "particles fill body {} as a staircase: order 1 at best",
                staircases.join(", ")
            ));
        }
        let held = |held: &proctor_scene::HeldBox| !on_lines(scene, coarsest, &[held.p1, held.p2]);
        if scene.held_boxes.iter().any(held) {
            notes.push("edges of a held box lie between cell lines: order 1 at best".to_owned());
        }
        let given = |vertices: &Vertices| !matches!(vertices, Vertices::Spacing(_));
        if !scene.surfaces.is_empty()
            || !scene.mortar.facets.is_empty()
            || scene.mortar.boundaries.iter().any(|b| given(&b.vertices))
        {
            notes.push("boundaries of triangles or given points stay as they are".to_owned());
        }
        if !scene.point_loads.is_empty() {
            notes.push("a load on a node is singular: values near it do not converge".to_owned());
        }
        let is_barrier = |contact: &MortarContact| contact.enforcement == Enforcement::Barrier;
        let barrier = scene.mortar.contacts.iter().any(is_barrier);
        if barrier {
            notes.push("the gap of a barrier stays: the limit is that of the barrier".to_owned());
        }
        if !scene.contacts.is_empty() && offsets == 0 {
            notes.push(
                "contact on the grid may depend on where the mesh lies: use `--offsets 3`"
                    .to_owned(),
            );
        }
        notes
    }
}

/// Cells across the thinnest extent of a body that deforms, on a mesh whose cells are larger by a factor.
fn cells_across(scene: &Scene, body: usize, factor: f64) -> Option<f64> {
    let body = &scene.bodies[body];
    let axes = scene.dimension.axes();
    let width = match &body.shape {
        _ if body.motion.is_some() => return None,
        Shape::Ring { inner, outer, .. } => outer - inner,
        Shape::Cylinder { p1, p2, radius } => {
            let square: f64 = (0..3).map(|axis| (p2[axis] - p1[axis]).powi(2)).sum();
            square.sqrt().min(2.0 * radius)
        }
        shape => 2.0 * shape.half_size(scene.dimension),
    };
    let cells = (0..axes).map(|axis| scene.mesh.cell[axis] * factor);
    let largest = cells.fold(0.0, f64::max);
    // A body along a plane of antisymmetry or one cell wide is a problem in fewer dimensions.
    let one_cell_wide = scene.dimension == Dimension::Two && scene.mesh.cells[..axes].contains(&1);
    (width.is_finite() && !one_cell_wide).then_some(width / largest)
}

/// True if all coordinates lie on cell lines of a mesh whose cells are larger by a factor.
fn on_lines(scene: &Scene, factor: f64, corners: &[[f64; 3]]) -> bool {
    let on = |axis: usize, x: f64| {
        let cells = (x - scene.mesh.origin[axis]) / (scene.mesh.cell[axis] * factor);
        (cells - cells.round()).abs() < 1e-6
    };
    let axes = 0..scene.dimension.axes();
    axes.into_iter()
        .all(|axis| corners.iter().all(|corner| on(axis, corner[axis])))
}
