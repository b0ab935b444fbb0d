//! The founding paper's verification: a concrete block pressed between plates
//! that hold its ends sideways, against finite elements; and the same block
//! confined on all sides, which has an exact answer.

use crate::lattice::CONCRETE;
use crate::pressed_block::{H, HEIGHT, difference, octant, pressed_block, references};
use gimpm::Discretisation;

/// End displacement: a ten-thousandth of a cell, because the fixed clamp plane
/// errs by displacement over cell width.
const PRESS: f64 = 1e-4 * H;

#[test]
fn end_clamped_block_agrees_with_finite_elements() {
    let (mut solid, dt) = pressed_block([10, 10, 20], PRESS, false, Discretisation::default());
    let (limit, fem) = references();
    let found = octant(&solid, PRESS / HEIGHT);
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
    let (solid, _) = pressed_block([2, 2, 20], PRESS, true, Discretisation::default());
    let exact = -CONCRETE.p_wave_modulus() * PRESS / HEIGHT;
    let worst =
        solid.points().stress.iter().map(|s| (s[2] / exact - 1.0).abs()).fold(0.0, f64::max);
    println!("confined block: largest relative difference of a point's σzz {worst:.2e}");
    assert!(worst < 2e-4, "{worst}");
}
