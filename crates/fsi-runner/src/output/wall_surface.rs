//! A triangle mesh of rigid walls from their dummy particles, for looking at.
//!
//! The particles are put on their lattice; faces between an occupied and an
//! empty cell become the surface. Faces that lie on the outer box of the wall
//! and point outwards are left out, and the viewer hides faces seen from behind:
//! so one looks into a tank from every side.

use std::collections::HashSet;

/// Triangles wound counter-clockwise around the outward normal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Corners (m).
    pub vertices: Vec<[f32; 3]>,
    /// One normal a corner.
    pub normals: Vec<[f32; 3]>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
}

type Cell = [i32; 3];

/// The inner surface of wall particles `spacing` apart (both m).
pub fn surface(points: &[[f64; 3]], spacing: f64) -> Surface {
    let mut surface = Surface::default();
    let Some(&origin) = points.first() else {
        return surface;
    };
    let cell = |point: &[f64; 3]| -> Cell {
        std::array::from_fn(|i| ((point[i] - origin[i]) / spacing).round() as i32)
    };
    let mut cells: Vec<Cell> = points.iter().map(cell).collect();
    cells.sort_unstable();
    cells.dedup();
    let occupied: HashSet<Cell> = cells.iter().copied().collect();
    let low: Cell = std::array::from_fn(|i| cells.iter().map(|c| c[i]).min().unwrap_or(0));
    let high: Cell = std::array::from_fn(|i| cells.iter().map(|c| c[i]).max().unwrap_or(0));
    for axis in 0..3 {
        for sign in [-1, 1] {
            let rim = if sign < 0 { low[axis] } else { high[axis] };
            let mut faces: Vec<Cell> = cells
                .iter()
                .filter(|cell| cell[axis] != rim && !occupied.contains(&step(**cell, axis, sign)))
                .copied()
                .collect();
            let (along, across) = ((axis + 1) % 3, (axis + 2) % 3);
            faces.sort_unstable_by_key(|face| (face[axis], face[across], face[along]));
            for run in faces.chunk_by(|a, b| step(*a, along, 1) == *b) {
                let strip = Strip { axis, sign, first: run[0], length: run.len() as i32 };
                surface.add(&strip, origin, spacing);
            }
        }
    }
    surface
}

/// Faces side by side along the axis after `axis`.
struct Strip {
    axis: usize,
    sign: i32,
    first: Cell,
    length: i32,
}

impl Surface {
    fn add(&mut self, strip: &Strip, origin: [f64; 3], spacing: f64) {
        let Strip { axis, sign, first, length } = *strip;
        let (along, across) = ((axis + 1) % 3, (axis + 2) % 3);
        let half = 0.5 * f64::from(sign);
        let corner = |a: f64, b: f64| -> [f32; 3] {
            let mut at: [f64; 3] = first.map(f64::from);
            at[axis] += half;
            at[along] += a - 0.5;
            at[across] += b - 0.5;
            std::array::from_fn(|i| (origin[i] + at[i] * spacing) as f32)
        };
        let length = f64::from(length);
        let start = self.vertices.len() as u32;
        self.vertices.extend([
            corner(0.0, 0.0),
            corner(length, 0.0),
            corner(length, 1.0),
            corner(0.0, 1.0),
        ]);
        let mut normal = [0.0; 3];
        normal[axis] = sign as f32;
        self.normals.extend([normal; 4]);
        // axis, along, across are cyclic, hence right-handed.
        let corners = if sign > 0 { [0, 1, 2, 3] } else { [3, 2, 1, 0] };
        let [a, b, c, d] = corners.map(|corner: u32| start + corner);
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }
}

fn step(mut cell: Cell, axis: usize, by: i32) -> Cell {
    cell[axis] += by;
    cell
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A closed shell of one layer around an inside of 3 x 2 x 4 cells.
    fn shell() -> Vec<[f64; 3]> {
        let mut points = Vec::new();
        for i in 0..5 {
            for j in 0..4 {
                for k in 0..6 {
                    let inside = (1..4).contains(&i) && (1..3).contains(&j) && (1..5).contains(&k);
                    if !inside {
                        points.push([i, j, k].map(|n| f64::from(n) * 0.1));
                    }
                }
            }
        }
        points
    }

    #[test]
    fn only_the_inside_of_a_shell_remains_and_its_area_is_right() {
        let surface = surface(&shell(), 0.1);
        let mut area = 0.0;
        for triangle in &surface.triangles {
            let [a, b, c] = triangle.map(|i| surface.vertices[i as usize]);
            let u: [f32; 3] = std::array::from_fn(|i| b[i] - a[i]);
            let v: [f32; 3] = std::array::from_fn(|i| c[i] - a[i]);
            let cross =
                [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            area += 0.5 * cross.iter().map(|x| x * x).sum::<f32>().sqrt();
            let normal = surface.normals[triangle[0] as usize];
            let along: f32 = (0..3).map(|i| cross[i] * normal[i]).sum();
            assert!(along > 0.0, "wound against its normal");
        }
        let expected = 2.0 * (0.3 * 0.2 + 0.2 * 0.4 + 0.3 * 0.4);
        assert!((area - expected).abs() < 1e-5, "{area} instead of {expected}");
    }
}
