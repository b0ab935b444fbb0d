//! Hands what a run produces to every writer.

use std::path::Path;

use crate::failure::Failure;
use crate::folder::RunFolder;
use crate::output::checkpoint::Checkpoint;
use crate::output::csv_table::CsvTable;
use crate::output::frame::{Frame, RunHeader};
use crate::output::layout::Table;
use crate::output::progress::{Progress, ProgressState};
use crate::output::rerun_log::RerunLog;
use crate::output::rerun_options::{Marker, RerunOptions, RerunTarget, SolidColour};
use crate::output::run_file::{ResumePoint, RunFile};
use crate::output::run_reader::RunReader;
use crate::output::xdmf::XdmfSidecar;
use crate::simulation::Simulation;
use crate::summary::Extremes;

/// The open files of a run, its viewer and its progress display.
pub struct Recorder {
    folder: RunFolder,
    case_hash: u64,
    file: RunFile,
    xdmf: XdmfSidecar,
    gauges: CsvTable,
    ledger: CsvTable,
    rerun: Option<RerunLog>,
    progress: Progress,
    extremes: Extremes,
    last_row_step: Option<u64>,
    last_frame_step: Option<u64>,
    checkpoint_time: Option<f64>,
}

/// What a recorder is opened with.
pub struct RecorderSettings<'a> {
    /// Where to write.
    pub folder: RunFolder,
    /// What identifies the run.
    pub header: &'a RunHeader,
    /// Fingerprint of case and overrides.
    pub case_hash: u64,
    /// Where to log for Rerun, if anywhere.
    pub rerun: Option<RerunTarget>,
    /// What colours the solids in Rerun.
    pub solid_colour: SolidColour,
    /// Simulated time at which the run ends (s).
    pub end_time: f64,
    /// Continue the files in the folder from the simulation's time.
    pub resume: bool,
}

impl Recorder {
    /// Creates the files of a new run, or reopens those of a resumed one and
    /// drops what they hold beyond the simulation's time.
    ///
    /// # Errors
    /// A file cannot be created or does not belong to this run.
    pub fn open(
        settings: RecorderSettings<'_>,
        simulation: &dyn Simulation,
    ) -> Result<Self, Failure> {
        let RecorderSettings { folder, header, case_hash, rerun, solid_colour, end_time, resume } =
            settings;
        let (gauge_columns, ledger_columns) =
            (simulation.gauge_columns(), simulation.ledger_columns());
        let statics = simulation.static_clouds();
        let time = simulation.time();
        let (file, xdmf, gauges, ledger) = if resume {
            let file = RunFile::open_to_append(
                &folder.hdf5(),
                ResumePoint { step: simulation.steps(), time },
            )?;
            let xdmf = XdmfSidecar::of_run(&folder.xdmf(), &RunReader::open(&folder.hdf5())?)?;
            let gauges = CsvTable::open_to_append(&folder.gauges(), &gauge_columns, time)?;
            let ledger = CsvTable::open_to_append(&folder.ledger(), &ledger_columns, time)?;
            (file, xdmf, gauges, ledger)
        } else {
            std::fs::create_dir_all(&folder.path).map_err(|error| {
                Failure::run(format!("cannot create {}: {error}", folder.path.display()))
            })?;
            // A checkpoint of an overwritten run must not be resumed into this one.
            let _ = std::fs::remove_file(folder.checkpoint());
            let file =
                RunFile::create(&folder.hdf5(), header, &statics, &gauge_columns, &ledger_columns)?;
            let data_file = format!("{}.h5", header.case_name);
            let xdmf = XdmfSidecar::new(&folder.xdmf(), &data_file, &statics);
            let gauges = CsvTable::create(&folder.gauges(), &gauge_columns)?;
            let ledger = CsvTable::create(&folder.ledger(), &ledger_columns)?;
            (file, xdmf, gauges, ledger)
        };
        let rerun = match rerun {
            Some(target) => {
                let markers = simulation
                    .markers()
                    .into_iter()
                    .map(|(name, position)| Marker { name, position })
                    .collect();
                let options = RerunOptions { markers, solid_colour, ..RerunOptions::new(target) };
                let first = simulation.frame(0);
                Some(RerunLog::start(
                    options,
                    header,
                    &statics,
                    &first,
                    &gauge_columns,
                    &ledger_columns,
                )?)
            }
            None => None,
        };
        Ok(Self {
            folder,
            case_hash,
            file,
            xdmf,
            gauges,
            ledger,
            rerun,
            progress: Progress::start(time, simulation.steps(), end_time),
            extremes: Extremes::new(&gauge_columns),
            last_row_step: None,
            last_frame_step: None,
            checkpoint_time: resume.then_some(time),
        })
    }

