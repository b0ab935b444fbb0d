//! The text of a case with overrides in place, and where its bytes came from.

use std::ops::Range;

use crate::CaseError;
use crate::outline::{Node, steps};

/// Where a stretch of the text came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    /// The file, starting at this byte.
    File(usize),
    /// The override with this index.
    Override(usize),
}

/// A case text with its origin.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    file_name: String,
    file_text: String,
    overrides: Vec<String>,
    text: String,
    pieces: Vec<(Range<usize>, Origin)>,
}

impl Source {
    /// The text of a file as it stands.
    pub(crate) fn new(file_name: &str, text: &str) -> Self {
        Self {
            file_name: file_name.to_owned(),
            file_text: text.to_owned(),
            overrides: Vec::new(),
            text: text.to_owned(),
            pieces: vec![(0..text.len(), Origin::File(0))],
        }
    }

    /// The text with all overrides in place.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// The file's name as given.
    pub(crate) fn file_name(&self) -> &str {
        &self.file_name
    }

    /// Replaces the bytes `range` by `replacement`, which `argument` asked for.
    pub(crate) fn replace(&mut self, range: Range<usize>, replacement: &str, argument: &str) {
        let index = self.overrides.len();
        self.overrides.push(argument.to_owned());
        let shift = |at: usize| at - range.len() + replacement.len();
        let mut pieces = Vec::with_capacity(self.pieces.len() + 2);
        for (piece, origin) in &self.pieces {
            if piece.start < range.start {
                pieces.push((piece.start..piece.end.min(range.start), *origin));
            }
        }
        pieces.push((range.start..range.start + replacement.len(), Origin::Override(index)));
        for (piece, origin) in &self.pieces {
            if piece.end > range.end {
                let cut = range.end.saturating_sub(piece.start);
                let origin = match *origin {
                    Origin::File(at) => Origin::File(at + cut),
                    other => other,
                };
                pieces.push((shift(piece.start.max(range.end))..shift(piece.end), origin));
            }
        }
        self.text.replace_range(range.clone(), replacement);
        self.pieces = pieces;
    }

    /// An error at the bytes `range` of the text.
    pub(crate) fn error_at(&self, range: Range<usize>, path: &str, message: String) -> CaseError {
        let piece = self
            .pieces
            .iter()
            .find(|(piece, _)| piece.contains(&range.start))
            .or_else(|| self.pieces.last());
        match piece {
            Some((_, Origin::Override(index))) => {
                let argument = self.overrides.get(*index).map_or("", String::as_str);
                CaseError::new(format!("--set {argument}"), path, message)
            }
            Some((piece, Origin::File(at))) => {
                let start = at + range.start.saturating_sub(piece.start);
                // A value that holds an override ends elsewhere in the file: show its start.
                let whole = range.end <= piece.end;
                let length = if whole { range.end.saturating_sub(range.start) } else { 1 };
                self.error_in_file(start, length, path, message)
            }
            None => CaseError::new(&self.file_name, path, message),
        }
    }

    /// An error at the value of a field, or at the deepest value around it.
    pub(crate) fn error_at_path(&self, path: &str, message: String) -> CaseError {
        match Node::parse(&self.text) {
            Ok(root) => {
                let (node, done) = root.locate(&steps(path));
                // A field that is not there is shown by the opening of what should hold it.
                let exact = done == steps(path).len();
                let end = if exact { node.span.end } else { node.span.start + 1 };
                self.error_at(node.span.start..end, path, message)
            }
            Err(_) => CaseError::new(&self.file_name, path, message),
        }
    }

    fn error_in_file(&self, start: usize, length: usize, path: &str, message: String) -> CaseError {
        let text = &self.file_text;
        let start = floor_boundary(text, start.min(text.len()));
        let end = floor_boundary(text, (start + length).min(text.len())).max(start);
        let (line, column) = line_and_column(text, start);
        // Long values, such as a whole body, are pointed at by their first line.
        let first_line = text[start..end].find('\n').map_or(end, |length| start + length);
        CaseError::new(format!("{}:{line}:{column}", self.file_name), path, message).with_snippet(
            &self.file_name,
            text,
            start..first_line,
        )
    }

    /// Byte offset in the text of a `ron` position (line and column from 1, in characters).
    pub(crate) fn offset(&self, line: usize, column: usize) -> usize {
        let mut start = 0;
        for (index, content) in self.text.split_inclusive('\n').enumerate() {
            if index + 1 == line {
                let within: usize =
                    content.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum();
                return start + within;
            }
            start += content.len();
        }
        self.text.len()
    }
}

fn floor_boundary(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Line and column (in characters) of a byte, both from 1.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_survive_a_replacement() {
        let text = "(\n  a: 1,\n  b: 2,\n  c: 3,\n)";
        let mut source = Source::new("x.ron", text);
        let at = text.find('2').unwrap();
        source.replace(at..at + 1, "[10, 20]", "b=[10, 20]");
        assert_eq!(source.error_at_path("a", String::new()).place(), "x.ron:2:6");
        assert_eq!(source.error_at_path("b[1]", String::new()).place(), "--set b=[10, 20]");
        assert_eq!(source.error_at_path("c", String::new()).place(), "x.ron:4:6");
        assert_eq!(source.error_at_path("d", String::new()).place(), "x.ron:1:1");
    }
}
