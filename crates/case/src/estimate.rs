//! What a case will cost, known before anything is seeded.

use gimpm::{Frame, Material};

use crate::format::DissipationForm;
use crate::geometry::Point;
use crate::memory;
use crate::plan::{BodyPlan, FluidPlan, Plan, SolidPlan, WallPlan, WallShape};
use crate::validate::Checker;

/// Bytes of state and work arrays per item, all buffers of a run included.
const FLUID_PARTICLE: f64 = 600.0;
const WALL_POINT: f64 = 250.0;
const MATERIAL_POINT: f64 = 900.0;
const GRID_NODE: f64 = 250.0;
const SEARCH_CELL: f64 = 16.0;

/// Part of the memory that a run may fill.
const USABLE: f64 = 0.8;

/// Estimated size and time steps of a case.
///
/// After [`crate::Case::build`] the counts are those seeded; before, they follow
/// from the volumes of the shapes, which overlaps make too large.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Estimate {
    /// Fluid particles.
    pub fluid_particles: u64,
    /// Rigid wall particles.
    pub wall_points: u64,
    /// Material points.
    pub material_points: u64,
    /// Nodes of the solid's background grid.
    pub grid_nodes: u64,
    /// Working memory of a run (bytes).
    pub memory: u64,
    /// Time step of the fluid at its largest expected speed.
    pub fluid_step: Option<StepEstimate>,
    /// Time step of the solid.
    pub solid_step: Option<StepEstimate>,
    /// Solid sub-steps in one fluid step; 1 unless there are both.
    pub substeps: u64,
    /// Coupled steps to the end time.
    pub steps: u64,
}

/// A time step and what limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepEstimate {
    /// Length (s).
    pub value: f64,
    /// Limiting term, in the words of the solvers.
    pub term: &'static str,
}

/// Counts as numbers that cannot overflow.
struct Counts {
    fluid: f64,
    walls: f64,
    points: f64,
    nodes: f64,
    cells: f64,
}

impl Counts {
    fn of(plan: &Plan) -> Self {
        let mut counts = Self::of_parts(plan.fluid.as_ref(), &plan.walls, plan.solid.as_ref());
        if let Some(fluid) = &plan.fluid {
            let (lower, upper) = plan.domain;
            counts.cells = (0..plan.dimension)
                .map(|axis| ((upper[axis] - lower[axis]) / fluid.kernel_radius()).ceil())
                .product();
        }
        counts
    }

    fn of_parts(fluid: Option<&FluidPlan>, walls: &[WallPlan], solid: Option<&SolidPlan>) -> Self {
        let mut counts = Self { fluid: 0.0, walls: 0.0, points: 0.0, nodes: 0.0, cells: 0.0 };
        if let Some(fluid) = fluid {
            let cell = fluid.spacing().powi(fluid.lattice.dimension as i32);
            counts.fluid = fluid.blocks.iter().map(|block| block.region.volume() / cell).sum();
            counts.walls = walls.iter().map(|wall| wall_volume(wall, fluid) / cell).sum();
        }
        if let Some(solid) = solid {
            let dimension = solid.grid.dimension;
            let cell = solid.point_spacing.powi(dimension as i32);
            counts.points = solid.bodies.iter().map(|body| body.region.volume() / cell).sum();
            counts.nodes = grid_nodes(solid);
        }
        counts
    }

    fn fluid_memory(&self) -> f64 {
        self.fluid * FLUID_PARTICLE + self.walls * WALL_POINT + self.cells * SEARCH_CELL
    }

    fn solid_memory(&self) -> f64 {
        self.points * MATERIAL_POINT + self.nodes * GRID_NODE
    }
}

/// Nodes of all grids: bodies in the updated frame share the background grid, or have one
/// each for contact; one in the total frame has the part that it covers.
fn grid_nodes(solid: &SolidPlan) -> f64 {
    let axes = 0..solid.grid.dimension;
    // The solver adds two planes of nodes on each side.
    let whole: f64 = axes.clone().map(|axis| solid.cells[axis] as f64 + 5.0).product();
    let covered = |body: &BodyPlan| -> f64 {
        let (lower, upper) = body.region.bounds();
        axes.clone().map(|d| ((upper[d] - lower[d]) / solid.grid.spacing).ceil() + 5.0).product()
    };
    let (updated, total): (Vec<_>, Vec<_>) =
        solid.bodies.iter().partition(|body| body.discretisation.frame == Frame::Updated);
    let shared = if solid.contact.is_some() { updated.len() } else { updated.len().min(1) };
    shared as f64 * whole + total.into_iter().map(covered).sum::<f64>()
}

/// Volume that a wall fills with particles (m^D).
fn wall_volume(wall: &WallPlan, fluid: &FluidPlan) -> f64 {
    let thickness = fluid.layers as f64 * fluid.spacing();
    let axes = 0..fluid.lattice.dimension;
    let volume = |lower: &Point, upper: &Point| -> f64 {
        axes.clone().map(|axis| upper[axis] - lower[axis]).product()
    };
    match &wall.shape {
        WallShape::Tank { lower, upper, closed } => {
            let (mut outer_lower, mut outer_upper) = (*lower, *upper);
            for axis in axes.clone() {
                outer_lower[axis] -= if closed[axis][0] { thickness } else { 0.0 };
                outer_upper[axis] += if closed[axis][1] { thickness } else { 0.0 };
            }
            volume(&outer_lower, &outer_upper) - volume(lower, upper)
        }
        WallShape::Filled(region) => {
            let (lower, upper) = region.bounds();
            let sizes = upper - lower;
            let inner: f64 =
                axes.clone().map(|axis| (sizes[axis] - 2.0 * thickness).max(0.0)).product();
            (region.volume() - inner).max(0.1 * region.volume())
        }
    }
}

