//! The fluid: parameters, lattice and blocks.

use crate::format::{
    BlockForm, CaseForm, DissipationForm, Fit, FluidForm, PressureForm, SoundSpeedForm,
};
use crate::geometry::{Point, Region, union};
use crate::lattice::{Lattice, ON_PLANE};
use crate::plan::{BlockPlan, FluidPlan};

use super::checker::{FACES, short};
use super::{Checker, shape, walls};

/// Fewest wall layers (design §3).
const FEWEST_LAYERS: f64 = 3.0;

/// Checks the fluid and resolves it; `None` when something it needs is wrong.
pub(crate) fn plan(
    form: &FluidForm,
    gravity: &Point,
    case: &CaseForm,
    check: &mut Checker<'_>,
) -> Option<FluidPlan> {
    let valid = parameters(form, check);
    if form.blocks.is_empty() {
        let help = "add a block, or leave out `fluid`";
        check.problem("fluid.blocks", "the fluid has no block".into(), help);
    }
    let blocks: Vec<BlockPlan> = form
        .blocks
        .iter()
        .enumerate()
        .filter_map(|(index, block)| self::block(block, &format!("fluid.blocks[{index}]"), check))
        .collect();
    if !valid || blocks.len() < form.blocks.len() || blocks.is_empty() {
        return None;
    }
    let first = blocks[0].region.bounds().0;
    let origin = check.vector_or("fluid.lattice_origin", form.lattice_origin.as_ref(), first)?;
    let lattice = Lattice { origin, spacing: form.spacing, dimension: check.dimension };
    let smoothing_length = form.smoothing_ratio * form.spacing;
    let layers = (2.0 * form.smoothing_ratio - 1e-9).ceil().max(FEWEST_LAYERS) as i64;
    let mut plan = FluidPlan {
        lattice,
        density: form.density,
        smoothing_length,
        sound_speed: 0.0,
        maximum_speed: 0.0,
        density_diffusion: form.density_diffusion,
        dissipation: form.dissipation,
        courant_number: form.courant_number,
        blocks,
        layers,
    };
    fit_blocks(&mut plan, form.fit, check);
    sound_speed(&mut plan, form, gravity, case, check)?;
    Some(plan)
}

fn parameters(form: &FluidForm, check: &mut Checker<'_>) -> bool {
    let mut valid = check.positive("fluid.spacing", form.spacing, "m");
    valid &= check.positive("fluid.density", form.density, "kg/m³");
    let ratio = form.smoothing_ratio;
    let allowed = "between 1.2 and 2.0 (h/dx)";
    valid &=
        check.within("fluid.smoothing_ratio", ratio, "", (1.2..=2.0).contains(&ratio), allowed);
    let diffusion = form.density_diffusion;
    let inside = (0.0..=0.2).contains(&diffusion);
    valid &= check.within("fluid.density_diffusion", diffusion, "", inside, "between 0 and 0.2");
    let courant = form.courant_number;
    let inside = courant > 0.0 && courant <= 1.0;
    valid &= check.within("fluid.courant_number", courant, "", inside, "above 0 and at most 1");
    match form.dissipation {
        DissipationForm::None => {}
        DissipationForm::Artificial { alpha } => {
            let inside = (0.0..=1.0).contains(&alpha);
            valid &= check.within("fluid.dissipation.alpha", alpha, "", inside, "between 0 and 1");
        }
        DissipationForm::Riemann { limiter } => {
            let inside = limiter > 0.0 && limiter <= 100.0;
            let allowed = "above 0 and at most 100";
            valid &= check.within("fluid.dissipation.limiter", limiter, "", inside, allowed);
        }
    }
    match form.sound_speed {
        SoundSpeedForm::Factor(value) => valid &= check.positive("fluid.sound_speed", value, ""),
        SoundSpeedForm::Fixed(value) => valid &= check.positive("fluid.sound_speed", value, "m/s"),
    }
    if let Some(speed) = form.maximum_speed {
        valid &= check.positive("fluid.maximum_speed", speed, "m/s");
    }
    valid
}

fn block(form: &BlockForm, path: &str, check: &mut Checker<'_>) -> Option<BlockPlan> {
    let region = shape::region(&form.shape, &format!("{path}.shape"), check);
    let velocity =
        check.vector_or(&format!("{path}.velocity"), form.velocity.as_ref(), Point::zeros());
    if let PressureForm::Uniform(pressure) = form.pressure {
        check.within(&format!("{path}.pressure"), pressure, "Pa", true, "a finite number");
    }
    Some(BlockPlan {
        name: form.name.clone(),
        region: region?,
        velocity: velocity?,
        pressure: form.pressure,
    })
}

