//! Every command printed in the README and the docs works.
#![allow(clippy::unwrap_used)]

use clap::Parser;
use fsi_runner::cli::{Cli, Command};
use seawall_tests::{repository, run_well};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Commands that open a window or belong to other programs; the rest must be run here or
/// stand in `.ci/run`.
const ELSEWHERE: [&str; 5] =
    ["pip install", "rerun ", "apt-get ", "python", "tools/screenshot_rerun.sh"];

fn documents() -> Vec<PathBuf> {
    let root = repository();
    let mut files =
        vec![root.join("README.md"), root.join("CONTRIBUTING.md"), root.join("tools/README.md")];
    for entry in std::fs::read_dir(root.join("docs")).unwrap() {
        files.push(entry.unwrap().path());
    }
    for entry in std::fs::read_dir(root.join("cases")).unwrap() {
        files.push(entry.unwrap().path().join("README.md"));
    }
    files.retain(|file| file.extension().is_some_and(|ending| ending == "md"));
    files
}

/// Lines of fenced and indented code blocks that are commands.
fn commands() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for file in documents() {
        let text = std::fs::read_to_string(&file).unwrap();
        let mut fenced = false;
        for line in text.lines() {
            if line.trim_start().starts_with("```") {
                fenced = !fenced;
            } else if fenced || line.starts_with("    ") {
                let line = line.trim();
                let starts = ["cargo ", "fsi-runner ", "target/", "tools/", ".ci/", ".venv/", "./"];
                if starts.iter().chain(&ELSEWHERE).any(|start| line.starts_with(start)) {
                    // A comment after the command explains it.
                    let command = line.split("  #").next().unwrap_or(line);
                    found.insert(command.trim().to_owned());
                }
            }
        }
    }
    found
}

/// Arguments of a line that calls `fsi-runner` in one of the documented ways.
fn runner_arguments(command: &str) -> Option<Vec<String>> {
    let starts =
        ["cargo run --release --bin fsi-runner -- ", "target/release/fsi-runner ", "fsi-runner "];
    let rest = starts.iter().find_map(|start| command.strip_prefix(start))?;
    Some(split(rest))
}

/// Splits as a shell does, as far as the documents need it: blanks and single quotes.
fn split(text: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted) = (Vec::new(), String::new(), false);
    for character in text.chars() {
        match character {
            '\'' => quoted = !quoted,
            ' ' if !quoted => {
                if !word.is_empty() {
                    words.push(std::mem::take(&mut word));
                }
            }
            other => word.push(other),
        }
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}

#[test]
fn documented_runner_commands_work() {
    let mut ran = 0;
    for command in commands() {
        let Some(arguments) = runner_arguments(&command) else { continue };
        let parsed = Cli::try_parse_from(
            std::iter::once("fsi-runner").chain(arguments.iter().map(String::as_str)),
        );
        assert!(parsed.is_ok(), "`{command}`: {}", parsed.unwrap_err());
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        match parsed.unwrap().command {
            // The first steps only: the whole runs are the verification's.
            Command::Run(run) if !run.resume && !run.viewer => {
                let folder = tempfile::tempdir().unwrap();
                let out = folder.path().join("run").display().to_string();
                let mut short: Vec<&str> = Vec::new();
                let mut skip = false;
                for argument in &arguments {
                    if skip {
                        skip = false;
                    } else if ["--out", "--until", "--rrd"].contains(argument) {
                        skip = true;
                    } else {
                        short.push(argument);
                    }
                }
                short.extend(["--until", "1e-5", "--out", &out]);
                run_well(&short);
                ran += 1;
            }
            Command::Check(_) | Command::List { .. } | Command::Material(_) => {
                run_well(&arguments);
                ran += 1;
            }
            Command::Verify(verify) => {
                for name in verify.names {
                    let folder = repository().join("cases").join(&name);
                    assert!(folder.join("check.ron").is_file(), "`{command}`: no {name}/check.ron");
                }
            }
            // They need a finished run: `.ci/run` calls them on one.
            Command::Run(_) | Command::Export { .. } | Command::Picture { .. } => {}
        }
    }
    assert!(ran >= 8, "only {ran} commands ran: the documents were not read");
}

#[test]
fn every_other_documented_command_is_run_by_ci() {
    let ci = std::fs::read_to_string(repository().join(".ci/run")).unwrap();
    for command in commands() {
        let elsewhere = ELSEWHERE.iter().any(|start| command.starts_with(start));
        if runner_arguments(&command).is_none() && !elsewhere && command != ".ci/run" {
            assert!(ci.contains(&command), "`{command}` is documented but .ci/run does not run it");
        }
    }
}
