//! The total Lagrangian frame against finite elements, exact states and locking.

use crate::lattice::{CONCRETE, at_rest, lattice, parameters, planes};
use crate::pressed_block::{H, HEIGHT, difference, octant, pressed_block, references};
use gimpm::{
    BodySeed, Discretisation, Frame, LinearElastic, Material, MaterialModel, NeoHookean,
    NodeConstraint, Solid, SolidError, Transfer,
};
use motion::Motion;
use nalgebra::{Matrix3, SVector};

fn total() -> Discretisation {
    Discretisation { frame: Frame::Total, ..Discretisation::default() }
}

fn seed<const D: usize>(
    material: impl Into<MaterialModel>,
    cells: [usize; D],
    discretisation: Discretisation,
) -> BodySeed<D> {
    BodySeed {
        name: "block".into(),
        material: material.into(),
        points: lattice(SVector::zeros(), cells.map(|n| 2 * n), 0.5 * H),
        velocity: at_rest(),
        point_spacing: 0.5 * H,
        discretisation,
    }
}

/// The clamp sits on material nodes, so the result may not depend on the
/// displacement. The references are those of small strain; at a strain ε the force of
/// a bar of this law is `E ln(1-ε)` on an area grown by `2νε`: `1 + (½ + 2ν) ε` times as
/// large to first order (4.5e-4 at the largest displacement), which is taken out.
#[test]
fn end_clamped_block_agrees_with_finite_elements_at_any_displacement() {
    let (limit, fem) = references();
    for cells_of_displacement in [1e-4, 1e-3, 1e-2] {
        let press = cells_of_displacement * H;
        let (mut solid, dt) = pressed_block([10, 10, 20], press, false, total());
        let found = octant(&solid, press / HEIGHT);
        let to_limit = difference(&found, &limit, |_, _, _| true);
        let all = difference(&found, &fem, |_, _, _| true);
        let no_edges = difference(&found, &fem, |i, j, k| k > 0 || (i > 0 && j > 0));
        let inside = difference(&found, &fem, |_, _, k| k > 0);
        let scale = CONCRETE.young_modulus * press / HEIGHT;
        let reactions = solid.current_reactions(dt).unwrap();
        let (bottom, top) = (reactions[0].force[2] / scale, -reactions[1].force[2] / scale);
        let larger = 1.0 + (0.5 + 2.0 * CONCRETE.poisson_ratio) * press / HEIGHT;
        let reaction = 0.5 * (bottom + top) / larger;
        println!(
            "displacement {cells_of_displacement} h: against the limit {:.4} %; against FEM {:.4} / {:.4} / {:.4} % (all, without end edges, without end layers); reaction at small strain {reaction:.6} ({:+.4} % off 1.0127638), as found {top:.6} top, {bottom:.6} bottom",
            100.0 * to_limit,
            100.0 * all,
            100.0 * no_edges,
            100.0 * inside,
            100.0 * (reaction / 1.012_763_8 - 1.0),
        );
        assert!(to_limit < 5e-4, "{to_limit}");
        assert!(all < 4.5e-3, "{all}");
        assert!(no_edges < 3.5e-3, "{no_edges}");
        assert!(inside < 2.8e-3, "{inside}");
        assert!((reaction / 1.012_763_8 - 1.0).abs() < 1e-3, "{reaction}");
    }
}

/// Steps until `error` is below `tolerance`, at most a million times.
fn settle<const D: usize>(
    solid: &mut Solid<D>,
    tolerance: f64,
    error: impl Fn(&Solid<D>) -> f64,
) -> f64 {
    let dt = 0.9 * solid.stable_time_step().unwrap().value;
    for k in 0..1_000_000 {
        if k % 100 == 0 && error(solid) < tolerance {
            break;
        }
        solid.step(dt).unwrap();
    }
    error(solid)
}

/// Motion by `distance` over `duration`, then rest.
fn then_rest(distance: f64, duration: f64) -> Motion {
    Motion::Table { rows: vec![(0.0, 0.0), (duration, distance)] }
}

/// `σzz = (λ+2μ) ε`, 1.1111 E ε for ν = 0.2. The law is linear between the rates of
/// Cauchy stress and logarithmic strain, `σ = (λ+2μ) ln(1+ε)`, so ε is the logarithmic
/// strain, which the sum of the steps' mid-step strains is to the third order of the
/// step. Local damping takes the waves away; it does not act at rest.
#[test]
fn confined_block_has_the_p_wave_modulus() {
    for cells_of_displacement in [1e-4, 1e-2] {
        let press = cells_of_displacement * H;
        let fixed = || Some(Motion::Fixed);
        let (infinity, duration) = (f64::INFINITY, HEIGHT / CONCRETE.p_wave_speed());
        let constraints = vec![
            planes("sides", 2, -infinity, infinity, [fixed(), fixed(), None]),
            planes("bottom", 2, -infinity, 0.0, [None, None, fixed()]),
            planes("top", 2, HEIGHT, infinity, [None, None, Some(then_rest(-press, duration))]),
        ];
        let mut parameters = parameters(H, SVector::zeros(), [2, 2, 20], 0.5);
        parameters.damping = 0.3;
        let block = seed(CONCRETE, [2, 2, 20], total());
        let mut solid = Solid::new(parameters, vec![block], constraints).unwrap();
        let strain = (-press / HEIGHT).ln_1p();
        let ratio = |s: &[f64; 6]| s[2] / (strain * CONCRETE.young_modulus);
        let worst = settle(&mut solid, 5e-10, |solid| {
            let off = solid.points().stress.iter().map(|s| (0.9 * ratio(s) - 1.0).abs());
            off.fold(0.0, f64::max)
        });
        println!(
            "confined, displacement {cells_of_displacement} h: σzz/(E ε) 1.1111 to {worst:.1e}"
        );
        assert!(worst < 1e-9, "{worst}");
    }
}

