use nalgebra::SVector;

use crate::SolidImpulse;

/// Momentum exchanged in one step, measured on each side by itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepBalance<const D: usize> {
    /// Length of the step (s).
    pub dt: f64,
    /// Impulse of the structure on the fluid, summed over fluid particles (N s).
    pub fluid_impulse: SVector<f64, D>,
    /// What entered the solid (N s).
    pub solid_impulse: SolidImpulse<D>,
}

/// Conservation record of the exchange.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CouplingLedger {
    /// Relative momentum residual of the last step.
    pub momentum_residual: f64,
    /// Largest residual since [`Self::start_row`].
    pub largest_in_row: f64,
    /// Largest residual of the whole run.
    pub largest_momentum_residual: f64,
    /// Accumulated interface work seen by the solid, Σ Δt Σ f_p·v̄_p (J).
    pub work_on_solid: f64,
    /// Accumulated work mismatch, Σ Δt Σ f_p·(v̄ assumed - v̄) (J): what the
    /// last corrector left between the two sides.
    pub work_mismatch: f64,
}

impl CouplingLedger {
    /// Forgets the row's extreme; called after an output row was written.
    pub fn start_row(&mut self) {
        self.largest_in_row = 0.0;
    }

    /// Adds one step.
    ///
    /// The residual is
    /// `|I_fluid + ΔP_solid - I_loads - I_supports| / (Δt Σ|f_p| + |I_loads| + |I_supports|)`:
    /// what the fluid side and the solid side, supports included, disagree by,
    /// relative to the impulses that passed. Where the fluid passes none, `Σ m|v|` of the
    /// solid joins the denominator: the reaction of a vibrating solid goes through 0.
    pub(crate) fn close_step<const D: usize>(
        &mut self,
        balance: &StepBalance<D>,
        load: &[SVector<f64, D>],
        assumed_velocity: &[SVector<f64, D>],
        mean_velocity: &[SVector<f64, D>],
    ) {
        let solid = &balance.solid_impulse;
        let residual = balance.fluid_impulse + solid.momentum_change - solid.loads - solid.supports;
        let [size, work, mismatch] = ordered_reduction::sum(load.len(), |index| {
            let force = load[index];
            let mean = mean_velocity[index];
            [force.norm(), force.dot(&mean), force.dot(&(assumed_velocity[index] - mean))]
        });
        let passed = balance.dt * size + solid.loads.norm() + solid.supports.norm();
        let scale = if size > 0.0 { passed } else { passed + solid.magnitude };
        self.momentum_residual = if scale > 0.0 { residual.norm() / scale } else { 0.0 };
        self.largest_in_row = self.largest_in_row.max(self.momentum_residual);
        self.largest_momentum_residual = self.largest_momentum_residual.max(self.momentum_residual);
        self.work_on_solid += balance.dt * work;
        self.work_mismatch += balance.dt * mismatch;
    }
}
