//! Momentum exchanged between fluid and solid, measured on each side by itself.
#![allow(clippy::unwrap_used)]

mod tank;

use coupling::{Coupled, CouplingParameters};
use nalgebra::vector;
use tank::{Block, Tank};

#[test]
fn free_block_in_a_tank_conserves_momentum_in_each_of_ten_thousand_steps() {
    // Inside a pool: the loops are small, and each would wake the pool from outside.
    rayon::ThreadPoolBuilder::new().build().unwrap().install(ten_thousand_steps);
}

fn ten_thousand_steps() {
    let tank = Tank { width: 0.5, depth: 0.3, spacing: 0.025 };
    // The block starts half immersed where the water leaves room for it.
    let block = Block { lower: vector![0.2, 0.2], upper: vector![0.3, 0.3], density: 500.0 };
    let fluid = tank.fluid(Some(&block));
    let solid = tank.solid(&block, 1.0e7, Vec::new());
    let parameters = CouplingParameters { mass_ratio: 2.0, ..CouplingParameters::default() };
    let mut coupled = Coupled::new(fluid, solid, parameters).unwrap();
    let mut touched = 0;
    for step in 0..10_000 {
        let dt = coupled.stable_time_step().unwrap().unwrap().value;
        coupled.step(dt).unwrap();
        let residual = coupled.ledger().momentum_residual;
        assert!(residual <= 1e-12, "step {step}: residual {residual:.2e}");
        touched += usize::from(coupled.interface().1.iter().any(|force| force.norm() > 0.0));
    }
    assert!(touched > 5_000, "the block touched the water in only {touched} steps");
    let largest = coupled.ledger().largest_momentum_residual;
    assert!(largest > 0.0, "a residual of exactly 0 would mean that nothing was measured");
}
