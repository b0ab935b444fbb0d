//! Boundaries: which nodes are held, and how.

use motion::Motion;

use crate::format::{BoundaryForm, BoundaryMotionForm, LawForm, LocationForm};
use crate::geometry::Point;
use crate::lattice::Lattice;
use crate::plan::{BoundaryPlan, HoldPlan};

use super::checker::{AXES, FACES, short};
use super::{Checker, walls};

/// How far a constrained face may miss a grid plane, in cells.
pub(crate) const ON_GRID: f64 = 1e-6;

/// Axis and side of the face that a boundary lies on, if it is a known one.
pub(crate) fn face_of(boundary: &BoundaryForm) -> Option<(usize, usize)> {
    match &boundary.location {
        LocationForm::Face(name) => {
            FACES.iter().position(|face| face == name).map(|index| (index / 2, index % 2))
        }
        LocationForm::Region { .. } => None,
    }
}

/// Checks a boundary of a body with these bounds.
pub(crate) fn plan(
    form: &BoundaryForm,
    bounds: (Point, Point),
    grid_spacing: f64,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<BoundaryPlan> {
    let range = match &form.location {
        LocationForm::Face(name) => {
            let face = check.face(&format!("{path}.where"), name);
            face.map(|face| beyond_face(face, bounds, grid_spacing))
        }
        LocationForm::Region { lower, upper } => {
            region(&format!("{path}.where"), lower, upper, check).map(|(lower, upper)| {
                let slack = Point::repeat(ON_GRID * grid_spacing);
                (lower - slack, upper + slack)
            })
        }
    };
    let hold = hold(form, &format!("{path}.motion"), check);
    let (lower, upper) = range?;
    Some(BoundaryPlan { name: form.name.clone(), lower, upper, hold: hold? })
}

fn hold(form: &BoundaryForm, path: &str, check: &mut Checker<'_>) -> Option<HoldPlan> {
    match &form.motion {
        BoundaryMotionForm::Fixed => {
            let components = [true, true, check.dimension == 3];
            Some(HoldPlan::Components(components.map(|held| held.then_some(Motion::Fixed))))
        }
        BoundaryMotionForm::Driven { x, y, z } => driven([x, y, z], &form.name, path, check),
        BoundaryMotionForm::Symmetry => {
            let LocationForm::Face(_) = form.location else {
                let message =
                    format!("boundary `{}` is a plane of symmetry without a face", form.name);
                check.problem(path, message, "use a Face, or Slip(normal: […]) in a Region");
                return None;
            };
            let (across, _) = face_of(form)?;
            let components = std::array::from_fn(|axis| (axis == across).then_some(Motion::Fixed));
            Some(HoldPlan::Components(components))
        }
        BoundaryMotionForm::Slip { normal, law } => {
            along_normal(form, (normal.as_ref(), law.as_ref()), false, path, check)
        }
        BoundaryMotionForm::Support { normal, law } => {
            along_normal(form, (normal.as_ref(), law.as_ref()), true, path, check)
        }
    }
}

fn driven(
    laws: [&Option<LawForm>; 3],
    name: &str,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<HoldPlan> {
    let mut components = [const { None }; 3];
    for (axis, component) in laws.into_iter().enumerate() {
        let Some(component) = component else { continue };
        let path = format!("{path}.{}", AXES[axis]);
        if axis >= check.dimension {
            let message = "a case in 2D has no component z".into();
            check.problem(&path, message, "leave it out");
            return None;
        }
        components[axis] = Some(walls::law(&component.motion(), &path, check)?);
    }
    if components.iter().all(Option::is_none) {
        let message = format!("boundary `{name}` holds no component");
        let help = "name at least one: Driven(x: Fixed), or use Fixed for all";
        check.problem(path, message, help);
        return None;
    }
    Some(HoldPlan::Components(components))
}

/// Motion along a normal; on a face its inward normal, if no other is given.
fn along_normal(
    form: &BoundaryForm,
    (normal, law): (Option<&Vec<f64>>, Option<&LawForm>),
    one_sided: bool,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<HoldPlan> {
    let motion = law.map_or(Motion::Fixed, LawForm::motion);
    let motion = walls::law(&motion, &format!("{path}.law"), check);
    let direction = match (normal, &form.location) {
        (Some(normal), _) => check.direction(&format!("{path}.normal"), normal),
        (None, LocationForm::Face(_)) => face_of(form).map(|(axis, side)| {
            let mut inward = Point::zeros();
            inward[axis] = if side == 0 { 1.0 } else { -1.0 };
            inward
        }),
        (None, LocationForm::Region { .. }) => {
            let message = format!("boundary `{}` in a Region has no normal", form.name);
            check.problem(path, message, "add `normal: […]`, from the support into the body");
            None
        }
    };
    Some(HoldPlan::Normal { direction: direction?, motion: motion?, one_sided })
}

/// A closed box that may be flat.
pub(crate) fn region(
    path: &str,
    lower: &[f64],
    upper: &[f64],
    check: &mut Checker<'_>,
) -> Option<(Point, Point)> {
    let low = check.vector(&format!("{path}.lower"), lower);
    let high = check.vector(&format!("{path}.upper"), upper);
    let (low, high) = (low?, high?);
    if let Some(axis) = (0..check.dimension).find(|&axis| high[axis] < low[axis]) {
        let message = format!("the upper {} is below the lower one", AXES[axis]);
        check.problem(&format!("{path}.upper[{axis}]"), message, "swap them");
        return None;
    }
    Some((low, high))
}

/// All nodes at and beyond a face, sideways to one cell beyond the body.
fn beyond_face(
    (axis, side): (usize, usize),
    (mut lower, mut upper): (Point, Point),
    grid_spacing: f64,
) -> (Point, Point) {
    let slack = 1e-3 * grid_spacing;
    let face = if side == 0 { lower[axis] + slack } else { upper[axis] - slack };
    lower.add_scalar_mut(-grid_spacing - slack);
    upper.add_scalar_mut(grid_spacing + slack);
    if side == 0 {
        (lower[axis], upper[axis]) = (f64::NEG_INFINITY, face);
    } else {
        (lower[axis], upper[axis]) = (face, f64::INFINITY);
    }
    (lower, upper)
}

/// Requires a constrained face on a grid plane.
pub(crate) fn face_on_grid(
    body: &str,
    (axis, side): (usize, usize),
    bounds: (Point, Point),
    grid: &Lattice,
    path: &str,
    check: &mut Checker<'_>,
) {
    let coordinate = if side == 0 { bounds.0[axis] } else { bounds.1[axis] };
    if grid.misfit(axis, coordinate) <= ON_GRID * grid.spacing {
        return;
    }
    let spacing = grid.spacing;
    let cells = (coordinate - grid.origin[axis]) / spacing;
    let planes = [cells.floor(), cells.ceil()].map(|n| short(grid.origin[axis] + n * spacing));
    let whole = [cells.abs().ceil(), cells.abs().floor()];
    let fitting = whole
        .iter()
        .filter(|n| **n >= 1.0)
        .map(|n| short((coordinate - grid.origin[axis]).abs() / n))
        .collect::<Vec<_>>();
    let message = format!(
        "face {} of body `{body}` at {} = {} m is not on a plane of the grid (spacing {} m); the \
         nearest planes are at {} and {} m",
        FACES[2 * axis + side],
        AXES[axis],
        short(coordinate),
        short(spacing),
        planes[0],
        planes[1]
    );
    let help = format!(
        "move the face there, or use a `solid.grid_spacing` of {} m, which fits along {}",
        fitting.join(" or "),
        AXES[axis]
    );
    check.problem(&format!("{path}.where"), message, &help);
}
