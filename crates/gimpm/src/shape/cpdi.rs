//! Convected particle domain interpolation: the domain is a deformed box.

use nalgebra::{Matrix3, SVector, Vector3};

use super::domain::{LARGEST_REACH, NODES_ALONG};
use super::{NodeWeight, PointDomain};

/// Grid linear functions interpolated between the corners
/// `x_c = x ± r_1 ± r_2 (± r_3)` of the parallelepiped with half edges
/// `r_i = l F e_i` (CPDI; Sadeghirad, Brannon and Burghardt 2011):
/// `S = 2⁻ᴰ Σ_c N(x_c)`, `∇S = Σ_i (2⁻ᴰ Σ_c ξ_ci N(x_c)) r^i`, with `ξ_ci = ±1`
/// and the dual vectors `r^i · r_j = δ_ij`; in two dimensions this is the paper's
/// formula.
///
/// A half diagonal longer than one cell is cut to that length (domain scaling;
/// Homel, Brannon and Guilkey 2016): the four corners of a plane domain follow
/// from their two diagonals. In space four diagonals fix three edges in the mean,
/// and a corner that is then still too far scales the whole domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cpdi {
    half_width: f64,
}

impl Cpdi {
    /// `half_width` is `l/h` in the reference state.
    pub fn new(half_width: f64) -> Self {
        Self { half_width }
    }

    /// Half edges, each a column; the third is the unit vector in plane strain.
    fn half_edges<const D: usize>(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let mut edges = f * self.half_width;
        let corners = 1 << D;
        if D == 2 {
            edges.set_column(2, &Vector3::zeros());
        }
        let far = |r: &Matrix3<f64>| {
            (0..corners / 2).map(|c| (r * signs(c)).norm()).fold(0.0_f64, f64::max)
        };
        if far(&edges) > LARGEST_REACH {
            // Corners c and 2ᴰ-1-c are the ends of one diagonal.
            let mut scaled = Matrix3::zeros();
            for c in 0..corners / 2 {
                let diagonal = edges * signs(c);
                let cut = (LARGEST_REACH / diagonal.norm()).min(1.0);
                scaled += diagonal * cut * signs(c).transpose();
            }
            edges = scaled * (2.0 / corners as f64);
            if D == 2 {
                edges.set_column(2, &Vector3::zeros());
            }
            let left = far(&edges);
            if left > LARGEST_REACH {
                edges *= LARGEST_REACH / left;
            }
        }
        if D == 2 {
            edges[(2, 2)] = 1.0;
        }
        edges
    }
}

/// ξ of a corner: bit i of its number says on which side of the point it lies.
fn signs(corner: usize) -> Vector3<f64> {
    Vector3::from_fn(|i, _| if corner >> i & 1 == 1 { 1.0 } else { -1.0 })
}

