//! Contact between bodies, and of one body with a rigid wall, against exact values.

use crate::lattice::{lattice, parameters, planes};
use crate::noise::noise;
use gimpm::{
    BodySeed, Contact, Discretisation, Frame, Hold, InitialVelocity, LinearElastic, NodeConstraint,
    Solid,
};
use motion::Motion;
use nalgebra::SVector;
use proptest::prelude::*;
use std::f64::consts::PI;

type Vector = SVector<f64, 2>;

const GRAVITY: f64 = 9.81;

fn body<const D: usize>(
    name: &str,
    material: LinearElastic,
    points: Vec<SVector<f64, D>>,
    velocity: SVector<f64, D>,
    point_spacing: f64,
) -> BodySeed<D> {
    BodySeed {
        name: name.into(),
        material: material.into(),
        points,
        velocity: InitialVelocity::Uniform(velocity),
        point_spacing,
        discretisation: Discretisation::default(),
    }
}

/// The lattice points in a disk; its centre is a corner of four boxes.
fn lattice_disk(centre: Vector, radius: f64, spacing: f64) -> Vec<Vector> {
    let reach = (radius / spacing).ceil();
    let lower = centre - Vector::repeat(reach * spacing);
    lattice(lower, [2 * reach as usize; 2], spacing)
        .into_iter()
        .filter(|x| (x - centre).norm() < radius)
        .collect()
}

/// Points on rings, so that the rim is round: lattice disks are polygons.
fn ring_disk(centre: Vector, rings: usize, spacing: f64) -> Vec<Vector> {
    let ring = |k: usize| {
        let radius = (k as f64 + 0.5) * spacing;
        let count = (2.0 * PI * (k as f64 + 0.5)).round() as usize;
        let turn = 0.5 * (k % 2) as f64;
        (0..count).map(move |i| {
            let angle = 2.0 * PI * (i as f64 + turn) / count as f64;
            centre + Vector::from([angle.cos(), angle.sin()]) * radius
        })
    };
    (0..rings).flat_map(ring).collect()
}

fn advance<const D: usize>(solid: &mut Solid<D>) -> f64 {
    let dt = solid.stable_time_step().unwrap().value;
    solid.step(dt).unwrap();
    if solid.needs_sort() {
        solid.sort_points();
    }
    dt
}

/// Velocity of the centre of mass of a body whose points weigh the same.
fn mean_velocity<const D: usize>(solid: &Solid<D>, body: usize) -> SVector<f64, D> {
    let range = solid.body_range(body);
    let count = range.len() as f64;
    range.map(|p| solid.points().velocity[p]).sum::<SVector<f64, D>>() / count
}

/// Slope of the least-squares line through (time, value).
fn slope(history: &[(f64, f64)]) -> f64 {
    let count = history.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| history.iter().map(pick).sum::<f64>() / count;
    let (time, value) = (mean(|entry| entry.0), mean(|entry| entry.1));
    let product: f64 = history.iter().map(|(t, v)| (t - time) * (v - value)).sum();
    product / history.iter().map(|(t, _)| (t - time).powi(2)).sum::<f64>()
}

/// Sulsky, Chen and Schreyer (1994): two disks of radius 0.2 on a diagonal.
fn two_disks(friction: f64) -> Solid<2> {
    let soft = LinearElastic { density: 1000.0, young_modulus: 1000.0, poisson_ratio: 0.3 };
    let disk = |name, at, speed| {
        let points = lattice_disk(Vector::repeat(at), 0.2, 0.025);
        body(name, soft, points, Vector::repeat(speed), 0.025)
    };
    let mut parameters = parameters(0.05, Vector::repeat(-0.2), [28, 28], 0.2);
    parameters.contact = Some(Contact { friction });
    let bodies = vec![disk("left", 0.2, 0.1), disk("right", 0.8, -0.1)];
    Solid::new(parameters, bodies, Vec::new()).unwrap()
}

