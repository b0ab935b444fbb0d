//! The impulse between two masses that meet, by Coulomb's law.

use nalgebra::{SMatrix, SVector};

/// What acts between two nodes through a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Impulse<const D: usize> {
    /// On the second node (N s); the first gets its opposite.
    pub on_second: SVector<f64, D>,
    /// Whether friction holds the two together.
    pub sticks: bool,
}

/// Impulse that keeps the second node from approaching the first faster than
/// `closing` (m/s) along the normal, which points from the first to the second.
///
/// With `v` the second's velocity minus the first's and `W` the sum of their
/// inverse masses, which is a matrix where a boundary holds components
/// (G33): none if `v·n ≥ -closing`; else `J = α n + β t`, `t` along the
/// tangential velocity, with both chosen to stop the approach and the sliding if
/// `|β| ≤ μ α`, or `J = α (n - μ t)` that stops the approach (Bardenhagen et al.
/// 2001). `None` if nothing needs to or can be stopped.
pub(crate) fn coulomb<const D: usize>(
    relative: &SVector<f64, D>,
    inverse_mass: &SMatrix<f64, D, D>,
    normal: &SVector<f64, D>,
    closing: f64,
    friction: f64,
) -> Option<Impulse<D>> {
    let approach = -(relative.dot(normal) + closing);
    let along = inverse_mass * normal;
    let normal_mobility = normal.dot(&along);
    if approach <= 0.0 || normal_mobility <= 0.0 {
        return None;
    }
    let sliding = relative - normal * relative.dot(normal);
    let speed = sliding.norm();
    let alone = approach / normal_mobility;
    let frictionless = Impulse { on_second: normal * alone, sticks: false };
    if friction == 0.0 {
        return Some(frictionless);
    }
    if speed == 0.0 {
        return Some(Impulse { sticks: true, ..frictionless });
    }
    let tangent = sliding / speed;
    let across = inverse_mass * tangent;
    let (tangent_mobility, coupling) = (tangent.dot(&across), normal.dot(&across));
    let mixed = tangent.dot(&along);
    let determinant = normal_mobility * tangent_mobility - coupling * mixed;
    if determinant <= f64::EPSILON * normal_mobility * normal_mobility {
        // Boundaries hold both nodes along the tangent.
        return Some(frictionless);
    }
    let push = (approach * tangent_mobility + speed * coupling) / determinant;
    let drag = (-speed * normal_mobility - approach * mixed) / determinant;
    if push > 0.0 && drag.abs() <= friction * push {
        return Some(Impulse { on_second: normal * push + tangent * drag, sticks: true });
    }
    let mobility = normal_mobility - friction * coupling;
    let push = if mobility > 0.0 { approach / mobility } else { alone };
    Some(Impulse { on_second: (normal - tangent * friction) * push, sticks: false })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    fn act(velocity: [f64; 2], inverse_mass: Matrix2<f64>, friction: f64) -> Option<Impulse<2>> {
        coulomb(&Vector2::from(velocity), &inverse_mass, &Vector2::y(), 0.0, friction)
    }

    #[test]
    fn separating_nodes_are_left_alone() {
        assert_eq!(act([1.0, 0.1], Matrix2::identity(), 0.5), None);
    }

    #[test]
    fn slow_sliding_sticks_and_fast_sliding_slips() {
        let stuck = act([0.4, -1.0], Matrix2::identity() * 2.0, 0.5).unwrap();
        assert_eq!(stuck, Impulse { on_second: Vector2::new(-0.2, 0.5), sticks: true });
        let slips = act([0.6, -1.0], Matrix2::identity() * 2.0, 0.5).unwrap();
        assert_eq!(slips, Impulse { on_second: Vector2::new(-0.25, 0.5), sticks: false });
    }

    /// Both nodes held along x: only the approach can be stopped.
    #[test]
    fn a_held_direction_takes_no_impulse() {
        let held = Matrix2::new(0.0, 0.0, 0.0, 2.0);
        let impulse = act([0.6, -1.0], held, 0.5).unwrap();
        assert_eq!(impulse.on_second, Vector2::new(0.0, 0.5));
    }

    #[test]
    fn an_open_gap_may_close_in_the_step() {
        let (velocity, mass) = (Vector2::new(0.0, -1.0), Matrix2::identity());
        assert_eq!(coulomb(&velocity, &mass, &Vector2::y(), 1.5, 0.5), None);
        let impulse = coulomb(&velocity, &mass, &Vector2::y(), 0.25, 0.0).unwrap();
        assert_eq!(impulse.on_second, Vector2::new(0.0, 0.75));
    }
}
