//! No text, however broken, makes the reader panic.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use case::Case;
use proptest::prelude::*;

const GOOD: &str = include_str!("../../../cases/floating_block/case.ron");

/// A solid alone, with one of everything.
const SOLID: &str = r#"(
    name: "solid", dimension: 2, end_time: 1.0,
    solid: (
        grid_spacing: 0.1, frame: Updated, shape_function: Cpdi, transfer: Fmpm(order: 2),
        stress_update: Usl, relaxation: (tolerance: 1e-4), gravity_ramp: 1,
        bodies: [
            (name: "block", shape: Box(lower: [0, 0], upper: [1, 0.4]), transfer: Apic,
             material: DruckerPrager(density: 2400, young_modulus: 3e10, poisson_ratio: 0.2,
                 compressive_strength: 3e7, tensile_strength: 3e6),
             boundaries: [
                 (name: "floor", where: Face("y-"), motion: Support()),
                 (name: "slope", where: Region(lower: [0, 0], upper: [0.2, 0.4]),
                  motion: Slip(normal: [3, 4], law: Table(rows: [(0, 0), (1, 0.1)]))),
             ],
             loads: [
                 (name: "pull", where: Face("x+"), kind: Traction([1, 2]), ramp: 0.5),
                 (name: "water", where: Region(face: "x-", lower: [0, 0], upper: [0, 0.4]),
                  kind: Hydrostatic(level: 0.3, density: 1200)),
             ]),
            (name: "disc", shape: Sphere(center: [0.5, 0.8], radius: 0.2),
             material: MooneyRivlin(density: 1100, c10: 1e5, bulk_modulus: 1e7)),
        ],
    ),
    gauges: [CenterOfMass(name: "middle", of: "disc")],
    output: (frame_interval: 0.1),
)"#;

/// Stretches of RON that reach deeper than random bytes do.
const PIECES: [&str; 16] = [
    "(",
    ")",
    "[",
    "]",
    ",",
    ":",
    "\"",
    "//",
    "/*",
    "r#\"",
    "-1e308",
    "1e-308",
    "NaN",
    "inf",
    "Moved(shape: ",
    "Compose([Subtract(",
];

#[derive(Debug, Clone)]
enum Edit {
    Delete,
    Duplicate,
    Insert(usize),
    Replace(char),
}

fn edit() -> impl Strategy<Value = (Edit, usize, usize)> {
    let kind = prop_oneof![
        Just(Edit::Delete),
        Just(Edit::Duplicate),
        (0..PIECES.len()).prop_map(Edit::Insert),
        any::<char>().prop_map(Edit::Replace),
    ];
    (kind, 0..GOOD.len().max(SOLID.len()), 1_usize..20)
}

fn apply(text: &mut String, (edit, at, length): &(Edit, usize, usize)) {
    let boundary = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let (start, end) = (boundary(*at), boundary(at + length));
    match edit {
        Edit::Delete => text.replace_range(start..end, ""),
        Edit::Duplicate => {
            let piece = text[start..end].to_owned();
            text.insert_str(end, &piece);
        }
        Edit::Insert(piece) => text.insert_str(start, PIECES[*piece]),
        Edit::Replace(c) => text.replace_range(start..end, &c.to_string()),
    }
}

fn use_all(case: Result<Case, case::CaseError>) {
    match case {
        Err(error) => {
            let report = format!("{:?}", miette::Report::new(error));
            assert!(!report.is_empty());
        }
        Ok(case) if case.estimate().memory < 1 << 24 => {
            let _ = case.build::<2>().map_err(|error| error.to_string());
            let _ = case.build::<3>().map_err(|error| error.to_string());
        }
        Ok(_) => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn mutated_text_is_read_or_refused(
        good in prop::sample::select(vec![GOOD, SOLID]),
        edits in prop::collection::vec(edit(), 1..4),
    ) {
        let mut text = good.to_owned();
        edits.iter().for_each(|edit| apply(&mut text, edit));
        use_all(Case::parse("x.ron", &text, &[]));
    }

    #[test]
    fn any_override_is_applied_or_refused(path in "[a-z_.0-9\\[\\]]{0,30}", value in ".{0,12}") {
        use_all(Case::parse("x.ron", GOOD, &[format!("{path}={value}"), path]));
    }

    #[test]
    fn any_number_is_used_or_refused(
        field in prop::sample::select(vec![
            "fluid.spacing", "solid.grid_spacing", "fluid.blocks.0.shape.0.upper.0",
            "solid.bodies.0.shape.upper.1", "solid.bodies.0.shape.lower.1", "end_time",
            "fluid.sound_speed", "solid.grid_margin", "fluid.lattice_origin.0", "gravity.1",
            "solid.bodies.0.material.young_modulus", "walls.0.shape.upper.1",
        ]),
        value in prop_oneof![any::<f64>(), -2.0..2.0_f64],
    ) {
        use_all(Case::parse("x.ron", GOOD, &[format!("{field}={value:?}")]));
    }

    #[test]
    fn any_number_in_a_solid_is_used_or_refused(
        field in prop::sample::select(vec![
            "solid.grid_spacing", "solid.gravity_ramp", "solid.relaxation.tolerance", "solid.bodies.0.boundaries.1.where.lower.0",
            "solid.bodies.0.boundaries.1.motion.normal.0", "solid.bodies.0.loads.0.kind.0.1",
            "solid.bodies.0.loads.0.ramp", "solid.bodies.0.loads.1.kind.level",
            "solid.bodies.0.loads.1.kind.density", "solid.bodies.0.loads.1.where.upper.1",
            "solid.bodies.0.material.tensile_strength", "solid.bodies.0.material.dilatancy",
            "solid.bodies.1.material.c10", "solid.bodies.1.material.bulk_modulus",
        ]),
        value in prop_oneof![any::<f64>(), -2.0..2.0_f64],
        method in prop::sample::select(vec![
            "solid.frame=Total", "solid.frame=Updated", "solid.contact=(friction: 0.3)",
        ]),
    ) {
        let arguments = [format!("{field}={value:?}"), method.to_owned()];
        use_all(Case::parse("x.ron", SOLID, &arguments));
    }
}
