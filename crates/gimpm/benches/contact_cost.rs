//! Time of a step with and without contact: a block of 27,000 points that slides
//! on a slab of 36,000, in one shared velocity field and in two with contact.
//!
//! `cargo bench -p gimpm --bench contact_cost`

use std::time::Instant;

use gimpm::{
    BodySeed, Contact, Discretisation, InitialVelocity, LinearElastic, Loops, Solid,
    SolidParameters, StressUpdate,
};
use nalgebra::SVector;

fn block(name: &str, lower: [f64; 3], counts: [u32; 3], velocity: [f64; 3]) -> BodySeed<3> {
    let [nx, ny, nz] = counts;
    let points = (0..nx * ny * nz)
        .map(|k| {
            let lattice = [k % nx, k / nx % ny, k / (nx * ny)];
            SVector::from_fn(|d, _| lower[d] + 0.05 * (f64::from(lattice[d]) + 0.5))
        })
        .collect();
    BodySeed {
        name: name.into(),
        material: LinearElastic { density: 1000.0, young_modulus: 1e7, poisson_ratio: 0.3 }.into(),
        points,
        velocity: InitialVelocity::Uniform(SVector::from(velocity)),
        point_spacing: 0.05,
        discretisation: Discretisation::default(),
    }
}

fn scene(contact: Option<Contact>) -> Result<Solid<3>, gimpm::SolidError> {
    let parameters = SolidParameters {
        gravity: SVector::from([0.0, 0.0, -9.81]),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops: Loops::Fast,
        contact,
        relaxation: None,
        courant_number: 0.5,
        grid_spacing: 0.1,
        grid_origin: SVector::from([-0.2, -0.2, -0.6]),
        grid_cells: [34, 34, 24],
        damping: 0.0,
    };
    let slab = block("slab", [0.0, 0.0, -0.5], [60, 60, 10], [0.0; 3]);
    let slider = block("slider", [0.5, 0.5, 0.0], [30, 30, 30], [1.0, 0.5, -0.1]);
    Solid::new(parameters, vec![slab, slider], Vec::new())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        for (name, contact) in [("shared", None), ("contact", Some(Contact { friction: 0.3 }))] {
            let best = pool.install(|| -> Result<f64, gimpm::SolidError> {
                let mut solid = scene(contact)?;
                let mut best = f64::INFINITY;
                for _ in 0..6 {
                    let start = Instant::now();
                    for _ in 0..20 {
                        solid.step(solid.stable_time_step()?.value)?;
                    }
                    best = best.min(start.elapsed().as_secs_f64() / 20.0);
                }
                Ok(best)
            })?;
            println!("{threads} thread(s), {name}: {:.2} ms a step", best * 1e3);
        }
    }
    Ok(())
}
