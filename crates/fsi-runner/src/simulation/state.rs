//! Solver state to checkpoint entries and back, bit for bit.

use coupling::{Coupled, CouplingLedger, FluidSide, SolidSide};
use gimpm::{Solid, SupportNode};
use nalgebra::{Matrix3, SMatrix, SVector};
use sph::Fluid;

use super::sides::{ObservedFluid, ObservedSolid};
use crate::failure::Failure;
use crate::output::checkpoint::Checkpoint;

/// Adds the complete state of both sides and of the coupling.
pub fn save<const D: usize, F, S>(coupled: &Coupled<D, F, S>, checkpoint: &mut Checkpoint)
where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    let state = coupled.state();
    checkpoint.scalars.insert("time".into(), state.time);
    checkpoint.integers.insert("steps".into(), state.steps);
    put_vectors(checkpoint, "coupling.mean_velocity", &state.mean_velocity_by_id);
    let ledger = state.ledger;
    checkpoint.reals.insert(
        "coupling.ledger".into(),
        vec![
            ledger.momentum_residual,
            ledger.largest_in_row,
            ledger.largest_momentum_residual,
            ledger.work_on_solid,
            ledger.work_mismatch,
        ],
    );
    if let Some(fluid) = coupled.fluid().observed() {
        save_fluid(fluid, checkpoint);
    }
    if let Some(solid) = coupled.solid().observed() {
        save_solid(solid, checkpoint);
    }
}

/// Restores what [`save`] stored, into a pair built from the same case.
///
/// # Errors
/// An entry is missing or does not fit this case.
pub fn load<const D: usize, F, S>(
    coupled: &mut Coupled<D, F, S>,
    checkpoint: &Checkpoint,
) -> Result<(), Failure>
where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    let entries = Entries(checkpoint);
    if let Some(fluid) = coupled.fluid_mut().observed_mut() {
        load_fluid(fluid, entries)?;
    }
    if let Some(solid) = coupled.solid_mut().observed_mut() {
        load_solid(solid, entries)?;
    }
    let mut state = coupled.state();
    state.time = entries.scalar("time")?;
    state.steps = entries.integer("steps")?;
    state.mean_velocity_by_id = entries.vectors("coupling.mean_velocity")?;
    let [residual, in_row, largest, work, mismatch] = entries.numbers("coupling.ledger")?;
    state.ledger = CouplingLedger {
        momentum_residual: residual,
        largest_in_row: in_row,
        largest_momentum_residual: largest,
        work_on_solid: work,
        work_mismatch: mismatch,
    };
    coupled.restore_state(state);
    Ok(())
}

fn save_fluid<const D: usize>(fluid: &Fluid<D>, checkpoint: &mut Checkpoint) {
    let state = fluid.state();
    let particles = &state.particles;
    checkpoint.indices.insert("fluid.id".into(), particles.id.clone());
    checkpoint.indices.insert("fluid.cell".into(), state.cell);
    put_vectors(checkpoint, "fluid.position", &particles.position);
    put_vectors(checkpoint, "fluid.velocity", &particles.velocity);
    put_vectors(checkpoint, "fluid.acceleration", &particles.acceleration);
    for (name, values) in [
        ("fluid.density_deviation", &particles.density_deviation),
        ("fluid.density_rate", &particles.density_rate),
        ("fluid.diffusion_rate", &particles.diffusion_rate),
        ("fluid.filling", &particles.filling),
    ] {
        checkpoint.reals.insert(name.into(), values.clone());
    }
    let (ledger, energy) = (&state.ledger, &state.initial_energy);
    let mut numbers = vec![
        state.time,
        state.slack,
        state.maximum_acceleration,
        energy.kinetic,
        energy.potential,
        energy.compression,
        ledger.wall_work,
        ledger.structure_work,
        ledger.viscous_loss,
        ledger.impact_loss,
        ledger.offset_loss,
        ledger.diffusion_loss,
        ledger.removed.mass,
        ledger.removed.energy,
    ];
    let impulses = [
        &ledger.gravity_impulse,
        &ledger.wall_impulse,
        &ledger.structure_impulse,
        &ledger.removed.momentum,
    ];
    numbers.extend(impulses.into_iter().flatten());
    checkpoint.reals.insert("fluid.numbers".into(), numbers);
    checkpoint.integers.insert("fluid.steps".into(), state.steps);
    checkpoint.integers.insert("fluid.removed".into(), ledger.removed.count);
}

