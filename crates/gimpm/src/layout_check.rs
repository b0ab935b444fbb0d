//! Every point must be inside the grid and on the planes of its slab.
//!
//! Run after everything that moves points, so that the scatters, which index
//! nodes without looking, can rely on it.

use rayon::prelude::*;

use crate::error::SolidError;
use crate::grid::GridGeometry;
use crate::parameters::Frame;
use crate::shape::{ShapeFunction, with_shape};
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// Checks all points that cross cells.
    pub(crate) fn check_layout(&self) -> Result<(), SolidError> {
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            if body.discretisation.frame == Frame::Total {
                continue;
            }
            let geometry = &self.fields[body.field].grid.geometry;
            let fault = offsets.par_windows(2).enumerate().find_map_first(|(slab, range)| {
                with_shape!(body, shape => {
                    (range[0]..range[1]).find_map(|p| self.check_point(geometry, shape, p, slab).err())
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
        geometry: &GridGeometry<D>,
        shape: S,
        p: usize,
        slab: usize,
    ) -> Result<(), SolidError> {
        let position = &self.state.points.position[p];
        let inside = (0..D).all(|d| {
            let along = geometry.coordinate(position, d);
            along >= 0.0 && along <= geometry.cells[d] as f64
        });
        if !inside {
            return Err(self.position_error(geometry, p));
        }
        let base = shape.weights(geometry.coordinate(position, D - 1)).base;
        if geometry.slab_holds(slab, base) {
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
