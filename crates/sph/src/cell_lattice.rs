//! Search lattice shared by fluid, walls and structure, and the counting sort onto it.
//!
//! Cells are `2h` wide across rows and `2h/X_BINS` along `x`, so the neighbours of a
//! point lie in at most 3 (2D) or 9 (3D) contiguous runs of slots, cut finely along x.

use crate::FluidError;
use nalgebra::SVector;
use rayon::prelude::*;
use std::ops::Range;

/// Cells per kernel support along `x`. Measured in `docs/method.md` (S7).
const X_BINS: usize = 4;
/// A table of this many cells takes 1 GiB.
const CELL_LIMIT: f64 = (1_u64 << 28) as f64;

/// Regular cells over the domain and one kernel support around it, `x` fastest.
#[derive(Debug, Clone)]
pub(crate) struct CellLattice<const D: usize> {
    origin: SVector<f64, D>,
    inverse_width: SVector<f64, D>,
    count: [usize; D],
}

impl<const D: usize> CellLattice<D> {
    /// Lattice over `domain` for kernels reaching `support`.
    pub fn new(
        domain: (SVector<f64, D>, SVector<f64, D>),
        support: f64,
    ) -> Result<Self, FluidError> {
        let origin = domain.0.add_scalar(-support);
        let mut inverse_width = SVector::repeat(1.0 / support);
        inverse_width[0] *= X_BINS as f64;
        let extent = domain.1.add_scalar(support) - origin;
        let wanted = extent.component_mul(&inverse_width).map(|c| c.floor() + 1.0);
        let cells = wanted.product();
        if cells.is_nan() || cells > CELL_LIMIT {
            return Err(FluidError::TooManyCells { cells, limit: CELL_LIMIT });
        }
        let mut count = [1; D];
        for axis in 0..D {
            count[axis] = wanted[axis] as usize;
        }
        Ok(Self { origin, inverse_width, count })
    }

    /// Number of cells; also the key of everything outside the lattice.
    pub fn cells(&self) -> usize {
        self.count.iter().product()
    }

    /// Key of the cell that holds `x`.
    #[inline]
    pub fn key(&self, x: &SVector<f64, D>) -> u32 {
        let c = (x - self.origin).component_mul(&self.inverse_width);
        let mut key = 0;
        for axis in (0..D).rev() {
            if !(c[axis] >= 0.0 && c[axis] < self.count[axis] as f64) {
                return self.cells() as u32;
            }
            key = key * self.count[axis] + c[axis] as usize;
        }
        key as u32
    }

    /// Calls `visit(first, end)` for each x-run of cells that meets the box `x ± radius`.
    #[inline(always)]
    pub fn for_each_run(
        &self,
        x: &SVector<f64, D>,
        radius: f64,
        mut visit: impl FnMut(usize, usize),
    ) {
        let c = x - self.origin;
        let mut lower = [0; 3];
        let mut upper = [0; 3];
        for axis in 0..D {
            let last = self.count[axis] - 1;
            // The cast saturates at 0 below the lattice.
            lower[axis] = (((c[axis] - radius) * self.inverse_width[axis]) as usize).min(last);
            upper[axis] = (((c[axis] + radius) * self.inverse_width[axis]) as usize).min(last);
        }
        let rows_per_layer = if D == 3 { self.count[1] } else { 0 };
        for z in lower[2]..=upper[2] {
            for y in lower[1]..=upper[1] {
                let row = (z * rows_per_layer + y) * self.count[0];
                visit(row + lower[0], row + upper[0] + 1);
            }
        }
    }
}

/// First slot of each cell for points sorted by key, with reused buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct CellTable {
    start: Vec<u32>,
    /// Key of each point before sorting.
    pub keys: Vec<u32>,
    /// `order[slot]` is the index before sorting of the point now in `slot`.
    pub order: Vec<u32>,
}

impl CellTable {
    /// Slots of the cells `first..end`.
    #[inline(always)]
    pub fn slots(&self, first: usize, end: usize) -> Range<usize> {
        self.start[first] as usize..self.start[end] as usize
    }

