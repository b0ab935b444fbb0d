//! One file a subcommand.

mod check;
mod export;
mod list;
mod picture;
mod run;
mod verify;

use crate::cli::{Cli, Command};
use crate::failure::Failure;

/// Carries out what the command line asks for.
///
/// # Errors
/// [`Failure`] with the message and the exit code.
pub fn execute(cli: Cli) -> Result<(), Failure> {
    if let Some(threads) = cli.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .map_err(Failure::run)?;
    }
    match cli.command {
        Command::Run(arguments) => run::execute(&arguments),
        Command::Check(arguments) => check::execute(&arguments),
        Command::List { cases } => list::execute(&cases),
        Command::Verify(arguments) => verify::execute(&arguments),
        Command::Export { run, .. } => export::execute(&run),
        Command::Picture { run, frame, out } => picture::execute(&run, frame, &out),
    }
}
