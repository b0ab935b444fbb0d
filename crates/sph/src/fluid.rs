//! The fluid: its data, construction and plain accessors.

use crate::boundary::Boundary;
use crate::cell_lattice::{CellLattice, CellTable};
use crate::ledger::{Exchange, FluidEnergy, FluidLedger};
use crate::parameters::{FluidParameters, FluidSeed, WallMotion, WallSeed};
use crate::particles::{Particles, Spare};
use crate::structure::NearStructure;
use crate::wall_closure::{FluidSide, WallClosure};
use crate::{FluidError, Kernel, LinearEquationOfState, WendlandC2};
use nalgebra::SVector;

/// One rigid wall: a contiguous range of the wall points.
#[derive(Debug, Clone)]
pub(crate) struct WallGroup<const D: usize> {
    pub name: String,
    pub first: usize,
    pub end: usize,
    pub motion: Option<WallMotion<D>>,
}

/// A weakly compressible fluid with its walls and, optionally, a structure.
///
/// Build it with [`Fluid::new`] and either call [`Fluid::step`] or drive the phases
/// yourself in the order of `step.rs`.
#[derive(Debug, Clone)]
pub struct Fluid<const D: usize, K: Kernel<D> = WendlandC2<D>> {
    pub(crate) parameters: FluidParameters<D>,
    pub(crate) equation_of_state: LinearEquationOfState,
    pub(crate) kernel: K,
    pub(crate) mass: f64,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    /// Step length of the drift under way, for mid-step velocities.
    pub(crate) step_length: f64,
    pub(crate) particles: Particles<D>,
    pub(crate) lattice: CellLattice<D>,
    pub(crate) table: CellTable,
    pub(crate) spare: Spare<D>,
    /// Fluid particles at mid-step, packed for the pair loops.
    pub(crate) midpoint: Vec<FluidSide<D>>,
    /// Work and forces per particle of the last momentum pass.
    pub(crate) exchange: Vec<Exchange<D>>,
    pub(crate) walls: Boundary<D>,
    pub(crate) wall_reference: Vec<SVector<f64, D>>,
    pub(crate) wall_groups: Vec<WallGroup<D>>,
    pub(crate) structure: Boundary<D>,
    pub(crate) near: NearStructure<D>,
    pub(crate) ledger: FluidLedger<D>,
    pub(crate) initial_energy: FluidEnergy,
    /// Largest distance moved since the last sort (m).
    pub(crate) slack: f64,
    pub(crate) maximum_speed: f64,
    pub(crate) maximum_acceleration: f64,
}

impl<const D: usize> Fluid<D> {
    /// A fluid with the Wendland C2 kernel; see [`Fluid::with_kernel`].
    ///
    /// # Errors
    /// [`FluidError`] names the parameter, particle or wall that cannot be used.
    pub fn new(
        parameters: FluidParameters<D>,
        particles: Vec<FluidSeed<D>>,
        walls: Vec<WallSeed<D>>,
    ) -> Result<Self, FluidError> {
        Self::with_kernel(parameters, particles, walls)
    }
}

impl<const D: usize, K: Kernel<D>> Fluid<D, K> {
    /// A fluid with kernel `K`. Particle ids are the indices of `particles`.
    ///
    /// # Errors
    /// [`FluidError`] names the parameter, particle or wall that cannot be used.
    pub fn with_kernel(
        parameters: FluidParameters<D>,
        particles: Vec<FluidSeed<D>>,
        walls: Vec<WallSeed<D>>,
    ) -> Result<Self, FluidError> {
        parameters.validate()?;
        let points: usize = walls.iter().map(|wall| wall.points.len()).sum();
        let limit = u32::MAX as usize;
        for (what, count) in [("fluid particles", particles.len()), ("wall points", points)] {
            if count > limit {
                return Err(FluidError::TooMany { what, count, limit });
            }
        }
        for (id, seed) in particles.iter().enumerate() {
            seed.validate(id, &parameters)?;
        }
        let kernel = K::new(parameters.smoothing_length);
        let lattice = CellLattice::new(parameters.domain, kernel.support())?;
        let (wall_points, wall_reference, wall_groups) = build_walls(&parameters, walls)?;
        let count = particles.len();
        let mut fluid = Self {
            equation_of_state: LinearEquationOfState {
                reference_density: parameters.reference_density,
                sound_speed: parameters.sound_speed,
            },
            kernel,
            mass: parameters.particle_mass(),
            time: 0.0,
            steps: 0,
            step_length: 0.0,
            particles: Particles {
                id: (0..count as u32).collect(),
                position: particles.iter().map(|seed| seed.position).collect(),
                velocity: particles.iter().map(|seed| seed.velocity).collect(),
                density_deviation: particles.iter().map(|seed| seed.density_deviation).collect(),
                acceleration: vec![SVector::zeros(); count],
                density_rate: vec![0.0; count],
                diffusion_rate: vec![0.0; count],
                filling: vec![0.0; count],
            },
            lattice,
            table: CellTable::default(),
            spare: Spare::default(),
            midpoint: Vec::with_capacity(count),
            exchange: Vec::with_capacity(count),
            walls: wall_points,
            wall_reference,
            wall_groups,
            structure: Boundary::default(),
            near: NearStructure::default(),
            ledger: FluidLedger::default(),
            initial_energy: FluidEnergy::default(),
            slack: 0.0,
            maximum_speed: 0.0,
            maximum_acceleration: parameters.gravity.norm(),
            parameters,
        };
        fluid.move_walls_to(0.0, 0.0);
        fluid.walls.locate(&fluid.lattice);
        fluid.sort()?;
        fluid.pack_midpoint();
        fluid.evaluate_density_rate();
        fluid.measure_speed()?;
        fluid.initial_energy = fluid.energy();
        Ok(fluid)
    }

