//! Checkpoint state: everything a bit-identical continuation needs.

use crate::ledger::{FluidEnergy, FluidLedger};
use crate::{Fluid, FluidError, Kernel, Particles};

/// Complete state between two steps, as plain data.
///
/// Together with the parameters and walls given to [`Fluid::new`] it determines the rest
/// of the run bit for bit. The structure is not part of it: its owner sets it every step.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidState<const D: usize> {
    /// Simulated time (s).
    pub time: f64,
    /// Steps taken.
    pub steps: u64,
    /// Particles in their sorted order.
    pub particles: Particles<D>,
    /// Search cell of each particle at the last sort.
    pub cell: Vec<u32>,
    /// Work, losses, removed particles.
    pub ledger: FluidLedger<D>,
    /// Energy at the start of the run (J).
    pub initial_energy: FluidEnergy,
    /// Largest distance moved since the last sort (m).
    pub slack: f64,
    /// Largest acceleration of the last kick (m/s²), for the time step.
    pub maximum_acceleration: f64,
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Copies the state.
    pub fn state(&self) -> FluidState<D> {
        FluidState {
            time: self.time,
            steps: self.steps,
            particles: self.particles.clone(),
            cell: self.table.sorted_keys(),
            ledger: self.ledger,
            initial_energy: self.initial_energy,
            slack: self.slack,
            maximum_acceleration: self.maximum_acceleration,
        }
    }

    /// Continues from `state`, on a fluid built with the same parameters and walls.
    ///
    /// Wall forces refer to the momentum pass of a step, so they are available again
    /// after the next step; until then they are those of the restored state.
    ///
    /// # Errors
    /// [`FluidError::Length`] if the arrays do not belong together or to this lattice;
    /// [`FluidError::NonFinite`].
    pub fn restore_state(&mut self, state: FluidState<D>) -> Result<(), FluidError> {
        let expected = state.particles.len();
        let found = state.cell.len();
        if found != expected || !state.particles.is_consistent() {
            return Err(FluidError::Length { array: "restored particles", expected, found });
        }
        let cells = self.lattice.cells();
        let ordered = state.cell.is_sorted();
        if let Some(&last) = state.cell.iter().max().filter(|&&c| c as usize >= cells || !ordered) {
            let found = last as usize;
            return Err(FluidError::Length { array: "restored cells", expected: cells, found });
        }
        self.time = state.time;
        self.steps = state.steps;
        self.particles = state.particles;
        self.table.keys = state.cell;
        self.table.sort_keys(cells);
        self.ledger = state.ledger;
        self.initial_energy = state.initial_energy;
        self.slack = state.slack;
        self.maximum_acceleration = state.maximum_acceleration;
        self.exchange.clear();
        self.move_walls_to(self.time, 0.0);
        self.walls.locate(&self.lattice);
        self.pack_midpoint();
        self.measure_speed()
    }
}
