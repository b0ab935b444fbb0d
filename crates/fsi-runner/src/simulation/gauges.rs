//! Gauges: what is recorded over time, and under which column names.

use case::{ForceTarget, Gauge, GaugeKind};
use coupling::{Coupled, FluidSide, SolidSide};
use gimpm::{Reaction, Solid};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::SVector;

use super::clouds::in_space;
use super::sides::{ObservedFluid, ObservedSolid};
use crate::output::frame::Column;

const AXES: [&str; 3] = ["x", "y", "z"];
const STRESSES: [&str; 6] = ["xx", "yy", "zz", "xy", "yz", "xz"];

/// The gauges of a run, with the material points that they follow.
pub struct GaugeBoard<const D: usize> {
    gauges: Vec<Gauge<D>>,
    /// Identity of the followed material point of each gauge, if it follows one.
    followed: Vec<Option<u32>>,
}

impl<const D: usize> GaugeBoard<D> {
    /// Finds the material point nearest to each gauge that follows one.
    pub fn new(gauges: Vec<Gauge<D>>, solid: Option<&Solid<D>>) -> Self {
        let followed = gauges
            .iter()
            .map(|gauge| match (&gauge.kind, solid) {
                (
                    GaugeKind::Displacement { body, position }
                    | GaugeKind::Stress { body, position },
                    Some(solid),
                ) => nearest_point(solid, *body, position),
                _ => None,
            })
            .collect();
        Self { gauges, followed }
    }

    /// Names and units, in the order of [`Self::row`].
    pub fn columns(&self) -> Vec<Column> {
        self.gauges.iter().flat_map(columns::<D>).collect()
    }

    /// Values now.
    pub fn row<F, S>(&self, coupled: &Coupled<D, F, S>, reactions: &[Reaction<D>]) -> Vec<f64>
    where
        F: FluidSide<D> + ObservedFluid<D>,
        S: SolidSide<D> + ObservedSolid<D>,
    {
        let mut row = Vec::new();
        // Points are sorted as they move: where each identity is now.
        let place = coupled.solid().observed().map(|solid| place_of_identity(&solid.points().id));
        for (gauge, followed) in self.gauges.iter().zip(&self.followed) {
            let index = followed.zip(place.as_ref()).map(|(id, place)| place[id as usize]);
            read(&gauge.kind, index, coupled, reactions, &mut row);
        }
        row
    }

    /// Gauge names with their places in space.
    pub fn markers(&self) -> Vec<(String, [f64; 3])> {
        let place = |kind: &GaugeKind<D>| match kind {
            GaugeKind::Pressure { position }
            | GaugeKind::Velocity { position }
            | GaugeKind::Displacement { position, .. }
            | GaugeKind::Stress { position, .. } => Some(in_space(position)),
            GaugeKind::WaterLevel { base, .. } => Some(in_space(base)),
            GaugeKind::Front { .. } | GaugeKind::CenterOfMass { .. } | GaugeKind::Force { .. } => {
                None
            }
        };
        self.gauges
            .iter()
            .filter_map(|gauge| place(&gauge.kind).map(|x| (gauge.name.clone(), x)))
            .collect()
    }
}

fn nearest_point<const D: usize>(
    solid: &Solid<D>,
    body: usize,
    position: &SVector<f64, D>,
) -> Option<u32> {
    let points = solid.points();
    let of_body: Vec<usize> = solid.body_range(body).collect();
    let places: Vec<[f64; D]> =
        of_body.iter().map(|&index| points.reference_position[index].into()).collect();
    let tree: ImmutableKdTree<f64, D> = ImmutableKdTree::new_from_slice(&places).ok()?;
    let at: [f64; D] = (*position).into();
    let nearest = tree.query(&at).nearest_one::<SquaredEuclidean<f64>>().execute();
    of_body.get(nearest.item as usize).map(|&index| points.id[index])
}

fn place_of_identity(ids: &[u32]) -> Vec<usize> {
    let mut place = vec![0; ids.len()];
    for (index, &id) in ids.iter().enumerate() {
        place[id as usize] = index;
    }
    place
}

