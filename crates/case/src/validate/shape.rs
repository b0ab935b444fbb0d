//! Shapes: from the file to regions.

use nalgebra::{Matrix3, Rotation3, Unit};

use crate::format::{OperationForm, RotationForm, ShapeForm};
use crate::geometry::{Point, Polygon, Region};

use super::Checker;

/// Resolves a shape; problems are noted at `path`.
pub(crate) fn region(form: &ShapeForm, path: &str, check: &mut Checker<'_>) -> Option<Region> {
    match form {
        ShapeForm::Tank { .. } => {
            check.problem(
                path,
                "a Tank is the shape of a wall and holds no material".into(),
                "use Box, Cylinder, Sphere, Polygon, Extrusion, Union, Compose or Moved",
            );
            None
        }
        ShapeForm::Box { lower, upper } => {
            let (lower, upper) = check.corners(path, lower, upper)?;
            Some(Region::Box { lower, upper, dimension: check.dimension })
        }
        ShapeForm::Cylinder { base, top, radius } => cylinder(base, top, *radius, path, check),
        ShapeForm::Sphere { center, radius } => {
            let valid = check.positive(&format!("{path}.radius"), *radius, "m");
            let center = check.vector(&format!("{path}.center"), center)?;
            if !valid {
                return None;
            }
            Some(match check.dimension {
                2 => Region::Disc { center, radius: *radius },
                _ => Region::Sphere { center, radius: *radius },
            })
        }
        ShapeForm::Polygon { points } => {
            only_in(2, "Polygon", "use Extrusion in 3D", path, check)?;
            polygon(points, path, check).map(Region::Polygon)
        }
        ShapeForm::Extrusion { points, from, to } => {
            only_in(3, "Extrusion", "use Polygon in 2D", path, check)?;
            let polygon = polygon(points, path, check)?;
            let allowed = "a number above `from`";
            let valid = from.is_finite()
                && check.within(&format!("{path}.to"), *to, "m", to > from, allowed);
            valid.then_some(Region::Extrusion { polygon, from: *from, to: *to })
        }
        ShapeForm::Union(shapes) => {
            let parts = shapes.iter().map(|shape| (true, shape)).collect::<Vec<_>>();
            compose(&parts, path, check)
        }
        ShapeForm::Compose(operations) => {
            let parts: Vec<_> = operations
                .iter()
                .map(|operation| match operation {
                    OperationForm::Add(shape) => (true, shape),
                    OperationForm::Subtract(shape) => (false, shape),
                })
                .collect();
            compose(&parts, path, check)
        }
        ShapeForm::Moved { shape, rotate, translate } => {
            let region = region(shape, &format!("{path}.shape"), check)?;
            let shift = check.vector_or(
                &format!("{path}.translate"),
                translate.as_ref(),
                Point::zeros(),
            )?;
            let (rotation, about) = match rotate {
                Some(rotate) => rotation(rotate, &format!("{path}.rotate"), check)?,
                None => (Matrix3::identity(), Point::zeros()),
            };
            Some(region.moved(rotation, about - rotation * about + shift))
        }
    }
}

/// Cells of a bounding box that may be tested one by one.
const MOST_TESTED: f64 = 4e9;

/// Refuses a shape so spread out that finding its few particles would take hours.
pub(crate) fn searchable(region: &Region, spacing: f64, path: &str, check: &mut Checker<'_>) {
    let (lower, upper) = region.bounds();
    let cells: f64 =
        (0..check.dimension).map(|axis| ((upper[axis] - lower[axis]) / spacing).ceil()).product();
    if region.as_box().is_none() && cells > MOST_TESTED {
        let message = format!("the box around this shape holds {cells:.1e} lattice cells");
        check.problem(path, message, "split the shape, or use a larger spacing");
    }
}

fn cylinder(
    base: &[f64],
    top: &[f64],
    radius: f64,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<Region> {
    only_in(3, "Cylinder", "use Sphere for a disc in 2D", path, check)?;
    let valid = check.positive(&format!("{path}.radius"), radius, "m");
    let base = check.vector(&format!("{path}.base"), base)?;
    let top = check.vector(&format!("{path}.top"), top)?;
    let length = (top - base).norm();
    let Some(axis) = (top - base).try_normalize(1e-300) else {
        let help = "they are the centres of its two ends";
        check.problem(&format!("{path}.top"), "`top` and `base` are the same point".into(), help);
        return None;
    };
    valid.then_some(Region::Cylinder { base, axis, length, radius })
}

fn only_in(
    dimension: usize,
    name: &str,
    help: &str,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<()> {
    if check.dimension == dimension {
        return Some(());
    }
    check.problem(path, format!("{name} is a shape of {dimension}D cases"), help);
    None
}

fn polygon(points: &[Vec<f64>], path: &str, check: &mut Checker<'_>) -> Option<Polygon> {
    let path = format!("{path}.points");
    if points.len() < 3 {
        let message = format!("a polygon with {} corner(s) encloses nothing", points.len());
        check.problem(&path, message, "give at least three");
        return None;
    }
    let mut corners = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        match point.as_slice() {
            &[a, b] if a.is_finite() && b.is_finite() => corners.push([a, b]),
            _ => {
                let message = "a corner is not a pair of finite numbers".into();
                let help = "write [x, y] in a Polygon and [x, z] in an Extrusion";
                check.problem(&format!("{path}[{index}]"), message, help);
                return None;
            }
        }
    }
    let polygon = Polygon::new(corners);
    if let Some((first, second)) = polygon.crossing() {
        let message = format!("the edges that start at corners {first} and {second} cross");
        check.problem(&path, message, "list the corners in order around the outline");
        return None;
    }
    if polygon.area() <= 0.0 {
        check.problem(&path, "the polygon has no area".into(), "move its corners apart");
        return None;
    }
    Some(polygon)
}

fn compose(parts: &[(bool, &ShapeForm)], path: &str, check: &mut Checker<'_>) -> Option<Region> {
    if !parts.first().is_some_and(|(add, _)| *add) {
        let message = "a composition must begin with a shape to add".to_owned();
        check.problem(path, message, "write Add(…) first; later ones may Subtract(…)");
        return None;
    }
    let mut regions = Vec::with_capacity(parts.len());
    for (index, (add, shape)) in parts.iter().enumerate() {
        regions.push((*add, region(shape, &format!("{path}[{index}]"), check)?));
    }
    Some(Region::Compose(regions))
}

fn rotation(
    form: &RotationForm,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<(Matrix3<f64>, Point)> {
    let about = check.vector_or(&format!("{path}.about"), form.about.as_ref(), Point::zeros())?;
    let degrees_path = format!("{path}.degrees");
    if !check.within(&degrees_path, form.degrees, "degrees", true, "a finite number") {
        return None;
    }
    let axis = match (&form.axis, check.dimension) {
        (None, 2) => Point::z(),
        (Some(_), 2) => {
            let message = "a rotation in 2D has no axis to choose".into();
            check.problem(&format!("{path}.axis"), message, "leave out `axis`");
            return None;
        }
        (Some(axis), _) => check.direction(&format!("{path}.axis"), axis)?,
        (None, _) => {
            check.problem(path, "a rotation in 3D needs an axis".into(), "add `axis: [0, 0, 1]`");
            return None;
        }
    };
    let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), form.degrees.to_radians());
    Some((turn.into_inner(), about))
}
