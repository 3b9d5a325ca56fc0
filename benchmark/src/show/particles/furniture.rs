//! The parts of a picture around its particles: axes with their numbers, lines of the mesh, the bar of colours, the title.

use super::view::Projection;
use super::{MeshLines, ParticlePicture, palette};
use crate::show::chart::{Axis, AxisRange, Format, Scale, Tick};
use crate::show::drawing::{Anchor, GRID, INK, Item, Rgb, TextSize, width};

/// Largest width and height of the plot in pixels.
const PLOT: [f64; 2] = [880.0, 680.0];
/// Smallest ones, of bodies that are long and thin.
const LEAST: [f64; 2] = [260.0, 90.0];
/// Distances from the upper edge to the plot, from the plot to the lower edge, and from the left edge to the numbers.
const ABOVE: f64 = 80.0;
const BELOW: f64 = 70.0;
const EDGE: f64 = 16.0;
/// Free room around the particles in the plane, as a share of their extent.
const MARGIN: f64 = 0.03;
/// Width of the bar of colours, its distance from the plot, and its steps.
const BAR: f64 = 24.0;
const BESIDE: f64 = 28.0;
const STEPS: usize = 128;
/// Free room around a box in space, for its numbers.
const AROUND: f64 = 78.0;
/// Most lines of a mesh along an axis: more would hide what they lie behind.
const MOST_LINES: usize = 400;
/// Height of plain letters in pixels, and how far the middle of a number is above its base line.
const TEXT: f64 = 18.0;
const MIDDLE: f64 = 6.0;
const PALE: Rgb = [186, 192, 200];

/// The places of a picture: how metres become pixels.
pub(super) struct Room {
    /// Left, top, width and height of the plot.
    plot: [f64; 4],
    size: [usize; 2],
    /// Pixels of a metre.
    scale: f64,
    /// Lower left corner of the plot, and its extent \[m\].
    origin: [f64; 2],
    span: [f64; 2],
    /// The axes of a plane.
    axes: Option<[AxisRange; 2]>,
    bar: AxisRange,
}

impl Room {
    pub(super) fn new(picture: &ParticlePicture<'_>, projection: &Projection, flat: bool) -> Self {
        let [low, high] = picture.bounds;
        let bar = axis(&picture.field.label).ranged(picture.range.into_iter(), false);
        let axes = flat.then(|| {
            ["x (m)", "y (m)"]
                .into_iter()
                .enumerate()
                .map(|(i, label)| axis(label).ranged([low[i], high[i]].into_iter(), false))
                .collect::<Vec<AxisRange>>()
        });
        let axes = axes.and_then(|axes| <[AxisRange; 2]>::try_from(axes).ok());
        let (origin, span) = if flat {
            let span = [0, 1].map(|axis| high[axis] - low[axis]);
            let margin = MARGIN * span[0].max(span[1]);
            (
                [0, 1].map(|axis| low[axis] - margin),
                span.map(|length| length + 2.0 * margin),
            )
        } else {
            let places = corners(low, high).map(|corner| projection.place(&corner));
            let end = |axis: usize, of: fn(f64, f64) -> f64, start: f64| {
                places.iter().map(|place| place[axis]).fold(start, of)
            };
            let least = [0, 1].map(|axis| end(axis, f64::min, f64::INFINITY));
            let most = [0, 1].map(|axis| end(axis, f64::max, f64::NEG_INFINITY));
            (least, [most[0] - least[0], most[1] - least[1]])
        };
        let around = if flat { 0.0 } else { AROUND };
        let span = span.map(|length| if length > 0.0 { length } else { 1.0 });
        let scale = (0..2)
            .map(|axis| (PLOT[axis] - 2.0 * around) / span[axis])
            .fold(f64::INFINITY, f64::min);
        let plot: [f64; 2] =
            std::array::from_fn(|i| (scale * span[i] + 2.0 * around).max(LEAST[i]).round());
        let numbers = |ticks: &AxisRange| {
            let widths = ticks.ticks.iter().map(|t| width(&t.text, TextSize::Plain));
            widths.fold(0.0, f64::max)
        };
        let left = EDGE + axes.as_ref().map_or(0.0, |[_, y]| numbers(y) + 10.0);
        let label = width(&bar.label, TextSize::Plain);
        let right = (BESIDE + BAR + 8.0 + numbers(&bar)).max(label + 8.0) + EDGE;
        let title = width(picture.title, TextSize::Title) + 2.0 * EDGE;
        let size = [
            (left + plot[0] + right).max(title).ceil() as usize,
            (ABOVE + plot[1] + BELOW).ceil() as usize,
        ];
        Self {
            plot: [left, ABOVE, plot[0], plot[1]],
            size,
            scale,
            origin: [0, 1].map(|axis| origin[axis] - around / scale),
            span: [0, 1].map(|axis| plot[axis] / scale),
            axes,
            bar,
        }
    }

