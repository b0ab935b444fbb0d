//! The nodes of one point as a list: the form that fits every frame and shape.

use nalgebra::{Matrix3, SVector};

use crate::grid::{GHOST_BELOW, GridGeometry};
use crate::shape::{NodeWeight, PointDomain, with_domain};
use crate::solid::Body;

/// Most nodes a point can have: four an axis.
const CAPACITY: usize = 64;

/// Weight of one node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    /// Storage index.
    pub node: u32,
    /// S_vp.
    pub value: f64,
    /// ∇S_vp (1/m), with respect to x in the updated frame, to X in the total one.
    pub gradient: [f64; 3],
    /// From the point to the node (m), in the same configuration.
    pub offset: [f64; 3],
}

/// Nodes of a point.
#[derive(Debug)]
pub(crate) struct PointStencil {
    count: usize,
    entries: [Entry; CAPACITY],
}

impl Default for PointStencil {
    fn default() -> Self {
        let none = Entry { node: 0, value: 0.0, gradient: [0.0; 3], offset: [0.0; 3] };
        Self { count: 0, entries: [none; CAPACITY] }
    }
}

impl PointStencil {
    /// The nodes of the point evaluated last.
    #[inline(always)]
    pub fn entries(&self) -> &[Entry] {
        &self.entries[..self.count]
    }

    /// Evaluates the weights of a point at its site, with its deformation gradient.
    pub fn evaluate<const D: usize>(
        &mut self,
        body: &Body,
        geometry: &GridGeometry<D>,
        site: &SVector<f64, D>,
        deformation_gradient: &Matrix3<f64>,
    ) {
        let x = SVector::from_fn(|d, _| geometry.coordinate(site, d));
        self.count = 0;
        with_domain!(body, domain => {
            domain.for_each_weight(&x, deformation_gradient, |weight| {
                self.push(geometry, &x, &weight);
            });
        });
    }

    #[inline(always)]
    fn push<const D: usize>(
        &mut self,
        geometry: &GridGeometry<D>,
        x: &SVector<f64, D>,
        weight: &NodeWeight<D>,
    ) {
        let (mut node, mut offset) = (0, [0.0; 3]);
        for d in 0..D {
            node += (weight.node[d] + GHOST_BELOW as i32) as usize * geometry.stride[d];
            offset[d] = geometry.spacing * (f64::from(weight.node[d]) - x[d]);
        }
        self.entries[self.count] = Entry {
            node: node as u32,
            value: weight.value,
            gradient: weight.gradient.map(|g| g * geometry.inverse_spacing),
            offset,
        };
        self.count += 1;
    }

    /// Second moments of the weights about the point, `D_p = Σ_v S_vp d ⊗ d` (m²),
    /// with d from the point to the node; their mean along the missing
    /// axis of a plane.
    pub fn second_moments<const D: usize>(&self) -> Matrix3<f64> {
        let mut moments = Matrix3::zeros();
        for entry in self.entries() {
            for i in 0..D {
                for j in 0..D {
                    moments[(i, j)] += entry.value * entry.offset[i] * entry.offset[j];
                }
            }
        }
        if D == 2 {
            moments[(2, 2)] = 0.5 * (moments[(0, 0)] + moments[(1, 1)]);
        }
        moments
    }
}

#[cfg(test)]
impl PointStencil {
    /// Linear weights of a place in a plane cell of width `h`, nodes numbered 0 to 3.
    pub fn of_cell(place: [f64; 2], h: f64) -> Self {
        let mut stencil = Self::default();
        for node in 0..4_u32 {
            let upper = [f64::from(node & 1), f64::from(node >> 1)];
            let weight = [0, 1].map(|d| 1.0 - (upper[d] - place[d]).abs());
            let slope = [0, 1].map(|d| (2.0 * upper[d] - 1.0) / h);
            stencil.entries[node as usize] = Entry {
                node,
                value: weight[0] * weight[1],
                gradient: [slope[0] * weight[1], weight[0] * slope[1], 0.0],
                offset: [h * (upper[0] - place[0]), h * (upper[1] - place[1]), 0.0],
            };
        }
        stencil.count = 4;
        stencil
    }
}
