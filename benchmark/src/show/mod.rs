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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_000_000), "1 000 000");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(0.278_746), "0.2787");
        assert_eq!(number(-12.5), "-12.5");
        assert_eq!(number(99_999.0), "99999");
        assert_eq!(number(1.0e-5), "1.000e-5");
        assert_eq!(number(f64::NAN), "NaN");
        assert_eq!(seconds(0.012_34), "12.3 ms");
        assert_eq!(seconds(125.0), "125 s");
        assert_eq!(bytes(1536), "1.5 KiB");
    }

    #[test]
    fn errors_are_in_per_cent_with_three_digits() {
        assert_eq!(percent(0.004_567), "0.457 %");
        assert_eq!(percent(0.123_4), "12.3 %");
        assert_eq!(percent(2.5), "250 %");
        assert_eq!(percent(1e-9), "1.0e-7 %");
        assert_eq!(percent(0.0), "0 %");
        assert_eq!(percent(-0.123_4), "-12.3 %");
        assert_eq!(percent(-1e-9), "-1.0e-7 %");
        assert_eq!(percent(f64::NAN), "-");
    }

    #[test]
    fn text_is_broken_at_blanks_alone() {
        let words = "a word that is longer than a line";
        assert_eq!(
            filled(words.split(' '), 6),
            ["a word", "that", "is", "longer", "than a", "line"]
        );
        assert_eq!(filled(words.split(' '), 100), [words]);
        assert_eq!(filled(["of two words", "of two words"], 5).len(), 2);
        assert_eq!(filled([], 5), [""]);
    }

    #[test]
    fn long_numbers_of_a_sentence_are_rounded_and_nothing_else() {
        let said = "step 49, time 23.5 s: 2 closes on 1 by 0.023364106467191550 m, since 6.99999999999999e-3 s.";
        assert_eq!(
            rounded(said),
            "step 49, time 23.5 s: 2 closes on 1 by 0.02336 m, since 0.007 s."
        );
        for kept in [
            "12345678901234 particles",
            "h=0.25, v1.2.3-rc, 1e-5",
            "",
            "none",
        ] {
            assert_eq!(rounded(kept), kept);
        }
    }

    #[test]
    fn long_names_lose_their_middle() {
        let name = "whole-step/two-bodies-3d/uGIMP/USL/FLIP/64000";
        let short = shortened(name, 29);
        assert_eq!(short.chars().count(), 29);
        let (head, tail) = short.split_once('…').expect("something is left out");
        assert!(name.starts_with(head) && name.ends_with(tail), "{short}");
        assert!(head.len().abs_diff(tail.len()) <= 1, "{short}");
        assert_eq!(shortened("short", 29), "short");
    }

    #[test]
    fn long_sentences_end_after_a_word() {
        let sentence = "stress less that of the closed form, over it";
        assert_eq!(in_words(sentence, 32), "stress less that of the closed …");
        assert_eq!(in_words(sentence, 31), "stress less that of the …");
        assert_eq!(in_words("short", 5), "short");
    }

    #[test]
    fn a_table_loses_the_columns_that_are_named() {
        let mut table = Table::new(["h", "steps", "error"]);
        table.push(["1/8", "7", "0.5"]);
        table.push(["1/16"]);
        let narrow = table.without(&["steps", "none"]);
        assert_eq!(narrow.to_string(), "  h     error\n  1/8     0.5\n  1/16\n");
    }

    #[test]
    fn a_table_aligns_numbers_to_the_right() {
        let mut table = Table::new(["h", "error"]);
        table.push(["1/8", "0.5"]);
        table.push(["1/16"]);
        assert_eq!(table.to_string(), "  h     error\n  1/8     0.5\n  1/16\n");
    }
}
