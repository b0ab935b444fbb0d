//! Loops over points that take one point at a time through a list of its nodes.
//!
//! They serve every frame, shape and transfer, and are the reference for the
//! vector loops of `separable`.

mod full_mass_pass;
mod grid_to_points;
mod points_to_grid;
mod remap;
mod stress;

pub(crate) use full_mass_pass::full_mass_pass;
pub(crate) use grid_to_points::grid_to_points;
pub(crate) use points_to_grid::points_to_grid;
pub(crate) use remap::remap;
pub(crate) use stress::displacement_gradients;
