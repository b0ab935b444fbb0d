//! What a run says at its end.

use std::fmt::Write as _;
use std::time::Duration;

use crate::folder::RunFolder;
use crate::output::frame::Column;
use crate::output::progress::duration;
use crate::simulation::{RelaxationProgress, Simulation};

/// Largest and smallest value of each gauge column.
#[derive(Debug, Clone)]
pub struct Extremes {
    columns: Vec<Column>,
    /// (smallest, its time, largest, its time) of each column.
    values: Vec<(f64, f64, f64, f64)>,
}

impl Extremes {
    /// Nothing recorded yet.
    pub fn new(columns: &[Column]) -> Self {
        let none = (f64::INFINITY, 0.0, f64::NEG_INFINITY, 0.0);
        Self { columns: columns.to_vec(), values: vec![none; columns.len()] }
    }

    /// Takes one gauge row.
    pub fn add(&mut self, time: f64, row: &[f64]) {
        for (extreme, &value) in self.values.iter_mut().zip(row) {
            if value < extreme.0 {
                (extreme.0, extreme.1) = (value, time);
            }
            if value > extreme.2 {
                (extreme.2, extreme.3) = (value, time);
            }
        }
    }
}

/// Cost of the steps of this session.
#[derive(Debug, Clone, Copy)]
pub struct Cost {
    /// Steps taken.
    pub steps: u64,
    /// Wall time.
    pub elapsed: Duration,
    /// Worker threads.
    pub threads: usize,
}

/// Whether the static state was found.
fn relaxation(progress: &RelaxationProgress, time: f64) -> String {
    let RelaxationProgress { out_of_balance, tolerance, relaxed } = *progress;
    if relaxed {
        format!(
            "at rest at t = {time:.6} s: unbalanced force {out_of_balance:.2e} of the load, \
             tolerance {tolerance:.1e}"
        )
    } else {
        format!(
            "NOT at rest: unbalanced force {out_of_balance:.2e} of the load is above the tolerance \
             {tolerance:.1e}; raise end_time or the tolerance"
        )
    }
}

/// The text printed after a run.
pub fn summary(
    simulation: &dyn Simulation,
    cost: &Cost,
    extremes: &Extremes,
    folder: &RunFolder,
    recording: Option<&std::path::Path>,
) -> String {
    let counts = simulation.counts();
    let totals = simulation.totals();
    let seconds = cost.elapsed.as_secs_f64().max(1e-9);
    let particles = counts.fluid + counts.material;
    let rate = cost.steps as f64 * particles as f64 / seconds * 1e-6;
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "particles   {counts}");
    let _ = writeln!(
        text,
        "steps       {} to t = {:.6} s, {} solid sub-steps in the last",
        simulation.steps(),
        simulation.time(),
        simulation.substeps()
    );
    if let Some(progress) = simulation.relaxation() {
        let _ = writeln!(text, "relaxation  {}", relaxation(&progress, simulation.time()));
    }
    let _ = writeln!(
        text,
        "wall time   {} on {} threads: {:.1} steps/s, {:.2} M particle-steps/s",
        duration(seconds),
        cost.threads,
        cost.steps as f64 / seconds,
        rate
    );
    let _ = writeln!(
        text,
        "ledger      momentum residual {:.1e} (largest of any step), interface work mismatch {:.3e} J, \
         {} leaked, {} left the domain",
        totals.momentum_residual, totals.work_mismatch, totals.leaks, totals.removed
    );
    if !extremes.columns.is_empty() {
        let width = extremes.columns.iter().map(|column| column.name.len()).max().unwrap_or(0);
        let _ = writeln!(
            text,
            "gauges      {:width$}       smallest  at [s]        largest  at [s]",
            ""
        );
        for (column, (low, low_time, high, high_time)) in
            extremes.columns.iter().zip(&extremes.values)
        {
            let _ = writeln!(
                text,
                "            {:width$} {low:>14.6e} {low_time:>7.3} {high:>14.6e} {high_time:>7.3}  {}",
                column.name, column.unit
            );
        }
    }
    let _ = writeln!(text, "files       {}", folder.hdf5().display());
    let _ = writeln!(text, "            {} (ParaView)", folder.xdmf().display());
    let _ =
        writeln!(text, "            {}, {}", folder.gauges().display(), folder.ledger().display());
    if let Some(recording) = recording {
        let _ = writeln!(text, "            {0}: rerun {0}", recording.display());
    }
    text
}