/// At 50 % stretch, in full motion: the displacement that the points next to a face
/// extrapolate to it is the clamp's, and every column of points is as much longer as
/// the clamps are further apart.
#[test]
fn clamped_faces_are_exact_at_any_displacement() {
    let soft = NeoHookean { density: 1000.0, young_modulus: 1.0e6, poisson_ratio: 0.3 };
    let (cells, length) = ([2, 2, 10], 1.0);
    let duration = 2.0 * length / soft.p_wave_speed();
    let fixed = || Some(Motion::Fixed);
    let motion = then_rest(0.5 * length, duration);
    let constraints = vec![
        planes("bottom", 2, f64::NEG_INFINITY, 0.0, [fixed(), fixed(), fixed()]),
        planes("top", 2, length, f64::INFINITY, [fixed(), fixed(), Some(motion.clone())]),
    ];
    let parameters = parameters(H, SVector::zeros(), cells, 0.3);
    let mut solid = Solid::new(parameters, vec![seed(soft, cells, total())], constraints).unwrap();
    let (mut faces, mut columns) = (0.0_f64, 0.0_f64);
    while solid.time() < 1.5 * duration {
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
        let plate = SVector::from([0.0, 0.0, motion.displacement(solid.time())]);
        let points = solid.points();
        let at = |id: usize| solid.point_index(id as u32).unwrap();
        let moved = |id: usize| points.position[at(id)] - points.reference_position[at(id)];
        for column in 0..16 {
            let id = |layer: usize| column + 16 * layer;
            let bottom = moved(id(0)) * 1.5 - moved(id(1)) * 0.5;
            let top = moved(id(19)) * 1.5 - moved(id(18)) * 0.5;
            faces = faces.max(bottom.norm()).max((top - plate).norm());
            let mut stretch = SVector::<f64, 3>::zeros();
            for layer in 0..20 {
                stretch += points.deformation_gradient[at(id(layer))].column(2) * (0.05 / length);
            }
            let expected = SVector::from([0.0, 0.0, 1.0]) + plate / length;
            columns = columns.max((stretch - expected).norm());
        }
    }
    let largest = solid.points().deformation_gradient.iter().map(|f| f[(2, 2)]).fold(0.0, f64::max);
    println!("faces off by {faces:.1e} m, columns by {columns:.1e}; largest stretch {largest:.3}");
    assert!(largest > 1.5);
    assert!(faces < 1e-12 && columns < 1e-12);
}

/// Patch test: rollers on all six faces stretch a cube by 20, 5 and -10 %; inside, the
/// deformation must be the same everywhere and the stress that of the law,
/// `σ = (μ (b - I) + λ ln J I)/J`.
#[test]
fn patch_at_finite_stretch_is_uniform() {
    let (young_modulus, poisson_ratio) = (1.0e6, 0.3);
    let soft = NeoHookean { density: 1000.0, young_modulus, poisson_ratio };
    let lambda =
        young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
    let mu = young_modulus / (2.0 * (1.0 + poisson_ratio));
    let stretch = [1.2, 1.05, 0.9_f64];
    let exact = Matrix3::from_diagonal(&SVector::from(stretch));
    let logarithm: f64 = stretch.iter().map(|a| a.ln()).sum();
    let volume: f64 = stretch.iter().product();
    for mean_dilatation in [false, true] {
        let duration = 0.4 / soft.p_wave_speed();
        let mut constraints: Vec<NodeConstraint<3>> = Vec::new();
        for axis in 0..3 {
            let only =
                |motion: Motion| std::array::from_fn(|d| (d == axis).then(|| motion.clone()));
            let moved = then_rest(0.4 * (stretch[axis] - 1.0), duration);
            constraints.push(planes("lower", axis, f64::NEG_INFINITY, 0.0, only(Motion::Fixed)));
            constraints.push(planes("upper", axis, 0.4, f64::INFINITY, only(moved)));
        }
        let mut parameters = parameters(H, SVector::zeros(), [4; 3], 0.3);
        parameters.damping = 0.3;
        let discretisation = Discretisation { mean_dilatation, ..total() };
        let block = seed(soft, [4; 3], discretisation);
        let mut solid = Solid::new(parameters, vec![block], constraints).unwrap();
        let worst = settle(&mut solid, 1e-11, |solid| {
            let gradients = solid.points().deformation_gradient.iter();
            gradients.map(|f| (f - exact).norm()).fold(0.0, f64::max)
        });
        let mut off: f64 = 0.0;
        for stress in &solid.points().stress {
            for d in 0..3 {
                let expected = (mu * (stretch[d] * stretch[d] - 1.0) + lambda * logarithm) / volume;
                off = off.max((stress[d] - expected).abs() / young_modulus);
            }
        }
        println!(
            "patch, mean dilatation {mean_dilatation}: F off by {worst:.1e}, stress {off:.1e}"
        );
        assert!(worst < 1e-10 && off < 1e-10);
    }
}

