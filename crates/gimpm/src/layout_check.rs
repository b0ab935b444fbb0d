//! Every point must be inside the grid and on the planes of its slab.
//!
//! Run after everything that moves points, so that the scatters, which index
//! nodes without looking, can rely on it.

use rayon::prelude::*;

use crate::error::SolidError;
use crate::shape::{ShapeFunction, with_shape};
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// Checks all points.
    pub(crate) fn check_layout(&self) -> Result<(), SolidError> {
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            let fault = offsets.par_windows(2).enumerate().find_map_first(|(slab, range)| {
                with_shape!(body, shape => {
                    (range[0]..range[1]).find_map(|p| self.check_point(shape, p, slab).err())
                })
            });
            if let Some(error) = fault {
                return Err(error);
            }
        }
        Ok(())
    }

    #[inline(always)]
    fn check_point<S: ShapeFunction>(
        &self,
        shape: S,
        p: usize,
        slab: usize,
    ) -> Result<(), SolidError> {
        let geometry = &self.grid.geometry;
        let position = &self.state.points.position[p];
        let inside = (0..D).all(|d| {
            let along = geometry.coordinate(position, d);
            along >= 0.0 && along <= geometry.cells[d] as f64
        });
        if !inside {
            return Err(self.position_error(p));
        }
        let base = shape.weights(geometry.coordinate(position, D - 1)).base;
        if geometry.slab_holds(slab, base) {
            Ok(())
        } else {
            Err(SolidError::NotSorted { point: self.state.points.id[p], time: self.state.time })
        }
    }

    #[cold]
    fn position_error(&self, p: usize) -> SolidError {
        let (point, time) = (self.state.points.id[p], self.state.time);
        let position = &self.state.points.position[p];
        if !position.iter().all(|x| x.is_finite()) {
            return SolidError::NonFinite { point, quantity: "position", time };
        }
        let geometry = &self.grid.geometry;
        let extent = geometry.cells.map(|n| n as f64 * geometry.spacing);
        let upper = geometry.origin.iter().zip(extent).map(|(o, e)| o + e).collect();
        let lower = geometry.origin.iter().copied().collect();
        let position = position.iter().copied().collect();
        SolidError::OutsideGrid { point, position, time, lower, upper }
    }
}
