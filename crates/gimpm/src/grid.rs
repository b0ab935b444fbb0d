//! The background grid: node records and numbering.
//!
//! Nodes are stored x fastest. One layer of nodes below the box of points and
//! two above it take the weights of points next to the box's faces.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid_momentum::NODES_PER_TASK;
use crate::lanes::{BLOCK, Lanes};
use crate::records::Records;
use crate::shape::{Linear, ShapeFunction};

/// Nodes below the first cell.
pub(crate) const GHOST_BELOW: usize = 1;
/// Nodes in excess of cells along an axis: the closing node and the ghosts.
const EXTRA_NODES: usize = 4;

/// One node, one cache line: `[m, p, p, p, f, f, f, _]` (mass, momentum, internal
/// force) during the scatter, then `[m, v_L, v_L, v_L, a, a, a, _]`; the last entry is
/// padding of any value.
pub(crate) type NodeRecord = [f64; 8];
/// First velocity (or momentum) entry of a [`NodeRecord`].
pub(crate) const VELOCITY: usize = 1;
/// First acceleration (or force) entry of a [`NodeRecord`].
pub(crate) const ACCELERATION: usize = 4;
/// Re-mapped momentum, then velocity; the last entry is padding.
pub(crate) type RemapRecord = [f64; 4];

/// Numbering of nodes and cells.
#[derive(Debug, Clone)]
pub(crate) struct GridGeometry<const D: usize> {
    pub spacing: f64,
    pub inverse_spacing: f64,
    pub origin: SVector<f64, D>,
    pub cells: [usize; D],
    /// Stored nodes along each axis.
    pub nodes: [usize; D],
    /// Distance in storage between neighbours along x, y, z (0 where absent).
    pub stride: [usize; 3],
}

/// Tensor-product weights of one point (G4): axis weights and the first node.
pub(crate) struct Stencil {
    pub first: usize,
    pub count: [usize; 3],
    pub value: [[f64; 3]; 3],
    /// Derivative per cell width; the kernels apply `1/h` once a point.
    pub gradient: [[f64; 3]; 3],
}

impl<const D: usize> GridGeometry<D> {
    pub fn new(spacing: f64, origin: SVector<f64, D>, cells: [usize; D]) -> Self {
        let nodes = cells.map(|n| n + EXTRA_NODES);
        let mut stride = [0; 3];
        let mut step = 1;
        for d in 0..D {
            stride[d] = step;
            step *= nodes[d];
        }
        Self { spacing, inverse_spacing: 1.0 / spacing, origin, cells, nodes, stride }
    }

    pub fn node_count(&self) -> usize {
        self.nodes.iter().product()
    }

    /// Upper corner of the box of points (m).
    pub fn upper(&self) -> SVector<f64, D> {
        SVector::from_fn(|d, _| self.origin[d] + self.cells[d] as f64 * self.spacing)
    }

    /// Nodes in one plane across the slowest axis.
    pub fn plane(&self) -> usize {
        self.stride[D - 1]
    }

    /// Coordinate along axis `d` in cells from the origin.
    #[inline(always)]
    pub fn coordinate(&self, position: &SVector<f64, D>, d: usize) -> f64 {
        (position[d] - self.origin[d]) * self.inverse_spacing
    }

    /// Storage index along axis `d` of a node counted from the origin.
    pub fn stored_index(&self, index: i64, d: usize) -> Option<usize> {
        let stored = usize::try_from(index + GHOST_BELOW as i64).ok()?;
        (stored < self.nodes[d]).then_some(stored)
    }

    /// Position of a stored node (m).
    pub fn node_position(&self, mut node: usize) -> SVector<f64, D> {
        let mut position = self.origin;
        for d in 0..D {
            let index = (node % self.nodes[d]) as f64 - GHOST_BELOW as f64;
            position[d] += index * self.spacing;
            node /= self.nodes[d];
        }
        position
    }

    pub fn cell_count(&self) -> usize {
        self.cells.iter().product()
    }

    /// Cell that holds a position, x fastest; positions outside count to the
    /// nearest cell.
    pub fn cell_of(&self, position: &SVector<f64, D>) -> usize {
        let mut cell = 0;
        for d in (0..D).rev() {
            let along = self.coordinate(position, d).clamp(0.0, self.cells[d] as f64 - 0.5);
            cell = cell * self.cells[d] + along as usize;
        }
        cell
    }

