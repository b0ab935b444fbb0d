//! The founding paper's block, pressed between plates that hold its ends sideways,
//! and its comparison with references.
//!
//! `reference/block_compression_sigma_zz.csv` holds σzz/(E ε0) averaged over the
//! grid cells of one octant, both at small strain.

use crate::lattice::{CONCRETE, at_rest, lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, Material, Solid};
use motion::Motion;
use nalgebra::SVector;

/// Cell width (m).
pub const H: f64 = 0.1;
/// Height of the block (m).
pub const HEIGHT: f64 = 2.0;

/// The block after 15 transit times of the P wave, pressed by `press` (m), and the
/// time step.
pub fn pressed_block(
    cells: [usize; 3],
    press: f64,
    confined: bool,
    discretisation: Discretisation,
) -> (Solid<3>, f64) {
    let transit = HEIGHT / CONCRETE.p_wave_speed();
    let duration = 10.0 * transit;
    let moved = Motion::SmoothStart { velocity: -press / duration, duration };
    let fixed = || Some(Motion::Fixed);
    let mut constraints = vec![
        planes("bottom", 2, f64::NEG_INFINITY, 0.0, [fixed(), fixed(), fixed()]),
        planes("top", 2, HEIGHT, f64::INFINITY, [fixed(), fixed(), Some(moved)]),
    ];
    if confined {
        constraints.insert(
            0,
            planes("sides", 2, f64::NEG_INFINITY, f64::INFINITY, [fixed(), fixed(), None]),
        );
    }
    let block = BodySeed {
        name: "block".into(),
        material: CONCRETE.into(),
        points: lattice(SVector::zeros(), cells.map(|n| 2 * n), 0.5 * H),
        velocity: at_rest(),
        point_spacing: 0.5 * H,
        discretisation,
    };
    let grid = cells.map(|n| n + 4);
    let parameters = parameters(H, SVector::repeat(-2.0 * H), grid, 0.5);
    let mut solid = Solid::new(parameters, vec![block], constraints).unwrap();
    let end = 15.0 * transit;
    let steps = (end / solid.stable_time_step().unwrap().value).ceil();
    for _ in 0..steps as usize {
        solid.step(end / steps).unwrap();
    }
    (solid, end / steps)
}

/// The static limit of uGIMP on this grid, and converged finite elements.
pub fn references() -> (Vec<f64>, Vec<f64>) {
    let column = |k: usize| {
        let rows = include_str!("reference/block_compression_sigma_zz.csv").lines().skip(1);
        rows.map(|line| line.split(',').nth(k).unwrap().parse().unwrap()).collect()
    };
    (column(3), column(4))
}

/// Cell averages of σzz/(E ε0), folded onto the octant of the reference.
pub fn octant(solid: &Solid<3>, strain: f64) -> Vec<f64> {
    let mut sum = vec![0.0; 250];
    let points = solid.points();
    for p in 0..points.len() {
        let cell: [usize; 3] =
            std::array::from_fn(|d| (points.reference_position[p][d] / H) as usize);
        let [i, j, k] =
            [cell[0].min(9 - cell[0]), cell[1].min(9 - cell[1]), cell[2].min(19 - cell[2])];
        sum[(i * 5 + j) * 10 + k] += points.stress[p][2] / (CONCRETE.young_modulus * strain) / 64.0;
    }
    sum
}

/// Relative L2 difference over the cells that `chosen` selects.
pub fn difference(
    found: &[f64],
    reference: &[f64],
    chosen: impl Fn(usize, usize, usize) -> bool,
) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    for (cell, (a, b)) in found.iter().zip(reference).enumerate() {
        if chosen(cell / 50, cell / 10 % 5, cell % 10) {
            error += (a - b) * (a - b);
            norm += b * b;
        }
    }
    f64::sqrt(error / norm)
}
