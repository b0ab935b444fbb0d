//! The plane between two clouds of points, and the gap along its normal.

use nalgebra::{Matrix4, SMatrix, SVector, Vector4};

/// Weight of the penalty on the plane's steepness, which bounds the steepness where
/// the clouds can be separated. It is small enough for the plane of the widest
/// margin: only points at the surface count. Larger ones lean the normals at the
/// ends of a body, which then hold it back: a block 6 cells long, friction 0.3,
/// slid 2.2 % too slowly with 1e-5, 1.7 % with 1e-6, 1.1 % with 1e-8.
const PENALTY: f64 = 1e-8;
/// Newton's method stops when the step is this small against the solution.
const TOLERANCE: f64 = 1e-4;
/// A Newton step that overshoots is halved down to this.
const SMALLEST_FRACTION: f64 = 1e-3;
/// Steepness (per cell) at which Newton's method starts.
const FIRST_STEEPNESS: f64 = 8.0;
/// A point that is so well classified that it adds less than round-off.
const CERTAIN: f64 = 25.0;
const MOST_ITERATIONS: usize = 30;
/// Steepness (per cell) below which the clouds have no separating direction.
const SMALLEST_STEEPNESS: f64 = 1e-3;

/// A point as seen from a node.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearPoint<const D: usize> {
    /// Position from the node, in cells.
    pub offset: SVector<f64, D>,
    /// Falls smoothly to zero where the point leaves the neighbourhood.
    pub weight: f64,
    /// Half of the deformed box's edges, in cells: `l/h F`.
    pub half_edges: SMatrix<f64, D, D>,
}

impl<const D: usize> NearPoint<D> {
    /// Reach of the point in a direction, in cells (G32): support of the hull
    /// of the deformed box's face centres, `max_i |n·F e_i| l/h`.
    ///
    /// It is the half thickness of the layer of points behind a flat face along
    /// the lattice and along its diagonals. The box itself would reach too far at
    /// an edge cut out of a lattice: its corners stick out of the body.
    fn reach(&self, direction: &SVector<f64, D>) -> f64 {
        (0..D)
            .map(|i| (0..D).map(|d| direction[d] * self.half_edges[(d, i)]).sum::<f64>().abs())
            .fold(0.0, f64::max)
    }
}

/// Unit normal from the first cloud to the second: the plane by which logistic
/// regression tells them apart (G31),
/// `min Σ_p w_p ln(1 + exp(-c_p (s·ξ_p + b))) + ½ λ |s|²`, `n = s/|s|`,
/// c = -1 in the first cloud and 1 in the second, the weights of each cloud
/// summing to 1 (Nairn, Hammerquist and Smith 2020, who take least squares of
/// the logistic function; the likelihood used here is convex).
///
/// `None` when there is no such plane.
pub(crate) fn normal<const D: usize>(
    first: &[NearPoint<D>],
    second: &[NearPoint<D>],
) -> Option<SVector<f64, D>> {
    let clouds = [Cloud::new(first, -1.0)?, Cloud::new(second, 1.0)?];
    let mut plane = Cloud::middle_plane(&clouds)?;
    let (mut slope, mut curvature) = derivatives(&clouds, &plane);
    for _ in 0..MOST_ITERATIONS {
        let newton = curvature.cholesky()?.solve(&slope);
        let descent = slope.dot(&newton);
        let mut fraction = 1.0;
        loop {
            let next = plane - newton * fraction;
            (slope, curvature) = derivatives(&clouds, &next);
            // The cost is convex: its slope along the step tells whether it overshot.
            if slope.dot(&newton).abs() <= descent || fraction < SMALLEST_FRACTION {
                plane = next;
                break;
            }
            fraction *= 0.5;
        }
        if newton.norm() * fraction <= TOLERANCE * plane.norm() {
            break;
        }
    }
    let steepness = SVector::<f64, D>::from_fn(|d, _| plane[d]);
    let length = steepness.norm();
    (length > SMALLEST_STEEPNESS).then(|| steepness / length)
}

/// Gap between two clouds along a normal, in cells (G32): the nearest face of
/// the second minus the farthest of the first, each over the points whose
/// distance from the node across the normal is at most `width`. Infinite if one
/// has no such point.
pub(crate) fn gap<const D: usize>(
    first: &[NearPoint<D>],
    second: &[NearPoint<D>],
    normal: &SVector<f64, D>,
    width: f64,
) -> f64 {
    let farthest = |cloud: &[NearPoint<D>], direction: &SVector<f64, D>| {
        cloud
            .iter()
            .filter(|point| {
                let along = point.offset.dot(direction);
                point.offset.norm_squared() - along * along <= width * width
            })
            .map(|point| point.offset.dot(direction) + point.reach(direction))
            .fold(f64::NEG_INFINITY, f64::max)
    };
    -farthest(second, &-normal) - farthest(first, normal)
}