/// The rims meet at t = (0.6 √2 - 0.4)/(0.2 √2) = 1.586 s; a shared velocity
/// field would make the disks meet a cell early and stick.
#[test]
fn two_disks_collide_and_part() {
    for friction in [0.0, 0.2] {
        let mut solid = two_disks(friction);
        let scale = solid.total_mass() * 0.1;
        let start = solid.energy().kinetic;
        let (mut first, mut last) = (f64::INFINITY, 0.0);
        let (mut momentum, mut most, mut end) = (0.0_f64, 0.0_f64, 0.0);
        while solid.time() < 3.5 {
            let (velocity, before) = (mean_velocity(&solid, 0), solid.energy());
            advance(&mut solid);
            if (mean_velocity(&solid, 0) - velocity).norm() > 1e-9 {
                first = solid.time().min(first);
                last = solid.time();
            }
            momentum = momentum.max(solid.momentum().norm() / scale);
            // Stress is known at whole steps, velocity between them.
            let kinetic = 0.5 * (before.kinetic + solid.energy().kinetic);
            end = (before.strain + kinetic) / start;
            most = end.max(most);
        }
        let closing = 0.2 * 2.0_f64.sqrt();
        let early = (0.6 * 2.0_f64.sqrt() - 0.4) - closing * first;
        let speed = mean_velocity(&solid, 1).norm() / (0.1 * 2.0_f64.sqrt());
        println!(
            "μ {friction}: contact from {first:.4} s ({:.2} cells early) to {last:.4} s, momentum {momentum:.1e}, energy at most {most:.4}, at the end {end:.4}, rebound {speed:.4}",
            early / 0.05
        );
        assert!(early.abs() < 0.5 * 0.05, "first contact at {first} s");
        assert!(momentum < 1e-12, "{momentum}");
        assert!(most <= 1.0 + 1e-9, "{most}");
        assert!(last < 3.0 && speed > 0.7, "parted at {last} s with {speed} of the speed");
    }
}

/// Gravity that turns the plane y = 0 into an incline.
fn tilted(angle: f64) -> Vector {
    Vector::from([GRAVITY * angle.sin(), -GRAVITY * angle.cos()])
}

fn held_below(name: &str, level: f64) -> NodeConstraint<2> {
    planes(name, 1, f64::NEG_INFINITY, level, std::array::from_fn(|_| Some(Motion::Fixed)))
}

const INCLINE: f64 = PI / 6.0;

/// Velocity history of a block 0.8 m long and 0.4 m high on an incline of 30°.
fn sliding(friction: f64, young_modulus: f64) -> Vec<(f64, f64)> {
    let material = LinearElastic { density: 1000.0, young_modulus, poisson_ratio: 0.3 };
    let rest = Vector::zeros();
    let slab = lattice(Vector::from([0.0, -0.2]), [60, 4], 0.05);
    let block = lattice(Vector::from([0.4, 0.0]), [16, 8], 0.05);
    let mut parameters = parameters(0.1, Vector::from([-0.4, -0.4]), [40, 12], 0.5);
    parameters.gravity = tilted(INCLINE);
    parameters.gravity_ramp = 0.3;
    parameters.contact = Some(Contact { friction });
    let bodies = vec![
        body(
            "slab",
            LinearElastic { young_modulus: 10.0 * young_modulus, ..material },
            slab,
            rest,
            0.05,
        ),
        body("block", material, block, rest, 0.05),
    ];
    let mut solid = Solid::new(parameters, bodies, vec![held_below("bottom", -0.2)]).unwrap();
    let mut history = Vec::new();
    while solid.time() < 0.8 {
        advance(&mut solid);
        history.push((solid.time(), mean_velocity(&solid, 1)[0]));
    }
    history
}

fn after(history: &[(f64, f64)], time: f64) -> &[(f64, f64)] {
    &history[history.partition_point(|entry| entry.0 < time)..]
}

#[test]
fn a_block_slides_down_an_incline() {
    for (friction, young_modulus) in [(0.0, 1e6), (0.3, 1e6), (0.3, 1e7)] {
        let exact = GRAVITY * (INCLINE.sin() - friction * INCLINE.cos());
        let measured = slope(after(&sliding(friction, young_modulus), 0.3));
        let error = measured / exact - 1.0;
        println!("μ {friction}, E {young_modulus:e}: a = {measured:.4}, {:+.2} %", 100.0 * error);
        assert!(error.abs() < 0.02, "{measured} {exact}");
    }
}

#[test]
fn a_block_sticks_below_the_angle_of_friction() {
    let history = sliding(0.7, 1e6);
    let velocity = after(&history, 0.3).iter().fold(0.0_f64, |most, entry| most.max(entry.1.abs()));
    let acceleration = slope(after(&history, 0.3));
    println!("sticking block: speed up to {velocity:.2e} m/s, a = {acceleration:.2e}");
    assert!(acceleration.abs() < 0.02 * GRAVITY * INCLINE.sin(), "{acceleration}");
    assert!(velocity < 0.01 * GRAVITY * INCLINE.sin() * 0.8, "{velocity}");
}

