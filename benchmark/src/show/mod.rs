//! Numbers and tables as text.

pub mod arena;
pub mod case;
pub mod chart;
pub mod comparison;
pub mod drawing;
pub mod figures;
pub mod histogram;
pub mod history;
pub mod keys;
pub mod paint;
pub mod particles;
pub mod picture;
pub mod precision;
pub mod refine;
pub mod refine_methods;
pub mod runs;
pub mod short;
pub mod stability;
pub mod summary;

use std::fmt::{self, Write as _};
use std::io::{self, Write};

/// A whole number in groups of three digits.
#[must_use]
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// A number with four significant digits, with an exponent only where it would be long.
#[must_use]
pub fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if !x.is_finite() {
        x.to_string()
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
        let text = format!("{x:.decimals$}");
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    } else {
        format!("{x:.3e}")
    }
}

/// Seconds with three significant digits and the unit that suits them.
#[must_use]
pub fn seconds(s: f64) -> String {
    let (value, unit) = match s {
        _ if s >= 1.0 => (s, "s"),
        _ if s >= 1e-3 => (s * 1e3, "ms"),
        _ => (s * 1e6, "µs"),
    };
    let decimals = match value {
        _ if value >= 100.0 => 0,
        _ if value >= 10.0 => 1,
        _ => 2,
    };
    format!("{value:.decimals$} {unit}")
}

/// A relative error in per cent, three significant digits.
#[must_use]
pub fn percent(error: f64) -> String {
    if !error.is_finite() {
        return "-".to_owned();
    }
    let value = 100.0 * error;
    let size = value.abs();
    if value != 0.0 && size < 1e-3 {
        format!("{value:.1e} %")
    } else {
        let decimals = if value == 0.0 {
            0
        } else {
            (2 - size.log10().floor() as i32).max(0) as usize
        };
        format!("{value:.decimals$} %")
    }
}

/// Bytes in the binary unit that suits them.
#[must_use]
pub fn bytes(n: u64) -> String {
    let size = n as f64;
    match n {
        0..1024 => format!("{n} B"),
        0x400..0x10_0000 => format!("{:.1} KiB", size / 1024.0),
        0x10_0000..0x4000_0000 => format!("{:.1} MiB", size / 1024.0_f64.powi(2)),
        _ => format!("{:.1} GiB", size / 1024.0_f64.powi(3)),
    }
}

/// A name in so many characters, its middle left out where it is longer.
#[must_use]
pub fn shortened(name: &str, characters: usize) -> String {
    let length = name.chars().count();
    if length <= characters {
        return name.to_owned();
    }
    let half = characters / 2;
    let head: String = name.chars().take(half).collect();
    let tail: String = name.chars().skip(length + half + 1 - characters).collect();
    format!("{head}…{tail}")
}

/// A sentence in so many characters, of whole words where it is longer.
#[must_use]
pub fn in_words(sentence: &str, characters: usize) -> String {
    if sentence.chars().count() <= characters {
        return sentence.to_owned();
    }
    let mut short = String::new();
    for word in sentence.split(' ') {
        if short.chars().count() + word.chars().count() + 2 > characters {
            break;
        }
        short.push_str(word);
        short.push(' ');
    }
    short + "…"
}

/// Words joined by blanks, in as many lines of so many characters as they need. A word that is longer has a line alone.
pub fn filled<'a>(words: impl IntoIterator<Item = &'a str>, characters: usize) -> Vec<String> {
    let mut lines = vec![];
    let mut line = String::new();
    for word in words {
        if line.is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() > characters {
            lines.push(std::mem::replace(&mut line, word.to_owned()));
        } else {
            line.push(' ');
            line.push_str(word);
        }
    }
    lines.push(line);
    lines
}

/// Columns that tables and text may take: those of the terminal between 80 and 120, and 80 where there is none.
#[must_use]
pub fn columns() -> usize {
    let found = terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    found.unwrap_or(0).clamp(80, 120)
}

/// Text in lines that fit, broken at blanks, all of them indented.
///
/// # Errors
/// If `out` cannot be written.
pub fn paragraph(text: &str, indent: usize, out: &mut dyn Write) -> io::Result<()> {
    for line in filled(text.split(' '), columns().saturating_sub(indent)) {
        writeln!(out, "{:indent$}{line}", "")?;
    }
    Ok(())
}

/// A sentence with its long numbers in four significant digits: what a program writes to its last bit, for a person.
#[must_use]
pub fn rounded(sentence: &str) -> String {
    let of_number = |c: char| c.is_ascii_digit() || ".e-+".contains(c);
    let mut text = String::new();
    let mut rest = sentence;
    while let Some(begin) = rest.find(|c: char| c.is_ascii_digit()) {
        text.push_str(&rest[..begin]);
        let length = rest[begin..].find(|c| !of_number(c));
        let whole = &rest[begin..begin + length.unwrap_or(rest.len() - begin)];
        let word = whole.trim_end_matches(['.', 'e', '-', '+']);
        match word.parse::<f64>() {
            Ok(x) if word.contains('.') && word.len() > LONG => text.push_str(&number(x)),
            _ => text.push_str(word),
        }
        rest = &rest[begin + word.len()..];
    }
    text + rest
}

/// Characters from which on a number is a long one.
const LONG: usize = 10;

/// Columns of text: the first to the left, the others to the right.
pub struct Table {
    lines: Vec<Vec<String>>,
}

impl Table {
    /// A table with these headings.
    pub fn new<S: Into<String>>(headings: impl IntoIterator<Item = S>) -> Self {
        Self {
            lines: vec![headings.into_iter().map(Into::into).collect()],
        }
    }

    /// Its lines, the headings first.
    #[must_use]
    pub fn lines(&self) -> &[Vec<String>] {
        &self.lines
    }

    /// The table without the columns of some headings.
    #[must_use]
    pub fn without(&self, headings: &[&str]) -> Self {
        let head = self.lines.first().map_or(&[][..], Vec::as_slice);
        let is_kept = |column: usize| {
            head.get(column)
                .is_none_or(|heading| !headings.contains(&heading.as_str()))
        };
        let lines = self.lines.iter().map(|line| {
            let cells = line.iter().enumerate();
            cells
                .filter(|(column, _)| is_kept(*column))
                .map(|(_, cell)| cell.clone())
                .collect()
        });
        Self {
            lines: lines.collect(),
        }
    }

    /// Adds a line; cells that are missing at its end stay empty.
    pub fn push<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.lines.push(cells.into_iter().map(Into::into).collect());
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.lines.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            let cells = self.lines.iter().filter_map(|line| line.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for line in &self.lines {
            let mut text = String::new();
            for (column, cell) in line.iter().enumerate() {
                let width = widths[column];
                if column == 0 {
                    write!(text, "{cell:<width$}")?;
                } else {
                    write!(text, "  {cell:>width$}")?;
                }
            }
            writeln!(f, "  {}", text.trim_end())?;
        }
        Ok(())
    }
}
