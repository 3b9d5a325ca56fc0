//! Pictures that are loaded when the case that holds them is opened: a page of hundreds stays small.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write as _;

/// HTML that the page's script puts in its place when it is to be seen: compressed (RFC 1951), in base64.
#[must_use]
pub fn packed(html: &str) -> String {
    if html.is_empty() {
        return String::new();
    }
    let mut encoder = DeflateEncoder::new(vec![], Compression::best());
    // Nothing that is written to memory fails; were it to, the text would stand as it is.
    let bytes = encoder
        .write_all(html.as_bytes())
        .and_then(|()| encoder.finish());
    match bytes {
        Ok(bytes) => format!(
            "<div class=\"packed\" data-packed=\"{}\"><noscript>Pictures need scripts; the record has their numbers.\
             </noscript></div>\n",
            STANDARD.encode(bytes)
        ),
        Err(_) => html.to_owned(),
    }
}
