//! Material points.

use gimpm::{
    BodySeed, Hold, InitialVelocity, LoadKind, Loops, Material, NodeConstraint, SolidParameters,
    SurfaceLoad,
};
use nalgebra::SVector;

use crate::CaseError;
use crate::geometry::Point;
use crate::lattice::each;
use crate::model::SolidModel;
use crate::plan::{BodyPlan, BoundaryPlan, HoldPlan, LoadKindPlan, LoadPlan, Plan, SolidPlan};
use crate::source::Source;
use crate::validate::short;

use super::{extent_text, selection, shrink};

/// Seeds all bodies.
pub(crate) fn seed<const D: usize>(
    solid: &SolidPlan,
    plan: &Plan,
    source: &Source,
    notes: &mut Vec<String>,
) -> Result<SolidModel<D>, CaseError> {
    let mut bodies = Vec::with_capacity(solid.bodies.len());
    for (index, body) in solid.bodies.iter().enumerate() {
        let cells = cells(body);
        let points: Vec<Point> = cells.iter().map(|cell| body.lattice.center(*cell)).collect();
        let path = format!("solid.bodies[{index}]");
        if points.is_empty() {
            let message = format!("no material point fits into body `{}`", body.name);
            let help = "enlarge it or use a smaller `solid.grid_spacing`";
            return Err(source
                .error_at_path(&format!("{path}.shape"), message)
                .with_help(Some(help.into())));
        }
        selection::held_nodes(body, &points, solid, &path, source)?;
        let velocity = velocity(body, &points);
        let points: Vec<SVector<f64, D>> = points.iter().map(shrink).collect();
        notes.push(format!(
            "body `{}`: {} material points, {}",
            body.name,
            points.len(),
            extent_text(&points, solid.point_spacing)
        ));
        notes.push(method(body, solid));
        selection::loaded_faces(body, &cells, &path, source, notes)?;
        bodies.push(BodySeed {
            name: body.name.clone(),
            material: body.material.clone(),
            points,
            velocity,
            point_spacing: solid.point_spacing,
            discretisation: body.discretisation,
        });
    }
    let constraints = solid
        .bodies
        .iter()
        .enumerate()
        .flat_map(|(index, body)| body.boundaries.iter().map(move |held| constraint(index, held)))
        .collect();
    let loads = solid
        .bodies
        .iter()
        .enumerate()
        .flat_map(|(index, body)| body.loads.iter().map(move |load| self::load(index, load)))
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
        gravity_ramp: solid.gravity_ramp,
        stress_update: solid.stress_update,
        loops: Loops::Fast,
        contact: solid.contact,
        relaxation: solid.relaxation,
        courant_number: solid.courant_number,
        grid_spacing: solid.grid.spacing,
        grid_origin: shrink(&solid.grid.origin),
        grid_cells: cells,
        damping: solid.damping,
    };
    Ok(SolidModel { parameters, bodies, constraints, loads })
}

/// How a body is computed, and what that allows as time step.
fn method(body: &BodyPlan, solid: &SolidPlan) -> String {
    let chosen = &body.discretisation;
    let transfer = match chosen.transfer {
        gimpm::Transfer::Fmpm { order } => format!("Fmpm({order})"),
        other => format!("{other:?}"),
    };
    let mean = if chosen.mean_dilatation { ", mean dilatation" } else { "" };
    let speed = body.material.p_wave_speed();
    format!(
        "body `{}`: frame {:?}, shape {:?}, transfer {transfer}{mean}, law {}, time step {:.3e} s \
         (P-wave speed {} m/s)",
        body.name,
        chosen.frame,
        chosen.shape,
        body.law,
        solid.courant_number * solid.grid.spacing / speed,
        short(speed)
    )
}

/// Cells of the body's lattice that hold a point.
fn cells(body: &BodyPlan) -> Vec<[i64; 3]> {
    let (lower, upper) = body.region.bounds();
    let range = body.lattice.cells(&lower, &upper);
    let is_box = body.region.as_box().is_some();
    let inside = |cell: &[i64; 3]| {
        let place = body.lattice.test_point(&body.lattice.center(*cell));
        is_box || body.region.signed_distance(&place) < 0.0
    };
    each(&range).filter(inside).collect()
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
        hold: match &boundary.hold {
            HoldPlan::Components(components) => {
                Hold::Components(std::array::from_fn(|axis| components[axis].clone()))
            }
            HoldPlan::Normal { direction, motion, one_sided } => Hold::Normal {
                direction: shrink(direction),
                motion: motion.clone(),
                one_sided: *one_sided,
            },
        },
    }
}

fn load<const D: usize>(body: usize, load: &LoadPlan) -> SurfaceLoad<D> {
    SurfaceLoad {
        name: load.name.clone(),
        body,
        axis: load.axis,
        upper_side: load.upper_side,
        lower: shrink(&load.lower),
        upper: shrink(&load.upper),
        kind: match load.kind {
            LoadKindPlan::Traction(force) => LoadKind::Traction(shrink(&force)),
            LoadKindPlan::Pressure(pressure) => LoadKind::Pressure(pressure),
            LoadKindPlan::Hydrostatic { level, specific_weight } => {
                LoadKind::Hydrostatic { level, specific_weight }
            }
        },
        ramp: load.ramp,
    }
}
