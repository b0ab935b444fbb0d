//! What describes a solid before it exists: grid, bodies, constraints.

use motion::Motion;
use nalgebra::SVector;

use crate::error::SolidError;
use crate::material::MaterialModel;

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
}

/// How velocity travels from nodes to points and back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Transfer {
    /// Points keep their velocity and take accelerations from nodes (G11).
    #[default]
    Flip,
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
    /// volumetric locking of nearly incompressible bodies (J-bar, [`Frame::Total`] only).
    pub mean_dilatation: bool,
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
    /// One value for each point, in seed order (m/s).
    PerPoint(Vec<SVector<f64, D>>),
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
            _ => Ok(()),
        }
    }

    /// Velocity of point `k` of the seed (m/s).
    pub(crate) fn initial_velocity(&self, k: usize) -> SVector<f64, D> {
        match &self.velocity {
            InitialVelocity::Uniform(v) => *v,
            InitialVelocity::PerPoint(v) => v[k],
        }
    }
}
