//! Slabs of blocks for threads, and arrays cut to them.

use std::ops::Range;

use rayon::prelude::*;

use crate::grid::GHOST_BELOW;

/// Cell layers whose blocks one task takes. Points never leave their cells here,
/// so the blocks of a slab reach `LAYERS + 1` node planes and thinner slabs than
/// those of [`crate::grid`] do, which balance better.
pub(crate) const LAYERS: usize = 2;

/// Blocks and points of [`LAYERS`] cell layers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Slab {
    pub blocks: Range<usize>,
    /// Counted from the body's first point.
    pub points: Range<usize>,
}

/// Cuts an array of the body's points into one piece for each slab.
pub(crate) fn split<'a, T>(
    slabs: &'a [Slab],
    mut array: &'a mut [T],
) -> impl Iterator<Item = &'a mut [T]> {
    slabs.iter().map(move |slab| {
        let (piece, rest) = std::mem::take(&mut array).split_at_mut(slab.points.len());
        array = rest;
        piece
    })
}

/// Runs one task for each slab, those of one colour (every second one) in parallel.
///
/// `scatter(task, first, records)` may change the records of the node planes that
/// the slab reaches; entry 0 is node `first`. The order of additions on a node
/// does not depend on the number of threads.
pub(crate) fn scatter<T: Send, R: Send>(
    tasks: &mut [T],
    plane: usize,
    records: &mut [R],
    scatter: impl Fn(&mut T, usize, &mut [R]) + Sync,
) {
    let chunk = 2 * LAYERS * plane;
    for colour in 0..2 {
        let skipped = ((GHOST_BELOW + colour * LAYERS) * plane).min(records.len());
        tasks
            .par_iter_mut()
            .skip(colour)
            .step_by(2)
            .zip(records[skipped..].par_chunks_mut(chunk))
            .enumerate()
            .for_each(|(k, (task, nodes))| scatter(task, skipped + k * chunk, nodes));
    }
}
