//! The scene in Rerun: points, walls, gauges and the legend of their colours.

use super::colour::{ColourScale, Rgb, engineering, high_percentile};
use super::frame::{
    CloudKind, Frame, PLASTIC_STRAIN, PointCloud, RunHeader, magnitudes, von_mises,
};
use super::rerun_options::{FluidColour, Marker, RerunOptions, SolidColour};
use super::view_camera::Bounds;
use super::wall_surface;
use rerun::components::MeshFaceRendering;
use rerun::{Color, Mesh3D, Points3D, Radius, RecordingStream, RecordingStreamError};

/// Root of everything that has a place in space.
pub const WORLD: &str = "world";

/// Explains the colours.
pub const LEGEND: &str = "legend";

const WALL_COLOUR: Rgb = [150, 156, 166];
const MARKER_COLOUR: Rgb = [255, 64, 192];

/// Turns clouds into entities and remembers the colour scales.
pub struct Scene {
    dimension: usize,
    point_limit: usize,
    fluid_colour: FluidColour,
    solid_colour: SolidColour,
    fluid: ColourScale,
    solid: ColourScale,
    /// The largest stride in use.
    thinning: usize,
    legend: String,
}

impl Scene {
    /// The fluid's scale is fixed by the first frame, so that colours can be
    /// compared over time; the solids' grows with the load.
    pub fn new(options: &RerunOptions, header: &RunHeader, first: &Frame) -> Self {
        let fluid = first.clouds.iter().find(|cloud| cloud.kind == CloudKind::Fluid);
        let fluid = fluid.map_or(0.0, |cloud| match options.fluid_colour {
            FluidColour::Pressure => column_pressure(cloud, header),
            FluidColour::Speed => (2.0 * drop_height(cloud, header)).sqrt(),
        });
        Self {
            dimension: header.dimension,
            point_limit: options.point_limit,
            fluid_colour: options.fluid_colour,
            solid_colour: options.solid_colour,
            fluid: ColourScale::covering(fluid),
            solid: ColourScale::covering(0.0),
            thinning: 1,
            legend: String::new(),
        }
    }

    /// Logs walls that never move and the gauges.
    pub fn log_statics(
        &self,
        recording: &RecordingStream,
        statics: &[PointCloud],
        markers: &[Marker],
        bounds: Option<Bounds>,
    ) -> Result<(), RecordingStreamError> {
        let axes = if self.dimension == 2 {
            rerun::ViewCoordinates::RIGHT_HAND_Y_UP()
        } else {
            rerun::ViewCoordinates::RIGHT_HAND_Z_UP()
        };
        recording.log_static(WORLD, &axes)?;
        for cloud in statics {
            self.log_wall(recording, cloud, true)?;
        }
        if markers.is_empty() {
            return Ok(());
        }
        let size =
            bounds.map_or(1.0, |(low, high)| (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max));
        let radius = Radius::new_scene_units((0.006 * size) as f32);
        let points = Points3D::new(markers.iter().map(|marker| single(marker.position)))
            .with_labels(markers.iter().map(|marker| marker.name.as_str()))
            .with_show_labels(true)
            .with_colors([colour(MARKER_COLOUR)])
            .with_radii([radius]);
        recording.log_static(format!("{WORLD}/gauges"), &points)
    }

    /// Logs a frame at the time that is set.
    pub fn log_frame(
        &mut self,
        recording: &RecordingStream,
        frame: &Frame,
    ) -> Result<(), RecordingStreamError> {
        for cloud in &frame.clouds {
            match cloud.kind {
                CloudKind::Wall => self.log_wall(recording, cloud, false)?,
                CloudKind::Fluid => {
                    let values = fluid_values(cloud, self.fluid_colour);
                    if self.fluid.upper == 0.0 {
                        self.fluid.grow(high_percentile(&values));
                    }
                    self.log_points(recording, cloud, &values, self.fluid)?;
                }
                CloudKind::Solid => {
                    let values = solid_values(cloud, self.solid_colour);
                    self.solid.grow(high_percentile(&values));
                    self.log_points(recording, cloud, &values, self.solid)?;
                }
            }
        }
        self.log_legend(recording, frame)
    }

    fn log_points(
        &mut self,
        recording: &RecordingStream,
        cloud: &PointCloud,
        values: &[f64],
        scale: ColourScale,
    ) -> Result<(), RecordingStreamError> {
        let stride = cloud.position.len().div_ceil(self.point_limit.max(1)).max(1);
        self.thinning = self.thinning.max(stride);
        // By identity: particles change places in memory, and the same ones should stay.
        let shown = |i: &usize| stride == 1 || (cloud.id[*i] as usize).is_multiple_of(stride);
        let chosen: Vec<usize> = (0..cloud.position.len()).filter(shown).collect();
        let positions = chosen.iter().map(|&i| single(cloud.position[i]));
        let colours =
            chosen.iter().map(|&i| colour(scale.colour(values.get(i).copied().unwrap_or(0.0))));
        let radius = 0.5 * cloud.spacing * (stride as f64).cbrt();
        let points = Points3D::new(positions)
            .with_colors(colours)
            .with_radii([Radius::new_scene_units(radius as f32)]);
        recording.log(format!("{WORLD}/{}", cloud.name), &points)
    }

