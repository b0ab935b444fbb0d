//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::output::rerun_options::SolidColour;

/// Simulates what a tsunami does to a structure: SPH water, GIMPM solid, coupled both ways.
#[derive(Debug, Parser)]
#[command(name = "fsi-runner", version, propagate_version = true, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Worker threads; all cores by default. Results do not depend on it.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a verification gate failed, or a file could not be written
  2    the case or the command line is wrong; nothing was written
  3    the physics failed; what was written so far is readable
  130  interrupted; a checkpoint was written, continue with --resume

Start here:
  fsi-runner list
  fsi-runner check cases/tsunami_wall
  fsi-runner run cases/tsunami_wall";

/// Subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a case and write HDF5, CSV and a Rerun recording.
    Run(RunArguments),
    /// Validate a case and print its size, time steps, memory and warnings.
    Check(CaseArguments),
    /// List the cases.
    List {
        /// Folder that holds one folder a case.
        #[arg(long, value_name = "DIR", default_value = "cases")]
        cases: PathBuf,
    },
    /// Run cases, compare them with their references and print the table.
    Verify(VerifyArguments),
    /// Drive a body's constitutive law along a path of deformation, at one point.
    Material(MaterialArguments),
    /// Convert a finished or running run for other programs.
    Export {
        /// Folder of the run.
        run: PathBuf,
        /// Write one temporal VTKHDF file a point set (ParaView 5.12 or later).
        #[arg(long, required = true)]
        vtkhdf: bool,
    },
    /// Draw one frame of a run as PNG.
    Picture {
        /// Folder of the run.
        run: PathBuf,
        /// Frame number; the last one by default.
        #[arg(long, value_name = "N")]
        frame: Option<u64>,
        /// Output file.
        #[arg(long, value_name = "PNG", default_value = "picture.png")]
        out: PathBuf,
    },
}

/// Which case, and what to change in it.
#[derive(Debug, Clone, Args)]
pub struct CaseArguments {
    /// Case folder, its `case.ron`, or the name of a folder in `cases/`.
    pub case: PathBuf,
    /// Replace a field, e.g. `--set fluid.spacing=0.05`; may be repeated.
    #[arg(long = "set", value_name = "FIELD=VALUE")]
    pub overrides: Vec<String>,
}

/// Arguments of `run`.
#[derive(Debug, Clone, Args)]
pub struct RunArguments {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Output folder; by default `runs/NAME`, numbered if that is taken.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace an earlier run in the output folder.
    #[arg(long, conflicts_with = "resume")]
    pub overwrite: bool,
    /// Continue from the checkpoint in the output folder.
    #[arg(long)]
    pub resume: bool,
    /// Stop at this simulated time (s) instead of the case's `end_time`.
    #[arg(long, value_name = "SECONDS")]
    pub until: Option<f64>,
    /// Show the run live in the Rerun viewer instead of writing a recording.
    #[arg(long, conflicts_with_all = ["rrd", "no_rrd"])]
    pub viewer: bool,
    /// Where to write the Rerun recording; by default `NAME.rrd` in the output folder.
    #[arg(long, value_name = "FILE")]
    pub rrd: Option<PathBuf>,
    /// What colours the solids in Rerun.
    #[arg(long, value_enum, default_value_t, value_name = "QUANTITY")]
    pub solid_colour: SolidColour,
    /// Write no Rerun recording.
    #[arg(long, conflicts_with = "rrd")]
    pub no_rrd: bool,
}

/// Arguments of `material`.
#[derive(Debug, Clone, Args)]
pub struct MaterialArguments {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
    /// The body; may be left out when there is only one.
    #[arg(long, value_name = "NAME")]
    pub body: Option<String>,
    /// How the point is deformed.
    #[arg(long, value_enum, ignore_case = true, default_value_t, value_name = "PATH")]
    pub path: MaterialPath,
    /// Engineering strain (in shear: γ) at the end of a leg; several make a path there and
    /// back: `--strain 0.01 --strain -0.01`.
    #[arg(long, required = true, allow_negative_numbers = true, value_name = "STRAIN")]
    pub strain: Vec<f64>,
    /// Steps of each leg.
    #[arg(long, default_value_t = 200, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub steps: u32,
    /// Also write all steps to this file.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// Paths of deformation of one point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
#[value(rename_all = "PascalCase")]
pub enum MaterialPath {
    /// Stretched along x, free along y and z.
    #[default]
    UniaxialStress,
    /// Stretched along x and y alike, free along z.
    BiaxialStress,
    /// Stretched along x, free along y, held along z.
    PlaneStrain,
    /// Stretched along x, held along y and z.
    UniaxialStrain,
    /// Stretched along all axes alike.
    VolumetricStrain,
    /// Sheared: x moves with y.
    SimpleShear,
}

/// Arguments of `verify`.
#[derive(Debug, Clone, Args)]
pub struct VerifyArguments {
    /// Names of cases; all that have a `check.ron` by default.
    pub names: Vec<String>,
    /// Run the coarsened variant with its own gates.
    #[arg(long)]
    pub quick: bool,
    /// Where the runs are kept.
    #[arg(long, value_name = "DIR", default_value = "runs/verify")]
    pub out: PathBuf,
    /// Folder that holds one folder a case.
    #[arg(long, value_name = "DIR", default_value = "cases")]
    pub cases: PathBuf,
    /// Compare runs that are already in `--out` instead of running again.
    #[arg(long)]
    pub keep: bool,
}
