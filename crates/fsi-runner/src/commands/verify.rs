//! `fsi-runner verify`.

use std::path::{Path, PathBuf};

use case::Case;

use crate::cli::{CaseArguments, RunArguments, VerifyArguments};
use crate::commands::run::run_case;
use crate::failure::Failure;
use crate::folder::RunFolder;
use crate::locate;
use crate::output::rerun_options::SolidColour;
use crate::output::run_reader::{Place, RunReader};
use crate::simulation;
use crate::verify::{
    CheckFile, FinalPoints, Histories, PointSource, ResultTable, Variant, VerifyError,
};

/// Runs each case into `--out`, prints its table, and fails if any gate is missed.
///
/// # Errors
/// An unknown name, a wrong check file, a failed run, or a missed gate.
pub fn execute(arguments: &VerifyArguments) -> Result<(), Failure> {
    let names = chosen(arguments)?;
    let variant = if arguments.quick { Variant::Quick } else { Variant::Full };
    // Every check file is read before anything runs: a typing error must not cost an hour.
    let cases = names
        .iter()
        .map(|name| Prepared::read(&arguments.cases.join(name), variant))
        .collect::<Result<Vec<_>, _>>()?;
    let (mut passed, mut missed) = (0, Vec::new());
    for prepared in &cases {
        let table = prepared.verify(arguments, variant)?;
        println!("\n{}{table}", prepared.case.name().to_owned() + "\n");
        if table.passed() {
            passed += 1;
        } else {
            missed.push(prepared.case.name());
        }
    }
    println!("{passed} passed, {} failed", missed.len());
    if missed.is_empty() {
        Ok(())
    } else {
        Err(Failure::run(format!("gates missed in: {}", missed.join(", "))))
    }
}

fn chosen(arguments: &VerifyArguments) -> Result<Vec<String>, Failure> {
    let known: Vec<String> = locate::case_names(&arguments.cases)
        .into_iter()
        .filter(|name| arguments.cases.join(name).join(CheckFile::NAME).is_file())
        .collect();
    for name in &arguments.names {
        if !known.contains(name) {
            let hint = case::nearest_name(name, known.iter().map(String::as_str))
                .map_or(String::new(), |near| format!("did you mean `{near}`? "));
            return Err(Failure::input(format!(
                "no case `{name}` with a {} in {}; {hint}known: {}",
                CheckFile::NAME,
                arguments.cases.display(),
                known.join(", ")
            )));
        }
    }
    Ok(if arguments.names.is_empty() { known } else { arguments.names.clone() })
}

/// A case with its checks, both read and agreeing.
struct Prepared {
    directory: PathBuf,
    case: Case,
    checks: CheckFile,
}

impl Prepared {
    fn read(directory: &Path, variant: Variant) -> Result<Self, Failure> {
        let checks = CheckFile::read(directory).map_err(Failure::input)?;
        let case = Case::load(directory.join("case.ron"), checks.overrides(variant))?;
        let simulation = simulation::assemble(&case)?;
        let columns: Vec<String> = simulation
            .gauge_columns()
            .into_iter()
            .chain(simulation.ledger_columns())
            .map(|column| column.name)
            .collect();
        for wanted in checks.columns() {
            if wanted != "time" && !columns.iter().any(|name| name == wanted) {
                let hint = case::nearest_name(wanted, columns.iter().map(String::as_str))
                    .map_or(String::new(), |near| format!("; did you mean `{near}`?"));
                return Err(Failure::input(format!(
                    "{}: no gauge or ledger column `{wanted}`{hint}",
                    directory.join(CheckFile::NAME).display()
                )));
            }
        }
        Ok(Self { directory: directory.to_owned(), case, checks })
    }

    fn verify(
        &self,
        arguments: &VerifyArguments,
        variant: Variant,
    ) -> Result<ResultTable, Failure> {
        let name = self.case.name();
        let suffix = if variant == Variant::Quick { "-quick" } else { "" };
        let folder = RunFolder::new(arguments.out.join(format!("{name}{suffix}")), name);
        if !(arguments.keep && folder.hdf5().exists()) {
            let run = RunArguments {
                case: CaseArguments {
                    case: self.directory.clone(),
                    overrides: self.checks.overrides(variant).to_vec(),
                },
                out: Some(folder.path.clone()),
                overwrite: true,
                resume: false,
                until: None,
                viewer: false,
                rrd: None,
                no_rrd: true,
                solid_colour: SolidColour::default(),
            };
            run_case(&self.case, folder.clone(), &run)?;
        }
        let histories = Histories::read(&folder.path).map_err(Failure::run)?;
        let points = LastFrame { folder };
        let rows = self.checks.evaluate(variant, &histories, &points).map_err(Failure::run)?;
        Ok(ResultTable(rows))
    }
}

/// The last frame of a run as the metrics ask for it.
struct LastFrame {
    folder: RunFolder,
}

impl PointSource for LastFrame {
    fn final_points(&self, body: &str) -> Result<FinalPoints, VerifyError> {
        let fault = |reason: String| VerifyError::Points { body: body.into(), reason };
        let cloud = format!("solid/{body}");
        let read = || {
            let run = RunReader::open(&self.folder.hdf5())?;
            let frames = run.frames()?;
            let Some(last) = frames.last() else { return Ok(None) };
            let place = Place::Frame(last.index);
            let position = run.position(place, &cloud)?;
            let displacement = run.field(place, &cloud, "displacement")?;
            let stress = run.field(place, &cloud, "stress")?;
            Ok(Some((position, displacement, stress)))
        };
        let data = read().map_err(|error: crate::output::OutputError| fault(error.to_string()))?;
        let (position, displacement, stress) =
            data.ok_or_else(|| fault("the run has no frame".into()))?;
        let reference_position = position
            .iter()
            .zip(displacement.as_chunks::<3>().0)
            .map(|(x, u)| std::array::from_fn(|axis| x[axis] - u[axis]))
            .collect();
        Ok(FinalPoints { position, reference_position, stress: stress.as_chunks::<6>().0.to_vec() })
    }
}
