//! Cost of each shape and transfer per material-point step, relative to FLIP with
//! uGIMP weights in the plain loops: a block of 27,000 points in free flight, one thread.
//!
//! `cargo bench -p gimpm --bench options`

use std::time::Instant;

use gimpm::{
    BodySeed, Discretisation, Frame, InitialVelocity, LinearElastic, Loops, Shape, Solid,
    SolidError, SolidParameters, StressUpdate, Transfer,
};
use nalgebra::{SMatrix, SVector};

const STEPS: u32 = 5;

/// A block of points, two a cell and axis, a little off the lattice unless it may not be.
fn block<const D: usize>(
    discretisation: Discretisation,
    loops: Loops,
    along: usize,
) -> Result<Solid<D>, SolidError> {
    let shift = if discretisation.frame == Frame::Total { 0.0 } else { 0.3 };
    let points = (0..along.pow(D as u32))
        .map(|k| {
            SVector::from_fn(|d, _| {
                let lattice = (k / along.pow(d as u32) % along) as f64;
                0.05 * (lattice + 0.5 + shift * ((k * 37 % 101) as f64) / 101.0)
            })
        })
        .collect();
    let body = BodySeed {
        name: "block".into(),
        material: LinearElastic { density: 2400.0, young_modulus: 3.0e10, poisson_ratio: 0.2 }
            .into(),
        points,
        velocity: InitialVelocity::Affine {
            gradient: SMatrix::from_fn(|i, j| if i < j { 10.0 } else { 0.0 }),
            centre: SVector::zeros(),
        },
        point_spacing: 0.05,
        discretisation,
    };
    let parameters = SolidParameters {
        gravity: SVector::zeros(),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops,
        contact: None,
        relaxation: None,
        courant_number: 0.5,
        grid_spacing: 0.1,
        grid_origin: SVector::repeat(-0.2),
        grid_cells: [along / 2 + 6; D],
        damping: 0.0,
    };
    Solid::new(parameters, vec![body], Vec::new())
}

/// Microseconds per point and step, best of five.
fn cost<const D: usize>(
    discretisation: Discretisation,
    loops: Loops,
    along: usize,
) -> Result<f64, SolidError> {
    let mut solid = block::<D>(discretisation, loops, along)?;
    let dt = solid.stable_time_step()?.value;
    solid.step(dt)?;
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        for _ in 0..STEPS {
            solid.step(dt)?;
        }
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(1e6 * best / f64::from(STEPS) / solid.points().len() as f64)
}

fn main() -> Result<(), SolidError> {
    let mut rows = Vec::new();
    rows.push((Loops::Fast, Discretisation::default()));
    for shape in [Shape::Ugimp, Shape::Linear, Shape::Cpgimp, Shape::Cpdi] {
        rows.push((Loops::Plain, Discretisation { shape, ..Default::default() }));
    }
    for transfer in [
        Transfer::Apic,
        Transfer::Tpic,
        Transfer::Fmpm { order: 1 },
        Transfer::Fmpm { order: 2 },
        Transfer::Fmpm { order: 4 },
    ] {
        rows.push((Loops::Plain, Discretisation { transfer, ..Default::default() }));
    }
    let frame = Frame::Total;
    rows.push((Loops::Plain, Discretisation { frame, ..Default::default() }));
    rows.push((
        Loops::Plain,
        Discretisation { frame, transfer: Transfer::Apic, ..Default::default() },
    ));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let Ok(pool) = pool else { return Ok(()) };
    pool.install(|| {
        let plain = Discretisation::default();
        let plane = cost::<2>(plain, Loops::Plain, 160)?;
        let space = cost::<3>(plain, Loops::Plain, 30)?;
        println!("plain FLIP uGIMP: 2D {plane:.2} µs, 3D {space:.2} µs per point and step");
        for (loops, chosen) in rows {
            let plane = cost::<2>(chosen, loops, 160)? / plane;
            let space = cost::<3>(chosen, loops, 30)? / space;
            let Discretisation { frame, shape, transfer, .. } = chosen;
            println!("{loops:?} {frame:?} {shape:?} {transfer:?}: 2D {plane:.2}, 3D {space:.2}");
        }
        Ok(())
    })
}
