//! A drawing as SVG: its image inside, all else as elements.

use super::super::chart::FONTS;
use super::{Anchor, Drawing, Item, Rgb, TextSize};
use crate::report::escape;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;

/// The drawing as an SVG document. Writing to a string does not fail.
#[must_use]
pub fn svg(drawing: &Drawing) -> String {
    let [width, height] = drawing.size;
    let title = escape(&drawing.title);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FONTS}\">\n<title>{title}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
        hexadecimal(super::PAPER)
    );
    for item in &drawing.behind {
        element(&mut out, item);
    }
    let _ = writeln!(
        out,
        "<image width=\"{width}\" height=\"{height}\" href=\"data:image/png;base64,{}\"/>",
        STANDARD.encode(drawing.pixels.png())
    );
    for item in &drawing.before {
        element(&mut out, item);
    }
    out.push_str("</svg>\n");
    out
}

fn element(out: &mut String, item: &Item) {
    let _ = match item {
        Item::Line {
            from,
            to,
            colour,
            width,
        } => writeln!(
            out,
            "<path stroke=\"{}\" stroke-width=\"{width}\" d=\"M{:.1} {:.1}L{:.1} {:.1}\"/>",
            hexadecimal(*colour),
            from[0],
            from[1],
            to[0],
            to[1]
        ),
        Item::Rectangle {
            corner,
            size,
            colour,
        } => writeln!(
            out,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\"/>",
            corner[0],
            corner[1],
            size[0],
            size[1],
            hexadecimal(*colour)
        ),
        Item::Text {
            text,
            at,
            anchor,
            size,
        } => writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>",
            at[0],
            at[1],
            match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            },
            size.pixels(),
            hexadecimal(super::INK),
            match size {
                TextSize::Plain => "",
                TextSize::Title => " font-weight=\"600\"",
            },
            escape(text)
        ),
    };
}

fn hexadecimal([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