/// Estimates from shapes and parameters alone.
pub(crate) fn before_seeding(plan: &Plan) -> Estimate {
    let counts = Counts::of(plan);
    let fluid_step = plan.fluid.as_ref().map(|fluid| fluid_step(fluid, &plan.gravity));
    let solid_step = plan.solid.as_ref().and_then(solid_step);
    let (step, substeps) = match (fluid_step, solid_step) {
        (Some(fluid), Some(solid)) => (fluid.value, (fluid.value / solid.value).ceil()),
        (Some(fluid), None) => (fluid.value, 1.0),
        (None, Some(solid)) => (solid.value, 1.0),
        (None, None) => (plan.end_time, 1.0),
    };
    Estimate {
        fluid_particles: counts.fluid.round() as u64,
        wall_points: counts.walls.round() as u64,
        material_points: counts.points.round() as u64,
        grid_nodes: counts.nodes as u64,
        memory: (counts.fluid_memory() + counts.solid_memory()) as u64,
        fluid_step,
        solid_step,
        substeps: substeps as u64,
        steps: (plan.end_time / step).ceil() as u64,
    }
}

/// The terms of `sph`'s time step (S8) at the largest speed expected.
fn fluid_step(fluid: &FluidPlan, gravity: &Point) -> StepEstimate {
    let (h, c0, speed) = (fluid.smoothing_length, fluid.sound_speed, fluid.maximum_speed);
    let relative_viscosity = match fluid.dissipation {
        DissipationForm::None => 0.0,
        DissipationForm::Artificial { alpha } => alpha,
        DissipationForm::Riemann { limiter } => (2.0 * limiter * speed / c0).min(1.0),
    };
    let terms = [
        ("sound speed", fluid.courant_number * h / (c0 + speed)),
        ("acceleration", 0.25 * (h / gravity.norm()).sqrt()),
        ("viscosity", 0.5 * h / (relative_viscosity * c0)),
        ("density diffusion", 0.07 * h / (fluid.density_diffusion * c0)),
    ];
    let (term, value) = terms.into_iter().fold(terms[0], |a, b| if b.1 < a.1 { b } else { a });
    StepEstimate { value, term }
}

/// `gimpm`'s time step (G21) at rest.
fn solid_step(solid: &SolidPlan) -> Option<StepEstimate> {
    let fastest = solid.bodies.iter().map(|body| body.material.p_wave_speed()).reduce(f64::max)?;
    let value = solid.courant_number * solid.grid.spacing / fastest;
    Some(StepEstimate { value, term: "P-wave speed" })
}

/// Refuses a case that the machine's memory or the solvers' 32-bit indices cannot hold.
pub(crate) fn check_memory(plan: &Plan, available: Option<u64>, check: &mut Checker<'_>) {
    refuse_excess(&Counts::of(plan), plan.fluid.as_ref(), plan.solid.as_ref(), available, check);
}

/// The same for the fluid alone, before the rest of a case is compared with it;
/// whether it fits.
pub(crate) fn check_fluid_memory(
    fluid: &FluidPlan,
    walls: &[WallPlan],
    available: Option<u64>,
    check: &mut Checker<'_>,
) -> bool {
    let counts = Counts::of_parts(Some(fluid), walls, None);
    refuse_excess(&counts, Some(fluid), None, available, check)
}

fn refuse_excess(
    counts: &Counts,
    fluid: Option<&FluidPlan>,
    solid: Option<&SolidPlan>,
    available: Option<u64>,
    check: &mut Checker<'_>,
) -> bool {
    let most = f64::from(u32::MAX);
    let limit = available.map_or(f64::INFINITY, |bytes| USABLE * bytes as f64);
    let need = counts.fluid_memory() + counts.solid_memory();
    let largest = counts.fluid.max(counts.walls).max(counts.points).max(counts.nodes);
    if need <= limit && largest <= most {
        return true;
    }
    let excess = (need / limit).max(largest / most);
    let reason = if need > limit {
        format!(
            "about {}, but this machine has {}, of which {:.0} % may be used",
            memory::text(need),
            memory::text(available.unwrap_or(0) as f64),
            100.0 * USABLE
        )
    } else {
        format!("more than {most:.1e} indices of one kind")
    };
    let (path, spacing) = match (fluid, solid) {
        (Some(fluid), None) => ("fluid.spacing", fluid.spacing()),
        (Some(fluid), Some(_)) if counts.fluid_memory() >= counts.solid_memory() => {
            ("fluid.spacing", fluid.spacing())
        }
        (_, Some(solid)) => ("solid.grid_spacing", solid.grid.spacing),
        (None, None) => return true,
    };
    let fitting = spacing * (1.05 * excess).powf(1.0 / check.dimension as f64);
    let message = format!(
        "too many particles: {:.3e} fluid particles, {:.3e} wall points, {:.3e} material points \
         and {:.3e} grid nodes need {reason}",
        counts.fluid, counts.walls, counts.points, counts.nodes
    );
    check.problem(path, message, &format!("a spacing of at least {fitting:.2e} m would fit"));
    false
}

/// Working memory for the counts of an estimate (bytes).
pub(crate) fn working_memory(estimate: &Estimate, plan: &Plan) -> u64 {
    let counts = Counts {
        fluid: estimate.fluid_particles as f64,
        walls: estimate.wall_points as f64,
        points: estimate.material_points as f64,
        ..Counts::of(plan)
    };
    (counts.fluid_memory() + counts.solid_memory()) as u64
}
