//! Points on a lattice, and boxes of nodes without end.

use gimpm::{
    Hold, InitialVelocity, LinearElastic, Loops, NodeConstraint, SolidParameters, StressUpdate,
};
use motion::Motion;
use nalgebra::SVector;

/// Centres of the cells of a lattice, x fastest.
pub fn lattice<const D: usize>(
    lower: SVector<f64, D>,
    counts: [usize; D],
    spacing: f64,
) -> Vec<SVector<f64, D>> {
    (0..counts.iter().product())
        .map(|mut k: usize| {
            SVector::from_fn(|d, _| {
                let along = k % counts[d];
                k /= counts[d];
                lower[d] + (along as f64 + 0.5) * spacing
            })
        })
        .collect()
}

/// Nodes with `lower <= x_axis <= upper`, any other coordinate.
pub fn planes<const D: usize>(
    name: &str,
    axis: usize,
    lower: f64,
    upper: f64,
    components: [Option<Motion>; D],
) -> NodeConstraint<D> {
    let mut low = SVector::repeat(f64::NEG_INFINITY);
    let mut high = SVector::repeat(f64::INFINITY);
    low[axis] = lower;
    high[axis] = upper;
    let hold = Hold::Components(components);
    NodeConstraint { name: name.into(), body: 0, lower: low, upper: high, hold }
}

/// uGIMP without gravity or damping.
pub fn parameters<const D: usize>(
    spacing: f64,
    origin: SVector<f64, D>,
    cells: [usize; D],
    courant_number: f64,
) -> SolidParameters<D> {
    SolidParameters {
        gravity: SVector::zeros(),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops: Loops::Fast,
        contact: None,
        relaxation: None,
        courant_number,
        grid_spacing: spacing,
        grid_origin: origin,
        grid_cells: cells,
        damping: 0.0,
    }
}

/// At rest.
pub fn at_rest<const D: usize>() -> InitialVelocity<D> {
    InitialVelocity::Uniform(SVector::zeros())
}

/// The concrete of the verification block.
pub const CONCRETE: LinearElastic =
    LinearElastic { density: 2400.0, young_modulus: 30.0e9, poisson_ratio: 0.2 };
