//! Fluid particles on the lattice.

use std::collections::HashMap;

use sph::{Dissipation, FluidParameters, FluidSeed};

use crate::CaseError;
use crate::format::{DissipationForm, PressureForm};
use crate::geometry::Point;
use crate::lattice::each;
use crate::model::FluidModel;
use crate::plan::{BlockPlan, FluidPlan, Plan};
use crate::source::Source;
use crate::validate::{position_text, short};

use super::{extent_text, overlap, shrink, walls};

/// Seeds water and walls and refuses overlaps.
pub(crate) fn seed<const D: usize>(
    fluid: &FluidPlan,
    plan: &Plan,
    source: &Source,
    notes: &mut Vec<String>,
) -> Result<FluidModel<D>, CaseError> {
    let mut particles = Vec::new();
    let mut owner: HashMap<[i64; 3], usize> = HashMap::new();
    for (index, block) in fluid.blocks.iter().enumerate() {
        let path = format!("fluid.blocks[{index}].shape");
        let cells = cells(block, fluid);
        if cells.is_empty() {
            let message = format!("no particle fits into fluid block `{}`", block.name);
            let help = "enlarge the block or use a smaller `fluid.spacing`";
            return Err(source.error_at_path(&path, message).with_help(Some(help.into())));
        }
        for cell in &cells {
            if let Some(other) = owner.insert(*cell, index) {
                let message = format!(
                    "fluid blocks `{}` and `{}` overlap, for example at {}",
                    fluid.blocks[other].name,
                    block.name,
                    position_text(&fluid.lattice.center(*cell), D)
                );
                let help = "shrink one of them, or take it out by Compose([Add(…), Subtract(…)])";
                return Err(source.error_at_path(&path, message).with_help(Some(help.into())));
            }
        }
        let centers: Vec<Point> = cells.iter().map(|cell| fluid.lattice.center(*cell)).collect();
        overlap::fluid_in_body(&centers, index, fluid, plan, source)?;
        overlap::fluid_in_wall(&centers, index, fluid, plan, source)?;
        let positions: Vec<_> = centers.iter().map(shrink::<D>).collect();
        notes.push(format!(
            "fluid block `{}`: {} particles, {}",
            block.name,
            positions.len(),
            extent_text(&positions, fluid.spacing())
        ));
        particles.extend(states::<D>(block, &centers, fluid, &plan.gravity));
    }
    let walls = walls::seed(fluid, plan, source, notes)?;
    overlap::fluid_near_wall(&particles, &walls, fluid.spacing(), source)?;
    notes.push(format!(
        "fluid: spacing {} m, smoothing length {} m, sound speed {} m/s",
        short(fluid.spacing()),
        short(fluid.smoothing_length),
        short(fluid.sound_speed)
    ));
    Ok(FluidModel { parameters: parameters(fluid, plan), particles, walls })
}

fn parameters<const D: usize>(fluid: &FluidPlan, plan: &Plan) -> FluidParameters<D> {
    FluidParameters {
        spacing: fluid.spacing(),
        smoothing_length: fluid.smoothing_length,
        reference_density: fluid.density,
        sound_speed: fluid.sound_speed,
        gravity: shrink(&plan.gravity),
        density_diffusion: fluid.density_diffusion,
        dissipation: match fluid.dissipation {
            DissipationForm::None => Dissipation::None,
            DissipationForm::Artificial { alpha } => Dissipation::Artificial { alpha },
            DissipationForm::Riemann { limiter } => Dissipation::Riemann { limiter },
        },
        courant_number: fluid.courant_number,
        domain: (shrink(&plan.domain.0), shrink(&plan.domain.1)),
    }
}

/// Lattice cells of a block, x fastest.
fn cells(block: &BlockPlan, fluid: &FluidPlan) -> Vec<[i64; 3]> {
    let lattice = &fluid.lattice;
    let (lower, upper) = block.region.bounds();
    let range = lattice.cells(&lower, &upper);
    let is_box = block.region.as_box().is_some();
    each(&range)
        .filter(|cell| {
            let test_point = lattice.test_point(&lattice.center(*cell));
            is_box || block.region.signed_distance(&test_point) < 0.0
        })
        .collect()
}

/// Velocity and density of the particles of one block: at rest under gravity the
/// linear equation of state p = c0² (ρ-ρ0) holds ρ0 g times the depth.
fn states<const D: usize>(
    block: &BlockPlan,
    centers: &[Point],
    fluid: &FluidPlan,
    gravity: &Point,
) -> Vec<FluidSeed<D>> {
    let sound_speed_squared = fluid.sound_speed * fluid.sound_speed;
    let surface = centers.iter().map(|p| -p.dot(gravity)).fold(f64::NEG_INFINITY, f64::max)
        + 0.5 * fluid.spacing() * gravity.norm();
    centers
        .iter()
        .map(|p| {
            let pressure = match block.pressure {
                PressureForm::Hydrostatic => fluid.density * (surface + p.dot(gravity)),
                PressureForm::Uniform(pressure) => pressure,
            };
            FluidSeed {
                position: shrink(p),
                velocity: shrink(&block.velocity),
                density_deviation: pressure / sound_speed_squared,
            }
        })
        .collect()
}
