//! Names: present, printable and unique.

use std::collections::BTreeMap;

use crate::format::CaseForm;

use super::Checker;

/// Checks all names of a case. Walls, bodies, boundaries and loads share one list,
/// since a force gauge refers to most of them.
pub(crate) fn names(form: &CaseForm, check: &mut Checker<'_>) {
    let mut blocks = Vec::new();
    for (index, block) in form.fluid.iter().flat_map(|fluid| fluid.blocks.iter().enumerate()) {
        blocks.push((format!("fluid.blocks[{index}].name"), block.name.as_str()));
    }
    let mut bearers = Vec::new();
    for (index, wall) in form.walls.iter().enumerate() {
        bearers.push((format!("walls[{index}].name"), wall.name.as_str()));
    }
    for (index, body) in form.solid.iter().flat_map(|solid| solid.bodies.iter().enumerate()) {
        let path = format!("solid.bodies[{index}]");
        bearers.push((format!("{path}.name"), body.name.as_str()));
        for (inner, load) in body.loads.iter().enumerate() {
            bearers.push((format!("{path}.loads[{inner}].name"), load.name.as_str()));
        }
        for (inner, boundary) in body.boundaries.iter().enumerate() {
            bearers.push((format!("{path}.boundaries[{inner}].name"), boundary.name.as_str()));
        }
    }
    let gauges = form.gauges.iter().enumerate();
    let gauges: Vec<_> =
        gauges.map(|(index, gauge)| (format!("gauges[{index}].name"), gauge.name())).collect();
    for list in [blocks, bearers, gauges] {
        unique(&list, check);
    }
}

fn unique(list: &[(String, &str)], check: &mut Checker<'_>) {
    let mut seen: BTreeMap<&str, &str> = BTreeMap::new();
    for (path, name) in list {
        let printable = |c: char| !c.is_control() && !"\",/\\".contains(c);
        if name.trim().is_empty() || !name.chars().all(printable) {
            check.problem(
                path,
                format!("`{name}` is not a name"),
                "give a text without commas, quotes, slashes and line breaks",
            );
        }
        if let Some(first) = seen.insert(name, path) {
            check.problem(
                path,
                format!("the name `{name}` is used twice; first at `{first}`"),
                "give each its own name",
            );
        }
    }
}
