//! Material points.

use gimpm::{
    BodySeed, Discretisation, Hold, InitialVelocity, Loops, NodeConstraint, Shape, SolidParameters,
    StressUpdate,
};
use nalgebra::SVector;

use crate::CaseError;
use crate::format::ShapeFunctionForm;
use crate::geometry::Point;
use crate::lattice::each;
use crate::model::SolidModel;
use crate::plan::{BodyPlan, BoundaryPlan, Plan, SolidPlan};
use crate::source::Source;
use crate::validate::short;

use super::{extent_text, shrink};

/// Seeds all bodies.
pub(crate) fn seed<const D: usize>(
    solid: &SolidPlan,
    plan: &Plan,
    source: &Source,
    notes: &mut Vec<String>,
) -> Result<SolidModel<D>, CaseError> {
    let mut bodies = Vec::with_capacity(solid.bodies.len());
    for (index, body) in solid.bodies.iter().enumerate() {
        let points = points(body);
        if points.is_empty() {
            let message = format!("no material point fits into body `{}`", body.name);
            let help = "enlarge it or use a smaller `solid.grid_spacing`";
            return Err(source
                .error_at_path(&format!("solid.bodies[{index}].shape"), message)
                .with_help(Some(help.into())));
        }
        let velocity = velocity(body, &points);
        let points: Vec<SVector<f64, D>> = points.iter().map(shrink).collect();
        notes.push(format!(
            "body `{}`: {} material points, {}",
            body.name,
            points.len(),
            extent_text(&points, solid.point_spacing)
        ));
        bodies.push(BodySeed {
            name: body.name.clone(),
            material: body.material.into(),
            points,
            velocity,
            point_spacing: solid.point_spacing,
            discretisation: Discretisation {
                shape: match solid.shape_function {
                    ShapeFunctionForm::Ugimp => Shape::Ugimp,
                    ShapeFunctionForm::Linear => Shape::Linear,
                },
                ..Discretisation::default()
            },
        });
    }
    let constraints = solid
        .bodies
        .iter()
        .enumerate()
        .flat_map(|(index, body)| body.boundaries.iter().map(move |held| constraint(index, held)))
        .collect();
    let cells = std::array::from_fn(|axis| solid.cells[axis]);
    let cell_text: Vec<_> = cells.iter().map(usize::to_string).collect();
    notes.push(format!(
        "solid grid: {} cells of {} m",
        cell_text.join(" x "),
        short(solid.grid.spacing)
    ));
    let parameters = SolidParameters {
        gravity: shrink(&plan.gravity),
        gravity_ramp: 0.0,
        stress_update: StressUpdate::ModifiedLast,
        loops: Loops::Fast,
        courant_number: solid.courant_number,
        grid_spacing: solid.grid.spacing,
        grid_origin: shrink(&solid.grid.origin),
        grid_cells: cells,
        damping: solid.damping,
    };
    Ok(SolidModel { parameters, bodies, constraints })
}

fn points(body: &BodyPlan) -> Vec<Point> {
    let (lower, upper) = body.region.bounds();
    let range = body.lattice.cells(&lower, &upper);
    let is_box = body.region.as_box().is_some();
    each(&range)
        .map(|cell| body.lattice.center(cell))
        .filter(|center| {
            is_box || body.region.signed_distance(&body.lattice.test_point(center)) < 0.0
        })
        .collect()
}

fn velocity<const D: usize>(body: &BodyPlan, points: &[Point]) -> InitialVelocity<D> {
    let Some(mode) = &body.mode else { return InitialVelocity::Uniform(shrink(&body.velocity)) };
    let wave_number = 2.0 * std::f64::consts::PI / mode.wavelength;
    let at = |p: &Point| {
        let phase = wave_number * (p.dot(&mode.axis) - mode.origin);
        shrink(&(body.velocity + mode.amplitude * phase.sin()))
    };
    InitialVelocity::PerPoint(points.iter().map(at).collect())
}

fn constraint<const D: usize>(body: usize, boundary: &BoundaryPlan) -> NodeConstraint<D> {
    NodeConstraint {
        name: boundary.name.clone(),
        body,
        lower: shrink(&boundary.lower),
        upper: shrink(&boundary.upper),
        hold: Hold::Components(std::array::from_fn(|axis| boundary.components[axis].clone())),
    }
}
