//! State of the fluid particles, sorted by cell.

use nalgebra::SVector;
use rayon::prelude::*;

/// Structure of arrays of the fluid particles, sorted by search cell.
///
/// Entry `i` of every array belongs to the same particle; its identity is `id[i]`, the
/// index of its seed. All particles have the same mass.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Particles<const D: usize> {
    /// Index of the seed.
    pub id: Vec<u32>,
    /// Position (m).
    pub position: Vec<SVector<f64, D>>,
    /// Velocity (m/s).
    pub velocity: Vec<SVector<f64, D>>,
    /// `ρ - ρ0` (kg/m³).
    pub density_deviation: Vec<f64>,
    /// Acceleration of the last kick (m/s²).
    pub acceleration: Vec<SVector<f64, D>>,
    /// `dρ/dt` of the last continuity pass (kg/m³/s).
    pub density_rate: Vec<f64>,
    /// Part of `density_rate` from density diffusion (kg/m³/s).
    pub diffusion_rate: Vec<f64>,
    /// `Σ V W` over fluid, walls and structure in the last continuity pass: 1 under
    /// water, about 0.6 at a free surface.
    pub filling: Vec<f64>,
}

impl<const D: usize> Particles<D> {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Whether all arrays have the same length.
    pub(crate) fn is_consistent(&self) -> bool {
        let n = self.len();
        [self.position.len(), self.velocity.len(), self.acceleration.len()] == [n; 3]
            && [self.density_deviation.len(), self.density_rate.len()] == [n; 2]
            && [self.diffusion_rate.len(), self.filling.len()] == [n; 2]
    }

    /// Moves particle `order[slot]` to `slot` and drops everything not in `order`.
    pub(crate) fn permute(&mut self, order: &[u32], spare: &mut Spare<D>) {
        gather(&mut self.id, order, &mut spare.index);
        for array in [&mut self.position, &mut self.velocity, &mut self.acceleration] {
            gather(array, order, &mut spare.vector);
        }
        for array in [
            &mut self.density_deviation,
            &mut self.density_rate,
            &mut self.diffusion_rate,
            &mut self.filling,
        ] {
            gather(array, order, &mut spare.scalar);
        }
    }
}

/// Buffers that [`Particles::permute`] swaps with the state.
#[derive(Debug, Clone, Default)]
pub(crate) struct Spare<const D: usize> {
    index: Vec<u32>,
    vector: Vec<SVector<f64, D>>,
    scalar: Vec<f64>,
}

fn gather<T: Copy + Send + Sync>(array: &mut Vec<T>, order: &[u32], spare: &mut Vec<T>) {
    order.par_iter().with_min_len(1024).map(|&i| array[i as usize]).collect_into_vec(spare);
    std::mem::swap(array, spare);
}
