//! A tree of bounding boxes over the triangles of a surface.

use super::nearest::{NearestPoint, NearestTriangle};
use super::{Point, Surface};

/// Triangles of a leaf.
const LEAF: usize = 4;

/// Boxes in preorder: the first child of a box follows it.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    boxes: Vec<Bounds>,
    /// Triangles in the order of the leaves.
    order: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Point,
    high: Point,
    content: Content,
}

#[derive(Clone, Copy, Debug)]
enum Content {
    /// First place in the order, and number.
    Triangles(u32, u32),
    /// The second child.
    Second(u32),
}

impl Bounds {
    /// Squared distance of a point.
    fn square(&self, x: &Point) -> f64 {
        let mut sum = 0.0;
        for axis in 0..3 {
            let d = (self.low[axis] - x[axis])
                .max(x[axis] - self.high[axis])
                .max(0.0);
            sum += d * d;
        }
        sum
    }
}

impl Tree {
    /// Halves the triangles at the median of their centres along the longest side of the box around them. Equal
    /// centres keep the order of the file, so that the tree depends on the surface alone.
    pub fn new(vertices: &[Point], triangles: &[[u32; 3]]) -> Self {
        let corners = |t: u32| triangles[t as usize].map(|v| vertices[v as usize]);
        let mut tree = Self {
            boxes: vec![],
            order: (0..triangles.len() as u32).collect(),
        };
        // Ranges to do, with the box whose second child they are.
        let mut todo = vec![(0, triangles.len(), None)];
        while let Some((start, end, second_of)) = todo.pop() {
            let own = &mut tree.order[start..end];
            let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
            for x in own.iter().flat_map(|&t| corners(t)) {
                for axis in 0..3 {
                    low[axis] = low[axis].min(x[axis]);
                    high[axis] = high[axis].max(x[axis]);
                }
            }
            let index = tree.boxes.len();
            if let Some(parent) = second_of {
                let parent: &mut Bounds = &mut tree.boxes[parent];
                parent.content = Content::Second(index as u32);
            }
            let mut content = Content::Triangles(start as u32, (end - start) as u32);
            if end - start > LEAF {
                let axis = (0..3)
                    .max_by(|&a, &b| (high[a] - low[a]).total_cmp(&(high[b] - low[b])))
                    .unwrap_or(0);
                let center = |t: u32| corners(t).iter().map(|x| x[axis] / 3.0).sum::<f64>();
                own.sort_by(|&a, &b| center(a).total_cmp(&center(b)).then(a.cmp(&b)));
                let middle = start + (end - start) / 2;
                todo.push((middle, end, Some(index)));
                todo.push((start, middle, None));
                content = Content::Second(u32::MAX);
            }
            tree.boxes.push(Bounds { low, high, content });
        }
        tree
    }

    pub fn bounds(&self) -> (Point, Point) {
        (self.boxes[0].low, self.boxes[0].high)
    }

    /// The nearest point, of a triangle closer than `within`. A `guess` spares what lies behind it and changes nothing.
    pub fn nearest(
        &self,
        surface: &Surface,
        x: &Point,
        within: f64,
        guess: Option<usize>,
    ) -> Option<NearestPoint> {
        let mut best = NearestTriangle::new(within);
        if let Some(triangle) = guess {
            best.look_at(surface, triangle, x);
        }
        // Depth at most 32 halvings of at most 2^31 triangles. Each box with its squared distance.
        let mut todo = [(0_u32, 0.0); 40];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (index, square) = todo[count];
            // Not `>=`: a box at the same distance may hold an earlier triangle.
            if square > best.limit() {
                continue;
            }
            match self.boxes[index as usize].content {
                Content::Triangles(start, number) => {
                    for &t in &self.order[start as usize..(start + number) as usize] {
                        if guess != Some(t as usize) {
                            best.look_at(surface, t as usize, x);
                        }
                    }
                }
                Content::Second(second) => {
                    let with_square = |index: u32| (index, self.boxes[index as usize].square(x));
                    let (first, second) = (with_square(index + 1), with_square(second));
                    let closer_last = if first.1 <= second.1 {
                        [second, first]
                    } else {
                        [first, second]
                    };
                    for child in closer_last {
                        if child.1 <= best.limit() {
                            todo[count] = child;
                            count += 1;
                        }
                    }
                }
            }
        }
        best.finish(surface, x)
    }
}
