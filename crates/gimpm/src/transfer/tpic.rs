//! Taylor particle-in-cell transfer.

use nalgebra::{SMatrix, SVector};

use super::{PointTransfer, gather_velocity};
use crate::grid::{NodeRecord, VELOCITY};
use crate::stencil::PointStencil;

/// `v_p = Σ_v v_v^L S_vp`, `C_p = Σ_v v_v^L ⊗ ∇S_vp`, and a point gives
/// `v_p + C_p (x_v - x_p)` (Nakamura, Matsumura and Mizutani 2023, CMAME 403).
///
/// An affine field survives the way to the nodes and back exactly, at the surface
/// too. The angular momentum of the nodes is kept only where C_p has the moments of
/// the nodal velocities: for linear weights whose points stay where they are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tpic;

/// `Σ_v v_v^L ⊗ ∇S_vp` (1/s).
#[inline(always)]
pub(super) fn velocity_gradient<const D: usize>(
    stencil: &PointStencil,
    nodes: &[NodeRecord],
) -> SMatrix<f64, D, D> {
    let mut gradient = SMatrix::zeros();
    for entry in stencil.entries() {
        let record = &nodes[entry.node as usize];
        for i in 0..D {
            for j in 0..D {
                gradient[(i, j)] += record[VELOCITY + i] * entry.gradient[j];
            }
        }
    }
    gradient
}

/// `C D_p`, the first moments of an affine velocity about the point.
pub(super) fn moments_of<const D: usize>(
    gradient: &SMatrix<f64, D, D>,
    stencil: &PointStencil,
) -> SMatrix<f64, D, D> {
    let second = stencil.second_moments::<D>();
    gradient * SMatrix::from_fn(|i, j| second[(i, j)])
}

impl PointTransfer for Tpic {
    const AFFINE: bool = true;

    #[inline(always)]
    fn gradient<const D: usize>(
        &self,
        kept: &SMatrix<f64, D, D>,
        _: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        *kept
    }

    fn keep<const D: usize>(
        &self,
        gradient: &SMatrix<f64, D, D>,
        _: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        *gradient
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
        *kept = velocity_gradient(stencil, nodes);
    }

    fn moments<const D: usize>(
        &self,
        kept: &SMatrix<f64, D, D>,
        stencil: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        moments_of(kept, stencil)
    }
}

#[cfg(test)]
mod tests {
    super::super::conformance::transfer_conformance!(
        #[test]
        tpic,
        super::Tpic
    );
}
