//! Boundaries and loads must find something of their body.

use std::collections::HashSet;

use gimpm::{Frame, Shape};

use crate::CaseError;
use crate::geometry::Point;
use crate::plan::{BodyPlan, BoundaryPlan, HoldPlan, LoadPlan, SolidPlan};
use crate::source::Source;
use crate::validate::{AXES, FACES, short};

/// Requires that every boundary holds a node that carries part of its body.
///
/// A one-sided support in the updated frame may wait for the body to come.
pub(crate) fn held_nodes(
    body: &BodyPlan,
    points: &[Point],
    solid: &SolidPlan,
    path: &str,
    source: &Source,
) -> Result<(), CaseError> {
    for (index, boundary) in body.boundaries.iter().enumerate() {
        let waits = matches!(boundary.hold, HoldPlan::Normal { one_sided: true, .. })
            && body.discretisation.frame == Frame::Updated;
        if waits || points.iter().any(|p| holds_part_of(boundary, body, p, solid)) {
            continue;
        }
        let message = format!(
            "boundary `{}` holds nothing: its box contains no grid node that carries body `{}`",
            boundary.name, body.name
        );
        let (lower, upper) = body.region.bounds();
        let (grid, spacing) = (&solid.grid, solid.grid.spacing);
        let planes: Vec<String> = (0..grid.dimension)
            .map(|axis| {
                let cells = |x: f64| (x - grid.origin[axis]) / spacing;
                let first = grid.origin[axis] + (cells(lower[axis]) - 1e-6).ceil() * spacing;
                let last = grid.origin[axis] + (cells(upper[axis]) + 1e-6).floor() * spacing;
                format!("{} {} to {}", AXES[axis], short(first), short(last))
            })
            .collect();
        let help = format!(
            "make the box reach a node of the body; they are {} m apart: {} m",
            short(spacing),
            planes.join(", ")
        );
        return Err(source
            .error_at_path(&format!("{path}.boundaries[{index}].where"), message)
            .with_help(Some(help)));
    }
    Ok(())
}

/// Whether a node with a weight at this point is in the boundary's box.
fn holds_part_of(
    boundary: &BoundaryPlan,
    body: &BodyPlan,
    point: &Point,
    solid: &SolidPlan,
) -> bool {
    let spacing = solid.grid.spacing;
    let linear =
        body.discretisation.frame == Frame::Total || body.discretisation.shape == Shape::Linear;
    let reach = spacing + if linear { 0.0 } else { 0.5 * solid.point_spacing };
    (0..solid.grid.dimension).all(|axis| {
        let lower = boundary.lower[axis].max(point[axis] - reach * (1.0 - 1e-9));
        let upper = boundary.upper[axis].min(point[axis] + reach * (1.0 - 1e-9));
        let cells = |x: f64| (x - solid.grid.origin[axis]) / spacing;
        cells(lower).ceil() <= cells(upper).floor()
    })
}

/// Loaded faces of material points of each load, and a note on each.
pub(crate) fn loaded_faces(
    body: &BodyPlan,
    cells: &[[i64; 3]],
    path: &str,
    source: &Source,
    notes: &mut Vec<String>,
) -> Result<(), CaseError> {
    if body.loads.is_empty() {
        return Ok(());
    }
    let filled: HashSet<[i64; 3]> = cells.iter().copied().collect();
    for (index, load) in body.loads.iter().enumerate() {
        let count = cells.iter().filter(|cell| is_loaded(load, body, cell, &filled)).count();
        let face = FACES[2 * load.axis + usize::from(load.upper_side)];
        if count == 0 {
            let message = format!(
                "load `{}` acts on nothing: no surface of body `{}` that looks towards {face} has \
                 its middle in the box",
                load.name, body.name
            );
            let (lower, upper) = body.region.bounds();
            let dimension = body.lattice.dimension;
            let help = format!(
                "the body reaches from {} to {} m",
                crate::validate::position_text(&lower, dimension),
                crate::validate::position_text(&upper, dimension)
            );
            return Err(source
                .error_at_path(&format!("{path}.loads[{index}].where"), message)
                .with_help(Some(help)));
        }
        let area = count as f64 * body.lattice.spacing.powi(body.lattice.dimension as i32 - 1);
        let unit = if body.lattice.dimension == 2 { "m" } else { "m²" };
        notes.push(format!(
            "load `{}`: {count} point faces towards {face}, {} {unit} of body `{}`",
            load.name,
            short(area),
            body.name
        ));
    }
    Ok(())
}

/// Whether a point's face towards the load has no neighbour and its middle in the box.
fn is_loaded(
    load: &LoadPlan,
    body: &BodyPlan,
    cell: &[i64; 3],
    filled: &HashSet<[i64; 3]>,
) -> bool {
    let step = if load.upper_side { 1 } else { -1 };
    let mut neighbour = *cell;
    neighbour[load.axis] += step;
    let mut middle = body.lattice.center(*cell);
    middle[load.axis] += 0.5 * step as f64 * body.lattice.spacing;
    let inside = (0..body.lattice.dimension)
        .all(|axis| load.lower[axis] <= middle[axis] && middle[axis] <= load.upper[axis]);
    inside && !filled.contains(&neighbour)
}
