//! Views of particles: the plane as it is, space from one direction without perspective.

/// A direction to look from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Angle about the vertical axis, from x towards y \[degrees\].
    pub azimuth: f64,
    /// Angle above the horizontal plane \[degrees\].
    pub elevation: f64,
}

impl Default for View {
    fn default() -> Self {
        Self {
            azimuth: -60.0,
            elevation: 25.0,
        }
    }
}

impl View {
    /// Parses `AZIMUTH,ELEVATION` in degrees.
    ///
    /// # Errors
    /// The accepted form.
    pub fn parse(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[azimuth, elevation])
                if azimuth.abs() <= 360.0 && (-90.0..=90.0).contains(&elevation) =>
            {
                Ok(Self { azimuth, elevation })
            }
            _ => Err(format!(
                "found {text:?}; accepted: AZIMUTH,ELEVATION in degrees, from -360 to 360 and from -90 to 90"
            )),
        }
    }

    /// The projection of space onto the picture.
    #[must_use]
    pub fn projection(self) -> Projection {
        let (sin_a, cos_a) = self.azimuth.to_radians().sin_cos();
        let (sin_e, cos_e) = self.elevation.to_radians().sin_cos();
        Projection {
            right: [-sin_a, cos_a, 0.0],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
            near: [cos_e * cos_a, cos_e * sin_a, sin_e],
        }
    }
}

/// Three directions at right angles: to the right and up in the picture, and out of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    right: [f64; 3],
    up: [f64; 3],
    near: [f64; 3],
}

impl Projection {
    /// The plane x-y as it is.
    pub const PLANE: Self = Self {
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        near: [0.0, 0.0, 1.0],
    };

    /// Place of a point in the picture \[m\], to the right and up.
    #[must_use]
    pub fn place(&self, point: &[f64; 3]) -> [f64; 2] {
        [dot(&self.right, point), dot(&self.up, point)]
    }

    /// Nearness of a point; of two points the nearer one hides the other.
    #[must_use]
    pub fn nearness(&self, point: &[f64; 3]) -> f64 {
        dot(&self.near, point)
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
