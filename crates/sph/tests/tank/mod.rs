//! Lattice-filled tanks for the tests.
#![allow(dead_code)] // each test binary uses a part

use nalgebra::SVector;
use sph::{FluidParameters, FluidSeed, WallSeed};

/// Layers of wall points: the kernel reaches `2h = 3 dx`, and pistons need one more.
pub const LAYERS: i64 = 4;

/// Cell centres of the lattice of spacing `dx` inside the box.
pub fn fill<const D: usize>(
    lower: SVector<f64, D>,
    upper: SVector<f64, D>,
    dx: f64,
) -> Vec<SVector<f64, D>> {
    let count: Vec<i64> = (0..D).map(|k| ((upper[k] - lower[k]) / dx).round() as i64).collect();
    let total = count.iter().product();
    (0..total)
        .map(|mut index| {
            SVector::from_fn(|k, _| {
                let i = index % count[k];
                index /= count[k];
                lower[k] + (i as f64 + 0.5) * dx
            })
        })
        .collect()
}

/// Walls around the box: every side but the top of the last axis.
pub fn tank<const D: usize>(
    lower: SVector<f64, D>,
    upper: SVector<f64, D>,
    dx: f64,
) -> Vec<SVector<f64, D>> {
    let margin = LAYERS as f64 * dx;
    let mut outer = upper.add_scalar(margin);
    outer[D - 1] = upper[D - 1];
    let mut points = fill(lower.add_scalar(-margin), outer, dx);
    points.retain(|x| !(0..D).all(|k| x[k] > lower[k] && x[k] < upper[k]));
    points
}

/// Water at rest between `lower` and `upper` with hydrostatic density.
pub fn still_water<const D: usize>(
    lower: SVector<f64, D>,
    upper: SVector<f64, D>,
    parameters: &FluidParameters<D>,
) -> Vec<FluidSeed<D>> {
    fill(lower, upper, parameters.spacing)
        .into_iter()
        .map(|x| FluidSeed::at_rest(parameters, x, lower[D - 1], upper[D - 1]))
        .collect()
}

/// A fixed wall.
pub fn wall<const D: usize>(name: &str, points: Vec<SVector<f64, D>>) -> WallSeed<D> {
    WallSeed { name: name.to_owned(), points, motion: None }
}
