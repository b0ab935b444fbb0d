//! Reading and checking a case file.

use std::path::Path;

use serde::Deserialize;
use serde_path_to_error::Segment;

use crate::build;
use crate::format::CaseForm;
use crate::plan::Plan;
use crate::source::Source;
use crate::{
    CaseError, Estimate, Model, OutputIntervals, memory, outline, overrides, suggestion, validate,
};

/// A case file that has passed every check that needs no particles.
#[derive(Debug, Clone)]
pub struct Case {
    form: CaseForm,
    source: Source,
    plan: Plan,
}

impl Case {
    /// Reads and checks a case file; a folder stands for the `case.ron` in it.
    ///
    /// Each of `overrides` is `path=value` with the path in dots and list
    /// indices and the value in RON, such as `fluid.spacing=0.05` or
    /// `solid.bodies.0.material.young_modulus=1e9`.
    ///
    /// # Errors
    /// [`CaseError`] for an unreadable file and for everything that [`Self::parse`] refuses.
    pub fn load(path: impl AsRef<Path>, overrides: &[String]) -> Result<Self, CaseError> {
        let path = path.as_ref();
        let file = if path.is_dir() { path.join("case.ron") } else { path.to_owned() };
        let name = file.display().to_string();
        let text = std::fs::read_to_string(&file).map_err(|error| {
            CaseError::new(&name, "", format!("cannot read the case file: {error}"))
                .with_help(Some("give a case file or a folder with a `case.ron`".into()))
        })?;
        Self::parse(&name, &text, overrides)
    }

    /// Checks the text of a case file; `file_name` is used in messages.
    ///
    /// # Errors
    /// [`CaseError`] with the place and path of the field, what is wrong, what is
    /// allowed, and the nearest valid name.
    pub fn parse(file_name: &str, text: &str, overrides: &[String]) -> Result<Self, CaseError> {
        let mut source = Source::new(file_name, text);
        for argument in overrides {
            overrides::apply(&mut source, argument)?;
        }
        let form = read(&source)?;
        let plan = validate::plan(&form, &source, memory::available())?;
        Ok(Self { form, source, plan })
    }

    /// Name of the case.
    pub fn name(&self) -> &str {
        &self.form.name
    }

    /// What the case shows, for people.
    pub fn description(&self) -> &str {
        &self.form.description
    }

    /// Simulated time at which the case ends (s).
    pub fn end_time(&self) -> f64 {
        self.plan.end_time
    }

    /// Acceleration of gravity (m/s²); z = 0 in 2D.
    pub fn gravity(&self) -> [f64; 3] {
        self.plan.gravity.into()
    }

    /// Output intervals (s).
    pub fn output(&self) -> OutputIntervals {
        self.plan.output
    }

    /// The case as written, overrides included.
    pub fn form(&self) -> &CaseForm {
        &self.form
    }

    /// 2 (plane strain) or 3: the `D` to call [`Self::build`] with.
    pub fn dimension(&self) -> usize {
        self.plan.dimension
    }

    /// Text of the case with all overrides in place.
    pub fn text(&self) -> &str {
        self.source.text()
    }

    /// Counts, memory and time steps, estimated without seeding anything.
    pub fn estimate(&self) -> &Estimate {
        &self.plan.estimate
    }

    /// What may be wrong but does not forbid the run.
    pub fn warnings(&self) -> &[String] {
        &self.plan.warnings
    }

    /// Fills all shapes and returns the inputs of the solvers.
    ///
    /// # Errors
    /// [`CaseError`] when `D` is not [`Self::dimension`], when a block or body
    /// holds no particle, and when fluid overlaps a wall, a body or other fluid.
    pub fn build<const D: usize>(&self) -> Result<Model<D>, CaseError> {
        build::model(&self.form, &self.source, &self.plan)
    }
}

