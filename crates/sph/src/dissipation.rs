//! Dissipation between two fluid particles, as an addition to their pressure sum (S5, S6).
//!
//! Both models act along the line of centres. The pair force is
//! `-V_i V_j (p_i + p_j + Q_ij) ∇W_ij`, and `Q_ij >= 0` is what this file supplies.

/// Dissipative part `Q_ij` (Pa) of a pair's pressure sum; zero for receding particles.
///
/// # Example
/// A model of one's own, checked by the conformance macro:
/// ```
/// use sph::PairDissipation;
///
/// /// Acoustic Riemann solution without limiter: `Q = ρ c w`.
/// #[derive(Clone, Copy)]
/// struct Acoustic { sound_speed: f64 }
///
/// impl PairDissipation for Acoustic {
///     fn pressure(&self, mean_density: f64, velocity_dot_offset: f64, distance: f64) -> f64 {
///         let w = -velocity_dot_offset / (distance + f64::MIN_POSITIVE);
///         mean_density * self.sound_speed * w.max(0.0)
///     }
/// }
///
/// sph::pair_dissipation_conformance!(acoustic, Acoustic { sound_speed: 30.0 });
/// # fn main() {}
/// ```
pub trait PairDissipation: Copy + Send + Sync {
    /// `Q_ij` (Pa) from the mean density `ρ̄` (kg/m³), `(v_i - v_j)·(x_i - x_j)` (m²/s)
    /// and the distance `|x_i - x_j|` (m), which is zero for a particle with itself.
    fn pressure(&self, mean_density: f64, velocity_dot_offset: f64, distance: f64) -> f64;
}

/// No dissipation: `Q = 0`.
#[derive(Debug, Clone, Copy)]
pub struct Inviscid;

impl PairDissipation for Inviscid {
    #[inline(always)]
    fn pressure(&self, _: f64, _: f64, _: f64) -> f64 {
        0.0
    }
}

/// Artificial viscosity (S5; Monaghan 1992 eq. 4.1–4.2 with β = 0):
/// `Q = -α ρ̄ c0 h min(0, v_ij·x_ij)/(|x_ij|² + 0.01 h²)`.
#[derive(Debug, Clone, Copy)]
pub struct ArtificialViscosity {
    strength: f64,
    softening: f64,
}

impl ArtificialViscosity {
    /// From `α`, `c0` (m/s) and `h` (m).
    pub fn new(alpha: f64, sound_speed: f64, smoothing_length: f64) -> Self {
        Self {
            strength: alpha * sound_speed * smoothing_length,
            softening: 0.01 * smoothing_length * smoothing_length,
        }
    }
}

impl PairDissipation for ArtificialViscosity {
    #[inline(always)]
    fn pressure(&self, mean_density: f64, velocity_dot_offset: f64, distance: f64) -> f64 {
        let approach = -velocity_dot_offset.min(0.0);
        self.strength * mean_density * approach / (distance * distance + self.softening)
    }
}

/// Low-dissipation Riemann term (S6; Zhang, Hu and Adams 2017 eq. 12–16).
///
/// With `w = U_L - U_R` the approach speed along the line of centres,
/// `p* = ½(p_i + p_j) + ½ β ρ̄ w`, `β = min(η max(w, 0), c0)`; the force
/// `-2 p* V_i V_j ∇W` means `Q = β ρ̄ w`.
#[derive(Debug, Clone, Copy)]
pub struct RiemannLimiter {
    /// `η`, 3 in the paper.
    pub limiter: f64,
    /// `c0` (m/s).
    pub sound_speed: f64,
}

impl PairDissipation for RiemannLimiter {
    #[inline(always)]
    fn pressure(&self, mean_density: f64, velocity_dot_offset: f64, distance: f64) -> f64 {
        // The smallest float keeps 0/0 out of a particle's pair with itself.
        let w = (-velocity_dot_offset / (distance + f64::MIN_POSITIVE)).max(0.0);
        (self.limiter * w).min(self.sound_speed) * mean_density * w
    }
}

/// Tests that every [`PairDissipation`](crate::PairDissipation) must pass, as one module
/// named `$name`: finite for a particle with itself, never negative, zero for receding
/// particles, proportional to density.
#[macro_export]
macro_rules! pair_dissipation_conformance {
    ($name:ident, $model:expr) => {
        #[cfg(test)]
        mod $name {
            #[allow(unused_imports)]
            use super::*;
            #[allow(unused_imports)] // in scope already where the trait is defined
            use $crate::PairDissipation as _;

            #[test]
            fn self_pair_is_zero() {
                assert_eq!(($model).pressure(1000.0, 0.0, 0.0), 0.0);
            }

            #[test]
            fn only_approach_dissipates() {
                for k in -20..=20 {
                    let rate = f64::from(k) * 0.01;
                    let q = ($model).pressure(1000.0, rate, 0.05);
                    assert!(q.is_finite() && q >= 0.0);
                    assert!(rate < 0.0 || q == 0.0, "{rate}: {q}");
                }
            }

            #[test]
            fn proportional_to_density() {
                let (light, heavy) =
                    (($model).pressure(500.0, -0.02, 0.05), ($model).pressure(1000.0, -0.02, 0.05));
                assert!((heavy - 2.0 * light).abs() <= 1e-12 * heavy);
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::pair_dissipation_conformance!(inviscid, Inviscid);
    crate::pair_dissipation_conformance!(artificial, ArtificialViscosity::new(0.02, 30.0, 0.1));
    crate::pair_dissipation_conformance!(
        riemann,
        RiemannLimiter { limiter: 3.0, sound_speed: 30.0 }
    );

    #[test]
    fn riemann_is_quadratic_below_and_acoustic_above_the_limit() {
        let model = RiemannLimiter { limiter: 3.0, sound_speed: 30.0 };
        let r = 0.1;
        assert!((model.pressure(1000.0, -2.0 * r, r) - 3.0 * 1000.0 * 4.0).abs() < 1e-9);
        assert!((model.pressure(1000.0, -20.0 * r, r) - 30.0 * 1000.0 * 20.0).abs() < 1e-6);
    }
}
