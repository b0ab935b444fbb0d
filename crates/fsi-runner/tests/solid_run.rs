//! What the solid adds to a run: loads, relaxation, memory of laws, restart.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use case::Case;
use fsi_runner::output::checkpoint::Checkpoint;
use fsi_runner::output::frame::Frame;
use fsi_runner::simulation::{Simulation, assemble};

/// A plane bar of 1 m × 0.2 m that slides on two planes of symmetry.
fn bar(solid: &str, material: &str, body: &str) -> Case {
    let text = format!(
        r#"(
            name: "bar", dimension: 2, gravity: [0.0, 0.0], end_time: 10.0,
            solid: (grid_spacing: 0.1, {solid} bodies: [(
                name: "bar", shape: Box(lower: [0.0, 0.0], upper: [1.0, 0.2]),
                material: {material},
                boundaries: [
                    (name: "end", where: Face("x-"), motion: Symmetry),
                    (name: "side", where: Face("y-"), motion: Symmetry),
                ],
                {body}
            )]),
            gauges: [
                Displacement(name: "tip", position: [1.0, 0.1]),
                Stress(name: "middle", position: [0.5, 0.1]),
                Force(name: "held", on: "end"),
                CenterOfMass(name: "mass", of: "bar"),
            ],
            output: (frame_interval: 0.1),
        )"#
    );
    Case::parse("bar.ron", &text, &[]).unwrap()
}

const ELASTIC: &str = "LinearElastic(density: 1000.0, young_modulus: 1.0e6, poisson_ratio: 0.0)";
const METAL: &str = "VonMises(density: 1000.0, young_modulus: 1.0e6, poisson_ratio: 0.3, \
                     yield_stress: 1.0e3, hardening_modulus: 1.0e5)";
const PULL: &str = r#"loads: [(name: "pull", where: Face("x+"), kind: Traction([1.0e3, 0.0]))],"#;

fn take_steps(simulation: &mut dyn Simulation, count: usize) {
    for _ in 0..count {
        let limit = simulation.time_step().unwrap();
        simulation.step(limit.value).unwrap();
    }
}

fn gauge(simulation: &mut dyn Simulation, name: &str) -> f64 {
    let columns = simulation.gauge_columns();
    let index = columns.iter().position(|column| column.name == name);
    let index = index.unwrap_or_else(|| panic!("no {name} in {columns:?}"));
    simulation.gauge_row()[index]
}

/// Statics: σ = t, u = L (exp(t/E) - 1), reaction t A.
#[test]
fn a_pulled_bar_relaxes_to_its_static_state() {
    let case = bar("relaxation: (tolerance: 1e-6),", ELASTIC, PULL);
    let mut simulation = assemble(&case).unwrap();
    let simulation = simulation.as_mut();
    assert!(!simulation.is_relaxed());
    let mut steps = 0;
    while !simulation.is_relaxed() {
        take_steps(simulation, 1);
        steps += 1;
        assert!(steps < 20_000, "{:?}", simulation.relaxation());
    }
    let progress = simulation.relaxation().unwrap();
    assert!(progress.relaxed && progress.out_of_balance <= progress.tolerance, "{progress:?}");
    for (name, expected, tolerance) in [
        ("tip.x", 1.0005e-3, 1e-5),
        ("middle.stress_xx", 1e3, 1e-5),
        ("held.force_x", -200.0, 1e-5),
        ("mass.displacement_x", 0.50025e-3, 1e-5),
    ] {
        let value = gauge(simulation, name);
        assert!((value / expected - 1.0).abs() < tolerance, "{name}: {value}, not {expected}");
    }
    assert!(gauge(simulation, "mass.velocity_x").abs() < 1e-6);
}

#[test]
fn a_frame_shows_plastic_strain_where_a_law_has_it() {
    let yields = PULL.replace("1.0e3", "1.5e3");
    let mut simulation = assemble(&bar("damping: 0.2,", METAL, &yields)).unwrap();
    take_steps(simulation.as_mut(), 400);
    let frame = simulation.frame(0);
    let field = frame.clouds[0].field("plastic_strain").unwrap();
    assert_eq!((field.components, field.unit), (1, "1"));
    let largest = field.values.iter().copied().fold(0.0, f64::max);
    assert!(largest > 1e-3 && largest < 0.1, "{largest}");
    let names: Vec<_> = simulation.ledger_columns().into_iter().map(|column| column.name).collect();
    let row = simulation.ledger_row();
    let of = |name: &str| row[names.iter().position(|column| column == name).unwrap()];
    assert!(of("solid.plastic_work") > 0.0 && of("solid.out_of_balance") >= 0.0);
    let elastic = assemble(&bar("", ELASTIC, PULL)).unwrap().frame(0);
    assert!(elastic.clouds[0].field("plastic_strain").is_none());
}

/// The same numbers in every field, bit for bit.
fn assert_same(a: &Frame, b: &Frame) {
    assert_eq!((a.step, a.time.to_bits()), (b.step, b.time.to_bits()));
    for (a, b) in a.clouds.iter().zip(&b.clouds) {
        assert_eq!((&a.id, &a.position), (&b.id, &b.position));
        for (a, b) in a.fields.iter().zip(&b.fields) {
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert!(bits(&a.values) == bits(&b.values), "`{}` differs", a.name);
        }
    }
}

#[test]
fn a_restart_continues_bit_for_bit_whatever_the_method() {
    let lift = r#"loads: [(name: "pull", where: Face("x+"), kind: Pressure(-1.5e3), ramp: 0.02)],"#;
    for solid in [
        "frame: Total,",
        "frame: Updated,",
        "frame: Updated, stress_update: Usf,",
        "frame: Total, relaxation: (tolerance: 1e-9), gravity_ramp: 0.01,",
    ] {
        let case = bar(solid, METAL, lift);
        let mut unbroken = assemble(&case).unwrap();
        take_steps(unbroken.as_mut(), 150);
        let mut checkpoint = Checkpoint::default();
        unbroken.save(&mut checkpoint);
        take_steps(unbroken.as_mut(), 150);
        let mut resumed = assemble(&case).unwrap();
        resumed.load(&checkpoint).unwrap();
        take_steps(resumed.as_mut(), 150);
        assert_same(&unbroken.frame(0), &resumed.frame(0));
        assert_eq!(unbroken.gauge_row(), resumed.gauge_row(), "{solid}");
        assert_eq!(unbroken.ledger_row(), resumed.ledger_row(), "{solid}");
    }
}
