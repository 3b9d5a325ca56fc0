//! Boxes between driven walls that act at nodes.

use super::places::name;
use super::poisson;
use super::resting::{Rest, all};
use crate::values::Scene;
use proctor_kernel::model::{Damping, StressScheme, Weighting};
use proctor_kernel::plan::scheme_word;

/// Poisson's ratio from which walls carry so much that what goes on at them is felt in the rows between.
const FELT: f64 = 1.0 / 3.0;

/// Boxes between standing driven bodies whose faces lie on lines of the mesh, under local damping.
///
/// With MUSL and USF such walls act at nodes. Forces there balance from step to step, not within each: local damping, which takes a
/// share of what is out of balance, does not bring them to rest. Of 19 columns of ground so (`proctor verify --generated 10000`,
/// question `walls`, seeds 1 and 2) 4 were off by 5 to 15 % of the stress at the base, and 10 did not come to rest; of the 94 others on
/// lines none was off, of 430 with faces within cells none. With USL and domains (uGIMP or cpGIMP) their edges pass a line to and fro:
/// one of three was off, by 6 %, and right with its faces moved by a twentieth of a cell.
pub(super) fn at_nodes(scene: &Scene) -> Vec<String> {
    let local = matches!(scene.damping, Damping::Local { alpha } if alpha > 0.0);
    let usl = scene.scheme == StressScheme::Usl;
    if !local || (usl && scene.weighting == Weighting::QuadraticBSpline) {
        return vec![];
    }
    let of = |rest: &Rest<'_>| {
        let material = scene.materials.get(rest.body.material)?;
        let confined = material.law.wave_speed(1.0).powi(2);
        let ratio = poisson(confined / material.law.young());
        (ratio > FELT && rest.is_between_driven(scene) && rest.on_a_line(scene)).then(|| {
            format!(
                "{}: it stands between driven bodies with its faces on lines of the mesh. With {} and local damping, contact on \
                 such lines leaves rows of particles off by 5 to 15 % of the largest stress in one of seven scenes with a Poisson's \
                 ratio above 1/3, here {ratio:.3}; faces within cells, a tenth of a cell from a line, keep them within 2 %",
                name(rest.body),
                scheme_word(scene.scheme)
            )
        })
    };
    all(scene).iter().filter_map(of).collect()
}
