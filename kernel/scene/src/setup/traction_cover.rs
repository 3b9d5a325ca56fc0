//! Tractions and the bodies that carry them at the start.
//!
//! A traction acts on the nodes around its rectangle. Where the rectangle lies over no body, nodes beside the body would take
//! its whole force, or there would be none to take it: both are refused, by the name of the traction.

use proctor_geometry::number::Number;
use proctor_kernel::model::{Shape, Traction, Vector};
use proctor_kernel::simulation::{SetupError, StepView, node_weights, nodes_of_traction};

/// Lengths below this share of a cell are round-off.
const NEAR: f64 = 1e-6;
/// Pieces of a cell along an axis in which bodies that are no boxes are looked for.
const PIECES: f64 = 4.0;
/// Most pieces of a rectangle along an axis.
const MOST_PIECES: usize = 1 << 10;
/// Boxes up to which a rectangle is cut at their edges.
const MOST_BOXES: usize = 64;
/// Lengths of a particle, half of them, within which it counts as the surface of a body that is no box: the particles of
/// such a body are a staircase, up to one of them high.
const STAIRCASE: f64 = 3.0;
/// Cells around a rectangle in which there are particles that reach its nodes.
const REACH: f64 = 4.0;

/// Check that bodies carry every traction of the scene.
///
/// # Errors
/// [`SetupError::Load`] by the path of a traction that lies over no body or only partly over one, or that acts on a node
/// that no particle reaches.
pub(super) fn require_carried(view: &StepView<'_>) -> Result<(), SetupError> {
    let settings = view.settings;
    for (i, traction) in settings.tractions.iter().enumerate() {
        let refused = |reason| {
            Err(SetupError::Load {
                path: format!("traction[{i}]"),
                reason,
            })
        };
        if let Some(gap) = gap_of(view, traction) {
            return refused(gap.told(traction, settings.dimension.axes()));
        }
        if let Some(x) = node_out_of_reach(view, i, traction)? {
            return refused(format!(
                "it acts at the node {} m, which no particle reaches: particles end before the rectangle does; accepted: a \
                 rectangle on a plane of nodes, or on the outermost particles of a body",
                point(&x, settings.dimension.axes())
            ));
        }
    }
    Ok(())
}

/// The part of a rectangle that lies over no body.
fn gap_of(view: &StepView<'_>, traction: &Traction) -> Option<Gap> {
    let settings = view.settings;
    let axes = settings.dimension.axes();
    let cell = &settings.mesh.cell;
    let normal = (0..axes).find(|&axis| traction.p1[axis] == traction.p2[axis])?;
    let tolerance = |axis: usize| NEAR * cell[axis] + settings.mesh.tolerance(axis);
    let boxes: Vec<[Vector; 2]> = (view.bodies.iter())
        .filter_map(|body| match body.shape {
            Shape::Cuboid { p1, p2 } => Some([p1, p2]),
            _ => None,
        })
        .filter(|[low, high]| {
            (0..axes).all(|axis| {
                low[axis] - tolerance(axis) <= traction.p2[axis]
                    && traction.p1[axis] <= high[axis] + tolerance(axis)
            })
        })
        .collect();
    let covers = |[low, high]: &[Vector; 2]| {
        (0..axes).all(|axis| {
            low[axis] - tolerance(axis) <= traction.p1[axis]
                && traction.p2[axis] <= high[axis] + tolerance(axis)
        })
    };
    if boxes.iter().any(covers) {
        return None;
    }
    let cuts: Vec<RectangleCuts> = (0..axes)
        .filter(|axis| *axis != normal)
        .map(|axis| RectangleCuts::new(axis, traction, cell[axis], &boxes))
        .collect();
    let mut covered = CoveredPieces::new(&cuts);
    for [low, high] in &boxes {
        covered.add(&|axis| [low[axis], high[axis]]);
    }
    for (run, set) in view.bodies.iter().zip(view.particles) {
        if matches!(run.shape, Shape::Cuboid { .. }) {
            continue;
        }
        let reach = run.particle_half_length.map(|l| STAIRCASE * l);
        for p in 0..set.len() {
            let x = set.position(p);
            let at = |axis: usize| x[axis] + settings.mesh.origin[axis];
            if (at(normal) - traction.p1[normal]).abs() <= reach[normal] {
                covered.add(&|axis| [at(axis) - reach[axis], at(axis) + reach[axis]]);
            }
        }
    }
    join(view, covered.pieces.iter_mut());
    covered.gap(traction)
}

/// Makes true what holds on any rank.
fn join<'a>(view: &StepView<'_>, here: impl Iterator<Item = &'a mut bool>) {
    let Some(ranks) = view.ranks else { return };
    let here: Vec<&mut bool> = here.collect();
    let mut all: Vec<f64> = here.iter().map(|here| f64::from(**here)).collect();
    ranks.join_most(&mut all);
    for (here, all) in here.into_iter().zip(all) {
        *here = all > 0.0;
    }
}

