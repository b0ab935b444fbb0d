//! Bad input is named with its value, limit and remedy.

#![allow(clippy::unwrap_used)]

mod tank;

use motion::{Motion, MotionError};
use nalgebra::SVector;
use sph::{Fluid, FluidError, FluidParameters, FluidSeed, WallMotion};

type V2 = SVector<f64, 2>;

fn parameters() -> FluidParameters<2> {
    FluidParameters::water(0.1, 20.0)
}

fn refusal(parameters: FluidParameters<2>) -> FluidError {
    Fluid::new(parameters, vec![], vec![]).unwrap_err()
}

#[test]
fn parameters_out_of_range() {
    type Spoil = fn(&mut FluidParameters<2>);
    let cases: [(&str, Spoil); 7] = [
        ("spacing", |p| p.spacing = 0.0),
        ("smoothing_length/spacing", |p| p.smoothing_length = 0.3),
        ("reference_density", |p| p.reference_density = -1000.0),
        ("sound_speed", |p| p.sound_speed = f64::NAN),
        ("density_diffusion", |p| p.density_diffusion = 0.6),
        ("courant_number", |p| p.courant_number = 2.0),
        ("domain extent", |p| p.domain.1 = p.domain.0),
    ];
    for (expected, spoil) in cases {
        let mut bad = parameters();
        spoil(&mut bad);
        let error = refusal(bad);
        let FluidError::Parameter { name, .. } = &error else { panic!("{error}") };
        assert_eq!(*name, expected);
        assert!(error.to_string().contains("allowed:"), "{error}");
    }
    let mut huge = parameters();
    huge.domain.1 = V2::repeat(1e6);
    assert!(matches!(refusal(huge), FluidError::TooManyCells { .. }));
}

#[test]
fn seeds_and_walls_out_of_range() {
    let outside = FluidSeed { position: V2::repeat(1e3), ..FluidSeed::default() };
    let dense = FluidSeed { density_deviation: 300.0, ..FluidSeed::default() };
    for (seed, expected) in [(outside, "position"), (dense, "density deviation")] {
        let error = Fluid::new(parameters(), vec![seed], vec![]).unwrap_err();
        let FluidError::Seed { id: 0, quantity, .. } = error else { panic!("{error}") };
        assert_eq!(quantity, expected);
    }
    let mut wall = tank::wall("sea bed", vec![V2::zeros()]);
    let twice = vec![wall.clone(), wall.clone()];
    assert!(matches!(Fluid::new(parameters(), vec![], twice), Err(FluidError::Wall { .. })));
    let motion = Motion::Ramp { velocity: 1.0, duration: 0.0 };
    wall.motion = Some(WallMotion { direction: V2::new(1.0, 0.0), motion });
    let error = Fluid::new(parameters(), vec![], vec![wall]).unwrap_err();
    let source = MotionError::Duration(0.0);
    assert_eq!(error, FluidError::WallMotion { name: "sea bed".to_owned(), source });
}

#[test]
fn a_run_that_fails_names_the_particle() {
    let seed = |x, u| FluidSeed {
        position: V2::new(x, 0.0),
        velocity: V2::new(u, 0.0),
        density_deviation: 0.0,
    };
    let mut fluid: Fluid<2> =
        Fluid::new(parameters(), vec![seed(0.0, 15.0), seed(0.1, -15.0)], vec![]).unwrap();
    let error = (0..100).find_map(|_| fluid.step(0.01).err()).unwrap();
    assert!(
        matches!(error, FluidError::DensityOutOfRange { .. } | FluidError::NonFinite { .. }),
        "{error}"
    );
    let mut fast: Fluid<2> = Fluid::new(parameters(), vec![seed(0.0, 25.0)], vec![]).unwrap();
    assert!(matches!(fast.stable_time_step(), Err(FluidError::TimeStep { .. })));
    assert!(matches!(fast.step(f64::NAN), Err(FluidError::TimeStep { .. })));
}
