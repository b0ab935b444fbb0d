//! Weights between material points and grid nodes along one axis.
//!
//! The weight of a node is the product of its axis weights (G4), so a shape
//! function is a function of one coordinate.

mod conformance;
mod linear;
mod ugimp;

pub use linear::Linear;
pub use ugimp::Ugimp;

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
}

/// The shape function of one body, with the size of its points.
#[derive(Debug, Clone, Copy)]
pub(crate) enum BodyShape {
    Linear(Linear),
    Ugimp(Ugimp),
}

impl BodyShape {
    /// In the total frame a box lies inside one cell, where the average of a linear
    /// function is its value in the middle: linear weights are those of any shape.
    pub(crate) fn new<const D: usize>(seed: &BodySeed<D>, grid_spacing: f64) -> Self {
        match (seed.discretisation.frame, seed.discretisation.shape) {
            (Frame::Total, _) | (_, Shape::Linear) => Self::Linear(Linear),
            (_, Shape::Ugimp) => Self::Ugimp(Ugimp::new(0.5 * seed.point_spacing / grid_spacing)),
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