/// A node that a traction acts on and no particle reaches \[m\].
fn node_out_of_reach(
    view: &StepView<'_>,
    i: usize,
    traction: &Traction,
) -> Result<Option<Vector>, SetupError> {
    let settings = view.settings;
    let shape = &view.grid.shape;
    let mut nodes: Vec<(usize, bool)> = nodes_of_traction(settings, shape, i, traction)?
        .into_iter()
        .map(|(node, _)| (node, false))
        .collect();
    nodes.sort_unstable();
    let origin = &settings.mesh.origin;
    let is_near = |x: &Vector| {
        (0..shape.axes).all(|axis| {
            let (at, far) = (x[axis] + origin[axis], REACH * settings.mesh.cell[axis]);
            (traction.p1[axis] - far..=traction.p2[axis] + far).contains(&at)
        })
    };
    for (set, run) in view.particles.iter().zip(view.bodies) {
        for p in (0..set.len()).filter(|p| is_near(&set.position(*p))) {
            for (node, _) in &*node_weights(set, run, shape, view.stencil, p) {
                if let Ok(place) = nodes.binary_search_by_key(node, |(node, _)| *node) {
                    nodes[place].1 = true;
                }
            }
        }
    }
    join(view, nodes.iter_mut().map(|(_, reached)| reached));
    let empty = nodes.iter().find(|(_, reached)| !reached);
    Ok(empty.map(|(node, _)| {
        let local = shape.position(*node);
        std::array::from_fn(|axis| local[axis] + origin[axis])
    }))
}

/// The pieces of a rectangle along one of its axes.
struct RectangleCuts {
    axis: usize,
    /// Lower and upper end of each piece \[m\].
    pieces: Vec<[f64; 2]>,
}

impl RectangleCuts {
    fn new(axis: usize, traction: &Traction, cell: f64, boxes: &[[Vector; 2]]) -> Self {
        let (low, high) = (traction.p1[axis], traction.p2[axis]);
        let count = ((high - low) / cell * PIECES).ceil();
        let count = (count.max(1.0) as usize).min(MOST_PIECES);
        let step = (high - low) / count as f64;
        let mut edges: Vec<f64> = (0..=count).map(|k| low + step * k as f64).collect();
        if boxes.len() <= MOST_BOXES {
            edges.extend(boxes.iter().flatten().map(|corner| corner[axis]));
        }
        edges.push(high);
        edges.retain(|x| (low..=high).contains(x));
        edges.sort_by(f64::total_cmp);
        let pieces = edges.windows(2).map(|pair| [pair[0], pair[1]]);
        Self {
            axis,
            pieces: pieces
                .filter(|[low, high]| high - low > NEAR * cell)
                .collect(),
        }
    }

    /// The pieces whose middle lies between two coordinates.
    fn between(&self, [low, high]: [f64; 2]) -> std::ops::Range<usize> {
        let middle = |piece: &[f64; 2]| 0.5 * (piece[0] + piece[1]);
        let first = self.pieces.partition_point(|piece| middle(piece) < low);
        let last = self.pieces.partition_point(|piece| middle(piece) <= high);
        first..last.max(first)
    }
}

/// Pieces of a rectangle that lie over a body.
struct CoveredPieces<'a> {
    cuts: &'a [RectangleCuts],
    /// The pieces along the last axis lie one after the other.
    pieces: Vec<bool>,
}

impl<'a> CoveredPieces<'a> {
    fn new(cuts: &'a [RectangleCuts]) -> Self {
        let count = cuts.iter().map(|cuts| cuts.pieces.len()).product();
        Self {
            cuts,
            pieces: vec![false; count],
        }
    }

    /// Number of pieces along the last axis.
    fn row(&self) -> usize {
        self.cuts.last().map_or(1, |cuts| cuts.pieces.len())
    }

    /// Adds a box, by its ends along an axis.
    fn add(&mut self, ends: &impl Fn(usize) -> [f64; 2]) {
        let row = self.row();
        let within = |cuts: &RectangleCuts| cuts.between(ends(cuts.axis));
        match self.cuts {
            [one] => self.pieces[within(one)].fill(true),
            [first, second] => {
                let along = within(second);
                for k in within(first) {
                    self.pieces[k * row..(k + 1) * row][along.clone()].fill(true);
                }
            }
            _ => {}
        }
    }

    /// The part that no box covers.
    fn gap(&self, traction: &Traction) -> Option<Gap> {
        let row = self.row().max(1);
        let mut gap = Gap {
            low: traction.p2,
            high: traction.p1,
            share: 0.0,
        };
        let mut whole = 0.0;
        for (k, covered) in self.pieces.iter().enumerate() {
            let places = if self.cuts.len() == 1 {
                [k, 0]
            } else {
                [k / row, k % row]
            };
            let mut area = 1.0;
            for (cuts, place) in self.cuts.iter().zip(places) {
                let [low, high] = cuts.pieces[place];
                area *= high - low;
                if !covered {
                    gap.low[cuts.axis] = gap.low[cuts.axis].min(low);
                    gap.high[cuts.axis] = gap.high[cuts.axis].max(high);
                }
            }
            whole += area;
            gap.share += if *covered { 0.0 } else { area };
        }
        gap.share /= whole;
        (gap.share > 0.0).then_some(gap)
    }
}

/// A part of a rectangle.
struct Gap {
    /// Lower corner of the box around it \[m\].
    low: Vector,
    /// Upper corner \[m\].
    high: Vector,
    /// Its share of the area.
    share: f64,
}

impl Gap {
    fn told(&self, traction: &Traction, axes: usize) -> String {
        let rectangle = format!(
            "the rectangle from {} to {} m",
            point(&traction.p1, axes),
            point(&traction.p2, axes)
        );
        if self.share > 1.0 - NEAR {
            return format!(
                "{rectangle} lies over no body; accepted: a rectangle on a body, as its tractions act on the particles there"
            );
        }
        format!(
            "{rectangle} lies over no body from {} to {} m, {} % of its area, whose force nothing would carry; accepted: a \
             rectangle that ends where the body does",
            point(&self.low, axes),
            point(&self.high, axes),
            Number((1e3 * self.share).round() / 10.0)
        )
    }
}

fn point(x: &Vector, axes: usize) -> String {
    let numbers: Vec<String> = x[..axes].iter().map(|x| Number(*x).to_string()).collect();
    format!("({})", numbers.join(", "))
}
