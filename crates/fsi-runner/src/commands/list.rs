//! `fsi-runner list`.

use std::path::Path;

use case::Case;

use crate::failure::Failure;
use crate::locate;

/// Prints name, dimension and description of every case.
///
/// # Errors
/// The folder holds no case.
pub fn execute(cases: &Path) -> Result<(), Failure> {
    let names = locate::case_names(cases);
    if names.is_empty() {
        return Err(Failure::input(format!(
            "no case in {}: a case is a folder with a case.ron",
            cases.display()
        )));
    }
    let width = names.iter().map(String::len).max().unwrap_or(0);
    for name in names {
        match Case::load(cases.join(&name).join("case.ron"), &[]) {
            Ok(case) => println!("{name:width$}  {}D  {}", case.dimension(), case.description()),
            Err(error) => println!("{name:width$}  cannot be read: {error}"),
        }
    }
    Ok(())
}
