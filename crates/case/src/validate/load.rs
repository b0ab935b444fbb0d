//! Loads on surfaces of bodies.

use crate::format::{LoadForm, LoadKindForm, LoadLocationForm};
use crate::geometry::Point;
use crate::plan::{FluidPlan, LoadKindPlan, LoadPlan};

use super::Checker;
use super::boundary::{ON_GRID, region};
use super::checker::{AXES, short};

/// Half the thickness of the layer in which a bounding face is looked for, in point
/// spacings: whole points put it at most half a spacing from where it was written.
const FACE_LAYER: f64 = 0.6;

/// Density of water where no fluid gives another (kg/m³).
const WATER_DENSITY: f64 = 1000.0;

/// The surroundings of a body that its loads depend on.
pub(crate) struct Surroundings<'a> {
    pub(crate) gravity: Point,
    pub(crate) fluid: Option<&'a FluidPlan>,
    pub(crate) point_spacing: f64,
}

/// Checks a load on a body with these bounds.
pub(crate) fn plan(
    form: &LoadForm,
    bounds: (Point, Point),
    surroundings: &Surroundings<'_>,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<LoadPlan> {
    let place = place(&form.location, bounds, surroundings, &format!("{path}.where"), check);
    let kind = kind(form, bounds, surroundings, &format!("{path}.kind"), check);
    let valid =
        check.within(&format!("{path}.ramp"), form.ramp, "s", form.ramp >= 0.0, "at least 0");
    let ((axis, side), (lower, upper)) = place?;
    valid.then_some(LoadPlan {
        name: form.name.clone(),
        axis,
        upper_side: side == 1,
        lower,
        upper,
        kind: kind?,
        ramp: form.ramp,
    })
}

type Place = ((usize, usize), (Point, Point));

fn place(
    form: &LoadLocationForm,
    bounds: (Point, Point),
    surroundings: &Surroundings<'_>,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<Place> {
    match form {
        LoadLocationForm::Face(name) => {
            let (axis, side) = check.face(path, name)?;
            let plane = if side == 0 { bounds.0[axis] } else { bounds.1[axis] };
            let reach = FACE_LAYER * surroundings.point_spacing;
            let mut lower = Point::repeat(f64::NEG_INFINITY);
            let mut upper = Point::repeat(f64::INFINITY);
            (lower[axis], upper[axis]) = (plane - reach, plane + reach);
            Some(((axis, side), (lower, upper)))
        }
        LoadLocationForm::Region { face, lower, upper } => {
            let face = check.face(&format!("{path}.face"), face);
            let corners = region(path, lower, upper, check);
            let slack = Point::repeat(ON_GRID * surroundings.point_spacing);
            let (lower, upper) = corners?;
            Some((face?, (lower - slack, upper + slack)))
        }
    }
}

fn kind(
    form: &LoadForm,
    bounds: (Point, Point),
    surroundings: &Surroundings<'_>,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<LoadKindPlan> {
    match &form.kind {
        LoadKindForm::Traction(force) => check.traction(path, force).map(LoadKindPlan::Traction),
        LoadKindForm::Pressure(pressure) => check
            .within(path, *pressure, "Pa", true, "a finite number")
            .then_some(LoadKindPlan::Pressure(*pressure)),
        LoadKindForm::Hydrostatic { level, density } => {
            let up = check.dimension - 1;
            let default = surroundings.fluid.map_or(WATER_DENSITY, |fluid| fluid.density);
            let density = density.unwrap_or(default);
            let mut valid = check.positive(&format!("{path}.density"), density, "kg/m³");
            let level_path = format!("{path}.level");
            valid &= check.within(&level_path, *level, "m", true, "a finite number");
            let gravity = surroundings.gravity;
            let sideways = (0..up).any(|axis| gravity[axis] != 0.0);
            if sideways || gravity[up] >= 0.0 {
                let message = format!(
                    "load `{}` is the pressure of still water, but gravity does not point down \
                     along {}",
                    form.name, AXES[up]
                );
                check.problem(path, message, "give `gravity` downwards, or use Pressure");
                return None;
            }
            if *level <= bounds.0[up] {
                let message = format!(
                    "the water level {} = {} m is not above the body's lowest point, {} m",
                    AXES[up],
                    short(*level),
                    short(bounds.0[up])
                );
                check.problem(&level_path, message, "raise the level, or leave out the load");
                return None;
            }
            let specific_weight = -density * gravity[up];
            valid.then_some(LoadKindPlan::Hydrostatic { level: *level, specific_weight })
        }
    }
}

/// Checks all loads of a body.
pub(crate) fn plans(
    forms: &[LoadForm],
    bounds: (Point, Point),
    surroundings: &Surroundings<'_>,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<Vec<LoadPlan>> {
    let plans: Vec<_> = forms
        .iter()
        .enumerate()
        .map(|(index, form)| {
            plan(form, bounds, surroundings, &format!("{path}.loads[{index}]"), check)
        })
        .collect();
    plans.into_iter().collect()
}