    /// Number of points inside the lattice; the others sort behind them.
    pub fn inside(&self) -> usize {
        self.start.iter().rev().nth(1).map_or(0, |&s| s as usize)
    }

    /// Computes keys with `key_of(i)` for `count` points in parallel, then sorts.
    pub fn sort(&mut self, cells: usize, count: usize, key_of: impl Fn(usize) -> u32 + Sync) {
        self.keys.resize(count, 0);
        self.keys.par_iter_mut().enumerate().with_min_len(1024).for_each(|(i, k)| *k = key_of(i));
        self.sort_keys(cells);
    }

    /// Stable counting sort of `keys`, each at most `cells` (meaning outside).
    pub fn sort_keys(&mut self, cells: usize) {
        // Shifted by one during the scatter: start[k + 1] runs from the first slot of
        // cell k to its end, so that afterwards start[k] is the first slot of cell k.
        self.start.clear();
        self.start.resize(cells + 3, 0);
        for &key in &self.keys {
            self.start[key as usize + 2] += 1;
        }
        for cell in 2..self.start.len() {
            self.start[cell] += self.start[cell - 1];
        }
        self.order.resize(self.keys.len(), 0);
        for (i, &key) in self.keys.iter().enumerate() {
            let slot = &mut self.start[key as usize + 1];
            self.order[*slot as usize] = i as u32;
            *slot += 1;
        }
        self.start.truncate(cells + 2);
    }

    /// Key of each point in slot order, for points inside the lattice.
    pub fn sorted_keys(&self) -> Vec<u32> {
        let cells = self.start.len().saturating_sub(2);
        let runs = (0..cells).map(|cell| (cell as u32, self.slots(cell, cell + 1).len()));
        runs.flat_map(|(cell, length)| std::iter::repeat_n(cell, length)).collect()
    }

    /// Whether the points were in order already.
    pub fn is_identity(&self) -> bool {
        self.order.iter().enumerate().all(|(slot, &i)| slot == i as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    use proptest::prelude::*;

    #[test]
    fn a_huge_domain_is_refused() {
        let domain = (Vector3::repeat(0.0), Vector3::repeat(1e5));
        assert!(matches!(CellLattice::new(domain, 0.1), Err(FluidError::TooManyCells { .. })));
    }

    proptest! {
        #[test]
        fn runs_hold_every_neighbour(
            points in prop::collection::vec([-0.3..1.3, -0.3..1.3, -0.3..1.3_f64], 1..200),
        ) {
            let support = 0.25;
            let lattice = CellLattice::new((SVector::from([0.0, 0.0, 0.0]), SVector::from([1.0, 1.0, 1.0])), support).unwrap();
            let points: Vec<_> = points.into_iter().map(Vector3::from).collect();
            let mut table = CellTable::default();
            table.sort(lattice.cells(), points.len(), |i| lattice.key(&points[i]));
            let covered = |x: &Vector3<f64>| x.iter().all(|&c| c > -support && c < 1.0 + support);
            for x in points.iter().filter(|x| x.iter().all(|&c| (0.0..=1.0).contains(&c))) {
                let mut found = vec![];
                lattice.for_each_run(x, support, |first, end| {
                    found.extend(table.slots(first, end).map(|slot| table.order[slot]));
                });
                for (j, y) in points.iter().enumerate().filter(|(_, y)| covered(y)) {
                    if (x - y).norm() < support {
                        prop_assert_eq!(found.iter().filter(|&&k| k as usize == j).count(), 1);
                    }
                }
            }
        }

        #[test]
        fn sort_is_stable(keys in prop::collection::vec(0_u32..=9, 0..300)) {
            let mut table = CellTable { keys: keys.clone(), ..CellTable::default() };
            table.sort_keys(9);
            let mut expected: Vec<u32> = (0..keys.len() as u32).collect();
            expected.sort_by_key(|&i| keys[i as usize]);
            prop_assert_eq!(&table.order, &expected);
            prop_assert_eq!(table.inside(), keys.iter().filter(|&&k| k < 9).count());
        }
    }
}