    /// Weights of a point at `position`.
    #[inline(always)]
    pub fn stencil<S: ShapeFunction>(&self, shape: S, position: &SVector<f64, D>) -> Stencil {
        let mut stencil = Stencil {
            first: 0,
            count: [1; 3],
            value: [[1.0, 0.0, 0.0]; 3],
            gradient: [[0.0; 3]; 3],
        };
        for d in 0..D {
            let weights = shape.weights(self.coordinate(position, d));
            stencil.first += (weights.base + GHOST_BELOW as i32) as usize * self.stride[d];
            stencil.count[d] = weights.count;
            stencil.value[d] = weights.value;
            stencil.gradient[d] = weights.gradient;
        }
        stencil
    }

    /// Storage index of the first node of eight points from its place along each axis.
    ///
    /// The index is put together in floating point, exact below 2^52, and read off the
    /// mantissa: Rust's own conversion tests for numbers out of range, lane by lane.
    #[inline(always)]
    pub fn first_nodes(&self, base: [Lanes; 3]) -> [usize; BLOCK] {
        const EXACT: f64 = (1_u64 << 52) as f64;
        let mut index = Lanes::splat(EXACT);
        for d in 0..D {
            let below = Lanes::splat(GHOST_BELOW as f64);
            index = (base[d] + below).mul_add(Lanes::splat(self.stride[d] as f64), index);
        }
        index.to_array().map(|index| (index.to_bits() & ((1 << 52) - 1)) as usize)
    }
}

/// The arrays on the nodes.
#[derive(Debug, Clone)]
pub(crate) struct Grid<const D: usize> {
    pub geometry: GridGeometry<D>,
    pub nodes: Records<NodeRecord>,
    pub remapped: Records<RemapRecord>,
    /// External force (N) for the next step.
    pub external_force: Vec<SVector<f64, D>>,
    /// Whether any external force was scattered since the last step.
    pub has_external_force: bool,
}

impl<const D: usize> Grid<D> {
    pub fn new(geometry: GridGeometry<D>) -> Self {
        let count = geometry.node_count();
        Self {
            nodes: Records::new(count),
            remapped: Records::new(count),
            external_force: vec![SVector::zeros(); count],
            has_external_force: false,
            geometry,
        }
    }

    /// Adds an external force that acts at one place: `f_v += N_v(x) f` with the
    /// grid's linear functions.
    pub fn add_at(&mut self, site: &SVector<f64, D>, force: &SVector<f64, D>) {
        let stencil = self.geometry.stencil(Linear, site);
        let [sx, sy, sz] = &stencil.value;
        let stride = self.geometry.stride;
        for c in 0..stencil.count[2] {
            for b in 0..stencil.count[1] {
                for a in 0..stencil.count[0] {
                    let weight = sx[a] * sy[b] * sz[c];
                    let node = stencil.first + a * stride[0] + b * stride[1] + c * stride[2];
                    self.external_force[node] += force * weight;
                }
            }
        }
    }

    /// Forgets the external force.
    pub fn clear_external_force(&mut self) {
        if self.has_external_force {
            let tasks = self.external_force.par_chunks_mut(NODES_PER_TASK);
            tasks.for_each(|forces| forces.fill(SVector::zeros()));
            self.has_external_force = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Ugimp;

    #[test]
    fn node_positions_match_the_numbering() {
        let geometry = GridGeometry::new(0.5, SVector::from([1.0, -2.0, 3.0]), [3, 4, 5]);
        let [sx, sy, sz] = geometry.stride;
        let node = 2 * sx + 4 * sy + 5 * sz;
        assert_eq!(geometry.node_position(node), SVector::from([1.5, -0.5, 5.0]));
    }

    #[test]
    fn points_in_the_whole_box_stay_inside_the_stored_nodes() {
        let geometry = GridGeometry::new(0.5, SVector::from([1.0, -2.0]), [3, 5]);
        for (x, y) in [(1.0, -2.0), (2.5, 0.5), (1.0, 0.5), (1.75, -1.9)] {
            for half_width in [0.5, 0.25, 0.01] {
                let stencil = geometry.stencil(Ugimp::new(half_width), &SVector::from([x, y]));
                let last = stencil.first + 2 + 2 * geometry.stride[1];
                assert!(last < geometry.node_count(), "{x} {y}");
            }
            let stencil = geometry.stencil(Linear, &SVector::from([x, y]));
            assert!(stencil.first + 2 + 2 * geometry.stride[1] < geometry.node_count());
        }
    }
}
