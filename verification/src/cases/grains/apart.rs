//! The gap between grains: no vertex in another grain, none beyond plate, floor or walls.
//!
//! Found from where the vertices are, without the gaps of the contact.

/// A grain or a rigid line as a polyline \[m\].
pub type Polyline = Vec<[f64; 3]>;

/// The free space between left wall, right wall, floor and plate \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Smallest and largest x.
    pub x: [f64; 2],
    /// Floor and plate.
    pub y: [f64; 2],
}

impl Room {
    /// Distance of a point from the nearest side \[m\]; negative beyond it.
    fn distance(&self, p: &[f64; 3]) -> f64 {
        let [along, up] = [(self.x, p[0]), (self.y, p[1])].map(|(side, at)| {
            let [low, high] = side;
            (at - low).min(high - at)
        });
        along.min(up)
    }
}

/// Number of vertices inside another grain.
#[must_use]
pub fn inside(grains: &[Polyline]) -> usize {
    let boxes: Vec<[f64; 4]> = grains.iter().map(|grain| box_of(grain)).collect();
    pairs(&boxes, 0.0)
        .map(|(i, j)| {
            let near = grains[i].iter().filter(|x| is_within(&boxes[j], x, 0.0));
            near.filter(|x| is_inside(&grains[j], x)).count()
        })
        .sum()
}

/// Number of vertices beyond a side of the room.
#[must_use]
pub fn beyond(grains: &[Polyline], room: &Room) -> usize {
    let vertices = grains.iter().flatten();
    vertices.filter(|x| room.distance(x) < 0.0).count()
}

/// Smallest distance of a vertex from another grain or from a side of the room, as far as it is below `reach` \[m\];
/// negative where something is inside or beyond.
#[must_use]
pub fn smallest(grains: &[Polyline], room: &Room, reach: f64) -> f64 {
    let boxes: Vec<[f64; 4]> = grains.iter().map(|grain| box_of(grain)).collect();
    let sides = grains.iter().flatten().map(|x| room.distance(x));
    let smallest = sides.fold(reach, f64::min);
    pairs(&boxes, reach).fold(smallest, |smallest, (i, j)| {
        let near = grains[i].iter().filter(|x| is_within(&boxes[j], x, reach));
        let distances = near.map(|x| {
            let distance = distance(&grains[j], x);
            if is_inside(&grains[j], x) {
                -distance
            } else {
                distance
            }
        });
        distances.fold(smallest, f64::min)
    })
}

/// Ordered pairs of which the boxes are no further apart than `reach` \[m\] along each axis.
fn pairs(boxes: &[[f64; 4]], reach: f64) -> impl Iterator<Item = (usize, usize)> {
    let all = (0..boxes.len()).flat_map(|i| (0..boxes.len()).map(move |j| (i, j)));
    all.filter(move |&(i, j)| {
        let (a, b) = (&boxes[i], &boxes[j]);
        let apart = |low: usize| a[low + 1] + reach < b[low] || b[low + 1] + reach < a[low];
        i != j && !apart(0) && !apart(2)
    })
}

/// Smallest and largest x, then y.
fn box_of(points: &[[f64; 3]]) -> [f64; 4] {
    let start = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
    points.iter().fold(start, |b, p| {
        [
            b[0].min(p[0]),
            b[1].max(p[0]),
            b[2].min(p[1]),
            b[3].max(p[1]),
        ]
    })
}

/// True if a point lies in a box that is larger by `reach` \[m\] on all sides.
fn is_within(of: &[f64; 4], x: &[f64; 3], reach: f64) -> bool {
    (of[0] - reach..=of[1] + reach).contains(&x[0])
        && (of[2] - reach..=of[3] + reach).contains(&x[1])
}

/// The sides of a closed polygon.
fn sides(polygon: &[[f64; 3]]) -> impl Iterator<Item = (&[f64; 3], &[f64; 3])> {
    polygon.iter().zip(polygon.iter().cycle().skip(1))
}

/// True if a point lies in a polygon: a ray from it crosses the polygon an odd number of times.
fn is_inside(polygon: &[[f64; 3]], x: &[f64; 3]) -> bool {
    let crossed = sides(polygon).filter(|(a, b)| {
        (a[1] > x[1]) != (b[1] > x[1])
            && x[0] < a[0] + (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1])
    });
    crossed.count() % 2 == 1
}

/// Distance of a point from a polygon \[m\].
fn distance(polygon: &[[f64; 3]], x: &[f64; 3]) -> f64 {
    sides(polygon).fold(f64::INFINITY, |least, (a, b)| {
        let (edge, to) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
        let length = edge[0] * edge[0] + edge[1] * edge[1];
        let share = ((to[0] * edge[0] + to[1] * edge[1]) / length).clamp(0.0, 1.0);
        least.min(libm::hypot(
            to[0] - share * edge[0],
            to[1] - share * edge[1],
        ))
    })
}