fn load_fluid<const D: usize>(fluid: &mut Fluid<D>, entries: Entries<'_>) -> Result<(), Failure> {
    let mut state = fluid.state();
    state.particles.id = entries.indices("fluid.id")?.clone();
    state.cell = entries.indices("fluid.cell")?.clone();
    state.particles.position = entries.vectors("fluid.position")?;
    state.particles.velocity = entries.vectors("fluid.velocity")?;
    state.particles.acceleration = entries.vectors("fluid.acceleration")?;
    state.particles.density_deviation = entries.reals("fluid.density_deviation")?.clone();
    state.particles.density_rate = entries.reals("fluid.density_rate")?.clone();
    state.particles.diffusion_rate = entries.reals("fluid.diffusion_rate")?.clone();
    state.particles.filling = entries.reals("fluid.filling")?.clone();
    let mut numbers = Numbers(entries.reals("fluid.numbers")?.iter());
    let (ledger, energy) = (&mut state.ledger, &mut state.initial_energy);
    for value in [
        &mut state.time,
        &mut state.slack,
        &mut state.maximum_acceleration,
        &mut energy.kinetic,
        &mut energy.potential,
        &mut energy.compression,
        &mut ledger.wall_work,
        &mut ledger.structure_work,
        &mut ledger.viscous_loss,
        &mut ledger.impact_loss,
        &mut ledger.offset_loss,
        &mut ledger.diffusion_loss,
        &mut ledger.removed.mass,
        &mut ledger.removed.energy,
    ] {
        *value = numbers.next("fluid.numbers")?;
    }
    for vector in [
        &mut ledger.gravity_impulse,
        &mut ledger.wall_impulse,
        &mut ledger.structure_impulse,
        &mut ledger.removed.momentum,
    ] {
        for component in vector.iter_mut() {
            *component = numbers.next("fluid.numbers")?;
        }
    }
    state.steps = entries.integer("fluid.steps")?;
    state.ledger.removed.count = entries.integer("fluid.removed")?;
    fluid.restore_state(state).map_err(|error| unfit(&error))
}

fn save_solid<const D: usize>(solid: &Solid<D>, checkpoint: &mut Checkpoint) {
    let state = solid.state();
    let points = &state.points;
    checkpoint.indices.insert("solid.id".into(), points.id.clone());
    let bodies = points.body.iter().map(|&body| u32::from(body)).collect();
    checkpoint.indices.insert("solid.body".into(), bodies);
    let offsets = state.slab_offsets.iter().flatten().map(|&offset| offset as u32).collect();
    checkpoint.indices.insert("solid.slab_offsets".into(), offsets);
    put_vectors(checkpoint, "solid.position", &points.position);
    put_vectors(checkpoint, "solid.reference_position", &points.reference_position);
    put_vectors(checkpoint, "solid.velocity", &points.velocity);
    put_vectors(checkpoint, "solid.constraint_velocity", &state.constraint_velocity);
    for (name, values) in [
        ("solid.mass", &points.mass),
        ("solid.reference_volume", &points.reference_volume),
        ("solid.volume", &points.volume),
    ] {
        checkpoint.reals.insert(name.into(), values.clone());
    }
    let gradients = points.deformation_gradient.iter().flatten().copied().collect();
    checkpoint.reals.insert("solid.deformation_gradient".into(), gradients);
    checkpoint.reals.insert("solid.stress".into(), points.stress.concat());
    let affine = points.affine_velocity.iter().flatten().copied().collect();
    checkpoint.reals.insert("solid.affine_velocity".into(), affine);
    checkpoint.reals.insert("solid.history".into(), points.history.concat());
    let forces = state.reactions.iter().map(|reaction| reaction.force).collect::<Vec<_>>();
    put_vectors(checkpoint, "solid.reaction_force", &forces);
    let moments = state.reactions.iter().flat_map(|reaction| reaction.moment).collect();
    checkpoint.reals.insert("solid.reaction_moment".into(), moments);
    let supports = state.supports.iter();
    let supports = supports.flat_map(|node| [node.gap, f64::from(u8::from(node.held))]).collect();
    checkpoint.reals.insert("solid.supports".into(), supports);
    let ledger = &state.ledger;
    let mut numbers = vec![
        state.time,
        state.drift,
        state.maximum_speed,
        ledger.boundary_work,
        ledger.external_work,
        ledger.damping_work,
    ];
    let impulses = [
        &ledger.boundary_impulse,
        &ledger.external_impulse,
        &ledger.gravity_impulse,
        &ledger.damping_impulse,
    ];
    numbers.extend(impulses.into_iter().chain([&state.load, &state.point_load]).flatten());
    numbers.extend(ledger.boundary_angular_impulse);
    numbers.extend(ledger.external_angular_impulse);
    checkpoint.reals.insert("solid.numbers".into(), numbers);
    checkpoint.integers.insert("solid.steps".into(), state.steps);
}

