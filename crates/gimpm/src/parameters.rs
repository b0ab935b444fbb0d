//! What describes a solid before it exists: grid, bodies, constraints.

use motion::Motion;
use nalgebra::{SMatrix, SVector};

use crate::error::SolidError;
use crate::material::{Material, MaterialModel};

/// The configuration in which a body's weights and gradients are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Frame {
    /// The current one, on the background grid shared by all such bodies (the
    /// founding paper): for bodies that break, flow or collide.
    #[default]
    Updated,
    /// The reference one, on a grid of the body's own that its points fill in a
    /// regular pattern (total Lagrangian): weights never change, nothing crosses
    /// cells, and a clamped face stays exactly where it is at any displacement.
    Total,
}

/// Which weights join points and nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shape {
    /// Grid linear functions at the point (original material point method, G3).
    Linear,
    /// Grid linear functions averaged over the point's undeformed box
    /// (uniform GIMP, G1).
    #[default]
    Ugimp,
    /// The same over a box whose edges stretch with the point's deformation
    /// gradient along the axes (contiguous-particle GIMP).
    Cpgimp,
    /// Grid functions interpolated between the corners of the point's deformed
    /// parallelogram or parallelepiped (convected particle domain interpolation).
    Cpdi,
}

/// How velocity travels from nodes to points and back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Transfer {
    /// Points keep their velocity and take accelerations from nodes (G11).
    #[default]
    Flip,
    /// Points take the velocity of the nodes and carry its affine part, found from
    /// its moments (affine particle in cell; Jiang et al. 2015).
    Apic,
    /// The same with the affine part found from the velocity's gradient (Taylor
    /// particle in cell; Nakamura, Matsumura and Mizutani 2023).
    Tpic,
    /// Points take the velocity of a grid whose mass matrix is inverted to this
    /// order (full mass matrix PIC; Nairn and Hammerquist 2021); 1 is PIC.
    Fmpm {
        /// Terms of the expansion, at least 1.
        order: u32,
    },
}

/// When in a step the stress is updated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StressUpdate {
    /// At its end, from the re-mapped velocity (modified update stress last, MUSL;
    /// the founding paper).
    #[default]
    ModifiedLast,
    /// At its start, from the velocity before the forces act (USF).
    First,
    /// At its end, from the velocity of the grid (USL).
    Last,
}

/// Which loops over points are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Loops {
    /// The vector loops wherever there are some for a body's discretisation.
    #[default]
    Fast,
    /// One point at a time: the reference for the fast ones, several times slower.
    Plain,
}

/// How a body is discretised.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Discretisation {
    /// Configuration of weights and gradients.
    pub frame: Frame,
    /// Weights between points and nodes. In [`Frame::Total`] every box lies inside
    /// one cell, where all shapes are the same.
    pub shape: Shape,
    /// Transfer of velocity.
    pub transfer: Transfer,
    /// Replaces each point's volume ratio by its mean over the cell, against
    /// volumetric locking of nearly incompressible bodies (J-bar; [`Frame::Total`]
    /// and [`Transfer::Flip`] only, with the vector loops whatever
    /// [`SolidParameters::loops`] says).
    pub mean_dilatation: bool,
}

/// Contact between the bodies of a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Coulomb's friction coefficient μ, at least 0.
    pub friction: f64,
}

/// Search for the static state: local damping takes out the motion, and the balance
/// of forces tells when it is over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxation {
    /// The solid is at rest when the forces on it are balanced to this fraction of
    /// the larger of loads and reactions, above 0.
    pub tolerance: f64,
}

/// A load on the surface of a body.
///
/// It acts on the faces of material points that have no neighbour, that look along
/// one axis, and whose centres lie in a closed box, all in the reference state.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceLoad<const D: usize> {
    /// Name used in messages.
    pub name: String,
    /// Index of the body.
    pub body: usize,
    /// Axis along which the loaded faces look.
    pub axis: usize,
    /// Whether they look towards larger coordinates.
    pub upper_side: bool,
    /// Lower corner (m), may be `-inf`.
    pub lower: SVector<f64, D>,
    /// Upper corner (m), may be `inf`.
    pub upper: SVector<f64, D>,
    /// What acts on them.
    pub kind: LoadKind<D>,
    /// Time (s) over which it rises smoothly from nothing; 0: at once.
    pub ramp: f64,
}

/// What acts on a loaded surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadKind<const D: usize> {
    /// Force per reference area (Pa), constant in direction.
    Traction(SVector<f64, D>),
    /// Pressure (Pa) against the current normal, on the current area.
    Pressure(f64),
    /// Pressure of still water, `γ · max(0, level - x_vertical)` at the current
    /// position; the last axis is vertical.
    Hydrostatic {
        /// Level of the water surface (m).
        level: f64,
        /// Specific weight γ = ρ g (N/m³).
        specific_weight: f64,
    },
}

