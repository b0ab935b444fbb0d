//! The founding paper's verification: a concrete block pressed between plates
//! that hold its ends sideways, against finite elements; and the same block
//! confined on all sides, which has an exact answer.
//!
//! `reference/block_compression_sigma_zz.csv` holds σzz/(E ε0) averaged over the
//! grid cells of one octant: the static limit of uGIMP on this grid, and
//! converged finite elements.

use crate::lattice::{CONCRETE, at_rest, lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, Material, Solid};
use motion::Motion;
use nalgebra::SVector;

const H: f64 = 0.1;
const HEIGHT: f64 = 2.0;
/// End displacement: a ten-thousandth of a cell, because the fixed clamp plane
/// errs by displacement over cell width.
const PRESS: f64 = 1e-4 * H;

/// The block after 15 transit times of the P wave, pressed by [`PRESS`], and the
/// time step.
fn pressed_block(cells: [usize; 3], courant_number: f64, confined: bool) -> (Solid<3>, f64) {
    let transit = HEIGHT / CONCRETE.p_wave_speed();
    let duration = 10.0 * transit;
    let press = Motion::SmoothStart { velocity: -PRESS / duration, duration };
    let fixed = || Some(Motion::Fixed);
    let mut constraints = vec![
        planes("bottom", 2, f64::NEG_INFINITY, 0.0, [fixed(), fixed(), fixed()]),
        planes("top", 2, HEIGHT, f64::INFINITY, [fixed(), fixed(), Some(press)]),
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
        discretisation: Discretisation::default(),
    };
    let grid = cells.map(|n| n + 4);
    let parameters = parameters(H, SVector::repeat(-2.0 * H), grid, courant_number);
    let mut solid = Solid::new(parameters, vec![block], constraints).unwrap();
    let end = 15.0 * transit;
    let steps = (end / solid.stable_time_step().unwrap().value).ceil();
    for _ in 0..steps as usize {
        solid.step(end / steps).unwrap();
    }
    (solid, end / steps)
}

/// Cell averages of σzz/(E ε0), folded onto the octant of the reference.
fn octant(solid: &Solid<3>) -> Vec<f64> {
    let strain = PRESS / HEIGHT;
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
fn difference(
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

#[test]
fn end_clamped_block_agrees_with_finite_elements() {
    let (mut solid, dt) = pressed_block([10, 10, 20], 0.5, false);
    let rows: Vec<[f64; 2]> = include_str!("reference/block_compression_sigma_zz.csv")
        .lines()
        .skip(1)
        .map(|line| {
            let columns: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
            [columns[3], columns[4]]
        })
        .collect();
    let limit: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let fem: Vec<f64> = rows.iter().map(|row| row[1]).collect();
    let found = octant(&solid);
    let to_limit = difference(&found, &limit, |_, _, _| true);
    let all = difference(&found, &fem, |_, _, _| true);
    let no_edges = difference(&found, &fem, |i, j, k| k > 0 || (i > 0 && j > 0));
    let inside = difference(&found, &fem, |_, _, k| k > 0);
    let scale = CONCRETE.young_modulus * PRESS / HEIGHT;
    let reactions = solid.current_reactions(dt).unwrap();
    let (bottom, top) = (reactions[0].force[2] / scale, -reactions[1].force[2] / scale);
    // Their difference is the rate of momentum of the waves still under way, their
    // mean the static reaction.
    let reaction = 0.5 * (bottom + top);
    println!(
        "against the uGIMP limit {:.4} %; against FEM {:.4} / {:.4} / {:.4} % (all, without end edges, without end layers); reaction {reaction:.6} ({:+.4} % off 1.0127638), {top:.6} top, {bottom:.6} bottom",
        100.0 * to_limit,
        100.0 * all,
        100.0 * no_edges,
        100.0 * inside,
        100.0 * (reaction / 1.012_763_8 - 1.0),
    );
    assert!(to_limit < 5e-4, "{to_limit}");
    assert!(all < 5e-3, "{all}");
    assert!(no_edges < 4e-3, "{no_edges}");
    assert!(inside < 3e-3, "{inside}");
    assert!((reaction / 1.012_763_8 - 1.0).abs() < 1e-3, "{reaction}");
    assert!((top / bottom - 1.0).abs() < 1e-3, "{top} {bottom}");
}

#[test]
fn confined_block_has_the_p_wave_modulus() {
    let (solid, _) = pressed_block([2, 2, 20], 0.5, true);
    let exact = -CONCRETE.p_wave_modulus() * PRESS / HEIGHT;
    let worst =
        solid.points().stress.iter().map(|s| (s[2] / exact - 1.0).abs()).fold(0.0, f64::max);
    println!("confined block: largest relative difference of a point's σzz {worst:.2e}");
    assert!(worst < 2e-4, "{worst}");
}
