//! What ends the program early, and with which exit code.

use std::process::ExitCode;

/// A message for the user with the exit code that goes with it.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    report: miette::Report,
}

impl Failure {
    /// A gate failed or a file could not be written: exit code 1.
    pub fn run(message: impl std::fmt::Display) -> Self {
        Self { code: 1, report: miette::miette!("{message}") }
    }

    /// Bad input, found before anything was written: exit code 2.
    pub fn input(message: impl std::fmt::Display) -> Self {
        Self { code: 2, report: miette::miette!("{message}") }
    }

    /// The physics failed: exit code 3.
    pub fn physics(message: impl std::fmt::Display) -> Self {
        Self { code: 3, report: miette::miette!("{message}") }
    }

    /// The user stopped the run: exit code 130.
    pub fn interrupted(message: impl std::fmt::Display) -> Self {
        Self { code: 130, report: miette::miette!("{message}") }
    }

    /// Exit code of the process.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(self.code)
    }

    /// The message, with a source snippet where there is one.
    pub fn report(&self) -> &miette::Report {
        &self.report
    }
}

impl From<case::CaseError> for Failure {
    fn from(error: case::CaseError) -> Self {
        Self { code: 2, report: miette::Report::new(error) }
    }
}

impl From<crate::output::OutputError> for Failure {
    fn from(error: crate::output::OutputError) -> Self {
        Self::run(error)
    }
}
