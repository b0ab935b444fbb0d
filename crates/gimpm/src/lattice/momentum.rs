//! Equations (5) and (6), and the momentum for (7) and for the next step's (1).

use nalgebra::SVector;

use super::assembly::clear;
use super::pattern::{CORNERS, Pattern};
use super::slabs::{scatter, split};
use super::{Block, Lattice};
use crate::grid::{ACCELERATION, Grid, NodeRecord, RemapRecord, VELOCITY};
use crate::lanes::{BLOCK, Lanes};
use crate::points::Points;
use crate::real::Real;

/// What one task changes.
struct Motion<'a, const D: usize> {
    blocks: &'a [Block],
    /// First point of the slab.
    first: usize,
    velocity: &'a mut [SVector<f64, D>],
    position: &'a mut [SVector<f64, D>],
    /// Square of the largest speed, NaN if any speed is.
    speed_squared: f64,
}

impl<const D: usize> Lattice<D> {
    /// New velocity (G11) and position (G12) of the points, their momentum on the
    /// nodes and their largest speed in one sweep. Positions may move at once: the
    /// weights are those of the reference state.
    pub fn grid_to_points(&mut self, points: &mut Points<D>, grid: &Grid<D>, dt: f64) {
        let range = self.start..self.start + self.count;
        let velocity = split(&self.slabs, &mut points.velocity[range.clone()]);
        let position = split(&self.slabs, &mut points.position[range]);
        let mut tasks: Vec<Motion<'_, D>> = self
            .slabs
            .iter()
            .zip(velocity.zip(position))
            .map(|(slab, (velocity, position))| Motion {
                blocks: &self.blocks[slab.blocks.clone()],
                first: slab.points.start,
                velocity,
                position,
                speed_squared: 0.0,
            })
            .collect();
        let (patterns, corner, mass) = (&self.patterns, &self.corner, self.point_mass);
        clear(&mut self.momentum.records);
        scatter(&mut tasks, self.plane, &mut self.momentum.records, |task, first, records| {
            let (mut fastest, mut trouble) = (Lanes::splat(0.0), Lanes::splat(0.0));
            for block in task.blocks {
                let pattern = &patterns[block.pattern as usize];
                let points = block.range(task.first);
                let velocity = &mut task.velocity[points.clone()];
                let position = &mut task.position[points];
                let squared = advance(
                    &grid.nodes[block.node as usize..],
                    corner,
                    pattern,
                    velocity,
                    position,
                    dt,
                );
                fastest = Real::max(fastest, squared);
                trouble += squared * 0.0;
                let local = &mut records[block.node as usize - first..];
                add_momentum(local, corner, pattern, velocity, mass);
            }
            // Zero, or NaN if any speed is not finite.
            let trouble: f64 = trouble.to_array().iter().sum();
            task.speed_squared = fastest.to_array().into_iter().fold(0.0, f64::max) + trouble;
        });
        let squares = tasks.iter().map(|task| task.speed_squared);
        let larger = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
        self.maximum_speed = squares.fold(0.0, larger).sqrt();
        self.momentum.is_current = true;
    }

    /// Momentum of the nodes from the points alone, where it was not carried over.
    pub(super) fn refresh_momentum(&mut self, points: &Points<D>) {
        if self.momentum.is_current {
            return;
        }
        let velocity = &points.velocity[self.start..self.start + self.count];
        let (patterns, corner, mass) = (&self.patterns, &self.corner, self.point_mass);
        let blocks = &self.blocks;
        clear(&mut self.momentum.records);
        let records = &mut self.momentum.records;
        scatter(&mut self.slabs.clone(), self.plane, records, |slab, first, records| {
            for block in &blocks[slab.blocks.clone()] {
                let pattern = &patterns[block.pattern as usize];
                let local = &mut records[block.node as usize - first..];
                add_momentum(local, corner, pattern, &velocity[block.range(0)], mass);
            }
        });
        self.momentum.is_current = true;
    }
}

/// Moves the points of a block and returns the squares of their speeds, with the
/// points in the lanes.
#[inline(always)]
fn advance<const D: usize>(
    nodes: &[NodeRecord],
    corner: &[usize; 8],
    pattern: &Pattern,
    velocity: &mut [SVector<f64, D>],
    position: &mut [SVector<f64, D>],
    dt: f64,
) -> Lanes {
    let zero = Lanes::splat(0.0);
    let (mut speed, mut acceleration) = ([zero; D], [zero; D]);
    for v in 0..1 << D {
        let record = &nodes[corner[v]];
        for d in 0..D {
            let value = pattern.value[v];
            speed[d] = Lanes::splat(record[VELOCITY + d]).mul_add(value, speed[d]);
            acceleration[d] =
                Lanes::splat(record[ACCELERATION + d]).mul_add(value, acceleration[d]);
        }
    }
    let step = Lanes::splat(dt);
    for d in 0..D {
        speed[d] *= step;
        acceleration[d] *= step;
    }
    move_by(position, &speed);
    move_by(velocity, &acceleration);
    let mut squared = zero;
    for d in 0..D {
        let along = Lanes::from_lanes(|k| velocity.get(k).map_or(0.0, |v| v[d]));
        squared = along.mul_add(along, squared);
    }
    squared
}

/// Adds a vector to each point.
#[inline(always)]
fn move_by<const D: usize>(vectors: &mut [SVector<f64, D>], change: &[Lanes; D]) {
    let mut by_axis = [[0.0; BLOCK]; D];
    for d in 0..D {
        by_axis[d] = change[d].to_array();
    }
    match vectors.first_chunk_mut::<BLOCK>() {
        Some(vectors) => {
            for (k, vector) in vectors.iter_mut().enumerate() {
                (0..D).for_each(|d| vector[d] += by_axis[d][k]);
            }
        }
        None => {
            for (k, vector) in vectors.iter_mut().enumerate() {
                (0..D).for_each(|d| vector[d] += by_axis[d][k]);
            }
        }
    }
}

/// Adds the momentum of a block's points to the corners of its cell, with the
/// corners in the lanes.
#[inline(always)]
fn add_momentum<const D: usize>(
    records: &mut [RemapRecord],
    corner: &[usize; 8],
    pattern: &Pattern,
    velocity: &[SVector<f64, D>],
    mass: f64,
) {
    let mut sum = [Lanes::splat(0.0); D];
    for (velocity, value) in velocity.iter().zip(&pattern.corner_value) {
        for d in 0..D {
            sum[d] = Lanes::splat(velocity[d]).mul_add(*value, sum[d]);
        }
    }
    for d in 0..D {
        sum[d] *= Lanes::splat(mass);
    }
    add(records, corner, &sum);
}

/// Adds a vector to each corner of a cell.
#[inline(always)]
pub(super) fn add<const D: usize>(
    records: &mut [RemapRecord],
    corner: &[usize; 8],
    sum: &[Lanes; D],
) {
    let mut by_axis = [[0.0; CORNERS]; D];
    for d in 0..D {
        by_axis[d] = sum[d].to_array();
    }
    for v in 0..1 << D {
        let record = &mut records[corner[v]];
        (0..D).for_each(|d| record[d] += by_axis[d][v]);
    }
}

impl Block {
    /// Places of the block's points in an array that starts with point `first`.
    #[inline(always)]
    pub(super) fn range(&self, first: usize) -> std::ops::Range<usize> {
        let start = self.first as usize - first;
        start..start + self.count as usize
    }
}
