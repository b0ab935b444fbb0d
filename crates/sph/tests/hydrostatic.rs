//! Still water in a tank: pressure, rest, weight.

#![allow(clippy::unwrap_used)]

mod tank;

use nalgebra::SVector;
use sph::{BoundarySet, Dissipation, Fluid, FluidParameters};

type V2 = SVector<f64, 2>;

fn still_tank(cells: f64, dissipation: Dissipation) -> Fluid<2> {
    let g = 9.81_f64;
    let parameters = FluidParameters {
        gravity: V2::new(0.0, -g),
        dissipation,
        domain: (V2::repeat(-0.5), V2::new(1.5, 2.0)),
        ..FluidParameters::water(1.0 / cells, 10.0 * g.sqrt())
    };
    let seeds = tank::still_water(V2::zeros(), V2::repeat(1.0), &parameters);
    let points = tank::tank(V2::zeros(), V2::new(1.0, 1.3), 1.0 / cells);
    Fluid::new(parameters, seeds, vec![tank::wall("tank", points)]).unwrap()
}

#[test]
fn five_seconds_of_rest() {
    let weight = 9810.0; // ρ g H, and the weight per metre of width
    for (cells, dissipation) in [
        (20.0, Dissipation::Artificial { alpha: 0.02 }),
        (40.0, Dissipation::Artificial { alpha: 0.02 }),
        (20.0, Dissipation::Riemann { limiter: 3.0 }),
    ] {
        let mut fluid = still_tank(cells, dissipation);
        let (mut pressure, mut force, mut count, mut worst) = (0.0, 0.0, 0.0, 0.0_f64);
        while fluid.time() < 5.0 {
            let dt = fluid.stable_time_step().unwrap().value;
            fluid.step(dt).unwrap();
            if fluid.time() > 4.0 {
                let p = fluid.sample(&V2::new(0.5, 0.0)).pressure / weight;
                pressure += p;
                force -= fluid.wall_force(0, &V2::zeros()).0[1] / weight;
                count += 1.0;
                worst = worst.max((p - 1.0).abs());
            }
        }
        let (pressure, force) = (pressure / count, force / count);
        let kinetic = fluid.energy().kinetic / weight;
        let level = fluid.water_level(&V2::new(0.5, 0.0), &V2::new(0.5, 1.3));
        eprintln!(
            "H/dx {cells} {dissipation:?}: mean bottom pressure {pressure:.4}, worst deviation \
             {worst:.4}, wall force {force:.5}, kinetic energy {kinetic:.2e}, level {level:.4}, \
             energy residual {:.2e}",
            fluid.energy_residual() / weight
        );
        assert!((pressure - 1.0).abs() < 0.01, "bottom pressure {pressure}");
        assert!(kinetic < 1e-4, "kinetic energy {kinetic}");
        assert!((force - 1.0).abs() < 2e-3, "wall force {force}");
        assert!((level - 0.995).abs() < 0.5 / cells, "water level {level}");
        assert!(fluid.energy_residual().abs() < 1e-5 * weight);
        assert_eq!(fluid.ledger().removed.count, 0);
    }
}

#[test]
fn gathered_wall_load_is_minus_the_force_on_the_fluid() {
    let mut fluid = still_tank(20.0, Dissipation::Artificial { alpha: 0.02 });
    for _ in 0..20 {
        fluid.step(1e-3).unwrap();
        fluid.evaluate_boundary_force(BoundarySet::Walls);
        let loads: V2 = fluid.walls().force.iter().sum();
        let scale: f64 = fluid.walls().force.iter().map(|f| f.norm()).sum();
        assert!((loads + fluid.force_from_walls()).norm() < 1e-13 * scale);
        let (gauge, _) = fluid.wall_force(0, &V2::zeros());
        assert!((loads - gauge).norm() < 1e-13 * scale);
    }
    let ledger = fluid.ledger();
    let change = fluid.momentum() - ledger.gravity_impulse - ledger.wall_impulse;
    assert!(change.norm() < 1e-12 * ledger.gravity_impulse.norm());
}
