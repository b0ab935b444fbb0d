//! Equations (1) and (2): points give mass, momentum and internal force to nodes.

use rayon::prelude::*;

use crate::field::Field;
use crate::grid_momentum::NODES_PER_TASK;
use crate::kernel::Kernel;
use crate::solid::Solid;
use crate::{plain, separable};

impl<const D: usize> Solid<D> {
    /// `m_v = Σ_p m_p S_vp`, `(mv)_v = Σ_p m_p v_p S_vp` (G5) and
    /// `f_v^int = -Σ_p V_p σ_p · ∇S_vp` (G6), in the total frame
    /// `f_v^int = -Σ_p V0_p P_p · ∇S_vp` (G6b).
    pub(crate) fn points_to_grid(&mut self) {
        for field in self.fields.iter_mut().filter(|field| field.lattice.is_none()) {
            let nodes = &mut field.grid.nodes;
            nodes.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 8]));
        }
        let points = &self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let Field { grid, lattice, .. } = &mut self.fields[body.field];
            if let Some(lattice) = lattice {
                lattice.points_to_grid(points, grid);
                continue;
            }
            match body.kernel {
                Kernel::Plain | Kernel::Lattice => {
                    plain::points_to_grid(body, offsets, points, grid)
                }
                Kernel::Separable => separable::points_to_grid(body, offsets, points, grid),
            }
        }
    }
}
