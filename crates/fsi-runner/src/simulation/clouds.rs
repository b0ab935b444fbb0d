//! Solver state as the point clouds that the writers take.
//!
//! Points are written in the order of their identities, whatever order the
//! solvers have sorted them into.

use gimpm::Solid;
use nalgebra::SVector;
use sph::Fluid;

use crate::output::frame::{CloudKind, Field, PLASTIC_STRAIN, PointCloud};

/// A vector of either dimension in space; z = 0 in 2D.
pub fn in_space<const D: usize>(vector: &SVector<f64, D>) -> [f64; 3] {
    let mut space = [0.0; 3];
    space[..D].copy_from_slice(vector.as_slice());
    space
}

fn gathered<T>(order: &[usize], value: impl Fn(usize) -> T) -> Vec<T> {
    order.iter().map(|&index| value(index)).collect()
}

fn vectors<const D: usize>(order: &[usize], values: &[SVector<f64, D>]) -> Vec<f64> {
    order.iter().flat_map(|&index| in_space(&values[index])).collect()
}

fn order_by_identity(ids: &[u32], keep: impl Fn(usize) -> bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..ids.len()).filter(|&index| keep(index)).collect();
    order.sort_unstable_by_key(|&index| ids[index]);
    order
}

/// Fluid particles with velocity, pressure and density.
pub fn fluid<const D: usize>(fluid: &Fluid<D>) -> PointCloud {
    let particles = fluid.particles();
    let order = order_by_identity(&particles.id, |_| true);
    let reference = fluid.parameters().reference_density;
    PointCloud {
        name: "fluid".into(),
        kind: CloudKind::Fluid,
        spacing: fluid.parameters().spacing,
        id: gathered(&order, |index| particles.id[index]),
        position: gathered(&order, |index| in_space(&particles.position[index])),
        fields: vec![
            Field {
                name: "velocity",
                unit: "m/s",
                components: 3,
                values: vectors(&order, &particles.velocity),
            },
            Field {
                name: "pressure",
                unit: "Pa",
                components: 1,
                values: gathered(&order, |index| fluid.pressure(index)),
            },
            Field {
                name: "density",
                unit: "kg/m^3",
                components: 1,
                values: gathered(&order, |index| reference + particles.density_deviation[index]),
            },
        ],
    }
}

/// Wall particles that never move.
pub fn fixed_walls<const D: usize>(fluid: &Fluid<D>) -> Option<PointCloud> {
    walls(fluid, "walls", |group| !fluid.wall_moves(group))
}

/// Wall particles with a prescribed motion.
pub fn moving_walls<const D: usize>(fluid: &Fluid<D>) -> Option<PointCloud> {
    walls(fluid, "moving_walls", |group| fluid.wall_moves(group))
}

fn walls<const D: usize>(
    fluid: &Fluid<D>,
    name: &str,
    keep: impl Fn(usize) -> bool,
) -> Option<PointCloud> {
    let walls = fluid.walls();
    let order: Vec<usize> =
        (0..walls.position.len()).filter(|&index| keep(usize::from(walls.group[index]))).collect();
    if order.is_empty() {
        return None;
    }
    Some(PointCloud {
        name: name.into(),
        kind: CloudKind::Wall,
        spacing: fluid.parameters().spacing,
        id: gathered(&order, |index| index as u32),
        position: gathered(&order, |index| in_space(&walls.position[index])),
        fields: Vec::new(),
    })
}

/// Material points of each body with velocity, displacement and stress, and with the
/// equivalent plastic strain where the law has one.
pub fn bodies<const D: usize>(solid: &Solid<D>) -> Vec<PointCloud> {
    let points = solid.points();
    let body = |(number, body): (usize, &gimpm::Body)| {
        let order =
            order_by_identity(&points.id, |index| usize::from(points.body[index]) == number);
        let displacement =
            |&index: &usize| in_space(&(points.position[index] - points.reference_position[index]));
        let mut fields = vec![
            Field {
                name: "velocity",
                unit: "m/s",
                components: 3,
                values: vectors(&order, &points.velocity),
            },
            Field {
                name: "displacement",
                unit: "m",
                components: 3,
                values: order.iter().flat_map(displacement).collect(),
            },
            Field {
                name: "stress",
                unit: "Pa",
                components: 6,
                values: order.iter().flat_map(|&index| points.stress[index]).collect(),
            },
        ];
        if body.material.has_history() {
            fields.push(Field {
                name: PLASTIC_STRAIN,
                unit: "1",
                components: 1,
                values: gathered(&order, |index| points.history[index][0]),
            });
        }
        PointCloud {
            name: format!("solid/{}", body.name),
            kind: CloudKind::Solid,
            spacing: body.point_spacing,
            id: gathered(&order, |index| points.id[index]),
            position: gathered(&order, |index| in_space(&points.position[index])),
            fields,
        }
    };
    solid.bodies().iter().enumerate().map(body).collect()
}
