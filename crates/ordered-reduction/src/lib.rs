//! Parallel sums whose bits do not depend on the number of threads.
//!
//! Floating-point addition is not associative, so a sum that follows rayon's
//! work stealing changes with the thread count. Here the index range is cut
//! into chunks of fixed length; each chunk is summed in index order and the
//! partial sums are added in chunk order.

use rayon::prelude::*;

/// Items per chunk. A constant: it decides the order of every sum.
const CHUNK: usize = 4096;

/// Sums `K` quantities at once over `0..count`.
///
/// `term(i)` returns the contribution of item `i` to each quantity.
///
/// ```
/// let [sum, squares] = ordered_reduction::sum(10, |i| [i as f64, (i * i) as f64]);
/// assert_eq!((sum, squares), (45.0, 285.0));
/// ```
pub fn sum<const K: usize>(count: usize, term: impl Fn(usize) -> [f64; K] + Sync) -> [f64; K] {
    let partials: Vec<[f64; K]> = (0..count.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            (chunk * CHUNK..((chunk + 1) * CHUNK).min(count))
                .fold([0.0; K], |total, i| add(total, term(i)))
        })
        .collect();
    partials.into_iter().fold([0.0; K], add)
}

/// Largest `value(i)` over `0..count`, or `None` when the range is empty.
///
/// A NaN anywhere makes the result NaN, so that a lost state cannot hide.
///
/// ```
/// assert_eq!(ordered_reduction::maximum(3, |i| -(i as f64)), Some(0.0));
/// assert_eq!(ordered_reduction::maximum(0, |_| 1.0), None);
/// ```
pub fn maximum(count: usize, value: impl Fn(usize) -> f64 + Sync) -> Option<f64> {
    let value = &value;
    (0..count)
        .into_par_iter()
        .with_min_len(CHUNK)
        .map(value)
        .reduce_with(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

fn add<const K: usize>(mut total: [f64; K], term: [f64; K]) -> [f64; K] {
    for (t, x) in total.iter_mut().zip(term) {
        *t += x;
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sum_has_the_same_bits_for_any_thread_count() {
        let term = |i: usize| [(i as f64 * 0.7).sin() * 1e3_f64.powi((i % 7) as i32)];
        let with = |threads| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .map(|pool| pool.install(|| sum(50_001, term)[0].to_bits()))
        };
        let bits: Vec<u64> = [1, 2, 3, 7].into_iter().filter_map(|n| with(n).ok()).collect();
        assert_eq!(bits.len(), 4);
        assert!(bits.iter().all(|&b| b == bits[0]), "{bits:?}");
    }

    #[test]
    fn maximum_reports_nan() {
        let value = |i: usize| if i == 4321 { f64::NAN } else { i as f64 };
        assert!(maximum(10_000, value).is_some_and(f64::is_nan));
    }
}
