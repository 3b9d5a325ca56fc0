//! Letters for pictures of pixels: a plain size and a bold one, as one grey image of the letters of DejaVu Sans.
//!
//! `letters.png` holds them in cells, 255 where there is ink; `LICENSE-letters` is the licence of the typeface.

use std::io::Cursor;
use std::sync::OnceLock;

/// The letters in the order of the image, behind those of ASCII from the blank on.
pub const MORE: &str = "°²³·µ×–−…⁰¹⁴⁵⁶⁷⁸⁹⁻";
/// Letters of ASCII.
const ASCII: usize = 95;
/// Side of a cell, cells in a row, rows of a size.
const CELL: usize = 32;
const ACROSS: usize = 19;
const DOWN: usize = 6;
/// Origin of a letter in its cell: the left end, and the base line.
const ORIGIN: [usize; 2] = [4, 23];

/// Distance to the next letter in tenths of a pixel, for plain and for bold letters.
#[rustfmt::skip]
const ADVANCE: [[u16; 113]; 2] = [
    [57, 72, 83, 151, 115, 171, 140, 49, 70, 70, 90, 151, 57, 65, 57, 61, 115, 115, 115, 115, 115, 115, 115, 115, 115, 115, 61, 61, 151, 151, 151, 96, 180, 123, 123, 126, 139, 114, 104, 139, 135, 53, 53, 118, 100, 155, 135, 142, 109, 142, 125, 114, 110, 132, 123, 178, 123, 110, 123, 70, 61, 70, 151, 90, 90, 110, 114, 99, 114, 111, 63, 114, 114, 50, 50, 104, 50, 175, 114, 110, 114, 114, 74, 94, 71, 114, 107, 147, 107, 107, 94, 115, 61, 115, 151, 90, 72, 72, 57, 115, 151, 90, 151, 180, 72, 72, 72, 72, 72, 72, 72, 72, 95],
    [77, 100, 115, 184, 153, 220, 192, 67, 101, 101, 115, 184, 84, 91, 84, 80, 153, 153, 153, 153, 153, 153, 153, 153, 153, 153, 88, 88, 184, 184, 184, 128, 220, 170, 168, 161, 183, 150, 150, 181, 184, 82, 82, 170, 140, 219, 184, 187, 161, 187, 169, 158, 150, 179, 170, 243, 170, 159, 160, 101, 80, 101, 184, 110, 110, 148, 157, 130, 157, 149, 96, 157, 157, 75, 75, 146, 75, 229, 157, 151, 157, 157, 108, 131, 105, 157, 143, 203, 142, 143, 128, 157, 80, 157, 184, 110, 96, 96, 84, 162, 184, 110, 184, 220, 96, 96, 96, 96, 96, 96, 96, 96, 116],
];

/// Size of a text in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextSize {
    /// 18 pixels.
    Plain,
    /// 22 pixels, bold.
    Title,
}

impl TextSize {
    /// Height of its letters in pixels.
    #[must_use]
    pub fn pixels(self) -> f64 {
        match self {
            Self::Plain => 18.0,
            Self::Title => 22.0,
        }
    }
}

/// Place of a letter in the image; the question mark stands for what it lacks.
fn place(letter: char) -> usize {
    let code = letter as usize;
    if (32..127).contains(&code) {
        return code - 32;
    }
    let more = MORE.chars().position(|known| known == letter);
    more.map_or('?' as usize - 32, |i| ASCII + i)
}

/// Width of a text in pixels.
#[must_use]
pub fn width(text: &str, size: TextSize) -> f64 {
    let advance = &ADVANCE[size as usize];
    text.chars()
        .map(|letter| f64::from(advance[place(letter)]) / 10.0)
        .sum()
}

/// Gives the ink of a text, from 0 to 255, pixel by pixel; `at` is the left end of its base line.
pub fn each_pixel(text: &str, size: TextSize, at: [f64; 2], mut ink: impl FnMut([i64; 2], u8)) {
    let image = image();
    let mut left = at[0];
    for letter in text.chars() {
        let place = place(letter);
        let cell = [
            CELL * (place % ACROSS),
            CELL * (place / ACROSS + DOWN * size as usize),
        ];
        let corner = [
            left.round() as i64 - ORIGIN[0] as i64,
            at[1].round() as i64 - ORIGIN[1] as i64,
        ];
        for y in 0..CELL {
            let row = (cell[1] + y) * CELL * ACROSS + cell[0];
            for (x, value) in image[row..row + CELL].iter().enumerate() {
                if *value > 0 {
                    ink([corner[0] + x as i64, corner[1] + y as i64], *value);
                }
            }
        }
        left += f64::from(ADVANCE[size as usize][place]) / 10.0;
    }
}

/// The grey values of the image, row by row.
fn image() -> &'static [u8] {
    static IMAGE: OnceLock<Vec<u8>> = OnceLock::new();
    IMAGE.get_or_init(|| {
        let file = Cursor::new(include_bytes!("letters.png"));
        let mut values = vec![0; 2 * DOWN * ACROSS * CELL * CELL];
        // The image is part of the program, and a test reads it.
        if let Ok(mut reader) = png::Decoder::new(file).read_info() {
            let _ = reader.next_frame(&mut values);
        }
        values
    })
}