/// Requires box faces on lattice planes, or moves them there.
fn fit_blocks(plan: &mut FluidPlan, fit: Fit, check: &mut Checker<'_>) {
    let lattice = plan.lattice.clone();
    for (index, block) in plan.blocks.iter_mut().enumerate() {
        let path = format!("fluid.blocks[{index}].shape");
        shape::searchable(&block.region, lattice.spacing, &path, check);
        let Some((lower, upper)) = block.region.as_box() else { continue };
        match fit {
            Fit::Exact => exact(&block.name, &lattice, (lower, upper), &path, check),
            Fit::Nearest => {
                let name = format!("fluid block `{}`", block.name);
                walls::report_rounding(&name, (lower, upper), [[true; 2]; 3], &lattice, check);
                let place = |corner: Point| {
                    Point::from_fn(|axis, _| match axis < lattice.dimension {
                        true => lattice.plane_coordinate(axis, lattice.plane(axis, corner[axis])),
                        false => 0.0,
                    })
                };
                block.region = Region::Box {
                    lower: place(lower),
                    upper: place(upper),
                    dimension: lattice.dimension,
                };
            }
        }
        if block.region.volume() <= 0.0 {
            let message = format!("block `{}` is thinner than half a spacing", block.name);
            check.problem(&path, message, "use a smaller `fluid.spacing`");
        }
    }
}

/// Notes a problem when a face of the box misses the lattice.
fn exact(
    name: &str,
    lattice: &Lattice,
    (lower, upper): (Point, Point),
    path: &str,
    check: &mut Checker<'_>,
) {
    let spacing = lattice.spacing;
    let sizes: Vec<f64> = (0..lattice.dimension).map(|axis| upper[axis] - lower[axis]).collect();
    let divides = |size: f64| {
        let cells = size / spacing;
        (cells - cells.round()).abs() <= ON_PLANE && cells.round() >= 1.0
    };
    if let Some(axis) = (0..lattice.dimension).find(|&axis| !divides(sizes[axis])) {
        let fitting = fitting_spacings(&sizes, spacing);
        let help = if fitting.is_empty() {
            "no spacing near it divides all sizes of the block; change its size, or set \
             `fluid.fit` to Nearest, which moves faces to the lattice"
                .to_owned()
        } else {
            let list = fitting.iter().map(|s| short(*s)).collect::<Vec<_>>().join(" or ");
            format!(
                "nearest spacings that divide all sizes of the block: {list}; or set \
                 `fluid.fit` to Nearest, which moves faces to the lattice"
            )
        };
        let message = format!(
            "the size of block `{name}` along {}, {} m, is {} spacings of {spacing} m, not a \
             whole number",
            super::checker::AXES[axis],
            short(sizes[axis]),
            short(sizes[axis] / spacing)
        );
        return check.problem(path, message, &help);
    }
    let off = (0..lattice.dimension)
        .find(|&axis| lattice.misfit(axis, lower[axis]) > 10.0 * ON_PLANE * spacing);
    if let Some(axis) = off {
        let cells = (lower[axis] - lattice.origin[axis]) / spacing;
        let message = format!(
            "face {} of block `{name}` at {} m misses the particle lattice",
            FACES[2 * axis],
            short(lower[axis])
        );
        let help = format!(
            "all blocks share one lattice; its planes nearest to the face are at {} and {} m. \
             Move the block, choose `fluid.lattice_origin`, or set `fluid.fit` to Nearest",
            short(lattice.origin[axis] + cells.floor() * spacing),
            short(lattice.origin[axis] + cells.ceil() * spacing),
        );
        check.problem(path, message, &help);
    }
}

