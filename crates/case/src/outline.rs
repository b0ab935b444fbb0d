//! Where each field of a RON text stands.
//!
//! The values are read by `ron`; this index only answers "which bytes hold
//! `solid.bodies[0].shape.lower`?", for error messages and for overrides.

use std::ops::Range;

/// Deepest nesting that is followed; `ron` refuses more than 128 levels itself.
const DEEPEST: usize = 160;

/// One value of the text with the values inside it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    /// Bytes of the whole value, a variant name included.
    pub(crate) span: Range<usize>,
    /// What is inside.
    pub(crate) content: Content,
}

/// The inside of a value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Content {
    /// A number, string or bare name.
    Leaf,
    /// `(name: value, …)`: name, bytes of the name, value.
    Fields { open: usize, fields: Vec<(String, Range<usize>, Node)> },
    /// `[value, …]`.
    List(Vec<Node>),
    /// `(value, …)`, also `()`.
    Tuple { open: usize, items: Vec<Node> },
}

/// One step of a path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Step {
    /// A field.
    Name(String),
    /// An entry of a list, from 0.
    Index(usize),
}

/// The text is not RON, at this byte.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NotRon(pub(crate) usize);

/// Splits `a.b[0].c` or `a.b.0.c`.
pub(crate) fn steps(path: &str) -> Vec<Step> {
    path.split(['.', '[', ']'])
        .filter(|part| !part.is_empty())
        .map(|part| match part.parse() {
            Ok(index) => Step::Index(index),
            Err(_) => Step::Name(part.to_owned()),
        })
        .collect()
}

impl Node {
    /// Indexes a whole RON text.
    pub(crate) fn parse(text: &str) -> Result<Self, NotRon> {
        let mut reader = Reader { text, at: 0 };
        reader.skip_blank()?;
        while reader.rest().starts_with("#!") {
            let end = reader.rest().find(']').ok_or(NotRon(reader.at))?;
            reader.at += end + 1;
            reader.skip_blank()?;
        }
        let node = reader.value(0)?;
        reader.skip_blank()?;
        if reader.at == text.len() { Ok(node) } else { Err(NotRon(reader.at)) }
    }

    /// The value `step` inside this one. A variant with one nameless value,
    /// such as `Add(Box(…))`, is looked through.
    pub(crate) fn child(&self, step: &Step) -> Option<&Node> {
        match (&self.content, step) {
            (Content::Fields { fields, .. }, Step::Name(name)) => {
                fields.iter().find(|field| field.0 == *name).map(|field| &field.2)
            }
            (Content::List(items), Step::Index(index)) => items.get(*index),
            (Content::Tuple { items, .. }, _) => match (items.as_slice(), step) {
                ([only], _) => only.child(step),
                (_, Step::Index(index)) => items.get(*index),
                (_, Step::Name(_)) => None,
            },
            _ => None,
        }
    }

    /// The deepest value on the way to `path`, and how many steps lead there.
    pub(crate) fn locate(&self, path: &[Step]) -> (&Node, usize) {
        let mut node = self;
        for (done, step) in path.iter().enumerate() {
            match node.child(step) {
                Some(child) => node = child,
                None => return (node, done),
            }
        }
        (node, path.len())
    }
}

