//! Loads on points, given to the nodes as external force.

use nalgebra::SVector;

use crate::shape::with_shape;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// `f_v^ext += Σ_p S_vp f_p` (G22; C5) with the current weights, for the next
    /// step, which clears it. Several calls add up.
    ///
    /// `force` (N) is in storage order, one entry a point; missing entries count
    /// as zero. The weights sum to one, so the total force is exact.
    pub fn scatter_point_force(&mut self, force: &[SVector<f64, D>]) {
        if self.failure.is_some() {
            return;
        }
        let grid = &mut self.grid;
        let geometry = &grid.geometry;
        let points = &self.state.points;
        grid.has_external_force = true;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            with_shape!(body, shape => {
                geometry.scatter_by_slab(offsets, &mut grid.external_force, |range, first, nodes| {
                    for p in range {
                        let Some(load) = force.get(p) else { break };
                        let stencil = geometry.stencil(shape, &points.position[p]);
                        let [sx, sy, sz] = &stencil.value;
                        for c in 0..stencil.count[2] {
                            for b in 0..stencil.count[1] {
                                let start = stencil.first - first
                                    + b * geometry.stride[1]
                                    + c * geometry.stride[2];
                                for (node, weight) in nodes[start..start + 3].iter_mut().zip(sx) {
                                    *node += load * (weight * (sy[b] * sz[c]));
                                }
                            }
                        }
                    }
                });
            });
        }
    }

    /// External force on each stored node (N) waiting for the next step.
    pub fn external_force_total(&self) -> SVector<f64, D> {
        let forces = &self.grid.external_force;
        if !self.grid.has_external_force {
            return SVector::zeros();
        }
        let total = ordered_reduction::sum(forces.len(), |v| {
            std::array::from_fn::<f64, 3, _>(|d| if d < D { forces[v][d] } else { 0.0 })
        });
        SVector::from_fn(|d, _| total[d])
    }
}
