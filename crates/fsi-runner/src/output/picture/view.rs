//! Parallel projection of the scene to pixels.

use super::super::view_camera::Bounds;

/// How far the view is turned to the left of straight ahead, in three dimensions (°).
const AZIMUTH: f64 = 15.0;

/// How far the view is above the horizon, in three dimensions (°).
const ELEVATION: f64 = 22.0;

/// Axes of the picture in space, and the place of the origin in the picture.
#[derive(Clone, Copy, Debug)]
pub struct View {
    right: [f64; 3],
    up: [f64; 3],
    towards: [f64; 3],
    scale: f64,
    origin: [f64; 2],
}

impl View {
    /// The xy plane in two dimensions; in three from −y, turned to −x and above.
    pub fn new(dimension: usize) -> Self {
        let ((sin_a, cos_a), (sin_e, cos_e)) = if dimension == 2 {
            ((0.0, 1.0), (1.0, 0.0))
        } else {
            (AZIMUTH.to_radians().sin_cos(), ELEVATION.to_radians().sin_cos())
        };
        Self {
            right: [cos_a, -sin_a, 0.0],
            up: [sin_a * sin_e, cos_a * sin_e, cos_e],
            towards: [-sin_a * cos_e, -cos_a * cos_e, sin_e],
            scale: 1.0,
            origin: [0.0; 2],
        }
    }

    /// Sets the scale (pixels per metre) and the pixel of the origin.
    pub fn place(&mut self, scale: f64, origin: [f64; 2]) {
        self.scale = scale;
        self.origin = origin;
    }

    /// Pixels per metre.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Column, row and nearness to the viewer, all in pixels; rows count downwards.
    pub fn project(&self, point: [f64; 3]) -> [f64; 3] {
        [
            self.origin[0] + self.scale * dot(self.right, point),
            self.origin[1] - self.scale * dot(self.up, point),
            self.scale * dot(self.towards, point),
        ]
    }

    /// A direction's components to the right, up and towards the viewer.
    pub fn turn(&self, direction: [f64; 3]) -> [f64; 3] {
        [self.right, self.up, self.towards].map(|axis| dot(axis, direction))
    }

    /// Smallest and largest distance to the right and up (m) of a box.
    pub fn extent(&self, (low, high): Bounds) -> ([f64; 2], [f64; 2]) {
        let (mut least, mut most) = ([0.0; 2], [0.0; 2]);
        for (i, axis) in [self.right, self.up].into_iter().enumerate() {
            for k in 0..3 {
                let ends = [axis[k] * low[k], axis[k] * high[k]];
                least[i] += ends[0].min(ends[1]);
                most[i] += ends[0].max(ends[1]);
            }
        }
        (least, most)
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_scene_keeps_its_axes() {
        let mut view = View::new(2);
        view.place(10.0, [5.0, 100.0]);
        let [column, row, _] = view.project([2.0, 3.0, 0.0]);
        assert!((column - 25.0).abs() < 1e-9 && (row - 70.0).abs() < 1e-9, "{column} {row}");
    }

    #[test]
    fn in_space_x_goes_right_z_goes_up_and_the_front_is_nearer() {
        let view = View::new(3);
        let [origin, x, y, z] =
            [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|p| view.project(p));
        assert!(x[0] > origin[0] + 0.9);
        assert!(z[1] < origin[1] - 0.9 && (z[0] - origin[0]).abs() < 1e-12);
        assert!(y[2] < origin[2] - 0.8);
    }
}
