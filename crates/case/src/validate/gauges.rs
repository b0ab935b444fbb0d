//! Gauges: places inside, references resolved.

use crate::format::{CaseForm, GaugeForm};
use crate::geometry::Point;
use crate::model::ForceTarget;
use crate::plan::{FluidPlan, GaugeKindPlan, GaugePlan, SolidPlan, WallPlan};
use crate::suggestion;

use super::Checker;
use super::checker::{position_text, short};

/// Parts of a case that gauges refer to.
struct Parts<'a> {
    fluid: Option<&'a FluidPlan>,
    walls: &'a [WallPlan],
    solid: Option<&'a SolidPlan>,
    domain: (Point, Point),
}

/// Checks and resolves all gauges.
pub(crate) fn plan(
    form: &CaseForm,
    fluid: Option<&FluidPlan>,
    walls: &[WallPlan],
    solid: Option<&SolidPlan>,
    domain: (Point, Point),
    check: &mut Checker<'_>,
) -> Vec<GaugePlan> {
    let parts = Parts { fluid, walls, solid, domain };
    let gauges = form.gauges.iter().enumerate();
    gauges
        .filter_map(|(index, gauge)| {
            let kind = kind(gauge, &format!("gauges[{index}]"), &parts, check)?;
            Some(GaugePlan { name: gauge.name().to_owned(), kind })
        })
        .collect()
}

fn kind(
    gauge: &GaugeForm,
    path: &str,
    parts: &Parts<'_>,
    check: &mut Checker<'_>,
) -> Option<GaugeKindPlan> {
    let of_fluid = matches!(
        gauge,
        GaugeForm::Pressure { .. }
            | GaugeForm::Velocity { .. }
            | GaugeForm::WaterLevel { .. }
            | GaugeForm::Front { .. }
    );
    if of_fluid && parts.fluid.is_none() {
        let message = format!("gauge `{}` measures a fluid, and this case has none", gauge.name());
        check.problem(
            path,
            message,
            "use Displacement, Stress, CenterOfMass or Force, or add a fluid",
        );
        return None;
    }
    match gauge {
        GaugeForm::Pressure { position, .. } => {
            inside(&format!("{path}.position"), position, parts, check).map(GaugeKindPlan::Pressure)
        }
        GaugeForm::Velocity { position, .. } => {
            inside(&format!("{path}.position"), position, parts, check).map(GaugeKindPlan::Velocity)
        }
        GaugeForm::WaterLevel { base, top, .. } => {
            let base = inside(&format!("{path}.base"), base, parts, check);
            let top = inside(&format!("{path}.top"), top, parts, check);
            let (base, top) = (base?, top?);
            if base == top {
                let message = "`base` and `top` are the same point".into();
                check.problem(&format!("{path}.top"), message, "they are the ends of a line");
                return None;
            }
            Some(GaugeKindPlan::WaterLevel(base, top))
        }
        GaugeForm::Front { direction, .. } => {
            check.direction(&format!("{path}.direction"), direction).map(GaugeKindPlan::Front)
        }
        GaugeForm::Displacement { position, .. } => {
            in_body(gauge.name(), &format!("{path}.position"), position, parts, check)
                .map(|(body, position)| GaugeKindPlan::Displacement(body, position))
        }
        GaugeForm::Stress { position, .. } => {
            in_body(gauge.name(), &format!("{path}.position"), position, parts, check)
                .map(|(body, position)| GaugeKindPlan::Stress(body, position))
        }
        GaugeForm::CenterOfMass { of, .. } => {
            named_body(of, &format!("{path}.of"), parts, check).map(GaugeKindPlan::CenterOfMass)
        }
        GaugeForm::Force { on, about, .. } => {
            let about = check.vector_or(&format!("{path}.about"), about.as_ref(), Point::zeros());
            let target = target(on, &format!("{path}.on"), parts, check);
            Some(GaugeKindPlan::Force(target?, about?))
        }
    }
}

fn inside(
    path: &str,
    components: &[f64],
    parts: &Parts<'_>,
    check: &mut Checker<'_>,
) -> Option<Point> {
    let position = check.vector(path, components)?;
    if check.contains(parts.domain, &position) {
        return Some(position);
    }
    let d = check.dimension;
    let message = format!("{} is outside the domain", position_text(&position, d));
    let (lower, upper) = parts.domain;
    let help = format!(
        "the domain reaches from {} to {}",
        position_text(&lower, d),
        position_text(&upper, d)
    );
    check.problem(path, message, &help);
    None
}

/// The body at a place, to within one point spacing.
fn in_body(
    gauge: &str,
    path: &str,
    components: &[f64],
    parts: &Parts<'_>,
    check: &mut Checker<'_>,
) -> Option<(usize, Point)> {
    let position = check.vector(path, components)?;
    let Some(solid) = parts.solid else {
        let message = format!("gauge `{gauge}` follows a body, and this case has no solid");
        check.problem(path, message, "use Pressure, Velocity, WaterLevel or Front");
        return None;
    };
    let distances = solid.bodies.iter().map(|body| body.region.signed_distance(&position));
    let (body, distance) =
        distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, f64::INFINITY));
    if distance <= solid.point_spacing {
        return Some((body, position));
    }
    let message = format!("{} is in no body", position_text(&position, check.dimension));
    let name = solid.bodies.get(body).map_or("", |body| &body.name);
    let help = format!(
        "the nearest body `{name}` is {} m away; give a position in the undeformed body",
        short(distance)
    );
    check.problem(path, message, &help);
    None
}

fn named_body(of: &str, path: &str, parts: &Parts<'_>, check: &mut Checker<'_>) -> Option<usize> {
    let bodies = parts.solid.map_or(&[][..], |solid| &solid.bodies);
    let found = bodies.iter().position(|body| body.name == of);
    if found.is_none() {
        let valid: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
        check.problem(path, format!("there is no body `{of}`"), &suggestion::help(of, &valid));
    }
    found
}

fn target(on: &str, path: &str, parts: &Parts<'_>, check: &mut Checker<'_>) -> Option<ForceTarget> {
    let mut names: Vec<(&str, ForceTarget)> = Vec::new();
    for (index, wall) in parts.walls.iter().enumerate() {
        names.push((&wall.name, ForceTarget::Wall(index)));
    }
    let bodies = parts.solid.map_or(&[][..], |solid| &solid.bodies);
    for (index, body) in bodies.iter().enumerate() {
        names.push((&body.name, ForceTarget::Body(index)));
    }
    for (index, boundary) in bodies.iter().flat_map(|body| &body.boundaries).enumerate() {
        names.push((&boundary.name, ForceTarget::Boundary(index)));
    }
    let Some((_, target)) = names.iter().find(|(name, _)| *name == on) else {
        let valid: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
        let message = format!("there is no wall, body or boundary `{on}`");
        check.problem(path, message, &suggestion::help(on, &valid));
        return None;
    };
    if matches!(target, ForceTarget::Body(_)) && parts.fluid.is_none() {
        let message = format!("the force on body `{on}` is that of the fluid, and there is none");
        check.problem(path, message, "name a boundary to record its reaction");
        return None;
    }
    Some(*target)
}