/// Spacings near `spacing` that divide every size: the next finer and the next coarser one.
pub(crate) fn fitting_spacings(sizes: &[f64], spacing: f64) -> Vec<f64> {
    const MOST_CELLS: f64 = 20_000.0;
    let shortest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
    let start = shortest / spacing;
    if !(start.is_finite() && start < MOST_CELLS) {
        return Vec::new();
    }
    let fits = |cells: &f64| {
        let candidate = shortest / cells;
        sizes.iter().all(|size| (size / candidate - (size / candidate).round()).abs() < ON_PLANE)
    };
    // Beyond a factor of four it would be another case.
    let steps = |from: f64| (0..).map(move |k| from + f64::from(k));
    let finer = steps(start.ceil().max(1.0)).take_while(|n| *n <= 4.0 * start.max(1.0)).find(fits);
    let coarser = (0..)
        .map(|k| start.floor() - f64::from(k))
        .take_while(|n| *n >= 1.0 && *n >= 0.25 * start)
        .find(fits);
    [finer, coarser].into_iter().flatten().map(|cells| shortest / cells).collect()
}

/// Resolves c0 and judges it by the largest speed expected.
fn sound_speed(
    plan: &mut FluidPlan,
    form: &FluidForm,
    gravity: &Point,
    case: &CaseForm,
    check: &mut Checker<'_>,
) -> Option<()> {
    let height = height(plan, gravity);
    let free_fall = (gravity.norm() * height).sqrt();
    plan.sound_speed = match form.sound_speed {
        SoundSpeedForm::Fixed(speed) => speed,
        SoundSpeedForm::Factor(factor) => factor * free_fall,
    };
    if plan.sound_speed <= 0.0 {
        let message = "without gravity there is no √(g H) to take a multiple of".into();
        check.problem("fluid.sound_speed", message, "give it as Fixed(speed in m/s)");
        return None;
    }
    let blocks = plan.blocks.iter().map(|block| block.velocity.norm()).fold(0.0, f64::max);
    let walls = case.walls.iter().filter_map(|wall| wall.motion.as_ref());
    let walls = walls.map(|motion| largest_speed(&motion.law)).fold(0.0, f64::max);
    let guess = (2.0 * free_fall).max(blocks).max(walls);
    plan.maximum_speed = form.maximum_speed.unwrap_or(guess);
    let (sound, speed) = (plan.sound_speed, plan.maximum_speed);
    if sound < 10.0 * speed * (1.0 - 1e-9) {
        check.warn(format!(
            "the sound speed {} m/s is less than 10 times the largest speed expected, {} m/s: \
             density may vary by more than 1 %; raise `fluid.sound_speed` to Fixed({}), or give \
             `fluid.maximum_speed`",
            short(sound),
            short(speed),
            short(10.0 * speed)
        ));
    }
    let compression = gravity.norm() * height / (sound * sound);
    if compression > 0.1 {
        let message = format!(
            "with a sound speed of {} m/s the water at the bottom is compressed by {:.0} %",
            short(sound),
            100.0 * compression
        );
        let help = format!("use at least Fixed({})", short(10.0 * free_fall));
        check.problem("fluid.sound_speed", message, &help);
        return None;
    }
    Some(())
}

/// Height of all blocks together along the direction opposite to gravity (m).
fn height(plan: &FluidPlan, gravity: &Point) -> f64 {
    let Some(down) = gravity.try_normalize(1e-300) else { return 0.0 };
    let (lower, upper) = union(plan.blocks.iter().map(|block| block.region.bounds()));
    (0..plan.lattice.dimension).map(|axis| (down[axis] * (upper[axis] - lower[axis])).abs()).sum()
}

fn largest_speed(law: &crate::format::LawForm) -> f64 {
    use crate::format::LawForm;
    match law {
        LawForm::Fixed => 0.0,
        LawForm::Constant { velocity }
        | LawForm::Ramp { velocity, .. }
        | LawForm::SmoothStart { velocity, .. } => velocity.abs(),
        LawForm::Table { rows } => rows
            .windows(2)
            .map(|pair| ((pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).abs())
            .fold(0.0, f64::max),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_finer_and_coarser_spacing_that_fit_are_found() {
        let near = |found: Vec<f64>, expected: &[f64]| {
            assert_eq!(found.len(), expected.len(), "{found:?}");
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-12, "{found:?}");
            }
        };
        near(fitting_spacings(&[1.0, 2.0], 0.11), &[0.1, 1.0 / 9.0]);
        near(fitting_spacings(&[6.0, 1.0, 2.0], 0.3), &[0.25, 1.0 / 3.0]);
        near(fitting_spacings(&[1.0, std::f64::consts::SQRT_2], 0.1), &[]);
        near(fitting_spacings(&[1.0], 1e-9), &[]);
    }
}
