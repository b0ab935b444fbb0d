//! Deformation and stress of eight points at a time.

use std::ops::Range;

use nalgebra::Matrix3;

use crate::lanes::{Lanes, load, load_matrices, store, store_matrices};
use crate::material::{Material, MaterialState, StepMotion};
use crate::parameters::Frame;
use crate::real::Real;
use crate::tensor::Tensor;

/// What the deformation of a run of points changes.
pub(crate) struct ConstitutiveRun<'a> {
    pub reference_volume: &'a [f64],
    pub volume: &'a mut [f64],
    pub deformation_gradient: &'a mut [Matrix3<f64>],
    pub stress: &'a mut [[f64; 6]],
    /// Empty for a law without memory.
    pub history: &'a mut [[f64; 2]],
}

/// Deformation gradient and Cauchy stress of eight points after a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Deformed {
    pub deformation_gradient: Tensor<Lanes>,
    pub stress: [Lanes; 6],
}

/// What is wrong with a point, by its place in the run.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Fault {
    NonFinite(usize),
    Inverted(usize, f64),
}

impl ConstitutiveRun<'_> {
    /// Advances up to eight points by the change of a step: H (G15) in the updated
    /// frame, the increment of F (G15b) in the total one. Both give `F_p`,
    /// `V_p = det F_p V0_p` (G18) and the stress of the law (G16, G17).
    ///
    /// `range` holds places in the run. A fault leaves the block as it was.
    #[inline(always)]
    pub fn advance<M: Material>(
        &mut self,
        law: &M,
        frame: Frame,
        range: Range<usize>,
        change: &Tensor<Lanes>,
    ) -> Result<Deformed, Fault> {
        let before = load_matrices(&self.deformation_gradient[range.clone()]);
        let motion = match frame {
            Frame::Updated => StepMotion {
                deformation_gradient: change.mul_add(&before, &before),
                step_gradient: *change,
            },
            Frame::Total => StepMotion {
                deformation_gradient: before + *change,
                step_gradient: *change * before.inverse(),
            },
        };
        let mut state = MaterialState {
            stress: load(&self.stress[range.clone()]),
            history: if M::HISTORY {
                load(&self.history[range.clone()])
            } else {
                [Lanes::splat(0.0); 2]
            },
        };
        law.update(&motion, &mut state);
        let deformed =
            Deformed { deformation_gradient: motion.deformation_gradient, stress: state.stress };
        self.accept(range.clone(), &deformed)?;
        if M::HISTORY {
            store(&state.history, &mut self.history[range]);
        }
        Ok(deformed)
    }

    /// Stores F, stress and volume of up to eight points, unless one is at fault.
    #[inline(always)]
    pub fn accept(&mut self, range: Range<usize>, deformed: &Deformed) -> Result<(), Fault> {
        let ratio = deformed.deformation_gradient.determinant();
        check(&ratio, &deformed.stress, range.len()).map_err(|fault| fault.shifted(range.start))?;
        let gradients = &mut self.deformation_gradient[range.clone()];
        store_matrices(&deformed.deformation_gradient, gradients);
        store(&deformed.stress, &mut self.stress[range.clone()]);
        let ratio = ratio.to_array();
        let volumes = self.volume[range.clone()].iter_mut().zip(&self.reference_volume[range]);
        for ((volume, reference), ratio) in volumes.zip(ratio) {
            *volume = ratio * reference;
        }
        Ok(())
    }
}

impl Fault {
    /// Place of the point in the run.
    pub fn place(self) -> usize {
        match self {
            Self::NonFinite(k) | Self::Inverted(k, _) => k,
        }
    }

    pub fn shifted(self, first: usize) -> Self {
        match self {
            Self::NonFinite(k) => Self::NonFinite(first + k),
            Self::Inverted(k, determinant) => Self::Inverted(first + k, determinant),
        }
    }
}

/// `det F > 0` and everything finite, in the first `count` lanes.
#[inline(always)]
fn check(ratio: &Lanes, stress: &[Lanes; 6], count: usize) -> Result<(), Fault> {
    let zero = Lanes::splat(0.0);
    let sum = stress.iter().fold(*ratio, |sum, component| sum + *component);
    // x · 0 is NaN for what is not finite, and a NaN is not equal to itself.
    let trouble = (sum * zero).to_array().iter().any(|x| *x != 0.0)
        || ratio.to_array().iter().any(|j| *j <= 0.0);
    if trouble { find(ratio, stress, count) } else { Ok(()) }
}

#[cold]
fn find(ratio: &Lanes, stress: &[Lanes; 6], count: usize) -> Result<(), Fault> {
    for k in 0..count {
        let determinant = ratio.lane(k);
        if determinant <= 0.0 {
            return Err(Fault::Inverted(k, determinant));
        }
        if !determinant.is_finite() || stress.iter().any(|s| !s.lane(k).is_finite()) {
            return Err(Fault::NonFinite(k));
        }
    }
    Ok(())
}
