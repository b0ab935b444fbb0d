//! Which nodes two bodies share, and which points lie around them.

use std::ops::Range;

use nalgebra::SVector;
use rayon::prelude::*;

use super::separation::NearPoint;
use crate::grid::{GridGeometry, NodeRecord};
use crate::grid_momentum::NODES_PER_TASK;
use crate::points::Points;
use crate::slabs::Slabs;

/// Distance along an axis up to which a point counts as near a node, in cells:
/// that at which uGIMP's widest box still has a weight.
const REACH: f64 = 1.5;
const UNMARKED: u32 = u32::MAX;

/// Place of each shared node in the list of them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Marks {
    place: Vec<u32>,
}

/// The points of one body near each node of a list.
pub(crate) struct Nearby {
    offsets: Vec<usize>,
    points: Vec<u32>,
}

impl Nearby {
    /// Fills `cloud` with the points near the node at a place in the list.
    pub fn cloud<const D: usize>(
        &self,
        place: usize,
        node: &SVector<f64, D>,
        geometry: &GridGeometry<D>,
        half_edge: f64,
        points: &Points<D>,
        cloud: &mut Vec<NearPoint<D>>,
    ) {
        let near = &self.points[self.offsets[place]..self.offsets[place + 1]];
        cloud.clear();
        cloud.extend(near.iter().map(|&p| {
            let p = p as usize;
            let offset = (points.position[p] - node) * geometry.inverse_spacing;
            let weight = offset.iter().map(|along| (REACH - along.abs()).max(0.0)).product();
            let deformation = points.deformation_gradient[p].fixed_view::<D, D>(0, 0);
            NearPoint { offset, weight, half_edges: deformation * half_edge }
        }));
    }
}

/// Nodes that the points of a body can touch.
fn touched<const D: usize>(
    geometry: &GridGeometry<D>,
    (slabs, slab_offsets): (Slabs, &[usize]),
) -> Range<usize> {
    let filled = |slab: &usize| slab_offsets[*slab] < slab_offsets[slab + 1];
    let mut occupied = (0..slab_offsets.len() - 1).filter(filled);
    let Some(first) = occupied.next() else { return 0..0 };
    let last = occupied.next_back().unwrap_or(first);
    slabs.window(geometry, first, last)
}

/// A node where one body has less than this share of the mass is left alone. What
/// its impulse could change is as small a share of a point's velocity; such nodes
/// lie a cell beyond the surface, see little of it and are three times as many.
const SMALLEST_SHARE: f64 = 1e-3;

/// Nodes at which both bodies have mass (G30), in order.
pub(crate) fn shared_nodes<const D: usize>(
    geometry: &GridGeometry<D>,
    bodies: [(Slabs, &[usize]); 2],
    records: [&[NodeRecord]; 2],
    mass_cut: f64,
) -> Vec<usize> {
    let [first, second] = bodies.map(|body| touched(geometry, body));
    let range = first.start.max(second.start)..first.end.min(second.end);
    if range.is_empty() {
        return Vec::new();
    }
    let [first, second] = records.map(|records| records[range.clone()].par_chunks(NODES_PER_TASK));
    first
        .zip(second)
        .enumerate()
        .flat_map_iter(|(task, (first, second))| {
            let start = range.start + task * NODES_PER_TASK;
            let shared = |k: &usize| {
                let (first, second) = (first[*k][0], second[*k][0]);
                let lighter = first.min(second);
                lighter > mass_cut && lighter >= SMALLEST_SHARE * (first + second)
            };
            (0..first.len()).filter(shared).map(move |k| start + k)
        })
        .collect()
}

impl Marks {
    /// Marks the nodes of a list while `run` runs.
    pub fn with<R>(
        &mut self,
        node_count: usize,
        nodes: &[usize],
        run: impl FnOnce(&Self) -> R,
    ) -> R {
        self.place.resize(node_count, UNMARKED);
        nodes.iter().enumerate().for_each(|(place, &node)| self.place[node] = place as u32);
        let result = run(self);
        nodes.iter().for_each(|&node| self.place[node] = UNMARKED);
        result
    }

    /// Points of a body near each marked node, in storage order.
    pub fn gather<const D: usize>(
        &self,
        nodes: &[usize],
        geometry: &GridGeometry<D>,
        slab_offsets: &[usize],
        points: &Points<D>,
    ) -> Nearby {
        let window = Window::around(geometry, nodes);
        let found: Vec<(u32, u32)> = slab_offsets
            .par_windows(2)
            .flat_map_iter(|slab| {
                let window = &window;
                (slab[0]..slab[1])
                    .filter(move |&p| window.holds(geometry, &points.position[p]))
                    .flat_map(move |p| {
                        self.near(geometry, &points.position[p]).map(move |place| (place, p as u32))
                    })
            })
            .collect();
        group(nodes.len(), &found)
    }

    /// Places of the marked nodes near a position.
    fn near<const D: usize>(
        &self,
        geometry: &GridGeometry<D>,
        position: &SVector<f64, D>,
    ) -> impl Iterator<Item = u32> {
        let along = SVector::<f64, D>::from_fn(|d, _| geometry.coordinate(position, d));
        (0..3_usize.pow(D as u32)).filter_map(move |mut k| {
            let mut node = 0;
            for d in 0..D {
                let index = along[d].round() as i64 + (k % 3) as i64 - 1;
                k /= 3;
                if (along[d] - index as f64).abs() >= REACH {
                    return None;
                }
                node += geometry.stored_index(index, d)? * geometry.stride[d];
            }
            self.place.get(node).copied().filter(|&place| place != UNMARKED)
        })
    }
}

/// Sorts the points by place, stably.
fn group(places: usize, found: &[(u32, u32)]) -> Nearby {
    let mut offsets = vec![0; places + 1];
    found.iter().for_each(|(place, _)| offsets[*place as usize + 1] += 1);
    (0..places).for_each(|place| offsets[place + 1] += offsets[place]);
    let mut next = offsets.clone();
    let mut points = vec![0; found.len()];
    for (place, point) in found {
        let slot = &mut next[*place as usize];
        points[*slot] = *point;
        *slot += 1;
    }
    Nearby { offsets, points }
}

/// The box, in cells, outside which no point is near any node of a list.
struct Window<const D: usize> {
    lower: SVector<f64, D>,
    upper: SVector<f64, D>,
}

impl<const D: usize> Window<D> {
    fn around(geometry: &GridGeometry<D>, nodes: &[usize]) -> Self {
        let mut window =
            Self { lower: SVector::repeat(f64::INFINITY), upper: SVector::repeat(-f64::INFINITY) };
        for &node in nodes {
            let position = geometry.node_position(node);
            for d in 0..D {
                let along = geometry.coordinate(&position, d);
                window.lower[d] = window.lower[d].min(along - REACH);
                window.upper[d] = window.upper[d].max(along + REACH);
            }
        }
        window
    }

    fn holds(&self, geometry: &GridGeometry<D>, position: &SVector<f64, D>) -> bool {
        (0..D).all(|d| {
            let along = geometry.coordinate(position, d);
            along >= self.lower[d] && along <= self.upper[d]
        })
    }
}
