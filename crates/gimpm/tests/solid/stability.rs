//! How large a step is stable, and what a large rotation does.

use crate::lattice::{lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, InitialVelocity, LinearElastic, Shape, Solid};
use motion::Motion;
use nalgebra::{Matrix3, SVector};

const H: f64 = 0.1;

/// Energy after 3000 steps over the energy at the start, for a clamped block with
/// a rough velocity that excites every wave the grid holds. `jitter` displaces
/// the points (in point spacings), `offset` the whole block (in cells), which
/// leaves slivers of mass on the nodes beyond its faces.
fn growth<const D: usize>(courant_number: f64, jitter: f64, offset: f64, shape: Shape) -> f64 {
    let mut state = 12_345_u64;
    let mut random = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    };
    let points: Vec<SVector<f64, D>> = lattice(SVector::repeat(offset * H), [8; D], 0.5 * H)
        .into_iter()
        .map(|x| x.map(|along| along + jitter * 0.5 * H * random()))
        .collect();
    let velocity = points.iter().map(|x| x.map(|_| 1e-3 * random())).collect();
    let seed = BodySeed {
        name: "block".into(),
        material: LinearElastic { density: 1.0, young_modulus: 1.0, poisson_ratio: 0.2 }.into(),
        points,
        velocity: InitialVelocity::PerPoint(velocity),
        point_spacing: 0.5 * H,
        discretisation: Discretisation { shape, ..Discretisation::default() },
    };
    let fixed = std::array::from_fn(|_| Some(Motion::Fixed));
    let clamp = planes("clamp", 0, f64::NEG_INFINITY, 0.0, fixed);
    let parameters = parameters(H, SVector::repeat(-2.0 * H), [9; D], courant_number);
    let mut solid = Solid::new(parameters, vec![seed], vec![clamp]).unwrap();
    let start = solid.energy().kinetic;
    for _ in 0..3000 {
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
    }
    let end = solid.energy();
    (end.kinetic + end.strain) / start
}

/// An unstable mode grows without bound over thousands of steps; the wobble of
/// the staggered energy is a few per cent at the largest step.
#[test]
fn courant_number_one_is_stable_in_two_and_three_dimensions() {
    for (jitter, offset) in [(0.0, 0.0), (0.3, 0.0), (0.0, 0.26), (0.0, 0.49), (0.3, 0.4)] {
        let ratios = [
            growth::<2>(1.0, jitter, offset, Shape::Ugimp),
            growth::<3>(1.0, jitter, offset, Shape::Ugimp),
            growth::<2>(0.7, jitter, offset, Shape::Linear),
        ];
        println!("jitter {jitter}, offset {offset}: {ratios:.3?}");
        for ratio in ratios {
            assert!((0.9..1.1).contains(&ratio), "jitter {jitter}, offset {offset}: {ratio}");
        }
    }
}

/// A free square turns once. Returns the losses of angular momentum and of total
/// energy, and the largest `|FᵀF - I|`.
fn one_turn(cells: usize) -> [f64; 3] {
    let (spin, spacing) = (2.0, 0.8 / cells as f64);
    let points = lattice::<2>(SVector::repeat(-0.4), [2 * cells; 2], 0.5 * spacing);
    let velocity = points.iter().map(|x| SVector::from([-spin * x[1], spin * x[0]])).collect();
    let seed = BodySeed {
        name: "square".into(),
        material: LinearElastic { density: 1.0, young_modulus: 100.0, poisson_ratio: 0.3 }.into(),
        points,
        velocity: InitialVelocity::PerPoint(velocity),
        point_spacing: 0.5 * spacing,
        discretisation: Discretisation::default(),
    };
    let parameters = parameters(spacing, SVector::repeat(-0.8), [2 * cells; 2], 0.4);
    let mut solid = Solid::new(parameters, vec![seed], Vec::new()).unwrap();
    let momentum = solid.angular_momentum(SVector::zeros())[2];
    let energy = solid.energy().kinetic;
    while solid.time() < std::f64::consts::PI {
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
    }
    let end = solid.energy();
    let gradients = &solid.points().deformation_gradient;
    let strain = gradients
        .iter()
        .map(|f| (f.transpose() * f - Matrix3::identity()).norm())
        .fold(0.0, f64::max);
    [
        1.0 - solid.angular_momentum(SVector::zeros())[2] / momentum,
        1.0 - (end.kinetic + end.strain) / energy,
        strain,
    ]
}

/// The lumped nodal mass of (5) does not conserve angular momentum exactly; the
/// loss must fall with the square of the cell width, and the objective rate must
/// keep the body's strain small over a full turn.
#[test]
fn a_turning_square_converges_with_the_grid() {
    let [coarse, fine] = [8, 16].map(one_turn);
    println!("angular momentum, energy, strain: 8 cells {coarse:.4?}, 16 cells {fine:.4?}");
    assert!(fine[0] < 0.05 && coarse[0] / fine[0] > 3.0, "{coarse:?} {fine:?}");
    assert!(fine[1].abs() < 0.01, "{fine:?}");
    assert!(fine[2] < 0.1, "{fine:?}");
}
