//! `fsi-runner run`.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use case::Case;

use crate::cli::RunArguments;
use crate::failure::Failure;
use crate::folder::{self, RunFolder};
use crate::locate;
use crate::output::checkpoint::{Checkpoint, case_fingerprint};
use crate::output::frame::RunHeader;
use crate::output::rerun_options::RerunTarget;
use crate::output::run_reader::RunReader;
use crate::recorder::{Recorder, RecorderSettings};
use crate::run::{Ending, Recorded, Schedule, run};
use crate::simulation;
use crate::summary::{Cost, summary};

/// Runs a case and prints the summary.
///
/// # Errors
/// Bad input, failed physics, unwritable files, or an interruption.
pub fn execute(arguments: &RunArguments) -> Result<(), Failure> {
    let path = locate::case_file(&arguments.case.case)?;
    let case = Case::load(&path, &arguments.case.overrides)?;
    let folder = if arguments.resume {
        let path = arguments.out.clone().unwrap_or_else(|| PathBuf::from("runs").join(case.name()));
        RunFolder::new(path, case.name())
    } else {
        folder::choose(arguments.out.as_deref(), case.name(), arguments.overwrite)?
    };
    run_case(&case, folder, arguments)
}

/// Runs a checked case into a folder.
///
/// # Errors
/// See [`execute`].
pub fn run_case(case: &Case, folder: RunFolder, arguments: &RunArguments) -> Result<(), Failure> {
    let overrides = &arguments.case.overrides;
    let end_time = arguments.until.unwrap_or_else(|| case.end_time());
    if !(end_time.is_finite() && end_time > 0.0) {
        return Err(Failure::input(format!("--until is {end_time} s; it must be above 0")));
    }
    let mut simulation = simulation::assemble(case)?;
    let case_hash = case_fingerprint(case.text(), overrides);
    let mut recorded = Recorded::default();
    if arguments.resume {
        let checkpoint = Checkpoint::read(&folder.checkpoint(), case_hash)
            .map_err(|error| Failure::input(format!("cannot resume: {error}")))?;
        simulation.load(&checkpoint)?;
        recorded = Recorded::from_checkpoint(&checkpoint);
    }
    print_opening(case, simulation.as_ref(), &folder);

    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    // Only the first run of a process can install the handler; `verify` runs several.
    let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));

    let target = rerun_target(arguments, &folder, simulation.steps());
    let recording = match &target {
        Some(RerunTarget::File(path)) => Some(path.clone()),
        _ => None,
    };
    let header = if arguments.resume {
        RunReader::open(&folder.hdf5())?.header()?
    } else {
        RunHeader::new(case.name(), case.text(), overrides, case.dimension(), case.gravity())
    };
    let settings = RecorderSettings {
        folder: folder.clone(),
        header: &header,
        case_hash,
        rerun: target,
        solid_colour: arguments.solid_colour,
        end_time,
        resume: arguments.resume,
    };
    let mut recorder = Recorder::open(settings, simulation.as_ref())?;
    let schedule = Schedule { end_time, output: case.output() };
    let (begun, first_step) = (Instant::now(), simulation.steps());
    let ending = run(simulation.as_mut(), &schedule, &mut recorder, &mut recorded, &interrupted)?;
    let cost = Cost {
        steps: simulation.steps() - first_step,
        elapsed: begun.elapsed(),
        threads: rayon::current_num_threads(),
    };
    let extremes = recorder.close()?;
    print!("{}", summary(simulation.as_ref(), &cost, &extremes, &folder, recording.as_deref()));
    match ending {
        Ending::Finished | Ending::Relaxed => Ok(()),
        Ending::Interrupted => Err(Failure::interrupted(format!(
            "interrupted at t = {:.6} s; continue with: fsi-runner run {} --out {} --resume{}",
            simulation.time(),
            arguments.case.case.display(),
            folder.path.display(),
            overrides.iter().map(|item| format!(" --set '{item}'")).collect::<String>(),
        ))),
    }
}

/// Where the run is logged for Rerun, when it begins at `step`.
fn rerun_target(arguments: &RunArguments, folder: &RunFolder, step: u64) -> Option<RerunTarget> {
    if arguments.viewer {
        return Some(RerunTarget::Spawn);
    }
    if arguments.no_rrd || cfg!(not(feature = "rerun")) {
        return None;
    }
    let usual = || if arguments.resume { folder.resumed_rerun(step) } else { folder.rerun() };
    Some(RerunTarget::File(arguments.rrd.clone().unwrap_or_else(usual)))
}

fn print_opening(case: &Case, simulation: &dyn simulation::Simulation, folder: &RunFolder) {
    println!("case        {}: {}", case.name(), case.description());
    println!("particles   {}", simulation.counts());
    println!("output      {}", folder.path.display());
}