    /// Shows the state after a step of `dt` (s) limited by `term`.
    pub fn progress(&mut self, simulation: &dyn Simulation, dt: f64, term: &str) {
        let counts = simulation.counts();
        self.progress.update(&ProgressState {
            time: simulation.time(),
            step: simulation.steps(),
            particles: counts.fluid + counts.material,
            time_step: dt,
            limiting_term: term,
        });
    }

    /// Records one row of gauges and ledger.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn row(&mut self, simulation: &mut dyn Simulation) -> Result<(), Failure> {
        let (time, step) = (simulation.time(), simulation.steps());
        let gauges = simulation.gauge_row();
        let ledger = simulation.ledger_row();
        self.extremes.add(time, &gauges);
        self.gauges.push_row(time, &gauges)?;
        self.ledger.push_row(time, &ledger)?;
        self.file.push_row(Table::Gauges, time, &gauges)?;
        self.file.push_row(Table::Ledger, time, &ledger)?;
        if let Some(rerun) = &mut self.rerun {
            rerun.log_row(Table::Gauges, step, time, &gauges);
            rerun.log_row(Table::Ledger, step, time, &ledger);
        }
        self.last_row_step = Some(step);
        Ok(())
    }

    /// Records all points as frame `index`; what was recorded before is then on disk.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn frame(&mut self, simulation: &dyn Simulation, index: u64) -> Result<(), Failure> {
        let frame: Frame = simulation.frame(index);
        self.file.write_frame(&frame)?;
        self.xdmf.add_frame(&frame)?;
        self.xdmf.write()?;
        self.gauges.flush()?;
        self.ledger.flush()?;
        if let Some(rerun) = &mut self.rerun {
            rerun.log_frame(&frame);
        }
        self.last_frame_step = Some(frame.step);
        Ok(())
    }

    /// Completes `checkpoint` and replaces the one in the folder.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn checkpoint(&mut self, mut checkpoint: Checkpoint) -> Result<(), Failure> {
        // The checkpoint must not be ahead of the files that a resume truncates.
        self.file.flush()?;
        self.gauges.flush()?;
        self.ledger.flush()?;
        checkpoint.case_hash = self.case_hash;
        checkpoint.write(&self.folder.checkpoint())?;
        self.checkpoint_time = checkpoint.scalars.get("time").copied();
        Ok(())
    }

    /// Step of the last row of this session.
    pub fn last_row_step(&self) -> Option<u64> {
        self.last_row_step
    }

    /// Step of the last frame of this session.
    pub fn last_frame_step(&self) -> Option<u64> {
        self.last_frame_step
    }

    /// Simulated time of the checkpoint in the folder, if there is one (s).
    pub fn checkpoint_time(&self) -> Option<f64> {
        self.checkpoint_time
    }

    /// The run's folder.
    pub fn folder(&self) -> &Path {
        &self.folder.path
    }

    /// Flushes what can be flushed after a failure.
    pub fn abandon(&mut self) {
        self.progress.finish();
        let flushed = [self.file.flush(), self.gauges.flush(), self.ledger.flush()];
        for error in flushed.into_iter().filter_map(Result::err) {
            tracing::warn!("{error}");
        }
    }

    /// Closes everything and returns the extremes of the gauges.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn close(mut self) -> Result<Extremes, Failure> {
        self.progress.finish();
        self.gauges.flush()?;
        self.ledger.flush()?;
        self.file.close()?;
        if let Some(rerun) = self.rerun {
            rerun.finish();
        }
        Ok(self.extremes)
    }
}
