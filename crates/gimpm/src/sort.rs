//! Sorting points by body and grid cell: a stable counting sort.

use crate::grid::SLAB;
use crate::parameters::Frame;
use crate::points::Points;
use crate::solid::Solid;

/// Fraction of a cell that a point may have moved before a sort is asked for;
/// the slabs hold twice as much.
const DRIFT_BEFORE_SORT: f64 = 0.25;

/// Buffers of the sort, kept between calls.
#[derive(Debug, Clone, Default)]
pub(crate) struct SortBuffers<const D: usize> {
    cell: Vec<u32>,
    next: Vec<u32>,
    order: Vec<u32>,
    points: Points<D>,
}

impl<const D: usize> Solid<D> {
    /// Whether points may have moved a quarter of a cell since the last sort, by
    /// the bound `Σ max|Δx|` over the steps. Call [`Self::sort_points`] then, between steps;
    /// a step fails once a point leaves the node planes of its slab, which takes
    /// at least half a cell.
    pub fn needs_sort(&self) -> bool {
        self.state.drift > DRIFT_BEFORE_SORT * self.parameters.grid_spacing
    }

    /// Sorts the points by body and cell; points of one cell keep their order.
    ///
    /// Arrays that a caller holds per point must follow `points().id` afterwards.
    pub fn sort_points(&mut self) {
        let buffers = &mut self.sort_buffers;
        let points = &self.state.points;
        buffers.cell.clear();
        buffers.order.clear();
        buffers.order.resize(points.len(), 0);
        for (body, offsets) in self.bodies.iter().zip(&mut self.state.slab_offsets) {
            let geometry = &self.fields[body.field].grid.geometry;
            let cells_in_slab = SLAB * geometry.cell_count() / geometry.cells[D - 1];
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let positions = match body.discretisation.frame {
                Frame::Updated => &points.position[start..end],
                Frame::Total => &points.reference_position[start..end],
            };
            buffers.cell.extend(positions.iter().map(|x| geometry.cell_of(x) as u32));
            buffers.next.clear();
            buffers.next.resize(geometry.cell_count() + 1, 0);
            for &cell in &buffers.cell[start..end] {
                buffers.next[cell as usize + 1] += 1;
            }
            buffers.next[0] = start as u32;
            for cell in 0..geometry.cell_count() {
                buffers.next[cell + 1] += buffers.next[cell];
            }
            for (slab, offset) in offsets.iter_mut().enumerate() {
                let cell = (slab * cells_in_slab).min(geometry.cell_count());
                *offset = buffers.next[cell] as usize;
            }
            for point in start..end {
                let slot = &mut buffers.next[buffers.cell[point] as usize];
                buffers.order[*slot as usize] = point as u32;
                *slot += 1;
            }
        }
        buffers.points.gather_from(points, &buffers.order);
        std::mem::swap(&mut buffers.points, &mut self.state.points);
        self.state.drift = 0.0;
        self.index_points();
    }

    /// Rebuilds the table from identity to storage index.
    pub(crate) fn index_points(&mut self) {
        self.index_of.resize(self.state.points.len(), 0);
        for (index, &id) in self.state.points.id.iter().enumerate() {
            self.index_of[id as usize] = index as u32;
        }
    }
}
