//! Simple polygons: the test for edges that cross or touch.

/// Corners in the plane.
type Point = [f64; 2];

/// Fault of a polygon: fewer than three corners, coinciding corners, crossing or touching edges. `None` if it is simple.
#[must_use]
pub fn fault(points: &[Point]) -> Option<String> {
    let n = points.len();
    if n < 3 {
        return Some(format!("{n} corners"));
    }
    if let Some(i) = (0..n).find(|&i| points[i] == points[(i + 1) % n]) {
        return Some(format!("corners {i} and {} that coincide", (i + 1) % n));
    }
    for i in 0..n {
        for j in i + 1..n {
            if edges_meet(points, i, j) {
                return Some(format!(
                    "edges from corner {i} and from corner {j} that cross"
                ));
            }
        }
    }
    None
}

/// True if edges `i < j` have more in common than the corner that neighbours share.
fn edges_meet(points: &[Point], i: usize, j: usize) -> bool {
    let n = points.len();
    let (a, b) = (points[i], points[(i + 1) % n]);
    let (c, d) = (points[j], points[(j + 1) % n]);
    if j == i + 1 {
        return folds_back(a, b, d);
    }
    if i == 0 && j == n - 1 {
        return folds_back(c, a, b);
    }
    let (side_c, side_d) = (turn(a, b, c), turn(a, b, d));
    let (side_a, side_b) = (turn(c, d, a), turn(c, d, b));
    let separated = (side_c > 0.0 && side_d > 0.0)
        || (side_c < 0.0 && side_d < 0.0)
        || (side_a > 0.0 && side_b > 0.0)
        || (side_a < 0.0 && side_b < 0.0);
    !separated && boxes_meet(a, b, c, d)
}

/// True if the path a, b, c returns over itself.
fn folds_back(a: Point, b: Point, c: Point) -> bool {
    let forward = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
    turn(a, b, c) == 0.0 && forward < 0.0
}

/// Twice the signed area of the triangle a, b, c.
fn turn(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// True if the bounding boxes of two edges meet; decides the case of edges on one line.
fn boxes_meet(a: Point, b: Point, c: Point, d: Point) -> bool {
    (0..2).all(|k| a[k].max(b[k]) >= c[k].min(d[k]) && c[k].max(d[k]) >= a[k].min(b[k]))
}

#[cfg(test)]
mod tests {
    use super::fault;

    #[test]
    fn simple_polygons_have_no_fault() {
        let l_shape = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];
        assert_eq!(fault(&l_shape), None);
        let mut clockwise = l_shape;
        clockwise.reverse();
        assert_eq!(fault(&clockwise), None);
        // A corner in the middle of a straight side is no fold.
        assert_eq!(fault(&[[0., 0.], [1., 0.], [2., 0.], [1., 1.]]), None);
    }

    #[test]
    fn faults_are_named() {
        let cases: [(&[[f64; 2]], &str); 6] = [
            (&[[0., 0.], [1., 0.]], "2 corners"),
            (
                &[[0., 0.], [1., 0.], [1., 1.], [0., 0.]],
                "corners 3 and 0 that coincide",
            ),
            // Bow tie.
            (
                &[[0., 0.], [1., 1.], [1., 0.], [0., 1.]],
                "edges from corner 0 and from corner 2 that cross",
            ),
            // A spike over itself.
            (
                &[[0., 0.], [2., 0.], [1., 0.], [1., 1.]],
                "edges from corner 0 and from corner 1 that cross",
            ),
            // A corner that touches a side.
            (
                &[[0., 0.], [2., 0.], [2., 2.], [1., 0.], [0., 2.]],
                "edges from corner 0 and from corner 2 that cross",
            ),
            // All corners on one line.
            (
                &[[0., 0.], [1., 0.], [2., 0.]],
                "edges from corner 0 and from corner 2 that cross",
            ),
        ];
        for (points, expected) in cases {
            assert_eq!(fault(points).as_deref(), Some(expected), "{points:?}");
        }
    }
}
