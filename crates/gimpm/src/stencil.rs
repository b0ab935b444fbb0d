//! The nodes of one point as a list: the form that fits every frame and shape.

use nalgebra::SVector;

use crate::grid::GridGeometry;
use crate::shape::{ShapeFunction, with_shape};
use crate::solid::Body;

/// Most nodes a point can have: eight corners with eight nodes each.
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
}

/// Nodes of a point.
#[derive(Debug)]
pub(crate) struct PointStencil {
    count: usize,
    entries: [Entry; CAPACITY],
}

impl Default for PointStencil {
    fn default() -> Self {
        let none = Entry { node: 0, value: 0.0, gradient: [0.0; 3] };
        Self { count: 0, entries: [none; CAPACITY] }
    }
}

impl PointStencil {
    /// The nodes of the point evaluated last.
    #[inline(always)]
    pub fn entries(&self) -> &[Entry] {
        &self.entries[..self.count]
    }

    /// Evaluates the weights of a point at its site.
    pub fn evaluate<const D: usize>(
        &mut self,
        body: &Body,
        geometry: &GridGeometry<D>,
        site: &SVector<f64, D>,
    ) {
        with_shape!(body, shape => self.tensor_product(shape, geometry, site));
    }

    /// `S_vp = Π_d S(x_d)` (G4).
    fn tensor_product<const D: usize>(
        &mut self,
        shape: impl ShapeFunction,
        geometry: &GridGeometry<D>,
        site: &SVector<f64, D>,
    ) {
        let stencil = geometry.stencil(shape, site);
        let [sx, sy, sz] = &stencil.value;
        let [gx, gy, gz] = stencil.gradient.map(|axis| axis.map(|g| g * geometry.inverse_spacing));
        self.count = 0;
        for c in 0..stencil.count[2] {
            for b in 0..stencil.count[1] {
                for a in 0..stencil.count[0] {
                    let node = stencil.first
                        + a * geometry.stride[0]
                        + b * geometry.stride[1]
                        + c * geometry.stride[2];
                    self.entries[self.count] = Entry {
                        node: node as u32,
                        value: sx[a] * sy[b] * sz[c],
                        gradient: [
                            gx[a] * sy[b] * sz[c],
                            sx[a] * gy[b] * sz[c],
                            sx[a] * sy[b] * gz[c],
                        ],
                    };
                    self.count += 1;
                }
            }
        }
    }
}
