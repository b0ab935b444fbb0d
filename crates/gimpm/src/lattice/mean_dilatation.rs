//! The volume ratio of a cell instead of each point's own, against locking.
//!
//! Near incompressibility a cell's points ask for constant volume one by one,
//! which is more than its corners can give: it locks. Here the law sees
//! `F̄ = (θ/J)^⅓ F` with one ratio `θ = Σ V0 J/Σ V0` for the cell, and the points bear
//! `σ = (θ/J) dev σ̄ + p I` with `p = Σ V0 p̄/Σ V0`, `p̄ = ⅓ tr σ̄` (G28; Nagtegaal, Parks
//! and Rice 1974; Simo, Taylor and Pister 1985, Comput. Methods Appl. Mech. Eng.
//! 51, section 3).
//!
//! That σ is the one whose virtual work is the change of `Σ V0 W(F̄)`: with
//! `τ̄ = θ σ̄` it is `Σ V0 [dev τ̄ : ∇δu + p̄ δθ]`, and `δθ = Σ V0 J div δu/Σ V0` turns the
//! second part into `Σ V0 J p div δu`. A law with split energy has the same p̄ at
//! all points of a cell; for others the mean is what keeps energy.
//!
//! In plane strain `F33 = 1` but `F̄33 = (θ/J)^⅓`: the split is that of three
//! dimensions, deviator `J^(-⅓) F` with all three axes, as in B̄ (Hughes 1980). Only
//! the cell's mean has no strain along z; since `δF33 = 0`, the work above holds.
//!
//! A law in rate form continues from `σ̄`, which the stored σ gives back, by the
//! step gradient of F̄.

use super::stress::Strain;
use super::{Block, Lattice};
use crate::constitutive::{Deformed, Fault};
use crate::grid::{Grid, RemapRecord};
use crate::lanes::{Lanes, load, load_matrices, store};
use crate::material::{Material, MaterialState, StepMotion};
use crate::points::Points;
use crate::real::Real;
use crate::symmetric::{deviator, plus_isotropic, trace};
use crate::tensor::Tensor;

impl<const D: usize> Lattice<D> {
    /// Deformation, stress and internal force as [`Lattice::strain`] does, cell by cell.
    #[inline(always)]
    pub(super) fn strain_mean_dilatation(
        &self,
        task: &mut Strain<'_>,
        law: &impl Material,
        grid: &Grid<D>,
        dt: f64,
        first: usize,
        records: &mut [RemapRecord],
    ) -> Result<(), Fault> {
        for cell in self.blocks[task.slab.blocks.clone()].chunk_by(|a, b| a.node == b.node) {
            let ratio = self.cell_ratio(task, cell, grid, dt);
            let pressure = self.strain_cell(task, cell, law, grid, dt, &ratio)?;
            for block in cell {
                let places = block.range(task.slab.points.start);
                let own = load(&task.run.stress[places.clone()]);
                let stress = plus_isotropic(&deviator(&own), Lanes::splat(pressure));
                store(&stress, &mut task.run.stress[places.clone()]);
                let gradients = &task.run.deformation_gradient[places];
                let deformed = Deformed { deformation_gradient: load_matrices(gradients), stress };
                let pattern = &self.patterns[block.pattern as usize];
                let local = &mut records[block.node as usize - first..];
                self.add_force(local, pattern, block.count, &deformed);
            }
        }
        Ok(())
    }

    /// θ of a cell before and after the step; its points have equal V0.
    #[inline(always)]
    fn cell_ratio(&self, task: &Strain<'_>, cell: &[Block], grid: &Grid<D>, dt: f64) -> [f64; 2] {
        let (mut sums, mut count) = ([Lanes::splat(0.0); 2], 0);
        for block in cell {
            let pattern = &self.patterns[block.pattern as usize];
            let places = block.range(task.slab.points.start);
            let before = load_matrices(&task.run.deformation_gradient[places]);
            let after = before + self.change(&grid.remapped, block, pattern, dt);
            sums[0] += before.determinant() * pattern.present;
            sums[1] += after.determinant() * pattern.present;
            count += block.count;
        }
        sums.map(|sum| sum.to_array().iter().sum::<f64>() / f64::from(count))
    }

