//! Tractions and pressures on the surface of a body.

use std::collections::HashSet;

use nalgebra::{Matrix3, SVector};

use crate::error::SolidError;
use crate::parameters::{Frame, LoadKind, SurfaceLoad, smooth_start};
use crate::points::Points;
use crate::solid::{Body, Solid};
use crate::tensor::Tensor;

/// A load with the faces that carry it.
#[derive(Debug, Clone)]
pub(crate) struct LoadedSurface<const D: usize> {
    load: SurfaceLoad<D>,
    /// Identities of the points.
    points: Vec<u32>,
}

impl<const D: usize> LoadedSurface<D> {
    /// Finds the faces of a load on the reference shape of its body.
    fn new(load: SurfaceLoad<D>, body: &Body, points: &Points<D>) -> Result<Self, SolidError> {
        let of_body = || (0..points.len()).filter(|&p| usize::from(points.body[p]) == load.body);
        let spacing = body.point_spacing;
        let anchor = of_body().next().map_or(SVector::zeros(), |p| points.reference_position[p]);
        let site = |x: &SVector<f64, D>| -> [i64; D] {
            std::array::from_fn(|d| ((x[d] - anchor[d]) / spacing).round() as i64)
        };
        let taken: HashSet<[i64; D]> =
            of_body().map(|p| site(&points.reference_position[p])).collect();
        let outward = if load.upper_side { 1.0 } else { -1.0 };
        let slack = 1e-6 * spacing;
        let mut loaded: Vec<u32> = of_body()
            .filter(|&p| {
                let mut centre = points.reference_position[p];
                centre[load.axis] += 0.5 * spacing * outward;
                let mut neighbour = points.reference_position[p];
                neighbour[load.axis] += spacing * outward;
                let inside = (0..D).all(|d| {
                    centre[d] >= load.lower[d] - slack && centre[d] <= load.upper[d] + slack
                });
                inside && !taken.contains(&site(&neighbour))
            })
            .map(|p| points.id[p])
            .collect();
        loaded.sort_unstable();
        if loaded.is_empty() {
            return Err(SolidError::Load {
                load: load.name.clone(),
                problem: format!(
                    "no free face of body '{}' that looks towards {}axis {} has its centre in the box {:?} to {:?} m; move or enlarge the box",
                    body.name,
                    if load.upper_side { "+" } else { "-" },
                    load.axis,
                    load.lower.as_slice(),
                    load.upper.as_slice()
                ),
            });
        }
        Ok(Self { load, points: loaded })
    }

    /// Time over which the load rises (s).
    pub fn ramp(&self) -> f64 {
        self.load.ramp
    }
}

fn validate<const D: usize>(load: &SurfaceLoad<D>, bodies: usize) -> Result<(), SolidError> {
    let fail = |problem| Err(SolidError::Load { load: load.name.clone(), problem });
    if load.body >= bodies {
        return fail(format!("its body has index {}; there are {bodies} bodies", load.body));
    }
    if load.axis >= D {
        return fail(format!("its axis is {}; it must be below {D}", load.axis));
    }
    if !(load.ramp.is_finite() && load.ramp >= 0.0) {
        return fail(format!("its ramp is {} s; it must be finite and at least 0", load.ramp));
    }
    let finite = match &load.kind {
        LoadKind::Traction(traction) => traction.iter().all(|t| t.is_finite()),
        LoadKind::Pressure(pressure) => pressure.is_finite(),
        LoadKind::Hydrostatic { level, specific_weight } => {
            level.is_finite() && specific_weight.is_finite()
        }
    };
    if finite { Ok(()) } else { fail("one of its values is not finite".into()) }
}

impl<const D: usize> Solid<D> {
    /// Sets the loads on surfaces, in place of those set before.
    ///
    /// # Errors
    /// [`SolidError::Load`] for a value outside its range or a load that finds no
    /// face.
    pub fn set_surface_loads(&mut self, loads: Vec<SurfaceLoad<D>>) -> Result<(), SolidError> {
        self.surfaces = loads
            .into_iter()
            .map(|load| {
                validate(&load, self.bodies.len())?;
                let body = &self.bodies[load.body];
                LoadedSurface::new(load, body, &self.state.points)
            })
            .collect::<Result<_, _>>()?;
        Ok(())
    }

    /// `f_v^ext += Σ_faces Σ_corners N_v(x_c) t A0/n_c` (G27): the load of a face is
    /// shared by its corners and reaches nodes through the grid's own linear
    /// functions, so that a uniform traction is balanced by a uniform stress.
    ///
    /// Corners move with the point, `x_c = x_p + F (X_c - X_p)`; pressure acts on
    /// the current area `cof F N A0` (Nanson). Returns the total force (N).
    pub(crate) fn apply_surface_loads(&mut self, dt: f64) -> SVector<f64, D> {
        let time = self.state.time + 0.5 * dt;
        let points = &self.state.points;
        let mut total = SVector::zeros();
        for LoadedSurface { load, points: loaded } in &self.surfaces {
            let body = &self.bodies[load.body];
            let grid = &mut self.fields[body.field].grid;
            grid.has_external_force = true;
            let half = 0.5 * body.point_spacing;
            let corners = 1 << (D - 1);
            let share = (2.0 * half).powi(D as i32 - 1) / f64::from(corners)
                * smooth_start(time, load.ramp);
            for &id in loaded {
                let p = self.index_of[id as usize] as usize;
                let gradient = &points.deformation_gradient[p];
                let area = current_area(gradient, load) * share;
                for corner in 0..corners {
                    let arm = corner_arm::<D>(load, corner, half);
                    let current = points.position[p] + linear_map(gradient, &arm);
                    let force = match &load.kind {
                        LoadKind::Traction(traction) => traction * share,
                        LoadKind::Pressure(pressure) => area * -pressure,
                        LoadKind::Hydrostatic { level, specific_weight } => {
                            area * (-specific_weight * (level - current[D - 1]).max(0.0))
                        }
                    };
                    let site = match body.discretisation.frame {
                        Frame::Updated => current,
                        Frame::Total => points.reference_position[p] + arm,
                    };
                    total += force;
                    grid.add_at(&site, &force);
                }
            }
        }
        total
    }
}

/// From the point to a corner of its loaded face, in the reference state.
fn corner_arm<const D: usize>(load: &SurfaceLoad<D>, corner: u32, half: f64) -> SVector<f64, D> {
    let mut bit = 0;
    SVector::from_fn(|d, _| {
        let upper = if d == load.axis {
            load.upper_side
        } else {
            bit += 1;
            corner >> (bit - 1) & 1 == 1
        };
        if upper { half } else { -half }
    })
}

/// `cof F N`: current area vector of a face of unit reference area.
fn current_area<const D: usize>(gradient: &Matrix3<f64>, load: &SurfaceLoad<D>) -> SVector<f64, D> {
    let cofactor = Tensor::from(gradient).cofactor();
    let outward = if load.upper_side { 1.0 } else { -1.0 };
    SVector::from_fn(|d, _| outward * cofactor.0[d][load.axis])
}

fn linear_map<const D: usize>(gradient: &Matrix3<f64>, arm: &SVector<f64, D>) -> SVector<f64, D> {
    SVector::from_fn(|i, _| (0..D).map(|j| gradient[(i, j)] * arm[j]).sum())
}