/// The same in three dimensions, sliding askew to the grid.
#[test]
fn a_block_slides_in_three_dimensions() {
    let material = LinearElastic { density: 1000.0, young_modulus: 1e6, poisson_ratio: 0.3 };
    let stiff = LinearElastic { young_modulus: 1e7, ..material };
    let slab = lattice(SVector::from([0.0, 0.0, -0.2]), [36, 28, 4], 0.05);
    let block = lattice(SVector::from([0.2, 0.2, 0.0]), [12, 12, 6], 0.05);
    let (rest, friction) = (SVector::zeros(), 0.3);
    let askew = (PI / 6.0).sin_cos();
    let mut parameters = parameters(0.1, SVector::repeat(-0.4), [26, 22, 12], 0.5);
    parameters.gravity = SVector::from([askew.1, askew.0, 0.0]) * (GRAVITY * INCLINE.sin());
    parameters.gravity[2] = -GRAVITY * INCLINE.cos();
    parameters.gravity_ramp = 0.3;
    parameters.contact = Some(Contact { friction });
    let fixed = std::array::from_fn(|_| Some(Motion::Fixed));
    let bottom = planes("bottom", 2, f64::NEG_INFINITY, -0.2, fixed);
    let bodies =
        vec![body("slab", stiff, slab, rest, 0.05), body("block", material, block, rest, 0.05)];
    let mut solid = Solid::new(parameters, bodies, vec![bottom]).unwrap();
    let mut history = [Vec::new(), Vec::new()];
    while solid.time() < 0.7 {
        advance(&mut solid);
        let velocity = mean_velocity(&solid, 1);
        (0..2).for_each(|d| history[d].push((solid.time(), velocity[d])));
    }
    let along = history.map(|history| slope(after(&history, 0.3)));
    let exact = GRAVITY * (INCLINE.sin() - friction * INCLINE.cos());
    let (size, direction) = (along[0].hypot(along[1]) / exact - 1.0, along[1].atan2(along[0]));
    println!("3D: a {:+.2} %, direction {:.2}°", 100.0 * size, direction.to_degrees());
    assert!(size.abs() < 0.02, "{along:?} {exact}");
    assert!((direction - PI / 6.0).abs() < 1.0_f64.to_radians(), "{direction}");
}

/// A disk that rolls has a = (2/3) g sin θ.
#[test]
fn a_disk_rolls_down_an_incline() {
    let (radius, cells) = (0.25, 20.0);
    let h = radius / cells;
    let spacing = 0.5 * h;
    let material = LinearElastic { density: 1000.0, young_modulus: 1e7, poisson_ratio: 0.3 };
    let disk = ring_disk(Vector::from([0.35, radius]), 2 * cells as usize, spacing);
    let slab = lattice(Vector::from([0.0, -2.0 * h]), [(1.1 / spacing) as usize, 4], spacing);
    let origin = Vector::from([-2.0 * h, -4.0 * h]);
    let mut parameters = parameters(h, origin, [96, 46], 0.5);
    parameters.gravity = tilted(INCLINE);
    parameters.gravity_ramp = 0.1;
    parameters.contact = Some(Contact { friction: 0.6 });
    let rest = Vector::zeros();
    let bodies = vec![
        body("slab", material, slab, rest, spacing),
        body("disk", material, disk, rest, spacing),
    ];
    let mut solid = Solid::new(parameters, bodies, vec![held_below("bottom", -2.0 * h)]).unwrap();
    let (mut travel, mut spin) = (Vec::new(), Vec::new());
    while solid.time() < 0.5 {
        advance(&mut solid);
        let velocity = mean_velocity(&solid, 1);
        let (range, points) = (solid.body_range(1), solid.points());
        let count = range.len() as f64;
        let centre = range.clone().map(|p| points.position[p]).sum::<Vector>() / count;
        let (mut momentum, mut inertia) = (0.0, 0.0);
        for p in range {
            let (arm, speed) = (points.position[p] - centre, points.velocity[p] - velocity);
            momentum += arm[0] * speed[1] - arm[1] * speed[0];
            inertia += arm.norm_squared();
        }
        travel.push((solid.time(), velocity[0]));
        spin.push((solid.time(), -momentum / inertia * radius));
    }
    let exact = 2.0 / 3.0 * GRAVITY * INCLINE.sin();
    let [travel, spin] = [travel, spin].map(|history| slope(after(&history, 0.1)) / exact - 1.0);
    println!("rolling disk: a {:+.2} %, α R {:+.2} %", 100.0 * travel, 100.0 * spin);
    assert!(travel.abs() < 0.02 && spin.abs() < 0.02, "{travel} {spin}");
}

