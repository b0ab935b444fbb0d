//! Sorting points by body and by the nodes they reach: a stable counting sort.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid::GridGeometry;
use crate::grid_to_points::POINTS_PER_TASK;
use crate::lattice::place_in_cell;
use crate::parameters::Frame;
use crate::shape::{ShapeFunction, with_shape};
use crate::slabs::Slabs;
use crate::solid::{Body, Solid};

/// Fraction of a cell that a point may have moved before a sort is asked for;
/// the slabs hold twice as much.
const DRIFT_BEFORE_SORT: f64 = 0.25;

/// Buffers of the sort, kept between calls.
#[derive(Debug, Clone, Default)]
pub(crate) struct SortBuffers {
    key: Vec<u32>,
    next: Vec<u32>,
    order: Vec<u32>,
}

/// Storage order of the points of a body: slab by slab of cells; within a slab by the
/// first of a point's nodes, so that points which share their nodes follow each other,
/// and then by whether a third row and plane of nodes is reached, so that loops over
/// rows and planes change their length seldom.
struct Order<'a, const D: usize> {
    geometry: &'a GridGeometry<D>,
    slabs: Slabs,
    /// Different first nodes along each axis; along the slowest one, within a slab.
    firsts: [usize; D],
    /// Keys for a first node: one for each combination of third rows and planes.
    classes: usize,
}

impl<'a, const D: usize> Order<'a, D> {
    fn new(geometry: &'a GridGeometry<D>, body: &Body) -> Self {
        let mut firsts = geometry.cells.map(|cells| cells + 1);
        firsts[D - 1] = body.slabs.layers + 1;
        // In the total frame the order is that of the cells, x fastest.
        let classes = if body.discretisation.frame == Frame::Total { 1 } else { 1 << (D - 1) };
        Self { geometry, slabs: body.slabs, firsts, classes }
    }

    fn keys_in_slab(&self) -> usize {
        self.firsts.iter().product::<usize>() * self.classes
    }

    fn key_count(&self) -> usize {
        self.slabs.count(self.geometry) * self.keys_in_slab()
    }

    /// Positions outside the grid count to the nearest cell.
    #[inline(always)]
    fn key(&self, shape: impl ShapeFunction, position: &SVector<f64, D>) -> u32 {
        let (mut key, mut class, mut slab) = (0, 0, 0);
        for d in (0..D).rev() {
            let cells = self.geometry.cells[d];
            let along = self.geometry.coordinate(position, d).clamp(0.0, cells as f64 - 1e-9);
            let weights = shape.weights(along);
            let mut first = (weights.base + 1) as usize;
            if d == D - 1 {
                let layers = self.slabs.layers;
                slab = along as usize / layers;
                first = (first - slab * layers).min(layers);
            }
            key = key * self.firsts[d] + first;
            if d > 0 {
                class = class * 2 + usize::from(weights.count == 3);
            }
        }
        let within = if self.classes == 1 { key } else { key * self.classes + class };
        (slab * self.keys_in_slab() + within) as u32
    }
}

impl<const D: usize> Solid<D> {
    /// Whether points may have moved a quarter of a cell since the last sort, by
    /// the bound `Σ max|Δx|` over the steps. Call [`Self::sort_points`] then, between steps;
    /// a step fails once a point leaves the node planes of its slab, which takes
    /// at least half a cell.
    pub fn needs_sort(&self) -> bool {
        self.state.drift > DRIFT_BEFORE_SORT * self.parameters.grid_spacing
    }

    /// Sorts the points by body, slab and first node; points of equal reach keep their
    /// order. In the total frame the points of a cell are sorted by place, x fastest,
    /// and stay so.
    ///
    /// Arrays that a caller holds per point must follow `points().id` afterwards.
    pub fn sort_points(&mut self) {
        let buffers = &mut self.sort_buffers;
        let points = &self.state.points;
        buffers.order.clear();
        buffers.order.resize(points.len(), 0);
        buffers.key.clear();
        buffers.key.resize(points.len(), 0);
        for (body, offsets) in self.bodies.iter().zip(&mut self.state.slab_offsets) {
            let geometry = &self.fields[body.field].grid.geometry;
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let order = Order::new(geometry, body);
            let sites = match body.discretisation.frame {
                Frame::Updated => &points.position[start..end],
                Frame::Total => &points.reference_position[start..end],
            };
            let keys = &mut buffers.key[start..end];
            let tasks = keys.par_iter_mut().zip(sites).with_min_len(POINTS_PER_TASK);
            with_shape!(body, shape => tasks.for_each(|(key, x)| *key = order.key(shape, x)));
            buffers.next.clear();
            buffers.next.resize(order.key_count() + 1, 0);
            for &key in &buffers.key[start..end] {
                buffers.next[key as usize + 1] += 1;
            }
            buffers.next[0] = start as u32;
            for key in 0..order.key_count() {
                buffers.next[key + 1] += buffers.next[key];
            }
            for (slab, offset) in offsets.iter_mut().enumerate() {
                *offset = buffers.next[slab * order.keys_in_slab()] as usize;
            }
            for point in start..end {
                let slot = &mut buffers.next[buffers.key[point] as usize];
                buffers.order[*slot as usize] = point as u32;
                *slot += 1;
            }
            if body.discretisation.frame == Frame::Total {
                let (key, order) = (&buffers.key, &mut buffers.order[start..end]);
                for points_of_cell in
                    order.chunk_by_mut(|a, b| key[*a as usize] == key[*b as usize])
                {
                    points_of_cell.sort_by_key(|&p| {
                        place_in_cell(geometry, &points.reference_position[p as usize])
                    });
                }
            }
        }
        self.state.points.reorder(&buffers.order, &mut self.displacement);
        self.state.drift = 0.0;
        self.index_points();
        self.forget_carried();
    }

    /// Rebuilds the table from identity to storage index.
    pub(crate) fn index_points(&mut self) {
        self.index_of.resize(self.state.points.len(), 0);
        for (index, &id) in self.state.points.id.iter().enumerate() {
            self.index_of[id as usize] = index as u32;
        }
    }
}
