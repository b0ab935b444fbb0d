//! `docs/case.md` names every field and choice of the format, and its example works.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use case::Case;

fn root() -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

fn page() -> String {
    std::fs::read_to_string(root().join("../../docs/case.md")).unwrap()
}

/// Names of fields and variants that the format's sources define.
fn names() -> Vec<String> {
    let mut sources = vec![root().join("src/format.rs")];
    let folder = std::fs::read_dir(root().join("src/format")).unwrap();
    sources.extend(folder.map(|entry| entry.unwrap().path()));
    let mut names = Vec::new();
    for source in sources {
        let text = std::fs::read_to_string(source).unwrap();
        let mut renamed = None;
        for line in text.lines().map(str::trim) {
            if let Some(rest) = line.strip_prefix("#[serde(rename = \"") {
                renamed = rest.split('"').next().map(str::to_owned);
            }
            let word: String =
                line.trim_start_matches("pub ").chars().take_while(|c| is_word(*c)).collect();
            let rest = line.trim_start_matches("pub ")[word.len()..].to_owned();
            let field = rest.starts_with(": ") && line.ends_with(',');
            let capital = word.starts_with(|c: char| c.is_ascii_uppercase());
            let variant = capital && (rest == "," || rest == " {" || rest.ends_with("),"));
            if field && !capital {
                names.push(renamed.take().unwrap_or(word));
            } else if variant {
                renamed = None;
                names.push(word);
            }
        }
    }
    names
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

#[test]
fn every_field_and_choice_is_documented() {
    let page = page();
    let words: std::collections::BTreeSet<&str> = page.split(|c| !is_word(c)).collect();
    let names = names();
    assert!(names.len() > 80, "only {} names were found", names.len());
    for name in ["where", "spacing", "Tank", "wavelength", "Subtract"] {
        assert!(names.iter().any(|found| found == name), "{name} was not found in the sources");
    }
    let missing: Vec<_> = names.iter().filter(|name| !words.contains(name.as_str())).collect();
    assert!(missing.is_empty(), "docs/case.md does not name {missing:?}");
}

#[test]
fn the_example_works() {
    let page = page();
    let example = page.split("```ron\n").nth(1).unwrap().split("```").next().unwrap();
    let model = Case::parse("docs/case.md", example, &[]).unwrap().build::<2>().unwrap();
    assert_eq!(model.estimate.fluid_particles, 600);
}
