//! Equations (8) and (9): strain increment, stress, deformation.

use nalgebra::{Matrix3, SVector};
use rayon::prelude::*;

use crate::error::SolidError;
use crate::grid::Grid;
use crate::grid_to_points::POINTS_PER_TASK;
use crate::kernel::Kernel;
use crate::material::{Material, MaterialModel};
use crate::objective::{incremental_motion, rotated};
use crate::parameters::Frame;
use crate::shape::with_shape;
use crate::solid::{Body, Solid};
use crate::stencil::PointStencil;
use crate::{plain, separable};

/// Arrays of a run of points.
struct Run<'a, const D: usize> {
    first: usize,
    site: &'a [SVector<f64, D>],
    velocity: &'a [SVector<f64, D>],
    reference_volume: &'a [f64],
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
    /// (G18); in the total frame `F_p ← F_p + Δt Σ_v v_v ⊗ ∂S_vp/∂X` (G15b).
    pub(crate) fn update_stress(&mut self, dt: f64) -> Result<(), SolidError> {
        let points = &mut self.state.points;
        let time = self.state.time + dt;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let grid = &self.fields[body.field].grid;
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let site = match body.discretisation.frame {
                Frame::Updated => &points.position[start..end],
                Frame::Total => &points.reference_position[start..end],
            };
            let runs = (
                site.par_chunks(POINTS_PER_TASK),
                points.velocity[start..end].par_chunks(POINTS_PER_TASK),
                points.reference_volume[start..end].par_chunks(POINTS_PER_TASK),
                points.volume[start..end].par_chunks_mut(POINTS_PER_TASK),
                points.deformation_gradient[start..end].par_chunks_mut(POINTS_PER_TASK),
                points.stress[start..end].par_chunks_mut(POINTS_PER_TASK),
            );
            let fault = runs
                .into_par_iter()
                .enumerate()
                .map(|(k, (site, velocity, reference_volume, volume, f, stress))| {
                    let first = start + k * POINTS_PER_TASK;
                    let deformation_gradient = f;
                    let run = Run {
                        first,
                        site,
                        velocity,
                        reference_volume,
                        volume,
                        deformation_gradient,
                        stress,
                    };
                    update_run(grid, body, dt, run)
                })
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

/// Chooses the compiled loop for the body's material and kernel.
fn update_run<const D: usize>(
    grid: &Grid<D>,
    body: &Body,
    dt: f64,
    run: Run<'_, D>,
) -> Option<Fault> {
    let geometry = &grid.geometry;
    match &body.material {
        MaterialModel::LinearElastic(material) => match body.kernel {
            Kernel::Plain => {
                let mut stencil = PointStencil::default();
                update_points(body.discretisation.frame, material, run, |site| {
                    stencil.evaluate(body, geometry, site);
                    plain::displacement_gradient(&stencil, grid, dt)
                })
            }
            Kernel::Separable => with_shape!(body, shape => {
                update_points(Frame::Updated, material, run, |site| {
                    let stencil = geometry.stencil(shape, site);
                    separable::displacement_gradient(grid, &stencil, dt * geometry.inverse_spacing)
                })
            }),
        },
    }
}

fn update_points<const D: usize>(
    frame: Frame,
    material: &impl Material,
    run: Run<'_, D>,
    mut gradient: impl FnMut(&SVector<f64, D>) -> Matrix3<f64>,
) -> Option<Fault> {
    for k in 0..run.site.len() {
        let before = run.deformation_gradient[k];
        let change = gradient(&run.site[k]);
        let (deformation, step_gradient) = match frame {
            Frame::Updated => ((Matrix3::identity() + change) * before, change),
            Frame::Total => match before.try_inverse() {
                Some(inverse) => (before + change, change * inverse),
                None => return Some(Fault::Inverted(run.first + k, before.determinant())),
            },
        };
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
    }
    None
}
