//! Periods of a sound wave and of a standing gravity wave.

#![allow(clippy::unwrap_used)]

mod tank;

use nalgebra::SVector;
use sph::{Dissipation, Fluid, FluidParameters, FluidSeed};
use std::f64::consts::PI;

type V2 = SVector<f64, 2>;

/// Times at which a sampled signal has a local minimum below half its largest value.
fn minima(signal: &[(f64, f64)]) -> Vec<f64> {
    let top = signal.iter().map(|s| s.1).fold(0.0, f64::max);
    let mut found: Vec<f64> = vec![];
    let mut k = 0;
    while k < signal.len() {
        let end = (k..signal.len()).find(|&i| signal[i].1 > 0.25 * top).unwrap_or(signal.len());
        if end > k + 2 && k > 0 && end < signal.len() {
            // Middle of the interval below the level: exact for a symmetric dip.
            found.push(0.5 * (signal[k].0 + signal[end].0));
        }
        k = (end..signal.len()).find(|&i| signal[i].1 <= 0.25 * top).unwrap_or(signal.len());
    }
    found
}

fn kinetic_energy(fluid: &mut Fluid<2>, end: f64) -> Vec<(f64, f64)> {
    let mut signal = vec![];
    while fluid.time() < end {
        let dt = fluid.stable_time_step().unwrap().value;
        fluid.step(dt).unwrap();
        signal.push((fluid.time(), fluid.energy().kinetic));
    }
    signal
}

/// Relative error of the period of the first mode in a closed square box.
fn sound_period_error(dx: f64) -> f64 {
    let (length, height, c0) = (1.0, 1.0, 50.0);
    let parameters = FluidParameters {
        dissipation: Dissipation::None,
        density_diffusion: 0.0,
        domain: (V2::repeat(-0.2), V2::repeat(1.2)),
        ..FluidParameters::water(dx, c0)
    };
    let corner = V2::new(length, height);
    let mut points = tank::tank(V2::zeros(), corner, dx);
    points.extend(tank::fill(
        V2::new(-4.0 * dx, height),
        V2::new(length + 4.0 * dx, height + 4.0 * dx),
        dx,
    ));
    // A background pressure keeps the one-sided walls in contact.
    let seeds = tank::fill(V2::zeros(), corner, dx)
        .into_iter()
        .map(|position| FluidSeed {
            position,
            density_deviation: 2.0 + 0.5 * (PI * position[0] / length).cos(),
            ..FluidSeed::default()
        })
        .collect();
    let mut fluid = Fluid::new(parameters, seeds, vec![tank::wall("box", points)]).unwrap();
    let period = 2.0 * length / c0;
    let dips = minima(&kinetic_energy(&mut fluid, 3.3 * period));
    // Kinetic energy ~ sin²(ωt) vanishes every half period.
    let measured = 2.0 * (dips[dips.len() - 1] - dips[0]) / (dips.len() - 1) as f64;
    eprintln!("dx {dx}: sound period {measured:.6} s, exact {period:.6} s");
    measured / period - 1.0
}

#[test]
fn sound_crosses_a_closed_box_at_c0() {
    // First order in dx: the layer along a wall sees half of a tangential gradient
    // (docs/method.md, C3), which slows the wave.
    let (coarse, fine) = (sound_period_error(0.05), sound_period_error(0.025));
    assert!(fine.abs() < 0.03 && fine.abs() < 0.65 * coarse.abs(), "{coarse} {fine}");
}

#[test]
fn standing_wave_has_the_linear_period() {
    // H 1, wavelength 2: T = 1.134 s. Flat surface, velocity of the linear solution.
    let (dx, g) = (1.0 / 32.0, 9.81_f64);
    let (k, amplitude) = (PI, 0.03);
    let omega = (g * k * k.tanh()).sqrt();
    let parameters = FluidParameters {
        gravity: V2::new(0.0, -g),
        domain: (V2::repeat(-0.5), V2::repeat(1.5)),
        ..FluidParameters::water(dx, 10.0 * g.sqrt())
    };
    let mut seeds = tank::still_water(V2::zeros(), V2::repeat(1.0), &parameters);
    for seed in &mut seeds {
        let (x, y) = (seed.position[0], seed.position[1]);
        let scale = amplitude * omega / k.sinh();
        seed.velocity =
            V2::new(-(k * x).sin() * (k * y).cosh(), (k * x).cos() * (k * y).sinh()) * scale;
    }
    let wall = tank::wall("tank", tank::tank(V2::zeros(), V2::new(1.0, 1.25), dx));
    let mut fluid = Fluid::new(parameters, seeds, vec![wall]).unwrap();
    let dips = minima(&kinetic_energy(&mut fluid, 2.2));
    let measured = 2.0 * (dips[dips.len() - 1] - dips[0]) / (dips.len() - 1) as f64;
    let period = 2.0 * PI / omega;
    eprintln!("standing wave period {measured:.4} s, linear {period:.4} s, dips {dips:?}");
    assert!((measured / period - 1.0).abs() < 0.02);
}
