//! Momentum, work and load balances, for random states.

use crate::lattice::{lattice, parameters, planes};
use crate::noise::noise;
use gimpm::{
    BodySeed, Discretisation, InitialVelocity, LinearElastic, Shape, Solid, SolidParameters,
};
use motion::Motion;
use nalgebra::SVector;
use proptest::prelude::*;

const SOFT: LinearElastic =
    LinearElastic { density: 1200.0, young_modulus: 2.0e6, poisson_ratio: 0.3 };
const H: f64 = 0.1;

/// Two bodies of random points and velocities in the middle of a grid.
fn debris<const D: usize>(
    seed: u64,
    discretisation: Discretisation,
    change: impl FnOnce(&mut SolidParameters<D>),
    constraints: Vec<gimpm::NodeConstraint<D>>,
) -> Solid<D> {
    let mut random = noise(seed);
    let mut parameters = parameters(H, SVector::repeat(-0.5), [12; D], 0.4);
    change(&mut parameters);
    let mut body = |name: &str, lower: f64, spacing: f64, count: usize| {
        let points: Vec<SVector<f64, D>> = lattice(SVector::repeat(lower), [count; D], spacing)
            .into_iter()
            .map(|x| x.map(|along| along + 0.2 * spacing * random()))
            .collect();
        let velocity = points.iter().map(|x| x.map(|_| random())).collect();
        BodySeed {
            name: name.into(),
            material: SOFT.into(),
            points,
            velocity: InitialVelocity::PerPoint(velocity),
            point_spacing: spacing,
            discretisation,
        }
    };
    let bodies = vec![body("first", -0.13, 0.05, 5), body("second", 0.15, 0.04, 4)];
    Solid::new(parameters, bodies, constraints).unwrap()
}

/// Steps freely and returns the largest relative change of momentum.
fn free_flight<const D: usize>(seed: u64, shape: Shape) -> f64 {
    let mut solid = debris::<D>(
        seed,
        Discretisation { shape, ..Discretisation::default() },
        |_| (),
        Vec::new(),
    );
    let start = solid.momentum();
    let scale: f64 = {
        let points = solid.points();
        (0..points.len()).map(|p| points.mass[p] * points.velocity[p].norm()).sum()
    };
    let mut worst: f64 = 0.0;
    for _ in 0..30 {
        let dt = solid.stable_time_step().unwrap().value;
        solid.step(dt).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
        worst = worst.max((solid.momentum() - start).norm() / scale);
    }
    worst
}

/// Momentum change of each step against gravity, loads and reactions.
fn balance<const D: usize>(seed: u64) -> (f64, f64) {
    let mut components: [Option<Motion>; D] = std::array::from_fn(|_| Some(Motion::Fixed));
    let mut pushed: [Option<Motion>; D] = std::array::from_fn(|_| None);
    pushed[0] = Some(Motion::SmoothStart { velocity: 0.3, duration: 0.01 });
    let constraints = vec![
        planes("floor", D - 1, f64::NEG_INFINITY, -0.1, components.clone()),
        planes("ram", 0, 0.3, f64::INFINITY, pushed),
    ];
    components[0] = None;
    let mut solid = debris::<D>(
        seed,
        Discretisation::default(),
        |p| {
            p.gravity = SVector::from_fn(|d, _| [1.0, -9.81, 3.0][d]);
            p.damping = 0.1;
        },
        constraints,
    );
    let mut random = noise(seed + 1);
    let (mut worst, mut load_error) = (0.0_f64, 0.0_f64);
    for _ in 0..20 {
        let force: Vec<SVector<f64, D>> = solid
            .points()
            .mass
            .iter()
            .map(|m| SVector::from_fn(|_, _| 50.0 * m * random()))
            .collect();
        let total: SVector<f64, D> = force.iter().sum();
        solid.scatter_point_force(&force);
        let size: f64 = force.iter().map(|f| f.norm()).sum();
        load_error = load_error.max((solid.external_force_total() - total).norm() / size);
        let (before, damped) = (solid.momentum(), solid.ledger().damping_impulse);
        let dt = solid.stable_time_step().unwrap().value;
        solid.step(dt).unwrap();
        let reaction =
            solid.reaction(0, SVector::zeros()).0 + solid.reaction(1, SVector::zeros()).0;
        let gravity = solid.parameters().gravity * solid.total_mass();
        let damping = solid.ledger().damping_impulse - damped;
        let given = (gravity + total + reaction) * dt + damping;
        let scale: f64 = {
            let points = solid.points();
            (0..points.len()).map(|p| points.mass[p] * points.velocity[p].norm()).sum()
        };
        worst = worst.max((solid.momentum() - before - given).norm() / scale);
        if solid.needs_sort() {
            solid.sort_points();
        }
    }
    (worst, load_error)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 12, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn momentum_is_conserved_in_free_flight(seed in 0..u64::MAX / 2) {
        for (dimension, error) in [
            ("2D uGIMP", free_flight::<2>(seed, Shape::Ugimp)),
            ("3D uGIMP", free_flight::<3>(seed, Shape::Ugimp)),
            ("2D linear", free_flight::<2>(seed, Shape::Linear)),
        ] {
            prop_assert!(error < 1e-13, "{dimension}: {error}");
        }
    }

    #[test]
    fn momentum_changes_by_gravity_loads_and_reactions(seed in 0..u64::MAX / 2) {
        for (worst, load_error) in [balance::<2>(seed), balance::<3>(seed)] {
            prop_assert!(worst < 1e-12, "momentum residual {worst}");
            prop_assert!(load_error < 1e-13, "scattered load {load_error}");
        }
    }
}

