//! A driven piston, and a structure set from outside.

#![allow(clippy::unwrap_used)]

mod tank;

use motion::Motion;
use nalgebra::SVector;
use sph::{BoundarySet, Fluid, FluidError, FluidParameters, WallMotion};

type V2 = SVector<f64, 2>;

/// Closed box compressed by a piston: relative errors of pressure and of work against
/// isentropic compression.
fn compress(dx: f64) -> (f64, f64) {
    let (length, c0) = (1.0, 50.0);
    let parameters = FluidParameters {
        domain: (V2::repeat(-0.5), V2::repeat(1.5)),
        ..FluidParameters::water(dx, c0)
    };
    let corner = V2::new(length, 0.5);
    let seeds = tank::still_water(V2::zeros(), corner, &parameters);
    let outer = tank::fill(V2::repeat(-4.0 * dx), corner.add_scalar(4.0 * dx), dx);
    let outside = |x: &V2| !(x[0] > 0.0 && x[0] < length && x[1] > 0.0 && x[1] < 0.5);
    let (piston, rest): (Vec<_>, Vec<_>) =
        outer.into_iter().filter(outside).partition(|x| x[0] < 0.0);
    let mut piston = tank::wall("piston", piston);
    let travel = 0.01;
    // A smooth push that lasts 25 sound crossings, so that compression is quasi-static.
    let motion = Motion::SmoothStart { velocity: 4.0 * travel, duration: 0.25 };
    let piston_motion = motion.clone();
    piston.motion = Some(WallMotion { direction: V2::new(1.0, 0.0), motion });
    let walls = vec![piston, tank::wall("box", rest)];
    let mut fluid = Fluid::new(parameters, seeds, walls).unwrap();
    let group = fluid.wall_group("piston").unwrap();
    let mut work = 0.0;
    while fluid.time() < 0.375 {
        let dt = fluid.stable_time_step().unwrap().value;
        let before = piston_motion.displacement(fluid.time());
        fluid.step(dt).unwrap();
        let after = piston_motion.displacement(fluid.time());
        work -= fluid.wall_force(group, &V2::zeros()).0[0] * (after - before);
    }
    let travel = piston_motion.displacement(fluid.time());
    let ledger = fluid.ledger();
    assert!((ledger.wall_work - work).abs() < 1e-10 * work, "{} {work}", ledger.wall_work);
    // Isentropic compression of the box: p = c0² ρ0 s/(L - s), W = ∫ p ds.
    let strain: f64 = travel / length;
    let pressure = c0 * c0 * 1000.0 * strain / (1.0 - strain);
    let exact_work = 0.5 * c0 * c0 * 1000.0 * (-strain - (1.0 - strain).ln());
    let count = fluid.particles().len();
    let measured = (0..count).map(|i| fluid.pressure(i)).sum::<f64>() / count as f64;
    eprintln!(
        "piston: pressure {measured:.0} Pa, exact {pressure:.0}; work {work:.2} J/m, exact \
         {exact_work:.2}; residual {:.3e}, {ledger:?}",
        fluid.energy_residual()
    );
    assert!(fluid.energy_residual().abs() < 0.02 * work);
    (measured / pressure - 1.0, work / exact_work - 1.0)
}

#[test]
fn piston_compresses_a_closed_box_and_the_ledger_gets_its_work() {
    // Measured: pressure 1.5 and 1.4 % low, work 2.7 and 2.5 % low at these spacings: the
    // effective face of the piston is a lattice sum, which does not converge with dx.
    for (pressure, work) in [compress(0.05), compress(0.025)] {
        assert!(pressure.abs() < 0.02 && work.abs() < 0.03, "{pressure} {work}");
    }
}

/// A tank whose right wall is a structure: the points and volumes of the wall.
fn structure_tank(structure_spacing: f64) -> (Fluid<2>, Vec<V2>, Vec<f64>) {
    let dx = 0.05;
    let parameters = FluidParameters {
        gravity: V2::new(0.0, -9.81),
        domain: (V2::repeat(-0.5), V2::repeat(1.6)),
        ..FluidParameters::water(dx, 30.0)
    };
    let seeds = tank::still_water(V2::zeros(), V2::repeat(1.0), &parameters);
    let mut points = tank::tank(V2::zeros(), V2::new(1.0, 1.2), dx);
    points.retain(|x| x[0] < 1.0);
    let fluid = Fluid::new(parameters, seeds, vec![tank::wall("tank", points)]).unwrap();
    let structure = tank::fill(V2::new(1.0, -0.2), V2::new(1.2, 1.2), structure_spacing);
    let volume = vec![structure_spacing.powi(2); structure.len()];
    (fluid, structure, volume)
}

