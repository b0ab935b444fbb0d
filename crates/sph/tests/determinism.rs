//! Same bits for any thread count and after a restart.

#![allow(clippy::unwrap_used)]

mod tank;

use motion::Motion;
use nalgebra::SVector;
use sph::{Fluid, FluidParameters, FluidState, WallMotion};

type V3 = SVector<f64, 3>;

/// A collapsing column in a 3D tank with a moving end wall.
fn case() -> Fluid<3> {
    let dx = 0.1;
    let parameters = FluidParameters {
        gravity: V3::new(0.0, 0.0, -9.81),
        domain: (V3::repeat(-0.5), V3::new(2.5, 1.0, 2.0)),
        ..FluidParameters::water(dx, 40.0)
    };
    let size = V3::new(1.6, 0.5, 1.2);
    let seeds = tank::still_water(V3::zeros(), V3::new(0.8, 0.5, 0.8), &parameters);
    let points = tank::tank(V3::zeros(), size, dx);
    let (piston, rest) = points.into_iter().partition(|x| x[0] < 0.0);
    let mut piston = tank::wall("piston", piston);
    piston.motion = Some(WallMotion {
        direction: V3::new(1.0, 0.0, 0.0),
        motion: Motion::SmoothStart { velocity: 0.5, duration: 0.1 },
    });
    Fluid::new(parameters, seeds, vec![piston, tank::wall("tank", rest)]).unwrap()
}

fn advance(fluid: &mut Fluid<3>, steps: usize) -> FluidState<3> {
    for _ in 0..steps {
        let dt = fluid.stable_time_step().unwrap().value;
        fluid.step(dt).unwrap();
    }
    fluid.state()
}

fn with_threads(threads: usize, steps: usize) -> (FluidState<3>, [f64; 3]) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut fluid = case();
        let state = advance(&mut fluid, steps);
        (state, fluid.wall_force(0, &V3::zeros()).1)
    })
}

#[test]
fn one_and_two_threads_give_the_same_bits() {
    let (one, two) = (with_threads(1, 120), with_threads(2, 120));
    assert!(one == two);
}

#[test]
fn a_restored_state_continues_bit_for_bit() {
    let mut original = case();
    let checkpoint = advance(&mut original, 60);
    let expected = advance(&mut original, 60);
    let mut restored = case();
    restored.restore_state(checkpoint.clone()).unwrap();
    let gauge = V3::new(0.4, 0.25, 0.3);
    assert!(restored.state() == checkpoint);
    assert!(advance(&mut restored, 60) == expected);
    assert!(restored.sample(&gauge) == original.sample(&gauge));
    let about = V3::zeros();
    assert!(restored.wall_force(1, &about) == original.wall_force(1, &about));
}
