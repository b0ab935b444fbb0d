//! Collapse of a water column (Martin and Moyce 1952, n² = 2; Koshizuka and Oka 1996).

#![allow(clippy::unwrap_used)]

mod tank;

use nalgebra::SVector;
use sph::{Dissipation, Fluid, FluidParameters};

type V2 = SVector<f64, 2>;

const WIDTH: f64 = 0.1;
const GRAVITY: f64 = 9.81;

/// Front position `Z/a` against `t √(2g/a)`, `shared/reference/dam_break_2d`.
const EXPERIMENTS: [&[(f64, f64)]; 3] = [
    // Martin and Moyce, a = 1.125 in
    &[(0.849, 1.245), (1.212, 1.443), (1.602, 1.884), (2.283, 2.689), (2.95, 3.728)],
    // Martin and Moyce, a = 2.25 in
    &[(0.832, 1.217), (1.219, 1.474), (1.997, 2.292), (2.547, 2.995), (3.345, 4.134)],
    // Koshizuka and Oka
    &[
        (0.381, 1.111),
        (0.769, 1.252),
        (1.153, 1.505),
        (1.537, 1.892),
        (1.935, 2.241),
        (2.323, 2.615),
        (2.719, 3.003),
        (3.096, 3.624),
    ],
];

fn column(height_cells: f64, sound_factor: f64, dissipation: Dissipation, length: f64) -> Fluid<2> {
    let height = 2.0 * WIDTH;
    let dx = height / height_cells;
    let parameters = FluidParameters {
        gravity: V2::new(0.0, -GRAVITY),
        dissipation,
        domain: (V2::repeat(-0.1), V2::new(length + 0.1, 1.0)),
        ..FluidParameters::water(dx, sound_factor * (GRAVITY * height).sqrt())
    };
    let seeds = tank::still_water(V2::zeros(), V2::new(WIDTH, height), &parameters);
    let points = tank::tank(V2::zeros(), V2::new(length, 3.0 * WIDTH), dx);
    Fluid::new(parameters, seeds, vec![tank::wall("tank", points)]).unwrap()
}

fn interpolate(curve: &[(f64, f64)], t: f64) -> Option<f64> {
    let after = curve.partition_point(|point| point.0 <= t);
    (after > 0 && after < curve.len()).then(|| {
        let ((t0, z0), (t1, z1)) = (curve[after - 1], curve[after]);
        z0 + (z1 - z0) * (t - t0) / (t1 - t0)
    })
}

#[test]
fn front_stays_within_five_percent_of_the_experiments() {
    let scale = (2.0 * GRAVITY / WIDTH).sqrt();
    let mut fluid = column(40.0, 20.0, Dissipation::Artificial { alpha: 0.05 }, 0.8);
    let (mut worst, mut next, mut compared) = (0.0_f64, 0.0, 0);
    loop {
        let dt = fluid.stable_time_step().unwrap().value;
        fluid.step(dt).unwrap();
        let t = fluid.time() * scale;
        if t < next {
            continue;
        }
        next += 0.02;
        let front = fluid.front(&V2::new(1.0, 0.0)) / WIDTH;
        if front > 3.0 {
            break;
        }
        let measured: Vec<f64> =
            EXPERIMENTS.iter().filter_map(|curve| interpolate(curve, t)).collect();
        if measured.is_empty() {
            continue;
        }
        compared += 1;
        let low = measured.iter().copied().fold(f64::INFINITY, f64::min);
        let high = measured.iter().copied().fold(0.0, f64::max);
        let deviation = (front / high - 1.0).max(0.0) + (front / low - 1.0).min(0.0);
        worst = if deviation.abs() > worst.abs() { deviation } else { worst };
    }
    eprintln!("dam break front: worst deviation from the band {:+.2} %", 100.0 * worst);
    assert!(compared > 80);
    assert!(worst.abs() < 0.05, "{worst}");
}

#[test]
fn impact_on_the_far_wall_stays_in_the_tank() {
    let length = 0.4;
    for dissipation in
        [Dissipation::Artificial { alpha: 0.02 }, Dissipation::Riemann { limiter: 3.0 }]
    {
        let mut fluid = column(40.0, 10.0, dissipation, length);
        let start = fluid.energy().total();
        let mut deepest = 0.0_f64;
        while fluid.time() < 0.7 {
            let dt = fluid.stable_time_step().unwrap().value;
            fluid.step(dt).unwrap();
            for x in &fluid.particles().position {
                deepest = deepest.max(-x[0]).max(x[0] - length).max(-x[1]);
            }
        }
        let loss = start - fluid.energy().total();
        let residual = fluid.energy_residual() / loss;
        eprintln!(
            "{dissipation:?}: deepest penetration {:.3} dx, residual {residual:.4} of the loss, {:?}",
            deepest / 0.005,
            fluid.ledger()
        );
        assert!(deepest < 0.5 * 0.005, "particle {deepest} m inside a wall");
        assert_eq!(fluid.ledger().removed.count, 0);
        assert!(residual.abs() < 0.06, "{residual}");
        let ledger = fluid.ledger();
        assert!(ledger.viscous_loss > 0.0 && ledger.impact_loss > 0.0);
    }
}
