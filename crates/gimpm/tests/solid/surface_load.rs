//! Loads on surfaces, and the way to the static state.

use crate::lattice::{at_rest, lattice, parameters, planes};
use gimpm::{
    BodySeed, Discretisation, Frame, Hold, LinearElastic, LoadKind, NodeConstraint, Relaxation,
    Solid, SurfaceLoad,
};
use motion::Motion;
use nalgebra::{SVector, vector};

const H: f64 = 0.1;
const RUBBER: LinearElastic =
    LinearElastic { density: 1000.0, young_modulus: 1.0e6, poisson_ratio: 0.3 };

/// A bar of 10 × 2 × 2 cells, guided at its left end, at rest under `load`.
fn settled<const D: usize>(
    frame: Frame,
    lateral: [Option<Motion>; D],
    load: SurfaceLoad<D>,
) -> Solid<D> {
    let counts = std::array::from_fn(|d| if d == 0 { 20 } else { 4 });
    let body = BodySeed {
        name: "bar".into(),
        material: RUBBER.into(),
        points: lattice(SVector::zeros(), counts, 0.5 * H),
        velocity: at_rest(),
        point_spacing: 0.5 * H,
        discretisation: Discretisation { frame, ..Discretisation::default() },
    };
    let mut parameters = parameters(H, SVector::repeat(-H), counts.map(|n| n / 2 + 2), 0.7);
    parameters.damping = 0.8;
    // In the updated frame the light nodes beyond the loaded face keep a little noise alive.
    let tolerance = if frame == Frame::Total { 1e-6 } else { 1e-4 };
    parameters.relaxation = Some(Relaxation { tolerance });
    let mut guides = vec![planes("guide", 0, f64::NEG_INFINITY, 0.0, lateral)];
    // Nothing else would stop the bar from drifting sideways.
    for axis in 1..D {
        let held = std::array::from_fn(|d| (d == axis).then_some(Motion::Fixed));
        guides.push(planes("side", axis, f64::NEG_INFINITY, 0.0, held));
    }
    let mut solid = Solid::new(parameters, vec![body], guides).unwrap();
    solid.set_surface_loads(vec![load]).unwrap();
    for _ in 0..20_000 {
        if solid.is_relaxed() {
            return solid;
        }
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
    }
    panic!("not at rest: out of balance by {:e}", solid.out_of_balance());
}

fn end_load<const D: usize>(kind: LoadKind<D>) -> SurfaceLoad<D> {
    SurfaceLoad {
        name: "end".into(),
        body: 0,
        axis: 0,
        upper_side: true,
        lower: SVector::repeat(f64::NEG_INFINITY),
        upper: SVector::repeat(f64::INFINITY),
        kind,
        ramp: 0.0,
    }
}

fn along_x<const D: usize>() -> [Option<Motion>; D] {
    std::array::from_fn(|d| (d == 0).then_some(Motion::Fixed))
}

/// Codes that put the traction into the outer half layer of points get 0.75 there.
fn uniform_traction<const D: usize>(frame: Frame) {
    let traction = SVector::from_fn(|d, _| if d == 0 { 100.0 } else { 0.0 });
    let solid = settled::<D>(frame, along_x(), end_load(LoadKind::Traction(traction)));
    let worst = solid.points().stress.iter().map(|s| (s[0] / 100.0 - 1.0).abs());
    let worst = worst.fold(0.0, f64::max);
    println!("{D}D {frame:?}: worst point {worst:.1e} off");
    assert!(worst < 1e-3, "{worst}");
    let (force, _) = solid.reaction(0, SVector::zeros());
    let area = (2.0 * H).powi(D as i32 - 1);
    assert!((force[0] / (-100.0 * area) - 1.0).abs() < 1e-4, "{force}");
}

#[test]
fn a_uniform_traction_is_carried_by_a_uniform_stress() {
    for frame in [Frame::Total, Frame::Updated] {
        uniform_traction::<2>(frame);
        uniform_traction::<3>(frame);
    }
}

/// Pressure p on the end of a bar that may not move sideways; the axial stress is -p.
#[test]
fn pressure_pushes_against_the_normal() {
    for frame in [Frame::Total, Frame::Updated] {
        let solid = settled::<2>(frame, along_x(), end_load(LoadKind::Pressure(100.0)));
        let worst = solid.points().stress.iter().map(|s| (s[0] / -100.0 - 1.0).abs());
        assert!(worst.fold(0.0, f64::max) < 2e-3);
    }
}

/// Still water of 0.4 m on the right side of a cantilever held at its bottom:
/// force ½γh² and moment γh³/6 at the foot.
#[test]
fn still_water_gives_its_force_and_moment() {
    let body = BodySeed {
        name: "wall".into(),
        material: LinearElastic { young_modulus: 1.0e9, ..RUBBER }.into(),
        points: lattice(SVector::zeros(), [4, 10], 0.5 * H),
        velocity: at_rest(),
        point_spacing: 0.5 * H,
        discretisation: Discretisation { frame: Frame::Total, ..Discretisation::default() },
    };
    let mut parameters = parameters(H, SVector::repeat(-H), [4, 7], 0.7);
    parameters.damping = 0.8;
    parameters.relaxation = Some(Relaxation { tolerance: 1e-4 });
    let fixed = [Some(Motion::Fixed), Some(Motion::Fixed)];
    let foot = NodeConstraint {
        name: "foot".into(),
        body: 0,
        lower: vector![f64::NEG_INFINITY, f64::NEG_INFINITY],
        upper: vector![f64::INFINITY, 0.0],
        hold: Hold::Components(fixed),
    };
    let mut solid = Solid::new(parameters, vec![body], vec![foot]).unwrap();
    let (level, specific_weight) = (0.4, 9810.0);
    solid
        .set_surface_loads(vec![end_load(LoadKind::Hydrostatic { level, specific_weight })])
        .unwrap();
    while !solid.is_relaxed() {
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
    }
    let (force, moment) = solid.reaction(0, vector![0.0, 0.0]);
    // Water pushes to the left, the foot to the right. The pressure is sampled at the
    // corners of faces, which is exact for a line.
    assert!((force[0] / (0.5 * specific_weight * level * level) - 1.0).abs() < 1e-3, "{force}");
    let lever = specific_weight * level.powi(3) / 6.0;
    assert!((moment[2] / -lever - 1.0).abs() < 0.02, "{moment:?} {lever}");
}

#[test]
fn a_load_without_a_face_is_refused() {
    let body = BodySeed {
        name: "bar".into(),
        material: RUBBER.into(),
        points: lattice(SVector::zeros(), [4, 4], 0.5 * H),
        velocity: at_rest(),
        point_spacing: 0.5 * H,
        discretisation: Discretisation::default(),
    };
    let mut solid =
        Solid::new(parameters(H, SVector::repeat(-H), [4, 4], 0.5), vec![body], Vec::new())
            .unwrap();
    let mut load = end_load(LoadKind::Pressure(1.0));
    load.lower[0] = 0.3;
    let message = solid.set_surface_loads(vec![load]).unwrap_err().to_string();
    assert!(message.contains("load 'end'") && message.contains("no free face"), "{message}");
    let nan = end_load(LoadKind::Pressure(f64::NAN));
    assert!(solid.set_surface_loads(vec![nan]).unwrap_err().to_string().contains("not finite"));
}
