//! Weights between material points and grid nodes.
//!
//! Where the point's box keeps its size the weight of a node is the product of its
//! axis weights (G4), and a [`ShapeFunction`] is a function of one coordinate. Where
//! the domain deforms with the point a [`PointDomain`] gives all weights at once.

mod conformance;
mod cpdi;
mod cpgimp;
mod domain;
mod domain_conformance;
mod linear;
mod ugimp;

pub use cpdi::Cpdi;
pub use cpgimp::Cpgimp;
pub(crate) use domain::Product;
pub use domain::{NodeWeight, PointDomain};
pub use linear::Linear;
pub use ugimp::Ugimp;

use wide::f64x8;

use crate::parameters::{BodySeed, Frame, Shape};

/// Weights of the three consecutive nodes `base`, `base + 1`, `base + 2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisWeights {
    /// First node, counted from the grid origin.
    pub base: i32,
    /// How many nodes may have a weight: 2 or 3. Entries beyond it are zero.
    pub count: usize,
    /// Weights; they sum to 1.
    pub value: [f64; 3],
    /// Derivative of each weight with respect to the coordinate in cells.
    pub gradient: [f64; 3],
}

/// [`AxisWeights`] of eight points, one a lane.
#[derive(Debug, Clone, Copy)]
pub struct LaneWeights {
    /// First node of each point, a whole number.
    pub base: f64x8,
    /// Points whose third node may have a weight, one bit a lane.
    pub third: u32,
    /// Weights of the three nodes.
    pub value: [f64x8; 3],
    /// Their derivatives with respect to the coordinate in cells.
    pub gradient: [f64x8; 3],
}

/// One-dimensional weights of a material point.
///
/// Coordinates are in cells from the grid origin, so a node sits at each
/// integer. To add a shape, implement this trait, add a variant to
/// [`Shape`](crate::Shape), and run the conformance test on it:
///
/// ```
/// use gimpm::{AxisWeights, ShapeFunction};
///
/// /// Quadratic B-spline of width three cells.
/// #[derive(Clone, Copy)]
/// struct Quadratic;
///
/// impl ShapeFunction for Quadratic {
///     fn reach(&self) -> f64 {
///         1.5
///     }
///     fn weights(&self, x: f64) -> AxisWeights {
///         let base = (x - 0.5).floor();
///         let t = x - base; // 0.5 to 1.5
///         let value = [0.5 * (1.5 - t).powi(2), 0.75 - (t - 1.0).powi(2), 0.5 * (t - 0.5).powi(2)];
///         let gradient = [t - 1.5, -2.0 * (t - 1.0), t - 0.5];
///         AxisWeights { base: base as i32, count: 3, value, gradient }
///     }
/// }
///
/// gimpm::shape_function_conformance!(quadratic_conforms, Quadratic);
/// quadratic_conforms();
/// ```
pub trait ShapeFunction: Copy + Send + Sync {
    /// Largest distance, in cells, at which a node has a weight.
    fn reach(&self) -> f64;

    /// Weights and derivatives at coordinate `x` (cells).
    fn weights(&self, x: f64) -> AxisWeights;

    /// The same at eight coordinates; point by point unless a shape does better.
    #[inline(always)]
    fn lane_weights(&self, x: f64x8) -> LaneWeights {
        let lanes = x.to_array().map(|x| self.weights(x));
        let third = |k: usize| u32::from(lanes[k].count == 3) << k;
        LaneWeights {
            base: lanes.map(|w| f64::from(w.base)).into(),
            third: (0..8).map(third).sum(),
            value: core::array::from_fn(|slot| lanes.map(|w| w.value[slot]).into()),
            gradient: core::array::from_fn(|slot| lanes.map(|w| w.gradient[slot]).into()),
        }
    }
}

/// The shape function of one body along an axis, with the size of its points. For
/// a body whose domains deform it is that of the reference state.
#[derive(Debug, Clone, Copy)]
pub(crate) enum BodyShape {
    Linear(Linear),
    Ugimp(Ugimp),
}

/// Shapes that follow the deformation of the points.
#[derive(Debug, Clone, Copy)]
pub(crate) enum DeformingShape {
    Cpgimp(Cpgimp),
    Cpdi(Cpdi),
}

impl BodyShape {
    /// In the total frame a box lies inside one cell, where the average of a linear
    /// function is its value in the middle: linear weights are those of any shape.
    pub(crate) fn new<const D: usize>(seed: &BodySeed<D>, grid_spacing: f64) -> Self {
        match (seed.discretisation.frame, seed.discretisation.shape) {
            (Frame::Total, _) | (_, Shape::Linear) => Self::Linear(Linear),
            (_, Shape::Ugimp | Shape::Cpgimp | Shape::Cpdi) => {
                Self::Ugimp(Ugimp::new(0.5 * seed.point_spacing / grid_spacing))
            }
        }
    }
}

impl DeformingShape {
    /// `None` where the domains keep their shape.
    pub(crate) fn new<const D: usize>(seed: &BodySeed<D>, grid_spacing: f64) -> Option<Self> {
        let half_width = 0.5 * seed.point_spacing / grid_spacing;
        match (seed.discretisation.frame, seed.discretisation.shape) {
            (Frame::Updated, Shape::Cpgimp) => Some(Self::Cpgimp(Cpgimp::new(half_width))),
            (Frame::Updated, Shape::Cpdi) => Some(Self::Cpdi(Cpdi::new(half_width))),
            (Frame::Total, _) | (_, Shape::Linear | Shape::Ugimp) => None,
        }
    }
}

/// Evaluates an expression with `$shape` bound to the concrete shape function:
/// loops over points are compiled once for each shape and never test for it.
macro_rules! with_shape {
    ($body:expr, $shape:ident => $expression:expr) => {
        match $body.shape {
            $crate::shape::BodyShape::Linear($shape) => $expression,
            $crate::shape::BodyShape::Ugimp($shape) => $expression,
        }
    };
}
pub(crate) use with_shape;

/// The same with `$domain` bound to the concrete point domain, for every shape.
macro_rules! with_domain {
    ($body:expr, $domain:ident => $expression:expr) => {
        match $body.deforming {
            Some($crate::shape::DeformingShape::Cpgimp($domain)) => $expression,
            Some($crate::shape::DeformingShape::Cpdi($domain)) => $expression,
            None => $crate::shape::with_shape!($body, shape => {
                let $domain = $crate::shape::Product(shape);
                $expression
            }),
        }
    };
}
pub(crate) use with_domain;
