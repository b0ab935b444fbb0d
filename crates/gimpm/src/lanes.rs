//! Eight consecutive points in the lanes of vector registers.

use nalgebra::Matrix3;
use wide::{f64x4, f64x8};

use crate::real::Real;
use crate::tensor::Tensor;

/// One number of each of eight points.
pub(crate) type Lanes = f64x8;

/// Points in a block.
pub(crate) const BLOCK: usize = 8;

/// Loads one array a point; lanes without a point repeat the first one, so that
/// nothing divides by zero in them.
#[inline(always)]
pub(crate) fn load<const N: usize>(rows: &[[f64; N]]) -> [Lanes; N] {
    match rows.first_chunk::<BLOCK>() {
        Some(rows) => load_block(|k| &rows[k]),
        None => load_some(rows),
    }
}

/// Stores what [`load`] loaded.
#[inline(always)]
pub(crate) fn store<const N: usize>(values: &[Lanes; N], rows: &mut [[f64; N]]) {
    match rows.first_chunk_mut::<BLOCK>() {
        Some(rows) => store_block(values, |k, first, part| put(&mut rows[k], first, part)),
        None => store_some(values, rows),
    }
}

/// Loads one matrix a point, as [`load`] does.
#[inline(always)]
pub(crate) fn load_matrices(matrices: &[Matrix3<f64>]) -> Tensor<Lanes> {
    let columns: [Lanes; 9] = match matrices.first_chunk::<BLOCK>() {
        Some(matrices) => load_block(|k| matrices[k].as_slice()),
        None => load_some_matrices(matrices),
    };
    Tensor::from_fn(|i, j| columns[3 * j + i])
}

/// Stores what [`load_matrices`] loaded.
#[inline(always)]
pub(crate) fn store_matrices(values: &Tensor<Lanes>, matrices: &mut [Matrix3<f64>]) {
    let [x, y, z] = &values.0;
    let columns = [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]];
    match matrices.first_chunk_mut::<BLOCK>() {
        Some(matrices) => store_block(&columns, |k, first, part| {
            put(matrices[k].as_mut_slice(), first, part);
        }),
        None => store_some_matrices(&columns, matrices),
    }
}

/// Turns eight rows of `N` numbers into lanes, four rows by four numbers at a time:
/// the last four overlap those before where `N` is no multiple of four.
#[inline(always)]
fn load_block<'a, const N: usize>(row: impl Fn(usize) -> &'a [f64]) -> [Lanes; N] {
    let mut values = [Lanes::splat(0.0); N];
    if N < 4 {
        for n in 0..N {
            values[n] = Lanes::from_lanes(|k| row(k)[n]);
        }
        return values;
    }
    for group in 0..N.div_ceil(4) {
        let first = (4 * group).min(N - 4);
        // Read as one vector: the compiler turns separate numbers into a gather, which
        // takes several times as long.
        let four = |k: usize| -> f64x4 {
            bytemuck::pod_read_unaligned(bytemuck::cast_slice(&row(k)[first..first + 4]))
        };
        let lower = f64x4::transpose([four(0), four(1), four(2), four(3)]);
        let upper = f64x4::transpose([four(4), four(5), four(6), four(7)]);
        for n in 0..4 {
            values[first + n] = bytemuck::cast([lower[n], upper[n]]);
        }
    }
    values
}

/// The reverse: calls `put(k, first, numbers)` for parts of each row, given as bytes.
#[inline(always)]
fn store_block<const N: usize>(values: &[Lanes; N], mut put: impl FnMut(usize, usize, &[u8])) {
    if N < 4 {
        for k in 0..BLOCK {
            for (n, value) in values.iter().enumerate() {
                put(k, n, bytemuck::bytes_of(&value.lane(k)));
            }
        }
        return;
    }
    for group in 0..N.div_ceil(4) {
        let first = (4 * group).min(N - 4);
        let halves = |n: usize| -> [f64x4; 2] { bytemuck::cast(values[first + n]) };
        let [a, b, c, d] = [halves(0), halves(1), halves(2), halves(3)];
        for half in 0..2 {
            let rows = f64x4::transpose([a[half], b[half], c[half], d[half]]);
            for (k, row) in rows.into_iter().enumerate() {
                put(4 * half + k, first, bytemuck::bytes_of(&row));
            }
        }
    }
}

/// Lanes from their lower and upper halves.
#[inline(always)]
pub(crate) fn joined(lower: [f64x4; 4], upper: [f64x4; 4]) -> [Lanes; 4] {
    std::array::from_fn(|n| bytemuck::cast([lower[n], upper[n]]))
}

/// Overwrites numbers of a row from `first` on.
#[inline(always)]
fn put(row: &mut [f64], first: usize, part: &[u8]) {
    let place = first * size_of::<f64>();
    bytemuck::cast_slice_mut(row)[place..place + part.len()].copy_from_slice(part);
}

// Blocks that are not full are rare: kept out of the loops that they would slow down.

#[inline(never)]
fn load_some<const N: usize>(rows: &[[f64; N]]) -> [Lanes; N] {
    std::array::from_fn(|n| {
        Lanes::from_lanes(|k| rows.get(k).or(rows.first()).map_or(0.0, |row| row[n]))
    })
}

#[inline(never)]
fn store_some<const N: usize>(values: &[Lanes; N], rows: &mut [[f64; N]]) {
    for (n, value) in values.iter().enumerate() {
        for (row, number) in rows.iter_mut().zip(value.to_array()) {
            row[n] = number;
        }
    }
}

#[inline(never)]
fn load_some_matrices(matrices: &[Matrix3<f64>]) -> [Lanes; 9] {
    std::array::from_fn(|n| {
        Lanes::from_lanes(|k| matrices.get(k).or(matrices.first()).map_or(0.0, |matrix| matrix[n]))
    })
}

#[inline(never)]
fn store_some_matrices(columns: &[Lanes; 9], matrices: &mut [Matrix3<f64>]) {
    for (n, column) in columns.iter().enumerate() {
        for (matrix, number) in matrices.iter_mut().zip(column.to_array()) {
            matrix[n] = number;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_loaded_is_stored_again() {
        for count in 1..=BLOCK {
            let rows: Vec<[f64; 6]> =
                (0..count).map(|k| std::array::from_fn(|n| (k + 10 * n) as f64)).collect();
            let mut copy = vec![[0.0; 6]; count];
            store(&load(&rows), &mut copy);
            assert_eq!(rows, copy);
            let matrices: Vec<Matrix3<f64>> =
                (0..count).map(|k| Matrix3::from_fn(|i, j| (i + 3 * j + 9 * k) as f64)).collect();
            let mut copy = vec![Matrix3::zeros(); count];
            store_matrices(&load_matrices(&matrices), &mut copy);
            assert_eq!(matrices, copy);
        }
    }
}
