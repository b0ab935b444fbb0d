//! The pair force between a fluid particle and a wall point (C2, C4).
//!
//! Rigid walls and structures use the same function, and so do the particle loop and
//! the gather of loads: action and reaction are the same bits with opposite sign.

use crate::Kernel;
use nalgebra::SVector;

/// A fluid particle `a` as a wall point sees it.
#[derive(Debug, Clone, Copy)]
pub struct FluidSide<const D: usize> {
    /// `x_a` (m).
    pub position: SVector<f64, D>,
    /// `v_a` (m/s).
    pub velocity: SVector<f64, D>,
    /// `V_a` (m^D).
    pub volume: f64,
    /// `ρ_a` (kg/m³).
    pub density: f64,
    /// `p_a` (Pa).
    pub pressure: f64,
    /// Share of a tension that a wall may exert on it, `τ_a` from 0 at a free surface to
    /// 1 under water (`tension_share`).
    pub tension: f64,
}

/// Share `τ` of a tension between wall and particle, from the particle's filling `Σ V W`:
/// 0 up to 0.8, where water leaves the wall freely, 1 from 0.95 on, linear between.
///
/// Under water a wall that recedes pulls the water along: the ambient pressure, which
/// the equation of state leaves out, holds the two together. Without that the closure
/// loses its balance of work as soon as a pressure wave passes through zero, and the
/// motion of an elastic gate depends on the speed of sound instead of converging with it.
pub fn tension_share(filling: f64) -> f64 {
    ((filling - 0.8) / 0.15).clamp(0.0, 1.0)
}

/// A wall point `p` as the fluid sees it.
#[derive(Debug, Clone, Copy)]
pub struct WallSide<const D: usize> {
    /// `x_p` (m).
    pub position: SVector<f64, D>,
    /// `v̄_p` (m/s): mean velocity over the fluid step (C1).
    pub velocity: SVector<f64, D>,
    /// `V_p` (m^D), capped so that `Σ V W <= 1`.
    pub volume: f64,
}

/// The force on the fluid particle, and the parts of its pressure sum that are not
/// exchanged with compression energy (the ledger's losses).
#[derive(Debug, Clone, Copy)]
pub struct WallForce<const D: usize> {
    /// `F_ap` (N), on the fluid particle; the wall point gets exactly `-F_ap`.
    pub force: SVector<f64, D>,
    /// Force per pressure `-V_a V_p ∇W_ap` (m^(D-1)).
    pub area: SVector<f64, D>,
    /// Impact pressure `β ρ_a w` (Pa), dissipative.
    pub impact: f64,
    /// Pressure sum less `impact` and `2 p_a` (Pa): hydrostatic offset and cuts of tension.
    pub offset: f64,
}

/// Constants of the closure.
#[derive(Debug, Clone, Copy)]
pub struct WallClosure<const D: usize, K> {
    /// The fluid's kernel.
    pub kernel: K,
    /// Gravity `g` (m/s²).
    pub gravity: SVector<f64, D>,
    /// `c0` (m/s).
    pub sound_speed: f64,
}

impl<const D: usize, K: Kernel<D>> WallClosure<D, K> {
    /// Force of wall point `p` on fluid particle `a` at `distance = |x_a - x_p|` (C2, C4):
    ///
    /// `F_ap = -V_a V_p [p_a + p_p + β ρ_a w]_τ ∇W_ap`, `p_p = [p_a + ρ_a g·(x_p - x_a)]_τ`,
    /// `w = max(0, -2 (v_a - v̄_p)·e_ap)`, `β = min(3w, c0)`, where `[x]_τ` is `x` under
    /// pressure and `τ_a x` under tension.
    ///
    /// The factor 2 is the mirrored normal velocity `2 v̄_p - v_a`; `β ρ_a w` is then
    /// the Riemann term (S6) between the particle and its mirror image.
    #[inline(always)]
    pub fn force(&self, a: &FluidSide<D>, p: &WallSide<D>, distance: f64) -> WallForce<D> {
        let offset = a.position - p.position;
        let cut = |x: f64| x.max(a.tension * x);
        let mirrored = cut(a.pressure - a.density * self.gravity.dot(&offset));
        // The smallest float keeps 0/0 out of a particle exactly on a wall point.
        let approach = -2.0 * (a.velocity - p.velocity).dot(&offset);
        let w = (approach / (distance + f64::MIN_POSITIVE)).max(0.0);
        let impact = (3.0 * w).min(self.sound_speed) * a.density * w;
        let sum = cut(a.pressure + mirrored + impact);
        let scale = -(a.volume * p.volume) * self.kernel.gradient_factor(distance);
        let area = offset * scale;
        WallForce { force: area * sum, area, impact, offset: sum - impact - 2.0 * a.pressure }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::WendlandC2;

    fn push(pressure: f64, tension: f64) -> f64 {
        let zero = SVector::zeros();
        let closure = WallClosure::<2, WendlandC2<2>> {
            kernel: WendlandC2::new(0.15),
            gravity: zero,
            sound_speed: 20.0,
        };
        let a = FluidSide {
            position: SVector::from([0.1, 0.0]),
            velocity: zero,
            volume: 0.01,
            density: 1000.0,
            pressure,
            tension,
        };
        let p = WallSide { position: zero, velocity: zero, volume: 0.01 };
        closure.force(&a, &p, 0.1).force[0]
    }

    #[test]
    fn pressure_pushes_and_only_submerged_water_is_pulled() {
        let under_pressure = push(500.0, 0.0);
        assert!(under_pressure > 0.0);
        assert_eq!(push(500.0, 1.0), under_pressure);
        assert_eq!(push(-500.0, 0.0), 0.0);
        assert_eq!(push(-500.0, 1.0), -under_pressure);
    }

    #[test]
    fn tension_is_continuous_in_the_filling() {
        assert_eq!([0.5, 0.8, 0.96, 1.02].map(tension_share), [0.0, 0.0, 1.0, 1.0]);
        assert!((tension_share(0.875) - 0.5).abs() < 1e-12);
    }
}
