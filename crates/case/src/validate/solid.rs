//! The solid: grid, bodies and boundaries.

use gimpm::LinearElastic;
use motion::Motion;

use crate::format::{
    BodyForm, BoundaryForm, BoundaryMotionForm, LocationForm, MaterialForm, SolidForm,
    VelocityModeForm,
};
use crate::geometry::{Point, Region, union};
use crate::lattice::Lattice;
use crate::plan::{BodyPlan, BoundaryPlan, FluidPlan, ModePlan, SolidPlan};

use super::checker::{AXES, FACES, short};
use super::{Checker, shape, walls};

/// How far a constrained face may miss a grid plane, in cells.
const ON_GRID: f64 = 1e-6;

/// Checks the solid and resolves it; `None` when something it needs is wrong.
pub(crate) fn plan(
    form: &SolidForm,
    fluid: Option<&FluidPlan>,
    check: &mut Checker<'_>,
) -> Option<SolidPlan> {
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
            self::body(body, region, &grid, point_spacing, &path, check)
        })
        .collect();
    if bodies.len() < form.bodies.len() {
        return None;
    }
    if let Some(fluid) = fluid {
        fine_enough(point_spacing, form, fluid, check);
    }
    let cells = cover(&mut grid, form, &bounds);
    Some(SolidPlan {
        grid,
        cells,
        point_spacing,
        shape_function: form.shape_function,
        courant_number: form.courant_number,
        damping: form.damping,
        bodies,
    })
}

fn parameters(form: &SolidForm, check: &mut Checker<'_>) -> bool {
    let mut valid = check.positive("solid.grid_spacing", form.grid_spacing, "m");
    let (points, courant, damping) = (form.points_per_cell, form.courant_number, form.damping);
    let inside = (1..=4).contains(&points);
    let path = "solid.points_per_cell";
    valid &= check.within(path, f64::from(points), "", inside, "1, 2, 3 or 4");
    let inside = courant > 0.0 && courant <= 1.0;
    valid &= check.within("solid.courant_number", courant, "", inside, "above 0 and at most 1");
    let inside = (0.0..1.0).contains(&damping);
    valid &= check.within("solid.damping", damping, "", inside, "at least 0 and below 1");
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

fn face_of(boundary: &BoundaryForm) -> Option<(usize, usize)> {
    match &boundary.location {
        LocationForm::Face(name) => {
            FACES.iter().position(|face| face == name).map(|index| (index / 2, index % 2))
        }
        LocationForm::Region { .. } => None,
    }
}

fn body(
    form: &BodyForm,
    region: Region,
    grid: &Lattice,
    point_spacing: f64,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<BodyPlan> {
    let bounds = region.bounds();
    let material = material(&form.material, path, check);
    let velocity =
        check.vector_or(&format!("{path}.velocity"), form.velocity.as_ref(), Point::zeros());
    let mode = match &form.velocity_mode {
        Some(mode) => mode_plan(mode, &format!("{path}.velocity_mode"), check).map(Some),
        None => Some(None),
    };
    // A lattice plane lies on a constrained face, or else on the body's lower face.
    let mut origin = bounds.0;
    let mut boundaries = Vec::with_capacity(form.boundaries.len());
    for (index, boundary) in form.boundaries.iter().enumerate() {
        let path = format!("{path}.boundaries[{index}]");
        if let Some((axis, side)) = face_of(boundary).filter(|(axis, _)| *axis < check.dimension) {
            origin[axis] = if side == 0 { bounds.0[axis] } else { bounds.1[axis] };
            face_on_grid(&form.name, (axis, side), bounds, grid, &path, check);
        }
        if let Some(boundary) = self::boundary(boundary, bounds, grid.spacing, &path, check) {
            boundaries.push(boundary);
        }
    }
    let lattice = Lattice { origin, spacing: point_spacing, dimension: check.dimension };
    report_size(&form.name, &region, &lattice, check);
    (boundaries.len() == form.boundaries.len()).then_some(())?;
    Some(BodyPlan {
        name: form.name.clone(),
        region,
        material: material?,
        velocity: velocity?,
        mode: mode?,
        lattice,
        boundaries,
    })
}

fn material(form: &MaterialForm, path: &str, check: &mut Checker<'_>) -> Option<LinearElastic> {
    let MaterialForm::LinearElastic { density, young_modulus, poisson_ratio } = *form;
    let path = format!("{path}.material");
    let mut valid = check.positive(&format!("{path}.density"), density, "kg/m³");
    valid &= check.positive(&format!("{path}.young_modulus"), young_modulus, "Pa");
    let inside = poisson_ratio > -1.0 && poisson_ratio < 0.5;
    let allowed = "above -1 and below 0.5 (at 0.5 the material is incompressible)";
    let field = format!("{path}.poisson_ratio");
    valid &= check.within(&field, poisson_ratio, "", inside, allowed);
    valid.then_some(LinearElastic { density, young_modulus, poisson_ratio })
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

/// Requires a constrained face on a grid plane.
fn face_on_grid(
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

fn boundary(
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
    let components = match &form.motion {
        BoundaryMotionForm::Fixed => {
            [true, true, check.dimension == 3].map(|held| held.then_some(Motion::Fixed))
        }
        BoundaryMotionForm::Driven { x, y, z } => {
            let mut components = [const { None }; 3];
            for (axis, component) in [x, y, z].into_iter().enumerate() {
                let Some(component) = component else { continue };
                let path = format!("{path}.motion.{}", AXES[axis]);
                if axis >= check.dimension {
                    let message = "a case in 2D has no component z".into();
                    check.problem(&path, message, "leave it out");
                    return None;
                }
                components[axis] = Some(walls::law(&component.motion(), &path, check)?);
            }
            components
        }
    };
    if components.iter().all(Option::is_none) {
        let message = format!("boundary `{}` holds no component", form.name);
        let help = "name at least one: Driven(x: Fixed), or use Fixed for all";
        check.problem(&format!("{path}.motion"), message, help);
        return None;
    }
    let (lower, upper) = range?;
    Some(BoundaryPlan { name: form.name.clone(), lower, upper, components })
}

/// A closed box that may be flat.
fn region(
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
