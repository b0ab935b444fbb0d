//! Slabs of cells, so that threads scatter to nodes without meeting.
//!
//! Cells are grouped into slabs along the slowest axis. The points of one slab
//! reach a window of node planes twice as thick as the slab, and slabs of one
//! colour (every second one) have disjoint windows: the slabs of a colour are
//! scattered in parallel, the colours one after the other. The order of additions
//! on a node never depends on the number of threads.

use std::ops::Range;

use rayon::prelude::*;

use crate::grid::{GHOST_BELOW, GridGeometry};

/// How a body's cells are grouped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Slabs {
    /// Cell layers in a slab; its window has twice as many node planes.
    pub layers: usize,
    /// Planes of the window that lie below the node plane under the slab's cells.
    below: usize,
}

impl Slabs {
    /// For points with three nodes an axis: the window holds the slab's own five
    /// planes, one more on each side for the width of a point, one for half a cell of drift.
    pub const NARROW: Self = Self { layers: 4, below: 0 };
    /// For points that reach one cell to each side (four nodes an axis): nine planes
    /// of its own, one more on each side for the reach, one more for the drift.
    pub const WIDE: Self = Self { layers: 8, below: 1 };

    /// Node planes that the points of a slab may touch.
    pub fn planes(self) -> usize {
        2 * self.layers
    }

    pub fn count<const D: usize>(self, geometry: &GridGeometry<D>) -> usize {
        geometry.cells[D - 1].div_ceil(self.layers)
    }

    /// Nodes that the slabs `first..=last` may touch.
    pub fn window<const D: usize>(
        self,
        geometry: &GridGeometry<D>,
        first: usize,
        last: usize,
    ) -> Range<usize> {
        let plane = geometry.plane();
        let start = (first * self.layers).saturating_sub(self.below) * plane;
        let end = (last * self.layers + self.planes() - self.below) * plane;
        start..end.min(geometry.node_count())
    }

    /// Whether a point with `nodes` nodes from `base` on along the slowest axis stays on
    /// the planes that slab `slab` may touch.
    pub fn holds(self, slab: usize, base: i32, nodes: usize) -> bool {
        let first_plane = i64::from(base) + GHOST_BELOW as i64;
        let lowest = (slab * self.layers) as i64 - self.below as i64;
        let highest = lowest + self.planes() as i64 - nodes as i64;
        (lowest..=highest).contains(&first_plane)
    }

    /// Scatters a body's points to nodes, in parallel and in a fixed order.
    ///
    /// `slab_offsets[s]..slab_offsets[s + 1]` are the points of slab `s`.
    /// `scatter(points, first, records)` adds a range of points to `records`,
    /// whose entry 0 is node `first`.
    pub fn scatter<R: Send, const D: usize>(
        self,
        geometry: &GridGeometry<D>,
        slab_offsets: &[usize],
        records: &mut [R],
        scatter: impl Fn(Range<usize>, usize, &mut [R]) + Sync,
    ) {
        let ranges = slab_offsets.windows(2).map(|ends| ends[0]..ends[1]).collect();
        self.scatter_each(geometry, ranges, records, scatter);
    }

    /// The same with anything that belongs to each slab in place of a range of points.
    pub fn scatter_each<R: Send, P: Send, const D: usize>(
        self,
        geometry: &GridGeometry<D>,
        slabs: Vec<P>,
        records: &mut [R],
        scatter: impl Fn(P, usize, &mut [R]) + Sync,
    ) {
        let plane = geometry.plane();
        let chunk = self.planes() * plane;
        let mut colours = [Vec::new(), Vec::new()];
        for (slab, points) in slabs.into_iter().enumerate() {
            colours[slab % 2].push(points);
        }
        let [even, odd] = colours;
        // The window of slab 0 would begin `below` planes under the grid.
        let head = (chunk - self.below * plane).min(records.len());
        let (first_window, rest) = records.split_at_mut(head);
        let mut even = even.into_iter();
        let first = even.next();
        let later: Vec<P> = even.collect();
        rayon::join(
            || {
                if let Some(points) = first {
                    scatter(points, 0, first_window);
                }
            },
            || {
                let windows = rest.par_chunks_mut(chunk);
                windows.zip(later).enumerate().for_each(|(k, (nodes, points))| {
                    scatter(points, head + k * chunk, nodes);
                });
            },
        );
        let skipped = ((self.layers - self.below) * plane).min(records.len());
        let windows = records[skipped..].par_chunks_mut(chunk);
        windows.zip(odd).enumerate().for_each(|(k, (nodes, points))| {
            scatter(points, skipped + k * chunk, nodes);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{ShapeFunction, Ugimp};
    use nalgebra::SVector;

    #[test]
    fn slabs_hold_half_a_cell_of_drift() {
        for half_width in [0.5, 0.25, 0.01] {
            let holds = |x| Slabs::NARROW.holds(1, Ugimp::new(half_width).weights(x).base, 3);
            assert!(holds(4.0 - 0.4999) && holds(8.0 + 0.4999));
            assert!(!holds(2.4) && !holds(10.1));
        }
        let holds = |x: f64| Slabs::WIDE.holds(1, (x - 1.0).floor() as i32, 4);
        assert!(holds(8.0 - 0.4999) && holds(16.0 + 0.4999));
        assert!(!holds(6.9) && !holds(20.1));
    }

    /// Every slab gets its own window once, and no node is in two windows of a colour.
    #[test]
    fn windows_hold_the_planes_that_holds_allows() {
        for slabs in [Slabs::NARROW, Slabs::WIDE] {
            for layers in 1..40 {
                let geometry = GridGeometry::new(1.0, SVector::from([0.0, 0.0]), [3, layers]);
                let count = slabs.count(&geometry);
                let offsets: Vec<usize> = (0..=count).collect();
                let mut records = vec![0_u32; geometry.node_count()];
                let seen = std::sync::Mutex::new(vec![0; count]);
                slabs.scatter(&geometry, &offsets, &mut records, |points, first, nodes| {
                    let slab = points.start;
                    seen.lock().unwrap()[slab] += 1;
                    let plane = geometry.plane();
                    let lowest = (slab * slabs.layers).saturating_sub(slabs.below);
                    assert_eq!(first, lowest * plane);
                    let end = slab * slabs.layers + slabs.planes() - slabs.below;
                    assert_eq!(nodes.len(), (end * plane).min(geometry.node_count()) - first);
                });
                assert!(seen.lock().unwrap().iter().all(|times| *times == 1), "{layers} layers");
            }
        }
    }
}
