//! The vector loops against the plain ones, which take one point at a time.

use gimpm::{
    BodySeed, Discretisation, Hold, InitialVelocity, LinearElastic, Loops, MaterialModel,
    NodeConstraint, Shape, Solid, SolidParameters, StressUpdate, VonMises,
};
use motion::Motion;
use nalgebra::SVector;
use proptest::prelude::*;

/// A number in 0 to 1 that looks random (splitmix64).
fn noise(seed: u64) -> f64 {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) as f64 / u64::MAX as f64
}

/// Two bodies of points scattered over boxes that overlap, some cells crowded, some
/// empty, on a grid that no lattice fits; held at one side.
fn scattered<const D: usize>(
    loops: Loops,
    shape: Shape,
    stress_update: StressUpdate,
    seed: u64,
    count: usize,
) -> Solid<D> {
    let cells = [7, 5, 11];
    let cells: [usize; D] = std::array::from_fn(|d| cells[d + 3 - D]);
    let spacing = 0.1 + 0.03 * noise(seed);
    let origin = SVector::from_fn(|d, _| noise(seed + d as u64) - 0.5);
    let body = |number: u64, material: MaterialModel| BodySeed {
        name: format!("body {number}"),
        material,
        points: (0..count as u64)
            .map(|k| {
                SVector::from_fn(|d, _| {
                    let along = noise(1000 * seed + 7919 * number + 3 * k + d as u64);
                    origin[d] + spacing * (0.7 + (cells[d] as f64 - 1.4) * along)
                })
            })
            .collect(),
        velocity: InitialVelocity::PerPoint(
            (0..count as u64)
                .map(|k| SVector::from_fn(|d, _| noise(31 * k + number + d as u64) - 0.5))
                .collect(),
        ),
        point_spacing: spacing * (0.2 + 0.8 * noise(seed + 5 + number)),
        discretisation: Discretisation { shape, ..Discretisation::default() },
    };
    let parameters = SolidParameters {
        gravity: SVector::from_fn(|d, _| -1.0 - d as f64),
        gravity_ramp: 0.0,
        stress_update,
        loops,
        contact: None,
        relaxation: None,
        courant_number: 0.1,
        grid_spacing: spacing,
        grid_origin: origin,
        grid_cells: cells,
        damping: 0.05,
    };
    let elastic = LinearElastic { density: 900.0, young_modulus: 1.0e6, poisson_ratio: 0.3 };
    let metal = VonMises {
        density: 1100.0,
        young_modulus: 2.0e6,
        poisson_ratio: 0.2,
        yield_stress: 100.0,
        hardening_modulus: 1.0e4,
    };
    let mut upper = SVector::repeat(f64::INFINITY);
    upper[0] = origin[0] + spacing;
    let held = NodeConstraint {
        name: "held".into(),
        body: 0,
        lower: SVector::repeat(f64::NEG_INFINITY),
        upper,
        hold: Hold::Components(std::array::from_fn(|_| Some(Motion::Fixed))),
    };
    let bodies = vec![body(0, elastic.into()), body(1, metal.into())];
    Solid::new(parameters, bodies, vec![held]).unwrap()
}

/// Largest difference of all numbers of two solids, each over the largest number of its kind.
fn difference<const D: usize>(one: &Solid<D>, two: &Solid<D>) -> f64 {
    let (a, b) = (one.points(), two.points());
    let mut worst: f64 = 0.0;
    let mut compare = |numbers: &dyn Fn(&gimpm::Points<D>, usize) -> Vec<f64>| {
        let (mut apart, mut size) = (0.0_f64, f64::MIN_POSITIVE);
        for id in 0..a.len() as u32 {
            let x = numbers(a, one.point_index(id).unwrap());
            let y = numbers(b, two.point_index(id).unwrap());
            for (x, y) in x.iter().zip(&y) {
                assert!(x.is_finite() && y.is_finite());
                apart = apart.max((x - y).abs());
                size = size.max(x.abs());
            }
        }
        worst = worst.max(apart / size);
    };
    compare(&|points, p| points.position[p].as_slice().to_vec());
    compare(&|points, p| points.velocity[p].as_slice().to_vec());
    compare(&|points, p| points.deformation_gradient[p].as_slice().to_vec());
    compare(&|points, p| points.stress[p].to_vec());
    compare(&|points, p| points.history[p].to_vec());
    compare(&|points, p| vec![points.volume[p]]);
    worst
}

fn agree<const D: usize>(shape: Shape, order: StressUpdate, seed: u64, count: usize) {
    let [mut fast, mut plain] =
        [Loops::Fast, Loops::Plain].map(|loops| scattered::<D>(loops, shape, order, seed, count));
    // Without re-mapping, the large velocities of light nodes strain the points, and
    // scattered points have many light nodes: differences of round-off soon grow.
    let steps = if order == StressUpdate::Last { 1 } else { 6 };
    for step in 0..steps {
        let dt = plain.stable_time_step().unwrap().value;
        assert!((fast.stable_time_step().unwrap().value / dt - 1.0).abs() < 1e-12);
        fast.step(dt).unwrap();
        plain.step(dt).unwrap();
        if step == 2 {
            fast.sort_points();
        }
    }
    let apart = difference(&fast, &plain);
    assert!(apart < 1e-12, "{shape:?} {order:?} in {D}D, seed {seed}, {count} points: {apart:e}");
    let [a, b] = [&fast, &plain].map(|solid| solid.reaction(0, SVector::zeros()).0);
    assert!((a - b).norm() < 1e-12 * b.norm(), "reactions {a} {b}");
    assert!((fast.state().drift / plain.state().drift).is_finite());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn vector_and_plain_loops_agree(seed in 0..10_000_u64, count in 1..400_usize) {
        for shape in [Shape::Linear, Shape::Ugimp] {
            for order in [StressUpdate::ModifiedLast, StressUpdate::First, StressUpdate::Last] {
                agree::<2>(shape, order, seed, count);
                agree::<3>(shape, order, seed, count);
            }
        }
    }
}
