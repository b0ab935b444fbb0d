//! What a step costs: a block of a million linear elastic points in vibration, eight
//! points a cell, displaced by up to 0.15 cells from their lattice along every axis,
//! uniform GIMP weights, three dimensions.
//!
//! `cargo bench -p gimpm --bench step` (a smaller block: `-- --edge 60`).
//!
//! Speeds are point-steps per second of processor time of all threads of this process
//! (`/proc/self/task/*/schedstat`), the best of several repeats: other programs on the
//! machine then disturb little. The time on the clock is printed beside it.

use std::time::Instant;

use gimpm::{
    BodySeed, Discretisation, InitialVelocity, LinearElastic, Loops, Solid, SolidError,
    SolidParameters, StressUpdate,
};
use nalgebra::SVector;

const CELL: f64 = 0.1;
const REPEATS: usize = 7;

/// A number in -1 to 1 that looks random (splitmix64).
fn noise(k: u64) -> f64 {
    let mut z = k.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) as f64 / u64::MAX as f64 * 2.0 - 1.0
}

fn block(edge: u64, loops: Loops) -> Result<Solid<3>, SolidError> {
    let points: Vec<SVector<f64, 3>> = (0..edge.pow(3))
        .map(|k| {
            let lattice = [k % edge, k / edge % edge, k / (edge * edge)];
            SVector::from_fn(|d, _| {
                CELL * (0.5 * (lattice[d] as f64 + 0.5) + 0.15 * noise(3 * k + d as u64))
            })
        })
        .collect();
    let length = 0.5 * CELL * edge as f64;
    let wave = |x: &SVector<f64, 3>| x.map(|x| (std::f64::consts::TAU * x / length).sin());
    let body = BodySeed {
        name: "block".into(),
        material: LinearElastic { density: 2400.0, young_modulus: 3.0e10, poisson_ratio: 0.2 }
            .into(),
        velocity: InitialVelocity::PerPoint(points.iter().map(wave).collect()),
        points,
        point_spacing: 0.5 * CELL,
        discretisation: Discretisation::default(),
    };
    let parameters = SolidParameters {
        gravity: SVector::zeros(),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops,
        contact: None,
        relaxation: None,
        courant_number: 0.5,
        grid_spacing: CELL,
        grid_origin: SVector::repeat(-2.0 * CELL),
        grid_cells: [edge as usize / 2 + 4; 3],
        damping: 0.0,
    };
    Solid::new(parameters, vec![body], Vec::new())
}

/// Processor time of all threads so far (s).
fn processor_time() -> f64 {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let nanoseconds = |task: std::fs::DirEntry| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split_whitespace().next()?.parse::<f64>().ok()
    };
    tasks.filter_map(nanoseconds).sum::<f64>() * 1e-9
}

/// Resident memory of this process (B).
fn resident_memory() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|line| line.trim().split(' ').next()?.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) * 1024.0
}

/// What was measured, for one point.
struct Costs {
    /// Processor time in a step (s), the best of the repeats.
    processor: f64,
    /// Time on the clock in a step (s), the best of the repeats.
    clock: f64,
    /// Processor time in a sort (s).
    sort: f64,
    /// Memory of a solid that has been sorted, with its grid (B).
    memory: f64,
}

fn measure(edge: u64, loops: Loops, threads: usize, steps: usize) -> Result<Costs, SolidError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let run = || {
        let before = resident_memory();
        let mut solid = block(edge, loops)?;
        let dt = solid.stable_time_step()?.value;
        solid.step(dt)?;
        let points = solid.points().len() as f64;
        let memory = (resident_memory() - before) / points;
        let (mut processor, mut clock) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..REPEATS {
            let (start, started) = (processor_time(), Instant::now());
            for _ in 0..steps {
                solid.step(dt)?;
            }
            let count = steps as f64 * points;
            processor = processor.min((processor_time() - start) / count);
            clock = clock.min(started.elapsed().as_secs_f64() / count);
        }
        let start = processor_time();
        solid.sort_points();
        let sort = (processor_time() - start) / points;
        Ok(Costs { processor, clock, sort, memory })
    };
    match pool {
        Ok(pool) => pool.install(run),
        Err(_) => run(),
    }
}

fn main() -> Result<(), SolidError> {
    let arguments: Vec<String> = std::env::args().collect();
    let value = |name: &str| {
        let place = arguments.iter().position(|argument| argument == name)?;
        arguments.get(place + 1)?.parse::<u64>().ok()
    };
    let edge = value("--edge").unwrap_or(100);
    let only_fast = arguments.iter().any(|argument| argument == "--fast");
    println!("{} points, million point-steps per second:", edge.pow(3));
    println!("loops  threads  of processor time  on the clock");
    let report = |name: &str, threads: usize, costs: &Costs| {
        let [processor, clock] = [costs.processor, costs.clock].map(|time| 1e-6 / time);
        println!("{name:5}  {threads:7}  {processor:17.2}  {clock:12.2}");
    };
    let one = measure(edge, Loops::Fast, 1, 4)?;
    report("fast", 1, &one);
    println!("sort: {:.0} ns a point; memory: {:.0} B a point", 1e9 * one.sort, one.memory);
    if only_fast {
        return Ok(());
    }
    let two = measure(edge, Loops::Fast, 2, 4)?;
    report("fast", 2, &two);
    let plain = measure(edge, Loops::Plain, 1, 1)?;
    report("plain", 1, &plain);
    println!("fast over plain: {:.1}", plain.processor / one.processor);
    println!(
        "two threads: {:.2} times as fast on the clock, {:.3} times the processor time",
        one.clock / two.clock,
        two.processor / one.processor
    );
    Ok(())
}
