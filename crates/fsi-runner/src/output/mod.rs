//! What a run leaves behind, and how it is read again.
//!
//! | file | written by | read by |
//! |---|---|---|
//! | `<case>.h5` | [`run_file::RunFile`] | [`run_reader::RunReader`], h5py |
//! | `<case>.xdmf` | [`xdmf::XdmfSidecar`] | ParaView, VTK |
//! | `*.vtkhdf` (on request) | [`vtkhdf::export_vtkhdf`] | ParaView, VTK |
//! | `gauges.csv`, `ledger.csv` | [`csv_table::CsvTable`] | anything |
//! | `checkpoint.h5` | [`checkpoint::Checkpoint`] | `run --resume` |
//! | a PNG (on request) | [`picture::draw`] | anything |
//! | `<case>.rrd` or a live viewer | [`rerun_log::RerunLog`] | Rerun |
//!
//! The solvers know none of this: the run loop turns their state into a
//! [`frame::Frame`] and hands it to each writer.

pub mod checkpoint;
pub mod colour;
pub mod csv_table;
pub mod error;
pub mod frame;
mod history;
pub mod layout;
pub mod picture;
pub mod plots;
pub mod progress;
pub mod replace_file;
#[cfg(feature = "rerun")]
mod rerun_blueprint;
#[cfg_attr(not(feature = "rerun"), path = "rerun_log_off.rs")]
pub mod rerun_log;
pub mod rerun_options;
#[cfg(feature = "rerun")]
mod rerun_scene;
pub mod run_file;
pub mod run_reader;
pub mod view_camera;
pub mod vtkhdf;
pub mod wall_surface;
pub mod xdmf;

pub use error::OutputError;
