//! Bending: the first mode of a plate clamped at one edge, in plane strain
//! (Landau and Lifshitz; Gray, Monaghan and Swift 2001).

use crate::lattice::{lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, InitialVelocity, LinearElastic, Solid};
use motion::Motion;
use nalgebra::SVector;

const LENGTH: f64 = 0.2;
const THICKNESS: f64 = 0.02;
const PLATE: LinearElastic =
    LinearElastic { density: 1000.0, young_modulus: 2.0e6, poisson_ratio: 0.3975 };
/// Tip speed at the start (m/s): a deflection of 0.2 % of the thickness.
const SPEED: f64 = 1e-3;
/// First root of cos kL cosh kL = -1.
const KL: f64 = 1.875_104;

/// Period of a thin plate, `ω² = E H² (kL)⁴ / (12 ρ (1-ν²) L⁴)`: 0.2540 s.
fn published_period() -> f64 {
    let LinearElastic { density, young_modulus, poisson_ratio } = PLATE;
    let stiffness = young_modulus * THICKNESS.powi(2) * KL.powi(4);
    let inertia = 12.0 * density * (1.0 - poisson_ratio * poisson_ratio) * LENGTH.powi(4);
    2.0 * std::f64::consts::PI / (stiffness / inertia).sqrt()
}

/// Period over the published one, with `cells` through the thickness.
fn period_ratio(cells: usize) -> f64 {
    let spacing = THICKNESS / cells as f64;
    let points = lattice::<2>(SVector::zeros(), [20 * cells, 2 * cells], 0.5 * spacing);
    let mode = |x: f64| {
        let (kx, ratio) = (KL * x / LENGTH, (KL.cosh() + KL.cos()) / (KL.sinh() + KL.sin()));
        kx.cosh() - kx.cos() - ratio * (kx.sinh() - kx.sin())
    };
    let velocity =
        points.iter().map(|x| SVector::from([0.0, SPEED * mode(x[0]) / mode(LENGTH)])).collect();
    let seed = BodySeed {
        name: "plate".into(),
        material: PLATE.into(),
        points,
        velocity: InitialVelocity::PerPoint(velocity),
        point_spacing: 0.5 * spacing,
        discretisation: Discretisation::default(),
    };
    let clamp =
        planes("clamp", 0, f64::NEG_INFINITY, 0.0, [Some(Motion::Fixed), Some(Motion::Fixed)]);
    let grid = [10 * cells + 4, 5 * cells];
    let origin = SVector::from([-2.0 * spacing, -2.0 * THICKNESS]);
    let mut solid =
        Solid::new(parameters(spacing, origin, grid, 0.5), vec![seed], vec![clamp]).unwrap();
    let corner = SVector::from([LENGTH, 0.5 * THICKNESS]);
    let tip = (20 * 2 * cells * cells - 1) as u32;
    let (mut before, mut crossings) = ((0.0, 0.0), Vec::new());
    while crossings.len() < 2 {
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
        let deflection = solid.displacement_at(solid.point_index(tip).unwrap(), corner)[1];
        if before.1 * deflection < 0.0 {
            let fraction = before.1 / (before.1 - deflection);
            crossings.push(before.0 + fraction * (solid.time() - before.0));
        }
        before = (solid.time(), deflection);
    }
    crossings[1] / published_period()
}

/// Two cells through the thickness are too stiff by sampling and shear; the error
/// must fall at least with the square of the cell width.
#[test]
fn clamped_plate_vibrates_with_the_published_period() {
    let error = [2, 4, 8].map(|cells| period_ratio(cells) - 1.0);
    println!("period error with 2, 4, 8 cells through the thickness: {error:.4?}");
    assert!(error[0].abs() < 0.07 && error[2].abs() < 0.005, "{error:?}");
    assert!(error[0] / error[1] > 3.0 && error[1] / error[2] > 3.0, "{error:?}");
}