/// A cursor in the text.
struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn error<T>(&self) -> Result<T, NotRon> {
        Err(NotRon(self.at))
    }

    fn take(&mut self, expected: char) -> bool {
        let found = self.peek() == Some(expected);
        if found {
            self.at += expected.len_utf8();
        }
        found
    }

    /// Skips white space and comments; block comments nest.
    fn skip_blank(&mut self) -> Result<(), NotRon> {
        loop {
            self.skip_while(char::is_whitespace);
            if self.rest().starts_with("//") {
                self.skip_while(|c| c != '\n');
            } else if self.rest().starts_with("/*") {
                let start = self.at;
                let mut depth = 0_usize;
                loop {
                    if self.rest().starts_with("/*") {
                        depth += 1;
                        self.at += 2;
                    } else if self.rest().starts_with("*/") {
                        depth -= 1;
                        self.at += 2;
                        if depth == 0 {
                            break;
                        }
                    } else if let Some(c) = self.peek() {
                        self.at += c.len_utf8();
                    } else {
                        return Err(NotRon(start));
                    }
                }
            } else {
                return Ok(());
            }
        }
    }

    fn skip_while(&mut self, wanted: impl Fn(char) -> bool) {
        let length = self.rest().find(|c| !wanted(c)).unwrap_or(self.rest().len());
        self.at += length;
    }

    fn value(&mut self, depth: usize) -> Result<Node, NotRon> {
        if depth > DEEPEST {
            return self.error();
        }
        let start = self.at;
        let content = match self.peek() {
            Some('[') => {
                self.at += 1;
                Content::List(self.items(']', depth)?)
            }
            Some('(') => self.parenthesis(depth)?,
            Some('"') => self.string()?,
            Some('\'') => self.character()?,
            Some(c) if c.is_alphabetic() || c == '_' => self.word(depth)?,
            Some(c) if c.is_ascii_digit() || "+-.".contains(c) => {
                self.skip_while(|c| c.is_alphanumeric() || "+-._".contains(c));
                Content::Leaf
            }
            _ => return self.error(),
        };
        Ok(Node { span: start..self.at, content })
    }

    /// A name, a variant with its values, or a raw string.
    fn word(&mut self, depth: usize) -> Result<Content, NotRon> {
        let start = self.at;
        self.skip_while(|c| c.is_alphanumeric() || c == '_');
        let word = &self.text[start..self.at];
        if matches!(word, "r" | "br" | "b") {
            let hashes = self.rest().chars().take_while(|&c| c == '#').count();
            if self.rest()[hashes..].starts_with('"') {
                self.at += hashes;
                let raw = word != "b";
                return if raw { self.raw_string(hashes) } else { self.string() };
            }
        }
        let end = self.at;
        self.skip_blank()?;
        if self.peek() == Some('(') {
            return self.parenthesis(depth);
        }
        self.at = end;
        Ok(Content::Leaf)
    }

    /// `( … )` with named or nameless values.
    fn parenthesis(&mut self, depth: usize) -> Result<Content, NotRon> {
        self.at += 1;
        let open = self.at;
        self.skip_blank()?;
        if !self.named_field_follows()? {
            return Ok(Content::Tuple { open, items: self.items(')', depth)? });
        }
        let mut fields = Vec::new();
        loop {
            self.skip_blank()?;
            if self.take(')') {
                return Ok(Content::Fields { open, fields });
            }
            let start = self.at;
            self.skip_while(|c| c.is_alphanumeric() || c == '_');
            let name = start..self.at;
            self.skip_blank()?;
            if name.is_empty() || !self.take(':') {
                return self.error();
            }
            self.skip_blank()?;
            let value = self.value(depth + 1)?;
            fields.push((self.text[name.clone()].to_owned(), name, value));
            self.skip_blank()?;
            if !self.take(',') && self.peek() != Some(')') {
                return self.error();
            }
        }
    }

    fn named_field_follows(&mut self) -> Result<bool, NotRon> {
        let start = self.at;
        self.skip_while(|c| c.is_alphanumeric() || c == '_');
        let named = self.at > start && {
            self.skip_blank()?;
            self.peek() == Some(':')
        };
        self.at = start;
        Ok(named)
    }

    fn items(&mut self, close: char, depth: usize) -> Result<Vec<Node>, NotRon> {
        let mut items = Vec::new();
        loop {
            self.skip_blank()?;
            if self.take(close) {
                return Ok(items);
            }
            items.push(self.value(depth + 1)?);
            self.skip_blank()?;
            if !self.take(',') && self.peek() != Some(close) {
                return self.error();
            }
        }
    }

    fn string(&mut self) -> Result<Content, NotRon> {
        let start = self.at;
        self.at += 1;
        loop {
            self.skip_while(|c| c != '"' && c != '\\');
            if self.take('"') {
                return Ok(Content::Leaf);
            }
            if !self.take('\\') {
                return Err(NotRon(start));
            }
            self.at += self.peek().map_or(0, char::len_utf8);
        }
    }

    fn raw_string(&mut self, hashes: usize) -> Result<Content, NotRon> {
        let start = self.at;
        self.at += 1;
        let close = format!("\"{}", "#".repeat(hashes));
        let length = self.rest().find(&close).ok_or(NotRon(start))?;
        self.at += length + close.len();
        Ok(Content::Leaf)
    }

    fn character(&mut self) -> Result<Content, NotRon> {
        self.at += 1;
        if self.take('\\') {
            self.at += self.peek().map_or(0, char::len_utf8);
        }
        self.skip_while(|c| c != '\'' && c != '\n');
        if self.take('\'') { Ok(Content::Leaf) } else { self.error() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text_at<'a>(text: &'a str, path: &str) -> &'a str {
        let root = Node::parse(text).unwrap();
        let (node, _) = root.locate(&steps(path));
        &text[node.span.clone()]
    }

    #[test]
    fn paths_find_their_values() {
        let text = r##"#![enable(implicit_some)]
        // a comment with (brackets: [
        ( name: "a \" ) b", raw: r#"x"y"#, list: [1, -2.5e-3, Named(x: 'c')],
          shape: Compose([Add(Box(lower: [0, 0])), Subtract(Sphere(radius: 1.0 /* ( /* */ */))]),
          speed: Factor(20.0), empty: (), )"##;
        assert_eq!(text_at(text, "name"), r#""a \" ) b""#);
        assert_eq!(text_at(text, "raw"), r##"r#"x"y"#"##);
        assert_eq!(text_at(text, "list[1]"), "-2.5e-3");
        assert_eq!(text_at(text, "list.2.x"), "'c'");
        assert_eq!(text_at(text, "shape[0].lower[1]"), "0");
        assert_eq!(text_at(text, "shape[1].radius"), "1.0");
        assert_eq!(text_at(text, "speed"), "Factor(20.0)");
        assert_eq!(text_at(text, "empty.x"), "()");
        let root = Node::parse(text).unwrap();
        assert_eq!(root.locate(&steps("list[7].x")).1, 1);
    }

    #[test]
    fn broken_text_is_refused_without_panic() {
        for text in ["", "(", "(a: )", "(a: 1", "[1 2]", "\"x", "(a: 1) b", "/* (", "r#\"x\"", "'"]
        {
            assert!(Node::parse(text).is_err(), "{text}");
        }
        let deep = "[".repeat(100_000);
        assert!(Node::parse(&deep).is_err());
    }
}
