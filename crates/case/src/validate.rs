//! From the file as written to a checked [`Plan`].

mod boundary;
mod checker;
mod discretisation;
mod fluid;
mod gauges;
mod load;
mod material;
mod scope;
mod shape;
mod solid;
mod walls;

use crate::CaseError;
use crate::estimate;
use crate::format::{CaseForm, CorrectorsForm};
use crate::geometry::{Point, union};
use crate::model::OutputIntervals;
use crate::plan::{FluidPlan, Plan, SolidPlan, WallPlan, WallShape};
use crate::source::Source;

pub(crate) use checker::{AXES, Checker, FACES, position_text, short};

/// Checks everything and resolves it. All independent mistakes are reported.
pub(crate) fn plan(
    form: &CaseForm,
    source: &Source,
    available_memory: Option<u64>,
) -> Result<Plan, CaseError> {
    let mut check = Checker::new(source);
    check.file_name("name", &form.name);
    if !(2..=3).contains(&form.dimension) {
        check.problem(
            "dimension",
            format!("the dimension is {}", form.dimension),
            "use 2 (plane strain) or 3",
        );
        return Err(check.into_error());
    }
    check.dimension = form.dimension;
    check.positive("end_time", form.end_time, "s");
    let gravity = match &form.gravity {
        Some(gravity) => check.vector("gravity", gravity),
        None => Some(-9.81 * check.up_axis()),
    };
    let output = output(form, &mut check);
    scope::names(form, &mut check);
    correctors(form, &mut check);
    if form.fluid.is_none() && form.solid.is_none() {
        check.problem("", "the case has neither a fluid nor a solid".into(), "add one of them");
    }
    if form.fluid.is_none() && !form.walls.is_empty() {
        check.problem(
            "walls",
            "walls act on a fluid only, and this case has none".into(),
            "hold a body by its boundaries, or add a fluid",
        );
    }
    let gravity_known = gravity.unwrap_or_default();
    let fluid =
        form.fluid.as_ref().and_then(|fluid| fluid::plan(fluid, &gravity_known, form, &mut check));
    let walls = walls::plan(&form.walls, fluid.as_ref(), &mut check);
    // A spacing that is far too small would only bring mistakes that follow from it.
    if let Some(fluid) = &fluid {
        let fits = estimate::check_fluid_memory(fluid, &walls, available_memory, &mut check);
        if !fits {
            return Err(check.into_error());
        }
    }
    let solid = form.solid.as_ref().and_then(|solid| {
        solid::plan(solid, fluid.as_ref(), &gravity_known, form.end_time, &mut check)
    });
    // What follows relates the parts to each other, which needs them all.
    if check.failed() {
        return Err(check.into_error());
    }
    let domain = domain(form, fluid.as_ref(), &walls, solid.as_ref(), &mut check);
    let gauges = gauges::plan(form, fluid.as_ref(), &walls, solid.as_ref(), domain, &mut check);
    let mut plan = Plan {
        dimension: form.dimension,
        gravity: gravity_known,
        end_time: form.end_time,
        domain,
        fluid,
        walls,
        solid,
        correctors: form.coupling.correctors,
        gauges,
        output,
        estimate: estimate::Estimate::default(),
        warnings: Vec::new(),
    };
    plan.estimate = estimate::before_seeding(&plan);
    estimate::check_memory(&plan, available_memory, &mut check);
    plan.warnings = check.take_warnings();
    if check.failed() { Err(check.into_error()) } else { Ok(plan) }
}

fn output(form: &CaseForm, check: &mut Checker<'_>) -> OutputIntervals {
    let frame = form.output.frame_interval;
    check.positive("output.frame_interval", frame, "s");
    let gauge = form.output.gauge_interval.unwrap_or(0.1 * frame);
    if let Some(gauge) = form.output.gauge_interval {
        check.positive("output.gauge_interval", gauge, "s");
    }
    if let Some(checkpoint) = form.output.checkpoint_interval {
        check.positive("output.checkpoint_interval", checkpoint, "s");
    }
    let frames = form.end_time / frame;
    if frames > 1e6 {
        check.problem(
            "output.frame_interval",
            format!("an interval of {frame} s gives {frames:.3e} frames in {} s", form.end_time),
            "keep to at most 1e6 frames",
        );
    }
    OutputIntervals { frame, gauge, checkpoint: form.output.checkpoint_interval }
}

fn correctors(form: &CaseForm, check: &mut Checker<'_>) {
    if let CorrectorsForm::Fixed(count @ 4..) = form.coupling.correctors {
        check.problem(
            "coupling.correctors",
            format!("{count} correctors are asked for"),
            "use Auto, or Fixed(0) to Fixed(3)",
        );
    }
}

/// The domain as given, or the geometry widened by a quarter of its largest extent.
fn domain(
    form: &CaseForm,
    fluid: Option<&FluidPlan>,
    walls: &[WallPlan],
    solid: Option<&SolidPlan>,
    check: &mut Checker<'_>,
) -> (Point, Point) {
    let margin = fluid.map_or(0.0, |fluid| fluid.layers as f64 * fluid.spacing());
    let blocks = fluid.iter().flat_map(|fluid| &fluid.blocks).map(|block| block.region.bounds());
    let bodies = solid.iter().flat_map(|solid| &solid.bodies).map(|body| body.region.bounds());
    let walls = walls.iter().map(|wall| match &wall.shape {
        WallShape::Tank { lower, upper, .. } => {
            (lower - check.axes_mask() * margin, upper + check.axes_mask() * margin)
        }
        WallShape::Filled(region) => region.bounds(),
    });
    let (lower, upper) = union(blocks.chain(bodies).chain(walls));
    let Some(given) = &form.domain else {
        let widening = 0.25 * (upper - lower).max() + 2.0 * margin;
        let widening = check.axes_mask() * widening;
        return (lower - widening, upper + widening);
    };
    let corners = check.corners("domain", &given.lower, &given.upper);
    let Some((low, high)) = corners else { return (lower, upper) };
    let inside = fluid.iter().flat_map(|fluid| fluid.blocks.iter().enumerate());
    for (index, block) in inside {
        let (lower, upper) = block.region.bounds();
        if !check.contains((low, high), &lower) || !check.contains((low, high), &upper) {
            check.problem(
                &format!("fluid.blocks[{index}]"),
                format!("fluid block `{}` reaches out of the domain", block.name),
                "widen `domain`, or leave it out to have it follow the geometry",
            );
        }
    }
    (low, high)
}
