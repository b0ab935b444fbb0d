use nalgebra::SVector;

use crate::CouplingError;

/// The largest stable time step and the term that limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepLimit {
    /// Time step (s).
    pub value: f64,
    /// Name of the limiting term.
    pub term: &'static str,
}

/// The solid's material points as the fluid sees them: wall particles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StructurePoints<const D: usize> {
    /// Stable number of each point, unchanged by sorting.
    pub id: Vec<u32>,
    /// Body of each point.
    pub body: Vec<u16>,
    /// Position (m).
    pub position: Vec<SVector<f64, D>>,
    /// Velocity of the point itself (m/s); the fluid uses the step mean (C1).
    pub velocity: Vec<SVector<f64, D>>,
    /// Current volume (m³; m² in 2D).
    pub volume: Vec<f64>,
}

/// Momentum that entered the solid during [`SolidSide::advance`] (N s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidImpulse<const D: usize> {
    /// Change of the points' momentum, Σ m v at the end minus at the start.
    pub momentum_change: SVector<f64, D>,
    /// Impulse of gravity and of loads other than the fluid's.
    pub loads: SVector<f64, D>,
    /// Impulse of the supports on the solid.
    pub supports: SVector<f64, D>,
    /// Σ m |v| at the end: the size that round-off of the momentum has.
    pub magnitude: f64,
}

impl<const D: usize> SolidImpulse<D> {
    /// No momentum exchanged.
    pub fn zero() -> Self {
        let zero = SVector::zeros();
        Self { momentum_change: zero, loads: zero, supports: zero, magnitude: 0.0 }
    }
}

/// The fluid, in the order in which one coupled step calls it.
///
/// ```
/// use coupling::{CouplingError, FluidSide, StructurePoints, TimeStepLimit};
/// use nalgebra::SVector;
///
/// /// A uniform, constant pressure: the simplest load that a solid can meet.
/// struct Push(f64);
///
/// impl<const D: usize> FluidSide<D> for Push {
///     fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> {
///         Ok(Some(TimeStepLimit { value: 1e-3, term: "chosen" }))
///     }
///     fn predict(&mut self, _: f64, _: &StructurePoints<D>) -> Result<(), CouplingError> {
///         Ok(())
///     }
///     fn load(&mut self, load: &mut [SVector<f64, D>]) {
///         load.iter_mut().for_each(|force| force[0] = self.0);
///     }
///     fn correct(&mut self, _: f64, _: &[SVector<f64, D>], _: &[SVector<f64, D>], _: &mut [SVector<f64, D>])
///         -> Result<(), CouplingError> { Ok(()) }
///     fn finish(&mut self, dt: f64, velocity: &[SVector<f64, D>]) -> Result<SVector<f64, D>, CouplingError> {
///         let mut impulse = SVector::zeros();
///         impulse[0] = -self.0 * dt * velocity.len() as f64;
///         Ok(impulse)
///     }
/// }
/// ```
pub trait FluidSide<const D: usize> {
    /// The fluid's stable time step; `None` when the fluid sets no limit.
    ///
    /// # Errors
    /// The fluid's state is not finite.
    fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError>;

    /// Drifts to the middle of the step and places the structure's points,
    /// already predicted to mid-step by the caller.
    ///
    /// # Errors
    /// The fluid refuses the step.
    fn predict(&mut self, dt: f64, points: &StructurePoints<D>) -> Result<(), CouplingError>;

    /// Pair forces at mid-step (C2), (C4): writes f_p = -Σ_a F_ap (N) of every
    /// structure point.
    fn load(&mut self, load: &mut [SVector<f64, D>]);

    /// Redoes density and forces near the structure after its mean velocity
    /// changed from `old` to `new` (m/s), and writes the new load.
    ///
    /// # Errors
    /// The velocities do not belong to the points placed last.
    fn correct(
        &mut self,
        dt: f64,
        old: &[SVector<f64, D>],
        new: &[SVector<f64, D>],
        load: &mut [SVector<f64, D>],
    ) -> Result<(), CouplingError>;

    /// Kick and second drift with the forces of the last load, and with the
    /// mean `velocity` that the structure really had (C1). Returns the impulse
    /// of the structure on the fluid, summed on the fluid's side (N s).
    ///
    /// # Errors
    /// The fluid's state is not finite or out of range.
    fn finish(
        &mut self,
        dt: f64,
        velocity: &[SVector<f64, D>],
    ) -> Result<SVector<f64, D>, CouplingError>;
}

/// The solid, in the order in which one coupled step calls it.
///
/// [`NoSolid`](crate::NoSolid) is the smallest implementation, `gimpm::Solid`
/// the real one.
///
/// ```
/// use coupling::{CouplingError, SolidImpulse, SolidSide, StructurePoints, TimeStepLimit};
/// use nalgebra::SVector;
///
/// /// One free mass point of 1 kg.
/// #[derive(Clone, Copy)]
/// struct Ball { position: f64, velocity: f64 }
/// struct Saved { now: Ball, kept: Ball }
///
/// impl SolidSide<2> for Saved {
///     fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError> { Ok(None) }
///     fn points(&mut self, points: &mut StructurePoints<2>) {
///         let at = |x| SVector::from([x, 0.0]);
///         *points = StructurePoints {
///             id: vec![0], body: vec![0], volume: vec![1e-3],
///             position: vec![at(self.now.position)], velocity: vec![at(self.now.velocity)],
///         };
///     }
///     fn save(&mut self) { self.kept = self.now; }
///     fn restore(&mut self) { self.now = self.kept; }
///     fn advance(&mut self, dt: f64, substeps: u32, load: &[SVector<f64, 2>], end: &mut [SVector<f64, 2>])
///         -> Result<SolidImpulse<2>, CouplingError> {
///         let before = self.now.velocity;
///         for _ in 0..substeps {
///             self.now.velocity += load[0][0] * dt / f64::from(substeps);
///             self.now.position += self.now.velocity * dt / f64::from(substeps);
///         }
///         end[0][0] = self.now.position;
///         let mut impulse = SolidImpulse::zero();
///         impulse.momentum_change[0] = self.now.velocity - before;
///         Ok(impulse)
///     }
/// }
///
/// use coupling::{Coupled, CouplingParameters, NoFluid};
/// let ball = Ball { position: 0.0, velocity: 2.0 };
/// let mut free = Coupled::new(NoFluid, Saved { now: ball, kept: ball }, CouplingParameters::default())?;
/// free.step(0.5)?;
/// assert_eq!(free.solid().now.position, 1.0);
/// # Ok::<(), CouplingError>(())
/// ```
pub trait SolidSide<const D: usize> {
    /// The solid's stable time step; `None` when there is nothing to limit it.
    ///
    /// # Errors
    /// The solid's state is not finite.
    fn stable_time_step(&self) -> Result<Option<TimeStepLimit>, CouplingError>;

    /// Writes all points; the only place where the solid may reorder them.
    fn points(&mut self, points: &mut StructurePoints<D>);

    /// Keeps a copy of the state for [`Self::restore`].
    fn save(&mut self);

    /// Returns to the state of the last [`Self::save`].
    fn restore(&mut self);

    /// `substeps` equal steps over `dt` with the frozen point `load` (N),
    /// scattered to the grid with the current weights in each (C5). Writes the
    /// points' positions at the end.
    ///
    /// # Errors
    /// The solid refuses a sub-step.
    fn advance(
        &mut self,
        dt: f64,
        substeps: u32,
        load: &[SVector<f64, D>],
        end_position: &mut [SVector<f64, D>],
    ) -> Result<SolidImpulse<D>, CouplingError>;
}