    /// New F and stress `(θ/J) dev σ̄ + p̄ I` of the points of a cell; returns the mean
    /// of p̄.
    #[inline(always)]
    fn strain_cell(
        &self,
        task: &mut Strain<'_>,
        cell: &[Block],
        law: &impl Material,
        grid: &Grid<D>,
        dt: f64,
        ratio: &[f64; 2],
    ) -> Result<f64, Fault> {
        let run = &mut task.run;
        let (mut sum, mut count) = (0.0, 0);
        for block in cell {
            let pattern = &self.patterns[block.pattern as usize];
            let change = self.change(&grid.remapped, block, pattern, dt);
            let places = block.range(task.slab.points.start);
            let memory = if run.history.is_empty() { 0..0 } else { places.clone() };
            let before = load_matrices(&run.deformation_gradient[places.clone()]);
            let after = before + change;
            // J/θ before the step, θ/J after it.
            let shrunk = before.determinant() * (1.0 / ratio[0]);
            let swollen = Lanes::splat(ratio[1]) / after.determinant();
            let scale = swollen.cbrt();
            let growth = scale * shrunk.cbrt();
            let spherical = Tensor::diagonal([growth - Lanes::splat(1.0); 3]);
            let motion = StepMotion {
                deformation_gradient: after.scaled(scale),
                step_gradient: spherical + (change * before.inverse()).scaled(growth),
            };
            let own: [Lanes; 6] = load(&run.stress[places.clone()]);
            let mut state = MaterialState {
                stress: scaled_deviator(&own, shrunk),
                history: load(&run.history[memory.clone()]),
            };
            law.update(&motion, &mut state);
            let stress = scaled_deviator(&state.stress, swollen);
            run.accept(places, &Deformed { deformation_gradient: after, stress })?;
            store(&state.history, &mut run.history[memory]);
            let pressure = trace(&state.stress) * (1.0 / 3.0) * pattern.present;
            sum += pressure.to_array().iter().sum::<f64>();
            count += block.count;
        }
        Ok(sum / f64::from(count))
    }

    /// Deformation gradient and stress of a point as its law sees them: F̄ and σ̄ with
    /// mean dilatation, else its own. `p` is a storage index.
    pub fn seen_by_law(&self, points: &Points<D>, p: usize) -> (Tensor<f64>, [f64; 6]) {
        let own = Tensor::from(&points.deformation_gradient[p]);
        let stress = points.stress[p];
        if !self.mean_dilatation {
            return (own, stress);
        }
        let place = (p - self.start) as u32;
        let here = self.blocks.partition_point(|block| block.first <= place) - 1;
        let node = self.blocks[here].node;
        let from = self.blocks[..here].iter().rev().take_while(|b| b.node == node).count();
        let (mut sum, mut count) = (0.0, 0);
        for block in self.blocks[here - from..].iter().take_while(|b| b.node == node) {
            let gradients = &points.deformation_gradient[self.start..][block.range(0)];
            sum += gradients.iter().map(|f| Tensor::from(f).determinant()).sum::<f64>();
            count += block.count;
        }
        let swollen = sum / f64::from(count) / own.determinant();
        (own.scaled(swollen.cbrt()), scaled_deviator(&stress, 1.0 / swollen))
    }
}

/// `factor · dev σ + ⅓ tr σ I`.
#[inline(always)]
fn scaled_deviator<R: Real>(stress: &[R; 6], factor: R) -> [R; 6] {
    let mean = trace(stress) * (1.0 / 3.0);
    plus_isotropic(&deviator(stress).map(|component| component * factor), mean)
}

#[cfg(test)]
mod tests {
    use nalgebra::SVector;

    use crate::{
        BodySeed, Discretisation, Frame, InitialVelocity, LinearElastic, Loops, MaterialModel,
        NeoHookean, Solid, SolidParameters, StressUpdate,
    };