impl PointDomain for Cpdi {
    fn for_each_weight<const D: usize>(
        &self,
        x: &SVector<f64, D>,
        f: &Matrix3<f64>,
        mut give: impl FnMut(NodeWeight<D>),
    ) {
        let edges = self.half_edges::<D>(f);
        let dual = edges.try_inverse().unwrap_or_else(Matrix3::zeros);
        let corners = 1_usize << D;
        let share = 1.0 / corners as f64;
        let base: [f64; D] = std::array::from_fn(|d| (x[d] - 1.0).floor());
        let mut sums = [[0.0; 4]; NODES_ALONG * NODES_ALONG * NODES_ALONG];
        let stride = [1, NODES_ALONG, NODES_ALONG * NODES_ALONG];
        for c in 0..corners {
            let side = signs(c);
            // r^i are the rows of the inverse of the matrix of columns r_i.
            let direction = dual.transpose() * side;
            let (mut first, mut low, mut high) = (0, [1.0; 3], [0.0; 3]);
            for d in 0..D {
                let reach: f64 = (0..D).map(|i| edges[(d, i)] * side[i]).sum();
                let along = x[d] - base[d] + reach;
                let cell = along.floor().clamp(0.0, (NODES_ALONG - 2) as f64);
                first += cell as usize * stride[d];
                high[d] = along - cell;
                low[d] = 1.0 - high[d];
            }
            for corner_node in 0..corners {
                let (mut slot, mut weight) = (first, share);
                for d in 0..D {
                    let upper = corner_node >> d & 1;
                    slot += upper * stride[d];
                    weight *= if upper == 1 { high[d] } else { low[d] };
                }
                let sum = &mut sums[slot];
                sum[0] += weight;
                for d in 0..D {
                    sum[1 + d] += weight * direction[d];
                }
            }
        }
        for (slot, sum) in sums[..NODES_ALONG.pow(D as u32)].iter().enumerate() {
            if *sum != [0.0; 4] {
                let node = std::array::from_fn(|d| {
                    base[d] as i32 + (slot / stride[d] % NODES_ALONG) as i32
                });
                give(NodeWeight { node, value: sum[0], gradient: [sum[1], sum[2], sum[3]] });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    crate::point_domain_conformance!(
        #[test]
        one_point_a_cell,
        Cpdi::new(0.5)
    );
    crate::point_domain_conformance!(
        #[test]
        two_points_a_cell,
        Cpdi::new(0.25)
    );

    /// Plane formula of the paper: `∇S = Σ_c (N_c/2V) (±(r1y - r2y), ±(r2x - r1x)) …`
    /// with full edges, V the area of the parallelogram.
    #[test]
    fn gradients_are_the_published_ones() {
        let f = Matrix3::new(1.2, 0.5, 0.0, -0.3, 0.9, 0.0, 0.0, 0.0, 1.0);
        let (x, l) = (SVector::from([3.37, 4.91]), 0.25);
        let [r1, r2] = [[2.0 * l * 1.2, 2.0 * l * -0.3], [2.0 * l * 0.5, 2.0 * l * 0.9]];
        let area = r1[0] * r2[1] - r1[1] * r2[0];
        let hat = |s: f64| (1.0 - s.abs()).max(0.0);
        let mut published: BTreeMap<[i32; 2], [f64; 2]> = BTreeMap::new();
        // Corners 1 to 4 counterclockwise from x - r1/2 - r2/2.
        let a = [r1[1] - r2[1], r2[0] - r1[0]];
        let b = [r1[1] + r2[1], -r1[0] - r2[0]];
        let corner = |s: f64, t: f64| [0, 1].map(|d| x[d] + 0.5 * (s * r1[d] + t * r2[d]));
        let terms = [
            (corner(-1.0, -1.0), a),
            (corner(1.0, -1.0), b),
            (corner(1.0, 1.0), a.map(|v| -v)),
            (corner(-1.0, 1.0), b.map(|v| -v)),
        ];
        for i in 0..8 {
            for j in 0..8 {
                for (place, factor) in terms {
                    let n = hat(place[0] - f64::from(i)) * hat(place[1] - f64::from(j));
                    let sum = published.entry([i, j]).or_default();
                    (0..2).for_each(|d| sum[d] += n * factor[d] / (2.0 * area));
                }
            }
        }
        Cpdi::new(l).for_each_weight(&x, &f, |w: NodeWeight<2>| {
            let expected = published.remove(&w.node).unwrap();
            for d in 0..2 {
                assert!((w.gradient[d] - expected[d]).abs() < 1e-13, "{w:?} {expected:?}");
            }
        });
        assert!(published.values().flatten().all(|g| g.abs() < 1e-13), "no node is missing");
    }

    #[test]
    fn long_domains_are_cut_to_one_cell() {
        let f = Matrix3::from_diagonal(&[9.0, 1.0, 1.0].into());
        let plane = Cpdi::new(0.25).half_edges::<2>(&f);
        assert!((plane * Vector3::new(1.0, 1.0, 0.0)).norm() <= 1.0);
        assert!((plane * Vector3::new(1.0, 1.0, 0.0)).norm() > 0.999);
        let space = Cpdi::new(0.25).half_edges::<3>(&f);
        for c in 0..8 {
            assert!((space * signs(c)).norm() <= 1.0);
        }
    }
}