/// Grid and time-integration parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidParameters<const D: usize> {
    /// Gravity (m/s²).
    pub gravity: SVector<f64, D>,
    /// Time (s) over which gravity rises smoothly from nothing; 0: at once.
    pub gravity_ramp: f64,
    /// When the stress is updated.
    pub stress_update: StressUpdate,
    /// Loops over points.
    pub loops: Loops,
    /// Contact between bodies, which all are in the updated frame then; without it
    /// they stick.
    pub contact: Option<Contact>,
    /// Search for the static state; without it the motion is dynamic.
    pub relaxation: Option<Relaxation>,
    /// Fraction of the P-wave limit used by `stable_time_step`, above 0, at most 1.
    pub courant_number: f64,
    /// Cell width h (m), the same along every axis.
    pub grid_spacing: f64,
    /// Lower corner of the box that points may occupy (m); a node lies on it.
    pub grid_origin: SVector<f64, D>,
    /// Cells along each axis. Nodes around the box are added internally.
    pub grid_cells: [usize; D],
    /// Local damping coefficient (G25), 0 (none) to below 1.
    pub damping: f64,
}

/// Initial velocity of a body.
#[derive(Debug, Clone, PartialEq)]
pub enum InitialVelocity<const D: usize> {
    /// One value for all points (m/s).
    Uniform(SVector<f64, D>),
    /// One value for each point, in seed order (m/s). Points whose transfer carries
    /// the affine part of the velocity start without one.
    PerPoint(Vec<SVector<f64, D>>),
    /// `v = L (x - c)`, rigid rotation or uniform straining about a place; points
    /// whose transfer carries the affine part of the velocity start with it.
    Affine {
        /// Velocity gradient L (1/s).
        gradient: SMatrix<f64, D, D>,
        /// Place c at rest (m).
        centre: SVector<f64, D>,
    },
}

/// A body: points of equal size and one material.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySeed<const D: usize> {
    /// Name used in messages and output.
    pub name: String,
    /// Constitutive law with its density.
    pub material: MaterialModel,
    /// Positions (m) of the points. Identities count through the bodies in
    /// order, from 0.
    pub points: Vec<SVector<f64, D>>,
    /// Initial velocity.
    pub velocity: InitialVelocity<D>,
    /// Edge of a point's box (m), twice its half width; at most one cell.
    pub point_spacing: f64,
    /// Frame, weights and transfer.
    pub discretisation: Discretisation,
}

/// What a constraint prescribes.
#[derive(Debug, Clone, PartialEq)]
pub enum Hold<const D: usize> {
    /// The motion of each component; `None` leaves it free.
    Components([Option<Motion>; D]),
    /// The velocity along one direction; sliding across it is free.
    Normal {
        /// From the support into the body; its length is ignored.
        direction: SVector<f64, D>,
        /// Motion along it.
        motion: Motion,
        /// Whether the support only pushes: a node that would be pulled is let go
        /// and is met again when it has come back.
        one_sided: bool,
    },
}

/// A prescribed motion of every node in a closed box, for one body.
///
/// In [`Frame::Updated`] the nodes are those of the background grid, and bodies
/// that share its velocity field are held with the body; give the box an infinite
/// extent away from it: the node planes *beyond* a clamped face carry weight
/// too and must be held with it. In [`Frame::Total`] the nodes are material ones,
/// chosen in the reference state. A component that two constraints hold takes the
/// later one; components win over directions.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeConstraint<const D: usize> {
    /// Name used in messages and output.
    pub name: String,
    /// Index of the body.
    pub body: usize,
    /// Lower corner (m), may be `-inf`.
    pub lower: SVector<f64, D>,
    /// Upper corner (m), may be `inf`.
    pub upper: SVector<f64, D>,
    /// What is prescribed.
    pub hold: Hold<D>,
}

impl<const D: usize> SolidParameters<D> {
    /// Gravity (m/s²) at a time (s): the quintic start of
    /// [`Motion::SmoothStart`] over `gravity_ramp`.
    pub(crate) fn gravity_at(&self, time: f64) -> SVector<f64, D> {
        self.gravity * smooth_start(time, self.gravity_ramp)
    }

