//! Affine particle-in-cell transfer.

use nalgebra::{Matrix3, SMatrix, SVector};

use super::tpic::{moments_of, velocity_gradient};
use super::{PointTransfer, gather_velocity};
use crate::grid::{NodeRecord, VELOCITY};
use crate::shape::BodyShape;
use crate::solid::Body;
use crate::stencil::PointStencil;

/// `v_p = Σ_v v_v^L S_vp`, `B_p = Σ_v S_vp v_v^L ⊗ (x_v - x_p)`, and a point gives
/// `v_p + B_p D_p⁻¹ (x_v - x_p)` with `D_p = Σ_v S_vp (x_v - x_p) ⊗ (x_v - x_p)`
/// (Jiang, Schroeder, Selle, Teran and Stomakhin 2015; Jiang, Schroeder and Teran 2017).
///
/// The point keeps B_p, whose moments do not depend on D_p: linear and angular
/// momentum pass exactly between points and nodes (proof: 2017, section 5).
///
/// Linear weights: D_p is singular where the point lies on a node plane, and a B_p from
/// before the step has no inverse there. There `B_p D_p⁻¹ = Σ_v v_v^L ⊗ ∇S_vp` at the
/// place where B_p was found (2015, section 5.3 of the technical report), so the point
/// keeps that gradient instead: the same as TPIC. Angular momentum is then kept
/// exactly only while points do not move over the grid, as in the total frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Apic {
    linear: bool,
}

impl Apic {
    pub(crate) fn of(body: &Body) -> Self {
        let linear = matches!(body.shape, BodyShape::Linear(_)) && body.deforming.is_none();
        Self { linear }
    }
}

impl PointTransfer for Apic {
    const AFFINE: bool = true;

    #[inline(always)]
    fn gradient<const D: usize>(
        &self,
        kept: &SMatrix<f64, D, D>,
        stencil: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        if self.linear {
            return *kept;
        }
        let inverse = stencil.second_moments::<D>().try_inverse().unwrap_or_else(Matrix3::zeros);
        kept * SMatrix::from_fn(|i, j| inverse[(i, j)])
    }

    fn keep<const D: usize>(
        &self,
        gradient: &SMatrix<f64, D, D>,
        stencil: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        if self.linear { *gradient } else { moments_of(gradient, stencil) }
    }

    #[inline(always)]
    fn gather<const D: usize>(
        &self,
        stencil: &PointStencil,
        nodes: &[NodeRecord],
        _: f64,
        velocity: &mut SVector<f64, D>,
        kept: &mut SMatrix<f64, D, D>,
    ) {
        *velocity = gather_velocity(stencil, nodes);
        if self.linear {
            *kept = velocity_gradient(stencil, nodes);
            return;
        }
        *kept = SMatrix::zeros();
        for entry in stencil.entries() {
            let record = &nodes[entry.node as usize];
            for i in 0..D {
                for j in 0..D {
                    kept[(i, j)] += entry.value * record[VELOCITY + i] * entry.offset[j];
                }
            }
        }
    }

    fn moments<const D: usize>(
        &self,
        kept: &SMatrix<f64, D, D>,
        stencil: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        if self.linear { moments_of(kept, stencil) } else { *kept }
    }
}

#[cfg(test)]
mod tests {
    super::super::conformance::transfer_conformance!(
        #[test]
        apic,
        super::Apic { linear: false }
    );
    super::super::conformance::transfer_conformance!(
        #[test]
        apic_with_linear_weights,
        super::Apic { linear: true }
    );
}