/// F = ρ c A u for 2L/c.
#[test]
fn a_rod_hits_a_rigid_wall() {
    let (length, height, speed, cells) = (1.0, 0.1, 0.05, 40);
    let h = length / f64::from(cells);
    let material = LinearElastic { density: 1000.0, young_modulus: 1e6, poisson_ratio: 0.0 };
    let points = lattice(Vector::zeros(), [2 * cells as usize, 8], 0.5 * h);
    let rod = body("rod", material, points, Vector::from([-speed, 0.0]), 0.5 * h);
    let wall = NodeConstraint {
        name: "wall".into(),
        body: 0,
        lower: Vector::repeat(f64::NEG_INFINITY),
        upper: Vector::from([0.0, f64::INFINITY]),
        hold: Hold::Normal {
            direction: Vector::from([1.0, 0.0]),
            motion: Motion::Fixed,
            one_sided: true,
        },
    };
    let parameters = parameters(h, Vector::repeat(-2.0 * h), [48, 8], 0.4);
    let mut solid = Solid::new(parameters, vec![rod], vec![wall]).unwrap();
    let wave_speed = 1000.0_f64.sqrt();
    let exact_force = 1000.0 * wave_speed * height * speed;
    let exact_duration = 2.0 * length / wave_speed;
    let (mut impulse, mut plateau, mut plateau_time, mut last) = (0.0, 0.0, 0.0, 0.0);
    while solid.time() < 2.0 * exact_duration {
        let start = solid.time() / exact_duration;
        let dt = advance(&mut solid);
        let force = solid.reaction(0, Vector::zeros()).0[0];
        assert!(force >= 0.0, "the wall only pushes: {force}");
        impulse += force * dt;
        if start > 0.2 && start < 0.8 {
            plateau += force * dt;
            plateau_time += dt;
        }
        if force > 0.0 {
            last = solid.time();
        }
    }
    let force = plateau / plateau_time / exact_force;
    let rebound = mean_velocity(&solid, 0)[0] / speed;
    println!(
        "rod: plateau {force:.4} ρcAu, last push at {:.4} of 2L/c, impulse over plateau {:.4} of 2L/c, rebound {rebound:.4}",
        last / exact_duration,
        impulse / (plateau / plateau_time) / exact_duration
    );
    assert!((force - 1.0).abs() < 0.02, "{force}");
    assert!((last / exact_duration - 1.0).abs() < 0.02, "{last} {exact_duration}");
}

/// Two rough blocks that fly into each other, the first on a floor if asked for.
fn crash<const D: usize>(seed: u64, floor: bool) -> Solid<D> {
    let mut random = noise(seed);
    let soft = LinearElastic { density: 1000.0, young_modulus: 1e6, poisson_ratio: 0.3 };
    let mut block = |name: &str, lower: f64, count: usize, spacing: f64, speed: f64| {
        let points: Vec<SVector<f64, D>> = lattice(SVector::repeat(lower), [count; D], spacing)
            .into_iter()
            .map(|x| x.map(|along| along + 0.1 * spacing * random()))
            .collect();
        let velocity = SVector::from_fn(|_, _| speed * (1.0 + 0.5 * random()));
        body(name, soft, points, velocity, spacing)
    };
    let bodies = vec![block("first", 0.0, 6, 0.05, 2.0), block("second", 0.32, 5, 0.04, -2.0)];
    let mut parameters = parameters(0.1, SVector::repeat(-0.5), [14; D], 0.4);
    parameters.contact = Some(Contact { friction: 0.3 });
    let held = || std::array::from_fn(|_| Some(Motion::Fixed));
    // Reaches the nodes at which the blocks meet: contact acts on held nodes too.
    let floor = floor.then(|| planes("floor", D - 1, f64::NEG_INFINITY, 0.3, held()));
    Solid::new(parameters, bodies, floor.into_iter().collect()).unwrap()
}

