//! One step: equations (1) to (9) of the founding paper, in order.

use crate::error::SolidError;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// Advances the solid by `dt` (s): modified update stress last, FLIP.
    ///
    /// Call it from inside a rayon pool (`pool.install`): from outside, each of its
    /// dozen parallel loops pays for waking the pool.
    ///
    /// # Errors
    /// [`SolidError`] for a step that is too large, a point that left the grid or
    /// drifted too far from its sorted cell, a quantity that is not finite, an
    /// inverted point. After an error in mid-step the solid refuses to go on
    /// until a state is restored.
    pub fn step(&mut self, dt: f64) -> Result<(), SolidError> {
        self.check_time_step(dt)?;
        self.points_to_grid(); //              (1) mass and momentum, (2) internal force
        self.update_grid_momentum(dt); //      (3) a_v, (4) v_v^L
        self.constrain_acceleration(dt); //    boundary conditions on a_v and v_v^L
        self.record_work(dt);
        self.grid_to_points(dt); //            (5) v_p, (6) displacement of x_p
        self.remap_momentum(); //              (7) v_v from the new v_p
        self.constrain_remapped_velocity(); // boundary conditions again
        let stressed = self.update_stress(dt); // (8) strain, (9) stress; x_p moves by (6)
        let outcome = stressed.and_then(|()| self.finish_step(dt));
        self.failure = outcome.clone().err();
        outcome
    }

    /// Clock, speed bound, loads used up, layout still valid.
    fn finish_step(&mut self, dt: f64) -> Result<(), SolidError> {
        self.state.time += dt;
        self.state.steps += 1;
        self.state.maximum_speed = self.measure_maximum_speed();
        self.state.drift += self.measure_maximum_displacement();
        self.grid.clear_external_force();
        self.check_layout()
    }
}
