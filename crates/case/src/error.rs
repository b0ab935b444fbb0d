//! The error of everything in this crate.

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};

/// What is wrong with a case, where, and what is allowed.
///
/// Its text reads `file:line:column: message (at `path`). help`; printed by
/// miette it also shows the lines of the file. Several independent mistakes
/// are reported together: the first is this error, the others are related to it.
#[derive(Debug, Clone)]
pub struct CaseError(Box<Details>);

#[derive(Debug, Clone)]
struct Details {
    place: String,
    path: String,
    message: String,
    help: Option<String>,
    source: Option<NamedSource<String>>,
    label: Option<LabeledSpan>,
    related: Vec<CaseError>,
}

impl CaseError {
    /// An error at `place`, which is `file:line:column`, `--set …` or a file name.
    pub(crate) fn new(
        place: impl Into<String>,
        path: impl Into<String>,
        message: impl Into<String>,
    ) -> Self {
        Self(Box::new(Details {
            place: place.into(),
            path: path.into(),
            message: message.into(),
            help: None,
            source: None,
            label: None,
            related: Vec::new(),
        }))
    }

    /// Adds what is allowed or what to do.
    pub(crate) fn with_help(mut self, help: Option<String>) -> Self {
        self.0.help = help;
        self
    }

    /// Adds the lines to show: `name` and `text` of the file, byte range in it.
    pub(crate) fn with_snippet(
        mut self,
        name: &str,
        text: &str,
        range: std::ops::Range<usize>,
    ) -> Self {
        self.0.source = Some(NamedSource::new(name, text.to_owned()));
        self.0.label = Some(LabeledSpan::at(range, "here"));
        self
    }

    /// Adds further independent errors.
    pub(crate) fn with_related(mut self, related: Vec<CaseError>) -> Self {
        self.0.related = related;
        self
    }

    /// `file:line:column`, or `--set …` for an override, or the file's name.
    pub fn place(&self) -> &str {
        &self.0.place
    }

    /// Path of the field, such as `solid.bodies[0].material.poisson_ratio`;
    /// empty when the error concerns the whole file.
    pub fn path(&self) -> &str {
        &self.0.path
    }

    /// What is wrong, without place and path.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// What is allowed, or what to do.
    pub fn advice(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Further independent errors in the same case.
    pub fn others(&self) -> &[CaseError] {
        &self.0.related
    }
}

impl std::fmt::Display for CaseError {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{}: {}", self.0.place, self.0.message)?;
        if !self.0.path.is_empty() {
            write!(out, " (at `{}`)", self.0.path)?;
        }
        match &self.0.help {
            // Without a terminal the help line of miette is lost, so it is part of the text.
            Some(help) => write!(out, "; {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for CaseError {}

impl Diagnostic for CaseError {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = self.0.label.clone()?;
        Some(Box::new(std::iter::once(label)))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        if self.0.related.is_empty() {
            return None;
        }
        Some(Box::new(self.0.related.iter().map(|error| error as &dyn Diagnostic)))
    }
}