/// Largest change of momentum in a step that no reaction explains, relative to
/// what the points carry, and the velocity change of the second block.
fn unbalanced<const D: usize>(seed: u64, floor: bool) -> (f64, f64) {
    let mut solid = crash::<D>(seed, floor);
    let start = mean_velocity(&solid, 1);
    let points = solid.points();
    let scale: f64 = (0..points.len()).map(|p| points.mass[p] * points.velocity[p].norm()).sum();
    let mut worst = 0.0_f64;
    for _ in 0..60 {
        let before = solid.momentum();
        let dt = advance(&mut solid);
        let given = if floor { solid.reaction(0, SVector::zeros()).0 * dt } else { before * 0.0 };
        worst = worst.max((solid.momentum() - before - given).norm() / scale);
    }
    (worst, (mean_velocity(&solid, 1) - start).norm())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 8, failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn momentum_is_exchanged_and_none_is_lost(seed in 0..u64::MAX / 2) {
        for (case, (worst, change)) in [
            ("2D", unbalanced::<2>(seed, false)),
            ("3D", unbalanced::<3>(seed, false)),
            ("2D with a floor", unbalanced::<2>(seed, true)),
            ("3D with a floor", unbalanced::<3>(seed, true)),
        ] {
            prop_assert!(worst < 1e-13, "{case}: {worst}");
            prop_assert!(change > 0.1, "{case}: the blocks did not meet");
        }
    }
}

/// A block at rest between two that come from both sides.
#[test]
fn three_bodies_meet() {
    let soft = LinearElastic { density: 1000.0, young_modulus: 1e6, poisson_ratio: 0.3 };
    let block = |name, lower, speed| {
        let points = lattice(Vector::from([lower, 0.0]), [6, 6], 0.05);
        body(name, soft, points, Vector::from([speed, 0.0]), 0.05)
    };
    let mut parameters = parameters(0.1, Vector::repeat(-0.5), [22, 14], 0.4);
    parameters.contact = Some(Contact { friction: 0.3 });
    let bodies =
        vec![block("left", 0.0, 1.0), block("middle", 0.35, 0.0), block("right", 0.7, -1.0)];
    let mut solid = Solid::new(parameters, bodies, Vec::new()).unwrap();
    let scale = 2.0 * solid.total_mass() / 3.0;
    while solid.time() < 0.2 {
        advance(&mut solid);
        assert!(solid.momentum().norm() < 1e-12 * scale, "{}", solid.momentum());
    }
    let speeds: [f64; 3] = std::array::from_fn(|k| mean_velocity(&solid, k)[0]);
    assert!(speeds[0] < -0.5 && speeds[1].abs() < 0.05 && speeds[2] > 0.5, "{speeds:?}");
}

#[test]
fn one_and_two_threads_give_the_same_bits() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut solid = crash::<3>(7, true);
            (0..80).for_each(|_| {
                advance(&mut solid);
            });
            format!("{:?}", solid.state())
        })
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn a_restored_state_continues_with_the_same_bits() {
    let run = |solid: &mut Solid<2>| {
        for _ in 0..30 {
            advance(solid);
        }
    };
    let mut solid = crash::<2>(7, true);
    run(&mut solid);
    let state = solid.state().clone();
    run(&mut solid);
    let mut fresh = crash::<2>(7, true);
    fresh.restore_state(state).unwrap();
    run(&mut fresh);
    assert_eq!(format!("{:?}", fresh.state()), format!("{:?}", solid.state()));
}

/// The floor's part of the contact impulses is in the reactions read in advance.
#[test]
fn reading_reactions_foretells_the_next_step() {
    let mut solid = crash::<2>(7, true);
    (0..20).for_each(|_| {
        advance(&mut solid);
    });
    let before = format!("{:?}", solid.state());
    let dt = solid.stable_time_step().unwrap().value;
    let now = solid.current_reactions(dt).unwrap();
    assert_eq!(format!("{:?}", solid.state()), before);
    solid.step(dt).unwrap();
    assert_eq!(solid.reaction(0, Vector::zeros()).0, now[0].force);
}

#[test]
fn what_contact_cannot_do_is_refused() {
    let rubber = LinearElastic { density: 1000.0, young_modulus: 1e6, poisson_ratio: 0.3 };
    let block =
        || body("block", rubber, lattice(Vector::zeros(), [4, 4], 0.05), Vector::zeros(), 0.05);
    let refused = |friction, seed| {
        let mut parameters = parameters(0.1, Vector::repeat(-0.2), [8, 8], 0.5);
        parameters.contact = Some(Contact { friction });
        Solid::new(parameters, vec![seed], Vec::new()).unwrap_err().to_string()
    };
    let message = refused(-0.1, block());
    assert!(
        message.contains("contact.friction is -0.1; it must be finite and at least 0"),
        "{message}"
    );
    let discretisation = Discretisation { frame: Frame::Total, ..Discretisation::default() };
    let message = refused(0.3, BodySeed { discretisation, ..block() });
    assert!(message.contains("body 'block'") && message.contains("Frame::Updated"), "{message}");
}
