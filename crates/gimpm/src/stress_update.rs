//! Equations (8) and (9): strain increment, deformation, stress.

use nalgebra::SVector;
use rayon::prelude::*;

use crate::constitutive::{ConstitutiveRun, Fault};
use crate::error::SolidError;
use crate::field::Field;
use crate::grid::{Grid, GridGeometry};
use crate::grid_to_points::POINTS_PER_TASK;
use crate::kernel::Kernel;
use crate::lanes::{BLOCK, Lanes};
use crate::layout_check::Reach;
use crate::material::{Material, with_material};
use crate::parameters::Frame;
use crate::points::{Points, front};
use crate::solid::{Body, Solid};
use crate::tensor::Tensor;
use crate::{plain, separable};

/// Points whose gradients are gathered before their law is evaluated: few enough
/// to stay in the nearest cache, many enough to make choosing the law free.
const POINTS_PER_PASS: usize = 64;

/// Change of the deformation of [`POINTS_PER_PASS`] points, block by block.
pub(crate) type Changes = [Tensor<Lanes>; POINTS_PER_PASS / BLOCK];

/// Points of one slab that one task handles.
struct Task<'a, const D: usize> {
    /// Storage index of the first of them.
    start: usize,
    slab: usize,
    position: &'a mut [SVector<f64, D>],
    reference_position: &'a [SVector<f64, D>],
    displacement: &'a [SVector<f64, D>],
    run: ConstitutiveRun<'a>,
}

/// What a task found.
#[derive(Debug, Clone, Copy)]
struct Outcome {
    /// Its first fault, by storage index.
    fault: Option<(usize, Fault)>,
    /// Whether all points are inside the grid and on the planes of their slab.
    inside: bool,
}

impl Outcome {
    fn and(self, later: Self) -> Self {
        Self { fault: self.fault.or(later.fault), inside: self.inside && later.inside }
    }
}

impl<const D: usize> Solid<D> {
    /// `H = Δt Σ_v v_v ⊗ ∇S_vp` (G15), strain and rotation at mid-step (G16),
    /// `σ_p ← Q σ_p Qᵀ + C : Δε` (G17) or the stress of a hyperelastic law,
    /// `F_p ← (I + H) F_p`, `V_p = det F_p V0_p` (G18); in the total frame
    /// `F_p ← F_p + Δt Σ_v v_v ⊗ ∂S_vp/∂X` (G15b).
    ///
    /// With `moves`, this is the last use of the weights of the step's start, and the
    /// points move by (6) in the same sweep.
    pub(crate) fn update_stress(&mut self, dt: f64, moves: bool) -> Result<(), SolidError> {
        let time = self.state.time + dt;
        let mut inside = true;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let Field { grid, lattice, .. } = &mut self.fields[body.field];
            let faulty = if let Some(lattice) = lattice {
                let done = lattice.update_stress(&body.material, &mut self.state.points, grid, dt);
                done.err().map(|(start, fault)| (start + fault.place(), fault))
            } else {
                let mut tasks = tasks(&mut self.state.points, &self.displacement, offsets);
                let outcome = tasks
                    .par_iter_mut()
                    .map(|task| {
                        let fault = task.strain(body, grid, dt).err();
                        let fault = fault.map(|(p, fault)| (task.start + p, fault));
                        let inside = !moves || task.advance_position(body, &grid.geometry);
                        Outcome { fault, inside }
                    })
                    .reduce(|| Outcome { fault: None, inside: true }, Outcome::and);
                inside &= outcome.inside;
                outcome.fault
            };
            if let Some((p, fault)) = faulty {
                let point = self.state.points.id[p];
                return Err(match fault {
                    Fault::NonFinite(_) => {
                        SolidError::NonFinite { point, quantity: "stress", time }
                    }
                    Fault::Inverted(_, determinant) => {
                        SolidError::Inverted { point, determinant, time }
                    }
                });
            }
        }
        self.layout_holds = moves && inside;
        Ok(())
    }
}

/// Cuts the points of a body into tasks that do not straddle slabs.
fn tasks<'a, const D: usize>(
    points: &'a mut Points<D>,
    displacement: &'a [SVector<f64, D>],
    offsets: &[usize],
) -> Vec<Task<'a, D>> {
    let (first, last) = (offsets[0], offsets[offsets.len() - 1]);
    let mut position = &mut points.position[first..last];
    let mut volume = &mut points.volume[first..last];
    let mut deformation_gradient = &mut points.deformation_gradient[first..last];
    let mut stress = &mut points.stress[first..last];
    let mut history = &mut points.history[first..last];
    let mut tasks = Vec::with_capacity((last - first) / POINTS_PER_TASK + offsets.len());
    for (slab, range) in offsets.windows(2).enumerate() {
        for start in (range[0]..range[1]).step_by(POINTS_PER_TASK) {
            let end = (start + POINTS_PER_TASK).min(range[1]);
            let count = end - start;
            tasks.push(Task {
                start,
                slab,
                position: front(&mut position, count),
                reference_position: &points.reference_position[start..end],
                displacement: &displacement[start..end],
                run: ConstitutiveRun {
                    reference_volume: &points.reference_volume[start..end],
                    volume: front(&mut volume, count),
                    deformation_gradient: front(&mut deformation_gradient, count),
                    stress: front(&mut stress, count),
                    history: front(&mut history, count),
                },
            });
        }
    }
    tasks
}

impl<const D: usize> Task<'_, D> {
    /// Strain and stress; a fault comes with the place of its point in the task.
    fn strain(&mut self, body: &Body, grid: &Grid<D>, dt: f64) -> Result<(), (usize, Fault)> {
        let frame = body.discretisation.frame;
        let sites = match frame {
            Frame::Updated => &*self.position,
            Frame::Total => self.reference_position,
        };
        let gradients = match body.kernel {
            Kernel::Plain | Kernel::Lattice => plain::displacement_gradients,
            Kernel::Separable => separable::displacement_gradients,
        };
        let mut changes = [Tensor([[Lanes::splat(0.0); 3]; 3]); POINTS_PER_PASS / BLOCK];
        for (pass, sites) in sites.chunks(POINTS_PER_PASS).enumerate() {
            let first = pass * POINTS_PER_PASS;
            let before = &self.run.deformation_gradient[first..];
            gradients(body, grid, dt, sites, before, &mut changes);
            let done = with_material!(&body.material, law => {
                advance(&mut self.run, law, frame, first, sites.len(), &changes)
            });
            done.map_err(|fault| (fault.place(), fault))?;
        }
        Ok(())
    }

    /// `x_p += Δx_p` (6); returns whether all points stay where scatters may find them.
    fn advance_position(&mut self, body: &Body, geometry: &GridGeometry<D>) -> bool {
        let mut reach = Reach::default();
        for (position, displacement) in self.position.iter_mut().zip(self.displacement) {
            *position += displacement;
            reach.include(position);
        }
        reach.is_held(body, geometry, self.slab)
    }
}

fn advance(
    run: &mut ConstitutiveRun<'_>,
    law: &impl Material,
    frame: Frame,
    first: usize,
    count: usize,
    changes: &Changes,
) -> Result<(), Fault> {
    for (block, change) in changes[..count.div_ceil(BLOCK)].iter().enumerate() {
        let start = first + block * BLOCK;
        run.advance(law, frame, start..(start + BLOCK).min(first + count), change)?;
    }
    Ok(())
}
