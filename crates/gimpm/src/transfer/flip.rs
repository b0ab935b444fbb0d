//! Fluid-implicit particle transfer, the founding paper's.

use nalgebra::{SMatrix, SVector};

use super::PointTransfer;
use crate::grid::{ACCELERATION, NodeRecord};
use crate::stencil::PointStencil;

/// `v_p += Δt Σ_v a_v S_vp` (G11; Brackbill and Ruppel 1986).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flip;

impl PointTransfer for Flip {
    const AFFINE: bool = false;

    #[inline(always)]
    fn gather<const D: usize>(
        &self,
        stencil: &PointStencil,
        nodes: &[NodeRecord],
        dt: f64,
        velocity: &mut SVector<f64, D>,
        _: &mut SMatrix<f64, D, D>,
    ) {
        for entry in stencil.entries() {
            let record = &nodes[entry.node as usize];
            for d in 0..D {
                velocity[d] += dt * entry.value * record[ACCELERATION + d];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    super::super::conformance::transfer_conformance!(
        #[test]
        flip,
        super::Flip
    );
}
