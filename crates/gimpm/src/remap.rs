//! Equation (7): the velocity that strains the points.

use rayon::prelude::*;

use crate::field::Field;
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
    ///
    /// The bodies of the vector loops have added their momentum in
    /// [`Self::grid_to_points`].
    pub(crate) fn remap_momentum(&mut self) {
        self.add_momentum(|kernel| kernel != Kernel::Separable);
        self.divide_by_mass();
    }

    /// The same from the velocity of the points at the step's start.
    pub(crate) fn map_momentum(&mut self) {
        self.clear_remapped();
        self.add_momentum(|_| true);
        self.divide_by_mass();
    }

    pub(crate) fn clear_remapped(&mut self) {
        for field in self.fields.iter_mut().filter(|field| field.lattice.is_none()) {
            let remapped = &mut field.grid.remapped;
            remapped.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 4]));
        }
    }

    fn add_momentum(&mut self, chosen: impl Fn(Kernel) -> bool) {
        let (points, mass_cut) = (&self.state.points, self.mass_cut);
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let Field { grid, lattice, .. } = &mut self.fields[body.field];
            if let Some(lattice) = lattice {
                lattice.remap(points, grid, mass_cut);
                continue;
            }
            match body.kernel {
                kernel if !chosen(kernel) => {}
                Kernel::Plain | Kernel::Lattice => plain::remap(body, offsets, points, grid),
                Kernel::Separable => separable::remap(body, offsets, points, grid),
            }
        }
    }

    fn divide_by_mass(&mut self) {
        let mass_cut = self.mass_cut;
        for field in self.fields.iter_mut().filter(|field| field.lattice.is_none()) {
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