/// A cloud with its class and the factor that makes its weights sum to 1.
struct Cloud<'a, const D: usize> {
    points: &'a [NearPoint<D>],
    class: f64,
    scale: f64,
}

impl<'a, const D: usize> Cloud<'a, D> {
    fn new(points: &'a [NearPoint<D>], class: f64) -> Option<Self> {
        let total: f64 = points.iter().map(|point| point.weight).sum();
        (total > 0.0).then(|| Self { points, class, scale: 1.0 / total })
    }

    /// Position with a 1 behind it, signed by the class; weight.
    fn signed(&self) -> impl Iterator<Item = (Vector4<f64>, f64)> {
        self.points.iter().map(|point| {
            let mut position = Vector4::w();
            (0..D).for_each(|d| position[d] = point.offset[d]);
            (position * self.class, point.weight * self.scale)
        })
    }

    /// Weighted mean position.
    fn centre(&self) -> SVector<f64, D> {
        self.points.iter().map(|point| point.offset * (point.weight * self.scale)).sum()
    }

    /// The plane half-way between the clouds' centres.
    fn middle_plane(clouds: &[Self; 2]) -> Option<Vector4<f64>> {
        let [first, second] = [clouds[0].centre(), clouds[1].centre()];
        let length = (second - first).norm();
        if length == 0.0 {
            return None;
        }
        let steepness = (second - first) * (FIRST_STEEPNESS / length);
        let mut plane = Vector4::w() * (-0.5 * steepness.dot(&(first + second)));
        (0..D).for_each(|d| plane[d] = steepness[d]);
        Some(plane)
    }

    fn add_derivatives(
        &self,
        plane: &Vector4<f64>,
        slope: &mut Vector4<f64>,
        curvature: &mut Matrix4<f64>,
    ) {
        for (position, weight) in self.signed() {
            let margin = plane.dot(&position);
            if margin < CERTAIN {
                let wrong = 1.0 / (1.0 + margin.exp());
                *slope -= position * (weight * wrong);
                *curvature += position * (position * (weight * wrong * (1.0 - wrong))).transpose();
            }
        }
    }
}

/// First and second derivatives of the cost.
fn derivatives<const D: usize>(
    clouds: &[Cloud<'_, D>; 2],
    plane: &Vector4<f64>,
) -> (Vector4<f64>, Matrix4<f64>) {
    let mut slope = Vector4::from_fn(|i, _| if i < 3 { PENALTY * plane[i] } else { 0.0 });
    let mut curvature = Matrix4::from_diagonal_element(PENALTY);
    // The offset is not penalised; round-off must not make it singular.
    curvature[(3, 3)] = f64::EPSILON;
    clouds.iter().for_each(|cloud| cloud.add_derivatives(plane, &mut slope, &mut curvature));
    (slope, curvature)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two points a cell and axis where `inside` says so, around a node at 0.
    fn cloud(inside: impl Fn(f64, f64) -> bool) -> Vec<NearPoint<2>> {
        let mut points = Vec::new();
        for k in 0..64 {
            let [x, y] = [k % 8, k / 8].map(|n| 0.5 * f64::from(n) - 1.75);
            let weight = (1.5 - x.abs()).max(0.0) * (1.5 - y.abs()).max(0.0);
            if weight > 0.0 && inside(x, y) {
                let half_edges = SMatrix::identity() * 0.25;
                points.push(NearPoint { offset: SVector::from([x, y]), weight, half_edges });
            }
        }
        points
    }

    #[test]
    fn flat_faces_have_their_normal_and_gap() {
        let (lower, upper) = (cloud(|_, y| y < 0.0), cloud(|_, y| y > 0.5));
        let normal = normal(&lower, &upper).unwrap();
        assert!((normal - SVector::from([0.0, 1.0])).norm() < 1e-6, "{normal}");
        let gap = gap(&lower, &upper, &normal, 1.0);
        assert!((gap - 0.5).abs() < 1e-6, "{gap}");
    }

    #[test]
    fn diagonal_faces_of_a_lattice_touch() {
        let (lower, upper) = (cloud(|x, y| x + y < -0.1), cloud(|x, y| x + y > -0.1));
        let normal = normal(&lower, &upper).unwrap();
        let diagonal = SVector::from([1.0, 1.0]) / 2.0_f64.sqrt();
        assert!((normal - diagonal).norm() < 1e-6, "{normal}");
        let gap = gap(&lower, &upper, &normal, 1.0);
        assert!(gap.abs() < 1e-6, "{gap}");
    }

    /// Below the end of a block the mass gradients lean by 18 degrees.
    #[test]
    fn the_end_of_a_block_hardly_tilts_the_normal() {
        for end in [-0.4, 0.1, 0.6] {
            let (slab, block) = (cloud(|_, y| y < 0.0), cloud(|x, y| y > 0.0 && x < end));
            let normal = normal(&slab, &block).unwrap();
            let lean = normal[0].atan2(normal[1]).to_degrees();
            assert!(lean.abs() < 3.0, "end {end}: {lean} degrees");
        }
    }
}
