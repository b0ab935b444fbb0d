//! Where to look from so that the whole scene is in view.

use super::frame::PointCloud;

/// Half the viewer's vertical field of view (55°), as a tangent.
const HALF_VIEW: f64 = 0.52;

/// Width over height of the 3D pane.
const ASPECT: f64 = 1.25;

/// Room around a plane scene. A box seen from an angle leaves room by itself.
const MARGIN: f64 = 1.12;

/// Corners of the box around all points.
pub type Bounds = ([f64; 3], [f64; 3]);

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it is (m).
    pub position: [f64; 3],
    /// What it looks at (m).
    pub target: [f64; 3],
    /// Which way is up.
    pub up: [f64; 3],
}

/// The box around all points of `clouds`, if there are any.
pub fn bounds<'a>(clouds: impl IntoIterator<Item = &'a PointCloud>) -> Option<Bounds> {
    let mut points = clouds.into_iter().flat_map(|cloud| &cloud.position);
    let first = *points.next()?;
    Some(points.fold((first, first), |(mut low, mut high), point| {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
        (low, high)
    }))
}

impl Camera {
    /// In two dimensions straight along -z; in three from the front (−y), a
    /// little from the left and above, with z up.
    pub fn facing((low, high): Bounds, dimension: usize) -> Self {
        let centre: [f64; 3] = std::array::from_fn(|i| 0.5 * (low[i] + high[i]));
        let size: [f64; 3] = std::array::from_fn(|i| (high[i] - low[i]).max(1e-6));
        let (direction, width, height, depth, up) = if dimension == 2 {
            ([0.0, 0.0, 1.0], size[0], size[1], 0.0, [0.0, 1.0, 0.0])
        } else {
            let direction = unit([-0.35, -1.0, 0.55]);
            let width = size[0] * 0.94 + size[1] * 0.33;
            let height = size[2] * 0.9 + size[1] * 0.45;
            (direction, width, height, size[1], [0.0, 0.0, 1.0])
        };
        let fit = (0.5 * width / ASPECT).max(0.5 * height) / HALF_VIEW;
        let distance = if dimension == 2 { MARGIN * fit } else { 0.9 * fit + 0.5 * depth };
        let position = std::array::from_fn(|i| centre[i] + distance * direction[i]);
        Self { position, target: centre, up }
    }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_scene_fits_between_the_edges_of_the_view() {
        let camera = Camera::facing(([0.0, 0.0, 0.0], [4.0, 1.0, 0.0]), 2);
        assert_eq!(camera.target, [2.0, 0.5, 0.0]);
        let distance = camera.position[2];
        assert!(distance * HALF_VIEW * ASPECT > 2.0 && distance * HALF_VIEW > 0.5);
    }
}
