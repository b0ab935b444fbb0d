//! Observables at points, along lines and on walls.

use crate::ledger::sum_vector;
use crate::momentum::points;
use crate::{Fluid, Kernel};
use nalgebra::SVector;
use ordered_reduction::sum;

/// Filling (`Σ V W`) below which a sample counts as dry: 1.0 inside the fluid, 0.5 at a
/// flat wall or surface, 0.125 in a 3D corner.
const DRY: f64 = 0.05;

/// The fluid at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<const D: usize> {
    /// Pressure (Pa): `Σ V_j W (p_j + ρ_j g·(x - x_j))/Σ V_j W`; 0 where dry.
    pub pressure: f64,
    /// Velocity (m/s): `Σ V_j W v_j/Σ V_j W`; 0 where dry.
    pub velocity: SVector<f64, D>,
    /// `Σ V_j W` over fluid: 1 inside, 0.5 at a flat wall, below 0.05 dry.
    pub filling: f64,
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Shepard mean of the fluid around `x`, with the hydrostatic gradient removed from
    /// the pressure so that a gauge on a wall reads the pressure of the wall's face.
    pub fn sample(&self, x: &SVector<f64, D>) -> Sample<D> {
        let (mut filling, mut pressure, mut velocity) = (0.0, 0.0, SVector::zeros());
        self.for_each_neighbour(x, |j, weight| {
            let offset = x - self.particles.position[j];
            let density = self.parameters.reference_density + self.particles.density_deviation[j];
            filling += weight;
            pressure +=
                weight * (self.pressure(j) + density * self.parameters.gravity.dot(&offset));
            velocity += self.particles.velocity[j] * weight;
        });
        if filling < DRY {
            return Sample { pressure: 0.0, velocity: SVector::zeros(), filling };
        }
        Sample { pressure: pressure / filling, velocity: velocity / filling, filling }
    }

    /// Distance (m) from `base` to the highest free surface on the line to `top`, 0 if
    /// there is no fluid on it.
    ///
    /// The surface is where `Σ V W = ½ (1 - Σ_walls V W)`: half filled, wherever walls
    /// leave only part of the kernel to the fluid.
    pub fn water_level(&self, base: &SVector<f64, D>, top: &SVector<f64, D>) -> f64 {
        let length = (top - base).norm();
        let pieces = (length / (0.25 * self.parameters.spacing)).ceil().max(1.0);
        let excess = |s: f64| self.surface_excess(&(base + (top - base) * s));
        let mut above = excess(1.0);
        if above >= 0.0 {
            return length;
        }
        for piece in (0..pieces as usize).rev() {
            let s = piece as f64 / pieces;
            let below = excess(s);
            if below >= 0.0 {
                return length * (s + below / (below - above) / pieces);
            }
            above = below;
        }
        0.0
    }

    /// Largest `x·direction` (m) over particles that are not spray, plus `dx/2`;
    /// `-∞` if there are none. Spray has fewer than `2D - 1` neighbours.
    pub fn front(&self, direction: &SVector<f64, D>) -> f64 {
        let unit = direction.normalize();
        let position = &self.particles.position;
        let mut ahead: Vec<(f64, usize)> =
            position.iter().enumerate().map(|(i, x)| (x.dot(&unit), i)).collect();
        ahead.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let connected = |&&(_, i): &&(f64, usize)| {
            let mut count = 0;
            self.for_each_neighbour(&position[i], |_, _| count += 1);
            count >= 2 * D
        };
        ahead
            .iter()
            .find(connected)
            .map_or(f64::NEG_INFINITY, |&(x, _)| x + 0.5 * self.parameters.spacing)
    }

    /// Force (N; N/m in 2D) and moment about `about` (N m; out-of-plane in 2D, third
    /// component) of the fluid on wall `group`, in the last step's momentum pass (C5).
    pub fn wall_force(&self, group: usize, about: &SVector<f64, D>) -> (SVector<f64, D>, [f64; 3]) {
        let walls = &self.walls;
        let loads: [f64; 6] = sum(walls.sorted.len(), |slot| {
            if usize::from(walls.group[walls.table.order[slot] as usize]) != group {
                return [0.0; 6];
            }
            let point = &walls.sorted[slot];
            let force = self.load(point);
            let [fx, fy, fz] = padded(&force);
            let [mx, my, mz] = cross(padded(&(point.position - about)), [fx, fy, fz]);
            [fx, fy, fz, mx, my, mz]
        });
        (SVector::from_fn(|axis, _| loads[axis]), [loads[3], loads[4], loads[5]])
    }

    /// Total force (N; N/m in 2D) of the structure on the fluid in the last momentum
    /// pass, summed on the fluid's side.
    pub fn force_from_structure(&self) -> SVector<f64, D> {
        sum_vector(self.exchange.len(), |i| self.exchange[i].structure_force)
    }

    /// Total force (N; N/m in 2D) of all walls on the fluid in the last momentum pass,
    /// summed on the fluid's side.
    pub fn force_from_walls(&self) -> SVector<f64, D> {
        sum_vector(self.exchange.len(), |i| self.exchange[i].wall_force)
    }

    fn surface_excess(&self, x: &SVector<f64, D>) -> f64 {
        let mut filling = 0.0;
        self.for_each_neighbour(x, |_, weight| filling += weight);
        let support = self.kernel.support();
        let mut wall = 0.0;
        self.lattice.for_each_run(x, support, |first, end| {
            for p in points(&self.walls, first, end) {
                let distance = (x - p.position).norm();
                if distance < support {
                    wall += p.volume * self.kernel.value(distance);
                }
            }
        });
        // Inside a wall no level is seen.
        filling - 0.5 * (1.0 - wall).max(0.1)
    }

    /// Calls `visit(j, V_j W)` for the fluid particles within the support of `x`, at
    /// their present positions.
    fn for_each_neighbour(&self, x: &SVector<f64, D>, mut visit: impl FnMut(usize, f64)) {
        let support = self.kernel.support();
        let (particles, mass) = (&self.particles, self.mass);
        self.lattice.for_each_run(x, support + self.slack, |first, end| {
            for j in self.table.slots(first, end) {
                let distance = (x - particles.position[j]).norm();
                if distance < support {
                    let density =
                        self.parameters.reference_density + particles.density_deviation[j];
                    visit(j, mass / density * self.kernel.value(distance));
                }
            }
        });
    }
}

fn padded<const D: usize>(v: &SVector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|axis| if axis < D { v[axis] } else { 0.0 })
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
