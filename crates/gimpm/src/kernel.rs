//! Which compiled loops serve a body.

use crate::parameters::{BodySeed, Frame, Loops, Shape, Transfer};

/// The loops over points of one body. All give the same numbers to round-off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kernel {
    /// One point at a time through a list of its nodes: any frame, shape, transfer.
    Plain,
    /// Updated frame, weights that are products over the axes, FLIP.
    Separable,
    /// Total frame, FLIP.
    Lattice,
}

impl Kernel {
    pub(crate) fn choose<const D: usize>(loops: Loops, seed: &BodySeed<D>) -> Self {
        let chosen = &seed.discretisation;
        let separable = matches!(chosen.shape, Shape::Linear | Shape::Ugimp);
        match (loops, chosen.frame, chosen.transfer) {
            (Loops::Fast, Frame::Updated, Transfer::Flip) if separable => Self::Separable,
            (Loops::Fast, Frame::Total, Transfer::Flip) => Self::Lattice,
            // The mean over a cell needs a cell's points together.
            (Loops::Plain, Frame::Total, Transfer::Flip) if chosen.mean_dilatation => Self::Lattice,
            _ => Self::Plain,
        }
    }
}
