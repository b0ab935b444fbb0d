//! Vector loops for the total frame with FLIP: points that stay in their cells.
//!
//! The weights of such a body never change and are the same in every cell that is
//! filled alike, so they are tabulated once ([`pattern`]). Up to eight points of a
//! cell form a block; its loops hold the cell's corners or the block's points in
//! the lanes of vector registers and touch each node record once a block.
//!
//! Node masses are constant. Momentum is scattered in the sweep that changes the
//! velocity, internal force in the sweep that changes the stress, both for the
//! next step as well: [`Carried`]. They depend on the state alone, bit for bit, so a
//! restored state may have them computed again.

mod assembly;
mod build;
mod mean_dilatation;
mod momentum;
mod pattern;
mod slabs;
mod stress;

use crate::grid::RemapRecord;
pub(crate) use build::place_in_cell;
use pattern::{CORNERS, Pattern};
use slabs::Slab;

/// Up to eight consecutive points of one cell.
#[derive(Debug, Clone, Copy)]
struct Block {
    /// First point, counted from the body's first.
    first: u32,
    /// Lowest corner of the cell.
    node: u32,
    /// Index of the pattern.
    pattern: u32,
    /// Number of points.
    count: u32,
}

/// Sums on nodes that the next step starts from.
#[derive(Debug, Clone)]
struct Carried {
    records: Vec<RemapRecord>,
    /// Whether they belong to the current state of the points.
    is_current: bool,
}

/// The points of one body as blocks.
#[derive(Debug, Clone)]
pub(crate) struct Lattice<const D: usize> {
    /// First point of the body.
    start: usize,
    /// Number of points.
    count: usize,
    patterns: Vec<Pattern>,
    blocks: Vec<Block>,
    slabs: Vec<Slab>,
    /// Storage distance of each corner of a cell from the lowest one.
    corner: [usize; CORNERS],
    /// Nodes in a plane across the slowest axis.
    plane: usize,
    /// Mass of every point (kg).
    point_mass: f64,
    /// Volume of every point in the reference state (m³).
    point_volume: f64,
    mean_dilatation: bool,
    /// Mass of the nodes (kg).
    mass: Vec<f64>,
    /// Momentum `Σ_p m_p v_p S_vp` before boundary conditions (N s).
    momentum: Carried,
    /// Internal force (N).
    force: Carried,
    /// Largest speed of a point after the last [`Self::grid_to_points`] (m/s).
    pub maximum_speed: f64,
}

impl<const D: usize> Lattice<D> {
    /// Forgets what was carried over from the last step. To be called whenever
    /// velocity, deformation or stress of the points change outside the loops of
    /// this module.
    pub fn forget(&mut self) {
        self.momentum.is_current = false;
        self.force.is_current = false;
    }
}
