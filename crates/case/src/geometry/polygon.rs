//! Simple polygons in a plane.

/// A closed simple polygon.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Polygon {
    points: Vec<[f64; 2]>,
}

impl Polygon {
    /// Corners in order, either way round; the last joins the first.
    pub(crate) fn new(points: Vec<[f64; 2]>) -> Self {
        Self { points }
    }

    fn edges(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(a, b)| (*a, *b))
    }

    /// Distance to the outline, negative inside.
    pub(crate) fn signed_distance(&self, p: [f64; 2]) -> f64 {
        let (mut square, mut inside) = (f64::INFINITY, false);
        for (a, b) in self.edges() {
            let (edge, to_p) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
            let length_square = edge[0].powi(2) + edge[1].powi(2);
            let along = (to_p[0] * edge[0] + to_p[1] * edge[1]) / length_square;
            let along = if along.is_nan() { 0.0 } else { along.clamp(0.0, 1.0) };
            let across = [to_p[0] - along * edge[0], to_p[1] - along * edge[1]];
            square = f64::min(square, across[0].powi(2) + across[1].powi(2));
            // Even-odd rule along the ray towards +x.
            if (a[1] > p[1]) != (b[1] > p[1]) && to_p[0] < edge[0] * to_p[1] / edge[1] {
                inside = !inside;
            }
        }
        if inside { -square.sqrt() } else { square.sqrt() }
    }

    /// Lower and upper corner of the box around it.
    pub(crate) fn bounds(&self) -> ([f64; 2], [f64; 2]) {
        let nothing = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        self.points.iter().fold(nothing, |(lower, upper), p| {
            ([lower[0].min(p[0]), lower[1].min(p[1])], [upper[0].max(p[0]), upper[1].max(p[1])])
        })
    }

    /// Enclosed area.
    pub(crate) fn area(&self) -> f64 {
        let twice: f64 = self.edges().map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
        0.5 * twice.abs()
    }

    /// Diameter of the largest inscribed circle, sampled (within 2 %).
    pub(crate) fn thickness(&self) -> f64 {
        const SAMPLES: usize = 100;
        let (lower, upper) = self.bounds();
        let at = |axis: usize, i: usize| {
            lower[axis] + (i as f64 + 0.5) / SAMPLES as f64 * (upper[axis] - lower[axis])
        };
        let mut depth = 0.0;
        for i in 0..SAMPLES {
            for j in 0..SAMPLES {
                depth = f64::max(depth, -self.signed_distance([at(0, i), at(1, j)]));
            }
        }
        2.0 * depth
    }

    /// The first pair of edges that cross, by the index of their first corner.
    pub(crate) fn crossing(&self) -> Option<(usize, usize)> {
        let edges: Vec<_> = self.edges().collect();
        for i in 0..edges.len() {
            for j in i + 2..edges.len() {
                let neighbours = i == 0 && j + 1 == edges.len();
                if !neighbours && cross(edges[i], edges[j]) {
                    return Some((i, j));
                }
            }
        }
        None
    }
}

/// Whether two edges cross inside both.
fn cross(first: ([f64; 2], [f64; 2]), second: ([f64; 2], [f64; 2])) -> bool {
    let side = |edge: ([f64; 2], [f64; 2]), p: [f64; 2]| {
        (edge.1[0] - edge.0[0]) * (p[1] - edge.0[1]) - (edge.1[1] - edge.0[1]) * (p[0] - edge.0[0])
    };
    side(first, second.0) * side(first, second.1) < 0.0
        && side(second, first.0) * side(second, first.1) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangle_has_its_area_distance_and_incircle() {
        let triangle = Polygon::new(vec![[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]);
        assert!((triangle.area() - 6.0).abs() < 1e-12);
        assert!((triangle.signed_distance([1.0, 1.0]) + 1.0).abs() < 1e-12);
        assert!((triangle.signed_distance([-2.0, 1.0]) - 2.0).abs() < 1e-12);
        assert!((triangle.thickness() - 2.0).abs() < 0.05);
        assert_eq!(triangle.crossing(), None);
        let bow = Polygon::new(vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(bow.crossing(), Some((0, 2)));
    }
}
