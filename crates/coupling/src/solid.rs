use gimpm::Solid;
use nalgebra::SVector;

use crate::{CouplingError, SolidImpulse, SolidSide, StructurePoints, TimeStepLimit};

impl<const D: usize> SolidSide<D> for Solid<D> {
    fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> {
        let limit = Solid::stable_time_step(self)?;
        Ok(Some(TimeStepLimit { value: limit.value, term: limit.term }))
    }

    fn points(&mut self, structure: &mut StructurePoints<D>) {
        if self.needs_sort() {
            self.sort_points();
        }
        let points = Solid::points(self);
        structure.id.clone_from(&points.id);
        structure.body.clone_from(&points.body);
        structure.position.clone_from(&points.position);
        structure.velocity.clone_from(&points.velocity);
        structure.volume.clone_from(&points.volume);
    }

    fn save(&mut self) {
        Solid::save(self);
    }

    fn restore(&mut self) {
        Solid::restore(self);
    }

    fn advance(
        &mut self,
        dt: f64,
        substeps: u32,
        load: &[SVector<f64, D>],
        end_position: &mut [SVector<f64, D>],
    ) -> Result<SolidImpulse<D>, CouplingError> {
        let substep = dt / f64::from(substeps);
        let start = self.momentum();
        let mut impulse = SolidImpulse::zero();
        for _ in 0..substeps {
            self.scatter_point_force(load);
            self.step(substep)?;
            let held = &self.state().reactions;
            impulse.loads += self.state().load * substep;
            impulse.supports +=
                held.iter().map(|reaction| reaction.force * substep).sum::<SVector<f64, D>>();
        }
        impulse.momentum_change = self.momentum() - start;
        let points = Solid::points(self);
        [impulse.magnitude] = ordered_reduction::sum(points.len(), |point| {
            [points.mass[point] * points.velocity[point].norm()]
        });
        end_position.copy_from_slice(&Solid::points(self).position);
        Ok(impulse)
    }
}
