//! The conservation ledger: one row per gauge time, and the run's totals.

use coupling::{Coupled, FluidSide, SolidSide, count_leaks};
use gimpm::Solid;

use super::sides::{ObservedFluid, ObservedSolid};
use crate::output::frame::Column;

const COLUMNS: [(&str, &str); 22] = [
    ("fluid.kinetic", "J"),
    ("fluid.potential", "J"),
    ("fluid.compression", "J"),
    ("fluid.wall_work", "J"),
    ("fluid.structure_work", "J"),
    ("fluid.dissipation_viscous", "J"),
    ("fluid.dissipation_diffusion", "J"),
    ("fluid.dissipation_impact", "J"),
    ("fluid.dissipation_offset", "J"),
    ("fluid.removed", "1"),
    ("fluid.removed_energy", "J"),
    ("solid.kinetic", "J"),
    ("solid.strain", "J"),
    ("solid.potential", "J"),
    ("solid.boundary_work", "J"),
    ("solid.external_work", "J"),
    ("solid.plastic_work", "J"),
    ("solid.out_of_balance", "1"),
    ("coupling.momentum_residual", "1"),
    ("coupling.work_mismatch", "J"),
    ("coupling.leaks", "1"),
    ("coupling.substeps", "1"),
];

/// Conservation figures of a whole run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Totals {
    /// Largest relative momentum residual of any step.
    pub momentum_residual: f64,
    /// Accumulated work mismatch at the interface (J).
    pub work_mismatch: f64,
    /// Fluid particles inside the solid now.
    pub leaks: usize,
    /// Fluid particles that left the domain.
    pub removed: u64,
}

/// Names and units of the ledger row.
pub fn columns() -> Vec<Column> {
    COLUMNS.iter().map(|&(name, unit)| Column { name: name.into(), unit: unit.into() }).collect()
}

/// The ledger now, in the order of [`columns`].
pub fn row<const D: usize, F, S>(coupled: &Coupled<D, F, S>) -> Vec<f64>
where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    let mut row = Vec::with_capacity(COLUMNS.len());
    match coupled.fluid().observed() {
        Some(fluid) => {
            let (energy, ledger) = (fluid.energy(), fluid.ledger());
            row.extend([
                energy.kinetic,
                energy.potential,
                energy.compression,
                ledger.wall_work,
                ledger.structure_work,
                ledger.viscous_loss,
                ledger.diffusion_loss,
                ledger.impact_loss,
                ledger.offset_loss,
                ledger.removed.count as f64,
                ledger.removed.energy,
            ]);
        }
        None => row.extend([0.0; 11]),
    }
    match coupled.solid().observed() {
        Some(solid) => {
            let (energy, ledger) = (solid.energy(), solid.ledger());
            row.extend([
                energy.kinetic,
                energy.strain,
                energy.gravity_potential,
                ledger.boundary_work,
                ledger.external_work,
                plastic_work(solid),
                solid.out_of_balance(),
            ]);
        }
        None => row.extend([0.0; 7]),
    }
    let ledger = coupled.ledger();
    row.extend([
        ledger.largest_in_row,
        ledger.work_mismatch,
        leaks(coupled) as f64,
        f64::from(coupled.substeps()),
    ]);
    row
}

/// The run's totals so far.
pub fn totals<const D: usize, F, S>(coupled: &Coupled<D, F, S>) -> Totals
where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    let ledger = coupled.ledger();
    Totals {
        momentum_residual: ledger.largest_momentum_residual,
        work_mismatch: ledger.work_mismatch,
        leaks: leaks(coupled),
        removed: coupled.fluid().observed().map_or(0, |fluid| fluid.ledger().removed.count),
    }
}

/// Work that plastic flow has taken (J).
fn plastic_work<const D: usize>(solid: &Solid<D>) -> f64 {
    let points = solid.points();
    let [work] = ordered_reduction::sum(points.history.len(), |p| {
        [points.reference_volume[p] * points.history[p][1]]
    });
    work
}

/// Fluid particles nearer than half a spacing to a material point.
fn leaks<const D: usize, F, S>(coupled: &Coupled<D, F, S>) -> usize
where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    let (structure, _) = coupled.interface();
    coupled.fluid().observed().map_or(0, |fluid| {
        count_leaks(&fluid.particles().position, structure, 0.5 * fluid.parameters().spacing)
    })
}
