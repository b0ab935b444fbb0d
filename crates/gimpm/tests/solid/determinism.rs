//! The same bits for any thread count, and after save/restore or a checkpoint.

use crate::lattice::{lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, InitialVelocity, LinearElastic, Solid, SolidState};
use motion::Motion;
use nalgebra::SVector;

/// Two overlapping soft blocks moving and shearing across slabs.
fn blocks() -> Solid<3> {
    let body = |name: &str, lower: [f64; 3], velocity: [f64; 3]| BodySeed {
        name: name.into(),
        material: LinearElastic { density: 1000.0, young_modulus: 1.0e6, poisson_ratio: 0.3 }
            .into(),
        points: lattice(SVector::from(lower), [10, 10, 20], 0.05),
        velocity: InitialVelocity::Uniform(SVector::from(velocity)),
        point_spacing: 0.05,
        discretisation: Discretisation::default(),
    };
    let bodies = vec![
        body("left", [0.0, 0.0, 0.0], [1.0, 0.0, 2.0]),
        body("right", [0.5, 0.0, 0.3], [-2.0, 0.5, 1.0]),
    ];
    let mut parameters = parameters(0.1, SVector::repeat(-0.5), [20, 16, 24], 0.4);
    parameters.gravity = SVector::from([0.0, 0.0, -9.81]);
    let floor =
        planes("floor", 2, f64::NEG_INFINITY, 0.0, std::array::from_fn(|_| Some(Motion::Fixed)));
    Solid::new(parameters, bodies, vec![floor]).unwrap()
}

fn run(solid: &mut Solid<3>, steps: usize) {
    for _ in 0..steps {
        let force: Vec<SVector<f64, 3>> =
            solid.points().id.iter().map(|id| SVector::repeat(f64::from(*id) * 1e-5)).collect();
        solid.scatter_point_force(&force);
        let dt = solid.stable_time_step().unwrap().value;
        solid.step(dt).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
    }
}

/// Bits, not values: `-0.0` and `0.0` differ.
fn bits(state: &SolidState<3>) -> String {
    format!("{state:?}")
}

#[test]
fn one_and_several_threads_give_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut solid = blocks();
            run(&mut solid, 60);
            solid.state().clone()
        })
    };
    let (one, two, five) = (with(1), with(2), with(5));
    assert!(one.steps == 60 && one.drift < 0.05, "sorted on the way");
    assert_eq!(bits(&one), bits(&two));
    assert_eq!(bits(&one), bits(&five));
}

#[test]
fn a_restored_state_continues_with_the_same_bits() {
    let mut solid = blocks();
    run(&mut solid, 25);
    let checkpoint = solid.state().clone();
    solid.save();
    run(&mut solid, 20);
    let expected = bits(solid.state());

    solid.restore();
    assert_eq!(bits(solid.state()), bits(&checkpoint));
    run(&mut solid, 20);
    assert_eq!(bits(solid.state()), expected, "save and restore");

    let mut fresh = blocks();
    fresh.restore_state(checkpoint).unwrap();
    run(&mut fresh, 20);
    assert_eq!(bits(fresh.state()), expected, "checkpoint in a new solid");
}

#[test]
fn reading_reactions_changes_nothing() {
    let mut solid = blocks();
    run(&mut solid, 10);
    let before = bits(solid.state());
    let dt = solid.stable_time_step().unwrap().value;
    let now = solid.current_reactions(dt).unwrap();
    assert_eq!(bits(solid.state()), before);
    solid.step(dt).unwrap();
    assert_eq!(solid.reaction(0, SVector::zeros()).0, now[0].force);
}