fn load_solid<const D: usize>(solid: &mut Solid<D>, entries: Entries<'_>) -> Result<(), Failure> {
    let mut state = solid.state().clone();
    let points = &mut state.points;
    points.id = entries.indices("solid.id")?.clone();
    points.body = entries.indices("solid.body")?.iter().map(|&body| body as u16).collect();
    let offsets = entries.indices("solid.slab_offsets")?;
    let mut stored = offsets.iter();
    for (offset, &value) in state.slab_offsets.iter_mut().flatten().zip(stored.by_ref()) {
        *offset = value as usize;
    }
    points.position = entries.vectors("solid.position")?;
    points.reference_position = entries.vectors("solid.reference_position")?;
    points.velocity = entries.vectors("solid.velocity")?;
    state.constraint_velocity = entries.vectors("solid.constraint_velocity")?;
    points.mass = entries.reals("solid.mass")?.clone();
    points.reference_volume = entries.reals("solid.reference_volume")?.clone();
    points.volume = entries.reals("solid.volume")?.clone();
    let gradients = entries.reals("solid.deformation_gradient")?.chunks_exact(9);
    points.deformation_gradient = gradients.map(Matrix3::from_column_slice).collect();
    points.stress = entries.reals("solid.stress")?.as_chunks::<6>().0.to_vec();
    let affine = entries.reals("solid.affine_velocity")?.chunks_exact(D * D);
    points.affine_velocity = affine.map(SMatrix::from_column_slice).collect();
    points.history = entries.reals("solid.history")?.as_chunks::<2>().0.to_vec();
    let forces: Vec<SVector<f64, D>> = entries.vectors("solid.reaction_force")?;
    let moments = entries.reals("solid.reaction_moment")?.as_chunks::<3>().0;
    for (reaction, (force, moment)) in state.reactions.iter_mut().zip(forces.iter().zip(moments)) {
        (reaction.force, reaction.moment) = (*force, *moment);
    }
    let supports = entries.reals("solid.supports")?.as_chunks::<2>().0.iter();
    state.supports = supports.map(|&[gap, held]| SupportNode { gap, held: held != 0.0 }).collect();
    let mut numbers = Numbers(entries.reals("solid.numbers")?.iter());
    let ledger = &mut state.ledger;
    for value in [
        &mut state.time,
        &mut state.drift,
        &mut state.maximum_speed,
        &mut ledger.boundary_work,
        &mut ledger.external_work,
        &mut ledger.damping_work,
    ] {
        *value = numbers.next("solid.numbers")?;
    }
    for vector in [
        &mut ledger.boundary_impulse,
        &mut ledger.external_impulse,
        &mut ledger.gravity_impulse,
        &mut ledger.damping_impulse,
        &mut state.load,
        &mut state.point_load,
    ] {
        for component in vector.iter_mut() {
            *component = numbers.next("solid.numbers")?;
        }
    }
    for moment in [&mut ledger.boundary_angular_impulse, &mut ledger.external_angular_impulse] {
        for component in moment.iter_mut() {
            *component = numbers.next("solid.numbers")?;
        }
    }
    state.steps = entries.integer("solid.steps")?;
    solid.restore_state(state).map_err(|error| unfit(&error))
}

fn put_vectors<const D: usize>(
    checkpoint: &mut Checkpoint,
    name: &str,
    vectors: &[SVector<f64, D>],
) {
    checkpoint.reals.insert(name.into(), vectors.iter().flatten().copied().collect());
}

fn unfit(problem: &dyn std::fmt::Display) -> Failure {
    Failure::input(format!("cannot resume: the checkpoint does not fit this case: {problem}"))
}

/// Reads entries by name.
#[derive(Clone, Copy)]
struct Entries<'a>(&'a Checkpoint);

impl<'a> Entries<'a> {
    fn missing(name: &str) -> Failure {
        unfit(&format!("entry `{name}` is missing or too short"))
    }

    fn scalar(self, name: &str) -> Result<f64, Failure> {
        self.0.scalars.get(name).copied().ok_or_else(|| Self::missing(name))
    }

    fn integer(self, name: &str) -> Result<u64, Failure> {
        self.0.integers.get(name).copied().ok_or_else(|| Self::missing(name))
    }

    fn reals(self, name: &str) -> Result<&'a Vec<f64>, Failure> {
        self.0.reals.get(name).ok_or_else(|| Self::missing(name))
    }

    fn indices(self, name: &str) -> Result<&'a Vec<u32>, Failure> {
        self.0.indices.get(name).ok_or_else(|| Self::missing(name))
    }

    fn vectors<const D: usize>(self, name: &str) -> Result<Vec<SVector<f64, D>>, Failure> {
        Ok(self.reals(name)?.as_chunks::<D>().0.iter().map(|&x| SVector::from(x)).collect())
    }

    fn numbers<const N: usize>(self, name: &str) -> Result<[f64; N], Failure> {
        self.reals(name)?.as_slice().try_into().map_err(|_| Self::missing(name))
    }
}

/// Takes stored numbers one after the other.
struct Numbers<'a>(std::slice::Iter<'a, f64>);

impl Numbers<'_> {
    fn next(&mut self, name: &str) -> Result<f64, Failure> {
        self.0.next().copied().ok_or_else(|| Entries::missing(name))
    }
}
