//! One step: equations (1) to (9) of the founding paper, in order.

use crate::error::SolidError;
use crate::parameters::StressUpdate;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// Advances the solid by `dt` (s).
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
        let order = self.parameters.stress_update;
        let strained = if order == StressUpdate::First { self.strain_first(dt) } else { Ok(()) };
        let surface_force = self.apply_surface_loads(dt);
        self.points_to_grid(); //              (1) mass and momentum, (2) internal force
        self.update_grid_momentum(dt); //      (3) a_v, (4) v_v^L
        self.constrain_acceleration(dt); //    boundary conditions on a_v and v_v^L
        self.find_contact();
        self.exchange_contact_impulses(dt); // contact on a_v and v_v^L
        self.expand_velocity(dt); //           v^(k) by the full mass matrix, if asked for
        self.record_work(dt, surface_force);
        self.grid_to_points(dt); //            (5) v_p, (6) displacement of x_p
        let stressed = strained.and_then(|()| match order {
            StressUpdate::ModifiedLast => self.strain_modified_last(dt),
            StressUpdate::Last => self.strain_last(dt),
            StressUpdate::First => Ok(()),
        });
        let outcome = stressed.and_then(|()| self.finish_step(dt));
        self.failure = outcome.clone().err();
        outcome
    }

    /// (7) v_v from the new v_p, boundary conditions and contact again, (8) strain, (9) stress.
    fn strain_modified_last(&mut self, dt: f64) -> Result<(), SolidError> {
        self.remap_momentum();
        self.constrain_remapped_velocity();
        self.separate_remapped_velocity(dt);
        self.expand_remapped_velocity();
        self.update_stress(dt, true)
    }

    /// Clock, speed bound, loads used up, layout still valid; x_p moves by (6) if it has
    /// not moved with the stress update.
    fn finish_step(&mut self, dt: f64) -> Result<(), SolidError> {
        if self.parameters.stress_update == StressUpdate::First {
            self.move_points();
        }
        self.state.time += dt;
        self.state.steps += 1;
        self.state.maximum_speed = self.checked_maximum_speed()?;
        self.state.drift += self.fastest.displacement_squared.sqrt();
        self.clear_external_force();
        if self.layout_holds { Ok(()) } else { self.check_layout() }
    }
}
