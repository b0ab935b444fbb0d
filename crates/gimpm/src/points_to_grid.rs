//! Equations (1) and (2): points give mass, momentum and internal force to nodes.

use rayon::prelude::*;

use crate::grid_momentum::NODES_PER_TASK;
use crate::kernel::Kernel;
use crate::solid::Solid;
use crate::{plain, separable};

impl<const D: usize> Solid<D> {
    /// `m_v = Σ_p m_p S_vp`, `(mv)_v = Σ_p m_p v_p S_vp` (G5) and
    /// `f_v^int = -Σ_p V_p σ_p · ∇S_vp` (G6), in the total frame
    /// `f_v^int = -Σ_p V0_p P_p · ∇S_vp` (G6b).
    pub(crate) fn points_to_grid(&mut self) {
        for field in &mut self.fields {
            let nodes = &mut field.grid.nodes;
            nodes.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 8]));
        }
        let points = &self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let grid = &mut self.fields[body.field].grid;
            match body.kernel {
                Kernel::Plain => plain::points_to_grid(body, offsets, points, grid),
                Kernel::Separable => separable::points_to_grid(body, offsets, points, grid),
            }
        }
    }
}
