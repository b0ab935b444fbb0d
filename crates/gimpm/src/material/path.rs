//! A law at one point: stress along a prescribed path of deformation.

use super::{Material, MaterialState, StepMotion};
use crate::real::Real;
use crate::tensor::Tensor;

/// The state of a point on its path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Deformation gradient F.
    pub deformation_gradient: Tensor<f64>,
    /// Cauchy stress (Pa) `[xx, yy, zz, xy, yz, xz]`.
    pub stress: [f64; 6],
    /// History of the law, see [`MaterialState`].
    pub history: [f64; 2],
    /// Elastic energy per reference volume (J/m³).
    pub stored_energy: f64,
    /// Work since the start per reference volume, `Σ ½(P_n + P_{n+1}) : ΔF` with
    /// `P = σ cof F` (J/m³).
    pub work: f64,
}

impl PathPoint {
    /// First Piola-Kirchhoff stress (Pa), `P = σ cof F`.
    pub fn first_piola_stress(&self) -> Tensor<f64> {
        Tensor::from_symmetric(&self.stress) * self.deformation_gradient.cofactor()
    }

    /// The undeformed point of a law.
    fn start(material: &impl Material) -> Self {
        let state = MaterialState::initial();
        let deformation_gradient = Tensor::identity();
        Self {
            deformation_gradient,
            stress: state.stress,
            history: state.history,
            stored_energy: material.stored_energy(&deformation_gradient, &state),
            work: 0.0,
        }
    }

    /// The point after one step to a deformation gradient.
    fn step(&self, material: &impl Material, to: Tensor<f64>) -> Self {
        let mut state = MaterialState { stress: self.stress, history: self.history };
        advance(material, &self.deformation_gradient, &to, &mut state);
        let mut next = Self {
            deformation_gradient: to,
            stress: state.stress,
            history: state.history,
            stored_energy: material.stored_energy(&to, &state),
            work: self.work,
        };
        let mean = (self.first_piola_stress() + next.first_piola_stress()).scaled(0.5);
        next.work += mean.double_contraction(&(to - self.deformation_gradient));
        next
    }
}

/// Takes a law from one deformation gradient to the next in one step.
pub(crate) fn advance<R: Real>(
    material: &impl Material,
    from: &Tensor<R>,
    to: &Tensor<R>,
    state: &mut MaterialState<R>,
) {
    let step_gradient = (*to - *from) * from.inverse();
    material.update(&StepMotion { deformation_gradient: *to, step_gradient }, state);
}

/// Deformation gradients to go through, one a step, from the undeformed state.
#[derive(Debug, Clone, PartialEq)]
pub struct StrainPath {
    /// Deformation gradients F after each step.
    pub deformation_gradients: Vec<Tensor<f64>>,
}

impl StrainPath {
    /// Straight legs from the undeformed state through each of the given
    /// deformation gradients, `steps` a leg: a cycle, if they go back and forth.
    pub fn through(corners: &[Tensor<f64>], steps: usize) -> Self {
        let mut deformation_gradients = Vec::with_capacity(corners.len() * steps);
        let mut from = Tensor::identity();
        for corner in corners {
            let leg = *corner - from;
            deformation_gradients.extend((1..=steps).map(|k| match k {
                _ if k == steps => *corner,
                _ => from + leg.scaled(k as f64 / steps as f64),
            }));
            from = *corner;
        }
        Self { deformation_gradients }
    }

    /// Stretch along x by an engineering strain, sides held.
    pub fn uniaxial_strain(strain: f64, steps: usize) -> Self {
        Self::through(&[Tensor::diagonal([1.0 + strain, 1.0, 1.0])], steps)
    }

    /// Simple shear: x moves with y by the shear `γ = F_xy`.
    pub fn simple_shear(shear: f64, steps: usize) -> Self {
        Self::through(&[Tensor([[1.0, shear, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])], steps)
    }

    /// The same path while it turns: the k-th gradient is multiplied from the
    /// left by `rotation(k)`, k from 0.
    pub fn turned(&self, rotation: impl Fn(usize) -> Tensor<f64>) -> Self {
        let turn = |(k, f): (usize, &Tensor<f64>)| rotation(k) * *f;
        let gradients = self.deformation_gradients.iter().enumerate();
        Self { deformation_gradients: gradients.map(turn).collect() }
    }

    /// States of a law along the path: the undeformed one, then one a step.
    pub fn drive(&self, material: &impl Material) -> Vec<PathPoint> {
        let mut point = PathPoint::start(material);
        let mut points = vec![point];
        for gradient in &self.deformation_gradients {
            point = point.step(material, *gradient);
            points.push(point);
        }
        points
    }
}

/// Stretches that go in straight legs from 1 through each corner, `steps` a leg.
pub fn stretches(corners: &[f64], steps: usize) -> Vec<f64> {
    let corners: Vec<_> = corners.iter().map(|&a| Tensor::diagonal([a; 3])).collect();
    let path = StrainPath::through(&corners, steps);
    path.deformation_gradients.iter().map(|f| f.0[0][0]).collect()
}

/// No lateral stretch was found that frees the sides of stress.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "step {step}, stretch {stretch}: no lateral stretch frees the sides of stress ({residual} Pa is left); take smaller steps"
)]
pub struct FreeSideError {
    /// Number of the step, from 1.
    pub step: usize,
    /// Axial stretch asked for.
    pub stretch: f64,
    /// Lateral stress of the last attempt (Pa).
    pub residual: f64,
}

/// Which sides are free of stress.
#[derive(Clone, Copy)]
enum FreeSides {
    /// y and z, with the same stretch.
    Uniaxial,
    /// z, while x and y are stretched together.
    Biaxial,
    /// y, while z is held.
    PlaneStrain,
}

