//! The mesh from its keys.

use super::build::Build;
use super::keys::{RawMesh, RawPlanes};
use super::words::PLANE_CONDITIONS;
use proctor_scene::Mesh;

impl Build<'_> {
    /// The mesh; without cells where a key is missing, so that no position is compared with it.
    pub(super) fn mesh(&mut self, raw: Option<&RawMesh>) -> Mesh {
        let nowhere = Mesh::new(self.dimension, [f64::NAN; 3], [f64::NAN; 3], [0; 3]);
        let Some(raw) = raw else {
            self.missing(
                "mesh",
                "an object with `cells_dimension` and `cells_number`",
            );
            return nowhere;
        };
        let cell = self.vector(
            "mesh.cells_dimension",
            raw.cells_dimension.as_ref(),
            "the edges of a cell [m]",
        );
        let origin = self.vector_or_zero("mesh.origin", raw.origin.as_ref());
        let axes = self.dimension.axes();
        let cells = match &raw.cells_number {
            Some(cells) if self.length("mesh.cells_number", cells, axes) => {
                std::array::from_fn(|axis| cells.get(axis).copied().unwrap_or(1))
            }
            Some(_) => [0; 3],
            None => {
                self.missing(
                    "mesh.cells_number",
                    format!("the number of cells per axis, {axes} whole numbers"),
                );
                [0; 3]
            }
        };
        let mut mesh = Mesh::new(self.dimension, origin, cell, cells);
        mesh.axisymmetric = raw.axisymmetric.unwrap_or(false);
        if let Some(planes) = &raw.boundary_conditions {
            self.planes(planes, &mut mesh);
        }
        mesh
    }

    fn planes(&mut self, raw: &RawPlanes, mesh: &mut Mesh) {
        let planes = [
            ("plane_X0", 0, 0, &raw.x0),
            ("plane_Xn", 0, 1, &raw.xn),
            ("plane_Y0", 1, 0, &raw.y0),
            ("plane_Yn", 1, 1, &raw.yn),
            ("plane_Z0", 2, 0, &raw.z0),
            ("plane_Zn", 2, 1, &raw.zn),
        ];
        for (key, axis, side, word) in planes {
            let Some(word) = word else { continue };
            let path = format!("mesh.boundary_conditions.{key}");
            if axis >= self.dimension.axes() {
                self.add(path, "a plane of z in two dimensions", "planes of x and y");
            } else if let Some(condition) = self.word(&path, word, PLANE_CONDITIONS) {
                mesh.planes[axis][side] = condition;
            }
        }
    }
}
