//! `--set path=value`: overrides of single fields.
//!
//! An override edits the text before it is read, so that an overridden field
//! passes exactly the checks of a written one. A field that the file leaves
//! out is inserted; whether it exists is then decided by the reader.

use crate::CaseError;
use crate::outline::{Content, Node, Step, steps};
use crate::source::Source;

/// Applies one `path=value`.
pub(crate) fn apply(source: &mut Source, argument: &str) -> Result<(), CaseError> {
    let place = format!("--set {argument}");
    let refuse = |path: &str, message: String, help: &str| {
        Err(CaseError::new(place.as_str(), path, message).with_help(Some(help.to_owned())))
    };
    const EXAMPLE: &str = "write `path=value`, such as `fluid.spacing=0.05` or \
                           `solid.bodies.0.material.young_modulus=1e9`";
    let Some((path, value)) = argument.split_once('=') else {
        return refuse("", "an override needs a `=`".into(), EXAMPLE);
    };
    let (path, value) = (path.trim(), value.trim());
    let wanted = steps(path);
    if wanted.is_empty() {
        return refuse("", "an override needs a path before the `=`".into(), EXAMPLE);
    }
    if Node::parse(value).is_err() || value.contains("//") {
        return refuse(
            path,
            format!("`{value}` is not a value in RON"),
            "write numbers as 0.05, texts in double quotes, lists as [0, 1], choices as Fixed(88)",
        );
    }
    // A broken file is reported by the reader, with its own place.
    let Ok(root) = Node::parse(source.text()) else { return Ok(()) };
    let (node, done) = root.locate(&wanted);
    if done == wanted.len() {
        source.replace(node.span.clone(), value, argument);
        return Ok(());
    }
    let reached = path_text(&wanted[..done]);
    match (&node.content, &wanted[done]) {
        (Content::Fields { open, .. }, Step::Name(_)) => {
            source.replace(*open..*open, &inserted(&wanted[done..], value), argument);
            Ok(())
        }
        (Content::Tuple { open, items }, Step::Name(_)) if items.is_empty() => {
            source.replace(*open..*open, &inserted(&wanted[done..], value), argument);
            Ok(())
        }
        (Content::List(items), Step::Index(index)) => refuse(
            path,
            format!("`{reached}` has no entry {index}"),
            &match items.len() {
                0 => "the list is empty".to_owned(),
                count => format!("entries 0 to {} exist", count - 1),
            },
        ),
        (Content::List(items), Step::Name(name)) => refuse(
            path,
            format!("`{reached}` is a list and has no field `{name}`"),
            &format!("choose an entry by its index, 0 to {}", items.len().saturating_sub(1)),
        ),
        (_, step) => refuse(
            path,
            format!("`{reached}` is a single value and has no part {}", step_text(step)),
            "leave out the last part of the path",
        ),
    }
}

/// Text of the missing fields `path` around `value`.
fn inserted(path: &[Step], value: &str) -> String {
    let mut text = value.to_owned();
    for (depth, step) in path.iter().enumerate().rev() {
        let Step::Name(name) = step else { continue };
        text = format!("{name}: {text}");
        text = if depth > 0 { format!("({text})") } else { format!("{text}, ") };
    }
    text
}

fn step_text(step: &Step) -> String {
    match step {
        Step::Name(name) => format!("`{name}`"),
        Step::Index(index) => format!("[{index}]"),
    }
}

fn path_text(path: &[Step]) -> String {
    path.iter().fold(String::new(), |text, step| match step {
        Step::Name(name) if text.is_empty() => name.clone(),
        Step::Name(name) => format!("{text}.{name}"),
        Step::Index(index) => format!("{text}[{index}]"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "(fluid: (spacing: 0.1, blocks: [(name: \"w\")]), output: ())";

    fn with(argument: &str) -> Result<String, String> {
        let mut source = Source::new("x.ron", TEXT);
        apply(&mut source, argument).map_err(|error| error.to_string())?;
        Ok(source.text().to_owned())
    }

    #[test]
    fn values_are_replaced_and_inserted() {
        assert!(with("fluid.spacing = 0.05").unwrap().contains("spacing: 0.05"));
        assert!(with("fluid.blocks.0.name=\"x\"").unwrap().contains("(name: \"x\")"));
        assert!(with("fluid.density=998").unwrap().contains("(density: 998, spacing"));
        assert!(with("output.frame_interval=1").unwrap().contains("output: (frame_interval: 1, )"));
        assert!(with("a.b=1").unwrap().starts_with("(a: (b: 1), fluid"));
    }

    #[test]
    fn bad_arguments_are_refused() {
        for (argument, message) in [
            ("fluid.spacing", "needs a `=`"),
            ("=1", "needs a path"),
            ("fluid.spacing=1, x: 2", "not a value"),
            ("fluid.blocks.3.name=1", "entries 0 to 0 exist"),
            ("fluid.blocks.name=1", "is a list"),
            ("fluid.spacing.x=1", "is a single value"),
        ] {
            let error = with(argument).unwrap_err();
            assert!(error.contains(message) && error.contains("--set"), "{error}");
        }
    }
}
