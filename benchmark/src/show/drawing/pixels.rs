//! Images of pixels, and drawings as PNG.

use super::letters::{self, TextSize};
use super::{Drawing, Item, PAPER, Rgb};
use std::io::Cursor;

/// An image: red, green, blue and opacity of each pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    size: [usize; 2],
    values: Vec<[u8; 4]>,
}

impl Pixels {
    /// An image of so many pixels with nothing on it.
    #[must_use]
    pub fn new(size: [usize; 2]) -> Self {
        Self {
            size,
            values: vec![[0; 4]; size[0] * size[1]],
        }
    }

    /// Fills the pixels of a square whose middle and half of whose side are given.
    pub fn square(&mut self, [x, y]: [f64; 2], half: f64, colour: Rgb) {
        let [left, right] = [x - half, x + half].map(f64::round);
        let [top, bottom] = [y - half, y + half].map(f64::round);
        // A square that is less than a pixel is one.
        let ends = |from: f64, to: f64, most: usize| {
            let from = from.clamp(0.0, most as f64) as usize;
            let to = to.max(from as f64 + 1.0).min(most as f64) as usize;
            from..to
        };
        let across = ends(left, right, self.size[0]);
        for row in ends(top, bottom, self.size[1]) {
            let start = row * self.size[0];
            self.values[start + across.start..start + across.end].fill(opaque(colour));
        }
    }

    /// Fills the pixels of a disc, darker towards its edge as a ball is.
    pub fn ball(&mut self, [x, y]: [f64; 2], radius: f64, colour: Rgb) {
        let radius = radius.max(0.6);
        let [width, height] = self.size.map(|n| n as f64);
        let rows = (y - radius).ceil().max(0.0)..(y + radius).floor().min(height - 1.0) + 1.0;
        let mut row = rows.start;
        while row < rows.end {
            let up = (row - y) / radius;
            let half = radius * (1.0 - up * up).max(0.0).sqrt();
            let mut column = (x - half).ceil().max(0.0);
            let end = (x + half).floor().min(width - 1.0);
            while column <= end {
                let across = (column - x) / radius;
                let facing = (1.0 - up * up - across * across).max(0.0).sqrt();
                let light = 0.55 + 0.45 * facing;
                let shaded = colour.map(|c| (f64::from(c) * light) as u8);
                self.values[row as usize * self.size[0] + column as usize] = opaque(shaded);
                column += 1.0;
            }
            row += 1.0;
        }
    }

    /// Mixes a colour into a pixel, where it is one of the image.
    fn mix(&mut self, [x, y]: [i64; 2], colour: Rgb, share: f64) {
        let inside = |at: i64, most: usize| usize::try_from(at).ok().filter(|at| *at < most);
        if let (Some(x), Some(y)) = (inside(x, self.size[0]), inside(y, self.size[1])) {
            let pixel = &mut self.values[y * self.size[0] + x];
            let old = *pixel;
            for (i, value) in colour.iter().enumerate() {
                pixel[i] = (f64::from(old[i]) * (1.0 - share) + f64::from(*value) * share) as u8;
            }
        }
    }

    /// The image as PNG, transparent where nothing is.
    pub(super) fn png(&self) -> Vec<u8> {
        encoded(
            self.size,
            png::ColorType::Rgba,
            &[self.values.as_flattened()],
            0.0,
        )
    }
}

fn opaque([r, g, b]: Rgb) -> [u8; 4] {
    [r, g, b, 255]
}

/// A drawing as PNG.
#[must_use]
pub fn png(drawing: &Drawing) -> Vec<u8> {
    encoded(drawing.size, png::ColorType::Rgb, &[&painted(drawing)], 0.0)
}

