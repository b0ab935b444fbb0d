//! Finds the case that the user named.

use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// The case file that `argument` means: a file, a folder with a `case.ron`, or
/// the name of a folder in `cases/`.
///
/// # Errors
/// [`Failure::input`] with the nearest name when there is no such case.
pub fn case_file(argument: &Path) -> Result<PathBuf, Failure> {
    let named = Path::new("cases").join(argument);
    for candidate in [argument, named.as_path()] {
        if candidate.is_file() {
            return Ok(candidate.to_owned());
        }
        let inside = candidate.join("case.ron");
        if inside.is_file() {
            return Ok(inside);
        }
    }
    let wanted = argument.file_name().map_or(String::new(), |n| n.to_string_lossy().into_owned());
    let names = case_names(Path::new("cases"));
    let hint = match case::nearest_name(&wanted, names.iter().map(String::as_str)) {
        Some(name) => format!("did you mean `{name}`? Known cases: {}", names.join(", ")),
        None if names.is_empty() => {
            "there is no folder `cases` here; give the path of a case file".to_owned()
        }
        None => format!("known cases: {}", names.join(", ")),
    };
    Err(Failure::input(format!("no case at {}; {hint}", argument.display())))
}

/// Names of the folders below `cases` that hold a `case.ron`, sorted.
pub fn case_names(cases: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(cases) else { return Vec::new() };
    let mut names: Vec<String> = entries
        .filter_map(Result::ok)
        .filter(|entry| entry.path().join("case.ron").is_file())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}