#[test]
fn structure_and_rigid_wall_feel_the_same_water() {
    // Hydrostatic load ½ ρ g H², on points at the fluid's spacing and at half of it.
    for spacing in [0.05, 0.025] {
        let (mut fluid, points, volume) = structure_tank(spacing);
        let still = vec![V2::zeros(); points.len()];
        let (mut load, mut count) = (0.0, 0.0);
        fluid.structure_mut().set_points(&points, &still, &volume).unwrap();
        while fluid.time() < 1.5 {
            let dt = fluid.stable_time_step().unwrap().value;
            fluid.drift_to_midpoint(dt).unwrap();
            fluid.locate_structure();
            fluid.evaluate_acceleration();
            fluid.evaluate_boundary_force(BoundarySet::Structure);
            fluid.kick(dt);
            fluid.evaluate_density_rate();
            fluid.drift_to_end(dt).unwrap();
            let force: V2 = fluid.structure().force.iter().sum();
            let scale: f64 = fluid.structure().force.iter().map(|f| f.norm()).sum();
            assert!((force + fluid.force_from_structure()).norm() < 1e-13 * scale);
            if fluid.time() > 1.0 {
                load += force[0];
                count += 1.0;
            }
        }
        let relative = load / count / (0.5 * 9810.0);
        eprintln!("structure spacing {spacing}: load {relative:.4} of the hydrostatic one");
        assert!((relative - 1.0).abs() < 0.02, "{relative}");
    }
}

#[test]
fn near_structure_pass_equals_the_full_pass() {
    let (mut fluid, points, volume) = structure_tank(0.025);
    let old = vec![V2::new(-0.2, 0.0); points.len()];
    let new: Vec<V2> = points.iter().map(|x| V2::new(-0.1 * x[1], 0.05)).collect();
    fluid.structure_mut().set_points(&points, &old, &volume).unwrap();
    for _ in 0..5 {
        fluid.drift_to_midpoint(1e-3).unwrap();
        fluid.locate_structure();
        fluid.evaluate_acceleration();
        fluid.correct_density(1e-3, &old, &new).unwrap();
        fluid.evaluate_near_structure();
        let near = fluid.particles().acceleration.clone();
        fluid.evaluate_acceleration();
        assert!(near == fluid.particles().acceleration);
        fluid.kick(1e-3);
        fluid.evaluate_density_rate();
        fluid.drift_to_end(1e-3).unwrap();
    }
}

#[test]
fn overlapping_structure_points_are_capped() {
    let (mut fluid, mut points, mut volume) = structure_tank(0.025);
    let load = |fluid: &mut Fluid<2>, points: &[V2], volume: &[f64]| {
        let still = vec![V2::zeros(); points.len()];
        fluid.structure_mut().set_points(points, &still, volume).unwrap();
        fluid.drift_to_midpoint(1e-6).unwrap();
        fluid.locate_structure();
        fluid.evaluate_acceleration();
        fluid.force_from_structure()[0]
    };
    let single = load(&mut fluid.clone(), &points, &volume);
    points.extend(points.clone());
    volume.extend(volume.clone());
    let double = load(&mut fluid, &points, &volume);
    // Inside the body the sum is 2 and halves the volumes. At the face it is near 1, so
    // the outermost layers keep theirs; without a cap the ratio is 2.
    eprintln!("load of a doubled body: {:.3} of the single one", double / single);
    assert!(double / single < 1.5);
}

#[test]
fn mismatched_structure_arrays_are_refused() {
    let (mut fluid, points, volume) = structure_tank(0.05);
    let error = fluid.structure_mut().set_points(&points, &[], &volume).unwrap_err();
    assert!(matches!(error, FluidError::Length { array: "structure velocity", .. }));
}
