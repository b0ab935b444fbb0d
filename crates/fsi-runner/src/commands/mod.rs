//! One file a subcommand.

mod check;
mod export;
mod list;
mod material;
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
    // 0 means one thread a core. Inside the pool a parallel loop costs microseconds; started
    // from outside, each of the hundreds in a coupled step would wake the pool anew.
    let threads = usize::from(cli.threads.unwrap_or(0));
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(Failure::run)?;
    pool.install(|| carry_out(cli.command))
}

fn carry_out(command: Command) -> Result<(), Failure> {
    match command {
        Command::Run(arguments) => run::execute(&arguments),
        Command::Check(arguments) => check::execute(&arguments),
        Command::List { cases } => list::execute(&cases),
        Command::Verify(arguments) => verify::execute(&arguments),
        Command::Material(arguments) => material::execute(&arguments),
        Command::Export { run, .. } => export::execute(&run),
        Command::Picture { run, frame, out } => picture::execute(&run, frame, &out),
    }
}
