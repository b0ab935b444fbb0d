//! What the seeded particles and points must satisfy.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use case::{Case, ForceTarget, GaugeKind, Model};
use gimpm::InitialVelocity;
use nalgebra::{Vector2, vector};

fn build<const D: usize>(name: &str, overrides: &[&str]) -> Model<D> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(name);
    let overrides: Vec<String> = overrides.iter().map(|argument| (*argument).into()).collect();
    Case::load(path, &overrides).unwrap().build().unwrap()
}

#[test]
fn still_water_has_the_density_of_its_depth() {
    let fluid = build::<2>("hydrostatic_tank", &[]).fluid.unwrap();
    let parameters = &fluid.parameters;
    assert!((parameters.sound_speed - 20.0 * 9.81_f64.sqrt()).abs() < 1e-12);
    let columns = (1.0 / parameters.spacing).round() as usize;
    for (index, seed) in fluid.particles.iter().enumerate() {
        let pressure = parameters.sound_speed.powi(2) * seed.density_deviation;
        let height = ((index / columns) as f64 + 0.5) * parameters.spacing;
        // A particle carries those above it, whatever they are compressed to.
        let expected = 1000.0 * 9.81 * (1.0 - height);
        assert!((pressure - expected).abs() < 1e-8 * 9810.0, "{seed:?}");
        // The compressed column is shorter by ½ gH/c0², a 1/800 here, at its top.
        assert!((0.0..1.3e-3).contains(&(height - seed.position.y)), "{seed:?}");
    }
}

#[test]
fn walls_continue_the_lattice_and_keep_half_a_spacing_from_the_face() {
    let fluid = build::<2>("hydrostatic_tank", &[]).fluid.unwrap();
    let spacing = fluid.parameters.spacing;
    let on_lattice = |p: &Vector2<f64>| {
        p.iter().all(|c| (c / spacing - 0.5 - (c / spacing - 0.5).round()).abs() < 1e-9)
    };
    let wall = &fluid.walls[0];
    assert!(wall.points.iter().all(on_lattice));
    let settled = |p: &Vector2<f64>| {
        let row = (p.y / spacing - 0.5).round();
        on_lattice(&vector![p.x, (row + 0.5) * spacing]) && (p.y / spacing - 0.5 - row).abs() < 0.06
    };
    assert!(fluid.particles.iter().all(|seed| settled(&seed.position)));
    let highest_below = wall.points.iter().map(|p| p.y).filter(|y| *y < 0.0).fold(-1.0, f64::max);
    assert!((highest_below + 0.5 * spacing).abs() < 1e-12);
    // 46 columns of 3 layers below, 3 columns on each side up to the open top.
    assert_eq!(wall.points.len(), 3 * 46 + 2 * 3 * 50);
}

#[test]
fn the_block_has_its_mass_and_holds_its_end_planes() {
    let solid = build::<3>("uniaxial_compression", &[]).solid.unwrap();
    assert_eq!(solid.bodies[0].points.len(), 16_000);
    let sum: nalgebra::Vector3<f64> = solid.bodies[0].points.iter().sum();
    assert!((sum / 16_000.0 - vector![0.5, 0.5, 1.0]).norm() < 1e-12);
    let held = |constraint: usize, p: [f64; 3]| {
        let constraint = &solid.constraints[constraint];
        (0..3).all(|axis| constraint.lower[axis] <= p[axis] && p[axis] <= constraint.upper[axis])
    };
    for (constraint, planes, free) in [(0, [0.0, -0.1], 0.1), (1, [2.0, 2.1], 1.9)] {
        for z in planes {
            assert!(held(constraint, [0.0, 1.0, z]) && held(constraint, [-0.1, 1.1, z]), "{z}");
            assert!(!held(constraint, [-0.2, 0.5, z]));
        }
        assert!(!held(constraint, [0.5, 0.5, free]));
    }
    let parameters = &solid.parameters;
    for axis in 0..3 {
        let cells = -parameters.grid_origin[axis] / parameters.grid_spacing;
        assert!((cells - cells.round()).abs() < 1e-9);
        let upper = parameters.grid_origin[axis] + parameters.grid_cells[axis] as f64 * 0.1;
        assert!(parameters.grid_origin[axis] <= -0.3 + 1e-9 && upper >= 1.3 - 1e-9);
    }
    // The end displacement is a thousandth of the grid spacing.
    let gimpm::Hold::Components(components) = &solid.constraints[1].hold else { panic!() };
    let press = components[2].as_ref().unwrap();
    assert!((press.displacement(8.049845e-3) + 1e-4).abs() < 1e-9);
}

