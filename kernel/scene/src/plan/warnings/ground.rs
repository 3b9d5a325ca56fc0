//! Ground that lies in the place of another body.

use super::places::name;
use crate::values::{Body, Scene};
use proctor_geometry::number::{Number, list};
use proctor_geometry::stratum::Stratum;
use proctor_kernel::model::Shape;
use std::borrow::Cow;

/// Share of the smaller volume below which an overlap is round-off.
const NEARLY: f64 = 1e-9;

/// Strata that overlap with another stratum or with a box, each with its volume and a place in it.
pub(super) fn overlaps(scene: &Scene) -> Vec<String> {
    let axes = scene.dimension.axes();
    let ground = |body: &'_ Body| matches!(body.shape, Shape::Stratum(_));
    let mut all = vec![];
    for (i, a) in scene.bodies.iter().enumerate() {
        for b in &scene.bodies[i + 1..] {
            if !(ground(a) || ground(b)) || is_apart(a, b, axes) {
                continue;
            }
            let (Some(first), Some(second)) = (as_ground(a, axes), as_ground(b, axes)) else {
                continue;
            };
            let common = first.common(&second);
            if common.volume() <= NEARLY * first.volume().min(second.volume()) {
                continue;
            }
            let Some(place) = common.place() else {
                continue;
            };
            let place: Vec<f64> = place[..axes]
                .iter()
                .map(|x| (1e6 * x).round() / 1e6)
                .collect();
            all.push(format!(
                "{} and {} overlap by {} m³, at {} m among other places: there the mass of both is in one place, twice as dense as \
                 it should be",
                name(a),
                name(b),
                Number((1e6 * common.volume()).round() / 1e6),
                list(&place)
            ));
        }
    }
    all
}

/// True if the boxes around two bodies share no volume.
fn is_apart(a: &Body, b: &Body, axes: usize) -> bool {
    let (Some(a), Some(b)) = (a.shape.bounds(), b.shape.bounds()) else {
        return true;
    };
    (0..axes).any(|axis| a[1][axis] <= b[0][axis] || b[1][axis] <= a[0][axis])
}

/// A stratum or a box as ground.
fn as_ground(body: &Body, axes: usize) -> Option<Cow<'_, Stratum>> {
    match &body.shape {
        Shape::Stratum(stratum) => Some(Cow::Borrowed(stratum)),
        Shape::Cuboid { p1, p2 } => Some(Cow::Owned(Stratum::of_box(axes, p1, p2))),
        _ => None,
    }
}
