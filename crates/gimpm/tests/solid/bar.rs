//! Axial vibration of a bar in its first mode (reference data: `bar/`, set A):
//! L 25, E 100, ρ 1, ν 0, v0 0.1 sin(πx/2L), so ω = πc/2L = 0.6283185.

use crate::lattice::{lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, InitialVelocity, LinearElastic, Solid};
use motion::Motion;
use nalgebra::SVector;
use std::f64::consts::PI;

const LENGTH: f64 = 25.0;
const CELLS: usize = 40;
const OMEGA: f64 = 0.628_318_530_717_958_6;
const RUBBER: LinearElastic =
    LinearElastic { density: 1.0, young_modulus: 100.0, poisson_ratio: 0.0 };

/// A bar along axis 0, one cell thick, clamped at x = 0, on rollers elsewhere if
/// asked for.
fn bar<const D: usize>(speed: f64, courant_number: f64, rollers: bool) -> Solid<D> {
    let spacing = LENGTH / CELLS as f64;
    let mut cells = [3; D];
    cells[0] = CELLS + 2;
    let mut counts = [2; D];
    counts[0] = 2 * CELLS;
    let points = lattice(SVector::zeros(), counts, 0.5 * spacing);
    let velocity = points
        .iter()
        .map(|x| {
            let mut v = SVector::zeros();
            v[0] = speed * (PI * x[0] / (2.0 * LENGTH)).sin();
            v
        })
        .collect();
    let mut held = std::array::from_fn(|_| None);
    held[0] = Some(Motion::Fixed);
    let mut constraints = vec![planes("clamp", 0, f64::NEG_INFINITY, 0.0, held)];
    if rollers {
        let mut sideways: [Option<Motion>; D] = std::array::from_fn(|_| Some(Motion::Fixed));
        sideways[0] = None;
        constraints.push(planes("rollers", 0, f64::NEG_INFINITY, f64::INFINITY, sideways));
    }
    let seed = BodySeed {
        name: "bar".into(),
        material: RUBBER.into(),
        points,
        velocity: InitialVelocity::PerPoint(velocity),
        point_spacing: 0.5 * spacing,
        discretisation: Discretisation::default(),
    };
    let origin = SVector::repeat(-spacing);
    let parameters = parameters(spacing, origin, cells, courant_number);
    Solid::new(parameters, vec![seed], constraints).unwrap()
}

struct Measured {
    frequency_error: f64,
    energy_drift: f64,
    energy_deviation: f64,
    momentum_residual: f64,
}

/// Three periods: the frequency from the zero crossings of the mean axial
/// displacement, the energy against its start, the momentum balance of each step.
fn vibrate<const D: usize>(mut solid: Solid<D>) -> Measured {
    let period = 2.0 * PI / OMEGA;
    let start = solid.energy().kinetic;
    let scale = solid.momentum()[0];
    let (mut previous_time, mut previous) = (0.0, 0.0);
    let mut crossings = Vec::new();
    let (mut energy_deviation, mut momentum_residual) = (0.0_f64, 0.0_f64);
    let mut energy = start;
    while solid.time() < 3.02 * period {
        let before = solid.momentum();
        let dt = solid.stable_time_step().unwrap().value;
        solid.step(dt).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
        let mut reaction = SVector::zeros();
        for k in 0..solid.constraint_names().len() {
            reaction += solid.reaction(k, SVector::zeros()).0;
        }
        let residual = (solid.momentum() - before - reaction * dt).norm() / scale;
        momentum_residual = momentum_residual.max(residual);
        let points = solid.points();
        let mean: f64 = (0..points.len())
            .map(|p| points.position[p][0] - points.reference_position[p][0])
            .sum();
        if previous_time > 0.0 && previous * mean < 0.0 {
            let fraction = previous / (previous - mean);
            crossings.push(previous_time + fraction * (solid.time() - previous_time));
        }
        (previous_time, previous) = (solid.time(), mean);
        if solid.time() <= 3.0 * period {
            let now = solid.energy();
            energy = now.kinetic + now.strain;
            energy_deviation = energy_deviation.max((energy / start - 1.0).abs());
        }
    }
    assert!(crossings.len() >= 6, "{crossings:?}");
    Measured {
        frequency_error: 3.0 * period / crossings[5] - 1.0,
        energy_drift: energy / start - 1.0,
        energy_deviation,
        momentum_residual,
    }
}

fn check(name: &str, measured: &Measured) {
    let &Measured { frequency_error, energy_drift, energy_deviation, momentum_residual } = measured;
    println!(
        "{name}: frequency {:+.4} %, energy after 3 periods {:+.4} %, largest deviation {:.4} %, momentum {momentum_residual:.1e}",
        100.0 * frequency_error,
        100.0 * energy_drift,
        100.0 * energy_deviation,
    );
    assert!(frequency_error.abs() < 5e-4, "{name}: frequency off by {frequency_error}");
    assert!(energy_drift.abs() < 1e-3, "{name}: energy drifted by {energy_drift}");
    assert!(momentum_residual < 1e-12, "{name}: momentum residual {momentum_residual}");
}

#[test]
fn plane_strip_vibrates_in_its_first_mode() {
    check("2D, free sides", &vibrate(bar::<2>(0.1, 0.04, false)));
    check("2D, rollers", &vibrate(bar::<2>(0.1, 0.04, true)));
}

#[test]
fn solid_bar_vibrates_in_its_first_mode() {
    check("3D, free sides", &vibrate(bar::<3>(0.1, 0.04, false)));
    check("3D, rollers", &vibrate(bar::<3>(0.1, 0.04, true)));
}

/// At a tenth of the speed the strain is 0.1 % and the quadratic energy of the
/// stress is exact to that order, so the sum of energies must hold all the time.
#[test]
fn energy_of_a_small_vibration_is_constant() {
    let measured = vibrate(bar::<2>(0.01, 0.02, false));
    check("2D, small", &measured);
    assert!(measured.energy_deviation < 1e-3, "{}", measured.energy_deviation);
}
