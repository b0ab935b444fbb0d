//! Velocity of the nodes from the approximate inverse of the full mass matrix.
//!
//! With S the map from nodes to points and S⁺ the one back (weights times mass over
//! the lumped mass), the full mass matrix is `M = m S⁺S`. Its inverse is expanded to
//! order k: `v^(k) = Σ_{l<k} Δ_l`, `Δ_0 = p/m`, `Δ_{l+1} = (I - S⁺S) Δ_l` (Nairn and
//! Hammerquist 2021, CMAME 377; the increments of Nairn 2026, arXiv 2604.07307). Every
//! increment obeys the boundary conditions: held components are zero from Δ_1 on.

use rayon::prelude::*;

use crate::grid::{NodeRecord, RemapRecord, VELOCITY};
use crate::grid_momentum::NODES_PER_TASK;
use crate::parameters::Transfer;
use crate::plain;
use crate::solid::Solid;

impl<const D: usize> Solid<D> {
    /// `v_v^L ← v^(k)` on the fields that ask for it. What the boundary conditions take
    /// from an increment is part of the reaction, so that momentum balances.
    pub(crate) fn expand_velocity(&mut self, dt: f64) {
        self.expand(
            Some(dt),
            |grid, v| std::array::from_fn(|d| if d < D { grid.0[v][VELOCITY + d] } else { 0.0 }),
            |grid, v, increment| {
                (0..D).for_each(|d| grid.0[v][VELOCITY + d] += increment[d]);
            },
        );
    }

    /// The same for the re-mapped velocity.
    pub(crate) fn expand_remapped_velocity(&mut self) {
        self.expand(
            None,
            |grid, v| grid.1[v],
            |grid, v, increment| {
                (0..D).for_each(|d| grid.1[v][d] += increment[d]);
            },
        );
    }

    fn expand(
        &mut self,
        dt: Option<f64>,
        read: impl Fn((&[NodeRecord], &[RemapRecord]), usize) -> RemapRecord + Sync,
        add: impl Fn((&mut [NodeRecord], &mut [RemapRecord]), usize, &RemapRecord) + Sync,
    ) {
        for index in 0..self.fields.len() {
            let field = &mut self.fields[index];
            let Transfer::Fmpm { order } = field.transfer else { continue };
            if order < 2 {
                continue;
            }
            let [mut increment, mut passed] = std::mem::take(&mut field.increments);
            let grid = &field.grid;
            increment.resize(grid.nodes.len(), [0.0; 4]);
            passed.resize(grid.nodes.len(), [0.0; 4]);
            increment.par_chunks_mut(NODES_PER_TASK).enumerate().for_each(|(task, records)| {
                let first = task * NODES_PER_TASK;
                for (k, record) in records.iter_mut().enumerate() {
                    *record = read((&grid.nodes, &grid.remapped), first + k);
                }
            });
            for _ in 1..order {
                self.next_increment(index, &mut increment, &mut passed);
                self.hold_increment(index, &mut increment, dt);
                let grid = &mut self.fields[index].grid;
                let nodes = grid.nodes.par_chunks_mut(NODES_PER_TASK);
                nodes
                    .zip(grid.remapped.par_chunks_mut(NODES_PER_TASK))
                    .zip(increment.par_chunks(NODES_PER_TASK))
                    .for_each(|((nodes, remapped), increments)| {
                        for (k, increment) in increments.iter().enumerate() {
                            add((nodes, remapped), k, increment);
                        }
                    });
            }
            self.fields[index].increments = [increment, passed];
        }
    }

    /// `Δ ← Δ - S⁺S Δ` in one pass over the points.
    fn next_increment(
        &self,
        field: usize,
        increment: &mut [RemapRecord],
        passed: &mut [RemapRecord],
    ) {
        passed.par_chunks_mut(NODES_PER_TASK).for_each(|records| records.fill([0.0; 4]));
        let grid = &self.fields[field].grid;
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            if body.field == field {
                let points = &self.state.points;
                plain::full_mass_pass(body, offsets, points, &grid.geometry, increment, passed);
            }
        }
        let mass_cut = self.mass_cut;
        let records = increment.par_chunks_mut(NODES_PER_TASK);
        records
            .zip(passed.par_chunks(NODES_PER_TASK))
            .zip(grid.nodes.par_chunks(NODES_PER_TASK))
            .for_each(|((increments, passed), nodes)| {
                for ((increment, passed), node) in increments.iter_mut().zip(passed).zip(nodes) {
                    if node[0] > mass_cut {
                        (0..D).for_each(|d| increment[d] -= passed[d] / node[0]);
                    } else {
                        *increment = [0.0; 4];
                    }
                }
            });
    }
}
