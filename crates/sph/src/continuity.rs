//! Continuity pass: density rate of every fluid particle (S3, C3).

use crate::momentum::{GRAIN, points};
use crate::{Fluid, Kernel};
use rayon::prelude::*;
use std::mem::take;

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// Continuity pass with the current velocities on the mid-step geometry (S3, C3):
    ///
    /// `dρ_i/dt = ρ_i Σ_j V_j (v_i - v_j)·∇W_ij + 2 ρ_i Σ_p V_p (v_i - v̄_p)·∇W_ip + D_i`,
    ///
    /// `D_i = δ h c0 Σ_j V_j ψ_ij·∇W_ij`, `ψ_ij = 2 [(ρ_j - ρ_i) - ρ^H_ij] x_ji/|x_ji|²`,
    /// `ρ^H_ij = ρ0 g·x_ji/c0²` (Fourtakas et al. 2019 eq. 10–13), fluid pairs only.
    pub fn evaluate_density_rate(&mut self) {
        let mut rate = take(&mut self.particles.density_rate);
        let mut diffusion = take(&mut self.particles.diffusion_rate);
        let mut filling = take(&mut self.particles.filling);
        rate.par_iter_mut()
            .zip(diffusion.par_iter_mut().zip(filling.par_iter_mut()))
            .enumerate()
            .with_min_len(GRAIN)
            .for_each(|(i, (rate, (diffusion, filling)))| {
                (*rate, *diffusion, *filling) = self.density_rate(i);
            });
        self.particles.density_rate = rate;
        self.particles.diffusion_rate = diffusion;
        self.particles.filling = filling;
    }

    /// Rate of particle `i`, the part of it from density diffusion (kg/m³/s), and the
    /// particle's filling.
    fn density_rate(&self, i: usize) -> (f64, f64, f64) {
        let a = &self.midpoint[i];
        let velocity = self.particles.velocity[i];
        let support = self.kernel.support();
        let weight = self.parameters.gravity * self.parameters.reference_density;
        let mut divergence = 0.0;
        let mut wall_divergence = [0.0; 2];
        let mut imbalance = 0.0;
        let mut filling = 0.0;
        self.lattice.for_each_run(&a.position, support, |first, end| {
            let slots = self.table.slots(first, end);
            let others = self.midpoint[slots.clone()].iter().zip(&self.particles.velocity[slots]);
            for (b, other) in others {
                let offset = a.position - b.position;
                let square = offset.norm_squared();
                if square < support * support {
                    let distance = square.sqrt();
                    filling += b.volume * self.kernel.value(distance);
                    let factor = b.volume * self.kernel.gradient_factor(distance);
                    divergence += factor * (velocity - other).dot(&offset);
                    // Pressures carry more digits than densities.
                    imbalance += factor * (b.pressure - a.pressure + weight.dot(&offset));
                }
            }
            for (sum, boundary) in wall_divergence.iter_mut().zip([&self.walls, &self.structure]) {
                for p in points(boundary, first, end) {
                    let offset = a.position - p.position;
                    let square = offset.norm_squared();
                    if square < support * support {
                        let distance = square.sqrt();
                        filling += p.volume * self.kernel.value(distance);
                        let factor = p.volume * self.kernel.gradient_factor(distance);
                        *sum += factor * (velocity - p.velocity).dot(&offset);
                    }
                }
            }
        });
        let parameters = &self.parameters;
        let diffusion = -2.0 * parameters.density_diffusion * parameters.smoothing_length
            / parameters.sound_speed
            * imbalance;
        for sum in wall_divergence {
            divergence += 2.0 * one_sided(sum, a.pressure, a.tension);
        }
        (a.density * divergence + diffusion, diffusion, filling)
    }
}

/// Rate of compression `Σ_p V_p (v_a - v̄_p)·∇W_ap` that a boundary causes (C3): all of it
/// under pressure; under tension all compression, but of stretching only the share `τ_a`
/// that C4 pulls with.
///
/// Where the wall does not pull it must not stretch either: the cut force does no work
/// on the fluid, and stretching would store tension from nothing.
#[inline(always)]
pub(crate) fn one_sided(compression: f64, pressure: f64, tension: f64) -> f64 {
    if pressure < 0.0 { compression.max(tension * compression) } else { compression }
}
