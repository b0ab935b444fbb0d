use nalgebra::SVector;
use sph::{BoundarySet, Fluid};

use crate::{CouplingError, FluidSide, StructurePoints, TimeStepLimit};

impl<const D: usize> FluidSide<D> for Fluid<D> {
    fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> {
        let limit = Fluid::stable_time_step(self)?;
        Ok(Some(TimeStepLimit { value: limit.value, term: limit.term }))
    }

    fn predict(&mut self, dt: f64, points: &StructurePoints<D>) -> Result<(), CouplingError> {
        self.drift_to_midpoint(dt)?;
        if !points.position.is_empty() {
            let structure = self.structure_mut();
            structure.set_points(&points.position, &points.velocity, &points.volume)?;
            self.locate_structure();
        }
        Ok(())
    }

    fn load(&mut self, load: &mut [SVector<f64, D>]) {
        self.evaluate_acceleration();
        gather(self, load);
    }

    fn correct(
        &mut self,
        dt: f64,
        old: &[SVector<f64, D>],
        new: &[SVector<f64, D>],
        load: &mut [SVector<f64, D>],
    ) -> Result<(), CouplingError> {
        self.correct_density(dt, old, new)?;
        self.evaluate_near_structure();
        gather(self, load);
        Ok(())
    }

    fn finish(
        &mut self,
        dt: f64,
        velocity: &[SVector<f64, D>],
    ) -> Result<SVector<f64, D>, CouplingError> {
        self.kick(dt);
        let impulse = self.force_from_structure() * dt;
        self.set_structure_velocity(velocity)?;
        self.evaluate_density_rate();
        self.drift_to_end(dt)?;
        Ok(impulse)
    }
}

fn gather<const D: usize>(fluid: &mut Fluid<D>, load: &mut [SVector<f64, D>]) {
    if !load.is_empty() {
        fluid.evaluate_boundary_force(BoundarySet::Structure);
        load.copy_from_slice(&fluid.structure().force);
    }
}
