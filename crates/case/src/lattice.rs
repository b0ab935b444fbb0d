//! The particle lattice: cell centres at half a spacing from its planes.

use crate::geometry::Point;

/// Part of a spacing by which a test point is pushed towards +x, +y, +z, so that a
/// centre exactly on a face belongs to one of the two sides and never to none or both.
const NUDGE: f64 = 1e-6;

/// How far a face may miss a lattice plane and still lie on it, in spacings.
pub(crate) const ON_PLANE: f64 = 1e-6;

/// A cubic lattice in the first `dimension` axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lattice {
    /// A corner of a cell (m).
    pub(crate) origin: Point,
    /// Distance of neighbours (m).
    pub(crate) spacing: f64,
    /// 2 or 3.
    pub(crate) dimension: usize,
}

/// Half-open range of cells along each axis.
pub(crate) type CellRange = [std::ops::Range<i64>; 3];

impl Lattice {
    /// Index of the plane that represents a coordinate.
    pub(crate) fn plane(&self, axis: usize, coordinate: f64) -> i64 {
        (((coordinate - self.origin[axis]) / self.spacing - 0.5 - NUDGE).floor() as i64)
            .saturating_add(1)
    }

    /// Coordinate of a plane (m).
    pub(crate) fn plane_coordinate(&self, axis: usize, plane: i64) -> f64 {
        self.origin[axis] + plane as f64 * self.spacing
    }

    /// How far a coordinate lies from its nearest plane (m).
    pub(crate) fn misfit(&self, axis: usize, coordinate: f64) -> f64 {
        let cells = (coordinate - self.origin[axis]) / self.spacing;
        (cells - cells.round()).abs() * self.spacing
    }

    /// Cells whose centres lie in a box.
    pub(crate) fn cells(&self, lower: &Point, upper: &Point) -> CellRange {
        std::array::from_fn(|axis| {
            if axis < self.dimension {
                self.plane(axis, lower[axis])..self.plane(axis, upper[axis])
            } else {
                0..1
            }
        })
    }

    /// Centre of a cell.
    pub(crate) fn center(&self, cell: [i64; 3]) -> Point {
        Point::from_fn(|axis, _| {
            if axis < self.dimension {
                self.origin[axis] + (cell[axis] as f64 + 0.5) * self.spacing
            } else {
                0.0
            }
        })
    }

    /// The point to test for containment of a cell.
    pub(crate) fn test_point(&self, center: &Point) -> Point {
        let mut p = *center;
        for axis in 0..self.dimension {
            p[axis] += NUDGE * self.spacing;
        }
        p
    }
}

/// All cells of a range, x fastest.
pub(crate) fn each(range: &CellRange) -> impl Iterator<Item = [i64; 3]> + '_ {
    let [x, y, z] = range.clone();
    z.flat_map(move |k| {
        let x = x.clone();
        y.clone().flat_map(move |j| x.clone().map(move |i| [i, j, k]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_share_their_plane() {
        let lattice = Lattice { origin: Point::new(0.1, 0.0, 0.0), spacing: 0.1, dimension: 2 };
        for coordinate in [0.25, 0.3, 0.35, 0.349_999_999, 0.350_000_01, 7.0 * 0.1] {
            let below = lattice.cells(&Point::zeros(), &Point::new(coordinate, 1.0, 0.0));
            let above =
                lattice.cells(&Point::new(coordinate, 0.0, 0.0), &Point::new(2.0, 1.0, 0.0));
            assert_eq!(below[0].end, above[0].start, "{coordinate}");
        }
        let cells: Vec<_> = each(&[0..2, 0..1, 0..1]).collect();
        assert_eq!(cells, [[0, 0, 0], [1, 0, 0]]);
    }
}
