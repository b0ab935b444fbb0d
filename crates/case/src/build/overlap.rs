//! Overlaps of fluid with walls and bodies.

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use sph::{FluidSeed, WallSeed};

use crate::CaseError;
use crate::geometry::Point;
use crate::plan::{FluidPlan, Plan, WallShape};
use crate::source::Source;
use crate::validate::{position_text, short};

/// A particle deeper inside a wall or body than this part of a spacing overlaps it.
const DEPTH: f64 = 0.01;

/// A fluid particle nearer to a wall particle than this part of a spacing overlaps it.
const NEAREST: f64 = 0.45;

/// Refuses fluid particles inside a body.
pub(crate) fn fluid_in_body(
    centers: &[Point],
    block: usize,
    fluid: &FluidPlan,
    plan: &Plan,
    source: &Source,
) -> Result<(), CaseError> {
    for body in plan.solid.iter().flat_map(|solid| &solid.bodies) {
        let inside = |p: &&Point| body.region.signed_distance(p) < -DEPTH * fluid.spacing();
        if let Some(p) = centers.iter().find(inside) {
            return Err(overlap(block, fluid, &format!("body `{}`", body.name), p, source));
        }
    }
    Ok(())
}

/// Refuses fluid particles inside the material of a wall.
pub(crate) fn fluid_in_wall(
    centers: &[Point],
    block: usize,
    fluid: &FluidPlan,
    plan: &Plan,
    source: &Source,
) -> Result<(), CaseError> {
    let depth = DEPTH * fluid.spacing();
    let thickness = fluid.layers as f64 * fluid.spacing();
    for wall in &plan.walls {
        let inside = |p: &&Point| match &wall.shape {
            WallShape::Filled(region) => region.signed_distance(p) < -depth,
            WallShape::Tank { lower, upper, closed } => {
                let beyond = |axis: usize| [lower[axis] - p[axis], p[axis] - upper[axis]];
                let axes = 0..fluid.lattice.dimension;
                let within_reach = axes.clone().all(|axis| {
                    (0..2).all(|side| {
                        let reach = if closed[axis][side] { thickness } else { 0.0 };
                        beyond(axis)[side] < reach
                    })
                });
                within_reach
                    && axes.clone().any(|axis| {
                        (0..2).any(|side| closed[axis][side] && beyond(axis)[side] > depth)
                    })
            }
        };
        if let Some(p) = centers.iter().find(inside) {
            return Err(overlap(block, fluid, &format!("wall `{}`", wall.name), p, source));
        }
    }
    Ok(())
}

fn overlap(block: usize, fluid: &FluidPlan, other: &str, p: &Point, source: &Source) -> CaseError {
    let message = format!(
        "fluid block `{}` overlaps {other}, for example at {}",
        fluid.blocks[block].name,
        position_text(p, fluid.lattice.dimension)
    );
    let help = "move or shrink one of them, or cut the block by Compose([Add(…), Subtract(…)])";
    source
        .error_at_path(&format!("fluid.blocks[{block}].shape"), message)
        .with_help(Some(help.into()))
}

/// Refuses fluid particles that all but coincide with a wall particle: what the
/// shapes do not show, such as a rotated wall's lattice against the fluid's.
pub(crate) fn fluid_near_wall<const D: usize>(
    particles: &[FluidSeed<D>],
    walls: &[WallSeed<D>],
    spacing: f64,
    source: &Source,
) -> Result<(), CaseError> {
    for (index, wall) in walls.iter().enumerate() {
        let points: Vec<[f64; D]> = wall.points.iter().map(|p| (*p).into()).collect();
        let Ok(tree) = ImmutableKdTree::<f64, D>::new_from_slice(&points) else { continue };
        for particle in particles {
            let nearest = tree
                .query(&particle.position.into())
                .nearest_one::<SquaredEuclidean<f64>>()
                .execute();
            if nearest.distance < (NEAREST * spacing).powi(2) {
                let position: Vec<_> = particle.position.iter().map(|c| short(*c)).collect();
                let message = format!(
                    "fluid at [{}] is only {} m from a particle of wall `{}`",
                    position.join(", "),
                    short(nearest.distance.sqrt()),
                    wall.name
                );
                let help = format!("keep {} m, half a spacing, between them", short(0.5 * spacing));
                return Err(source
                    .error_at_path(&format!("walls[{index}].shape"), message)
                    .with_help(Some(help)));
            }
        }
    }
    Ok(())
}

/// Tells of bodies whose middle lies in a wall; touching and clamping are common, so
/// this is no error.
pub(crate) fn body_in_wall(plan: &Plan) -> Vec<String> {
    let mut warnings = Vec::new();
    for body in plan.solid.iter().flat_map(|solid| &solid.bodies) {
        let (lower, upper) = body.region.bounds();
        let middle = 0.5 * (lower + upper);
        for wall in &plan.walls {
            if let WallShape::Filled(region) = &wall.shape
                && region.signed_distance(&middle) < 0.0
            {
                warnings.push(format!(
                    "body `{}` lies in wall `{}`; walls act on the fluid only",
                    body.name, wall.name
                ));
            }
        }
    }
    warnings
}