#[test]
fn the_mode_is_a_quarter_sine_along_the_bar() {
    let body = build::<2>("bar_mode_1", &[]).solid.unwrap().bodies.remove(0);
    let InitialVelocity::PerPoint(velocity) = body.velocity else { panic!("one velocity only") };
    for (v, p) in velocity.iter().zip(&body.points) {
        let expected = 0.01 * (std::f64::consts::PI * p.x / 50.0).sin();
        assert!((v - vector![expected, 0.0]).norm() < 1e-15);
    }
}

#[test]
fn gauges_find_what_they_name() {
    let model = build::<3>("tsunami_wall", &["fluid.spacing=0.125", "solid.grid_spacing=0.2"]);
    let target = |name: &str| {
        let gauge = model.gauges.iter().find(|gauge| gauge.name == name).unwrap();
        match &gauge.kind {
            GaugeKind::Force { target, .. } => *target,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(target("load"), ForceTarget::Body(0));
    assert_eq!(target("base_reaction"), ForceTarget::Boundary(0));
    assert_eq!(model.estimate.material_points, 800);
    assert!(model.case_text.contains("spacing: 0.125"));
    // μ = 2400 · 0.4/(1000 · 0.125)
    assert!((model.coupling.mass_ratio - 7.68).abs() < 1e-9);
}

#[test]
fn a_beach_is_a_flat_face_at_half_a_spacing() {
    let text = r#"(
        name: "beach", dimension: 2, end_time: 1.0,
        fluid: (spacing: 0.02, blocks: [(name: "water", shape: Compose([
            Add(Box(lower: [0, 0], upper: [2, 0.3])),
            Subtract(Moved(shape: Box(lower: [1, -1], upper: [4, 0]), rotate: (degrees: 20, about: [1, 0]))),
        ]))]),
        walls: [
            (name: "bed", shape: Tank(lower: [0, 0], upper: [3, 1], open: ["y+", "x+"])),
            (name: "beach", shape: Moved(shape: Box(lower: [1, -1], upper: [4, 0]), rotate: (degrees: 20, about: [1, 0]))),
        ],
        output: (frame_interval: 0.1),
    )"#;
    let fluid = Case::parse("beach.ron", text, &[]).unwrap().build::<2>().unwrap().fluid.unwrap();
    let angle = 20_f64.to_radians();
    let normal = vector![-angle.sin(), angle.cos()];
    let heights = fluid.walls[1].points.iter().map(|p| (p - vector![1.0, 0.0]).dot(&normal));
    let highest = heights.fold(f64::NEG_INFINITY, f64::max);
    assert!((highest + 0.01).abs() < 1e-12, "{highest}");
    assert!(
        fluid.particles.iter().all(|seed| (seed.position - vector![1.0, 0.0]).dot(&normal) > 0.0)
    );
}

/// A plane block of 1 m × 0.4 m with fields put into the solid and into the body.
fn block(solid: &str, body: &str) -> Result<Case, case::CaseError> {
    let text = format!(
        r#"(
            name: "block", dimension: 2, end_time: 1.0,
            solid: (grid_spacing: 0.1, {solid} bodies: [(
                name: "block", shape: Box(lower: [0, 0], upper: [1, 0.4]),
                material: NeoHookean(density: 1000, young_modulus: 1e6, poisson_ratio: 0.3),
                {body}
            )]),
            output: (frame_interval: 0.1),
        )"#
    );
    Case::parse("block.ron", &text, &[])
}

fn block_model(solid: &str, body: &str) -> case::SolidModel<2> {
    block(solid, body).unwrap().build::<2>().unwrap().solid.unwrap()
}

#[test]
fn a_body_takes_its_own_choices_before_those_of_the_solid() {
    use gimpm::{Discretisation, Frame, Shape, Transfer};
    let of = |solid, body| block_model(solid, body).bodies[0].discretisation;
    let total = Discretisation { frame: Frame::Total, ..Discretisation::default() };
    assert_eq!(of("", ""), total);
    assert_eq!(of("contact: (friction: 0.3),", ""), Discretisation::default());
    let chosen = of(
        "frame: Updated, shape_function: Linear, transfer: Apic,",
        "frame: Total, shape_function: Cpdi, transfer: Fmpm(order: 3), mean_dilatation: true,",
    );
    let expected = Discretisation {
        frame: Frame::Total,
        shape: Shape::Cpdi,
        transfer: Transfer::Fmpm { order: 3 },
        mean_dilatation: true,
    };
    assert_eq!(chosen, expected);
    let warnings = |solid: &str, body: &str| block(solid, body).unwrap().warnings().to_vec();
    assert!(warnings("shape_function: Cpdi,", "")[0].contains("changes nothing"));
    assert!(warnings("", "").is_empty());
    let restless = "boundaries: [(name: \"press\", where: Face(\"y+\"), motion: Driven(y: Constant(velocity: -1)))],";
    assert!(warnings("relaxation: (),", restless)[0].contains("cannot come to rest"));
    let table = "boundaries: [(name: \"press\", where: Face(\"y+\"), motion: Driven(y: Table(rows: [(0, 0), (0.5, -0.1)])))],";
    assert!(warnings("relaxation: (),", table).is_empty());
}

