//! The loop over time steps.

use std::sync::atomic::{AtomicBool, Ordering};

use case::OutputIntervals;

use crate::failure::Failure;
use crate::output::checkpoint::Checkpoint;
use crate::recorder::Recorder;
use crate::simulation::Simulation;

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The end time was reached.
    Finished,
    /// The solid found its static state before that.
    Relaxed,
    /// The user asked to stop; a checkpoint was written.
    Interrupted,
}

/// How long a run lasts and how often it records.
#[derive(Debug, Clone, Copy)]
pub struct Schedule {
    /// Simulated time at which the run ends (s).
    pub end_time: f64,
    /// Output intervals.
    pub output: OutputIntervals,
}

/// Which records have been made: part of every checkpoint, so that a resumed
/// run records at the same steps as an unbroken one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Recorded {
    /// Frames so far.
    pub frames: u64,
    /// Gauge rows so far.
    pub rows: u64,
    /// Checkpoint intervals that have passed.
    pub checkpoints: u64,
}

/// Steps `simulation` to the end of `schedule`, or until its solid is relaxed, recording
/// what falls due.
///
/// The time step is never shortened to meet an output time, only to meet the
/// end: a record is made after the first step at or beyond its time, so that
/// output intervals do not change the physics.
///
/// # Errors
/// A step fails ([`Failure::physics`]; what was recorded stays readable and the
/// last checkpoint valid) or a file cannot be written.
pub fn run(
    simulation: &mut dyn Simulation,
    schedule: &Schedule,
    recorder: &mut Recorder,
    recorded: &mut Recorded,
    interrupted: &AtomicBool,
) -> Result<Ending, Failure> {
    // A step that would end this close to the end time is not worth taking.
    let end = schedule.end_time * (1.0 - 1e-12);
    record_due(simulation, schedule, recorder, recorded)?;
    let mut ending = Ending::Finished;
    while simulation.time() < end {
        // Also true at once for a resumed run that had ended so.
        if simulation.is_relaxed() {
            ending = Ending::Relaxed;
            break;
        }
        let limit = simulation.time_step().map_err(|error| stopped(recorder, &error))?;
        let dt = limit.value.min(schedule.end_time - simulation.time());
        simulation.step(dt).map_err(|error| stopped(recorder, &error))?;
        recorder.progress(simulation, dt, limit.term);
        record_due(simulation, schedule, recorder, recorded)?;
        if interrupted.load(Ordering::Relaxed) {
            save(simulation, recorder, recorded)?;
            return Ok(Ending::Interrupted);
        }
    }
    record_end(simulation, recorder, recorded)?;
    save(simulation, recorder, recorded)?;
    Ok(ending)
}

fn record_due(
    simulation: &mut dyn Simulation,
    schedule: &Schedule,
    recorder: &mut Recorder,
    recorded: &mut Recorded,
) -> Result<(), Failure> {
    let time = simulation.time();
    if time >= due(recorded.rows, schedule.output.gauge) {
        recorder.row(simulation)?;
        recorded.rows = 1 + intervals(time, schedule.output.gauge);
    }
    if time >= due(recorded.frames, schedule.output.frame) {
        recorder.frame(simulation, recorded.frames)?;
        recorded.frames += 1;
    }
    if let Some(interval) = schedule.output.checkpoint
        && time >= due(recorded.checkpoints + 1, interval)
    {
        recorded.checkpoints = intervals(time, interval);
        save(simulation, recorder, recorded)?;
    }
    Ok(())
}

/// The end itself is always recorded, whether or not an interval ends there.
fn record_end(
    simulation: &mut dyn Simulation,
    recorder: &mut Recorder,
    recorded: &mut Recorded,
) -> Result<(), Failure> {
    let step = Some(simulation.steps());
    if recorder.last_row_step() != step {
        recorder.row(simulation)?;
    }
    if recorder.last_frame_step() != step {
        recorder.frame(simulation, recorded.frames)?;
        recorded.frames += 1;
    }
    Ok(())
}

/// Time at which record number `count` falls due.
fn due(count: u64, interval: f64) -> f64 {
    count as f64 * interval * (1.0 - 1e-12)
}

/// Whole intervals in `time`.
fn intervals(time: f64, interval: f64) -> u64 {
    (time / interval * (1.0 + 1e-12)).floor() as u64
}

fn save(
    simulation: &dyn Simulation,
    recorder: &mut Recorder,
    recorded: &Recorded,
) -> Result<(), Failure> {
    let mut checkpoint = Checkpoint::default();
    simulation.save(&mut checkpoint);
    for (name, value) in [
        ("recorded.frames", recorded.frames),
        ("recorded.rows", recorded.rows),
        ("recorded.checkpoints", recorded.checkpoints),
    ] {
        checkpoint.integers.insert(name.into(), value);
    }
    recorder.checkpoint(checkpoint)
}

impl Recorded {
    /// The counters stored by a checkpoint.
    pub fn from_checkpoint(checkpoint: &Checkpoint) -> Self {
        let get = |name: &str| checkpoint.integers.get(name).copied().unwrap_or(0);
        Self {
            frames: get("recorded.frames"),
            rows: get("recorded.rows"),
            checkpoints: get("recorded.checkpoints"),
        }
    }
}

fn stopped(recorder: &mut Recorder, error: &coupling::CouplingError) -> Failure {
    let advice = match recorder.checkpoint_time() {
        Some(time) => format!(
            "Everything up to the last frame is readable in {folder}. To go on from the \
             checkpoint at t = {time:.6} s: fsi-runner run … --out {folder} --resume",
            folder = recorder.folder().display()
        ),
        None => format!(
            "Everything up to the last frame is readable in {}. There is no checkpoint yet; \
             set output.checkpoint_interval to be able to resume.",
            recorder.folder().display()
        ),
    };
    recorder.abandon();
    Failure::physics(format!("the simulation stopped: {error}\n{advice}"))
}
