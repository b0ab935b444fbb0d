//! Points put into another order within their own arrays.

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use crate::grid_to_points::POINTS_PER_TASK;
use crate::points::Points;

/// An entry of an array of points as a list of numbers.
trait Numbers: Copy + Send + Sync {
    const COUNT: usize;
    fn number(&self, n: usize) -> f64;
    fn set_number(&mut self, n: usize, value: f64);
}

impl Numbers for f64 {
    const COUNT: usize = 1;
    #[inline(always)]
    fn number(&self, _: usize) -> f64 {
        *self
    }
    #[inline(always)]
    fn set_number(&mut self, _: usize, value: f64) {
        *self = value;
    }
}

impl Numbers for u32 {
    const COUNT: usize = 1;
    #[inline(always)]
    fn number(&self, _: usize) -> f64 {
        f64::from(*self)
    }
    #[inline(always)]
    fn set_number(&mut self, _: usize, value: f64) {
        *self = value as u32;
    }
}

impl<const N: usize> Numbers for [f64; N] {
    const COUNT: usize = N;
    #[inline(always)]
    fn number(&self, n: usize) -> f64 {
        self[n]
    }
    #[inline(always)]
    fn set_number(&mut self, n: usize, value: f64) {
        self[n] = value;
    }
}

impl<const R: usize, const C: usize> Numbers for SMatrix<f64, R, C> {
    const COUNT: usize = R * C;
    #[inline(always)]
    fn number(&self, n: usize) -> f64 {
        self[n]
    }
    #[inline(always)]
    fn set_number(&mut self, n: usize, value: f64) {
        self[n] = value;
    }
}

impl<const D: usize> Points<D> {
    /// Entry `k` becomes point `order[k]`, which belongs to the same body.
    ///
    /// `scratch` has an entry a point; its content is lost. An array is moved through
    /// it a few numbers of every point at a time, so that no second copy of the points
    /// is needed, and buffers are never new memory.
    pub(crate) fn reorder(&mut self, order: &[u32], scratch: &mut [SVector<f64, D>]) {
        reorder(&mut self.id, order, scratch);
        reorder(&mut self.position, order, scratch);
        reorder(&mut self.reference_position, order, scratch);
        reorder(&mut self.velocity, order, scratch);
        reorder(&mut self.mass, order, scratch);
        reorder(&mut self.reference_volume, order, scratch);
        reorder(&mut self.volume, order, scratch);
        reorder(&mut self.deformation_gradient, order, scratch);
        reorder(&mut self.stress, order, scratch);
        reorder(&mut self.history, order, scratch);
        if !self.affine_velocity.is_empty() {
            reorder(&mut self.affine_velocity, order, scratch);
        }
    }
}

fn reorder<T: Numbers, const D: usize>(
    array: &mut [T],
    order: &[u32],
    scratch: &mut [SVector<f64, D>],
) {
    for first in (0..T::COUNT).step_by(D) {
        let count = (T::COUNT - first).min(D);
        let gathered = scratch.par_iter_mut().zip(order).with_min_len(POINTS_PER_TASK);
        gathered.for_each(|(part, &source)| {
            let source = &array[source as usize];
            for n in 0..count {
                part[n] = source.number(first + n);
            }
        });
        let written = array.par_iter_mut().zip(&*scratch).with_min_len(POINTS_PER_TASK);
        written.for_each(|(entry, part)| {
            for n in 0..count {
                entry.set_number(first + n, part[n]);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_follows_its_point() {
        let rows: Vec<[f64; 6]> =
            (0..7).map(|p| std::array::from_fn(|n| (10 * p + n) as f64)).collect();
        let order = [3, 0, 6, 5, 1, 2, 4];
        let mut moved = rows.clone();
        reorder(&mut moved, &order, &mut [SVector::<f64, 2>::zeros(); 7]);
        let expected: Vec<[f64; 6]> = order.iter().map(|&k| rows[k as usize]).collect();
        assert_eq!(moved, expected);
        let mut ids = vec![7_u32, u32::MAX, 9];
        reorder(&mut ids, &[1, 2, 0], &mut [SVector::<f64, 3>::zeros(); 3]);
        assert_eq!(ids, [u32::MAX, 9, 7]);
    }
}
