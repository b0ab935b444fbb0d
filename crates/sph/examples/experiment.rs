#[path = "../tests/tank/mod.rs"]
mod tank;
use nalgebra::SVector;
use sph::*;
use std::time::Instant;
fn arg(n: usize, d: f64) -> f64 {
    std::env::args().nth(n).map_or(d, |s| s.parse().unwrap())
}
fn diss(kind: f64, val: f64) -> Dissipation {
    if kind == 0.0 {
        Dissipation::None
    } else if kind == 1.0 {
        Dissipation::Artificial { alpha: val }
    } else {
        Dissipation::Riemann { limiter: val }
    }
}
fn main() {
    match std::env::args().nth(1).unwrap().as_str() {
        "hydro" => hydro(),
        "dam" => dam(),
        "speed" => speed(),
        _ => {}
    }
}
fn hydro() {
    let n = arg(2, 20.0);
    let cfl = arg(3, 0.6);
    let d = diss(arg(4, 1.0), arg(5, 0.02));
    let delta = arg(6, 0.1);
    let end = arg(7, 5.0);
    let dx = 1.0 / n;
    let g = 9.81;
    let c0 = 10.0 * (g * 1.0_f64).sqrt();
    let p = FluidParameters {
        gravity: SVector::from([0.0, -g]),
        courant_number: cfl,
        dissipation: d,
        density_diffusion: delta,
        domain: (SVector::from([-0.5, -0.5]), SVector::from([1.5, 3.0])),
        ..FluidParameters::water(dx, c0)
    };
    let seeds = tank::still_water(SVector::from([0.0, 0.0]), SVector::from([1.0, 1.0]), &p);
    let walls = vec![tank::wall(
        "tank",
        tank::tank(SVector::from([0.0, 0.0]), SVector::from([1.0, 1.4]), dx),
    )];
    let count = seeds.len();
    let mut f: Fluid<2> = Fluid::new(p, seeds, walls).unwrap();
    let t0 = Instant::now();
    let mut next = 0.0;
    let (mut sum, mut m, mut lo, mut hi) = (0.0, 0.0, 9e9_f64, -9e9_f64);
    let weight = 1000.0 * g * 1.0;
    while f.time() < end {
        let l = f.stable_time_step().unwrap();
        f.step(l.value).unwrap();
        let s = f.sample(&SVector::from([0.5, 0.0]));
        if f.time() > end - 1.0 {
            sum += s.pressure;
            m += 1.0;
            lo = lo.min(s.pressure);
            hi = hi.max(s.pressure);
        }
        if f.time() >= next {
            next += 0.5;
            let e = f.energy();
            let led = f.ledger();
            let (wf, mo) = f.wall_force(0, &SVector::from([0.5, 0.0]));
            println!(
                "t {:.2} p/rgH {:.5} fill {:.3} Ek/ {:.3e} lvl {:.4} wf {:.5} {:.1e} mom {:.1e} dE {:.4e} visc {:.3e} imp {:.3e} off {:.3e} diff {:.3e} work {:.3e} resid {:.3e} [{} {:.2e}]",
                f.time(),
                s.pressure / weight,
                s.filling,
                e.kinetic / weight,
                f.water_level(&SVector::from([0.5, 0.0]), &SVector::from([0.5, 1.4])),
                wf[1] / -weight,
                wf[0] / weight,
                mo[2] / weight,
                (e.total()) / weight,
                led.viscous_loss / weight,
                led.impact_loss / weight,
                led.offset_loss / weight,
                led.diffusion_loss / weight,
                led.wall_work / weight,
                f.energy_residual() / weight,
                l.term,
                l.value
            );
        }
    }
    let bins = 10;
    let mut acc = vec![(0.0, 0.0, 0.0, 0.0); bins];
    for i in 0..f.particles().len() {
        let x = f.particles().position[i];
        let b = ((x[1] * bins as f64) as usize).min(bins - 1);
        acc[b].0 += 1.0;
        acc[b].1 += f.pressure(i) / weight;
        acc[b].2 += x[1];
        acc[b].3 += f.particles().density_deviation[i];
    }
    for b in &acc {
        println!(
            "  y {:.4} p {:.5} excess {:.5} count {}",
            b.2 / b.0,
            b.1 / b.0,
            b.1 / b.0 - 1.0 + b.2 / b.0,
            b.0
        );
    }
    println!(
        "mean last second {:.5} range {:.5}..{:.5} removed {} rate {:.0}/s",
        sum / m / weight,
        lo / weight,
        hi / weight,
        f.ledger().removed.count,
        count as f64 * f.steps() as f64 / t0.elapsed().as_secs_f64()
    );
}
fn dam() {
    let n = arg(2, 40.0);
    let cfl = arg(3, 0.6);
    let d = diss(arg(4, 1.0), arg(5, 0.02));
    let delta = arg(6, 0.1);
    let cf = arg(7, 10.0);
    let end = arg(8, 4.2);
    let len = arg(9, 8.0);
    let g = 9.81;
    let a = 0.1;
    let h = 2.0 * a;
    let dx = h / n;
    let c0 = cf * (g * h).sqrt();
    let p = FluidParameters {
        gravity: SVector::from([0.0, -g]),
        courant_number: cfl,
        dissipation: d,
        density_diffusion: delta,
        domain: (SVector::from([-0.1, -0.1]), SVector::from([len * a + 0.1, 1.0])),
        ..FluidParameters::water(dx, c0)
    };
    let seeds = tank::still_water(SVector::from([0.0, 0.0]), SVector::from([a, h]), &p);
    let top = (3.0 * a / dx).round() * dx;
    let walls = vec![tank::wall(
        "tank",
        tank::tank(SVector::from([0.0, 0.0]), SVector::from([len * a, top]), dx),
    )];
    let count = seeds.len();
    let mut f: Fluid<2> = Fluid::new(p, seeds, walls).unwrap();
    let t0 = Instant::now();
    let mut next = 0.0;
    let scale = (2.0 * g / a).sqrt();
    let e0 = f.energy().total();
    let unit = 1000.0 * g * h * a * h / 2.0;
    while f.time() * scale < end {
        let l = f.stable_time_step().unwrap();
        f.step(l.value).unwrap();
        if f.time() * scale >= next {
            next += 0.25;
            let e = f.energy();
            let led = f.ledger();

            let minp = (0..f.particles().len()).map(|i| f.pressure(i)).fold(0.0, f64::min);
            let maxp = (0..f.particles().len()).map(|i| f.pressure(i)).fold(0.0, f64::max);
            println!(
                "T {:.3} Z {:.4} H {:.4} Ek {:.4} dE {:.4e} visc {:.3e} imp {:.3e} off {:.3e} diff {:.3e} work {:.1e} resid {:.3e} p {:.3} {:.3} removed {} [{} {:.2e}]",
                f.time() * scale,
                f.front(&SVector::from([1.0, 0.0])) / a,
                f.water_level(&SVector::from([0.01, 0.0]), &SVector::from([0.01, 0.25])) / h,
                e.kinetic / unit,
                (e.total() - e0) / unit,
                led.viscous_loss / unit,
                led.impact_loss / unit,
                led.offset_loss / unit,
                led.diffusion_loss / unit,
                led.wall_work / unit,
                f.energy_residual() / unit,
                minp / (1000.0 * g * h),
                maxp / (1000.0 * g * h),
                led.removed.count,
                l.term,
                l.value
            );
        }
    }
    println!(
        "rate {:.0}/s steps {}",
        count as f64 * f.steps() as f64 / t0.elapsed().as_secs_f64(),
        f.steps()
    );
}
fn speed() {
    let n = arg(2, 30.0);
    let dx = 1.0 / n;
    let g = 9.81;
    let c0 = 10.0 * (g * 1.0_f64).sqrt();
    let p = FluidParameters {
        gravity: SVector::from([0.0, 0.0, -g]),
        domain: (SVector::from([-0.5, -0.5, -0.5]), SVector::from([1.5, 1.5, 3.0])),
        ..FluidParameters::water(dx, c0)
    };
    let seeds =
        tank::still_water(SVector::from([0.0, 0.0, 0.0]), SVector::from([1.0, 1.0, 1.0]), &p);
    let walls = vec![tank::wall(
        "tank",
        tank::tank(SVector::from([0.0, 0.0, 0.0]), SVector::from([1.0, 1.0, 1.4]), dx),
    )];
    let count = seeds.len();
    let mut f: Fluid<3> = Fluid::new(p, seeds, walls).unwrap();
    println!("{} particles {} walls", count, f.walls().len());
    for phase in 0..2 {
        let t0 = Instant::now();
        let s0 = f.steps();
        for _ in 0..10 {
            let dt = f.stable_time_step().unwrap().value;
            f.step(dt).unwrap();
        }
        println!(
            "{phase} rate {:.0}/s",
            count as f64 * (f.steps() - s0) as f64 / t0.elapsed().as_secs_f64()
        );
    }
    let _ = BoundarySet::Walls;
}