    /// Width and height of the picture in pixels.
    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Pixels of a metre.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// The pixel of a place in the plot \[m\].
    pub(super) fn at(&self, place: [f64; 2]) -> [f64; 2] {
        let [left, top, _, height] = self.plot;
        [
            left + (place[0] - self.origin[0]) * self.scale,
            top + height - (place[1] - self.origin[1]) * self.scale,
        ]
    }

    /// Items behind the particles, and items before them.
    pub(super) fn items(
        &self,
        picture: &ParticlePicture<'_>,
        projection: &Projection,
    ) -> (Vec<Item>, Vec<Item>) {
        let (mut behind, mut before) = (vec![], vec![]);
        let title = picture.title;
        before.push(text(title, [EDGE, 34.0], Anchor::Start, TextSize::Title));
        let low = [EDGE, self.size[1] as f64 - 16.0];
        before.push(text(picture.caption, low, Anchor::Start, TextSize::Plain));
        if let Some(axes) = &self.axes {
            self.plane(axes, &mut behind, &mut before);
            if let Some(mesh) = picture.mesh {
                self.mesh(mesh, &mut before);
            }
        } else {
            self.space(picture, projection, &mut behind, &mut before);
        }
        self.colours(picture, &mut before);
        (behind, before)
    }

    /// Axes of a plane: a grid, and numbers at its ends.
    fn plane(&self, [x, y]: &[AxisRange; 2], behind: &mut Vec<Item>, before: &mut Vec<Item>) {
        let [left, upper, wide, height] = self.plot;
        let (right, bottom) = (left + wide, upper + height);
        let inside = |tick: &&Tick, axis: usize| {
            (0.0..=self.span[axis]).contains(&(tick.at - self.origin[axis]))
        };
        // A number is left out where it would touch the one before.
        let mut free = f64::NEG_INFINITY;
        for tick in x.ticks.iter().filter(|tick| inside(tick, 0)) {
            let at = self.at([tick.at, 0.0])[0];
            behind.push(line([at, upper], [at, bottom], GRID, 1.0));
            let half = 0.5 * width(&tick.text, TextSize::Plain);
            if at - half > free {
                let place = [at, bottom + 24.0];
                before.push(text(&tick.text, place, Anchor::Middle, TextSize::Plain));
                free = at + half + 6.0;
            }
        }
        let mut free = f64::INFINITY;
        for tick in y.ticks.iter().filter(|tick| inside(tick, 1)) {
            let at = self.at([0.0, tick.at])[1];
            behind.push(line([left, at], [right, at], GRID, 1.0));
            if at < free {
                let place = [left - 8.0, at + MIDDLE];
                before.push(text(&tick.text, place, Anchor::End, TextSize::Plain));
                free = at - TEXT;
            }
        }
        before.push(line([left, upper], [left, bottom], INK, 1.5));
        before.push(line([left, bottom], [right, bottom], INK, 1.5));
        let middle = [0.5 * (left + right), bottom + 52.0];
        before.push(text(&x.label, middle, Anchor::Middle, TextSize::Plain));
        let above = [EDGE, upper - 12.0];
        before.push(text(&y.label, above, Anchor::Start, TextSize::Plain));
    }

