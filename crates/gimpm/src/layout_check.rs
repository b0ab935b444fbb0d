//! Every point must be inside the grid and on the planes of its slab.
//!
//! Run after everything that moves points, so that the scatters, which index
//! nodes without looking, can rely on it.

use nalgebra::SVector;
use rayon::prelude::*;
use wide::f64x4;

use crate::error::SolidError;
use crate::grid::GridGeometry;
use crate::parameters::Frame;
use crate::shape::{ShapeFunction, with_shape};
use crate::slabs::Slabs;
use crate::solid::{Body, Solid};

/// The box around points of one slab: if it is held, every point is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    lower: f64x4,
    upper: f64x4,
    /// NaN once a coordinate was not finite.
    poison: f64x4,
}

impl Default for Reach {
    fn default() -> Self {
        Self {
            lower: f64x4::splat(f64::INFINITY),
            upper: f64x4::splat(f64::NEG_INFINITY),
            poison: f64x4::splat(0.0),
        }
    }
}

impl Reach {
    #[inline(always)]
    pub fn include<const D: usize>(&mut self, position: &SVector<f64, D>) {
        let third = if D == 3 { position[2] } else { 0.0 };
        let x = f64x4::new([position[0], position[1], third, 0.0]);
        self.lower = self.lower.fast_min(x);
        self.upper = self.upper.fast_max(x);
        // NaN for what is not finite; otherwise it stays 0.
        self.poison += x * f64x4::splat(0.0);
    }

    /// Whether the box is inside the grid and on the planes of a slab; always true in
    /// the total frame, where points keep their nodes; never where the reach of a point
    /// depends on its deformation.
    pub fn is_held<const D: usize>(
        &self,
        body: &Body,
        geometry: &GridGeometry<D>,
        slab: usize,
    ) -> bool {
        if body.discretisation.frame == Frame::Total {
            return true;
        }
        if body.deforming.is_some() {
            return false;
        }
        let corner = |x: f64x4| SVector::<f64, D>::from_fn(|d, _| x.as_array()[d]);
        let (lower, upper) = (corner(self.lower), corner(self.upper));
        let inside = (0..D).all(|d| {
            geometry.coordinate(&lower, d) >= 0.0
                && geometry.coordinate(&upper, d) <= geometry.cells[d] as f64
        });
        let held = |x: &SVector<f64, D>| {
            let along = geometry.coordinate(x, D - 1);
            let base = with_shape!(body, shape => shape.weights(along).base);
            body.slabs.holds(slab, base, 3)
        };
        self.poison == f64x4::splat(0.0) && inside && held(&lower) && held(&upper)
    }
}

impl<const D: usize> Solid<D> {
    /// Checks all points that cross cells.
    pub(crate) fn check_layout(&self) -> Result<(), SolidError> {
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            if body.discretisation.frame == Frame::Total {
                continue;
            }
            let geometry = &self.fields[body.field].grid.geometry;
            let fault = offsets.par_windows(2).enumerate().find_map_first(|(slab, range)| {
                let mut points = range[0]..range[1];
                let slab = (body.slabs, slab);
                if body.deforming.is_some() {
                    // However it is deformed: `PointDomain` bounds its reach.
                    let first = |x: f64| ((x - 1.0).floor() as i32, 4);
                    return points.find_map(|p| self.check_point(geometry, first, p, slab).err());
                }
                with_shape!(body, shape => {
                    let first = |x| (shape.weights(x).base, 3);
                    points.find_map(|p| self.check_point(geometry, first, p, slab).err())
                })
            });
            if let Some(error) = fault {
                return Err(error);
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn check_point(
        &self,
        geometry: &GridGeometry<D>,
        nodes_along: impl Fn(f64) -> (i32, usize),
        p: usize,
        (slabs, slab): (Slabs, usize),
    ) -> Result<(), SolidError> {
        let position = &self.state.points.position[p];
        let inside = (0..D).all(|d| {
            let along = geometry.coordinate(position, d);
            along >= 0.0 && along <= geometry.cells[d] as f64
        });
        if !inside {
            return Err(self.position_error(geometry, p));
        }
        let (base, nodes) = nodes_along(geometry.coordinate(position, D - 1));
        if slabs.holds(slab, base, nodes) {
            Ok(())
        } else {
            Err(SolidError::NotSorted { point: self.state.points.id[p], time: self.state.time })
        }
    }

    #[cold]
    fn position_error(&self, geometry: &GridGeometry<D>, p: usize) -> SolidError {
        let (point, time) = (self.state.points.id[p], self.state.time);
        let position = &self.state.points.position[p];
        if !position.iter().all(|x| x.is_finite()) {
            return SolidError::NonFinite { point, quantity: "position", time };
        }
        let upper = geometry.upper().iter().copied().collect();
        let lower = geometry.origin.iter().copied().collect();
        let position = position.iter().copied().collect();
        SolidError::OutsideGrid { point, position, time, lower, upper }
    }
}
