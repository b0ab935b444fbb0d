//! Cuts the sorted points of a body into blocks and tabulates their weights.

use std::collections::HashMap;

use super::pattern::{CORNERS, Pattern};
use super::slabs::{LAYERS, Slab};
use super::{Block, Carried, Lattice};
use crate::grid::{GHOST_BELOW, GridGeometry};
use crate::lanes::BLOCK;
use crate::points::Points;
use crate::real::Real;
use nalgebra::SVector;

/// Local coordinates that agree to this fraction of a cell share a pattern; above
/// the round-off of positions, far below anything a result shows.
const RESOLUTION: f64 = 1.0 / (1_u64 << 32) as f64;

/// Coordinates in a point's cell, 0 to 1.
fn local<const D: usize>(geometry: &GridGeometry<D>, reference: &SVector<f64, D>) -> [f64; D] {
    std::array::from_fn(|d| {
        let along = geometry.coordinate(reference, d);
        along - along.floor()
    })
}

/// The same as whole numbers of [`RESOLUTION`], slowest axis first: the order of the
/// points of a cell (G27).
pub(crate) fn place_in_cell<const D: usize>(
    geometry: &GridGeometry<D>,
    reference: &SVector<f64, D>,
) -> [i64; D] {
    let mut place = local(geometry, reference).map(|x| (x / RESOLUTION).round() as i64);
    place.reverse();
    place
}

impl<const D: usize> Lattice<D> {
    /// Cuts the points `start..end`, sorted by cell and place, into blocks; `None`
    /// if they are not sorted.
    pub fn new(
        geometry: &GridGeometry<D>,
        points: &Points<D>,
        start: usize,
        end: usize,
        mean_dilatation: bool,
    ) -> Option<Self> {
        let references = &points.reference_position[start..end];
        let cells: Vec<usize> = references.iter().map(|x| geometry.cell_of(x)).collect();
        if !cells.is_sorted() {
            return None;
        }
        let mut corner = [0; CORNERS];
        for (v, offset) in corner.iter_mut().enumerate().take(1 << D) {
            *offset = (0..D).map(|d| (v >> d & 1) * geometry.stride[d]).sum();
        }
        let mut lattice = Self {
            start,
            count: end - start,
            patterns: Vec::new(),
            blocks: Vec::with_capacity(references.len().div_ceil(1 << D)),
            slabs: vec![Slab::default(); geometry.cells[D - 1].div_ceil(LAYERS)],
            corner,
            plane: geometry.plane(),
            point_mass: points.mass.get(start).copied().unwrap_or(0.0),
            point_volume: points.reference_volume.get(start).copied().unwrap_or(0.0),
            mean_dilatation,
            mass: vec![0.0; geometry.node_count()],
            momentum: Carried::new(geometry.node_count()),
            force: Carried::new(geometry.node_count()),
            maximum_speed: 0.0,
        };
        lattice.cut(geometry, references, &cells);
        lattice.sum_mass();
        Some(lattice)
    }

    fn cut(&mut self, geometry: &GridGeometry<D>, references: &[SVector<f64, D>], cells: &[usize]) {
        let mut known: HashMap<Vec<[i64; D]>, u32> = HashMap::new();
        let cells_in_slab = LAYERS * geometry.cell_count() / geometry.cells[D - 1];
        let mut first = 0;
        for run in cells.chunk_by(|a, b| a == b) {
            let slab = run[0] / cells_in_slab;
            let node = lowest_corner(geometry, run[0]);
            for part in run.chunks(BLOCK) {
                let points = &references[first..first + part.len()];
                let key = points.iter().map(|x| place_in_cell(geometry, x)).collect();
                let patterns = &mut self.patterns;
                let pattern = *known.entry(key).or_insert_with(|| {
                    let along: Vec<[f64; D]> = points.iter().map(|x| local(geometry, x)).collect();
                    patterns.push(Pattern::new(&along, geometry.inverse_spacing));
                    (patterns.len() - 1) as u32
                });
                let count = part.len() as u32;
                self.blocks.push(Block { first: first as u32, node: node as u32, pattern, count });
                first += part.len();
            }
            self.slabs[slab].blocks.end = self.blocks.len();
            self.slabs[slab].points.end = first;
        }
        let (mut block, mut point) = (0, 0);
        for slab in &mut self.slabs {
            slab.blocks = block..slab.blocks.end.max(block);
            slab.points = point..slab.points.end.max(point);
            (block, point) = (slab.blocks.end, slab.points.end);
        }
    }

    /// Mass of the nodes (G5), block by block.
    fn sum_mass(&mut self) {
        for block in &self.blocks {
            let value = &self.patterns[block.pattern as usize].value;
            for v in 0..1 << D {
                let share: f64 = (0..block.count as usize).map(|p| value[v].lane(p)).sum();
                self.mass[block.node as usize + self.corner[v]] += self.point_mass * share;
            }
        }
    }
}

impl Carried {
    fn new(nodes: usize) -> Self {
        Self { records: vec![[0.0; 4]; nodes], is_current: false }
    }
}

/// Storage index of the lowest corner of a cell.
fn lowest_corner<const D: usize>(geometry: &GridGeometry<D>, mut cell: usize) -> usize {
    let mut node = 0;
    for d in 0..D {
        node += (cell % geometry.cells[d] + GHOST_BELOW) * geometry.stride[d];
        cell /= geometry.cells[d];
    }
    node
}
