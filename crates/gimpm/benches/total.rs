//! Cost of a step in the total Lagrangian frame, in CPU time.
//!
//! `cargo bench -p gimpm --bench total -- [part of a case's name]`

use std::time::Instant;

use gimpm::{
    BodySeed, Discretisation, Frame, InitialVelocity, LinearElastic, Loops, MaterialModel,
    NeoHookean, Solid, SolidError, SolidParameters, StressUpdate,
};
use nalgebra::SVector;

const SPACING: f64 = 0.1;

/// CPU time of the process (s), from Linux' scheduler.
fn cpu_time() -> f64 {
    let Ok(threads) = std::fs::read_dir("/proc/self/task") else { return f64::NAN };
    let nanoseconds = threads.flatten().filter_map(|thread| {
        let statistics = std::fs::read_to_string(thread.path().join("schedstat")).ok()?;
        statistics.split_whitespace().next()?.parse::<f64>().ok()
    });
    1e-9 * nanoseconds.sum::<f64>()
}

/// A free block with a rough velocity.
fn block<const D: usize>(
    cells: [usize; D],
    material: MaterialModel,
    loops: Loops,
    mean_dilatation: bool,
) -> Result<Solid<D>, SolidError> {
    let counts = cells.map(|n| 2 * n);
    let points: Vec<SVector<f64, D>> = (0..counts.iter().product())
        .map(|mut k: usize| {
            SVector::from_fn(|d, _| {
                let along = k % counts[d];
                k /= counts[d];
                0.5 * SPACING * (along as f64 + 0.5)
            })
        })
        .collect();
    let velocity = points.iter().map(|x| x.map(|along| 1e-3 * (37.0 * along).sin())).collect();
    let body = BodySeed {
        name: "block".into(),
        material,
        points,
        velocity: InitialVelocity::PerPoint(velocity),
        point_spacing: 0.5 * SPACING,
        discretisation: Discretisation {
            frame: Frame::Total,
            mean_dilatation,
            ..Discretisation::default()
        },
    };
    let parameters = SolidParameters {
        gravity: SVector::zeros(),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops,
        contact: None,
        relaxation: None,
        courant_number: 0.5,
        grid_spacing: SPACING,
        grid_origin: SVector::zeros(),
        grid_cells: cells,
        damping: 0.0,
    };
    Solid::new(parameters, vec![body], Vec::new())
}

/// Least CPU and wall time of a step over its points (s).
fn measure<const D: usize>(mut solid: Solid<D>, steps: usize) -> Result<(f64, f64), SolidError> {
    let dt = solid.stable_time_step()?.value;
    solid.step(dt)?;
    let (mut least_cpu, mut least_wall) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..5 {
        let (cpu, wall) = (cpu_time(), Instant::now());
        for _ in 0..steps {
            solid.step(dt)?;
        }
        let scale = 1.0 / (steps * solid.points().len()) as f64;
        least_cpu = f64::min(least_cpu, (cpu_time() - cpu) * scale);
        least_wall = f64::min(least_wall, wall.elapsed().as_secs_f64() * scale);
    }
    Ok((least_cpu, least_wall))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let elastic = LinearElastic { density: 2400.0, young_modulus: 3.0e10, poisson_ratio: 0.2 };
    let rubber = NeoHookean { density: 1000.0, young_modulus: 1.0e7, poisson_ratio: 0.45 };
    let cells = [40, 40, 78];
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        let report = |name: &str, (cpu, wall): (f64, f64)| {
            println!(
                "{threads} thread(s), {name}: {:.2} M point-steps per CPU-second, {:.2} per second",
                1e-6 / cpu,
                1e-6 / wall
            );
        };
        let wanted = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
        let wanted = |name: &str| wanted.as_ref().is_none_or(|part| name.contains(part.as_str()));
        pool.install(|| -> Result<(), SolidError> {
            let fast = |material: MaterialModel, mean| block(cells, material, Loops::Fast, mean);
            let name = "3D linear elastic";
            if wanted(name) {
                report(name, measure(fast(elastic.into(), false)?, 10)?);
            }
            let name = "3D neo-Hookean";
            if wanted(name) {
                report(name, measure(fast(rubber.into(), false)?, 10)?);
            }
            let name = "3D mean dilatation, linear elastic";
            if wanted(name) {
                report(name, measure(fast(elastic.into(), true)?, 10)?);
            }
            let name = "2D linear elastic";
            if wanted(name) {
                let plane = block([500, 500], elastic.into(), Loops::Fast, false)?;
                report(name, measure(plane, 10)?);
            }
            let name = "3D plain loops, linear elastic";
            if wanted(name) && threads == 1 {
                let plain = block(cells, elastic.into(), Loops::Plain, false)?;
                report(name, measure(plain, 2)?);
            }
            Ok(())
        })?;
    }
    Ok(())
}
