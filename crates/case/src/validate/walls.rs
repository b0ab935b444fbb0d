//! Rigid walls.

use motion::Motion;

use crate::format::{ShapeForm, WallForm, WallMotionForm};
use crate::geometry::Point;
use crate::lattice::{Lattice, ON_PLANE};
use crate::plan::{FluidPlan, WallPlan, WallShape};

use super::checker::{AXES, FACES, short};
use super::{Checker, shape};

/// Checks all walls. Sizes are judged by the fluid's kernel, if there is one.
pub(crate) fn plan(
    forms: &[WallForm],
    fluid: Option<&FluidPlan>,
    check: &mut Checker<'_>,
) -> Vec<WallPlan> {
    let walls = forms.iter().enumerate();
    walls.filter_map(|(index, wall)| self::wall(wall, index, fluid, check)).collect()
}

fn wall(
    form: &WallForm,
    index: usize,
    fluid: Option<&FluidPlan>,
    check: &mut Checker<'_>,
) -> Option<WallPlan> {
    let path = format!("walls[{index}]");
    let motion = form.motion.as_ref().map(|motion| self::motion(motion, &path, check));
    let shape_path = format!("{path}.shape");
    let shape = match &form.shape {
        ShapeForm::Tank { lower, upper, open } => {
            tank(&form.name, lower, upper, open, &shape_path, fluid, check)?
        }
        other => {
            let region = shape::region(other, &shape_path, check)?;
            if let Some(fluid) = fluid {
                shape::searchable(&region, fluid.spacing(), &shape_path, check);
                thick_enough("wall", &form.name, &region, &shape_path, fluid, check);
                if let Some(corners) = region.as_box() {
                    let what = format!("wall `{}`", form.name);
                    report_rounding(&what, corners, [[true; 2]; 3], &fluid.lattice, check);
                }
            }
            WallShape::Filled(region)
        }
    };
    let motion = match motion {
        Some(resolved) => Some(resolved?),
        None => None,
    };
    Some(WallPlan { name: form.name.clone(), shape, motion })
}

fn tank(
    name: &str,
    lower: &[f64],
    upper: &[f64],
    open: &[String],
    path: &str,
    fluid: Option<&FluidPlan>,
    check: &mut Checker<'_>,
) -> Option<WallShape> {
    let corners = check.corners(path, lower, upper);
    let mut closed = [[true; 2]; 3];
    if check.dimension == 2 {
        closed[2] = [false; 2];
    }
    for (index, face) in open.iter().enumerate() {
        if let Some((axis, side)) = check.face(&format!("{path}.open[{index}]"), face) {
            closed[axis][side] = false;
        }
    }
    if closed.as_flattened().iter().all(|closed| !closed) {
        let message = format!("all faces of tank `{name}` are open, so it has no wall");
        check.problem(&format!("{path}.open"), message, "leave at least one face closed");
        return None;
    }
    let (lower, upper) = corners?;
    if let Some(fluid) = fluid {
        let what = format!("wall `{name}`");
        report_rounding(&what, (lower, upper), closed, &fluid.lattice, check);
    }
    Some(WallShape::Tank { lower, upper, closed })
}

fn motion(form: &WallMotionForm, path: &str, check: &mut Checker<'_>) -> Option<(Point, Motion)> {
    let direction = check.direction(&format!("{path}.motion.direction"), &form.direction);
    let law = law(&form.law.motion(), &format!("{path}.motion.law"), check);
    Some((direction?, law?))
}

/// Checks a law of motion.
pub(crate) fn law(motion: &Motion, path: &str, check: &mut Checker<'_>) -> Option<Motion> {
    match motion.validate() {
        Ok(()) => Some(motion.clone()),
        Err(error) => {
            let help = "velocities in m/s, durations above 0 s, table times increasing";
            check.problem(path, error.to_string(), help);
            None
        }
    }
}

/// Design §4: a structure is at least three points and one kernel radius thick,
/// so that water on one side does not feel water on the other.
pub(crate) fn thick_enough(
    kind: &str,
    name: &str,
    region: &crate::geometry::Region,
    path: &str,
    fluid: &FluidPlan,
    check: &mut Checker<'_>,
) {
    let needed = fluid.kernel_radius().max(3.0 * fluid.spacing());
    let thickness = region.thickness();
    // Sampled shapes are known to a few per cent.
    let tolerance = if region.as_box().is_some() { 1e-6 } else { 0.05 };
    if thickness >= needed * (1.0 - tolerance) {
        return;
    }
    let ratio = needed / fluid.spacing();
    let message = format!(
        "{kind} `{name}` is {} m thick, less than the reach of the kernel, {} m (2h = {} spacings \
         of {} m)",
        short(thickness),
        short(needed),
        short(ratio),
        short(fluid.spacing())
    );
    let help = format!(
        "make it at least {} m thick, or use `fluid.spacing` of at most {}",
        short(needed),
        short(thickness / ratio)
    );
    check.problem(path, message, &help);
}

/// Tells where faces that miss the lattice will be.
pub(crate) fn report_rounding(
    what: &str,
    (lower, upper): (Point, Point),
    used: [[bool; 2]; 3],
    lattice: &Lattice,
    check: &mut Checker<'_>,
) {
    let mut moved = Vec::new();
    for axis in 0..lattice.dimension {
        for (side, coordinate) in [lower[axis], upper[axis]].into_iter().enumerate() {
            let misfit = lattice.misfit(axis, coordinate);
            if used[axis][side] && misfit > 10.0 * ON_PLANE * lattice.spacing {
                let plane = lattice.plane_coordinate(axis, lattice.plane(axis, coordinate));
                moved.push(format!(
                    "{} from {} = {} to {} m",
                    FACES[2 * axis + side],
                    AXES[axis],
                    short(coordinate),
                    short(plane)
                ));
            }
        }
    }
    if !moved.is_empty() {
        check.warn(format!("{what}: faces move to the particle lattice: {}", moved.join(", ")));
    }
}
