//! Equations (5), (6) and the sum of (7), whole node records at a time.

use nalgebra::SVector;
use wide::{f64x4, f64x8};

use crate::fastest::Fastest;
use crate::grid::{ACCELERATION, Grid, GridGeometry, NodeRecord, RemapRecord, VELOCITY};
use crate::lanes::BLOCK;
use crate::points::{Points, front};
use crate::separable::remap::{add_block, momentum};
use crate::separable::weights::BlockWeights;
use crate::shape::{ShapeFunction, with_shape};
use crate::solid::Body;

/// Points of one slab.
struct Slab<'a, const D: usize> {
    position: &'a [SVector<f64, D>],
    mass: &'a [f64],
    velocity: &'a mut [SVector<f64, D>],
    displacement: &'a mut [SVector<f64, D>],
    fastest: &'a mut Fastest,
}

/// New velocity of the points (G11) and their displacement in the step (G12).
///
/// With `remaps`, the new momentum goes back to the nodes in the same sweep (G13, before
/// the division by mass): the weights are evaluated once for both.
pub(crate) fn grid_to_points<const D: usize>(
    body: &Body,
    slab_offsets: &[usize],
    points: &mut Points<D>,
    displacement: &mut [SVector<f64, D>],
    grid: &mut Grid<D>,
    (dt, remaps): (f64, bool),
) -> Fastest {
    let Grid { geometry, nodes: from, remapped, .. } = grid;
    let (start, end) = (slab_offsets[0], slab_offsets[slab_offsets.len() - 1]);
    let mut fastest = vec![Fastest::default(); slab_offsets.len() - 1];
    let (mut velocity, mut displacement) = (&mut points.velocity[start..end], displacement);
    let slabs = slab_offsets.windows(2).zip(&mut fastest).map(|(ends, fastest)| Slab {
        position: &points.position[ends[0]..ends[1]],
        mass: &points.mass[ends[0]..ends[1]],
        velocity: front(&mut velocity, ends[1] - ends[0]),
        displacement: front(&mut displacement, ends[1] - ends[0]),
        fastest,
    });
    with_shape!(body, shape => {
        body.slabs.scatter_each(geometry, slabs.collect(), remapped, |slab, first, to| {
            slab.run(geometry, shape, from, dt, remaps.then_some((first, to)));
        });
    });
    fastest.into_iter().fold(Fastest::default(), Fastest::and)
}

impl<const D: usize> Slab<'_, D> {
    /// `to` are node records from storage index `first` on.
    #[inline(always)]
    fn run(
        self,
        geometry: &GridGeometry<D>,
        shape: impl ShapeFunction,
        from: &[NodeRecord],
        dt: f64,
        mut to: Option<(usize, &mut [RemapRecord])>,
    ) {
        let mut momenta = [f64x4::splat(0.0); BLOCK];
        let mut fastest = Fastest::default();
        let positions = self.position.chunks(BLOCK).zip(self.mass.chunks(BLOCK));
        let changing = self.velocity.chunks_mut(BLOCK).zip(self.displacement.chunks_mut(BLOCK));
        for ((positions, masses), (velocities, displacements)) in positions.zip(changing) {
            let weights = BlockWeights::<1>::new(geometry, shape, positions);
            let changed = velocities.iter_mut().zip(displacements).zip(masses);
            for (k, ((velocity, displacement), mass)) in changed.enumerate() {
                let nodes = &from[weights.first[k]..];
                let sum = gather(nodes, geometry.stride, &weights, k, D);
                let moved = (sum * f64x8::splat(dt)).to_array();
                *velocity += SVector::from_fn(|d, _| moved[ACCELERATION + d]);
                *displacement = SVector::from_fn(|d, _| moved[VELOCITY + d]);
                fastest.include(velocity, displacement);
                momenta[k] = momentum(*mass, velocity);
            }
            if let Some((first, to)) = &mut to {
                let momenta = &momenta[..positions.len()];
                add_block(to, *first, geometry.stride, &weights, momenta, D);
            }
        }
        *self.fastest = fastest;
    }
}

/// Weighted sum of the node records of point `k`.
#[inline(always)]
fn gather(
    nodes: &[NodeRecord],
    stride: [usize; 3],
    weights: &BlockWeights<1>,
    k: usize,
    dimension: usize,
) -> f64x8 {
    let weight = |lanes: &f64x8| f64x8::splat(lanes.as_array()[k]);
    let [x0, x1, x2] = &weights.x[0];
    let [x0, x1, x2] = [weight(x0), weight(x1), weight(x2)];
    let [rows, planes] = weights.extent(k, k + 1, dimension);
    let mut total = f64x8::splat(0.0);
    for c in 0..planes {
        for b in 0..rows {
            let start = b * stride[1] + c * stride[2];
            let row = &nodes[start..start + 3];
            let [n0, n1, n2] = [f64x8::from(row[0]), f64x8::from(row[1]), f64x8::from(row[2])];
            let along = n0.mul_add(x0, n1.mul_add(x1, n2 * x2));
            total = along.mul_add(weight(&weights.rows[c][b][0]), total);
        }
    }
    total
}
