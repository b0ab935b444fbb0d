//! The background grid: node records, numbering, slabs for threads.
//!
//! Nodes are stored x fastest. One layer of nodes below the box of points and
//! two above it take the weights of points next to the box's faces. Cells are
//! grouped into slabs of [`SLAB`] layers along the slowest axis: the points of
//! one slab reach [`SLAB_PLANES`] node planes, and slabs of one colour (every
//! second one) reach disjoint planes, so the slabs of a colour are scattered in
//! parallel, the colours one after the other. The order of additions on a node
//! never depends on the number of threads.

use std::ops::Range;

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid_momentum::NODES_PER_TASK;
use crate::shape::ShapeFunction;

/// Cell layers in a slab.
pub(crate) const SLAB: usize = 4;
/// Node planes that the points of a slab may touch: its own `SLAB + 1`, one more
/// on each side for the width of a point, and one for half a cell of drift.
pub(crate) const SLAB_PLANES: usize = 2 * SLAB;
/// Nodes below the first cell.
const GHOST_BELOW: usize = 1;
/// Nodes in excess of cells along an axis: the closing node and the ghosts.
const EXTRA_NODES: usize = 4;

/// One node, one cache line: `[m, p, p, p, f, f, f, 0]` (mass, momentum, internal
/// force) during the scatter, then `[m, v_L, v_L, v_L, a, a, a, 0]`.
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

    pub fn cell_count(&self) -> usize {
        self.cells.iter().product()
    }

    /// Upper corner of the box of points (m).
    pub fn upper(&self) -> SVector<f64, D> {
        SVector::from_fn(|d, _| self.origin[d] + self.cells[d] as f64 * self.spacing)
    }

    /// Nodes in one plane across the slowest axis.
    pub fn plane(&self) -> usize {
        self.stride[D - 1]
    }

    pub fn slab_count(&self) -> usize {
        self.cells[D - 1].div_ceil(SLAB)
    }

    /// Coordinate along axis `d` in cells from the origin.
    #[inline(always)]
    pub fn coordinate(&self, position: &SVector<f64, D>, d: usize) -> f64 {
        (position[d] - self.origin[d]) * self.inverse_spacing
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

    /// Whether a point whose first node along the slowest axis is `base` stays
    /// on the planes that slab `slab` may touch.
    pub fn slab_holds(&self, slab: usize, base: i32) -> bool {
        let first_plane = i64::from(base) + GHOST_BELOW as i64;
        let lowest = (slab * SLAB) as i64;
        (lowest..=lowest + (SLAB_PLANES - 3) as i64).contains(&first_plane)
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

    /// Scatters a body's points to nodes, in parallel and in a fixed order.
    ///
    /// `slab_offsets[s]..slab_offsets[s + 1]` are the points of slab `s`.
    /// `scatter(points, first, records)` adds a range of points to `records`,
    /// whose entry 0 is node `first`.
    pub fn scatter_by_slab<R: Send>(
        &self,
        slab_offsets: &[usize],
        records: &mut [R],
        scatter: impl Fn(Range<usize>, usize, &mut [R]) + Sync,
    ) {
        for colour in 0..2 {
            let skipped = (colour * SLAB * self.plane()).min(records.len());
            let chunk = SLAB_PLANES * self.plane();
            records[skipped..].par_chunks_mut(chunk).enumerate().for_each(|(k, nodes)| {
                let slab = 2 * k + colour;
                if slab + 1 < slab_offsets.len() {
                    let points = slab_offsets[slab]..slab_offsets[slab + 1];
                    scatter(points, skipped + k * chunk, nodes);
                }
            });
        }
    }
}

/// The arrays on the nodes.
#[derive(Debug, Clone)]
pub(crate) struct Grid<const D: usize> {
    pub geometry: GridGeometry<D>,
    pub nodes: Vec<NodeRecord>,
    pub remapped: Vec<RemapRecord>,
    /// External force (N) for the next step.
    pub external_force: Vec<SVector<f64, D>>,
    /// Whether any external force was scattered since the last step.
    pub has_external_force: bool,
}

impl<const D: usize> Grid<D> {
    pub fn new(geometry: GridGeometry<D>) -> Self {
        let count = geometry.node_count();
        Self {
            nodes: vec![[0.0; 8]; count],
            remapped: vec![[0.0; 4]; count],
            external_force: vec![SVector::zeros(); count],
            has_external_force: false,
            geometry,
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
    use crate::shape::{Linear, Ugimp};

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

    #[test]
    fn slabs_hold_half_a_cell_of_drift() {
        let geometry = GridGeometry::new(1.0, SVector::from([0.0, 0.0]), [3, 12]);
        for half_width in [0.5, 0.25, 0.01] {
            let shape = Ugimp::new(half_width);
            assert!(geometry.slab_holds(1, shape.weights(4.0 - 0.4999).base));
            assert!(geometry.slab_holds(1, shape.weights(8.0 + 0.4999).base));
            assert!(!geometry.slab_holds(1, shape.weights(2.4).base));
            assert!(!geometry.slab_holds(1, shape.weights(10.1).base));
        }
    }
}
