//! Pressure, volume and stored energy from the density deviation (S2).

/// Linear equation of state `p = c0² (ρ - ρ0)` (S2; Monaghan 1994 linearised).
///
/// The argument is the deviation `ρ - ρ0`, which keeps the digits of the pressure:
/// at Mach 0.1 the deviation is below 1 % of `ρ`.
///
/// ```
/// let water = sph::LinearEquationOfState { reference_density: 1000.0, sound_speed: 20.0 };
/// assert_eq!(water.pressure(2.5), 1000.0);
/// assert!(water.specific_energy(2.5) > 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearEquationOfState {
    /// `ρ0` (kg/m³).
    pub reference_density: f64,
    /// `c0` (m/s).
    pub sound_speed: f64,
}

impl LinearEquationOfState {
    /// Pressure (Pa) at deviation `ρ - ρ0` (kg/m³).
    #[inline(always)]
    pub fn pressure(&self, density_deviation: f64) -> f64 {
        self.sound_speed * self.sound_speed * density_deviation
    }

    /// Density deviation (kg/m³) at pressure `p` (Pa).
    pub fn density_deviation(&self, pressure: f64) -> f64 {
        pressure / (self.sound_speed * self.sound_speed)
    }

    /// Compression energy per mass (J/kg):
    /// `∫ p/ρ² dρ = c0² [ln(ρ/ρ0) + ρ0/ρ - 1]`, zero at rest and positive elsewhere.
    pub fn specific_energy(&self, density_deviation: f64) -> f64 {
        let x = density_deviation / self.reference_density;
        self.sound_speed * self.sound_speed * (x.ln_1p() - x / (1.0 + x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn energy_is_the_integral_of_pressure_over_density_squared() {
        let fluid = LinearEquationOfState { reference_density: 1000.0, sound_speed: 30.0 };
        for deviation in [-40.0, -1.0, 3.0, 60.0] {
            let intervals = 10_000;
            let width = deviation / f64::from(intervals);
            let integral: f64 = (0..intervals)
                .map(|k| (f64::from(k) + 0.5) * width)
                .map(|d| fluid.pressure(d) / (1000.0 + d).powi(2) * width)
                .sum();
            let energy = fluid.specific_energy(deviation);
            assert!((energy - integral).abs() < 1e-7 * energy, "{deviation}: {energy} {integral}");
        }
    }
}