    /// Simulated time (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps taken since the start.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The parameters.
    pub fn parameters(&self) -> &FluidParameters<D> {
        &self.parameters
    }

    /// The particles, sorted by cell.
    pub fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    /// Pressure (Pa) of the particle in slot `i` of [`Fluid::particles`] (S2).
    pub fn pressure(&self, i: usize) -> f64 {
        self.equation_of_state.pressure(self.particles.density_deviation[i])
    }

    /// Mass of one particle (kg; kg per metre of width in 2D).
    pub fn particle_mass(&self) -> f64 {
        self.mass
    }

    /// Mass of all particles (kg; kg/m in 2D).
    pub fn total_mass(&self) -> f64 {
        self.mass * self.particles.len() as f64
    }

    /// Points of all rigid walls; their `group` indexes [`Fluid::wall_names`].
    pub fn walls(&self) -> &Boundary<D> {
        &self.walls
    }

    /// Names of the walls in group order.
    pub fn wall_names(&self) -> impl Iterator<Item = &str> {
        self.wall_groups.iter().map(|group| group.name.as_str())
    }

    /// Group index of the wall called `name`.
    pub fn wall_group(&self, name: &str) -> Option<usize> {
        self.wall_groups.iter().position(|group| group.name == name)
    }

    /// Whether the wall of index `group` has a prescribed motion.
    pub fn wall_moves(&self, group: usize) -> bool {
        self.wall_groups.get(group).is_some_and(|wall| wall.motion.is_some())
    }

    /// The wall closure with this fluid's constants (C2, C4).
    pub(crate) fn wall_closure(&self) -> WallClosure<D, K> {
        WallClosure {
            kernel: self.kernel,
            gravity: self.parameters.gravity,
            sound_speed: self.parameters.sound_speed,
        }
    }
}

type Walls<const D: usize> = (Boundary<D>, Vec<SVector<f64, D>>, Vec<WallGroup<D>>);

fn build_walls<const D: usize>(
    parameters: &FluidParameters<D>,
    walls: Vec<WallSeed<D>>,
) -> Result<Walls<D>, FluidError> {
    let limit = usize::from(u16::MAX);
    if walls.len() > limit {
        return Err(FluidError::TooMany { what: "walls", count: walls.len(), limit });
    }
    let mut boundary = Boundary::default();
    let mut groups: Vec<WallGroup<D>> = Vec::with_capacity(walls.len());
    for (index, wall) in walls.into_iter().enumerate() {
        wall.validate()?;
        if groups.iter().any(|group| group.name == wall.name) {
            let problem = "the name is used twice; wall names must be unique".to_owned();
            return Err(FluidError::Wall { name: wall.name, problem });
        }
        let first = boundary.position.len();
        boundary.position.extend_from_slice(&wall.points);
        let end = boundary.position.len();
        boundary.group.resize(end, index as u16);
        groups.push(WallGroup { name: wall.name, first, end, motion: wall.motion });
    }
    let count = boundary.position.len();
    boundary.velocity = vec![SVector::zeros(); count];
    boundary.force = vec![SVector::zeros(); count];
    boundary.volume = vec![parameters.spacing.powi(D as i32); count];
    let reference = boundary.position.clone();
    Ok((boundary, reference, groups))
}
