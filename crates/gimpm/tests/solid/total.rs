//! The total Lagrangian frame: its vector loops against the plain ones, and the
//! same bits for any thread count and after a restart.

use crate::lattice::{lattice, parameters, planes};
use crate::noise::noise;
use gimpm::{
    BodySeed, Discretisation, DruckerPrager, Frame, Hold, InitialVelocity, LinearElastic, Loops,
    MaterialModel, NeoHookean, NodeConstraint, Solid, SolidState, StressUpdate, VonMises,
};
use motion::Motion;
use nalgebra::SVector;

const H: f64 = 0.1;

const SOFT: LinearElastic =
    LinearElastic { density: 1200.0, young_modulus: 2.0e6, poisson_ratio: 0.3 };

fn laws() -> [MaterialModel; 3] {
    let (density, young_modulus, poisson_ratio) = (1200.0, 2.0e6, 0.3);
    [
        SOFT.into(),
        NeoHookean { density, young_modulus, poisson_ratio }.into(),
        VonMises {
            density,
            young_modulus,
            poisson_ratio,
            yield_stress: 2.0e3,
            hardening_modulus: 1.0e5,
        }
        .into(),
    ]
}

/// What a block is made of.
#[derive(Clone)]
struct Case {
    material: MaterialModel,
    /// Points an axis of a cell.
    per_axis: usize,
    loops: Loops,
    stress_update: StressUpdate,
    held: bool,
    mean_dilatation: bool,
}

impl Case {
    fn new(material: impl Into<MaterialModel>) -> Self {
        Self {
            material: material.into(),
            per_axis: 2,
            loops: Loops::Fast,
            stress_update: StressUpdate::ModifiedLast,
            held: true,
            mean_dilatation: false,
        }
    }

    /// A ball cut from a lattice, whose boundary cells are filled in part, with a
    /// rough velocity, gravity and, if held, a foot in a clamp and a plate that
    /// presses; its points come in disorder.
    fn ball<const D: usize>(&self) -> Solid<D> {
        let spacing = H / self.per_axis as f64;
        let mut random = noise(7);
        let mut points: Vec<SVector<f64, D>> =
            lattice(SVector::zeros(), [7 * self.per_axis; D], spacing)
                .into_iter()
                .filter(|x| (x - SVector::repeat(0.37)).norm() < 0.36)
                .collect();
        for k in (1..points.len()).rev() {
            let other = ((0.5 + 0.5 * random()) * k as f64) as usize;
            points.swap(k, other.min(k));
        }
        let velocity = points.iter().map(|x| x.map(|_| 0.5 * random())).collect();
        let body = BodySeed {
            name: "ball".into(),
            material: self.material.clone(),
            points,
            velocity: InitialVelocity::PerPoint(velocity),
            point_spacing: spacing,
            discretisation: Discretisation {
                frame: Frame::Total,
                mean_dilatation: self.mean_dilatation,
                ..Discretisation::default()
            },
        };
        let mut parameters = parameters(H, SVector::repeat(-0.2), [11; D], 0.4);
        parameters.loops = self.loops;
        parameters.stress_update = self.stress_update;
        parameters.gravity = SVector::from_fn(|d, _| [1.0, -9.81, 3.0][d]);
        let fixed: [Option<Motion>; D] = std::array::from_fn(|_| Some(Motion::Fixed));
        let mut pressed: [Option<Motion>; D] = std::array::from_fn(|_| None);
        pressed[0] = Some(Motion::SmoothStart { velocity: -0.5, duration: 0.01 });
        let mut constraints = vec![
            planes("foot", D - 1, f64::NEG_INFINITY, 0.1, fixed),
            planes("plate", 0, 0.7, f64::INFINITY, pressed),
            NodeConstraint {
                name: "support".into(),
                body: 0,
                lower: SVector::repeat(-1.0),
                upper: SVector::from_fn(|d, _| if d == 1 { 0.2 } else { 0.45 }),
                hold: Hold::Normal {
                    direction: SVector::from_fn(|d, _| if d == 1 { 1.0 } else { 0.3 }),
                    motion: Motion::Fixed,
                    one_sided: true,
                },
            },
        ];
        if !self.held {
            constraints.clear();
        }
        Solid::new(parameters, vec![body], constraints).unwrap()
    }
}

