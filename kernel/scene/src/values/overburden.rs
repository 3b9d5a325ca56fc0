//! Ground at rest below a surface: the weight of the layers above each point.

use proctor_geometry::sheet::{PlanPoint, Sheet};
use proctor_geometry::stratum::Stratum;
use proctor_kernel::model::Vector;
use std::sync::Arc;

/// Ground at rest: the weight above a point along the last axis, and a share of it across.
#[derive(Clone, Debug, PartialEq)]
pub struct Overburden {
    /// Coefficient of earth pressure at rest, K_0.
    pub ratio: f64,
    /// Pressure on the surface \[Pa\].
    pub surcharge: f64,
    /// Surface of the ground.
    pub surface: Sheet,
    /// The ground below it, with its densities \[kg/m³\]. It is the same for all parts of a body.
    pub ground: Arc<Vec<(Stratum, f64)>>,
}

impl Overburden {
    /// The stress xx, yy, zz, yz, xz, xy at a point \[Pa\], for gravity \[m/s²\] along the last axis of so many; above the
    /// surface there is none.
    #[must_use]
    pub fn at(&self, x: &Vector, gravity: &Vector, axes: usize) -> [f64; 6] {
        let last = axes - 1;
        let at: PlanPoint = if axes == 2 { [x[0], 0.5] } else { [x[0], x[1]] };
        if self.surface.height(at).is_none_or(|level| x[last] > level) {
            return [0.0; 6];
        }
        let mut intervals = vec![];
        let mut mass = 0.0;
        for (stratum, density) in self.ground.iter() {
            stratum.intervals(at, &mut intervals);
            for [low, high] in intervals.drain(..) {
                mass += density * (high - low.max(x[last])).max(0.0);
            }
        }
        let along = -self.surcharge - mass * gravity[last].abs();
        let across = self.ratio * along;
        let mut stress = [across, across, across, 0.0, 0.0, 0.0];
        stress[last] = along;
        stress
    }
}
