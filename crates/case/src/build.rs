//! From a checked plan to particles and points.

mod fluid;
mod overlap;
mod selection;
mod solid;
mod walls;

use coupling::{Correctors, CouplingParameters};
use gimpm::Material;
use nalgebra::SVector;

use crate::estimate;
use crate::format::{CaseForm, CorrectorsForm};
use crate::geometry::Point;
use crate::model::{FluidModel, Gauge, GaugeKind, Model, SolidModel};
use crate::plan::{GaugeKindPlan, Plan};
use crate::source::Source;
use crate::validate::short;
use crate::{CaseError, Estimate};

/// Seeds everything.
pub(crate) fn model<const D: usize>(
    form: &CaseForm,
    source: &Source,
    plan: &Plan,
) -> Result<Model<D>, CaseError> {
    if D != plan.dimension {
        let message = format!("the case has dimension {}, not {D}", plan.dimension);
        return Err(source.error_at_path("dimension", message));
    }
    let mut notes = Vec::new();
    let mut warnings = plan.warnings.clone();
    let solid = match &plan.solid {
        Some(solid) => Some(solid::seed(solid, plan, source, &mut notes)?),
        None => None,
    };
    let fluid = match &plan.fluid {
        Some(fluid) => Some(fluid::seed(fluid, plan, source, &mut notes)?),
        None => None,
    };
    warnings.extend(overlap::body_in_wall(plan));
    Ok(Model {
        name: form.name.clone(),
        description: form.description.clone(),
        case_text: source.text().to_owned(),
        gravity: shrink(&plan.gravity),
        end_time: plan.end_time,
        domain: (shrink(&plan.domain.0), shrink(&plan.domain.1)),
        coupling: coupling(plan),
        gauges: plan.gauges.iter().map(|gauge| self::gauge(&gauge.name, &gauge.kind)).collect(),
        output: plan.output,
        estimate: counted(plan, fluid.as_ref(), solid.as_ref()),
        notes,
        warnings,
        fluid,
        solid,
    })
}

/// The first `D` components.
pub(crate) fn shrink<const D: usize>(p: &Point) -> SVector<f64, D> {
    SVector::from_fn(|axis, _| p[axis])
}

fn coupling(plan: &Plan) -> CouplingParameters {
    let correctors = match plan.correctors {
        CorrectorsForm::Auto => Correctors::Automatic,
        CorrectorsForm::Fixed(count) => Correctors::Fixed(count),
    };
    let mut parameters = CouplingParameters { correctors, ..CouplingParameters::default() };
    if let (Some(fluid), Some(solid)) = (&plan.fluid, &plan.solid) {
        // μ = ρ_s t/(ρ dx) of the lightest body decides how often the wall velocity is corrected.
        let layer = fluid.density * fluid.spacing();
        parameters.mass_ratio = solid
            .bodies
            .iter()
            .map(|body| body.material.density() * body.region.thickness() / layer)
            .fold(f64::INFINITY, f64::min);
    }
    parameters
}

fn gauge<const D: usize>(name: &str, kind: &GaugeKindPlan) -> Gauge<D> {
    let kind = match kind {
        GaugeKindPlan::Pressure(position) => GaugeKind::Pressure { position: shrink(position) },
        GaugeKindPlan::Velocity(position) => GaugeKind::Velocity { position: shrink(position) },
        GaugeKindPlan::WaterLevel(base, top) => {
            GaugeKind::WaterLevel { base: shrink(base), top: shrink(top) }
        }
        GaugeKindPlan::Front(direction) => GaugeKind::Front { direction: shrink(direction) },
        GaugeKindPlan::Displacement(body, position) => {
            GaugeKind::Displacement { body: *body, position: shrink(position) }
        }
        GaugeKindPlan::Stress(body, position) => {
            GaugeKind::Stress { body: *body, position: shrink(position) }
        }
        GaugeKindPlan::CenterOfMass(body) => GaugeKind::CenterOfMass { body: *body },
        GaugeKindPlan::Force(target, about) => {
            GaugeKind::Force { target: *target, about: shrink(about) }
        }
    };
    Gauge { name: name.to_owned(), kind }
}

/// The estimate with counts as seeded.
fn counted<const D: usize>(
    plan: &Plan,
    fluid: Option<&FluidModel<D>>,
    solid: Option<&SolidModel<D>>,
) -> Estimate {
    let mut estimate = plan.estimate.clone();
    if let Some(fluid) = fluid {
        estimate.fluid_particles = fluid.particles.len() as u64;
        estimate.wall_points = fluid.walls.iter().map(|wall| wall.points.len() as u64).sum();
    }
    if let Some(solid) = solid {
        estimate.material_points = solid.bodies.iter().map(|body| body.points.len() as u64).sum();
    }
    estimate.memory = estimate::working_memory(&estimate, plan);
    estimate
}

/// Extent of points of volume `spacing^D`, for notes.
pub(crate) fn extent_text<const D: usize>(points: &[SVector<f64, D>], spacing: f64) -> String {
    let mut points = points.iter();
    let Some(first) = points.next() else { return "nothing".into() };
    let (lower, upper) = points.fold((*first, *first), |(l, u), p| (l.inf(p), u.sup(p)));
    let range = |axis: usize| {
        let name = crate::validate::AXES[axis];
        let faces = [lower[axis] - 0.5 * spacing, upper[axis] + 0.5 * spacing];
        // Round-off around zero is no coordinate.
        let [from, to] = faces.map(|face| if face.abs() < 1e-9 * spacing { 0.0 } else { face });
        format!("{name} {} to {} m", short(from), short(to))
    };
    (0..D).map(range).collect::<Vec<_>>().join(", ")
}
