//! `fsi-runner material`: a body's law at one point.

use std::path::Path;

use case::Case;
use gimpm::path::{PathPoint, StrainPath, biaxial_stress, plane_strain_stress, uniaxial_stress};
use gimpm::{MaterialModel, Tensor};

use crate::cli::{MaterialArguments, MaterialPath};
use crate::failure::Failure;
use crate::locate;

/// Rows printed; a CSV file has them all.
const PRINTED_ROWS: usize = 20;

const CSV_COLUMNS: [&str; 10] = [
    "strain [1]",
    "stress_xx [Pa]",
    "stress_yy [Pa]",
    "stress_zz [Pa]",
    "stress_xy [Pa]",
    "stress_yz [Pa]",
    "stress_xz [Pa]",
    "plastic_strain [1]",
    "stored_energy [J/m^3]",
    "work [J/m^3]",
];

/// Drives the law of a body along a path and prints stress, plastic strain and energy.
///
/// # Errors
/// The case or the body is unknown, a strain cannot be reached, the file cannot be written.
pub fn execute(arguments: &MaterialArguments) -> Result<(), Failure> {
    let path = locate::case_file(&arguments.case.case)?;
    let case = Case::load(&path, &arguments.case.overrides)?;
    let body = find(&case, arguments.body.as_deref())?;
    let (name, law, model) = (&body.name, body.material.law(), body.material.model());
    let points = drive(&model, arguments)?;
    println!("body        {name}: {law}");
    println!("path        {:?}, {} steps a leg", arguments.path, arguments.steps);
    print_table(&points, arguments.path);
    if let Some(file) = &arguments.csv {
        write_csv(file, &points, arguments.path)?;
        println!("file        {}", file.display());
    }
    Ok(())
}

/// The body of that name; without one, the only body.
fn find<'a>(case: &'a Case, name: Option<&str>) -> Result<&'a case::format::BodyForm, Failure> {
    let bodies = case.form().solid.as_ref().map_or(&[][..], |solid| &solid.bodies);
    let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
    let list = names.join(", ");
    match name {
        None if bodies.is_empty() => {
            Err(Failure::input(format!("case {} has no solid, so no material", case.name())))
        }
        None => match bodies {
            [body] => Ok(body),
            _ => Err(Failure::input(format!("name one of the bodies by --body: {list}"))),
        },
        Some(name) => bodies.iter().find(|body| body.name == name).ok_or_else(|| {
            let hint = case::nearest_name(name, names.iter().copied())
                .map_or(String::new(), |near| format!("; did you mean `{near}`?"));
            let known = if list.is_empty() { "it has no bodies".into() } else { list.clone() };
            Failure::input(format!("case {} has no body `{name}`{hint} ({known})", case.name()))
        }),
    }
}

