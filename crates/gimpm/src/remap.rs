//! Equation (7): the velocity that strains the points.

use rayon::prelude::*;

use crate::grid::{Grid, VELOCITY};
use crate::grid_momentum::NODES_PER_TASK;
use crate::kernel::Kernel;
use crate::solid::Solid;
use crate::{plain, separable};

impl<const D: usize> Solid<D> {
    /// `v_v = Σ_p m_p v_p S_vp / m_v` (G13), with the weights and masses of the
    /// step's start. The strain increment comes from this field, which is what
    /// makes the update "modified": it averages out the large velocities that a
    /// small node mass may have in v_v^L.
    pub(crate) fn remap_momentum(&mut self) {
        for field in &mut self.fields {
            let remapped = &mut field.grid.remapped;
            remapped.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 4]));
        }
        let points = &self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let grid = &mut self.fields[body.field].grid;
            match body.kernel {
                Kernel::Plain => plain::remap(body, offsets, points, grid),
                Kernel::Separable => separable::remap(body, offsets, points, grid),
            }
        }
        let mass_cut = self.mass_cut;
        for field in &mut self.fields {
            let Grid { nodes, remapped, .. } = &mut field.grid;
            let masses = nodes.par_chunks(NODES_PER_TASK);
            remapped.par_chunks_mut(NODES_PER_TASK).zip(masses).for_each(|(records, masses)| {
                for (record, mass) in records.iter_mut().zip(masses.iter().map(|node| node[0])) {
                    let inverse = if mass > mass_cut { 1.0 / mass } else { 0.0 };
                    record.iter_mut().for_each(|momentum| *momentum *= inverse);
                }
            });
        }
    }

    /// Takes the velocity of the nodes themselves instead: `v_v^L` after the forces
    /// have acted, for the update at the step's end (G13b).
    pub(crate) fn take_grid_velocity(&mut self) {
        for field in &mut self.fields {
            let Grid { nodes, remapped, .. } = &mut field.grid;
            let nodes = nodes.par_chunks(NODES_PER_TASK);
            remapped.par_chunks_mut(NODES_PER_TASK).zip(nodes).for_each(|(records, nodes)| {
                for (record, node) in records.iter_mut().zip(nodes) {
                    record[..3].copy_from_slice(&node[VELOCITY..VELOCITY + 3]);
                }
            });
        }
    }
}
