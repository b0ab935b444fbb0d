//! Point data of a finished run, as the metrics need them.

use super::VerifyError;

/// Material points of one body in the last frame of a run, all in one order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FinalPoints {
    /// Positions in the last frame (m), shape (N, 3).
    pub position: Vec<[f64; 3]>,
    /// Positions at the start (m), shape (N, 3).
    pub reference_position: Vec<[f64; 3]>,
    /// Cauchy stress (Pa), tension positive: xx, yy, zz, xy, yz, xz; shape (N, 6).
    pub stress: Vec<[f64; 6]>,
}

/// Supplies the final points of a body; asked only by metrics that need them.
pub trait PointSource {
    /// The points of `body` in the last frame.
    ///
    /// # Errors
    /// [`VerifyError::Points`] if the run has no such body or frame.
    fn final_points(&self, body: &str) -> Result<FinalPoints, VerifyError>;
}

/// A run without point data: histories only.
#[derive(Debug, Clone, Copy)]
pub struct NoPoints;

impl PointSource for NoPoints {
    fn final_points(&self, body: &str) -> Result<FinalPoints, VerifyError> {
        Err(VerifyError::Points { body: body.into(), reason: "this run has no point data".into() })
    }
}