impl FreeSides {
    fn gradient(self, stretch: f64, lateral: f64) -> Tensor<f64> {
        Tensor::diagonal(match self {
            Self::Uniaxial => [stretch, lateral, lateral],
            Self::Biaxial => [stretch, stretch, lateral],
            Self::PlaneStrain => [stretch, lateral, 1.0],
        })
    }

    fn axis(self) -> usize {
        match self {
            Self::Biaxial => 2,
            Self::Uniaxial | Self::PlaneStrain => 1,
        }
    }
}

/// Uniaxial stress: stretch along x, stress-free sides.
///
/// # Errors
/// [`FreeSideError`] when the lateral stretch is not found.
pub fn uniaxial_stress(
    material: &impl Material,
    stretches: &[f64],
) -> Result<Vec<PathPoint>, FreeSideError> {
    drive_free(material, FreeSides::Uniaxial, stretches)
}

/// Equal biaxial stress: the same stretch along x and y, free along z.
///
/// # Errors
/// [`FreeSideError`] when the lateral stretch is not found.
pub fn biaxial_stress(
    material: &impl Material,
    stretches: &[f64],
) -> Result<Vec<PathPoint>, FreeSideError> {
    drive_free(material, FreeSides::Biaxial, stretches)
}

/// Plane strain tension: stretch along x, free along y, held along z.
///
/// # Errors
/// [`FreeSideError`] when the lateral stretch is not found.
pub fn plane_strain_stress(
    material: &impl Material,
    stretches: &[f64],
) -> Result<Vec<PathPoint>, FreeSideError> {
    drive_free(material, FreeSides::PlaneStrain, stretches)
}

fn drive_free(
    material: &impl Material,
    sides: FreeSides,
    stretches: &[f64],
) -> Result<Vec<PathPoint>, FreeSideError> {
    let mut point = PathPoint::start(material);
    let mut points = vec![point];
    for (k, &stretch) in stretches.iter().enumerate() {
        let attempt = |lateral| point.step(material, sides.gradient(stretch, lateral));
        let start = point.deformation_gradient.0[sides.axis()][sides.axis()];
        let scale = material.density() * material.p_wave_speed().powi(2);
        point = free_side(attempt, sides.axis(), start, 1e-12 * scale)
            .map_err(|residual| FreeSideError { step: k + 1, stretch, residual })?;
        points.push(point);
    }
    Ok(points)
}

/// Newton's method for the lateral stretch that makes a normal stress vanish,
/// with a numerical slope; halving where a kink in the law throws it out of the
/// bracket found so far. The error is the stress left.
fn free_side(
    attempt: impl Fn(f64) -> PathPoint,
    axis: usize,
    start: f64,
    tolerance: f64,
) -> Result<PathPoint, f64> {
    let (mut lateral, mut low, mut high) = (start, 0.0, f64::INFINITY);
    let mut residual = f64::NAN;
    for _ in 0..100 {
        let point = attempt(lateral);
        residual = point.stress[axis];
        if residual.abs() <= tolerance {
            return Ok(point);
        }
        // Stress grows with the stretch.
        if residual > 0.0 {
            high = lateral;
        } else {
            low = lateral;
        }
        let offset = 1e-7 * lateral;
        let slope = (attempt(lateral + offset).stress[axis] - residual) / offset;
        let newton = lateral - residual / slope;
        lateral = if newton > low && newton < high {
            newton
        } else if high.is_finite() {
            0.5 * (low + high)
        } else {
            1.5 * lateral
        };
    }
    Err(residual)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{LinearElastic, NeoHookean};

    #[test]
    fn work_is_the_energy_of_a_hyperelastic_law() {
        let law = NeoHookean { density: 1.0, young_modulus: 1.0, poisson_ratio: 0.3 };
        let shear = Tensor([[1.1, 0.8, 0.0], [0.1, 0.9, 0.2], [0.0, 0.3, 1.2]]);
        let path = StrainPath::through(&[shear, Tensor::diagonal([0.7, 1.0, 1.4])], 2000);
        let end = path.drive(&law).pop().unwrap();
        assert!((end.work / end.stored_energy - 1.0).abs() < 1e-6, "{end:?}");
    }

    #[test]
    fn sides_are_free_and_contract_by_poissons_ratio() {
        let law = LinearElastic { density: 1.0, young_modulus: 5.0, poisson_ratio: 0.25 };
        let end = uniaxial_stress(&law, &[1.0 + 1e-6]).unwrap().pop().unwrap();
        let lateral = end.deformation_gradient.0[1][1] - 1.0;
        assert!((lateral / -0.25e-6 - 1.0).abs() < 1e-5, "{lateral}");
        assert!(end.stress[1].abs() < 1e-11 && end.stress[2].abs() < 1e-11);
        let end = biaxial_stress(&law, &[1.0 + 1e-6]).unwrap().pop().unwrap();
        assert!((end.stress[0] / (5.0e-6 / 0.75) - 1.0).abs() < 1e-5, "{end:?}");
        let end = plane_strain_stress(&law, &[1.0 + 1e-6]).unwrap().pop().unwrap();
        assert!((end.stress[0] / (5.0e-6 / (1.0 - 0.0625)) - 1.0).abs() < 1e-5, "{end:?}");
    }

    #[test]
    fn what_cannot_be_reached_is_an_error() {
        let law = LinearElastic { density: 1.0, young_modulus: 1.0, poisson_ratio: 0.25 };
        let error = uniaxial_stress(&law, &[1.1, f64::NAN]).unwrap_err();
        assert_eq!(error.step, 2);
    }
}
