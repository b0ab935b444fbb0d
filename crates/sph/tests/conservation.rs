//! Invariants of a fluid without walls.

#![allow(clippy::unwrap_used)]

mod tank;

use nalgebra::SVector;
use proptest::prelude::*;
use sph::{Dissipation, Fluid, FluidParameters, FluidSeed};

type V2 = SVector<f64, 2>;

const SPACING: f64 = 0.1;

fn parameters(
    dissipation: Dissipation,
    gravity: f64,
    density_diffusion: f64,
) -> FluidParameters<2> {
    FluidParameters {
        gravity: V2::new(0.0, -gravity),
        dissipation,
        density_diffusion,
        domain: (V2::repeat(-20.0), V2::repeat(20.0)),
        ..FluidParameters::water(SPACING, 20.0)
    }
}

/// A square blob whose particles get the velocities and pressures of `noise` in turn.
fn blob(noise: &[(f64, f64, f64)]) -> Vec<FluidSeed<2>> {
    tank::fill(V2::repeat(-0.5), V2::repeat(0.5), SPACING)
        .into_iter()
        .zip(noise.iter().cycle())
        .map(|(position, &(u, v, density_deviation))| FluidSeed {
            position,
            velocity: V2::new(u, v),
            density_deviation,
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn momentum_is_conserved_to_round_off(
        noise in prop::collection::vec((-0.5..0.5, -0.5..0.5, -2.0..2.0_f64), 7..30),
        model in 0..3,
    ) {
        let dissipation = [
            Dissipation::None,
            Dissipation::Artificial { alpha: 0.05 },
            Dissipation::Riemann { limiter: 3.0 },
        ][model as usize];
        let mut fluid: Fluid<2> =
            Fluid::new(parameters(dissipation, 0.0, 0.1), blob(&noise), vec![]).unwrap();
        let start = fluid.momentum();
        for _ in 0..100 {
            let dt = fluid.stable_time_step().unwrap().value;
            fluid.step(dt).unwrap();
        }
        let scale = fluid.total_mass();
        prop_assert!((fluid.momentum() - start).norm() < 1e-13 * scale);
        prop_assert!(fluid.ledger().viscous_loss >= -1e-12);
    }

    #[test]
    fn a_pair_of_particles_feels_opposite_forces(
        offset in (0.01..0.2_f64, 0.0..6.0_f64),
        a in (-1.0..1.0, -1.0..1.0, -20.0..20.0_f64),
        b in (-1.0..1.0, -1.0..1.0, -20.0..20.0_f64),
    ) {
        let seed = |position, (u, v, density_deviation)| FluidSeed {
            position,
            velocity: V2::new(u, v),
            density_deviation,
        };
        let second = V2::new(offset.1.cos(), offset.1.sin()) * offset.0;
        let pair = vec![seed(V2::zeros(), a), seed(second, b)];
        let model = Dissipation::Riemann { limiter: 3.0 };
        let mut fluid: Fluid<2> = Fluid::new(parameters(model, 0.0, 0.1), pair, vec![]).unwrap();
        fluid.drift_to_midpoint(1e-9).unwrap();
        fluid.evaluate_acceleration();
        let acceleration = &fluid.particles().acceleration;
        let residual = (acceleration[0] + acceleration[1]).norm();
        prop_assert!(residual <= 1e-15 * acceleration[0].norm());
    }
}

#[test]
fn free_fall_is_exact() {
    // Without density diffusion: its hydrostatic term (S3) assumes supported water.
    let velocity = V2::new(0.3, 1.0);
    let seeds = blob(&[(velocity[0], velocity[1], 0.0)]);
    let start: Vec<V2> = seeds.iter().map(|seed| seed.position).collect();
    let model = Dissipation::Artificial { alpha: 0.02 };
    let mut fluid: Fluid<2> = Fluid::new(parameters(model, 9.81, 0.0), seeds, vec![]).unwrap();
    for _ in 0..300 {
        let dt = fluid.stable_time_step().unwrap().value;
        fluid.step(dt).unwrap();
    }
    let t = fluid.time();
    let fall = velocity * t + V2::new(0.0, -0.5 * 9.81 * t * t);
    let particles = fluid.particles();
    for (x, &id) in particles.position.iter().zip(&particles.id) {
        assert!((x - start[id as usize] - fall).norm() < 1e-11);
    }
    assert!(fluid.energy_residual().abs() < 1e-11 * fluid.energy().kinetic);
}

#[test]
fn energy_residual_is_first_order_in_the_step() {
    // A blob squeezed by opposing velocities: u = -x, v = y, strong compression waves.
    let run = |courant_number: f64| {
        let seeds = tank::fill(V2::repeat(-0.5), V2::repeat(0.5), SPACING / 2.0)
            .into_iter()
            .map(|position| FluidSeed {
                position,
                velocity: V2::new(-2.0 * position[0], 2.0 * position[1]),
                density_deviation: 0.0,
            })
            .collect();
        let parameters =
            FluidParameters { courant_number, ..FluidParameters::<2>::water(SPACING / 2.0, 20.0) };
        let mut fluid: Fluid<2> = Fluid::new(parameters, seeds, vec![]).unwrap();
        let start = fluid.energy().total();
        while fluid.time() < 0.2 {
            let dt = fluid.stable_time_step().unwrap().value;
            fluid.step(dt).unwrap();
        }
        (fluid.energy_residual() / start, fluid.ledger().losses() / start)
    };
    let (coarse, loss) = run(0.6);
    let (fine, _) = run(0.15);
    eprintln!("energy residual {coarse:.3e} at C 0.6, {fine:.3e} at C 0.15; losses {loss:.3e}");
    assert!(coarse.abs() < 5e-3 && fine.abs() < 0.4 * coarse.abs());
}

#[test]
fn leavers_are_counted_with_mass_momentum_and_energy() {
    let mut parameters = parameters(Dissipation::None, 0.0, 0.0);
    parameters.domain = (V2::repeat(-1.0), V2::repeat(1.0));
    let moving = FluidSeed { velocity: V2::new(1.0, 0.0), ..FluidSeed::default() };
    let resting = FluidSeed { position: V2::new(-0.5, 0.0), ..FluidSeed::default() };
    let mut fluid: Fluid<2> = Fluid::new(parameters, vec![moving, resting], vec![]).unwrap();
    while fluid.time() < 1.1 {
        fluid.step(0.004).unwrap();
    }
    let removed = fluid.ledger().removed;
    let mass = fluid.particle_mass();
    assert_eq!((removed.count, fluid.particles().len()), (1, 1));
    assert!((removed.mass - mass).abs() < 1e-12);
    assert!((removed.momentum - V2::new(mass, 0.0)).norm() < 1e-12);
    assert!((removed.energy - 0.5 * mass).abs() < 1e-12);
    assert!(fluid.energy_residual().abs() < 1e-12);
}
