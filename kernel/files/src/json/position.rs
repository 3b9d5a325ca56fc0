//! Source spans: the places of paths in a JSON text.
//!
//! A range error is found long after parsing, when only the path is known. Instead of carrying positions through
//! every raw type, the text is walked again along the path; this costs nothing where nothing is wrong.

use proctor_scene::Location;

/// Place of a path in the text, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SourceSpan {
    /// Start of the key; of the value for entries of a list and for the whole.
    pub key: usize,
    /// Start of the value.
    pub value: usize,
    /// End of the value.
    pub end: usize,
    /// True if it is the path itself; otherwise the nearest enclosing value that exists.
    pub exact: bool,
}

/// Finds `path`, written as in messages (`body.column.point_p1[2]`), in a text that is JSON at least up to there.
/// Of equal keys the last is found. `None` if the text does not start as JSON.
#[must_use]
pub fn find(text: &str, path: &str) -> Option<SourceSpan> {
    let mut walk = Walk {
        text,
        at: 0,
        depth: 0,
        target: path,
        best: None,
    };
    walk.blank();
    let start = walk.at;
    let end = walk.value(&mut String::new(), true);
    let whole = SourceSpan {
        key: start,
        value: start,
        end: end.unwrap_or(text.len()),
        exact: path.is_empty(),
    };
    walk.best
        .map(|(_, place)| place)
        .or_else(|| (start < text.len()).then_some(whole))
}

/// Line and column of a byte offset.
#[must_use]
pub fn location(file: &str, text: &str, offset: usize) -> Location {
    let before = &text[..floor(text, offset)];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    Location {
        file: file.to_owned(),
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}

/// Byte offset of a line and column as the JSON parser gives them: line from 1, column in bytes.
#[must_use]
pub fn offset(text: &str, line: usize, column: usize) -> usize {
    let start = match line {
        0 | 1 => 0,
        _ => text
            .match_indices('\n')
            .nth(line - 2)
            .map_or(text.len(), |(at, _)| at + 1),
    };
    floor(text, start + column.saturating_sub(1))
}

/// The nearest character boundary at or before an offset.
fn floor(text: &str, mut offset: usize) -> usize {
    offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// Deeper than the JSON parser goes, and far from the end of the stack.
const DEEPEST: usize = 200;

struct Walk<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    target: &'a str,
    /// Length of the longest matching path so far, and its place.
    best: Option<(usize, SourceSpan)>,
}

impl Walk<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn blank(&mut self) {
        while self.peek().is_some_and(|b| b.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// Walks over a value, looking inside where `on_path`. Its end, or `None` where the text stops being JSON.
    fn value(&mut self, path: &mut String, on_path: bool) -> Option<usize> {
        match self.peek()? {
            b'{' => self.members(path, on_path, b'}'),
            b'[' => self.members(path, on_path, b']'),
            b'"' => self.string().map(|_| ()),
            _ => {
                let start = self.at;
                while self
                    .peek()
                    .is_some_and(|b| b.is_ascii_alphanumeric() || b"+-.".contains(&b))
                {
                    self.at += 1;
                }
                (self.at > start).then_some(())
            }
        }?;
        Some(self.at)
    }

    /// Walks over an object or a list.
    fn members(&mut self, path: &mut String, on_path: bool, close: u8) -> Option<()> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        self.at += 1;
        self.blank();
        let mut index = 0;
        while self.peek()? != close {
            let key = self.at;
            let length = path.len();
            if close == b'}' {
                let name = self.string()?;
                self.blank();
                (self.peek()? == b':').then(|| self.at += 1)?;
                self.blank();
                if !path.is_empty() {
                    path.push('.');
                }
                path.push_str(&name);
            } else {
                path.push('[');
                path.push_str(&index.to_string());
                path.push(']');
                index += 1;
            }
            self.member(path, on_path, key)?;
            path.truncate(length);
            self.blank();
            if self.peek()? == b',' {
                self.at += 1;
                self.blank();
            }
        }
        self.at += 1;
        self.depth -= 1;
        Some(())
    }

    /// Walks over one value whose path is `path`, and remembers it if the target lies at or below it.
    fn member(&mut self, path: &mut String, on_path: bool, key: usize) -> Option<()> {
        let rest = self.target.strip_prefix(path.as_str());
        let leads =
            on_path && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
        let value = self.at;
        if !leads {
            return self.value(path, false).map(|_| ());
        }
        let depth = path.len();
        let exact = rest.is_some_and(str::is_empty);
        let is_better =
            |best: &Option<(usize, SourceSpan)>| best.is_none_or(|(len, _)| len <= depth);
        let place = SourceSpan {
            key,
            value,
            end: self.text.len(),
            exact,
        };
        if is_better(&self.best) {
            self.best = Some((depth, place));
        }
        let end = self.value(path, true)?;
        if let Some((_, best)) = self.best.as_mut().filter(|(len, _)| *len == depth) {
            best.end = end;
        }
        Some(())
    }

    /// Walks over a string; its content.
    fn string(&mut self) -> Option<String> {
        let start = self.at;
        if self.peek()? != b'"' {
            return None;
        }
        self.at += 1;
        loop {
            match self.peek()? {
                b'\\' => self.at += 2,
                b'"' => break,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        serde_json::from_str(self.text.get(start..self.at)?).ok()
    }
}