/// Drawings of one size as an animated PNG, each shown for so many seconds, for ever. Viewers that know no animation show the
/// first.
#[must_use]
pub fn animation(drawings: &[Drawing], seconds: f64) -> Vec<u8> {
    let images: Vec<Vec<u8>> = drawings.iter().map(painted).collect();
    let images: Vec<&[u8]> = images.iter().map(Vec::as_slice).collect();
    let size = drawings.first().map_or([1, 1], |drawing| drawing.size);
    encoded(size, png::ColorType::Rgb, &images, seconds)
}

/// Images as a PNG file. Writing into memory does not fail.
fn encoded(size: [usize; 2], colour: png::ColorType, images: &[&[u8]], seconds: f64) -> Vec<u8> {
    let mut file = Cursor::new(vec![]);
    let write = |file: &mut Cursor<Vec<u8>>| -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(file, size[0] as u32, size[1] as u32);
        encoder.set_color(colour);
        encoder.set_depth(png::BitDepth::Eight);
        if images.len() > 1 {
            encoder.set_animated(images.len() as u32, 0)?;
            encoder.set_frame_delay((1000.0 * seconds) as u16, 1000)?;
        }
        let mut writer = encoder.write_header()?;
        for image in images {
            writer.write_image_data(image)?;
        }
        writer.finish()
    };
    let _ = write(&mut file);
    file.into_inner()
}

/// The pixels of a drawing on paper: red, green and blue.
fn painted(drawing: &Drawing) -> Vec<u8> {
    let mut paper = Pixels::new(drawing.size);
    paper.values.fill(opaque(PAPER));
    for item in &drawing.behind {
        paint(&mut paper, item);
    }
    for (below, above) in paper.values.iter_mut().zip(&drawing.pixels.values) {
        if above[3] > 0 {
            *below = *above;
        }
    }
    for item in &drawing.before {
        paint(&mut paper, item);
    }
    let rgb = paper.values.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]);
    rgb.collect()
}

fn paint(paper: &mut Pixels, item: &Item) {
    match item {
        Item::Line {
            from,
            to,
            colour,
            width,
        } => line(paper, *from, *to, *colour, *width),
        Item::Rectangle {
            corner,
            size,
            colour,
        } => {
            for y in corner[1].round() as i64..(corner[1] + size[1]).round() as i64 {
                for x in corner[0].round() as i64..(corner[0] + size[0]).round() as i64 {
                    paper.mix([x, y], *colour, 1.0);
                }
            }
        }
        Item::Text {
            text,
            at,
            anchor,
            size,
        } => words(
            paper,
            text,
            [anchor.left(at[0], letters::width(text, *size)), at[1]],
            *size,
        ),
    }
}

fn words(paper: &mut Pixels, text: &str, at: [f64; 2], size: TextSize) {
    letters::each_pixel(text, size, at, |place, ink| {
        paper.mix(place, super::INK, f64::from(ink) / 255.0);
    });
}

/// A line with smooth edges: each pixel by the share of it that the line covers.
fn line(paper: &mut Pixels, from: [f64; 2], to: [f64; 2], colour: Rgb, width: f64) {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    if length == 0.0 || !length.is_finite() {
        return;
    }
    let half = 0.5 * width;
    let span = |axis: usize| {
        let low = from[axis].min(to[axis]) - half - 1.0;
        let high = from[axis].max(to[axis]) + half + 1.0;
        let most = paper.size[axis] as f64;
        low.floor().clamp(0.0, most) as i64..high.ceil().clamp(0.0, most) as i64
    };
    let (across, down) = (span(0), span(1));
    for y in down {
        for x in across.clone() {
            let at = [x as f64 + 0.5 - from[0], y as f64 + 0.5 - from[1]];
            let along = ((at[0] * way[0] + at[1] * way[1]) / length).clamp(0.0, length);
            let off = [0, 1].map(|axis| at[axis] - along * way[axis] / length);
            let distance = (off[0] * off[0] + off[1] * off[1]).sqrt();
            let share = (half + 0.5 - distance).clamp(0.0, 1.0);
            if share > 0.0 {
                paper.mix([x, y], colour, share);
            }
        }
    }
}
