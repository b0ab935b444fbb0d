//! Equations (8) and (9): strain increment, stress, deformation; then positions.

use nalgebra::{Matrix3, SVector};
use rayon::prelude::*;

use crate::error::SolidError;
use crate::grid::{Grid, Stencil};
use crate::grid_to_points::POINTS_PER_TASK;
use crate::material::{Material, MaterialModel};
use crate::objective::{incremental_motion, rotated};
use crate::shape::{ShapeFunction, with_shape};
use crate::solid::{Body, Solid};

/// Mutable arrays of a run of points, and what moves them.
struct Run<'a, const D: usize> {
    first: usize,
    displacement: &'a [SVector<f64, D>],
    velocity: &'a [SVector<f64, D>],
    reference_volume: &'a [f64],
    position: &'a mut [SVector<f64, D>],
    volume: &'a mut [f64],
    deformation_gradient: &'a mut [Matrix3<f64>],
    stress: &'a mut [[f64; 6]],
}

/// What is wrong with a point, by storage index.
enum Fault {
    NonFinite(usize, &'static str),
    Inverted(usize, f64),
}

impl<const D: usize> Solid<D> {
    /// `H = Δt Σ_v v_v ⊗ ∇S_vp` (G15), strain and rotation at mid-step (G16),
    /// `σ_p ← Q σ_p Qᵀ + C : Δε` (G17), `F_p ← (I + H) F_p`, `V_p = det F_p V0_p`
    /// (G18); then `x_p += Δx_p` from (6).
    pub(crate) fn update_stress(&mut self, dt: f64) -> Result<(), SolidError> {
        let grid = &self.grid;
        let points = &mut self.state.points;
        let time = self.state.time + dt;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let runs = (
                self.displacement[start..end].par_chunks(POINTS_PER_TASK),
                points.velocity[start..end].par_chunks(POINTS_PER_TASK),
                points.reference_volume[start..end].par_chunks(POINTS_PER_TASK),
                points.position[start..end].par_chunks_mut(POINTS_PER_TASK),
                points.volume[start..end].par_chunks_mut(POINTS_PER_TASK),
                points.deformation_gradient[start..end].par_chunks_mut(POINTS_PER_TASK),
                points.stress[start..end].par_chunks_mut(POINTS_PER_TASK),
            );
            let fault = runs
                .into_par_iter()
                .enumerate()
                .map(
                    |(
                        k,
                        (displacement, velocity, reference_volume, position, volume, f, stress),
                    )| {
                        let first = start + k * POINTS_PER_TASK;
                        let deformation_gradient = f;
                        update_run(
                            grid,
                            body,
                            dt,
                            Run {
                                first,
                                displacement,
                                velocity,
                                reference_volume,
                                position,
                                volume,
                                deformation_gradient,
                                stress,
                            },
                        )
                    },
                )
                .find_map_first(|fault| fault);
            if let Some(fault) = fault {
                return Err(match fault {
                    Fault::NonFinite(p, quantity) => {
                        SolidError::NonFinite { point: points.id[p], quantity, time }
                    }
                    Fault::Inverted(p, determinant) => {
                        SolidError::Inverted { point: points.id[p], determinant, time }
                    }
                });
            }
        }
        Ok(())
    }
}

/// Chooses the compiled loop for the body's material and shape function.
fn update_run<const D: usize>(
    grid: &Grid<D>,
    body: &Body,
    dt: f64,
    run: Run<'_, D>,
) -> Option<Fault> {
    match &body.material {
        MaterialModel::LinearElastic(material) => {
            with_shape!(body, shape => update_points(grid, shape, material, dt, run))
        }
    }
}

fn update_points<const D: usize>(
    grid: &Grid<D>,
    shape: impl ShapeFunction,
    material: &impl Material,
    dt: f64,
    run: Run<'_, D>,
) -> Option<Fault> {
    let factor = dt * grid.geometry.inverse_spacing;
    for k in 0..run.position.len() {
        let stencil = grid.geometry.stencil(shape, &run.position[k]);
        let step_gradient = displacement_gradient(grid, &stencil, factor);
        let deformation = (Matrix3::identity() + step_gradient) * run.deformation_gradient[k];
        let determinant = deformation.determinant();
        let Some(motion) = incremental_motion(&step_gradient) else {
            return Some(Fault::Inverted(run.first + k, determinant));
        };
        let turned = rotated(&run.stress[k], &motion.rotation);
        let stress = material.update_stress(turned, &motion.strain);
        if !run.velocity[k].iter().all(|v| v.is_finite()) {
            return Some(Fault::NonFinite(run.first + k, "velocity"));
        }
        if !(stress.iter().all(|s| s.is_finite()) && determinant.is_finite()) {
            return Some(Fault::NonFinite(run.first + k, "stress"));
        }
        if determinant <= 0.0 {
            return Some(Fault::Inverted(run.first + k, determinant));
        }
        run.stress[k] = stress;
        run.deformation_gradient[k] = deformation;
        run.volume[k] = determinant * run.reference_volume[k];
        run.position[k] += run.displacement[k];
    }
    None
}

/// `factor · Σ_v v_v ⊗ ∂S_vp` from the re-mapped velocity; the third row and
/// column are zero in plane strain.
#[inline(always)]
fn displacement_gradient<const D: usize>(
    grid: &Grid<D>,
    stencil: &Stencil,
    factor: f64,
) -> Matrix3<f64> {
    let [sx, sy, sz] = &stencil.value;
    let [gx, gy, gz] = &stencil.gradient;
    let stride = grid.geometry.stride;
    let mut columns = [[0.0; 4]; 3];
    for c in 0..stencil.count[2] {
        for b in 0..stencil.count[1] {
            let (yz, dy, dz) = (sy[b] * sz[c], gy[b] * sz[c], sy[b] * gz[c]);
            let start = stencil.first + b * stride[1] + c * stride[2];
            let row = &grid.remapped[start..start + 3];
            for k in 0..4 {
                let value = row[0][k] * sx[0] + row[1][k] * sx[1] + row[2][k] * sx[2];
                let slope = row[0][k] * gx[0] + row[1][k] * gx[1] + row[2][k] * gx[2];
                columns[0][k] += slope * yz;
                columns[1][k] += value * dy;
                columns[2][k] += value * dz;
            }
        }
    }
    Matrix3::from_fn(|i, j| factor * columns[j][i])
}
