//! Wall particles.

use std::collections::HashSet;

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::SVector;
use sph::{WallMotion, WallSeed};

use crate::CaseError;
use crate::geometry::{Point, Region};
use crate::lattice::{Lattice, each};
use crate::plan::{FluidPlan, Plan, WallPlan, WallShape};
use crate::source::Source;

use super::{extent_text, shrink};

/// Seeds all walls. Where walls meet, the earlier one keeps the place.
pub(crate) fn seed<const D: usize>(
    fluid: &FluidPlan,
    plan: &Plan,
    source: &Source,
    notes: &mut Vec<String>,
) -> Result<Vec<WallSeed<D>>, CaseError> {
    let mut taken: HashSet<[i64; 3]> = HashSet::new();
    let mut turned: Vec<Vec<Point>> = Vec::new();
    let mut on_lattice: Vec<Vec<Point>> = Vec::new();
    for wall in &plan.walls {
        let (mut fixed, mut free) = (Vec::new(), Vec::new());
        match &wall.shape {
            WallShape::Tank { lower, upper, closed } => {
                for cell in tank_cells(lower, upper, closed, fluid) {
                    if taken.insert(cell) {
                        fixed.push(fluid.lattice.center(cell));
                    }
                }
            }
            WallShape::Filled(region @ Region::Moved { .. }) => {
                free = turned_points(region, fluid);
            }
            WallShape::Filled(region) => {
                for cell in shell_cells(region, &fluid.lattice, depth(fluid)) {
                    if taken.insert(cell) {
                        fixed.push(fluid.lattice.center(cell));
                    }
                }
            }
        }
        on_lattice.push(fixed);
        turned.push(free);
    }
    let fixed: Vec<[f64; 3]> = on_lattice.iter().flatten().map(|p| [p.x, p.y, p.z]).collect();
    let mut seeds = Vec::with_capacity(plan.walls.len());
    for (index, wall) in plan.walls.iter().enumerate() {
        let mut points = std::mem::take(&mut on_lattice[index]);
        points.extend(apart(&turned[index], &fixed, 0.5 * fluid.spacing()));
        if points.is_empty() {
            let message = format!("no particle of wall `{}` is left", wall.name);
            let help = "it is too small for `fluid.spacing`, or earlier walls cover it";
            return Err(source
                .error_at_path(&format!("walls[{index}].shape"), message)
                .with_help(Some(help.into())));
        }
        let points: Vec<SVector<f64, D>> = points.iter().map(shrink).collect();
        notes.push(format!(
            "wall `{}`: {} particles, {}",
            wall.name,
            points.len(),
            extent_text(&points, fluid.spacing())
        ));
        seeds.push(WallSeed { name: wall.name.clone(), points, motion: motion(wall) });
    }
    Ok(seeds)
}

fn motion<const D: usize>(wall: &WallPlan) -> Option<WallMotion<D>> {
    let (direction, motion) = wall.motion.as_ref()?;
    Some(WallMotion { direction: shrink(direction), motion: motion.clone() })
}

/// Depth of the wall that the kernel sees, with one spacing to spare.
fn depth(fluid: &FluidPlan) -> f64 {
    (fluid.layers as f64 + 1.0) * fluid.spacing()
}

/// Cells outside the box on closed sides, corners included.
fn tank_cells(
    lower: &Point,
    upper: &Point,
    closed: &[[bool; 2]; 3],
    fluid: &FluidPlan,
) -> Vec<[i64; 3]> {
    let inside = fluid.lattice.cells(lower, upper);
    let mut outside = inside.clone();
    for axis in 0..fluid.lattice.dimension {
        let layers = closed[axis].map(|closed| if closed { fluid.layers } else { 0 });
        outside[axis].start = outside[axis].start.saturating_sub(layers[0]);
        outside[axis].end = outside[axis].end.saturating_add(layers[1]);
    }
    let mut cells = Vec::new();
    for k in outside[2].clone() {
        for j in outside[1].clone() {
            let row_meets_inside = inside[1].contains(&j) && inside[2].contains(&k);
            let mut push = |range: std::ops::Range<i64>| cells.extend(range.map(|i| [i, j, k]));
            if row_meets_inside && !inside[0].is_empty() {
                push(outside[0].start..inside[0].start);
                push(inside[0].end..outside[0].end);
            } else {
                push(outside[0].clone());
            }
        }
    }
    cells
}

/// Cells of a shape not deeper below its surface than `depth`.
fn shell_cells(region: &Region, lattice: &Lattice, depth: f64) -> Vec<[i64; 3]> {
    let (lower, upper) = region.bounds();
    each(&lattice.cells(&lower, &upper))
        .filter(|cell| {
            let distance = region.signed_distance(&lattice.test_point(&lattice.center(*cell)));
            distance < 0.0 && distance > -depth
        })
        .collect()
}

/// Points of a rotated shape, on a lattice that turns with it, so that its faces stay flat.
fn turned_points(region: &Region, fluid: &FluidPlan) -> Vec<Point> {
    let Region::Moved { region: inner, rotation, shift } = region else { return Vec::new() };
    let lattice = Lattice { origin: inner.bounds().0, ..fluid.lattice.clone() };
    shell_cells(inner, &lattice, depth(fluid))
        .into_iter()
        .map(|cell| rotation * lattice.center(cell) + shift)
        .collect()
}

/// The points farther than `distance` from all of `others`.
fn apart(points: &[Point], others: &[[f64; 3]], distance: f64) -> Vec<Point> {
    if points.is_empty() || others.is_empty() {
        return points.to_vec();
    }
    let Ok(tree) = ImmutableKdTree::<f64, 3>::new_from_slice(others) else {
        return points.to_vec();
    };
    let far = |p: &&Point| {
        let nearest = tree.query(&[p.x, p.y, p.z]).nearest_one::<SquaredEuclidean<f64>>().execute();
        nearest.distance > distance * distance
    };
    points.iter().filter(far).copied().collect()
}
