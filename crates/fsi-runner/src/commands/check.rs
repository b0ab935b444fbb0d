//! `fsi-runner check`.

use case::{Case, Estimate, StepEstimate};

use crate::cli::CaseArguments;
use crate::failure::Failure;
use crate::locate;
use crate::output::progress::duration;
use crate::simulation::{self, Simulation};

/// Steps timed for the estimate of the run time.
const TIMED_STEPS: u32 = 3;

/// Validates and builds a case, times a few steps of it, and prints what a run will take.
///
/// # Errors
/// The case is wrong, or its first steps fail.
pub fn execute(arguments: &CaseArguments) -> Result<(), Failure> {
    let path = locate::case_file(&arguments.case)?;
    let case = Case::load(&path, &arguments.overrides)?;
    println!("case        {}: {}", case.name(), case.description());
    println!("file        {}", path.display());
    let (mut simulation, notes) = simulation::assemble_with_notes(&case)?;
    for note in notes {
        println!("            {note}");
    }
    println!("particles   {}", simulation.counts());
    let estimate = case.estimate();
    println!("memory      {:.1} MB", estimate.memory as f64 / 1e6);
    print_time_steps(estimate);
    let step_seconds = time_steps(simulation.as_mut())?;
    println!(
        "run time    about {} on {} threads: {} steps of {:.2} ms, without output",
        duration(step_seconds * estimate.steps as f64),
        rayon::current_num_threads(),
        estimate.steps,
        step_seconds * 1e3
    );
    for warning in case.warnings() {
        println!("warning     {warning}");
    }
    println!("the case is valid");
    Ok(())
}

fn print_time_steps(estimate: &Estimate) {
    let line = |side: &str, step: &StepEstimate| {
        println!("time step   {side} {:.3e} s, limited by {}", step.value, step.term);
    };
    if let Some(step) = &estimate.fluid_step {
        line("fluid", step);
    }
    if let Some(step) = &estimate.solid_step {
        line("solid", step);
    }
    if estimate.fluid_step.is_some() && estimate.solid_step.is_some() {
        println!("            {} solid sub-steps in a fluid step", estimate.substeps);
    }
}

/// Wall time of one step (s), the least of a few: the machine may be busy.
fn time_steps(simulation: &mut dyn Simulation) -> Result<f64, Failure> {
    let mut least = f64::INFINITY;
    for _ in 0..TIMED_STEPS {
        let limit = simulation.time_step().map_err(Failure::physics)?;
        let begun = std::time::Instant::now();
        simulation.step(limit.value).map_err(Failure::physics)?;
        least = least.min(begun.elapsed().as_secs_f64());
    }
    Ok(least)
}
