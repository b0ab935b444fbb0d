//! What a frame shows: water, solids and rigid walls, each with its colours.

use super::super::colour::Rgb;
use super::super::error::OutputError;
use super::super::frame::{CloudKind, magnitudes, von_mises};
use super::super::run_reader::{FrameInfo, Place, RunReader};
use super::super::view_camera::Bounds;
use super::super::wall_surface::{self, Surface};
use super::canvas::{Canvas, brightness, shaded};
use super::ramp::Ramp;
use super::view::View;

/// A plane scene's walls are seen from their side, as dark as an outline.
const WALL_IN_PLANE: Rgb = [150, 156, 166];

/// Walls in space are background: faint, so that what is in front stands out.
const WALL_IN_SPACE: Rgb = [247, 248, 250];

/// Drawn diameter over spacing in the plane: the discs have the area of the particles, 2/√π.
const DISC_SIZE: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// Drawn diameter over spacing in space, where balls must close the surface.
const BALL_SIZE: f64 = 1.25;

/// Points with one value each.
struct Dots {
    position: Vec<[f64; 3]>,
    value: Vec<f64>,
    spacing: f64,
}

/// Everything in view.
pub struct Scene {
    dimension: usize,
    water: Vec<Dots>,
    solids: Vec<Dots>,
    walls: Vec<Dots>,
    surfaces: Vec<Surface>,
    /// Colours of the water, if there is any.
    pub water_ramp: Option<Ramp>,
    /// Colours of the solids, if there are any.
    pub solid_ramp: Option<Ramp>,
}

impl Scene {
    /// Reads what `frame` shows.
    pub fn read(run: &RunReader, frame: &FrameInfo, dimension: usize) -> Result<Self, OutputError> {
        let mut scene = Self {
            dimension,
            water: Vec::new(),
            solids: Vec::new(),
            walls: Vec::new(),
            surfaces: Vec::new(),
            water_ramp: None,
            solid_ramp: None,
        };
        let statics = run.static_clouds()?.into_iter().map(|name| (Place::Static, name));
        let moving = frame.clouds.iter().map(|name| (Place::Frame(frame.index), name.clone()));
        for (place, name) in statics.chain(moving) {
            scene.add(run, place, &name)?;
        }
        let values = |dots: &[Dots]| dots.iter().flat_map(|d| d.value.clone()).collect::<Vec<_>>();
        scene.water_ramp = (!scene.water.is_empty()).then(|| Ramp::speed(&values(&scene.water)));
        scene.solid_ramp =
            (!scene.solids.is_empty()).then(|| Ramp::von_mises(&values(&scene.solids)));
        Ok(scene)
    }

    fn add(&mut self, run: &RunReader, place: Place, name: &str) -> Result<(), OutputError> {
        let info = run.cloud(place, name)?;
        if info.count == 0 {
            return Ok(());
        }
        let position = run.position(place, name)?;
        let value = match info.kind {
            CloudKind::Fluid => magnitudes(&run.field(place, name, "velocity")?, 3),
            CloudKind::Solid => von_mises(&run.field(place, name, "stress")?),
            CloudKind::Wall if self.dimension == 2 => vec![0.0; position.len()],
            CloudKind::Wall => {
                self.surfaces.push(wall_surface::surface(&position, info.spacing));
                return Ok(());
            }
        };
        let dots = Dots { position, value, spacing: info.spacing };
        match info.kind {
            CloudKind::Fluid => self.water.push(dots),
            CloudKind::Solid => self.solids.push(dots),
            CloudKind::Wall => self.walls.push(dots),
        }
        Ok(())
    }

    /// The box around everything.
    pub fn bounds(&self) -> Bounds {
        let dots = [&self.water, &self.solids, &self.walls].into_iter().flatten();
        let dots = dots.flat_map(|dots| {
            dots.position.iter().flat_map(|p| {
                [-0.5, 0.5].map(|side| std::array::from_fn(|i| p[i] + side * dots.spacing))
            })
        });
        around(dots.chain(self.surfaces.iter().flat_map(corners))).unwrap_or(([0.0; 3], [1.0; 3]))
    }

    /// The box that the axes measure: the walls' inside where it is known, else everything.
    pub fn frame(&self) -> Bounds {
        around(self.surfaces.iter().flat_map(corners)).unwrap_or_else(|| self.bounds())
    }

    /// Two or three.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Paints everything as seen from `view`.
    pub fn paint(&self, canvas: &mut Canvas, view: &View) {
        for surface in &self.surfaces {
            paint_surface(surface, canvas, view);
        }
        for dots in &self.walls {
            self.paint_dots(dots, |_| WALL_IN_PLANE, canvas, view);
        }
        for (clouds, ramp) in [(&self.water, &self.water_ramp), (&self.solids, &self.solid_ramp)] {
            let Some(ramp) = ramp else { continue };
            for dots in clouds {
                self.paint_dots(dots, |value| ramp.colour(value), canvas, view);
            }
        }
    }

    fn paint_dots(
        &self,
        dots: &Dots,
        colour: impl Fn(f64) -> Rgb,
        canvas: &mut Canvas,
        view: &View,
    ) {
        let radius = 0.5 * dots.spacing * view.scale();
        for (&point, &value) in dots.position.iter().zip(&dots.value) {
            let centre = view.project(point);
            if self.dimension == 2 {
                canvas.circle(centre, DISC_SIZE * radius, colour(value));
            } else {
                canvas.ball(centre, BALL_SIZE * radius, colour(value));
            }
        }
    }
}

fn paint_surface(surface: &Surface, canvas: &mut Canvas, view: &View) {
    for triangle in &surface.triangles {
        let normal = view.turn(surface.normals[triangle[0] as usize].map(f64::from));
        // Seen from behind, a wall would hide what it holds.
        if normal[2] > 0.0 {
            let corners =
                triangle.map(|i| view.project(surface.vertices[i as usize].map(f64::from)));
            canvas.triangle(corners, shaded(WALL_IN_SPACE, 0.75 + 0.25 * brightness(normal)));
        }
    }
}

fn corners(surface: &Surface) -> impl Iterator<Item = [f64; 3]> + '_ {
    surface.vertices.iter().map(|vertex| vertex.map(f64::from))
}

fn around(mut points: impl Iterator<Item = [f64; 3]>) -> Option<Bounds> {
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), point| {
        (
            std::array::from_fn(|i| low[i].min(point[i])),
            std::array::from_fn(|i| high[i].max(point[i])),
        )
    }))
}