/// Stiffness of a cantilever in plane strain, four cells thick and four times as long,
/// over that of Timoshenko's beam, `1/(L³/(3E'I) + L/(⅚ μ t))` with `E' = E/(1-ν²)`:
/// twice the energy over the square of the deflection.
fn cantilever(material: MaterialModel, poisson_ratio: f64, mean_dilatation: bool) -> f64 {
    let (young_modulus, cells) = (1.0e6, 4);
    let (thickness, length) = (cells as f64 * H, 4.0 * cells as f64 * H);
    let bending = young_modulus / (1.0 - poisson_ratio * poisson_ratio) * thickness.powi(3) / 12.0;
    let shear = young_modulus / (2.0 * (1.0 + poisson_ratio)) * thickness * 5.0 / 6.0;
    let beam = 1.0 / (length.powi(3) / (3.0 * bending) + length / shear);
    let deflection = 1e-3 * length;
    // The first period of the beam is 1.8 L²/t √(12ρ/E').
    let duration = 1.8 * length * length / thickness * (12.0 * 1000.0 / 1.33e6_f64).sqrt();
    let fixed = || Some(Motion::Fixed);
    let moved = Motion::Table { rows: vec![(0.0, 0.0), (0.5 * duration, deflection)] };
    let constraints = vec![
        planes("root", 0, f64::NEG_INFINITY, 0.0, [fixed(), fixed()]),
        planes("tip", 0, length, f64::INFINITY, [None, Some(moved)]),
    ];
    let mut parameters = parameters(H, SVector::zeros(), [4 * cells, cells], 0.7);
    parameters.damping = 0.5;
    let discretisation = Discretisation { mean_dilatation, ..total() };
    let beam_seed = seed(material, [4 * cells, cells], discretisation);
    let mut solid = Solid::new(parameters, vec![beam_seed], constraints).unwrap();
    while solid.time() < 2.0 * duration {
        solid.step(0.99 * solid.stable_time_step().unwrap().value).unwrap();
    }
    // Not from the reaction: local damping acts on the held nodes' forces too.
    let energy = solid.energy();
    assert!(energy.kinetic < 1e-4 * energy.strain, "at rest: {energy:?}");
    2.0 * energy.strain / (deflection * deflection * beam)
}

/// Four cells through the thickness and no locking are 2.8 % too stiff at ν = 0.3
/// against the beam.
#[test]
fn mean_dilatation_unlocks_a_nearly_incompressible_beam() {
    let (density, young_modulus) = (1000.0, 1.0e6);
    let elastic = |poisson_ratio| LinearElastic { density, young_modulus, poisson_ratio }.into();
    let rubber = |poisson_ratio| NeoHookean { density, young_modulus, poisson_ratio }.into();
    let compressible = cantilever(rubber(0.3), 0.3, false);
    println!("stiffness over the beam's, ν 0.3: {compressible:.4}");
    assert!((compressible - 1.0).abs() < 0.04);
    for (name, law) in [("linear elastic", elastic(0.4999)), ("neo-Hookean", rubber(0.4999))] {
        let law: MaterialModel = law;
        let locked = cantilever(law.clone(), 0.4999, false);
        let free = cantilever(law, 0.4999, true);
        println!("{name}, ν 0.4999: {locked:.2} locked, {free:.4} with mean dilatation");
        assert!(locked > 3.0, "{locked}");
        assert!((free - 1.0).abs() < 0.06, "{free}");
    }
}

#[test]
fn mean_dilatation_is_refused_where_there_is_none() {
    for discretisation in [
        Discretisation { mean_dilatation: true, ..Discretisation::default() },
        Discretisation { mean_dilatation: true, transfer: Transfer::Apic, ..total() },
    ] {
        let parameters = parameters(H, SVector::repeat(-0.2), [8; 2], 0.5);
        let block = seed(CONCRETE, [2, 2], discretisation);
        let error = Solid::new(parameters, vec![block], Vec::new()).unwrap_err();
        assert!(matches!(error, SolidError::Body { .. }));
        assert!(error.to_string().contains("mean_dilatation needs Frame::Total"), "{error}");
    }
}
