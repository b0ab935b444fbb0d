//! What is refused, and what the message names.

use crate::lattice::{CONCRETE, at_rest, lattice, parameters, planes};
use gimpm::{
    BodySeed, Discretisation, InitialVelocity, LinearElastic, NodeConstraint, Solid, SolidError,
    SolidParameters,
};
use motion::Motion;
use nalgebra::SVector;

fn block() -> BodySeed<2> {
    BodySeed {
        name: "block".into(),
        material: CONCRETE.into(),
        points: lattice(SVector::zeros(), [4, 4], 0.05),
        velocity: at_rest(),
        point_spacing: 0.05,
        discretisation: Discretisation::default(),
    }
}

fn grid() -> SolidParameters<2> {
    parameters(0.1, SVector::repeat(-0.2), [6, 6], 0.5)
}

fn refused(
    parameters: SolidParameters<2>,
    seed: BodySeed<2>,
    held: Vec<NodeConstraint<2>>,
) -> String {
    Solid::new(parameters, vec![seed], held).unwrap_err().to_string()
}

#[test]
fn bad_parameters_are_named_with_value_and_range() {
    for (change, expected) in [
        ((|p| p.grid_spacing = 0.0) as fn(&mut SolidParameters<2>), "grid_spacing is 0;"),
        (|p| p.courant_number = 1.5, "courant_number is 1.5; it must be in (0, 1]"),
        (|p| p.damping = -0.1, "damping is -0.1;"),
        (|p| p.gravity[1] = f64::NAN, "gravity is NaN;"),
        (|p| p.grid_cells[0] = 0, "grid_cells is 0;"),
    ] {
        let mut changed = grid();
        change(&mut changed);
        let message = refused(changed, block(), Vec::new());
        assert!(message.contains(expected), "{message}");
    }
    let heavy = LinearElastic { density: -5.0, ..CONCRETE };
    let message = refused(grid(), BodySeed { material: heavy.into(), ..block() }, Vec::new());
    assert!(message.contains("body 'block': density is -5 kg/m³"), "{message}");
    let message = refused(grid(), BodySeed { point_spacing: 0.2, ..block() }, Vec::new());
    assert!(message.contains("point_spacing is 0.2 m"), "{message}");
    let velocity = InitialVelocity::PerPoint(vec![SVector::zeros(); 3]);
    let message = refused(grid(), BodySeed { velocity, ..block() }, Vec::new());
    assert!(message.contains("16 points but 3 initial velocities"), "{message}");
    assert_eq!(
        Solid::<1>::new(parameters(0.1, SVector::zeros(), [3], 0.5), vec![], vec![]).unwrap_err(),
        SolidError::Dimension(1)
    );
}

#[test]
fn constraints_that_hold_nothing_are_refused() {
    let fixed = || [Some(Motion::Fixed), None];
    let between = planes("between planes", 0, 0.03, 0.07, fixed());
    assert!(refused(grid(), block(), vec![between]).contains("'between planes': its box"));
    let upside_down = planes("upside down", 0, 1.0, 0.0, fixed());
    assert!(refused(grid(), block(), vec![upside_down]).contains("lower must not exceed upper"));
    let idle = planes("idle", 0, 0.0, 0.0, [None, None]);
    assert!(refused(grid(), block(), vec![idle]).contains("holds no component"));
    let press = Motion::Ramp { velocity: 1.0, duration: 0.0 };
    let bad = planes("press", 0, 0.0, 0.0, [Some(press), None]);
    assert!(refused(grid(), block(), vec![bad]).contains("duration is 0 s"));
}

#[test]
fn points_outside_the_grid_are_named() {
    let mut seed = block();
    seed.points[7] = SVector::from([0.5, 0.0]);
    let error = Solid::new(grid(), vec![seed], Vec::new()).unwrap_err();
    assert!(matches!(error, SolidError::OutsideGrid { point: 7, .. }), "{error}");
    let mut seed = block();
    seed.points[3][1] = f64::NAN;
    let error = Solid::new(grid(), vec![seed], Vec::new()).unwrap_err();
    assert!(matches!(error, SolidError::NonFinite { point: 3, quantity: "position", .. }));
}

