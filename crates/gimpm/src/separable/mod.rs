//! Vector loops for the updated frame: weights as products over the axes, FLIP.

mod grid_to_points;
mod points_to_grid;
mod remap;
mod stress;
mod weights;

pub(crate) use grid_to_points::grid_to_points;
pub(crate) use points_to_grid::points_to_grid;
pub(crate) use remap::remap;
pub(crate) use stress::displacement_gradients;
