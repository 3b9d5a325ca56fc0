//! Bodies that lie anywhere on the mesh: what a method is predicted and measured with.

use proctor_scene::{Dimension, Mesh, PlaneCondition, Scene, Vector, Weighting};

use super::StabilityError;
use super::predicted::predict;
use crate::cases::{NO_RESULTS, body, cuboid, elastic};
use crate::settings::{Method, Settings};

/// Edge of the largest body in cells. Larger ones have longer steps.
const CELLS: f64 = 3.0;
/// A hair's breadth past a node or a face, in cells.
pub const HAIR: f64 = 1e-6;
/// Parts of a cell at which a body may begin.
const PARTS: u32 = 12;
/// Poisson's ratio.
const POISSON: f64 = 0.3;

/// A method with its resolution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Method.
    pub method: Method,
    /// Number of dimensions.
    pub dimension: Dimension,
    /// Particles per cell and axis.
    pub particles_per_cell: usize,
}

/// Shape of a body. Small and thin ones weigh little at the nodes that carry them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A square or a cube; its side in quarters of a cell.
    Block(u8),
    /// One particle thick, three cells along the other axes.
    Plate,
    /// One particle thick along two axes (3D).
    Rod,
    /// One particle.
    Particle,
}

/// A form at a place on the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The form.
    pub form: Form,
    /// Start of the block, in cells past a node, along all axes alike: the corners of a body are lightest where all its sides
    /// are.
    pub offset: f64,
}

/// A place, and what is predicted there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Predicted c dt / h.
    pub courant: f64,
    /// The place.
    pub place: Place,
}

impl Form {
    /// The block that is so large that its corners, faces and edges do not know of each other.
    pub const LARGE: Self = Self::Block(12);

    /// The forms of so many dimensions that so many particles per cell and axis can make.
    #[must_use]
    pub fn all(dimension: Dimension, particles_per_cell: usize) -> Vec<Self> {
        let fits = |quarters: &u8| (usize::from(*quarters) * particles_per_cell).is_multiple_of(4);
        let blocks = [12, 8, 7, 6, 5, 4].into_iter().filter(fits);
        let thin: &[Self] = match dimension {
            Dimension::Two => &[Self::Plate, Self::Particle],
            Dimension::Three => &[Self::Plate, Self::Rod, Self::Particle],
        };
        blocks
            .map(Self::Block)
            .chain(thin.iter().copied())
            .collect()
    }

    /// Its words.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Self::Block(quarters) => format!("block of {}", f64::from(quarters) / 4.0),
            Self::Plate => "plate".to_owned(),
            Self::Rod => "rod".to_owned(),
            Self::Particle => "particle".to_owned(),
        }
    }

    /// True if it is more than a cell thick along all axes.
    #[must_use]
    pub fn is_thick(self) -> bool {
        matches!(self, Self::Block(quarters) if quarters > 4)
    }

    /// Its edge along an axis of so many, in cells, with particles so far apart.
    fn edge(self, axis: usize, axes: usize, spacing: f64) -> f64 {
        let thin_axes = match self {
            Self::Block(quarters) => return f64::from(quarters) / 4.0,
            Self::Plate => 1,
            Self::Rod => 2,
            Self::Particle => axes,
        };
        if axis + thin_axes < axes {
            CELLS
        } else {
            spacing
        }
    }
}

/// Offsets with the faces or the outermost particles of a body at every twelfth of a cell, and a hair past a node on either
/// side. The thirteen of which the first is zero are those of the faces.
#[must_use]
pub fn offsets(particles_per_cell: usize) -> Vec<f64> {
    let half = 0.5 / particles_per_cell as f64;
    let mut all: Vec<f64> = (0..PARTS)
        .map(|k| f64::from(k) / f64::from(PARTS))
        .collect();
    all.extend([HAIR, 1.0 - HAIR]);
    // A first particle on a node, and a hair past and before it; a last one so.
    all.extend([
        1.0 - half,
        1.0 - half + HAIR,
        1.0 - half - HAIR,
        half + HAIR,
        half - HAIR,
    ]);
    all
}

impl Choice {
    /// A body in a mesh of cells of 1 m without a plane near it; waves run at 1 m/s, the density is 1 kg/m³.
    #[must_use]
    pub fn scene(&self, place: Place) -> Scene {
        let axes = self.dimension.axes();
        let mut mesh = Mesh::new(self.dimension, [0.0; 3], [1.0; 3], [CELLS as usize + 6; 3]);
        mesh.planes[..axes].fill([PlaneCondition::Free; 2]);
        let spacing = 1.0 / self.particles_per_cell as f64;
        let corner = |upper: bool| -> Vector {
            std::array::from_fn(|axis| {
                let edge = place.form.edge(axis, axes, spacing);
                match (axis < axes, upper) {
                    (false, _) => 0.0,
                    (true, false) => 2.0 + place.offset,
                    (true, true) => 2.0 + place.offset + edge,
                }
            })
        };
        let mut scene = Scene::new(self.dimension, mesh, 1e9);
        // E of a confined modulus of 1.
        let young = (1.0 + POISSON) * (1.0 - 2.0 * POISSON) / (1.0 - POISSON);
        scene.materials = elastic(1.0, young, POISSON);
        scene.bodies = vec![body("body", 1, cuboid(corner(false), corner(true)))];
        scene.results = NO_RESULTS;
        let settings = Settings {
            particles_per_cell: self.particles_per_cell,
            ..Settings::new(self.method)
        };
        settings.apply(&mut scene);
        scene
    }

    /// The predicted Courant number at a place; infinite where nothing can become unstable.
    ///
    /// # Errors
    /// As [`predict`].
    pub fn predict(&self, place: Place) -> Result<f64, StabilityError> {
        let limit = predict(&self.scene(place))?;
        Ok(limit.map_or(f64::INFINITY, |limit| limit.courant))
    }

    /// True if a particle lies on a node at an offset, where a linear function has one gradient on the left and another on the
    /// right: there is no linear step then.
    #[must_use]
    pub fn is_on_node(&self, offset: f64) -> bool {
        let spacings = offset * self.particles_per_cell as f64 - 0.5;
        self.method.weighting == Weighting::Linear
            && (spacings - spacings.round()).abs() < 0.1 * HAIR
    }

    /// The smallest predicted Courant number of a form over all offsets at which there is a linear step.
    ///
    /// # Errors
    /// As [`predict`].
    pub fn worst_of(&self, form: Form) -> Result<Worst, StabilityError> {
        let mut worst = Worst {
            courant: f64::INFINITY,
            place: Place { form, offset: 0.0 },
        };
        let all = offsets(self.particles_per_cell);
        for offset in all.into_iter().filter(|&o| !self.is_on_node(o)) {
            let place = Place { form, offset };
            let courant = self.predict(place)?;
            if courant < worst.courant {
                worst = Worst { courant, place };
            }
        }
        Ok(worst)
    }
}
