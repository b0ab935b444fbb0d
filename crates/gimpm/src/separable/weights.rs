//! Weights of eight points at once and their products over y and z.

use nalgebra::SVector;

use crate::grid::GridGeometry;
use crate::lanes::{BLOCK, Lanes};
use crate::real::Real;
use crate::shape::{LaneWeights, ShapeFunction};

/// Rows along x that a point reaches: three in y times three in z.
const ROWS: usize = 3;

/// Tensor-product weights (G4) of up to eight consecutive points, factored into a
/// part along x and one that belongs to a row of nodes. Lane `k` is point `k`.
///
/// `N` is 1 for loops that need the weights alone, 3 for those that need the slopes too.
pub(crate) struct BlockWeights<const N: usize> {
    /// Storage index of each point's first node.
    pub first: [usize; BLOCK],
    /// Points with a third row, and a third plane, one bit each.
    third: [u32; 2],
    /// Along x: value and derivative per cell width.
    pub x: [AxisLanes; 2],
    /// For each plane and row: `S_y S_z`, `S_y' S_z`, `S_y S_z'`.
    pub rows: Rows<N>,
}

type AxisLanes = [Lanes; 3];
pub(crate) type Rows<const N: usize> = [[[Lanes; N]; ROWS]; ROWS];

impl<const N: usize> BlockWeights<N> {
    /// Weights of the points at `positions`, at least one and at most eight.
    #[inline(always)]
    pub fn new<const D: usize>(
        geometry: &GridGeometry<D>,
        shape: impl ShapeFunction,
        positions: &[SVector<f64, D>],
    ) -> Self {
        let at = |d: usize| -> LaneWeights {
            let inverse = Lanes::splat(geometry.inverse_spacing);
            let position = match positions.first_chunk::<BLOCK>() {
                Some(rows) => Lanes::from_lanes(|k| rows[k][d]),
                None => Lanes::from_lanes(|k| positions[k.min(positions.len() - 1)][d]),
            };
            shape.lane_weights((position - Lanes::splat(geometry.origin[d])) * inverse)
        };
        let (x, y) = (at(0), at(1));
        let z = if D == 3 { at(2) } else { absent() };
        let mut rows = [[[Lanes::splat(0.0); N]; ROWS]; ROWS];
        for c in 0..if D == 3 { ROWS } else { 1 } {
            for b in 0..ROWS {
                rows[c][b][0] = y.value[b] * z.value[c];
                if N == 3 {
                    rows[c][b][1] = y.gradient[b] * z.value[c];
                    rows[c][b][2] = y.value[b] * z.gradient[c];
                }
            }
        }
        Self {
            first: geometry.first_nodes([x.base, y.base, z.base]),
            third: [y.third, z.third],
            x: [x.value, x.gradient],
            rows,
        }
    }

    /// Rows and planes that carry weight for any of the points `start..end`.
    #[inline(always)]
    pub fn extent(&self, start: usize, end: usize, dimension: usize) -> [usize; 2] {
        let points = ((1_u32 << end) - 1) & !((1 << start) - 1);
        let rows = 2 + usize::from(self.third[0] & points != 0);
        let planes = 2 + usize::from(self.third[1] & points != 0);
        [rows, if dimension == 3 { planes } else { 1 }]
    }

    /// End of the run of points from `start` on that share their nodes.
    #[inline(always)]
    pub fn run_end(&self, start: usize, count: usize) -> usize {
        let same = |k: &usize| self.first[*k] != self.first[start];
        (start + 1..count).find(same).unwrap_or(count)
    }
}

/// The axis that plane strain does not have: one plane of weight 1.
#[inline(always)]
fn absent() -> LaneWeights {
    let [zero, one] = [0.0, 1.0].map(Lanes::splat);
    LaneWeights { base: zero, third: 0, value: [one, zero, zero], gradient: [zero; 3] }
}