fn step<const D: usize>(solid: &mut Solid<D>, steps: usize, dt: f64) {
    for _ in 0..steps {
        let force: Vec<SVector<f64, D>> =
            solid.points().id.iter().map(|id| SVector::repeat(f64::from(*id % 7) * 1e-2)).collect();
        solid.scatter_point_force(&force);
        solid.step(dt).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
    }
}

/// Largest differences of position, velocity, F and stress, over their size.
fn difference<const D: usize>(a: &Solid<D>, b: &Solid<D>) -> f64 {
    let (p, q) = (a.points(), b.points());
    assert_eq!(p.id, q.id);
    let mut error = [0.0_f64; 5];
    let mut size = [0.0_f64; 5];
    let mut compare = |k: usize, x: &[f64], y: &[f64]| {
        for (x, y) in x.iter().zip(y) {
            error[k] = error[k].max((x - y).abs());
            size[k] = size[k].max(y.abs());
        }
    };
    for k in 0..p.len() {
        compare(0, p.position[k].as_slice(), q.position[k].as_slice());
        compare(1, p.velocity[k].as_slice(), q.velocity[k].as_slice());
        let (f, g) = (p.deformation_gradient[k], q.deformation_gradient[k]);
        compare(2, f.as_slice(), g.as_slice());
        compare(3, &p.stress[k], &q.stress[k]);
        compare(4, &[p.volume[k]], &[q.volume[k]]);
    }
    (0..5).map(|k| error[k] / size[k]).fold(0.0, f64::max)
}

fn against_plain<const D: usize>(case: &Case) -> f64 {
    let mut fast = case.ball::<D>();
    let mut plain = Case { loops: Loops::Plain, ..case.clone() }.ball::<D>();
    let dt = 0.8 * fast.stable_time_step().unwrap().value;
    step(&mut fast, 25, dt);
    step(&mut plain, 25, dt);
    let moved = fast.points().stress.iter().flatten().fold(0.0_f64, |a, s| a.max(s.abs()));
    assert!(moved > 1e3, "the test strains the ball: {moved}");
    let (a, b) = (fast.state(), plain.state());
    assert!((a.maximum_speed / b.maximum_speed - 1.0).abs() < 1e-12);
    for (a, b) in a.reactions.iter().zip(&b.reactions) {
        assert!((a.force - b.force).norm() <= 1e-11 * b.force.norm(), "{a:?} {b:?}");
    }
    assert!((fast.energy().strain / plain.energy().strain - 1.0).abs() < 1e-11);
    difference(&fast, &plain)
}

#[test]
fn vector_loops_agree_with_the_plain_ones() {
    for per_axis in [1, 2, 3] {
        for material in laws() {
            let case = Case { per_axis, ..Case::new(material) };
            let errors = [against_plain::<2>(&case), against_plain::<3>(&case)];
            println!("{per_axis} points an axis, 2D and 3D: {errors:?}");
            assert!(errors.iter().all(|error| *error < 1e-12), "{errors:?}");
        }
    }
    for stress_update in [StressUpdate::First, StressUpdate::Last] {
        for held in [true, false] {
            let case = Case { stress_update, held, ..Case::new(SOFT) };
            let errors = [against_plain::<2>(&case), against_plain::<3>(&case)];
            assert!(errors.iter().all(|error| *error < 1e-12), "{errors:?}");
        }
    }
}

/// Bits, not values: `-0.0` and `0.0` differ.
fn bits(state: &SolidState<3>) -> String {
    format!("{state:?}")
}

