//! The solid: grid, bodies and boundaries.

use gimpm::Frame;

use crate::format::{BodyForm, SolidForm, VelocityModeForm};
use crate::geometry::{Point, Region, union};
use crate::lattice::Lattice;
use crate::plan::{BodyPlan, FluidPlan, ModePlan, SolidPlan};

use super::boundary::{ON_GRID, face_of, face_on_grid};
use super::checker::{AXES, FACES, short};
use super::load::Surroundings;
use super::{Checker, boundary, discretisation, load, material, shape, walls};

/// Checks the solid and resolves it; `None` when something it needs is wrong.
pub(crate) fn plan(
    form: &SolidForm,
    fluid: Option<&FluidPlan>,
    gravity: &Point,
    end_time: f64,
    check: &mut Checker<'_>,
) -> Option<SolidPlan> {
    let contact = discretisation::contact(form, check);
    let relaxation = discretisation::relaxation(form, fluid.is_some(), check);
    if !parameters(form, check) {
        return None;
    }
    if form.bodies.is_empty() {
        let help = "add a body, or leave out `solid`";
        check.problem("solid.bodies", "the solid has no body".into(), help);
        return None;
    }
    let point_spacing = form.grid_spacing / f64::from(form.points_per_cell);
    let shapes: Vec<Option<Region>> = form
        .bodies
        .iter()
        .enumerate()
        .map(|(index, body)| {
            shape::region(&body.shape, &format!("solid.bodies[{index}].shape"), check)
        })
        .collect();
    let bounds: Vec<(Point, Point)> =
        shapes.iter().map(|region| region.as_ref().map(Region::bounds)).collect::<Option<_>>()?;
    let mut grid = Lattice {
        origin: anchor(form, &bounds, check.dimension),
        spacing: form.grid_spacing,
        dimension: check.dimension,
    };
    let surroundings = Surroundings { gravity: *gravity, fluid, point_spacing };
    let bodies: Vec<BodyPlan> = form
        .bodies
        .iter()
        .zip(shapes.into_iter().flatten())
        .enumerate()
        .filter_map(|(index, (body, region))| {
            let path = format!("solid.bodies[{index}]");
            shape::searchable(&region, point_spacing, &format!("{path}.shape"), check);
            if let Some(fluid) = fluid {
                let shape_path = format!("{path}.shape");
                walls::thick_enough("body", &body.name, &region, &shape_path, fluid, check);
            }
            self::body((body, form), region, &grid, &surroundings, &path, check)
        })
        .collect();
    if bodies.len() < form.bodies.len() {
        return None;
    }
    if let Some(fluid) = fluid {
        fine_enough(point_spacing, form, fluid, check);
    }
    if relaxation.is_some() {
        discretisation::report_restless(&bodies, end_time, check);
    }
    let cells = cover(&mut grid, form, &bounds);
    Some(SolidPlan {
        grid,
        cells,
        point_spacing,
        stress_update: discretisation::stress_update(form.stress_update),
        contact,
        relaxation,
        courant_number: form.courant_number,
        damping: damping(form),
        gravity_ramp: form.gravity_ramp,
        bodies,
    })
}

/// Damping of a relaxed solid, as usual in dynamic relaxation.
const RELAXATION_DAMPING: f64 = 0.8;

fn damping(form: &SolidForm) -> f64 {
    form.damping.unwrap_or(if form.relaxation.is_some() { RELAXATION_DAMPING } else { 0.0 })
}

fn parameters(form: &SolidForm, check: &mut Checker<'_>) -> bool {
    let mut valid = check.positive("solid.grid_spacing", form.grid_spacing, "m");
    let (points, courant, damping) = (form.points_per_cell, form.courant_number, damping(form));
    let inside = (1..=4).contains(&points);
    let path = "solid.points_per_cell";
    valid &= check.within(path, f64::from(points), "", inside, "1, 2, 3 or 4");
    let inside = courant > 0.0 && courant <= 1.0;
    valid &= check.within("solid.courant_number", courant, "", inside, "above 0 and at most 1");
    let inside = (0.0..1.0).contains(&damping);
    valid &= check.within("solid.damping", damping, "", inside, "at least 0 and below 1");
    if form.relaxation.is_some() {
        let allowed = "above 0 where `relaxation` takes out the motion with it; 0.8 is usual";
        valid &= check.within("solid.damping", damping, "", damping > 0.0, allowed);
    }
    let ramp = form.gravity_ramp;
    valid &= check.within("solid.gravity_ramp", ramp, "s", ramp >= 0.0, "at least 0");
    if let Some(margin) = form.grid_margin {
        valid &= check.within("solid.grid_margin", margin, "m", margin >= 0.0, "at least 0");
    }
    valid
}

