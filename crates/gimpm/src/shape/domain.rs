//! Weights of a point whose domain deforms with it.

use nalgebra::{Matrix3, SVector};

use super::ShapeFunction;

/// Weight of one node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeWeight<const D: usize> {
    /// Node, counted from the grid origin along each axis.
    pub node: [i32; D],
    /// S_vp.
    pub value: f64,
    /// ∂S_vp/∂x with x in cells.
    pub gradient: [f64; 3],
}

/// How far a deforming domain may reach from its point along an axis, in cells. A
/// little less than one, so that round-off never adds a fifth node.
pub(crate) const LARGEST_REACH: f64 = 1.0 - 1e-9;

/// Nodes along an axis that such a domain may touch.
pub(crate) const NODES_ALONG: usize = 4;

/// Weights of a material point from its place and its deformation.
///
/// Lengths are in cells. The point's domain stays within one cell of the point
/// along each axis, so its nodes lie from `floor(x) - 1` to `floor(x) + 2`: grid and
/// slabs rely on it. To add a shape, implement this trait, add a variant to
/// [`Shape`](crate::Shape) and to `DeformingShape`, and run
/// [`point_domain_conformance`](crate::point_domain_conformance) on it.
pub trait PointDomain: Copy + Send + Sync {
    /// Calls `give` once for each node that may have a weight, for a point at `x`
    /// (cells) with deformation gradient `f`.
    fn for_each_weight<const D: usize>(
        &self,
        x: &SVector<f64, D>,
        f: &Matrix3<f64>,
        give: impl FnMut(NodeWeight<D>),
    );
}

/// A [`ShapeFunction`] along each axis, whatever the deformation (G4).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Product<S>(pub S);

impl<S: ShapeFunction> PointDomain for Product<S> {
    #[inline(always)]
    fn for_each_weight<const D: usize>(
        &self,
        x: &SVector<f64, D>,
        _: &Matrix3<f64>,
        give: impl FnMut(NodeWeight<D>),
    ) {
        let mut axes = [AxisNodes::ABSENT; 3];
        for d in 0..D {
            let weights = self.0.weights(x[d]);
            axes[d].base = weights.base;
            axes[d].count = weights.count;
            axes[d].value[..3].copy_from_slice(&weights.value);
            axes[d].gradient[..3].copy_from_slice(&weights.gradient);
        }
        tensor_product(&axes, give);
    }
}

/// Weights along one axis of a box of any width.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AxisNodes {
    pub base: i32,
    pub count: usize,
    pub value: [f64; NODES_ALONG],
    pub gradient: [f64; NODES_ALONG],
}

impl AxisNodes {
    /// The missing axis of a plane problem: one node of weight 1.
    pub const ABSENT: Self =
        Self { base: 0, count: 1, value: [1.0, 0.0, 0.0, 0.0], gradient: [0.0; NODES_ALONG] };
}

/// `S_vp = Π_d S(x_d)` (G4).
#[inline(always)]
pub(crate) fn tensor_product<const D: usize>(
    axes: &[AxisNodes; 3],
    mut give: impl FnMut(NodeWeight<D>),
) {
    let [x, y, z] = axes;
    for c in 0..z.count {
        for b in 0..y.count {
            let (yz, dy, dz) =
                (y.value[b] * z.value[c], y.gradient[b] * z.value[c], y.value[b] * z.gradient[c]);
            for a in 0..x.count {
                let slot = [a, b, c];
                give(NodeWeight {
                    node: std::array::from_fn(|d| axes[d].base + slot[d] as i32),
                    value: x.value[a] * yz,
                    gradient: [x.gradient[a] * yz, x.value[a] * dy, x.value[a] * dz],
                });
            }
        }
    }
}
