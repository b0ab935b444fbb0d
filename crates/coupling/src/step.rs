//! One coupled step: the sequence of design §4, nothing else.

use crate::{Coupled, CouplingError, FluidSide, SolidSide, StepBalance};

impl<const D: usize, F: FluidSide<D>, S: SolidSide<D>> Coupled<D, F, S> {
    /// Advances both sides by `dt` (s).
    ///
    /// # Errors
    /// Either side refuses its part; the state is then that of the failed phase.
    pub fn step(&mut self, dt: f64) -> Result<(), CouplingError> {
        let substeps = self.substep_count(dt)?;

        // 1  fluid drifts half a step; wall points predicted with the mean velocity of the last step
        self.predict_structure(dt);
        self.fluid.predict(dt, &self.structure)?;

        // 2  pair forces at mid-step (C2), (C4)
        self.fluid.load(&mut self.load);

        // 3  solid sub-steps with the frozen load (C5);  4  mean wall velocity (C1)
        let correctors = self.corrector_count();
        if correctors > 0 {
            self.solid.save();
        }
        let mut solid_impulse = self.advance_solid(dt, substeps)?;

        // 5  correctors: the load again with the velocity that the wall really had
        for _ in 0..correctors {
            if !self.velocity_changed() {
                break;
            }
            self.fluid.correct(dt, &self.assumed_velocity, &self.mean_velocity, &mut self.load)?;
            self.assumed_velocity.copy_from_slice(&self.mean_velocity);
            self.solid.restore();
            solid_impulse = self.advance_solid(dt, substeps)?;
        }

        // 6  kick with the numbers that were scattered;  7  fluid drifts half a step
        let fluid_impulse = self.fluid.finish(dt, &self.mean_velocity)?;

        // 8  ledger
        let balance = StepBalance { dt, fluid_impulse, solid_impulse };
        self.ledger.close_step(&balance, &self.load, &self.assumed_velocity, &self.mean_velocity);
        self.complete_step(dt);
        Ok(())
    }
}
