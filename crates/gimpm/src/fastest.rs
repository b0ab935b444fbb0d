//! The largest speed and displacement of a step.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::grid_to_points::POINTS_PER_TASK;

/// Largest squares; NaN if any is.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Fastest {
    /// m²/s².
    pub speed_squared: f64,
    /// m².
    pub displacement_squared: f64,
}

impl Fastest {
    /// Includes a point.
    #[inline(always)]
    pub fn include<const D: usize>(
        &mut self,
        velocity: &SVector<f64, D>,
        displacement: &SVector<f64, D>,
    ) {
        let point = Self {
            speed_squared: velocity.norm_squared(),
            displacement_squared: displacement.norm_squared(),
        };
        *self = self.and(point);
    }

    /// The larger of both. The order of calls does not matter.
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self {
            speed_squared: larger(self.speed_squared, other.speed_squared),
            displacement_squared: larger(self.displacement_squared, other.displacement_squared),
        }
    }

    /// Points of a known largest speed that do not leave their cells.
    pub fn at_speed(speed: f64) -> Self {
        Self { speed_squared: speed * speed, displacement_squared: 0.0 }
    }

    /// Of points in memory.
    pub fn of<const D: usize>(
        velocity: &[SVector<f64, D>],
        displacement: &[SVector<f64, D>],
    ) -> Self {
        let tasks =
            velocity.par_chunks(POINTS_PER_TASK).zip(displacement.par_chunks(POINTS_PER_TASK));
        tasks
            .map(|(velocity, displacement)| {
                let mut fastest = Self::default();
                for (v, u) in velocity.iter().zip(displacement) {
                    fastest.include(v, u);
                }
                fastest
            })
            .reduce(Self::default, Self::and)
    }
}

/// `f64::max` would drop a NaN.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_largest_and_never_loses_a_nan() {
        let mut velocity = vec![SVector::from([0.0, 0.0]); 2000];
        velocity[700] = SVector::from([3.0, -4.0]);
        let displacement = vec![SVector::from([1.0, 0.0]); 2000];
        let fastest = Fastest::of(&velocity, &displacement);
        assert_eq!((fastest.speed_squared, fastest.displacement_squared), (25.0, 1.0));
        for k in [0, 699, 1999] {
            let mut lost = velocity.clone();
            lost[k][1] = f64::NAN;
            let fastest = Fastest::of(&lost, &displacement);
            assert!(fastest.speed_squared.is_nan() && fastest.displacement_squared == 1.0);
        }
    }
}
