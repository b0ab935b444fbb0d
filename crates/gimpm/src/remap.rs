//! Equation (7): the updated momentum of the points goes back to the nodes.

use rayon::prelude::*;

use crate::grid::{RemapRecord, Stencil};
use crate::grid_momentum::NODES_PER_TASK;
use crate::shape::with_shape;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// `v_v = Σ_p m_p v_p S_vp / m_v` (G13), with the weights and masses of the
    /// step's start. The strain increment comes from this field, which is what
    /// makes the update "modified": it averages out the large velocities that a
    /// small node mass may have in v_v^L.
    pub(crate) fn remap_momentum(&mut self) {
        let mass_cut = self.mass_cut;
        let grid = &mut self.grid;
        let geometry = &grid.geometry;
        let points = &self.state.points;
        grid.remapped.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 4]));
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            with_shape!(body, shape => {
                geometry.scatter_by_slab(offsets, &mut grid.remapped, |range, first, nodes| {
                    for p in range {
                        let stencil = geometry.stencil(shape, &points.position[p]);
                        let mut momentum = [0.0; 4];
                        for d in 0..D {
                            momentum[d] = points.mass[p] * points.velocity[p][d];
                        }
                        let local = &mut nodes[stencil.first - first..];
                        add(local, &stencil, geometry.stride, &momentum);
                    }
                });
            });
        }
        let masses = grid.nodes.par_chunks(NODES_PER_TASK);
        grid.remapped.par_chunks_mut(NODES_PER_TASK).zip(masses).for_each(|(records, masses)| {
            for (record, mass) in records.iter_mut().zip(masses.iter().map(|node| node[0])) {
                let inverse = if mass > mass_cut { 1.0 / mass } else { 0.0 };
                record.iter_mut().for_each(|momentum| *momentum *= inverse);
            }
        });
    }
}

/// Adds a momentum to the nodes of a point.
#[inline(always)]
fn add(nodes: &mut [RemapRecord], stencil: &Stencil, stride: [usize; 3], momentum: &RemapRecord) {
    let [sx, sy, sz] = &stencil.value;
    for c in 0..stencil.count[2] {
        for b in 0..stencil.count[1] {
            let part = momentum.map(|component| component * (sy[b] * sz[c]));
            let start = b * stride[1] + c * stride[2];
            let row = &mut nodes[start..start + 3];
            for a in 0..3 {
                for k in 0..4 {
                    row[a][k] += part[k] * sx[a];
                }
            }
        }
    }
}
