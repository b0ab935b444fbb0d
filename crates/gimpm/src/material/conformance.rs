//! What every constitutive law must satisfy; see
//! [`material_conformance`](crate::material_conformance).

use core::fmt::Debug;

use wide::f64x8;

use super::path::{PathPoint, StrainPath, advance};
use super::{Material, MaterialState, StepMotion};
use crate::symmetric::{double_contraction, transformed};
use crate::tensor::Tensor;

/// Strain up to which every law must be elastic.
const ELASTIC_STRAIN: f64 = 1e-5;

/// Strain that takes laws with a yield limit far beyond it.
const YIELDING_STRAIN: f64 = 4e-3;

/// Defines a function `$name` that holds a [`Material`](crate::Material) to
/// [`conformance::check`](crate::conformance::check) and panics with what it
/// violates. Write `#[test]` before the name in a test module.
#[macro_export]
macro_rules! material_conformance {
    ($(#[$attribute:meta])* $name:ident, $material:expr) => {
        $(#[$attribute])*
        fn $name() {
            let outcome = $crate::conformance::check(&$material);
            assert!(outcome.is_ok(), "{outcome:?}");
        }
    };
}

/// Checks what every law must satisfy, elastic up to a strain of 1e-5 as it must
/// be:
///
/// - its constants are valid;
/// - no motion, no change of stress;
/// - its wave speed is the slope of the stress in confined compression;
/// - the work along a small path is the stored energy (1e-4);
/// - a law whose stress is a function of F alone is hyperelastic, `P = ∂W/∂F`
///   (1e-7), and its stress turns with a superposed rotation; the stress of any
///   other law turns with a rotation after the strain (1e-12 of the stress plus
///   1e-14 of the stiffness, the round-off of F);
/// - along a path to 4e-3 the work is never below the stored energy, up to the
///   relative 4e-3 that rate laws miss, and plastic work never decreases and
///   accounts for the difference (1 % of the work);
/// - eight points at once get the numbers of eight single points (1e-13).
///
/// # Errors
/// What is violated, with its numbers.
pub fn check(material: &impl Material) -> Result<(), String> {
    material.validate().map_err(|error| error.to_string())?;
    check_rest(material)?;
    check_wave_speed(material)?;
    check_work(material)?;
    if is_function_of_deformation(material) {
        check_energy_derivative(material)?;
        check_turning(material, true)?;
    } else {
        check_turning(material, false)?;
    }
    check_dissipation(material)?;
    check_lanes(material)
}

fn require(valid: bool, what: &str, numbers: impl Debug) -> Result<(), String> {
    if valid { Ok(()) } else { Err(format!("{what}: {numbers:?}")) }
}

/// Scale of the stress at a strain of 1 (Pa).
fn stiffness(material: &impl Material) -> f64 {
    material.density() * material.p_wave_speed().powi(2)
}

fn norm(stress: &[f64; 6]) -> f64 {
    double_contraction(stress, stress).sqrt()
}

fn difference(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    norm(&core::array::from_fn(|k| a[k] - b[k]))
}

/// Deformation gradients whose displacement gradients have entries of a size in
/// all directions, the same ones every time (linear congruential generator).
fn scattered(count: usize, size: f64) -> Vec<Tensor<f64>> {
    let mut seed = 20_240_229_u64;
    let mut entry = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        size * ((seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    (0..count).map(|_| Tensor::identity() + Tensor::from_fn(|_, _| entry())).collect()
}

/// Rotation by an angle (rad) about the diagonal (Rodrigues' formula).
fn turn(angle: f64) -> Tensor<f64> {
    let a = 1.0 / 3.0_f64.sqrt();
    let spin = Tensor([[0.0, -a, a], [a, 0.0, -a], [-a, a, 0.0]]);
    let squared = spin * spin;
    Tensor::identity() + spin.scaled(angle.sin()) + squared.scaled(1.0 - angle.cos())
}

fn last(points: Vec<PathPoint>) -> Result<PathPoint, String> {
    points.last().copied().ok_or_else(|| "the path has no points".into())
}

fn check_rest(material: &impl Material) -> Result<(), String> {
    let mut state = MaterialState::<f64>::initial();
    let rest = Tensor::identity();
    require(material.stored_energy(&rest, &state) == 0.0, "energy of the undeformed state", state)?;
    advance(material, &rest, &rest, &mut state);
    require(state == MaterialState::initial(), "no motion changes the initial state", state)?;
    let end = last(StrainPath::through(&scattered(3, YIELDING_STRAIN), 100).drive(material))?;
    let mut state = MaterialState { stress: end.stress, history: end.history };
    advance(material, &end.deformation_gradient, &end.deformation_gradient, &mut state);
    let change = difference(&state.stress, &end.stress) / norm(&end.stress);
    require(change < 1e-12, "no motion changes the stress by", change)
}

fn check_wave_speed(material: &impl Material) -> Result<(), String> {
    let stress = |strain| {
        let end = last(StrainPath::uniaxial_strain(strain, 1).drive(material));
        end.map(|point| point.stress[0])
    };
    let strain = 0.1 * ELASTIC_STRAIN;
    let slope = (stress(strain)? - stress(-strain)?) / (2.0 * strain);
    let ratio = slope / stiffness(material);
    require((ratio - 1.0).abs() < 1e-7, "slope of the stress over ρ c_p² is not 1", ratio)
}

fn check_work(material: &impl Material) -> Result<(), String> {
    let corners = scattered(3, 0.2 * ELASTIC_STRAIN);
    let end = last(StrainPath::through(&corners, 200).drive(material))?;
    let ratio = end.stored_energy / end.work;
    require(end.history == [0.0; 2], "it flows below a strain of 1e-5", end.history)?;
    require(end.stored_energy > 0.0, "stored energy of a strained point", end.stored_energy)?;
    require((ratio - 1.0).abs() < 1e-4, "stored energy over work is not 1", ratio)
}

/// Whether the stress before the step does not matter.
fn is_function_of_deformation(material: &impl Material) -> bool {
    let rest = Tensor::identity();
    let mut state = MaterialState::initial();
    state.stress[3] = 1e-9 * stiffness(material);
    advance(material, &rest, &rest, &mut state);
    state.stress[3] == 0.0
}

fn check_energy_derivative(material: &impl Material) -> Result<(), String> {
    for gradient in scattered(8, 0.2) {
        let path = StrainPath { deformation_gradients: vec![gradient] };
        let piola = last(path.drive(material))?.first_piola_stress();
        let state = MaterialState::initial();
        let step = 1e-5;
        let slope = Tensor::from_fn(|i, j| {
            let energy = |offset: f64| {
                let mut moved = gradient;
                moved.0[i][j] += offset;
                material.stored_energy(&moved, &state)
            };
            (energy(step) - energy(-step)) / (2.0 * step)
        });
        let miss = piola - slope;
        let relative = (miss.double_contraction(&miss) / piola.double_contraction(&piola)).sqrt();
        require(relative < 1e-7, "P is not the derivative of the energy", (relative, gradient))?;
    }
    Ok(())
}

/// Stress on a path that turns as a whole, or (a rate law) after its strain.
fn check_turning(material: &impl Material, as_a_whole: bool) -> Result<(), String> {
    let size = if as_a_whole { 0.1 } else { YIELDING_STRAIN };
    let path = StrainPath::through(&scattered(3, size), 50);
    let still = last(path.drive(material))?;
    let angle = 2.0;
    let turned = if as_a_whole {
        let steps = path.deformation_gradients.len() as f64;
        path.turned(|k| turn(angle * (k + 1) as f64 / steps))
    } else {
        let strained = still.deformation_gradient;
        let mut gradients = path.deformation_gradients;
        gradients.extend((1..=4).map(|k| turn(0.25 * angle * f64::from(k)) * strained));
        StrainPath { deformation_gradients: gradients }
    };
    let end = last(turned.drive(material))?;
    let expected = transformed(&still.stress, &turn(angle));
    // The round-off of F is a strain of its own.
    let allowed = 1e-12 * norm(&expected) + 1e-14 * stiffness(material);
    let ratio = difference(&end.stress, &expected) / allowed;
    require(ratio < 1.0, "the stress does not turn with the point, error over allowed", ratio)?;
    let energy = end.stored_energy / still.stored_energy;
    require((energy - 1.0).abs() < 1e-11, "a rotation changes the energy by the factor", energy)
}

fn check_dissipation(material: &impl Material) -> Result<(), String> {
    let path = StrainPath::through(&scattered(6, YIELDING_STRAIN), 400).drive(material);
    let mut largest = 0.0_f64;
    for (k, pair) in path.windows(2).enumerate() {
        let (before, after) = (&pair[0], &pair[1]);
        largest = largest.max(after.stored_energy);
        let flow = (after.history[1] - before.history[1], after.history[0] - before.history[0]);
        require(flow.0 >= 0.0 && flow.1 >= 0.0, "plastic work or strain decreases", (k, flow))?;
        let dissipated = after.work - after.stored_energy;
        let allowed = -YIELDING_STRAIN * largest;
        require(dissipated >= allowed, "energy from nothing", (k, dissipated, largest))?;
        let unaccounted = dissipated - after.history[1];
        let allowed = 1e-2 * after.work.max(largest);
        let numbers = (k, unaccounted, after.work);
        require(unaccounted.abs() <= allowed, "work that is neither stored nor plastic", numbers)?;
    }
    Ok(())
}

fn check_lanes(material: &impl Material) -> Result<(), String> {
    let paths: [StrainPath; 8] = core::array::from_fn(|lane| {
        let size = YIELDING_STRAIN * (0.01 + lane as f64 / 7.0);
        StrainPath::through(&scattered(3, size), 20)
    });
    let singles: [Vec<PathPoint>; 8] = core::array::from_fn(|lane| paths[lane].drive(material));
    let gradient = |k: usize| {
        let of_lane = |lane: usize| &singles[lane][k].deformation_gradient;
        Tensor::from_fn(|i, j| {
            f64x8::from(core::array::from_fn::<f64, 8, _>(|lane| of_lane(lane).0[i][j]))
        })
    };
    let mut state = MaterialState::<f64x8>::initial();
    for k in 1..singles[0].len() {
        let (from, to) = (gradient(k - 1), gradient(k));
        let motion =
            StepMotion { deformation_gradient: to, step_gradient: (to - from) * from.inverse() };
        material.update(&motion, &mut state);
        let energy = material.stored_energy(&to, &state).to_array();
        for (lane, single) in singles.iter().enumerate() {
            let single = &single[k];
            let stress = state.stress.map(|s| s.to_array()[lane]);
            let scale = norm(&single.stress).max(1e-3 * YIELDING_STRAIN * stiffness(material));
            let relative = difference(&stress, &single.stress) / scale;
            require(
                relative < 1e-13,
                "a lane's stress differs from its point's",
                (lane, relative),
            )?;
            let history = state.history.map(|h| h.to_array()[lane]);
            for (together, alone) in history
                .into_iter()
                .chain([energy[lane]])
                .zip(single.history.into_iter().chain([single.stored_energy]))
            {
                let close = (together - alone).abs() <= 1e-12 * alone.abs();
                require(close, "a lane's history or energy differs", (lane, together, alone))?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{LinearElastic, MaterialError, NeoHookean, VonMises};
    use crate::real::Real;

    /// A law with one thing wrong.
    struct Broken<M> {
        law: M,
        fault: Fault,
    }

    #[derive(Clone, Copy, PartialEq)]
    enum Fault {
        Nothing,
        WaveSpeed,
        Energy,
        Residue,
        NoRotation,
        FreePlasticWork,
        FirstLane,
    }

    impl<M: Material> Material for Broken<M> {
        fn density(&self) -> f64 {
            self.law.density()
        }
        fn p_wave_speed(&self) -> f64 {
            let factor = if self.fault == Fault::WaveSpeed { 1.0 + 1e-6 } else { 1.0 };
            self.law.p_wave_speed() * factor
        }
        fn update<R: Real>(&self, motion: &StepMotion<R>, state: &mut MaterialState<R>) {
            let mut motion = *motion;
            if self.fault == Fault::NoRotation {
                motion.step_gradient = Tensor::from_symmetric(&motion.step_gradient.symmetric());
            }
            self.law.update(&motion, state);
            if self.fault == Fault::Residue {
                state.stress[0] += R::splat(1e-6);
            }
            if self.fault == Fault::FreePlasticWork {
                state.history[1] = state.history[1] * 0.9;
            }
            if self.fault == Fault::FirstLane {
                state.stress = state.stress.map(|s| R::splat(s.lane(0)));
            }
        }
        fn stored_energy<R: Real>(&self, f: &Tensor<R>, state: &MaterialState<R>) -> R {
            let factor = if self.fault == Fault::Energy { 1.001 } else { 1.0 };
            self.law.stored_energy(f, state) * factor
        }
        fn validate(&self) -> Result<(), MaterialError> {
            self.law.validate()
        }
    }

    fn assert_refused(law: impl Material + Copy, faults: &[(Fault, &str)]) {
        assert_eq!(check(&Broken { law, fault: Fault::Nothing }), Ok(()));
        for &(fault, reason) in faults {
            let message = check(&Broken { law, fault }).unwrap_err();
            assert!(message.contains(reason), "{message}");
        }
    }

    #[test]
    fn a_broken_law_is_refused() {
        let (density, young_modulus, poisson_ratio) = (1000.0, 1.0e9, 0.3);
        let common = [
            (Fault::WaveSpeed, "slope of the stress"),
            (Fault::Energy, "stored energy over work"),
            (Fault::Residue, "no motion changes"),
            (Fault::FirstLane, "a lane's stress"),
        ];
        assert_refused(NeoHookean { density, young_modulus, poisson_ratio }, &common);
        let rate = LinearElastic { density, young_modulus, poisson_ratio };
        assert_refused(rate, &common);
        assert_refused(rate, &[(Fault::NoRotation, "does not turn with the point")]);
        let (yield_stress, hardening_modulus) = (1.0e6, 1.0e7);
        let plastic =
            VonMises { density, young_modulus, poisson_ratio, yield_stress, hardening_modulus };
        assert_refused(plastic, &common);
        assert_refused(plastic, &[(Fault::FreePlasticWork, "stored nor plastic")]);
        let invalid = NeoHookean { density, young_modulus, poisson_ratio: 0.5 };
        assert!(check(&invalid).unwrap_err().contains("poisson_ratio"));
    }
}
