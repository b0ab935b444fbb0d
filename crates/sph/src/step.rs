//! One step of the fluid alone: the phases in order.

use crate::{Fluid, FluidError, Kernel};

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Advances the fluid by `dt` (s): drift–kick–drift with one force evaluation (S9;
    /// Zhang, Hu et al. 2020, position-based Verlet). The structure, if any, rests
    /// where it was located last.
    ///
    /// # Errors
    /// [`FluidError`] of the phases; the state is then unusable for further steps.
    pub fn step(&mut self, dt: f64) -> Result<(), FluidError> {
        self.drift_to_midpoint(dt)?; // S9, S7: positions, densities, walls, cells
        self.evaluate_acceleration(); // S4-S6, C2, C4
        self.kick(dt); // S9, S10
        self.evaluate_density_rate(); // S3, C3
        self.drift_to_end(dt) // S9
    }
}
