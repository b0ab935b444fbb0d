//! A 2D water tank with a free or held block: the set-up of the coupling's tests.

use gimpm::{
    BodySeed, Discretisation, InitialVelocity, LinearElastic, Loops, NodeConstraint, Solid,
    SolidParameters, StressUpdate,
};
use nalgebra::{SVector, Vector2, vector};
use sph::{Dissipation, Fluid, FluidParameters, FluidSeed, WallSeed};

/// A tank of water at rest, its inner lower corner at the origin.
pub struct Tank {
    /// Inner width (m).
    pub width: f64,
    /// Water depth (m).
    pub depth: f64,
    /// Particle spacing (m).
    pub spacing: f64,
}

/// An elastic block.
pub struct Block {
    /// Lower corner (m).
    pub lower: Vector2<f64>,
    /// Upper corner (m).
    pub upper: Vector2<f64>,
    /// Density (kg/m³).
    pub density: f64,
}

const GRAVITY: f64 = 9.81;

impl Tank {
    /// c0 = 10 √(gH) (m/s).
    pub fn sound_speed(&self) -> f64 {
        10.0 * (GRAVITY * self.depth).sqrt()
    }

    /// Water in hydrostatic balance between three layers of wall, with room for `block`.
    pub fn fluid(&self, block: Option<&Block>) -> Fluid<2> {
        let dx = self.spacing;
        let c0 = self.sound_speed();
        let inside = |x: &Vector2<f64>| {
            block.is_some_and(|block| {
                (0..2).all(|axis| (block.lower[axis]..block.upper[axis]).contains(&x[axis]))
            })
        };
        let (columns, rows) = ((self.width / dx).round() as i32, (self.depth / dx).round() as i32);
        let place = |i: i32, j: i32| vector![(f64::from(i) + 0.5) * dx, (f64::from(j) + 0.5) * dx];
        let mut particles = Vec::new();
        let mut wall = Vec::new();
        for j in -4..2 * rows + 4 {
            for i in -4..columns + 4 {
                let position = place(i, j);
                if !(0..columns).contains(&i) || j < 0 {
                    wall.push(position);
                } else if j < rows && !inside(&position) {
                    let pressure = 1000.0 * GRAVITY * (self.depth - position[1]);
                    particles.push(FluidSeed {
                        position,
                        velocity: SVector::zeros(),
                        density_deviation: pressure / (c0 * c0),
                    });
                }
            }
        }
        let parameters = FluidParameters {
            gravity: vector![0.0, -GRAVITY],
            dissipation: Dissipation::Artificial { alpha: 0.02 },
            domain: (
                vector![-5.0 * dx, -5.0 * dx],
                vector![self.width + 5.0 * dx, 3.0 * self.depth],
            ),
            ..FluidParameters::water(dx, c0)
        };
        let walls = vec![WallSeed { name: "tank".into(), points: wall, motion: None }];
        Fluid::new(parameters, particles, walls).unwrap()
    }

    /// `block` with Young's modulus `young_modulus` (Pa), held by `constraints`. Points at the fluid's spacing, cells of two.
    pub fn solid(
        &self,
        block: &Block,
        young_modulus: f64,
        constraints: Vec<NodeConstraint<2>>,
    ) -> Solid<2> {
        let dx = self.spacing;
        let size = block.upper - block.lower;
        let (columns, rows) = ((size[0] / dx).round() as usize, (size[1] / dx).round() as usize);
        let points = (0..rows)
            .flat_map(|j| (0..columns).map(move |i| vector![i as f64 + 0.5, j as f64 + 0.5]))
            .map(|index: Vector2<f64>| block.lower + index * dx)
            .collect();
        let margin = (self.width / dx).ceil() as usize;
        let parameters = SolidParameters {
            gravity: vector![0.0, -GRAVITY],
            gravity_ramp: 0.0,
            stress_update: StressUpdate::ModifiedLast,
            loops: Loops::Fast,
            contact: None,
            relaxation: None,
            courant_number: 0.5,
            grid_spacing: 2.0 * dx,
            grid_origin: block.lower - SVector::repeat(2.0 * dx * margin as f64),
            grid_cells: [2 * margin + columns, 2 * margin + rows],
            damping: 0.0,
        };
        let material = LinearElastic { density: block.density, young_modulus, poisson_ratio: 0.3 };
        let body = BodySeed {
            name: "block".into(),
            material: material.into(),
            points,
            velocity: InitialVelocity::Uniform(SVector::zeros()),
            point_spacing: dx,
            discretisation: Discretisation::default(),
        };
        Solid::new(parameters, vec![body], constraints).unwrap()
    }
}
