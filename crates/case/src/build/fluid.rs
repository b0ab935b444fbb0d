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
    let parameters = parameters(fluid, plan);
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
        particles.extend(states(block, &centers, &parameters));
    }
    let walls = walls::seed(fluid, plan, source, notes)?;
    overlap::fluid_near_wall(&particles, &walls, fluid.spacing(), source)?;
    notes.push(format!(
        "fluid: spacing {} m, smoothing length {} m, sound speed {} m/s",
        short(fluid.spacing()),
        short(fluid.smoothing_length),
        short(fluid.sound_speed)
    ));
    Ok(FluidModel { parameters, particles, walls })
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

/// Position, velocity and density of the particles of one block. At rest under gravity
/// the particles carry the water above them, and stand as much closer as that
/// compresses them ([`FluidSeed::at_rest`]).
fn states<const D: usize>(
    block: &BlockPlan,
    centers: &[Point],
    parameters: &FluidParameters<D>,
) -> Vec<FluidSeed<D>> {
    let up = -parameters.gravity / parameters.gravity.norm().max(f64::MIN_POSITIVE);
    let heights = || centers.iter().map(|p| shrink::<D>(p).dot(&up));
    let half = 0.5 * parameters.spacing;
    let floor = heights().fold(f64::INFINITY, f64::min) - half;
    let surface = heights().fold(f64::NEG_INFINITY, f64::max) + half;
    centers
        .iter()
        .map(|p| {
            let seed = match block.pressure {
                PressureForm::Hydrostatic => {
                    FluidSeed::at_rest(parameters, shrink(p), floor, surface)
                }
                PressureForm::Uniform(pressure) => FluidSeed {
                    position: shrink(p),
                    density_deviation: pressure / parameters.sound_speed.powi(2),
                    ..FluidSeed::default()
                },
            };
            FluidSeed { velocity: shrink(&block.velocity), ..seed }
        })
        .collect()
}