/// Design §4: material points are wall particles, so they may not be sparser than the water's.
fn fine_enough(point_spacing: f64, form: &SolidForm, fluid: &FluidPlan, check: &mut Checker<'_>) {
    if point_spacing <= fluid.spacing() * (1.0 + 1e-9) {
        return;
    }
    let message = format!(
        "material points are {} m apart ({} m / {}), farther than the fluid particles ({} m), so \
         water would leak through",
        short(point_spacing),
        short(form.grid_spacing),
        form.points_per_cell,
        short(fluid.spacing())
    );
    let help = format!(
        "use `solid.grid_spacing` of at most {}",
        short(fluid.spacing() * f64::from(form.points_per_cell))
    );
    check.problem("solid.grid_spacing", message, &help);
}

/// A point of the grid: per axis the first constrained face, else the first body's lower face.
fn anchor(form: &SolidForm, bounds: &[(Point, Point)], dimension: usize) -> Point {
    let mut anchor = bounds.first().map_or(Point::zeros(), |bounds| bounds.0);
    for axis in 0..dimension {
        let faces = form.bodies.iter().zip(bounds).flat_map(|(body, bounds)| {
            body.boundaries.iter().filter_map(move |boundary| {
                let (face_axis, side) = face_of(boundary)?;
                (face_axis == axis).then_some(if side == 0 { bounds.0 } else { bounds.1 })
            })
        });
        if let Some(face) = faces.into_iter().next() {
            anchor[axis] = face[axis];
        }
    }
    anchor
}

fn body(
    (form, solid): (&BodyForm, &SolidForm),
    region: Region,
    grid: &Lattice,
    surroundings: &Surroundings<'_>,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<BodyPlan> {
    let bounds = region.bounds();
    let material = material::plan(&form.material, path, check);
    let discretisation = discretisation::plan(form, solid, path, check);
    let velocity =
        check.vector_or(&format!("{path}.velocity"), form.velocity.as_ref(), Point::zeros());
    let mode = match &form.velocity_mode {
        Some(mode) => mode_plan(mode, &format!("{path}.velocity_mode"), check).map(Some),
        None => Some(None),
    };
    // A lattice plane lies on a constrained face, or else on the body's lower face.
    let mut origin = bounds.0;
    let mut boundaries = Vec::with_capacity(form.boundaries.len());
    let mut constrained = [false; 3];
    for (index, boundary) in form.boundaries.iter().enumerate() {
        let path = format!("{path}.boundaries[{index}]");
        if let Some((axis, side)) = face_of(boundary).filter(|(axis, _)| *axis < check.dimension) {
            origin[axis] = if side == 0 { bounds.0[axis] } else { bounds.1[axis] };
            constrained[axis] = true;
            face_on_grid(&form.name, (axis, side), bounds, grid, &path, check);
        }
        if let Some(boundary) = boundary::plan(boundary, bounds, grid.spacing, &path, check) {
            boundaries.push(boundary);
        }
    }
    let loads = load::plans(&form.loads, bounds, surroundings, path, check);
    let spacing = surroundings.point_spacing;
    let mut lattice = Lattice { origin, spacing, dimension: check.dimension };
    if discretisation::frame(form, solid) == Frame::Total {
        let free = constrained.map(|constrained| !constrained);
        whole_points(form, &region, free, &mut lattice, grid, path, check);
    }
    report_size(&form.name, &region, &lattice, check);
    (boundaries.len() == form.boundaries.len()).then_some(())?;
    Some(BodyPlan {
        name: form.name.clone(),
        region,
        material: material?,
        law: form.material.law(),
        discretisation: discretisation?,
        velocity: velocity?,
        mode: mode?,
        lattice,
        boundaries,
        loads: loads?,
    })
}

