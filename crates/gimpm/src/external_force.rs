//! Loads on points, given to the nodes as external force.

use nalgebra::SVector;

use crate::grid::Grid;
use crate::solid::Solid;
use crate::stencil::PointStencil;

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
        let points = &self.state.points;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let frame = body.discretisation.frame;
            let Grid { geometry, external_force, has_external_force, .. } =
                &mut self.fields[body.field].grid;
            *has_external_force = true;
            body.slabs.scatter(geometry, offsets, external_force, |range, first, nodes| {
                let mut stencil = PointStencil::default();
                for p in range {
                    let Some(load) = force.get(p) else { break };
                    let f = &points.deformation_gradient[p];
                    stencil.evaluate(body, geometry, points.site(frame, p), f);
                    for entry in stencil.entries() {
                        nodes[entry.node as usize - first] += load * entry.value;
                    }
                }
            });
        }
    }

    /// Forgets the external force of all fields.
    pub(crate) fn clear_external_force(&mut self) {
        self.fields.iter_mut().for_each(|field| field.grid.clear_external_force());
    }

    /// External force (N) waiting on all nodes for the next step.
    pub fn external_force_total(&self) -> SVector<f64, D> {
        let mut sum = SVector::zeros();
        for grid in self.fields.iter().map(|field| &field.grid) {
            if grid.has_external_force {
                let forces = &grid.external_force;
                let total = ordered_reduction::sum(forces.len(), |v| {
                    std::array::from_fn::<f64, 3, _>(|d| if d < D { forces[v][d] } else { 0.0 })
                });
                sum += SVector::from_fn(|d, _| total[d]);
            }
        }
        sum
    }
}
