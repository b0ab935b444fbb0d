//! The solid: bodies on one background grid.

use std::ops::Range;

use nalgebra::{Matrix3, SMatrix, SVector};

use crate::constraints::{Constraints, SupportNode};
use crate::contact::ContactNodes;
use crate::error::SolidError;
use crate::fastest::Fastest;
use crate::field::{Field, fields};
use crate::grid_momentum::{RELATIVE_MASS_CUT, SmallMassReport};
use crate::kernel::Kernel;
use crate::lattice::Lattice;
use crate::material::{Material, MaterialModel};
use crate::parameters::{BodySeed, Discretisation, NodeConstraint, SolidParameters};
use crate::points::Points;
use crate::reaction::Reaction;
use crate::shape::{BodyShape, DeformingShape};
use crate::slabs::Slabs;
use crate::sort::SortBuffers;
use crate::state::SolidState;
use crate::stencil::PointStencil;
use crate::surface_load::LoadedSurface;
use crate::transfer::{PointTransfer, with_transfer};

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
    pub(crate) deforming: Option<DeformingShape>,
    pub(crate) slabs: Slabs,
    pub(crate) kernel: Kernel,
}

/// Bodies of material points and their grids; see the crate's example.
///
/// Bodies in the updated frame share one velocity field: where they meet, they
/// stick, unless [`SolidParameters::contact`] says how they touch.
#[derive(Debug, Clone)]
pub struct Solid<const D: usize> {
    pub(crate) parameters: SolidParameters<D>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) constraints: Constraints<D>,
    pub(crate) fields: Vec<Field<D>>,
    pub(crate) surfaces: Vec<LoadedSurface<D>>,
    pub(crate) contact: ContactNodes<D>,
    pub(crate) state: SolidState<D>,
    /// The copy that [`Self::save`] made.
    pub(crate) saved: Option<Box<SolidState<D>>>,
    /// Displacement of each point in the current step (m).
    pub(crate) displacement: Vec<SVector<f64, D>>,
    /// Storage index of each identity.
    pub(crate) index_of: Vec<u32>,
    pub(crate) sort_buffers: SortBuffers,
    /// Largest squares of a speed (m²/s²) and a displacement (m²) in the current step.
    pub(crate) fastest: Fastest,
    /// Whether the last sweep over the points found each on the planes of its slab.
    pub(crate) layout_holds: bool,
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
        let (mut fields, field_of) = fields(&parameters, &bodies)?;
        let constraints = Constraints::new(constraints, &fields, &field_of)?;
        if parameters.damping > 0.0 {
            constraints.mark_held(&mut fields);
        }
        let deforming = |seed: &BodySeed<D>| DeformingShape::new(seed, parameters.grid_spacing);
        let slabs_of = |seed: &BodySeed<D>| match deforming(seed) {
            Some(_) => Slabs::WIDE,
            None => Slabs::NARROW,
        };
        let slabs: Vec<usize> = bodies
            .iter()
            .zip(&field_of)
            .map(|(seed, &field)| slabs_of(seed).count(&fields[field].grid.geometry))
            .collect();
        let state = initial_state(&bodies, &constraints, &slabs);
        let count = state.points.len();
        let masses = || state.points.mass.iter().copied();
        let lightest = masses().fold(f64::INFINITY, f64::min);
        let total_mass = masses().sum();
        let wave_speed = bodies
            .iter()
            .map(|seed| seed.material.p_wave_speed())
            .fold(f64::MIN_POSITIVE, f64::max);
        let gradients: Vec<_> = bodies.iter().map(BodySeed::initial_gradient).collect();
        let bodies = bodies
            .into_iter()
            .zip(field_of)
            .map(|(seed, field)| Body {
                shape: BodyShape::new(&seed, parameters.grid_spacing),
                deforming: deforming(&seed),
                slabs: slabs_of(&seed),
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
            surfaces: Vec::new(),
            contact: ContactNodes::default(),
            saved: None,
            displacement: vec![SVector::zeros(); count],
            index_of: Vec::new(),
            sort_buffers: SortBuffers::default(),
            fastest: Fastest::default(),
            layout_holds: false,
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
        solid.start_affine_velocity(&gradients);
        solid.sort_points();
        solid.build_lattices()?;
        solid.check_layout()?;
        solid.state.maximum_speed = solid.measure_maximum_speed();
        Ok(solid)
    }

    /// Gives points the affine part of their seed's velocity, if any body needs one.
    fn start_affine_velocity(&mut self, gradients: &[SMatrix<f64, D, D>]) {
        if !self.bodies.iter().any(|body| body.discretisation.transfer.is_affine()) {
            return;
        }
        let points = &self.state.points;
        let mut stencil = PointStencil::default();
        let kept = (0..points.len()).map(|p| {
            let index = usize::from(points.body[p]);
            let (body, gradient) = (&self.bodies[index], &gradients[index]);
            let geometry = &self.fields[body.field].grid.geometry;
            let inside = (0..D).all(|d| {
                let along = geometry.coordinate(&points.position[p], d);
                along >= 0.0 && along <= geometry.cells[d] as f64
            });
            if !inside {
                return SMatrix::zeros(); // reported by the layout check
            }
            stencil.evaluate(body, geometry, &points.position[p], &Matrix3::identity());
            with_transfer!(body, transfer => transfer.keep(gradient, &stencil))
        });
        let kept = kept.collect();
        self.state.points.affine_velocity = kept;
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
        let velocity = &self.state.points.velocity;
        Fastest::of(velocity, velocity).speed_squared.sqrt()
    }

    /// Largest speed of a point after (5), or which point's speed is not finite.
    pub(crate) fn checked_maximum_speed(&self) -> Result<f64, SolidError> {
        let speed = self.fastest.speed_squared.sqrt();
        if speed.is_finite() {
            return Ok(speed);
        }
        let points = &self.state.points;
        let lost = points.velocity.iter().position(|v| !v.norm_squared().is_finite());
        let point = lost.map_or(0, |p| points.id[p]);
        Err(SolidError::NonFinite { point, quantity: "velocity", time: self.state.time })
    }

    /// Cuts the points of the bodies that [`Kernel::Lattice`] serves into blocks.
    ///
    /// # Errors
    /// [`SolidError::StateMismatch`] when the points are not in the order that
    /// [`Self::sort_points`] gives.
    pub(crate) fn build_lattices(&mut self) -> Result<(), SolidError> {
        for (body, offsets) in self.bodies.iter().zip(&self.state.slab_offsets) {
            if body.kernel != Kernel::Lattice {
                continue;
            }
            let (start, end) = (offsets[0], offsets[offsets.len() - 1]);
            let Field { grid, lattice, .. } = &mut self.fields[body.field];
            let mean_dilatation = body.discretisation.mean_dilatation;
            let points = &self.state.points;
            let Some(built) = Lattice::new(&grid.geometry, points, start, end, mean_dilatation)
            else {
                let what = "points of a total Lagrangian body sorted by cell";
                return Err(SolidError::StateMismatch { what, found: 0, expected: end - start });
            };
            *lattice = Some(built);
        }
        Ok(())
    }

    /// Makes the next step compute from the points what it would take over from the
    /// last one. To be called after every change of the points outside a step.
    pub(crate) fn forget_carried(&mut self) {
        self.fields.iter_mut().filter_map(|field| field.lattice.as_mut()).for_each(Lattice::forget);
    }
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
        let mass = seed.material.density() * volume;
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
            points.history.push([0.0; 2]);
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