fn variants() -> Vec<Case> {
    let [elastic, rubber, metal] = laws();
    let concrete = DruckerPrager::concrete(1200.0, 2.0e6, 0.3, 5.0e3, 1.0e3);
    vec![
        Case { per_axis: 3, ..Case::new(elastic.clone()) },
        Case { stress_update: StressUpdate::First, ..Case::new(elastic) },
        Case { mean_dilatation: true, ..Case::new(rubber) },
        Case { mean_dilatation: true, per_axis: 3, ..Case::new(metal) },
        Case::new(concrete),
    ]
}

#[test]
fn any_thread_count_gives_the_same_bits() {
    for case in variants() {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut solid = case.ball::<3>();
                let dt = 0.8 * solid.stable_time_step().unwrap().value;
                step(&mut solid, 15, dt);
                bits(solid.state())
            })
        };
        let one = with(1);
        assert!(one == with(2) && one == with(7));
    }
}

#[test]
fn a_restored_state_continues_with_the_same_bits() {
    for case in variants() {
        let mut solid = case.ball::<3>();
        let dt = 0.8 * solid.stable_time_step().unwrap().value;
        step(&mut solid, 7, dt);
        let checkpoint = solid.state().clone();
        solid.save();
        step(&mut solid, 9, dt);
        let expected = bits(solid.state());

        solid.restore();
        step(&mut solid, 9, dt);
        assert!(bits(solid.state()) == expected, "save and restore");

        solid.restore();
        solid.sort_points();
        assert!(bits(solid.state()) == bits(&checkpoint), "sorting again changes nothing");
        step(&mut solid, 9, dt);
        assert!(bits(solid.state()) == expected, "sorted in between");

        let mut fresh = case.ball::<3>();
        step(&mut fresh, 3, dt);
        fresh.restore_state(checkpoint.clone()).unwrap();
        let now = fresh.current_reactions(dt).unwrap();
        assert!(bits(fresh.state()) == bits(&checkpoint), "reading reactions changes nothing");
        fresh.step(dt).unwrap();
        if case.stress_update != StressUpdate::First {
            assert_eq!(fresh.reaction(0, SVector::zeros()).0, now[0].force);
        }
        fresh.restore_state(checkpoint).unwrap();
        step(&mut fresh, 9, dt);
        assert!(bits(fresh.state()) == expected, "checkpoint in a new solid");
    }
}

/// Momentum changes by gravity, loads and reactions, and by nothing without them.
#[test]
fn momentum_is_balanced() {
    fn residual<const D: usize>(case: &Case) -> f64 {
        let mut solid = case.ball::<D>();
        let dt = 0.8 * solid.stable_time_step().unwrap().value;
        let mut worst: f64 = 0.0;
        for _ in 0..20 {
            let load = SVector::<f64, D>::repeat(2e-2);
            let count = solid.points().len();
            solid.scatter_point_force(&vec![load; count]);
            let before = solid.momentum();
            solid.step(dt).unwrap();
            let mut given = solid.parameters().gravity * solid.total_mass() + load * count as f64;
            for constraint in 0..solid.constraint_names().len() {
                given += solid.reaction(constraint, SVector::zeros()).0;
            }
            let points = solid.points();
            let scale: f64 = (0..count).map(|p| points.mass[p] * points.velocity[p].norm()).sum();
            worst = worst.max((solid.momentum() - before - given * dt).norm() / scale);
        }
        worst
    }
    for held in [false, true] {
        for mean_dilatation in [false, true] {
            let case = Case { held, mean_dilatation, per_axis: 3, ..Case::new(SOFT) };
            let errors = [residual::<2>(&case), residual::<3>(&case)];
            println!("held {held}, mean dilatation {mean_dilatation}: {errors:?}");
            assert!(errors.iter().all(|error| *error < 1e-12), "{errors:?}");
        }
    }
}