    /// Lines of the mesh as far as the plot goes.
    fn mesh(&self, mesh: &MeshLines, items: &mut Vec<Item>) {
        let low: [f64; 2] = std::array::from_fn(|i| self.origin[i].max(mesh.origin[i]));
        let high: [f64; 2] = std::array::from_fn(|i| {
            let end = mesh.origin[i] + mesh.cells[i] as f64 * mesh.cell[i];
            end.min(self.origin[i] + self.span[i])
        });
        for axis in 0..2 {
            let slack = 1e-9 * mesh.cell[axis];
            let lines = (0..=mesh.cells[axis])
                .map(|i| mesh.origin[axis] + i as f64 * mesh.cell[axis])
                .filter(|at| (low[axis] - slack..=high[axis] + slack).contains(at));
            let lines: Vec<f64> = lines.collect();
            if lines.len() > MOST_LINES {
                continue;
            }
            for at in lines {
                let ends = [low, high].map(|end| {
                    let mut place = end;
                    place[axis] = at;
                    self.at(place)
                });
                items.push(line(ends[0], ends[1], PALE, 0.8));
            }
        }
    }

    /// The box around the particles in space: edges that lie behind them and edges before them, and numbers at three of these.
    fn space(
        &self,
        picture: &ParticlePicture<'_>,
        projection: &Projection,
        behind: &mut Vec<Item>,
        before: &mut Vec<Item>,
    ) {
        let [low, high] = picture.bounds;
        let middle: [f64; 3] = std::array::from_fn(|i| 0.5 * (low[i] + high[i]));
        let centre = self.at(projection.place(&middle));
        for axis in 0..3 {
            let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut best: Option<(f64, [[f64; 2]; 2])> = None;
            for (in_b, in_c) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let pick = |side: usize, i: usize| if side == 0 { low[i] } else { high[i] };
                let ends = [low, high].map(|end| {
                    let mut corner = end;
                    corner[b] = pick(in_b, b);
                    corner[c] = pick(in_c, c);
                    corner
                });
                let mut half = middle;
                half[b] = pick(in_b, b);
                half[c] = pick(in_c, c);
                let [from, to] = ends.map(|corner| self.at(projection.place(&corner)));
                let is_near = projection.nearness(&half) > projection.nearness(&middle);
                let place = self.at(projection.place(&half));
                let far = (place[0] - centre[0]).abs() + (place[1] - centre[1]).abs();
                behind.push(line(from, to, if is_near { PALE } else { GRID }, 1.0));
                // Numbers stand at an edge of the outline: below for the horizontal axes, at the left for the vertical one.
                let rank = if axis == 2 {
                    centre[0] - place[0] + 1e-3 * far
                } else {
                    place[1] - centre[1] + 1e-3 * far
                };
                if best.is_none_or(|(most, _)| rank > most) {
                    best = Some((rank, [from, to]));
                }
            }
            if let Some((_, ends)) = best {
                Self::numbers(axis, [low[axis], high[axis]], ends, centre, before);
            }
        }
    }

    /// An edge of the box with its name and its numbers, outside of it.
    fn numbers(
        axis_number: usize,
        range: [f64; 2],
        [from, to]: [[f64; 2]; 2],
        centre: [f64; 2],
        items: &mut Vec<Item>,
    ) {
        let label = ["x (m)", "y (m)", "z (m)"][axis_number];
        items.push(line(from, to, INK, 1.5));
        let at = |share: f64| -> [f64; 2] {
            std::array::from_fn(|i| from[i] + share * (to[i] - from[i]))
        };
        let middle = at(0.5);
        let out = if middle[0] < centre[0] { -1.0 } else { 1.0 };
        let anchor = if out < 0.0 {
            Anchor::End
        } else {
            Anchor::Start
        };
        let ticks = axis(label).ranged(range.into_iter(), false);
        let span = range[1] - range[0];
        let is_vertical = axis_number == 2;
        // Numbers are left out where they would touch the one before.
        let mut last: Option<[f64; 2]> = None;
        for tick in &ticks.ticks {
            let share = (tick.at - range[0]) / span;
            let [x, y] = at(share);
            let is_inside = (-1e-9..=1.0 + 1e-9).contains(&share);
            let wide = width(&tick.text, TextSize::Plain) + 10.0;
            let is_free =
                last.is_none_or(|[x0, y0]| (x - x0).abs() > wide || (y - y0).abs() > TEXT + 4.0);
            if is_inside && is_free {
                last = Some([x, y]);
                let down = if is_vertical { MIDDLE } else { TEXT + 2.0 };
                let place = [x + 8.0 * out, y + down];
                items.push(line(
                    [x, y],
                    [x + 5.0 * out, y + if is_vertical { 0.0 } else { 5.0 }],
                    INK,
                    1.2,
                ));
                items.push(text(&tick.text, place, anchor, TextSize::Plain));
            }
        }
        let place = if is_vertical {
            [to[0] - 8.0, to[1].min(from[1]) - 14.0]
        } else {
            [middle[0] + 44.0 * out, middle[1] + 50.0]
        };
        let anchor = if is_vertical { Anchor::Middle } else { anchor };
        items.push(text(&ticks.label, place, anchor, TextSize::Plain));
    }

    /// The bar of colours with its numbers.
    fn colours(&self, picture: &ParticlePicture<'_>, items: &mut Vec<Item>) {
        let [left, top, wide, height] = self.plot;
        let corner = [left + wide + BESIDE, top];
        let [low, high] = picture.range;
        let step = height / STEPS as f64;
        for i in 0..STEPS {
            let share = (i as f64 + 0.5) / STEPS as f64;
            let upper = top + height - (i + 1) as f64 * step;
            items.push(Item::Rectangle {
                corner: [corner[0], upper],
                // No paper shows between two steps.
                size: [BAR, (step + 0.6).min(top + height - upper)],
                colour: palette::colour(low + share * (high - low), [low, high]),
            });
        }
        let right = corner[0] + BAR;
        for tick in &self.bar.ticks {
            let share = if high > low {
                (tick.at - low) / (high - low)
            } else {
                0.5
            };
            // Where all values are one, that one stands at the middle.
            let (words, is_shown) = if high > low {
                (tick.text.clone(), (-1e-9..=1.0 + 1e-9).contains(&share))
            } else {
                (crate::show::number(low), tick == &self.bar.ticks[0])
            };
            if is_shown {
                let y = top + (1.0 - share) * height;
                items.push(line([right, y], [right + 5.0, y], INK, 1.2));
                let place = [right + 8.0, y + MIDDLE];
                items.push(text(&words, place, Anchor::Start, TextSize::Plain));
            }
        }
        let label = if high > low {
            &self.bar.label
        } else {
            &picture.field.label
        };
        let end = [self.size[0] as f64 - EDGE, top - 18.0];
        items.push(text(label, end, Anchor::End, TextSize::Plain));
    }
}

/// The eight corners of a box.
fn corners(low: [f64; 3], high: [f64; 3]) -> [[f64; 3]; 8] {
    std::array::from_fn(|i| {
        std::array::from_fn(|axis| {
            if i >> axis & 1 == 0 {
                low[axis]
            } else {
                high[axis]
            }
        })
    })
}

fn axis(label: &str) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Linear,
        format: Format::Number,
    }
}

fn line(from: [f64; 2], to: [f64; 2], colour: Rgb, width: f64) -> Item {
    Item::Line {
        from,
        to,
        colour,
        width,
    }
}

fn text(words: &str, at: [f64; 2], anchor: Anchor, size: TextSize) -> Item {
    Item::Text {
        text: words.to_owned(),
        at,
        anchor,
        size,
    }
}
