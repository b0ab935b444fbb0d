//! The solid: bodies on one background grid.

use std::ops::Range;

use nalgebra::{Matrix3, SVector};

use crate::constraints::{Constraints, SupportNode};
use crate::error::SolidError;
use crate::field::{Field, fields};
use crate::grid_momentum::{RELATIVE_MASS_CUT, SmallMassReport};
use crate::kernel::Kernel;
use crate::material::MaterialModel;
use crate::parameters::{BodySeed, Discretisation, NodeConstraint, SolidParameters};
use crate::points::Points;
use crate::reaction::Reaction;
use crate::shape::BodyShape;
use crate::sort::SortBuffers;
use crate::state::SolidState;

/// A body: a run of points with one material.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name.
    pub name: String,
    /// Constitutive law.
    pub material: MaterialModel,
    /// Edge of a point's box in the reference state (m).
    pub point_spacing: f64,
    /// Frame, weights and transfer.
    pub discretisation: Discretisation,
    /// Index of the velocity field.
    pub(crate) field: usize,
    pub(crate) shape: BodyShape,
    pub(crate) kernel: Kernel,
}

/// Bodies of material points and their grids; see the crate's example.
///
/// Bodies in the updated frame share one velocity field: where they meet, they stick.
#[derive(Debug, Clone)]
pub struct Solid<const D: usize> {
    pub(crate) parameters: SolidParameters<D>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) constraints: Constraints<D>,
    pub(crate) fields: Vec<Field<D>>,
    pub(crate) state: SolidState<D>,
    pub(crate) saved: SolidState<D>,
    /// Displacement of each point in the current step (m).
    pub(crate) displacement: Vec<SVector<f64, D>>,
    /// Storage index of each identity.
    pub(crate) index_of: Vec<u32>,
    pub(crate) sort_buffers: SortBuffers<D>,
    pub(crate) previous_velocity: Vec<SVector<f64, D>>,
    pub(crate) small_mass: SmallMassReport,
    /// Nodes up to this mass are left out (kg).
    pub(crate) mass_cut: f64,
    pub(crate) total_mass: f64,
    /// P-wave speed of the fastest body (m/s).
    pub(crate) wave_speed: f64,
    /// Error of the last step: the state in between is not valid.
    pub(crate) failure: Option<SolidError>,
}

impl<const D: usize> Solid<D> {
    /// Builds a solid and sorts its points.
    ///
    /// # Errors
    /// [`SolidError`] for a parameter, material, body or constraint outside its
    /// range, or a point outside the grid.
    pub fn new(
        parameters: SolidParameters<D>,
        bodies: Vec<BodySeed<D>>,
        constraints: Vec<NodeConstraint<D>>,
    ) -> Result<Self, SolidError> {
        parameters.validate()?;
        for seed in &bodies {
            seed.validate(parameters.grid_spacing)?;
        }
        let (fields, field_of) = fields(&parameters, &bodies)?;
        let constraints = Constraints::new(constraints, &fields, &field_of)?;
        let slabs: Vec<usize> =
            field_of.iter().map(|&field| fields[field].grid.geometry.slab_count()).collect();
        let state = initial_state(&bodies, &constraints, &slabs);
        let count = state.points.len();
        let masses = || state.points.mass.iter().copied();
        let lightest = masses().fold(f64::INFINITY, f64::min);
        let total_mass = masses().sum();
        let wave_speed = bodies
            .iter()
            .map(|seed| seed.material.as_material().p_wave_speed())
            .fold(f64::MIN_POSITIVE, f64::max);
        let bodies = bodies
            .into_iter()
            .zip(field_of)
            .map(|(seed, field)| Body {
                shape: BodyShape::new(&seed, parameters.grid_spacing),
                kernel: Kernel::choose(parameters.loops, &seed),
                field,
                name: seed.name,
                material: seed.material,
                point_spacing: seed.point_spacing,
                discretisation: seed.discretisation,
            })
            .collect();
        let mut solid = Self {
            bodies,
            fields,
            saved: SolidState::default(),
            displacement: vec![SVector::zeros(); count],
            index_of: Vec::new(),
            sort_buffers: SortBuffers::default(),
            previous_velocity: Vec::new(),
            small_mass: SmallMassReport::default(),
            mass_cut: if count == 0 { 0.0 } else { RELATIVE_MASS_CUT * lightest },
            total_mass,
            wave_speed,
            failure: None,
            parameters,
            constraints,
            state,
        };
        solid.sort_points();
        solid.check_layout()?;
        solid.state.maximum_speed = solid.measure_maximum_speed();
        solid.save();
        Ok(solid)
    }

    /// Grid and time-integration parameters.
    pub fn parameters(&self) -> &SolidParameters<D> {
        &self.parameters
    }

    /// The bodies, in seed order.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Storage indices of a body's points; empty for an index beyond the bodies.
    pub fn body_range(&self, body: usize) -> Range<usize> {
        let offsets = self.state.slab_offsets.get(body);
        offsets.map_or(0..0, |offsets| offsets[0]..offsets[offsets.len() - 1])
    }

    /// The material points, in storage order.
    pub fn points(&self) -> &Points<D> {
        &self.state.points
    }

    /// Storage index of the point with an identity.
    pub fn point_index(&self, id: u32) -> Option<usize> {
        self.index_of.get(id as usize).map(|&index| index as usize)
    }

    /// Displacement (m) at a material position near a point, see
    /// [`Points::displacement_at`].
    pub fn displacement_at(&self, point: usize, reference: SVector<f64, D>) -> SVector<f64, D> {
        self.state.points.displacement_at(point, &reference)
    }

    /// Time (s).
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Mass of all points (kg; per metre of thickness in plane strain).
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// Largest speed of a point (m/s); NaN if any is.
    pub(crate) fn measure_maximum_speed(&self) -> f64 {
        largest_norm(&self.state.points.velocity)
    }

    /// Largest displacement of a point in the last step (m).
    pub(crate) fn measure_maximum_displacement(&self) -> f64 {
        largest_norm(&self.displacement)
    }
}

fn largest_norm<const D: usize>(vectors: &[SVector<f64, D>]) -> f64 {
    ordered_reduction::maximum(vectors.len(), |p| vectors[p].norm_squared()).map_or(0.0, f64::sqrt)
}

/// Points at rest in their reference state, body by body.
fn initial_state<const D: usize>(
    bodies: &[BodySeed<D>],
    constraints: &Constraints<D>,
    slabs: &[usize],
) -> SolidState<D> {
    let mut points = Points::default();
    let mut slab_offsets = Vec::new();
    for (index, seed) in bodies.iter().enumerate() {
        let volume = seed.point_spacing.powi(D as i32);
        let mass = seed.material.as_material().density() * volume;
        let start = points.len();
        for (k, position) in seed.points.iter().enumerate() {
            points.id.push((start + k) as u32);
            points.body.push(index as u16);
            points.position.push(*position);
            points.reference_position.push(*position);
            points.velocity.push(seed.initial_velocity(k));
            points.mass.push(mass);
            points.reference_volume.push(volume);
            points.volume.push(volume);
            points.deformation_gradient.push(Matrix3::identity());
            points.stress.push([0.0; 6]);
        }
        let mut offsets = vec![points.len(); slabs[index] + 1];
        offsets[0] = start;
        slab_offsets.push(offsets);
    }
    SolidState {
        points,
        slab_offsets,
        constraint_velocity: vec![SVector::zeros(); constraints.names.len()],
        reactions: vec![Reaction::default(); constraints.names.len()],
        supports: vec![SupportNode::default(); constraints.support_count()],
        ..SolidState::default()
    }
}