    fn log_wall(
        &self,
        recording: &RecordingStream,
        cloud: &PointCloud,
        fixed: bool,
    ) -> Result<(), RecordingStreamError> {
        let path = format!("{WORLD}/{}", cloud.name);
        if self.dimension == 2 {
            let points = Points3D::new(cloud.position.iter().map(|&p| single(p)))
                .with_colors([colour(WALL_COLOUR)])
                .with_radii([Radius::new_scene_units((0.5 * cloud.spacing) as f32)]);
            return recording.log_with_static(path, fixed, &points);
        }
        let surface = wall_surface::surface(&cloud.position, cloud.spacing);
        let colours = vec![colour(WALL_COLOUR); surface.vertices.len()];
        let mesh = Mesh3D::new(surface.vertices)
            .with_vertex_normals(surface.normals)
            .with_triangle_indices(surface.triangles)
            .with_vertex_colors(colours)
            .with_face_rendering(MeshFaceRendering::Front);
        recording.log_with_static(path, fixed, &mesh)
    }

    fn log_legend(
        &mut self,
        recording: &RecordingStream,
        frame: &Frame,
    ) -> Result<(), RecordingStreamError> {
        let has = |kind| frame.clouds.iter().any(|cloud| cloud.kind == kind);
        let range = |scale: ColourScale, unit| {
            format!("0 (blue) to {} (red)", engineering(scale.upper, unit))
        };
        let mut parts = Vec::new();
        if has(CloudKind::Fluid) {
            let (name, unit) = match self.fluid_colour {
                FluidColour::Pressure => ("pressure", "Pa"),
                FluidColour::Speed => ("speed", "m/s"),
            };
            parts.push(format!("**Fluid**: {name} {}", range(self.fluid, unit)));
        }
        if has(CloudKind::Solid) {
            let (name, unit) = match self.solid_colour {
                SolidColour::Stress => ("von Mises stress", "Pa"),
                SolidColour::PlasticStrain => ("plastic strain", "1"),
                SolidColour::Displacement => ("displacement", "m"),
            };
            parts.push(format!("**Solid**: {name} {}", range(self.solid, unit)));
        }
        if self.thinning > 1 {
            parts.push(format!("one point of {} is shown", self.thinning));
        }
        let legend = parts.join("  \n");
        if legend != self.legend {
            recording.log(LEGEND, &rerun::TextDocument::from_markdown(legend.as_str()))?;
            self.legend = legend;
        }
        Ok(())
    }
}

fn fluid_values(cloud: &PointCloud, choice: FluidColour) -> Vec<f64> {
    let name = match choice {
        FluidColour::Pressure => "pressure",
        FluidColour::Speed => "velocity",
    };
    cloud.field(name).map_or_else(Vec::new, |field| match choice {
        FluidColour::Pressure => field.values.clone(),
        FluidColour::Speed => magnitudes(&field.values, field.components),
    })
}

fn solid_values(cloud: &PointCloud, choice: SolidColour) -> Vec<f64> {
    let name = match choice {
        SolidColour::Stress => "stress",
        SolidColour::PlasticStrain => PLASTIC_STRAIN,
        SolidColour::Displacement => "displacement",
    };
    cloud.field(name).map_or_else(Vec::new, |field| match choice {
        SolidColour::Stress if field.components == 6 => von_mises(&field.values),
        SolidColour::PlasticStrain => field.values.clone(),
        SolidColour::Stress | SolidColour::Displacement => {
            magnitudes(&field.values, field.components)
        }
    })
}

/// Highest pressure at the start, or that of the water column ρ g H.
fn column_pressure(cloud: &PointCloud, header: &RunHeader) -> f64 {
    let largest = |name| {
        let values = cloud.field(name).map_or(&[][..], |field| &field.values);
        values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max)
    };
    largest("pressure").max(largest("density") * drop_height(cloud, header))
}

/// |g| H with the extent H of the cloud along gravity: ρ times it is a
/// pressure, the root of twice it a speed.
fn drop_height(cloud: &PointCloud, header: &RunHeader) -> f64 {
    let along = |p: &[f64; 3]| (0..3).map(|i| p[i] * header.gravity[i]).sum::<f64>();
    let (low, high) = cloud
        .position
        .iter()
        .map(along)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
    if high > low { high - low } else { 0.0 }
}

fn single(p: [f64; 3]) -> [f32; 3] {
    p.map(|x| x as f32)
}

fn colour([red, green, blue]: Rgb) -> Color {
    Color::from_rgb(red, green, blue)
}