fn columns<const D: usize>(gauge: &Gauge<D>) -> Vec<Column> {
    let column = |quantity: &str, unit: &str| Column {
        name: format!("{}.{quantity}", gauge.name),
        unit: unit.into(),
    };
    let axes = &AXES[..D];
    // In 2D forces and moments are those of one metre of width.
    let (force, moment) = if D == 2 { ("N/m", "N") } else { ("N", "N m") };
    match &gauge.kind {
        GaugeKind::Pressure { .. } => vec![column("pressure", "Pa")],
        GaugeKind::Velocity { .. } => {
            axes.iter().map(|axis| column(&format!("velocity_{axis}"), "m/s")).collect()
        }
        GaugeKind::WaterLevel { .. } => vec![column("level", "m")],
        GaugeKind::Front { .. } => vec![column("position", "m")],
        GaugeKind::Displacement { .. } => axes.iter().map(|axis| column(axis, "m")).collect(),
        GaugeKind::Stress { .. } => {
            STRESSES.iter().map(|name| column(&format!("stress_{name}"), "Pa")).collect()
        }
        GaugeKind::CenterOfMass { .. } => {
            let place = axes.iter().map(|axis| column(&format!("displacement_{axis}"), "m"));
            let speed = axes.iter().map(|axis| column(&format!("velocity_{axis}"), "m/s"));
            place.chain(speed).collect()
        }
        GaugeKind::Force { .. } => {
            let forces = axes.iter().map(|axis| column(&format!("force_{axis}"), force));
            let about = if D == 2 { &AXES[2..] } else { &AXES[..] };
            let moments = about.iter().map(|axis| column(&format!("moment_{axis}"), moment));
            forces.chain(moments).collect()
        }
    }
}

fn read<const D: usize, F, S>(
    kind: &GaugeKind<D>,
    followed: Option<usize>,
    coupled: &Coupled<D, F, S>,
    reactions: &[Reaction<D>],
    row: &mut Vec<f64>,
) where
    F: FluidSide<D> + ObservedFluid<D>,
    S: SolidSide<D> + ObservedSolid<D>,
{
    let fluid = coupled.fluid().observed();
    let solid = coupled.solid().observed();
    match kind {
        GaugeKind::Pressure { position } => {
            row.push(fluid.map_or(0.0, |fluid| fluid.sample(position).pressure));
        }
        GaugeKind::Velocity { position } => {
            let velocity = fluid.map_or(SVector::zeros(), |fluid| fluid.sample(position).velocity);
            row.extend(velocity.iter());
        }
        GaugeKind::WaterLevel { base, top } => {
            row.push(fluid.map_or(0.0, |fluid| fluid.water_level(base, top)));
        }
        GaugeKind::Front { direction } => {
            row.push(fluid.map_or(0.0, |fluid| fluid.front(direction)));
        }
        GaugeKind::Displacement { position, .. } => {
            let displacement = solid
                .zip(followed)
                .map_or(SVector::zeros(), |(solid, index)| solid.displacement_at(index, *position));
            row.extend(displacement.iter());
        }
        GaugeKind::Stress { .. } => {
            let stress =
                solid.zip(followed).map_or([0.0; 6], |(solid, index)| solid.points().stress[index]);
            row.extend(stress);
        }
        GaugeKind::CenterOfMass { body } => {
            let zero = SVector::zeros();
            let (displacement, velocity) =
                solid.map_or((zero, zero), |solid| mean_motion(solid, *body));
            row.extend(displacement.iter().chain(&velocity));
        }
        GaugeKind::Force { target, about } => {
            let (force, moment) = match *target {
                ForceTarget::Wall(wall) => fluid.map(|fluid| fluid.wall_force(wall, about)),
                ForceTarget::Boundary(index) => {
                    reactions.get(index).map(|held| (held.force, held.moment_about(about)))
                }
                ForceTarget::Body(body) => Some(body_load(coupled, body, about)),
            }
            .unwrap_or((SVector::zeros(), [0.0; 3]));
            row.extend(force.iter());
            row.extend(if D == 2 { &moment[2..] } else { &moment[..] });
        }
    }
}

/// Displacement (m) and velocity (m/s) of a body's centre of mass.
fn mean_motion<const D: usize>(
    solid: &Solid<D>,
    body: usize,
) -> (SVector<f64, D>, SVector<f64, D>) {
    let (points, range) = (solid.points(), solid.body_range(body));
    let sums = ordered_reduction::sum::<7>(range.len(), |k| {
        let p = range.start + k;
        let mass = points.mass[p];
        let [x, y, z] = in_space(&((points.position[p] - points.reference_position[p]) * mass));
        let [u, v, w] = in_space(&(points.velocity[p] * mass));
        [mass, x, y, z, u, v, w]
    });
    let mean = |first: usize| SVector::from_fn(|axis, _| sums[first + axis] / sums[0]);
    (mean(1), mean(4))
}

/// Force of the fluid on a body and its moment about a point.
fn body_load<const D: usize, F, S>(
    coupled: &Coupled<D, F, S>,
    body: usize,
    about: &SVector<f64, D>,
) -> (SVector<f64, D>, [f64; 3])
where
    F: FluidSide<D>,
    S: SolidSide<D>,
{
    let (structure, load) = coupled.interface();
    let sums = ordered_reduction::sum::<6>(load.len(), |index| {
        if usize::from(structure.body[index]) != body {
            return [0.0; 6];
        }
        let [fx, fy, fz] = in_space(&load[index]);
        let [x, y, z] = in_space(&(structure.position[index] - about));
        [fx, fy, fz, y * fz - z * fy, z * fx - x * fz, x * fy - y * fx]
    });
    (SVector::from_fn(|axis, _| sums[axis]), [sums[3], sums[4], sums[5]])
}
