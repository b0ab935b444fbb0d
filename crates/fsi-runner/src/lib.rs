//! Runs, checks and verifies Seawall cases: the library behind `fsi-runner`.
//!
//! `commands` holds one file a subcommand, `run` the loop over time steps,
//! `simulation` the solvers behind one interface, `output` the writers and
//! `verify` the comparison with references.
#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used))]

pub mod cli;
pub mod commands;
pub mod failure;
pub mod folder;
pub mod locate;
pub mod output;
pub mod recorder;
pub mod run;
pub mod simulation;
mod summary;
pub mod verify;
