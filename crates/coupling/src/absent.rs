use nalgebra::SVector;

use crate::{CouplingError, FluidSide, SolidImpulse, SolidSide, StructurePoints, TimeStepLimit};

/// No fluid: the solid alone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NoFluid;

/// No solid: the fluid alone, between rigid walls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NoSolid;

impl<const D: usize> FluidSide<D> for NoFluid {
    fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> {
        Ok(None)
    }

    fn predict(&mut self, _: f64, _: &StructurePoints<D>) -> Result<(), CouplingError> {
        Ok(())
    }

    fn load(&mut self, load: &mut [SVector<f64, D>]) {
        load.fill(SVector::zeros());
    }

    fn correct(
        &mut self,
        _: f64,
        _: &[SVector<f64, D>],
        _: &[SVector<f64, D>],
        _: &mut [SVector<f64, D>],
    ) -> Result<(), CouplingError> {
        Ok(())
    }

    fn finish(&mut self, _: f64, _: &[SVector<f64, D>]) -> Result<SVector<f64, D>, CouplingError> {
        Ok(SVector::zeros())
    }
}

impl<const D: usize> SolidSide<D> for NoSolid {
    fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> {
        Ok(None)
    }

    fn points(&mut self, _: &mut StructurePoints<D>) {}

    fn save(&mut self) {}

    fn restore(&mut self) {}

    fn advance(
        &mut self,
        _: f64,
        _: u32,
        _: &[SVector<f64, D>],
        _: &mut [SVector<f64, D>],
    ) -> Result<SolidImpulse<D>, CouplingError> {
        Ok(SolidImpulse::zero())
    }
}
