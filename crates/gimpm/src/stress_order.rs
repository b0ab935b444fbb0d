//! The orders of the stress update other than the founding paper's.

use crate::error::SolidError;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// (8) and (9) at the start of the step, from `v_v = (mv)_v/m_v` before the
    /// forces act (update stress first; Bardenhagen 2002, J. Comput. Phys. 180,
    /// section 2). The weights are those of the step's start in every order.
    pub(crate) fn strain_first(&mut self, dt: f64) -> Result<(), SolidError> {
        self.points_to_grid();
        self.find_contact();
        self.map_momentum();
        self.constrain_remapped_velocity();
        self.separate_remapped_velocity(dt);
        self.expand_remapped_velocity();
        self.update_stress(dt, false)
    }

    /// (8) and (9) at its end from the grid's own v_v^L, without (7) (update
    /// stress last; Sulsky, Chen and Schreyer 1994).
    pub(crate) fn strain_last(&mut self, dt: f64) -> Result<(), SolidError> {
        self.take_grid_velocity();
        self.update_stress(dt, true)
    }
}
