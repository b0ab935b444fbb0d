//! Every case of the repository can be read, checked and built.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use case::{Case, CaseError, Model};

fn folder() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases")
}

fn summary<const D: usize>(model: &Model<D>) -> String {
    let estimate = &model.estimate;
    format!(
        "{}\n  {estimate:?}\n  notes:\n    {}\n  warnings:\n    {}",
        model.name,
        model.notes.join("\n    "),
        model.warnings.join("\n    ")
    )
}

/// Builds the case and hands its parts to the solvers, which check them again.
fn accepted<const D: usize>(case: &Case) -> Result<String, String> {
    let model = case.build::<D>().map_err(|error: CaseError| error.to_string())?;
    let text = summary(&model);
    if let Some(fluid) = model.fluid {
        sph::Fluid::new(fluid.parameters, fluid.particles, fluid.walls)
            .map_err(|error| error.to_string())?;
    }
    if let Some(solid) = model.solid {
        gimpm::Solid::new(solid.parameters, solid.bodies, solid.constraints)
            .map_err(|error| error.to_string())?;
    }
    Ok(text)
}

#[test]
fn every_case_builds_and_is_accepted_by_the_solvers() {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.join("case.ron").is_file() {
            let case = Case::load(&path, &[]).unwrap();
            let text = match case.dimension() {
                2 => accepted::<2>(&case),
                _ => accepted::<3>(&case),
            };
            println!("{}", text.unwrap());
            assert_eq!(path.file_name().unwrap().to_str().unwrap(), case.name());
            names.push(case.name().to_owned());
        }
    }
    assert!(names.len() >= 8, "{names:?}");
}
