//! The material points, one array a quantity.

use nalgebra::{Matrix3, SMatrix, SVector};

use crate::parameters::Frame;
use crate::stencil::PointStencil;
use crate::transfer::PointTransfer;

/// Material points in storage order: body by body, within a body by grid cell.
///
/// The order changes only in `sort_points`; `id` says which point is where.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Points<const D: usize> {
    /// Identity, the number of the point in the seeds.
    pub id: Vec<u32>,
    /// Index of the body.
    pub body: Vec<u16>,
    /// Position x (m).
    pub position: Vec<SVector<f64, D>>,
    /// Position X in the reference state (m).
    pub reference_position: Vec<SVector<f64, D>>,
    /// Velocity (m/s).
    pub velocity: Vec<SVector<f64, D>>,
    /// Mass (kg; in plane strain kg per metre of thickness).
    pub mass: Vec<f64>,
    /// Volume V0 in the reference state (m³; in plane strain m²).
    pub reference_volume: Vec<f64>,
    /// Current volume `det F · V0`.
    pub volume: Vec<f64>,
    /// Deformation gradient F; its out-of-plane part is the identity in plane strain.
    pub deformation_gradient: Vec<Matrix3<f64>>,
    /// Cauchy stress (Pa) `[xx, yy, zz, xy, yz, xz]`, tension positive.
    pub stress: Vec<[f64; 6]>,
    /// Memory of the law: equivalent plastic strain, plastic work per reference
    /// volume (J/m³).
    pub history: Vec<[f64; 2]>,
    /// Affine part of the velocity in the coordinates of the weights (x, or X in the
    /// total frame): its gradient C (1/s), or with APIC on other than linear weights its
    /// moments `B = Σ S_vp v_v ⊗ (x_v - x_p)` (m²/s). Empty when no body has one.
    pub affine_velocity: Vec<SMatrix<f64, D, D>>,
}

/// Applies a method call to every array that all sets of points have.
macro_rules! for_each_array {
    ($apply:ident) => {
        $apply!(
            id,
            body,
            position,
            reference_position,
            velocity,
            mass,
            reference_volume,
            volume,
            deformation_gradient,
            stress,
            history
        )
    };
}

impl<const D: usize> Points<D> {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Where the weights of a point are taken (m): x, or X in the total frame.
    #[inline(always)]
    pub(crate) fn site(&self, frame: Frame, p: usize) -> &SVector<f64, D> {
        match frame {
            Frame::Updated => &self.position[p],
            Frame::Total => &self.reference_position[p],
        }
    }

    /// Displacement (m) at a material position X (m) near point `point`, taken as
    /// deforming with it (G24): `u = x_p + F (X - X_p) - X`.
    pub fn displacement_at(&self, point: usize, reference: &SVector<f64, D>) -> SVector<f64, D> {
        let offset = reference - self.reference_position[point];
        let gradient = &self.deformation_gradient[point];
        SVector::from_fn(|i, _| {
            let carried: f64 = (0..D).map(|j| gradient[(i, j)] * offset[j]).sum();
            self.position[point][i] + carried - reference[i]
        })
    }

    /// Gradient (1/s) with which a point gives its velocity to its nodes.
    #[inline(always)]
    pub(crate) fn spread<T: PointTransfer>(
        &self,
        transfer: T,
        p: usize,
        stencil: &PointStencil,
    ) -> SMatrix<f64, D, D> {
        if T::AFFINE {
            transfer.gradient(&self.affine_velocity[p], stencil)
        } else {
            SMatrix::zeros()
        }
    }

    /// Whether all arrays have the same length; the affine part may be absent.
    pub(crate) fn is_consistent(&self) -> bool {
        let count = self.len();
        if !(self.affine_velocity.is_empty() || self.affine_velocity.len() == count) {
            return false;
        }
        macro_rules! same_length {
            ($($array:ident),*) => { $(self.$array.len() == count)&&* };
        }
        for_each_array!(same_length)
    }

    /// Copies all arrays, reusing this set's buffers.
    pub(crate) fn copy_from(&mut self, source: &Self) {
        macro_rules! copy {
            ($($array:ident),*) => { $(self.$array.clone_from(&source.$array);)* };
        }
        for_each_array!(copy);
        self.affine_velocity.clone_from(&source.affine_velocity);
    }
}

/// Takes the first entries off a slice.
pub(crate) fn front<'a, T>(slice: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (front, rest) = std::mem::take(slice).split_at_mut(count);
    *slice = rest;
    front
}
