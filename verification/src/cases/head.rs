//! The head of the file of a case: the lines of its module's documentation, which the pages of the book print.
//!
//! The program holds the heads and not the files: they are cut out when it is compiled.

/// The beginning of each line of a head.
const MARK: [u8; 3] = *b"//!";

/// Number of bytes of the lines with which a source begins and that are documentation of the module.
pub(super) const fn length(source: &str) -> usize {
    let bytes = source.as_bytes();
    let mut at = 0;
    while at + 3 <= bytes.len()
        && bytes[at] == MARK[0]
        && bytes[at + 1] == MARK[1]
        && bytes[at + 2] == MARK[2]
    {
        while at < bytes.len() && bytes[at] != b'\n' {
            at += 1;
        }
        at += 1;
    }
    if at > bytes.len() { bytes.len() } else { at }
}

/// The first bytes of a source.
pub(super) const fn copy<const N: usize>(source: &str) -> [u8; N] {
    let bytes = source.as_bytes();
    let mut head = [0; N];
    let mut at = 0;
    while at < N {
        head[at] = bytes[at];
        at += 1;
    }
    head
}

/// The head as text; whole lines of a source that is text are text.
pub(super) const fn text(head: &[u8]) -> &str {
    match std::str::from_utf8(head) {
        Ok(text) => text,
        Err(_) => "",
    }
}
