//! Material-point steps per second on one thread and on all: a block of 64,000
//! points in free flight, slightly displaced so that points reach two or three
//! nodes an axis.
//!
//! `cargo run --release -p gimpm --example throughput`

use std::time::Instant;

use gimpm::{
    BodySeed, Discretisation, InitialVelocity, LinearElastic, Loops, Solid, SolidParameters,
    StressUpdate,
};
use nalgebra::SVector;

fn block() -> Result<Solid<3>, gimpm::SolidError> {
    let points = (0..64_000)
        .map(|k| {
            let lattice = [k % 40, k / 40 % 40, k / 1600];
            SVector::from(
                lattice
                    .map(|n| 0.05 * (f64::from(n) + 0.5 + 0.3 * f64::from(k * 37 % 101) / 101.0)),
            )
        })
        .collect();
    let body = BodySeed {
        name: "block".into(),
        material: LinearElastic { density: 2400.0, young_modulus: 3.0e10, poisson_ratio: 0.2 }
            .into(),
        points,
        velocity: InitialVelocity::Uniform(SVector::from([1.0, 2.0, 3.0])),
        point_spacing: 0.05,
        discretisation: Discretisation::default(),
    };
    let parameters = SolidParameters {
        gravity: SVector::zeros(),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops: Loops::Fast,
        courant_number: 0.5,
        grid_spacing: 0.1,
        grid_origin: SVector::repeat(-0.2),
        grid_cells: [24; 3],
        damping: 0.0,
    };
    Solid::new(parameters, vec![body], Vec::new())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for threads in [1, 0] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let best = pool.install(|| -> Result<f64, gimpm::SolidError> {
            let mut solid = block()?;
            let dt = solid.stable_time_step()?.value;
            let mut best: f64 = 0.0;
            for _ in 0..5 {
                let start = Instant::now();
                for _ in 0..20 {
                    solid.step(dt)?;
                }
                best = best.max(20.0 * 64_000.0 / start.elapsed().as_secs_f64());
            }
            Ok(best)
        })?;
        println!("{} thread(s): {:.2} M point-steps/s", pool.current_num_threads(), best * 1e-6);
    }
    Ok(())
}