/// Reads the text into the form of a case.
fn read(source: &Source) -> Result<CaseForm, CaseError> {
    use ron::extensions::Extensions;
    let options = ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_NEWTYPES);
    let fail = |error: &ron::error::SpannedError, path: String| located(source, error, path);
    let mut reader = ron::Deserializer::from_str_with_options(source.text(), &options)
        .map_err(|error| fail(&error, String::new()))?;
    let mut track = serde_path_to_error::Track::new();
    let tracked = serde_path_to_error::Deserializer::new(&mut reader, &mut track);
    let form = CaseForm::deserialize(tracked)
        .map_err(|error| fail(&reader.span_error(error), path_text(&track.path())))?;
    reader.end().map_err(|error| fail(&reader.span_error(error), String::new()))?;
    Ok(form)
}

/// The path without the names of variants, which a user does not write in it.
fn path_text(path: &serde_path_to_error::Path) -> String {
    let mut text = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => text.push_str(&format!("[{index}]")),
            Segment::Map { key } => {
                text.push_str(if text.is_empty() { "" } else { "." });
                text.push_str(key);
            }
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    text
}

/// A reader's error in the words and places of this crate.
fn located(source: &Source, error: &ron::error::SpannedError, mut path: String) -> CaseError {
    use ron::Error;
    let mut start = source.offset(error.span.start.line, error.span.start.col);
    let mut end = source.offset(error.span.end.line, error.span.end.col).max(start + 1);
    let of = |outer: &Option<String>| match outer {
        Some(name) => format!(" of `{name}`"),
        None => String::new(),
    };
    let (message, help) = match &error.code {
        Error::NoSuchStructField { expected, found, outer } => {
            (start, end) = word_before(source.text(), start, end, found);
            (
                format!("unknown field `{found}`{}", of(outer)),
                Some(suggestion::help(found, expected)),
            )
        }
        Error::NoSuchEnumVariant { expected, found, outer } => {
            (start, end) = word_before(source.text(), start, end, found);
            (
                format!("unknown choice `{found}`{}", of(outer)),
                Some(suggestion::help(found, expected)),
            )
        }
        Error::MissingStructField { field, outer } => {
            if let Some(span) = value_span(source, &path) {
                (start, end) = (span.start, span.start + 1);
            }
            path = if path.is_empty() { (*field).to_owned() } else { format!("{path}.{field}") };
            (
                format!("field `{field}`{} is missing", of(outer)),
                Some(format!("add `{field}: …`; docs/case.md describes it")),
            )
        }
        Error::DuplicateStructField { field, outer } => {
            (start, end) = word_before(source.text(), start, end, field);
            (
                format!("field `{field}`{} is given twice", of(outer)),
                Some("keep one of them".into()),
            )
        }
        other => {
            let mut message = other.to_string();
            // The reader stops before the blanks that lead to the value it could not use.
            if let Some(span) = value_span(source, &path).filter(|span| !span.contains(&start)) {
                (start, end) = (span.start, span.end);
                let found = source.text()[span].lines().next().unwrap_or_default();
                message.push_str(&format!(", found `{found}`"));
            }
            (message, None)
        }
    };
    source.error_at(start..end, &path, message).with_help(help)
}

/// Bytes of the value at a path, if it is there.
fn value_span(source: &Source, path: &str) -> Option<std::ops::Range<usize>> {
    let root = outline::Node::parse(source.text()).ok()?;
    let steps = outline::steps(path);
    let (node, done) = root.locate(&steps);
    (done == steps.len()).then(|| node.span.clone())
}

/// The last place of `word` at or before the reader's cursor.
fn word_before(text: &str, start: usize, end: usize, word: &str) -> (usize, usize) {
    let end = end.min(text.len());
    let before = text.get(..end).unwrap_or(text);
    match before.rfind(word) {
        Some(at) if start.saturating_sub(at) <= word.len() + 64 => (at, at + word.len()),
        _ => (start, end.max(start)),
    }
}