fn drive(model: &MaterialModel, arguments: &MaterialArguments) -> Result<Vec<PathPoint>, Failure> {
    let (strains, path) = (&arguments.strain, arguments.path);
    let steps = arguments.steps as usize;
    for &strain in strains {
        let possible = strain.is_finite() && (path == MaterialPath::SimpleShear || strain > -1.0);
        if !possible {
            return Err(Failure::input(format!(
                "--strain is {strain}; it must be a finite number{}",
                if path == MaterialPath::SimpleShear {
                    ""
                } else {
                    " above -1, where nothing is left"
                }
            )));
        }
    }
    let corners: Vec<f64> = strains.iter().map(|strain| 1.0 + strain).collect();
    let stretches = gimpm::path::stretches(&corners, steps);
    let along = |gradient: fn(f64) -> Tensor<f64>| {
        let corners: Vec<_> = strains.iter().map(|&strain| gradient(strain)).collect();
        Ok(StrainPath::through(&corners, steps).drive(model))
    };
    let points = match path {
        MaterialPath::UniaxialStress => uniaxial_stress(model, &stretches),
        MaterialPath::BiaxialStress => biaxial_stress(model, &stretches),
        MaterialPath::PlaneStrain => plane_strain_stress(model, &stretches),
        MaterialPath::UniaxialStrain => along(|e| Tensor::diagonal([1.0 + e, 1.0, 1.0])),
        MaterialPath::VolumetricStrain => along(|e| Tensor::diagonal([1.0 + e; 3])),
        MaterialPath::SimpleShear => {
            along(|e| Tensor([[1.0, e, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]))
        }
    }
    .map_err(Failure::physics)?;
    let broken = points.iter().position(|point| !point.stress.iter().all(|s| s.is_finite()));
    match broken {
        Some(step) => Err(Failure::physics(format!(
            "the stress is not finite at step {step}, strain {:.6e}: the law does not reach so far",
            strain(&points[step], path)
        ))),
        None => Ok(points),
    }
}

/// The strain that drives the path: `F_xx - 1`, in shear `F_xy`.
fn strain(point: &PathPoint, path: MaterialPath) -> f64 {
    let gradient = &point.deformation_gradient.0;
    if path == MaterialPath::SimpleShear { gradient[0][1] } else { gradient[0][0] - 1.0 }
}

/// Values of a row, in the order of [`CSV_COLUMNS`].
fn row(point: &PathPoint, path: MaterialPath) -> [f64; 10] {
    let [xx, yy, zz, xy, yz, xz] = point.stress;
    let [plastic_strain, _] = point.history;
    let (energy, work) = (point.stored_energy, point.work);
    [strain(point, path), xx, yy, zz, xy, yz, xz, plastic_strain, energy, work]
}

fn print_table(points: &[PathPoint], path: MaterialPath) {
    println!(
        "{:>12} {:>13} {:>13} {:>13} {:>13} {:>12} {:>12} {:>12}",
        "strain", "xx [Pa]", "yy [Pa]", "zz [Pa]", "xy [Pa]", "plastic", "W [J/m³]", "work [J/m³]"
    );
    let last = points.len() - 1;
    let stride = last.div_ceil(PRINTED_ROWS).max(1);
    for (step, point) in points.iter().enumerate() {
        if step % stride == 0 || step == last {
            let [strain, xx, yy, zz, xy, _, _, plastic, energy, work] = row(point, path);
            println!(
                "{strain:>12.4e} {xx:>13.5e} {yy:>13.5e} {zz:>13.5e} {xy:>13.5e} {plastic:>12.4e} \
                 {energy:>12.4e} {work:>12.4e}"
            );
        }
    }
}

fn write_csv(file: &Path, points: &[PathPoint], path: MaterialPath) -> Result<(), Failure> {
    let fault =
        |error: csv::Error| Failure::run(format!("cannot write {}: {error}", file.display()));
    let mut writer = csv::Writer::from_path(file).map_err(fault)?;
    writer.write_record(CSV_COLUMNS).map_err(fault)?;
    for point in points {
        // Enough digits to read back the same number.
        writer.write_record(row(point, path).map(|value| format!("{value:?}"))).map_err(fault)?;
    }
    writer.flush().map_err(|error| fault(error.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::CaseArguments;

    /// A bar of E = 100 Pa and ν = 0.25, and one of a metal that yields at 1 Pa.
    const CASE: &str = r#"(
        name: "bars", dimension: 2, gravity: [0.0, 0.0], end_time: 1.0,
        solid: (grid_spacing: 1.0, bodies: [
            (name: "elastic", shape: Box(lower: [0.0, 0.0], upper: [2.0, 1.0]),
             material: LinearElastic(density: 1.0, young_modulus: 100.0, poisson_ratio: 0.25)),
            (name: "metal", shape: Box(lower: [4.0, 0.0], upper: [6.0, 1.0]),
             material: VonMises(density: 1.0, young_modulus: 100.0, poisson_ratio: 0.25, yield_stress: 1.0)),
        ]),
        output: (frame_interval: 0.1),
    )"#;

    fn arguments(body: Option<&str>, path: MaterialPath, strain: &[f64]) -> MaterialArguments {
        MaterialArguments {
            case: CaseArguments { case: "bars.ron".into(), overrides: Vec::new() },
            body: body.map(Into::into),
            path,
            strain: strain.to_vec(),
            steps: 100,
            csv: None,
        }
    }

    fn end(body: &str, path: MaterialPath, strain: &[f64]) -> [f64; 10] {
        let case = Case::parse("bars.ron", CASE, &[]).unwrap();
        let model = find(&case, Some(body)).unwrap().material.model();
        let points = drive(&model, &arguments(Some(body), path, strain)).unwrap();
        row(points.last().unwrap(), path)
    }

    #[test]
    fn paths_give_the_moduli_of_an_elastic_law() {
        let (e, nu) = (100.0, 0.25);
        let strain = 1e-5;
        for (path, modulus, stress) in [
            (MaterialPath::UniaxialStress, e, 1),
            (MaterialPath::BiaxialStress, e / (1.0 - nu), 1),
            (MaterialPath::PlaneStrain, e / (1.0 - nu * nu), 1),
            (MaterialPath::UniaxialStrain, e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)), 1),
            (MaterialPath::VolumetricStrain, e / (1.0 - 2.0 * nu), 1),
            (MaterialPath::SimpleShear, 0.5 * e / (1.0 + nu), 4),
        ] {
            let end = end("elastic", path, &[strain]);
            assert!((end[0] / strain - 1.0).abs() < 1e-9, "{path:?}: {end:?}");
            assert!((end[stress] / (modulus * strain) - 1.0).abs() < 1e-4, "{path:?}: {end:?}");
        }
    }

    #[test]
    fn a_metal_yields_and_keeps_its_plastic_strain_on_the_way_back() {
        let there = end("metal", MaterialPath::UniaxialStress, &[0.02]);
        assert!((there[1] - 1.0).abs() < 1e-3, "{there:?}");
        // ε - σ/E at small strain.
        assert!((there[7] - 0.01).abs() < 2e-4, "{there:?}");
        let back = end("metal", MaterialPath::UniaxialStress, &[0.02, 0.015]);
        assert!((back[7] - there[7]).abs() < 1e-9, "{back:?}");
    }

    #[test]
    fn unknown_bodies_and_impossible_strains_are_refused() {
        let case = Case::parse("bars.ron", CASE, &[]).unwrap();
        let text = |failure: Failure| failure.report().to_string();
        let error = text(find(&case, Some("mettal")).map(|_| ()).unwrap_err());
        assert!(error.contains("did you mean `metal`?"), "{error}");
        let error = text(find(&case, None).map(|_| ()).unwrap_err());
        assert!(error.contains("--body: elastic, metal"), "{error}");
        let model = find(&case, Some("metal")).unwrap().material.model();
        for strain in [-1.0, f64::NAN] {
            let wrong = arguments(None, MaterialPath::UniaxialStress, &[strain]);
            let error = text(drive(&model, &wrong).map(|_| ()).unwrap_err());
            assert!(error.contains("above -1"), "{error}");
        }
    }

    #[test]
    fn the_file_holds_every_step() {
        let case = Case::parse("bars.ron", CASE, &[]).unwrap();
        let model = find(&case, Some("elastic")).unwrap().material.model();
        let path = MaterialPath::UniaxialStrain;
        let points = drive(&model, &arguments(None, path, &[0.01, 0.0])).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("law.csv");
        write_csv(&file, &points, path).unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        assert_eq!(text.lines().count(), 1 + 201);
        assert!(text.starts_with("strain [1],stress_xx [Pa],"));
        assert!(write_csv(&folder.path().join("no/law.csv"), &points, path).is_err());
    }
}
