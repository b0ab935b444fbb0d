//! What a boundary leaves free at a node, for forces found after it has acted.

use nalgebra::{SMatrix, SVector};

use crate::constraints::{ComponentNode, Constraints, NormalNode, SupportNode};
use crate::parameters::Hold;

/// The boundaries that hold a node.
pub(crate) struct Freedom<'a, const D: usize> {
    holds: &'a [Hold<D>],
    components: Option<&'a ComponentNode<D>>,
    normals: &'a [NormalNode],
    supports: &'a [SupportNode],
}

impl<const D: usize> Constraints<D> {
    /// What is free at a node in this step.
    pub fn freedom<'a>(
        &'a self,
        supports: &'a [SupportNode],
        field: usize,
        node: usize,
    ) -> Freedom<'a, D> {
        let wanted = (field, node);
        let found = self.components.binary_search_by_key(&wanted, |held| (held.field, held.node));
        let start = self.normals.partition_point(|held| (held.field, held.node) < wanted);
        let end = self.normals.partition_point(|held| (held.field, held.node) <= wanted);
        Freedom {
            holds: &self.holds,
            components: found.ok().map(|k| &self.components[k]),
            normals: &self.normals[start..end],
            supports: &supports[start..end],
        }
    }
}

impl<const D: usize> Freedom<'_, D> {
    /// The part of an impulse that moves the node. What a boundary takes is handed
    /// to `taken` with the index of its constraint; directions first, then
    /// components, in the order in which they act.
    pub fn split(
        &self,
        mut impulse: SVector<f64, D>,
        mut taken: impl FnMut(usize, SVector<f64, D>),
    ) -> SVector<f64, D> {
        for (held, support) in self.normals.iter().zip(self.supports) {
            let owner = usize::from(held.owner);
            if let (Hold::Normal { direction, .. }, true) = (&self.holds[owner], support.held) {
                let part = direction * direction.dot(&impulse);
                impulse -= part;
                taken(owner, part);
            }
        }
        for d in 0..D {
            if let Some(owner) = self.components.and_then(|held| held.owner[d]) {
                let mut part = SVector::zeros();
                part[d] = impulse[d];
                impulse[d] = 0.0;
                taken(usize::from(owner), part);
            }
        }
        impulse
    }

    /// The same as a matrix: the identity at a free node.
    pub fn matrix(&self) -> SMatrix<f64, D, D> {
        let mut matrix = SMatrix::<f64, D, D>::identity();
        if self.components.is_some() || !self.normals.is_empty() {
            for mut column in matrix.column_iter_mut() {
                let free = self.split(column.clone_owned(), |_, _| ());
                column.copy_from(&free);
            }
        }
        matrix
    }
}
