//! Transfer by the approximate inverse of the full mass matrix.

use nalgebra::{SMatrix, SVector};

use super::{PointTransfer, gather_velocity};
use crate::grid::NodeRecord;
use crate::stencil::PointStencil;

/// `v_p = Σ_v v_v^(k) S_vp`, `x_p += Δt v_p`, with the velocity of order k on the nodes
/// (`full_mass.rs`; Nairn and Hammerquist 2021, CMAME 377). k = 1 is PIC.
///
/// The paper moves points with `α v_p^{n+1} + (1-α) v_p^n` and recommends α = ½ where
/// both velocities belong to whole steps. Here velocities belong to mid-steps, where
/// α = 1 is the second-order choice and moves points as F is updated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fmpm;

impl PointTransfer for Fmpm {
    const AFFINE: bool = false;

    #[inline(always)]
    fn gather<const D: usize>(
        &self,
        stencil: &PointStencil,
        nodes: &[NodeRecord],
        _: f64,
        velocity: &mut SVector<f64, D>,
        _: &mut SMatrix<f64, D, D>,
    ) {
        *velocity = gather_velocity(stencil, nodes);
    }
}

#[cfg(test)]
mod tests {
    super::super::conformance::transfer_conformance!(
        #[test]
        fmpm,
        super::Fmpm
    );
}
