//! Storage of node records that begins on a cache line.

use std::ops::{Deref, DerefMut};

use bytemuck::Pod;
use wide::f64x8;

/// Records of 64 or 32 bytes, none of which straddles two cache lines: a vector
/// register is loaded from one line, twice as fast as from two.
#[derive(Debug, Clone)]
pub(crate) struct Records<R> {
    lines: Vec<f64x8>,
    count: usize,
    record: std::marker::PhantomData<R>,
}

impl<R: Pod> Records<R> {
    /// Records of zeros.
    pub fn new(count: usize) -> Self {
        let lines = (count * size_of::<R>()).div_ceil(size_of::<f64x8>());
        Self { lines: vec![f64x8::splat(0.0); lines], count, record: std::marker::PhantomData }
    }
}

impl<R: Pod> Deref for Records<R> {
    type Target = [R];

    #[inline(always)]
    fn deref(&self) -> &[R] {
        &bytemuck::cast_slice(&self.lines)[..self.count]
    }
}

impl<R: Pod> DerefMut for Records<R> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [R] {
        &mut bytemuck::cast_slice_mut(&mut self.lines)[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_begin_on_a_cache_line() {
        for count in 0..5 {
            let mut records = Records::<[f64; 4]>::new(count);
            assert_eq!(records.len(), count);
            assert_eq!(records.as_ptr().align_offset(64), 0);
            records.fill([1.0; 4]);
            assert!(records.iter().all(|record| *record == [1.0; 4]));
        }
    }
}
