//! Every bad case is refused by the program itself: exit code 2, its message, nothing written.
#![allow(clippy::unwrap_used)]

use seawall_tests::{repository, run, squeezed};

#[test]
fn every_bad_case_is_refused_before_anything_is_written() {
    let folder = repository().join("tests/input/bad");
    let mut cases: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "ron"))
        .collect();
    cases.sort();
    assert!(cases.len() >= 20, "only {} bad cases", cases.len());
    for case in cases {
        let out = tempfile::tempdir().unwrap();
        let target = out.path().join("run");
        let output = run(&["run", case.to_str().unwrap(), "--out", target.to_str().unwrap()]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        let name = case.file_name().unwrap().to_string_lossy().into_owned();
        assert_eq!(output.status.code(), Some(2), "{name}: {message}");
        assert!(!target.exists(), "{name} wrote something");
        let expected = std::fs::read_to_string(case.with_extension("expected")).unwrap();
        for line in expected.lines().filter(|line| !line.trim().is_empty()) {
            assert!(
                squeezed(&message).contains(&squeezed(line)),
                "{name}: the message lacks `{line}`:\n{message}"
            );
        }
    }
}

#[test]
fn a_wrong_command_line_is_refused_with_code_2() {
    for arguments in [
        &["run", "tsunami_wal"][..],
        &["run", "cases/tsunami_wall", "--set", "fluid.spacin=0.1"],
        &["run", "cases/tsunami_wall", "--until", "-1"],
        &["verify", "tsunami_wal"],
        &["run", "cases/tsunami_wall", "--threads", "0"],
        &["export", "no_such_folder", "--vtkhdf"],
    ] {
        let output = run(arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        if arguments.iter().any(|a| a.contains("tsunami_wal") && !a.contains("wall")) {
            assert!(squeezed(&message).contains("didyoumean`tsunami_wall`?"), "{message}");
        }
    }
}