/// A block falling with gravity gains what gravity gives, and stays unstressed.
#[test]
fn free_fall_is_uniform() {
    let mut parameters = parameters::<3>(H, SVector::repeat(-0.6), [12; 3], 0.4);
    parameters.gravity = SVector::from([0.0, 0.0, -9.81]);
    let block = BodySeed {
        name: "block".into(),
        material: SOFT.into(),
        points: lattice(SVector::repeat(-0.1), [4; 3], 0.05),
        velocity: crate::lattice::at_rest(),
        point_spacing: 0.05,
        discretisation: Discretisation::default(),
    };
    let mut solid = Solid::new(parameters, vec![block], Vec::new()).unwrap();
    let (dt, steps) = (5e-4, 500);
    for _ in 0..steps {
        solid.step(dt).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
    }
    let (fall, n) = (solid.displacement_at(0, solid.points().reference_position[0])[2], 500.0);
    let exact = -9.81 * dt * dt * n * (n + 1.0) / 2.0;
    assert!((fall / exact - 1.0).abs() < 1e-12, "{fall} {exact}");
    let stress = solid.points().stress.iter().flatten().fold(0.0_f64, |a, s| a.max(s.abs()));
    assert!(stress < 1e-9 * SOFT.young_modulus, "{stress}");
}

/// Work given by a load on points equals force times displacement, and appears
/// as energy: a bar pulled at its end by a slowly growing force.
#[test]
fn work_of_loads_becomes_energy() {
    let bar = BodySeed {
        name: "bar".into(),
        material: LinearElastic { poisson_ratio: 0.0, ..SOFT }.into(),
        points: lattice(SVector::zeros(), [20, 4], 0.05),
        velocity: crate::lattice::at_rest(),
        point_spacing: 0.05,
        discretisation: Discretisation::default(),
    };
    let clamp = planes("clamp", 0, f64::NEG_INFINITY, 0.0, [Some(Motion::Fixed), None]);
    let parameters = parameters::<2>(H, SVector::repeat(-0.3), [16, 8], 0.1);
    let mut solid = Solid::new(parameters, vec![bar], vec![clamp]).unwrap();
    let mut work = 0.0;
    while solid.time() < 0.02 {
        let points = solid.points();
        let before = points.position.clone();
        let force: Vec<SVector<f64, 2>> = points
            .reference_position
            .iter()
            .map(|x| {
                SVector::from([if x[0] > 0.95 { 50.0 * solid.time() / 0.02 } else { 0.0 }, 0.0])
            })
            .collect();
        solid.scatter_point_force(&force);
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
        let after = &solid.points().position;
        work += (0..force.len()).map(|p| force[p].dot(&(after[p] - before[p]))).sum::<f64>();
    }
    let (energy, ledger) = (solid.energy(), solid.ledger());
    assert!((ledger.external_work / work - 1.0).abs() < 1e-11, "{} {work}", ledger.external_work);
    assert!(ledger.boundary_work.abs() < 1e-12 * work, "a fixed clamp does no work");
    let stored = energy.kinetic + energy.strain;
    assert!((stored / work - 1.0).abs() < 0.01, "stored {stored} of {work}");
}