    /// A ball with cells filled in part, `per_axis` points along an axis of a full one.
    fn ball<const D: usize>(
        material: MaterialModel,
        per_axis: usize,
        mean_dilatation: bool,
    ) -> Solid<D> {
        let spacing = 0.1 / per_axis as f64;
        let across = 4 * per_axis;
        let points: Vec<SVector<f64, D>> = (0..across.pow(D as u32))
            .map(|k| {
                SVector::from_fn(|d, _| {
                    ((k / across.pow(d as u32) % across) as f64 + 0.5) * spacing
                })
            })
            .filter(|x: &SVector<f64, D>| (x - SVector::repeat(0.2)).norm() < 0.19)
            .collect();
        let seed = BodySeed {
            name: "ball".into(),
            material,
            points,
            velocity: InitialVelocity::Uniform(SVector::zeros()),
            point_spacing: spacing,
            discretisation: Discretisation {
                frame: Frame::Total,
                mean_dilatation,
                ..Discretisation::default()
            },
        };
        let parameters = SolidParameters {
            gravity: SVector::zeros(),
            gravity_ramp: 0.0,
            stress_update: StressUpdate::ModifiedLast,
            loops: Loops::Fast,
            contact: None,
            relaxation: None,
            courant_number: 0.5,
            grid_spacing: 0.1,
            grid_origin: SVector::zeros(),
            grid_cells: [4; D],
            damping: 0.0,
        };
        Solid::new(parameters, vec![seed], Vec::new()).unwrap()
    }

    /// Work of the internal force over the change of energy, less one, when the
    /// nodes of a strained ball move a little.
    fn work_error<const D: usize>(material: &MaterialModel, per_axis: usize, mean: bool) -> f64 {
        let mut solid = ball::<D>(material.clone(), per_axis, mean);
        let shake = |solid: &mut Solid<D>, size: f64, phase: f64| {
            let grid = &mut solid.fields[0].grid;
            for (v, record) in grid.remapped.iter_mut().enumerate() {
                for d in 0..D {
                    record[d] = size * ((3 * v + d) as f64 * 1.7 + phase).sin();
                }
            }
            solid.update_stress(1.0, false).unwrap();
        };
        (0..20).for_each(|k| shake(&mut solid, 6e-4, 0.1 * f64::from(k)));
        let before = solid.energy().strain;
        let force = solid.fields[0].lattice.as_ref().unwrap().force.records.clone();
        shake(&mut solid, 1e-7, 0.9);
        let gained = solid.energy().strain - before;
        let field = &solid.fields[0];
        let after = &field.lattice.as_ref().unwrap().force.records;
        let mut work = 0.0;
        for ((a, b), v) in force.iter().zip(after).zip(field.grid.remapped.iter()) {
            work -= (0..D).map(|d| 0.5 * (a[d] + b[d]) * v[d]).sum::<f64>();
        }
        work / gained - 1.0
    }

    /// The internal force is the derivative of the stored energy at finite strain, for a
    /// law whose pressure differs from point to point as well.
    #[test]
    fn the_internal_force_derives_from_the_energy() {
        let law = NeoHookean { density: 1.0, young_modulus: 1.0e6, poisson_ratio: 0.3 };
        for mean in [false, true] {
            for per_axis in [1, 2, 3] {
                let law = law.into();
                let errors =
                    [work_error::<2>(&law, per_axis, mean), work_error::<3>(&law, per_axis, mean)];
                println!("{per_axis} points an axis, mean dilatation {mean}: {errors:?}");
                assert!(errors.iter().all(|e| e.abs() < 1e-6), "{errors:?}");
            }
        }
    }

    /// One point a cell: its ratio is the cell's, so nothing may change.
    #[test]
    fn a_single_point_sees_its_own_volume_ratio() {
        let elastic = LinearElastic { density: 1.0, young_modulus: 1.0e6, poisson_ratio: 0.3 };
        let run = |mean| {
            let mut solid = ball::<3>(elastic.into(), 1, mean);
            for (v, record) in solid.fields[0].grid.remapped.iter_mut().enumerate() {
                (0..3).for_each(|d| record[d] = 1e-2 * ((3 * v + d) as f64 * 1.7).sin());
            }
            (0..5).for_each(|_| solid.update_stress(1.0, false).unwrap());
            solid.state.points.stress
        };
        let size = 1.0e6;
        for (a, b) in run(false).iter().flatten().zip(run(true).iter().flatten()) {
            assert!((a - b).abs() < 1e-12 * size, "{a} {b}");
        }
    }
}
