//! Prescribed motion: one scalar velocity and displacement as functions of time.
//!
//! A moving wall of the fluid and a driven node set of the solid follow the
//! same laws, so both use this crate. Times are in seconds, velocities in m/s,
//! displacements in m; a direction is supplied by the user of the motion.
//!
//! ```
//! use motion::Motion;
//! let press = Motion::SmoothStart { velocity: -0.01, duration: 2.0 };
//! press.validate()?;
//! assert_eq!(press.velocity(3.0), -0.01);
//! assert_eq!(press.displacement(3.0), -0.01 * (3.0 - 1.0)); // half the start is lost
//! # Ok::<(), motion::MotionError>(())
//! ```

/// Velocity history of a driven wall or node set.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion {
    /// Held in place: `v = 0`.
    Fixed,
    /// `v = velocity` from the first instant (sends a wave through a solid).
    Constant {
        /// Velocity (m/s).
        velocity: f64,
    },
    /// `v = velocity · t/duration` up to `duration`, constant afterwards.
    Ramp {
        /// Final velocity (m/s).
        velocity: f64,
        /// Length of the ramp (s), above zero.
        duration: f64,
    },
    /// Quintic start `v = velocity · (10 s³ - 15 s⁴ + 6 s⁵)`, `s = t/duration`,
    /// constant afterwards: velocity, acceleration and its rate are continuous,
    /// so a solid is loaded without ringing.
    SmoothStart {
        /// Final velocity (m/s).
        velocity: f64,
        /// Length of the start (s), above zero.
        duration: f64,
    },
    /// Displacement read off a table, linear between its rows; before the first
    /// row and after the last the motion rests.
    Table {
        /// Rows `(time s, displacement m)`, times strictly increasing.
        rows: Vec<(f64, f64)>,
    },
}

/// What is wrong with a [`Motion`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// A ramp or smooth start needs a positive duration.
    #[error("motion duration is {0} s; it must be finite and above 0")]
    Duration(f64),
    /// A velocity is NaN or infinite.
    #[error("motion velocity is {0} m/s; it must be finite")]
    Velocity(f64),
    /// A table needs at least two rows.
    #[error("motion table has {0} row(s); at least 2 are needed")]
    ShortTable(usize),
    /// Table times must increase, and all entries must be finite.
    #[error(
        "motion table row {row}: (time {time} s, displacement {displacement} m) is not finite or not later than the row before"
    )]
    TableRow {
        /// Index of the row, from 0.
        row: usize,
        /// Its time (s).
        time: f64,
        /// Its displacement (m).
        displacement: f64,
    },
}

impl Motion {
    /// Checks the parameters.
    ///
    /// # Errors
    /// [`MotionError`] names the parameter, its value and its limit.
    pub fn validate(&self) -> Result<(), MotionError> {
        match self {
            Self::Fixed => Ok(()),
            Self::Constant { velocity } => finite(*velocity),
            Self::Ramp { velocity, duration } | Self::SmoothStart { velocity, duration } => {
                if !(duration.is_finite() && *duration > 0.0) {
                    return Err(MotionError::Duration(*duration));
                }
                finite(*velocity)
            }
            Self::Table { rows } => validate_table(rows),
        }
    }

    /// Velocity at time `t` (m/s).
    pub fn velocity(&self, t: f64) -> f64 {
        match self {
            Self::Fixed => 0.0,
            Self::Constant { velocity } => *velocity,
            Self::Ramp { velocity, duration } => velocity * (t / duration).clamp(0.0, 1.0),
            Self::SmoothStart { velocity, duration } => {
                let s = (t / duration).clamp(0.0, 1.0);
                velocity * s * s * s * (10.0 + s * (6.0 * s - 15.0))
            }
            Self::Table { rows } => {
                segment(rows, t).map_or(0.0, |(a, b)| (b.1 - a.1) / (b.0 - a.0))
            }
        }
    }

    /// Displacement at time `t` (m): the exact integral of [`Self::velocity`].
    pub fn displacement(&self, t: f64) -> f64 {
        match self {
            Self::Fixed => 0.0,
            Self::Constant { velocity } => velocity * t,
            Self::Ramp { velocity, duration } => {
                let s = t.clamp(0.0, *duration);
                velocity * (0.5 * s * s / duration + (t - duration).max(0.0))
            }
            Self::SmoothStart { velocity, duration } => {
                let s = (t / duration).clamp(0.0, 1.0);
                let started = s.powi(4) * (2.5 + s * (s - 3.0));
                velocity * (duration * started + (t - duration).max(0.0))
            }
            Self::Table { rows } => match segment(rows, t) {
                Some((a, b)) => a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0),
                None if rows.first().is_some_and(|first| t < first.0) => rows[0].1,
                None => rows.last().map_or(0.0, |last| last.1),
            },
        }
    }
}

fn finite(velocity: f64) -> Result<(), MotionError> {
    if velocity.is_finite() { Ok(()) } else { Err(MotionError::Velocity(velocity)) }
}

fn validate_table(rows: &[(f64, f64)]) -> Result<(), MotionError> {
    if rows.len() < 2 {
        return Err(MotionError::ShortTable(rows.len()));
    }
    let mut previous = f64::NEG_INFINITY;
    for (row, &(time, displacement)) in rows.iter().enumerate() {
        if !(time.is_finite() && displacement.is_finite() && time > previous) {
            return Err(MotionError::TableRow { row, time, displacement });
        }
        previous = time;
    }
    Ok(())
}

/// The two rows around `t`, or `None` outside the table.
fn segment(rows: &[(f64, f64)], t: f64) -> Option<((f64, f64), (f64, f64))> {
    let after = rows.partition_point(|row| row.0 <= t);
    (after > 0 && after < rows.len()).then(|| (rows[after - 1], rows[after]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn examples() -> Vec<Motion> {
        vec![
            Motion::Fixed,
            Motion::Constant { velocity: 0.3 },
            Motion::Ramp { velocity: -2.0, duration: 0.5 },
            Motion::SmoothStart { velocity: 1.5, duration: 0.8 },
            Motion::Table { rows: vec![(0.2, 0.0), (0.5, 0.3), (1.1, -0.2)] },
        ]
    }

    #[test]
    fn displacement_is_the_integral_of_velocity() {
        for motion in examples() {
            let (steps, end) = (200_000, 1.4);
            let dt = end / f64::from(steps);
            let integral: f64 =
                (0..steps).map(|k| motion.velocity((f64::from(k) + 0.5) * dt) * dt).sum();
            let exact = motion.displacement(end) - motion.displacement(0.0);
            assert!((integral - exact).abs() < 1e-5, "{motion:?}: {integral} against {exact}");
        }
    }

    #[test]
    fn bad_parameters_are_named() {
        let bad = [
            (Motion::Ramp { velocity: 1.0, duration: 0.0 }, MotionError::Duration(0.0)),
            (Motion::Constant { velocity: f64::INFINITY }, MotionError::Velocity(f64::INFINITY)),
            (Motion::Table { rows: vec![(0.0, 1.0)] }, MotionError::ShortTable(1)),
            (
                Motion::Table { rows: vec![(0.0, 1.0), (0.0, 2.0)] },
                MotionError::TableRow { row: 1, time: 0.0, displacement: 2.0 },
            ),
        ];
        for (motion, error) in bad {
            assert_eq!(motion.validate(), Err(error));
        }
        for motion in examples() {
            assert_eq!(motion.validate(), Ok(()));
        }
    }
}