/// In the total frame cells must hold whole points: on the axes without a constrained
/// face, which lies on the grid anyway, the lattice of the points must be one of the grid.
/// A shape without flat faces is filled from the nearest plane; a box must lie on one.
fn whole_points(
    form: &BodyForm,
    region: &Region,
    free: [bool; 3],
    lattice: &mut Lattice,
    grid: &Lattice,
    path: &str,
    check: &mut Checker<'_>,
) {
    let points = Lattice { spacing: lattice.spacing, ..grid.clone() };
    for axis in (0..lattice.dimension).filter(|&axis| free[axis]) {
        let face = lattice.origin[axis];
        let steps = (face - grid.origin[axis]) / points.spacing;
        let plane = |n: f64| grid.origin[axis] + n * points.spacing;
        if region.as_box().is_none() || points.misfit(axis, face) <= ON_GRID * grid.spacing {
            lattice.origin[axis] = plane(steps.round());
            continue;
        }
        let message = format!(
            "face {} of body `{}` at {} = {} m cuts the material points that fill the grid (every \
             {} m, a plane at {} m); a body in the total frame needs whole ones in each cell",
            FACES[2 * axis],
            form.name,
            AXES[axis],
            short(face),
            short(points.spacing),
            short(grid.origin[axis])
        );
        let help = format!(
            "move it to {} or {} m, or give the body `frame: Updated`",
            short(plane(steps.floor())),
            short(plane(steps.ceil()))
        );
        check.problem(&format!("{path}.shape"), message, &help);
    }
}

fn mode_plan(form: &VelocityModeForm, path: &str, check: &mut Checker<'_>) -> Option<ModePlan> {
    let VelocityModeForm::Sine { direction, axis, origin, amplitude, wavelength } = form;
    let direction = check.direction(&format!("{path}.direction"), direction);
    let axis = check.direction(&format!("{path}.axis"), axis);
    let finite = "a finite number";
    let mut valid = check.within(&format!("{path}.origin"), *origin, "m", true, finite);
    valid &= check.within(&format!("{path}.amplitude"), *amplitude, "m/s", true, finite);
    valid &= check.positive(&format!("{path}.wavelength"), *wavelength, "m");
    valid.then_some(ModePlan {
        amplitude: direction? * *amplitude,
        axis: axis?,
        origin: *origin,
        wavelength: *wavelength,
    })
}

/// Tells the size that whole material points give a box.
fn report_size(name: &str, region: &Region, lattice: &Lattice, check: &mut Checker<'_>) {
    let Some((lower, upper)) = region.as_box() else { return };
    for axis in 0..lattice.dimension {
        let size = upper[axis] - lower[axis];
        let range = &lattice.cells(&lower, &upper)[axis];
        let points = range.end.saturating_sub(range.start) as f64;
        let seeded = points * lattice.spacing;
        if (seeded - size).abs() > 1e-6 * size {
            check.warn(format!(
                "body `{name}` is {} m long along {}, but {} material points make {} m; spacings \
                 {} or {} m fit (`solid.grid_spacing` over `points_per_cell`)",
                short(size),
                AXES[axis],
                points,
                short(seeded),
                short(size / (size / lattice.spacing).ceil().max(1.0)),
                short(size / (size / lattice.spacing).floor().max(1.0)),
            ));
        }
    }
}

/// Extends the grid around all bodies and returns its cells.
fn cover(grid: &mut Lattice, form: &SolidForm, bounds: &[(Point, Point)]) -> [usize; 3] {
    let spacing = grid.spacing;
    let (lower, upper) = union(bounds.iter().copied());
    let largest = (upper - lower).max();
    let margin = form.grid_margin.unwrap_or((3.0 * spacing).max(0.25 * largest));
    let anchor = grid.origin;
    std::array::from_fn(|axis| {
        if axis >= grid.dimension {
            return 1;
        }
        let first = ((lower[axis] - margin - anchor[axis]) / spacing + ON_GRID).floor();
        let last = ((upper[axis] + margin - anchor[axis]) / spacing - ON_GRID).ceil();
        grid.origin[axis] = anchor[axis] + first * spacing;
        (last - first).max(1.0) as usize
    })
}
