//! What the whole-program tests share: the binary, the repository, run folders.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use fsi_runner::output::layout::Table;
use fsi_runner::output::run_reader::{Place, RunReader};

/// Root of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The `fsi-runner` that `cargo test --release --workspace` built.
///
/// # Panics
/// It is not there: a single package was tested.
pub fn runner() -> Command {
    let test = std::env::current_exe().unwrap_or_default();
    // target/release/deps/<test> -> target/release/fsi-runner
    let program = test.ancestors().nth(2).map(|folder| folder.join("fsi-runner"));
    let program = program.filter(|program| program.is_file());
    assert!(
        program.is_some(),
        "fsi-runner is not built; run the tests with `cargo test --release --workspace`"
    );
    let mut command = Command::new(program.unwrap_or_default());
    command.current_dir(repository()).env_remove("RUST_LOG");
    command
}

/// Runs `fsi-runner` with `arguments` in the repository.
///
/// # Panics
/// The program cannot be started.
pub fn run(arguments: &[&str]) -> Output {
    let output = runner().args(arguments).output();
    assert!(output.is_ok(), "cannot start fsi-runner: {output:?}");
    output.unwrap_or_else(|_| unreachable!("asserted above"))
}

/// Runs `fsi-runner` and demands exit code 0.
///
/// # Panics
/// Another exit code, with what was printed.
pub fn run_well(arguments: &[&str]) -> Output {
    let output = run(arguments);
    assert!(
        output.status.success(),
        "fsi-runner {} ended with {}:\n{}{}",
        arguments.join(" "),
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    output
}

/// Every number in a run file, as bits, under the name of its dataset.
///
/// # Panics
/// The file cannot be read.
pub fn all_bits(path: &Path) -> Vec<(String, Vec<u64>)> {
    let read = || -> Result<_, fsi_runner::output::OutputError> {
        let run = RunReader::open(path)?;
        let mut sets = Vec::new();
        for frame in run.frames()? {
            let place = Place::Frame(frame.index);
            sets.push((format!("{} time", frame.index), vec![frame.time.to_bits()]));
            for cloud in &frame.clouds {
                let info = run.cloud(place, cloud)?;
                let name = |field: &str| format!("{} {cloud} {field}", frame.index);
                let position = run.position(place, cloud)?;
                sets.push((name("position"), position.as_flattened().iter().map(bits).collect()));
                let id = run.id(place, cloud)?;
                sets.push((name("id"), id.into_iter().map(u64::from).collect()));
                for field in &info.fields {
                    let values = run.field(place, cloud, &field.name)?;
                    sets.push((name(&field.name), values.iter().map(bits).collect()));
                }
            }
        }
        for table in [Table::Gauges, Table::Ledger] {
            let history = run.history(table)?;
            for (column, values) in history.columns.iter().zip(&history.values) {
                sets.push((column.name.clone(), values.iter().map(bits).collect()));
            }
        }
        Ok(sets)
    };
    let sets = read();
    assert!(sets.is_ok(), "{}: {:?}", path.display(), sets.err());
    sets.unwrap_or_default()
}

/// A message without the line breaks and bars that wrap it to the terminal's width.
pub fn squeezed(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace() && *c != '│').collect()
}

fn bits(value: &f64) -> u64 {
    value.to_bits()
}

/// Demands that two run files hold the same numbers, bit for bit.
///
/// # Panics
/// They differ: names the first dataset that does.
pub fn assert_same_bits(a: &Path, b: &Path) {
    let (a, b) = (all_bits(a), all_bits(b));
    assert!(a.len() > 10, "only {} datasets: nothing was compared", a.len());
    let names =
        |sets: &[(String, Vec<u64>)]| sets.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for ((name, left), (_, right)) in a.iter().zip(&b) {
        assert!(left == right, "`{name}` differs");
    }
}
