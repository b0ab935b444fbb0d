//! Equations (8) and (9), and the internal force of the next step's (2).

use super::assembly::clear;
use super::momentum::add;
use super::pattern::Pattern;
use super::slabs::{Slab, scatter, split};
use super::{Block, Lattice};
use crate::constitutive::{ConstitutiveRun, Deformed, Fault};
use crate::grid::{Grid, RemapRecord};
use crate::lanes::{BLOCK, Lanes, load, load_matrices};
use crate::material::{Material, MaterialModel, with_material};
use crate::parameters::Frame;
use crate::points::Points;
use crate::tensor::Tensor;

/// What one task changes.
pub(super) struct Strain<'a> {
    pub slab: &'a Slab,
    pub run: ConstitutiveRun<'a>,
    pub fault: Option<Fault>,
}

impl<const D: usize> Lattice<D> {
    /// Deformation (G15b), volume (G18) and stress (G16, G17) of the points and the
    /// internal force (G6b) of their new stress in one sweep.
    ///
    /// # Errors
    /// The first point of the slab at fault, and what is wrong in the slab.
    pub fn update_stress(
        &mut self,
        material: &MaterialModel,
        points: &mut Points<D>,
        grid: &Grid<D>,
        dt: f64,
    ) -> Result<(), (usize, Fault)> {
        let range = self.start..self.start + self.count;
        let remembered = if material.has_history() { range.clone() } else { 0..0 };
        let mut volume = split(&self.slabs, &mut points.volume[range.clone()]);
        let mut gradient = split(&self.slabs, &mut points.deformation_gradient[range.clone()]);
        let mut stress = split(&self.slabs, &mut points.stress[range.clone()]);
        let mut history = split(&self.slabs, &mut points.history[range.clone()]);
        let reference_volume = &points.reference_volume[range];
        let mut tasks = Vec::with_capacity(self.slabs.len());
        for slab in &self.slabs {
            let (Some(volume), Some(deformation_gradient), Some(stress), Some(history)) =
                (volume.next(), gradient.next(), stress.next(), history.next())
            else {
                break;
            };
            let run = ConstitutiveRun {
                reference_volume: &reference_volume[slab.points.clone()],
                volume,
                deformation_gradient,
                stress,
                history: if remembered.is_empty() { &mut [] } else { history },
            };
            tasks.push(Strain { slab, run, fault: None });
        }
        let mut force = std::mem::take(&mut self.force.records);
        clear(&mut force);
        self.force.is_current = false;
        with_material!(material, law => scatter(&mut tasks, self.plane, &mut force, |task, first, records| {
            let done = if self.mean_dilatation {
                self.strain_mean_dilatation(task, law, grid, dt, first, records)
            } else {
                self.strain(task, law, grid, dt, first, records)
            };
            task.fault = done.err();
        }));
        let fault = tasks
            .iter()
            .find_map(|task| task.fault.map(|fault| (self.start + task.slab.points.start, fault)));
        self.force.records = force;
        self.force.is_current = fault.is_none();
        fault.map_or(Ok(()), Err)
    }

    #[inline(always)]
    fn strain(
        &self,
        task: &mut Strain<'_>,
        law: &impl Material,
        grid: &Grid<D>,
        dt: f64,
        first: usize,
        records: &mut [RemapRecord],
    ) -> Result<(), Fault> {
        for block in &self.blocks[task.slab.blocks.clone()] {
            let pattern = &self.patterns[block.pattern as usize];
            let change = self.change(&grid.remapped, block, pattern, dt);
            let places = block.range(task.slab.points.start);
            let deformed = task.run.advance(law, Frame::Total, places, &change)?;
            let local = &mut records[block.node as usize - first..];
            self.add_force(local, pattern, block.count, &deformed);
        }
        Ok(())
    }

    /// `ΔF = Δt Σ_v v_v ⊗ ∂S_vp/∂X` (G15b).
    #[inline(always)]
    pub(super) fn change(
        &self,
        remapped: &[RemapRecord],
        block: &Block,
        pattern: &Pattern,
        dt: f64,
    ) -> Tensor<Lanes> {
        let nodes = &remapped[block.node as usize..];
        let mut change = [[Lanes::splat(0.0); 3]; 3];
        for v in 0..1 << D {
            let velocity = &nodes[self.corner[v]];
            for i in 0..D {
                let along = Lanes::splat(velocity[i]);
                for j in 0..D {
                    change[i][j] = along.mul_add(pattern.gradient[v][j], change[i][j]);
                }
            }
        }
        Tensor(change).scaled(Lanes::splat(dt))
    }

    /// Adds `-Σ_p V0 P_p · ∂S_vp/∂X` with `P = σ cof F` (G6b), the corners in the lanes.
    #[inline(always)]
    pub(super) fn add_force(
        &self,
        records: &mut [RemapRecord],
        pattern: &Pattern,
        count: u32,
        deformed: &Deformed,
    ) {
        let cofactor = deformed.deformation_gradient.cofactor();
        let nominal = Tensor::from_symmetric(&deformed.stress) * cofactor;
        let mut by_component = [[[0.0; BLOCK]; D]; D];
        for i in 0..D {
            for j in 0..D {
                by_component[i][j] = nominal.0[i][j].to_array();
            }
        }
        let mut sum = [[Lanes::splat(0.0); D]; D];
        let mut add_point = |p: usize| {
            let gradient = &pattern.corner_gradient[p];
            for i in 0..D {
                for j in 0..D {
                    let component = Lanes::splat(by_component[i][j][p]);
                    sum[i][j] = component.mul_add(gradient[j], sum[i][j]);
                }
            }
        };
        if count as usize == BLOCK {
            (0..BLOCK).for_each(&mut add_point);
        } else {
            (0..count as usize).for_each(&mut add_point);
        }
        let mut force = [Lanes::splat(0.0); D];
        for i in 0..D {
            for j in 0..D {
                force[i] += sum[i][j];
            }
            force[i] *= Lanes::splat(-self.point_volume);
        }
        add(records, &self.corner, &force);
    }

    /// Internal force of the points' stress, where it was not carried over.
    pub(super) fn refresh_force(&mut self, points: &Points<D>) {
        if self.force.is_current {
            return;
        }
        let range = self.start..self.start + self.count;
        let gradients = &points.deformation_gradient[range.clone()];
        let stresses = &points.stress[range];
        let mut force = std::mem::take(&mut self.force.records);
        clear(&mut force);
        scatter(&mut self.slabs.clone(), self.plane, &mut force, |slab, first, records| {
            for block in &self.blocks[slab.blocks.clone()] {
                let places = block.range(0);
                let deformed = Deformed {
                    deformation_gradient: load_matrices(&gradients[places.clone()]),
                    stress: load(&stresses[places]),
                };
                let pattern = &self.patterns[block.pattern as usize];
                let local = &mut records[block.node as usize - first..];
                self.add_force(local, pattern, block.count, &deformed);
            }
        });
        self.force.records = force;
        self.force.is_current = true;
    }
}