#[test]
fn the_solids_settings_reach_the_solver() {
    let parameters = block_model(
        "frame: Updated, stress_update: Usf, contact: (friction: 0.3), relaxation: (tolerance: 1e-4), gravity_ramp: 2.0,",
        "",
    )
    .parameters;
    assert_eq!(parameters.stress_update, gimpm::StressUpdate::First);
    assert_eq!(parameters.contact, Some(gimpm::Contact { friction: 0.3 }));
    assert_eq!(parameters.relaxation, Some(gimpm::Relaxation { tolerance: 1e-4 }));
    assert_eq!(parameters.gravity_ramp, 2.0);
}

#[test]
fn boundaries_hold_components_and_normals() {
    use gimpm::Hold;
    let model = block_model(
        "",
        r#"boundaries: [
            (name: "middle", where: Face("x-"), motion: Symmetry),
            (name: "roof", where: Face("y+"), motion: Slip()),
            (name: "floor", where: Face("y-"), motion: Support()),
            (name: "slope", where: Region(lower: [0.2, 0.0], upper: [0.8, 0.0]),
             motion: Slip(normal: [-3.0, 4.0], law: Constant(velocity: 0.5))),
        ],"#,
    );
    let Hold::Components([Some(_), None]) = &model.constraints[0].hold else { panic!() };
    let normal = |index: usize| match &model.constraints[index].hold {
        Hold::Normal { direction, motion, one_sided } => {
            (*direction, motion.velocity(0.1), *one_sided)
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(normal(1), (vector![0.0, -1.0], 0.0, false));
    assert_eq!(normal(2), (vector![0.0, 1.0], 0.0, true));
    let (direction, velocity, one_sided) = normal(3);
    assert!((direction - vector![-0.6, 0.8]).norm() < 1e-12 && velocity == 0.5 && !one_sided);
}

#[test]
fn loads_name_the_faces_they_act_on() {
    let body = r#"loads: [
        (name: "pull", where: Face("x+"), kind: Traction([2.0e8, 0.0]), ramp: 0.1),
        (name: "push", where: Region(face: "y+", lower: [0.25, 0.4], upper: [0.75, 0.4]), kind: Pressure(5.0)),
        (name: "water", where: Face("x-"), kind: Hydrostatic(level: 0.3)),
        (name: "brine", where: Face("x-"), kind: Hydrostatic(level: 0.3, density: 1200)),
    ],"#;
    let case = block("", body).unwrap();
    let model = case.build::<2>().unwrap();
    for note in
        ["`pull`: 8 point faces towards x+, 0.4 m", "`push`: 10 point faces towards y+, 0.5 m"]
    {
        assert!(model.notes.iter().any(|line| line.contains(note)), "{note}: {:?}", model.notes);
    }
    let loads = model.solid.unwrap().loads;
    assert_eq!((loads[0].axis, loads[0].upper_side, loads[0].ramp), (0, true, 0.1));
    assert!(loads[0].lower.x < 1.0 && loads[0].upper.x > 1.0 && loads[0].upper.y == f64::INFINITY);
    assert!(!loads[2].upper_side);
    let weight = |index: usize| match loads[index].kind {
        gimpm::LoadKind::Hydrostatic { specific_weight, .. } => specific_weight,
        other => panic!("{other:?}"),
    };
    assert!((weight(2) - 9810.0).abs() < 1e-9 && (weight(3) - 11_772.0).abs() < 1e-9);
}

#[test]
fn round_bodies_in_the_total_frame_fill_cells_with_whole_points() {
    let text = r#"(
        name: "disc", dimension: 2, end_time: 1.0,
        solid: (grid_spacing: 0.1, bodies: [
            (name: "table", shape: Box(lower: [0, 0], upper: [1, 0.2]),
             material: LinearElastic(density: 1000, young_modulus: 1e6, poisson_ratio: 0.3)),
            (name: "disc", shape: Sphere(center: [0.513, 0.497], radius: 0.21),
             material: LinearElastic(density: 1000, young_modulus: 1e6, poisson_ratio: 0.3)),
        ]),
        output: (frame_interval: 0.1),
    )"#;
    let solid = Case::parse("disc.ron", text, &[]).unwrap().build::<2>().unwrap().solid.unwrap();
    let disc = &solid.bodies[1].points;
    assert!(disc.len() > 40);
    assert!(
        disc.iter().flatten().all(|x| (x / 0.05 - 0.5 - (x / 0.05 - 0.5).round()).abs() < 1e-9)
    );
    // The solver, which demands whole points in every cell, agrees.
    gimpm::Solid::new(solid.parameters, solid.bodies, solid.constraints).unwrap();
}
