//! Logging a run to Rerun: a file, or a viewer that may come and go.

use super::error::OutputError;
use super::frame::{Column, Frame, PointCloud, RunHeader};
use super::layout::Table;
use super::plots::{self, Plot};
use super::rerun_blueprint;
use super::rerun_options::{RerunOptions, RerunTarget};
use super::rerun_scene::Scene;
use super::view_camera::{self, Camera};
use rerun::{RecordingStream, RecordingStreamBuilder, RecordingStreamError, SpawnOptions};
use std::time::Duration;

/// What the viewer groups recordings and layouts by.
const APPLICATION: &str = "seawall";

/// A viewer that takes no data for so long is given up.
const PATIENCE: Duration = Duration::from_secs(20);

/// Time since the start, in seconds of simulated time.
const SIMULATED_TIME: &str = "sim_time";

/// Coupled steps.
const STEP: &str = "step";

/// An open log. Nothing that happens to it later ends a run: a failure is one
/// warning, and the rest of the log is dropped.
pub struct RerunLog {
    recording: RecordingStream,
    target: RerunTarget,
    scene: Scene,
    gauges: Vec<Plot>,
    ledger: Vec<Plot>,
    alive: bool,
}

impl RerunLog {
    /// Opens the log, lays out the viewer (scene beside plots) and logs what
    /// never changes. `first` sets the camera and the colour ranges; log it
    /// with [`log_frame`](Self::log_frame) as well.
    ///
    /// Logs with the same [`RunHeader::run_id`] are shown as one recording.
    ///
    /// # Errors
    /// [`OutputError::Rerun`] when the file cannot be created or no viewer started.
    pub fn start(
        options: RerunOptions,
        header: &RunHeader,
        statics: &[PointCloud],
        first: &Frame,
        gauges: &[Column],
        ledger: &[Column],
    ) -> Result<Self, OutputError> {
        let fail =
            |reason: String| OutputError::Rerun { target: options.target.to_string(), reason };
        let recording = open(&options.target, header).map_err(|error| {
            let remedy = match options.target {
                RerunTarget::Spawn => "; `pip install rerun-sdk==0.36.3` brings the viewer",
                RerunTarget::File(_) | RerunTarget::Connect(_) => "",
            };
            fail(format!("{error}{remedy}"))
        })?;
        recording.set_log_tick_enabled(false);
        recording.set_log_time_enabled(false);
        let gauge_plots = plots::group(Table::Gauges, gauges);
        let ledger_plots = plots::group(Table::Ledger, ledger);
        let bounds = view_camera::bounds(statics.iter().chain(&first.clouds));
        let camera = bounds.map(|bounds| Camera::facing(bounds, header.dimension));
        rerun_blueprint::send(&recording, header, camera, &gauge_plots, &ledger_plots)
            .map_err(|error| fail(error.to_string()))?;
        let scene = Scene::new(&options, header, first);
        let mut log = Self {
            recording,
            target: options.target.clone(),
            scene,
            gauges: gauge_plots,
            ledger: ledger_plots,
            alive: true,
        };
        log.attempt(|log| {
            log.scene.log_statics(&log.recording, statics, &options.markers, bounds)?;
            for (plots, columns) in [(&log.gauges, gauges), (&log.ledger, ledger)] {
                log_series_names(&log.recording, plots, columns)?;
            }
            Ok(())
        });
        Ok(log)
    }

    /// Logs the points of a frame.
    pub fn log_frame(&mut self, frame: &Frame) {
        self.attempt(|log| {
            set_time(&log.recording, frame.step, frame.time);
            log.scene.log_frame(&log.recording, frame)
        });
        self.flush();
    }

    /// Logs one row of a table.
    pub fn log_row(&mut self, table: Table, step: u64, time: f64, values: &[f64]) {
        self.attempt(|log| {
            set_time(&log.recording, step, time);
            let plots = if table == Table::Gauges { &log.gauges } else { &log.ledger };
            for plot in plots {
                for &column in &plot.columns {
                    // A gauge out of the water has no value: the curve gets a gap.
                    if let Some(&value) = values.get(column).filter(|value| value.is_finite()) {
                        let scalar = rerun::Scalars::single(value);
                        log.recording.log(plot.entity(column), &scalar)?;
                    }
                }
            }
            Ok(())
        });
    }

    /// Writes out what waits and closes the log.
    pub fn finish(mut self) {
        self.flush();
    }

    fn attempt(&mut self, log: impl FnOnce(&mut Self) -> Result<(), RecordingStreamError>) {
        if self.alive
            && let Err(error) = log(self)
        {
            self.give_up(&error.to_string());
        }
    }

    fn flush(&mut self) {
        if self.alive
            && let Err(error) = self.recording.flush_with_timeout(PATIENCE)
        {
            self.give_up(&error.to_string());
        }
    }

    fn give_up(&mut self, reason: &str) {
        let target = self.target.to_string();
        tracing::warn!(target, reason, "Rerun takes no more data; the run goes on without it");
        self.alive = false;
        // Disconnecting or dropping the stream would wait for the viewer, for ever.
        let stuck = std::mem::replace(&mut self.recording, RecordingStream::disabled());
        std::mem::forget(stuck);
    }
}

fn open(target: &RerunTarget, header: &RunHeader) -> Result<RecordingStream, RecordingStreamError> {
    let builder = RecordingStreamBuilder::new(APPLICATION)
        .recording_id(header.run_id.as_str())
        .recording_name(header.case_name.as_str());
    match target {
        RerunTarget::File(path) => builder.save(path),
        RerunTarget::Connect(address) => builder.connect_grpc_opts(address),
        RerunTarget::Spawn => builder.spawn_opts(&SpawnOptions {
            // Without this the viewer would accept data from the whole network.
            extra_args: vec!["--bind".into(), "127.0.0.1".into()],
            hide_welcome_screen: true,
            wait_for_bind: true,
            ..SpawnOptions::default()
        }),
    }
}

fn set_time(recording: &RecordingStream, step: u64, time: f64) {
    recording.set_duration_secs(SIMULATED_TIME, time);
    recording.set_time_sequence(STEP, i64::try_from(step).unwrap_or(i64::MAX));
}

fn log_series_names(
    recording: &RecordingStream,
    plots: &[Plot],
    columns: &[Column],
) -> Result<(), RecordingStreamError> {
    for plot in plots {
        for &column in &plot.columns {
            let name = columns[column].name.as_str();
            let line = rerun::SeriesLines::new().with_names([name]).with_widths([1.5]);
            recording.log_static(plot.entity(column), &line)?;
        }
    }
    Ok(())
}