#[test]
fn a_flying_block_leaves_the_grid_and_the_solid_stops_there() {
    let seed =
        BodySeed { velocity: InitialVelocity::Uniform(SVector::from([1.0, 0.0])), ..block() };
    let mut solid = Solid::new(grid(), vec![seed], Vec::new()).unwrap();
    solid.save();
    let error = loop {
        if let Err(error) = solid.step(2e-5) {
            break error;
        }
        if solid.needs_sort() {
            solid.sort_points();
        }
    };
    assert!(matches!(error, SolidError::OutsideGrid { .. }), "{error}");
    assert_eq!(solid.step(2e-5), Err(error.clone()));
    assert_eq!(solid.stable_time_step().unwrap_err(), error);
    solid.scatter_point_force(&vec![SVector::zeros(); 16]);
    solid.restore();
    assert_eq!(solid.step(2e-5), Ok(()));
}

#[test]
fn unsorted_drift_is_an_error_with_its_remedy() {
    let mut wide = grid();
    wide.grid_cells = [6, 60];
    let seed =
        BodySeed { velocity: InitialVelocity::Uniform(SVector::from([0.0, 5.0])), ..block() };
    let mut solid = Solid::new(wide, vec![seed], Vec::new()).unwrap();
    let error = (0..100_000).find_map(|_| solid.step(2e-5).err()).unwrap();
    assert!(error.to_string().contains("call sort_points"), "{error}");
    assert!(solid.needs_sort());
}

#[test]
fn time_steps_beyond_the_wave_are_refused() {
    let mut solid = Solid::new(grid(), vec![block()], Vec::new()).unwrap();
    let limit = solid.stable_time_step().unwrap();
    assert_eq!(limit.term, "P-wave speed");
    let error = solid.step(2.1 * limit.value).unwrap_err();
    assert!(matches!(error, SolidError::TimeStepTooLarge { term: "P-wave speed", .. }), "{error}");
    assert_eq!(solid.step(-1.0).unwrap_err(), SolidError::TimeStep(-1.0));
    assert_eq!(solid.step(limit.value), Ok(()), "a refused step changes nothing");
}

#[test]
fn infinite_loads_and_crushed_points_are_named() {
    let mut solid = Solid::new(grid(), vec![block()], Vec::new()).unwrap();
    let mut force = vec![SVector::zeros(); 16];
    force[5][0] = f64::INFINITY;
    solid.scatter_point_force(&force);
    let error = solid.step(1e-6).unwrap_err();
    assert!(matches!(error, SolidError::NonFinite { .. }), "{error}");

    let soft = LinearElastic { density: 1000.0, young_modulus: 1.0, poisson_ratio: 0.0 };
    let velocity = block()
        .points
        .iter()
        .map(|x| SVector::from([if x[0] < 0.15 { 10.0 } else { -10.0 }, 0.0]))
        .collect();
    let seed = BodySeed {
        material: soft.into(),
        velocity: InitialVelocity::PerPoint(velocity),
        ..block()
    };
    let mut solid = Solid::new(grid(), vec![seed], Vec::new()).unwrap();
    assert_eq!(solid.stable_time_step().unwrap().term, "point velocity");
    let error = (0..1000)
        .find_map(|_| {
            let limit = solid.stable_time_step().unwrap().value;
            solid.step(2.0 * limit).err()
        })
        .unwrap();
    assert!(matches!(error, SolidError::Inverted { .. }), "{error}");
}

#[test]
fn a_state_of_another_solid_is_refused() {
    let mut solid = Solid::new(grid(), vec![block()], Vec::new()).unwrap();
    let smaller = BodySeed { points: lattice(SVector::zeros(), [2, 2], 0.05), ..block() };
    let other = Solid::new(grid(), vec![smaller], Vec::new()).unwrap();
    let error = solid.restore_state(other.state().clone()).unwrap_err();
    assert!(error.to_string().contains("4 material points, this solid has 16"), "{error}");
}
