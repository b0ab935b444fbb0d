//! Reading a RON file with errors that name file, line, column, field and remedy.

use super::{VerifyError, error::suggestion};
use ron::extensions::Extensions;
use serde::de::DeserializeOwned;
use std::path::Path;

/// Reads `path` as a `T`; `implicit_some` and unwrapped newtypes as in case files.
pub(super) fn read<T: DeserializeOwned>(path: &Path) -> Result<T, VerifyError> {
    let text = std::fs::read_to_string(path)
        .map_err(|e| VerifyError::Read { path: path.into(), reason: e.to_string() })?;
    parse(path, &text)
}

/// Parses `text`; `path` is only named in errors.
pub(super) fn parse<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, VerifyError> {
    let options = ron::Options::default().with_default_extension(
        Extensions::IMPLICIT_SOME
            | Extensions::UNWRAP_NEWTYPES
            | Extensions::UNWRAP_VARIANT_NEWTYPES,
    );
    let format_error = |field: String, error: ron::error::SpannedError| VerifyError::Format {
        path: path.into(),
        line: error.span.start.line,
        column: error.span.start.col,
        field,
        message: explain(&error.code),
    };
    let mut deserializer = ron::de::Deserializer::from_str_with_options(text, &options)
        .map_err(|e| format_error(".".into(), e))?;
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|e| {
        let field = e.path().to_string();
        format_error(field, deserializer.span_error(e.into_inner()))
    })?;
    deserializer.end().map_err(|e| format_error(".".into(), deserializer.span_error(e)))?;
    Ok(value)
}

/// The message with the list of allowed names and the nearest of them.
fn explain(error: &ron::Error) -> String {
    match error {
        ron::Error::NoSuchStructField { expected, found, .. } => {
            format!("unknown field `{found}`{}", allowed(found, expected))
        }
        ron::Error::NoSuchEnumVariant { expected, found, .. } => {
            format!("unknown variant `{found}`{}", allowed(found, expected))
        }
        other => other.to_string(),
    }
}

fn allowed(found: &str, expected: &[&'static str]) -> String {
    format!("{}; allowed are {}", suggestion(found, expected.iter().copied()), expected.join(", "))
}