    /// Checks ranges.
    ///
    /// # Errors
    /// [`SolidError::Dimension`] or [`SolidError::Parameter`].
    pub fn validate(&self) -> Result<(), SolidError> {
        if !(2..=3).contains(&D) {
            return Err(SolidError::Dimension(D));
        }
        let check = |name, value: f64, ok: bool, allowed| {
            if ok { Ok(()) } else { Err(SolidError::Parameter { name, value, allowed }) }
        };
        let (h, courant) = (self.grid_spacing, self.courant_number);
        check("grid_spacing", h, h.is_finite() && h > 0.0, "finite and above 0")?;
        check("courant_number", courant, courant > 0.0 && courant <= 1.0, "in (0, 1]")?;
        check("damping", self.damping, (0.0..1.0).contains(&self.damping), "in [0, 1)")?;
        if let Some(Relaxation { tolerance }) = self.relaxation {
            let inside = tolerance > 0.0 && tolerance < 1.0;
            check("relaxation.tolerance", tolerance, inside, "above 0 and below 1")?;
            let damped = self.damping > 0.0;
            check("damping", self.damping, damped, "above 0 with a relaxation; 0.8 is usual")?;
        }
        if let Some(Contact { friction }) = self.contact {
            let ok = friction.is_finite() && friction >= 0.0;
            check("contact.friction", friction, ok, "finite and at least 0")?;
        }
        let ramp = self.gravity_ramp;
        check("gravity_ramp", ramp, ramp.is_finite() && ramp >= 0.0, "finite and at least 0")?;
        let mut nodes = 1.0;
        for d in 0..D {
            let (g, o, n) = (self.gravity[d], self.grid_origin[d], self.grid_cells[d]);
            check("gravity", g, g.is_finite(), "finite")?;
            check("grid_origin", o, o.is_finite(), "finite")?;
            check("grid_cells", n as f64, n > 0, "at least 1 along every axis")?;
            nodes *= n as f64 + 4.0;
        }
        check("grid_cells", nodes, nodes < 4.0e9, "fewer than 4e9 nodes in all")
    }
}

/// Share of a load that acts at `time` (s) when it rises smoothly over `duration`
/// (s): `10 s³ - 15 s⁴ + 6 s⁵`; 1 without a duration.
pub(crate) fn smooth_start(time: f64, duration: f64) -> f64 {
    if duration > 0.0 {
        Motion::SmoothStart { velocity: 1.0, duration }.velocity(time)
    } else {
        1.0
    }
}

impl<const D: usize> BodySeed<D> {
    /// Checks the material, the point size and the initial velocity.
    pub(crate) fn validate(&self, grid_spacing: f64) -> Result<(), SolidError> {
        let problem = |problem| Err(SolidError::Body { body: self.name.clone(), problem });
        self.material
            .validate()
            .map_err(|source| SolidError::Material { body: self.name.clone(), source })?;
        let size = self.point_spacing;
        if !(size > 0.0 && size <= grid_spacing * (1.0 + 1e-9)) {
            return problem(format!(
                "point_spacing is {size} m; it must be above 0 and at most the cell width {grid_spacing} m"
            ));
        }
        if self.discretisation.transfer == (Transfer::Fmpm { order: 0 }) {
            return problem("the order of its Fmpm transfer is 0; it must be at least 1".into());
        }
        let chosen = &self.discretisation;
        let cellwise = chosen.frame == Frame::Total && chosen.transfer == Transfer::Flip;
        if chosen.mean_dilatation && !cellwise {
            return problem(format!(
                "mean_dilatation needs Frame::Total and Transfer::Flip, it has {:?} and {:?}",
                chosen.frame, chosen.transfer
            ));
        }
        if self.points.is_empty() {
            return problem("it has no points; seed at least one".into());
        }
        match &self.velocity {
            InitialVelocity::Uniform(v) if !v.iter().all(|x| x.is_finite()) => {
                problem("its initial velocity is not finite".into())
            }
            InitialVelocity::PerPoint(v) if v.len() != self.points.len() => problem(format!(
                "it has {} points but {} initial velocities; give one for each point",
                self.points.len(),
                v.len()
            )),
            InitialVelocity::PerPoint(v) if v.iter().flatten().any(|x| !x.is_finite()) => {
                problem("one of its initial velocities is not finite".into())
            }
            InitialVelocity::Affine { gradient, centre }
                if gradient.iter().chain(centre.iter()).any(|x| !x.is_finite()) =>
            {
                problem("its initial velocity is not finite".into())
            }
            _ => Ok(()),
        }
    }

    /// Gradient of the initial velocity (1/s), as far as the seed knows it.
    pub(crate) fn initial_gradient(&self) -> SMatrix<f64, D, D> {
        match &self.velocity {
            InitialVelocity::Affine { gradient, .. } => *gradient,
            InitialVelocity::Uniform(_) | InitialVelocity::PerPoint(_) => SMatrix::zeros(),
        }
    }

    /// Velocity of point `k` of the seed (m/s).
    pub(crate) fn initial_velocity(&self, k: usize) -> SVector<f64, D> {
        match &self.velocity {
            InitialVelocity::Uniform(v) => *v,
            InitialVelocity::PerPoint(v) => v[k],
            InitialVelocity::Affine { gradient, centre } => gradient * (self.points[k] - centre),
        }
    }
}
