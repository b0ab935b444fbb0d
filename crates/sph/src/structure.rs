//! The externally driven structure: location, volume cap, density corrector (C1–C3).

use crate::momentum::{Accelerated, GRAIN, points};
use crate::{Boundary, Fluid, FluidError, Kernel};
use nalgebra::SVector;
use rayon::prelude::*;
use std::mem::take;

/// Which particles the structure touches, with reused buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct NearStructure<const D: usize> {
    /// Particles with structure points in their neighbour cells, by slot.
    pub reached: Vec<u32>,
    /// `reached` and the particles with one of those in their neighbour cells.
    pub affected: Vec<u32>,
    pub results: Vec<Accelerated<D>>,
    pub loads: Vec<SVector<f64, D>>,
    flags: Vec<bool>,
    /// `reached` particles before each slot.
    counts: Vec<u32>,
    volumes: Vec<f64>,
    rates: Vec<f64>,
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Points of the structure, in the caller's order.
    pub fn structure(&self) -> &Boundary<D> {
        &self.structure
    }

    /// The structure's points, for [`Boundary::set_points`].
    pub fn structure_mut(&mut self) -> &mut Boundary<D> {
        &mut self.structure
    }

    /// Builds the structure's cell table, caps its volumes and finds the particles
    /// within its reach. Call it at mid-step, after `set_points`.
    ///
    /// Cap: near fluid, `V_p` is divided by `Σ_q V_q W_pq` over structure points where
    /// that sum exceeds 1, as where bodies overlap. A regular tiling is unaffected.
    pub fn locate_structure(&mut self) {
        self.structure.locate(&self.lattice);
        self.near.reached.clear();
        self.near.affected.clear();
        if self.structure.sorted.is_empty() {
            return;
        }
        self.cap_volumes();
        self.find_near();
    }

    fn cap_volumes(&mut self) {
        let mut volumes = take(&mut self.near.volumes);
        self.structure
            .sorted
            .par_iter()
            .with_min_len(GRAIN)
            .map(|p| {
                if !self.sees(&p.position, |first, end| !self.table.slots(first, end).is_empty()) {
                    return p.volume;
                }
                let support = self.kernel.support();
                let mut filling = 0.0;
                self.lattice.for_each_run(&p.position, support, |first, end| {
                    for q in points(&self.structure, first, end) {
                        let square = (p.position - q.position).norm_squared();
                        if square < support * support {
                            filling += q.volume * self.kernel.value(square.sqrt());
                        }
                    }
                });
                p.volume / filling.max(1.0)
            })
            .collect_into_vec(&mut volumes);
        for (point, &volume) in self.structure.sorted.iter_mut().zip(&volumes) {
            point.volume = volume;
        }
        self.near.volumes = volumes;
    }

    fn find_near(&mut self) {
        let mut near = take(&mut self.near);
        self.flag(&mut near.flags, |first, end| !points(&self.structure, first, end).is_empty());
        collect_flagged(&near.flags, &mut near.reached);
        near.counts.clear();
        near.counts.push(0);
        let mut count = 0;
        near.counts.extend(near.flags.iter().map(|&flag| {
            count += u32::from(flag);
            count
        }));
        self.flag(&mut near.flags, |first, end| {
            let slots = self.table.slots(first, end);
            near.counts[slots.end] > near.counts[slots.start]
        });
        collect_flagged(&near.flags, &mut near.affected);
        self.near = near;
    }

    /// Flags every particle with a neighbour run for which `test` holds.
    fn flag(&self, flags: &mut Vec<bool>, test: impl Fn(usize, usize) -> bool + Sync) {
        self.midpoint
            .par_iter()
            .with_min_len(GRAIN)
            .map(|a| self.sees(&a.position, &test))
            .collect_into_vec(flags);
    }

    fn sees(&self, x: &SVector<f64, D>, test: impl Fn(usize, usize) -> bool) -> bool {
        let mut seen = false;
        self.lattice.for_each_run(x, self.kernel.support(), |first, end| seen |= test(first, end));
        seen
    }

    /// Corrector (C3): replaces the structure velocities `old` of the first half drift
    /// by `new` (m/s, caller's order):
    /// `ρ_a += Δt/2 · 2 ρ_a Σ_p V_p (old_p - new_p)·∇W_ap`, then `v̄_p := new_p`.
    ///
    /// # Errors
    /// [`FluidError::Length`] if the slices do not match the structure.
    pub fn correct_density(
        &mut self,
        dt: f64,
        old: &[SVector<f64, D>],
        new: &[SVector<f64, D>],
    ) -> Result<(), FluidError> {
        let expected = self.structure.len();
        for (array, found) in [("old velocity", old.len()), ("new velocity", new.len())] {
            if found != expected {
                return Err(FluidError::Length { array, expected, found });
            }
        }
        let mut rates = take(&mut self.near.rates);
        self.near
            .reached
            .par_iter()
            .with_min_len(GRAIN)
            .map(|&i| self.wall_divergence(i as usize, |p| old[p] - new[p]))
            .collect_into_vec(&mut rates);
        let eos = self.equation_of_state;
        for (&i, &divergence) in self.near.reached.iter().zip(&rates) {
            let a = &mut self.midpoint[i as usize];
            // Under tension only the share that the load depends on, as in `continuity.rs`.
            let share = if a.pressure < 0.0 { a.tension } else { 1.0 };
            let deviation = &mut self.particles.density_deviation[i as usize];
            *deviation += dt * a.density * divergence * share;
            a.density = eos.reference_density + *deviation;
            a.volume = self.mass / a.density;
            a.pressure = eos.pressure(*deviation);
        }
        self.near.rates = rates;
        self.set_structure_velocity(new)
    }

    /// Gives the structure's points the mean velocities `v̄_p` (m/s, caller's order) that
    /// they really had, for the continuity pass that follows.
    ///
    /// # Errors
    /// [`FluidError::Length`] if the slice does not match the structure.
    pub fn set_structure_velocity(
        &mut self,
        velocity: &[SVector<f64, D>],
    ) -> Result<(), FluidError> {
        let (expected, found) = (self.structure.len(), velocity.len());
        if found != expected {
            return Err(FluidError::Length { array: "structure velocity", expected, found });
        }
        self.structure.velocity.copy_from_slice(velocity);
        self.structure.refresh_velocity();
        Ok(())
    }

    /// `Σ_p V_p u_p·∇W_ap` over structure points `p` with velocity `u_p`.
    fn wall_divergence(&self, i: usize, u: impl Fn(usize) -> SVector<f64, D>) -> f64 {
        let a = &self.midpoint[i];
        let support = self.kernel.support();
        let mut divergence = 0.0;
        self.lattice.for_each_run(&a.position, support, |first, end| {
            for slot in self.structure.table.slots(first, end) {
                let p = &self.structure.sorted[slot];
                let offset = a.position - p.position;
                let square = offset.norm_squared();
                if square < support * support {
                    let velocity = u(self.structure.table.order[slot] as usize);
                    divergence += p.volume
                        * self.kernel.gradient_factor(square.sqrt())
                        * velocity.dot(&offset);
                }
            }
        });
        divergence
    }
}

fn collect_flagged(flags: &[bool], list: &mut Vec<u32>) {
    list.clear();
    list.extend((0_u32..).zip(flags).filter(|&(_, &flag)| flag).map(|(i, _)| i));
}
