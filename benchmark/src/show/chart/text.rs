//! Widths of text, and text in XML.

use std::borrow::Cow;

/// Text as it stands in an element or an attribute.
pub fn escaped(text: &str) -> Cow<'_, str> {
    quick_xml::escape::escape(text)
}

/// Width of a text in a sans-serif of that size, estimated on the safe side.
pub fn width(text: &str, size: f64) -> f64 {
    let of = |c: char| match c {
        'i' | 'j' | 'l' | 't' | 'f' | '.' | ',' | ':' | ';' | '|' | '\'' | ' ' | '⁻' | '('
        | ')' => 0.34,
        'm' | 'w' | 'M' | 'W' | '%' => 0.92,
        c if c.is_ascii_uppercase() => 0.70,
        _ => 0.58,
    };
    size * text.chars().map(of).sum::<f64>()
}

/// Breaks a text at blanks into lines no wider than `most`; a word that is wider stands alone.
pub fn lines(text: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) + 0.34 * size <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A whole number as exponent.
pub fn superscript(n: i32) -> String {
    n.to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            c => char::from_u32('⁰' as u32 + c.to_digit(10).unwrap_or(0)).unwrap_or(c),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_and_breaks() {
        assert_eq!(superscript(-304), "⁻³⁰⁴");
        assert_eq!(lines("one two three", 10.0, 50.0), ["one two", "three"]);
        assert_eq!(lines("unbreakable", 10.0, 5.0), ["unbreakable"]);
    }
}
