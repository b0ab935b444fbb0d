//! Shapes with known distances: the signed distance tells inside from outside,
//! finds shells of a given thickness and overlaps.
//!
//! Points always have three components here; in 2D the third is zero and a box
//! ignores it.

mod polygon;

use nalgebra::{Matrix3, Vector3};

pub(crate) use polygon::Polygon;

/// A point or vector; z = 0 in 2D.
pub(crate) type Point = Vector3<f64>;

/// A region of space.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Region {
    /// Axis-aligned box in the first `dimension` axes.
    Box { lower: Point, upper: Point, dimension: usize },
    /// Capped circular cylinder: `axis` is a unit vector from `base`.
    Cylinder { base: Point, axis: Point, length: f64, radius: f64 },
    /// Sphere.
    Sphere { center: Point, radius: f64 },
    /// Disc in the (x, y) plane (2D).
    Disc { center: Point, radius: f64 },
    /// Polygon in the (x, y) plane (2D).
    Polygon(Polygon),
    /// Polygon in the (x, z) plane between two values of y (3D).
    Extrusion { polygon: Polygon, from: f64, to: f64 },
    /// Regions added (`true`) and taken away in order.
    Compose(Vec<(bool, Region)>),
    /// `p ↦ rotation p + shift` applied to a region.
    Moved { region: std::boxed::Box<Region>, rotation: Matrix3<f64>, shift: Point },
}

impl Region {
    /// Distance to the surface, negative inside (m). Exact for single shapes;
    /// for compositions exact in sign and never larger in size than the true one.
    pub(crate) fn signed_distance(&self, p: &Point) -> f64 {
        match self {
            Self::Box { lower, upper, dimension } => {
                let (mut outside, mut inside) = (0.0, f64::NEG_INFINITY);
                for axis in 0..*dimension {
                    let beyond = (lower[axis] - p[axis]).max(p[axis] - upper[axis]);
                    outside += beyond.max(0.0).powi(2);
                    inside = f64::max(inside, beyond);
                }
                if inside > 0.0 { outside.sqrt() } else { inside }
            }
            Self::Cylinder { base, axis, length, radius } => {
                let along = (p - base).dot(axis);
                let across = (p - base - axis * along).norm() - radius;
                corner_distance(across, (-along).max(along - length))
            }
            Self::Sphere { center, radius } | Self::Disc { center, radius } => {
                (p - center).norm() - radius
            }
            Self::Polygon(polygon) => polygon.signed_distance([p.x, p.y]),
            Self::Extrusion { polygon, from, to } => {
                corner_distance(polygon.signed_distance([p.x, p.z]), (from - p.y).max(p.y - to))
            }
            Self::Compose(parts) => parts.iter().fold(f64::INFINITY, |distance, (add, region)| {
                let other = region.signed_distance(p);
                if *add { distance.min(other) } else { distance.max(-other) }
            }),
            Self::Moved { region, rotation, shift } => {
                region.signed_distance(&(rotation.transpose() * (p - shift)))
            }
        }
    }

    /// A box around the region; tight for single shapes.
    pub(crate) fn bounds(&self) -> (Point, Point) {
        match self {
            Self::Box { lower, upper, .. } => (*lower, *upper),
            Self::Cylinder { base, axis, length, radius } => {
                let reach = axis.map(|a| radius * (1.0 - a * a).max(0.0).sqrt());
                let top = base + axis * *length;
                (base.inf(&top) - reach, base.sup(&top) + reach)
            }
            Self::Sphere { center, radius } => {
                let reach = Point::repeat(*radius);
                (center - reach, center + reach)
            }
            Self::Disc { center, radius } => {
                let reach = Point::new(*radius, *radius, 0.0);
                (center - reach, center + reach)
            }
            Self::Polygon(polygon) => {
                let (lower, upper) = polygon.bounds();
                (Point::new(lower[0], lower[1], 0.0), Point::new(upper[0], upper[1], 0.0))
            }
            Self::Extrusion { polygon, from, to } => {
                let (lower, upper) = polygon.bounds();
                (Point::new(lower[0], *from, lower[1]), Point::new(upper[0], *to, upper[1]))
            }
            Self::Compose(parts) => {
                union(parts.iter().filter(|(add, _)| *add).map(|(_, region)| region.bounds()))
            }
            Self::Moved { region, rotation, shift } => {
                let (lower, upper) = region.bounds();
                let corners = (0..8).map(|corner| {
                    let local = Point::from_fn(|axis, _| {
                        if corner >> axis & 1 == 0 { lower[axis] } else { upper[axis] }
                    });
                    let p = rotation * local + shift;
                    (p, p)
                });
                union(corners)
            }
        }
    }

    /// Volume (in 2D area); for compositions that of the parts added, an upper bound.
    pub(crate) fn volume(&self) -> f64 {
        match self {
            Self::Box { lower, upper, dimension } => {
                (0..*dimension).map(|axis| upper[axis] - lower[axis]).product()
            }
            Self::Cylinder { length, radius, .. } => {
                std::f64::consts::PI * radius * radius * length
            }
            Self::Sphere { radius, .. } => 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
            Self::Disc { radius, .. } => std::f64::consts::PI * radius * radius,
            Self::Polygon(polygon) => polygon.area(),
            Self::Extrusion { polygon, from, to } => polygon.area() * (to - from),
            Self::Compose(parts) => {
                parts.iter().filter(|(add, _)| *add).map(|(_, region)| region.volume()).sum()
            }
            Self::Moved { region, .. } => region.volume(),
        }
    }

    /// Diameter of the largest ball inside; sampled for polygons and compositions.
    pub(crate) fn thickness(&self) -> f64 {
        match self {
            Self::Box { lower, upper, dimension } => {
                (0..*dimension).map(|axis| upper[axis] - lower[axis]).fold(f64::INFINITY, f64::min)
            }
            Self::Cylinder { length, radius, .. } => length.min(2.0 * radius),
            Self::Sphere { radius, .. } | Self::Disc { radius, .. } => 2.0 * radius,
            Self::Moved { region, .. } => region.thickness(),
            Self::Extrusion { polygon, from, to } => polygon.thickness().min(to - from),
            Self::Polygon(polygon) => polygon.thickness(),
            Self::Compose(_) => self.sampled_thickness(),
        }
    }

    fn sampled_thickness(&self) -> f64 {
        const SAMPLES: usize = 48;
        let (lower, upper) = self.bounds();
        let mut depth = 0.0;
        for index in 0..SAMPLES.pow(3) {
            let cell = [index % SAMPLES, index / SAMPLES % SAMPLES, index / SAMPLES.pow(2)];
            if cell[2] > 0 && upper.z <= lower.z {
                break;
            }
            let p = Point::from_fn(|axis, _| {
                let fraction = (cell[axis] as f64 + 0.5) / SAMPLES as f64;
                lower[axis] + fraction * (upper[axis] - lower[axis])
            });
            depth = f64::max(depth, -self.signed_distance(&p));
        }
        2.0 * depth
    }

    /// Corners if this is an axis-aligned box.
    pub(crate) fn as_box(&self) -> Option<(Point, Point)> {
        match self {
            Self::Box { lower, upper, .. } => Some((*lower, *upper)),
            _ => None,
        }
    }

    /// The region rotated, then shifted; a box that is only shifted stays a box.
    pub(crate) fn moved(self, rotation: Matrix3<f64>, shift: Point) -> Self {
        match self {
            Self::Box { lower, upper, dimension } if rotation == Matrix3::identity() => {
                Self::Box { lower: lower + shift, upper: upper + shift, dimension }
            }
            region => Self::Moved { region: region.into(), rotation, shift },
        }
    }
}

/// The box around several boxes.
pub(crate) fn union(boxes: impl IntoIterator<Item = (Point, Point)>) -> (Point, Point) {
    let nothing = (Point::repeat(f64::INFINITY), Point::repeat(f64::NEG_INFINITY));
    boxes.into_iter().fold(nothing, |(lower, upper), (l, u)| (lower.inf(&l), upper.sup(&u)))
}

/// Distance to a shape bounded across by `a` and along by `b` (both signed).
fn corner_distance(a: f64, b: f64) -> f64 {
    if a > 0.0 && b > 0.0 { a.hypot(b) } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit_box() -> Region {
        Region::Box { lower: Point::zeros(), upper: Point::repeat(1.0), dimension: 3 }
    }

    #[test]
    fn distances_are_signed_and_exact() {
        let at = |region: &Region, p: [f64; 3]| region.signed_distance(&Point::from(p));
        assert!((at(&unit_box(), [0.5, 0.5, 0.9]) + 0.1).abs() < 1e-12);
        assert!((at(&unit_box(), [2.0, 2.0, 0.5]) - 2.0_f64.sqrt()).abs() < 1e-12);
        let cylinder =
            Region::Cylinder { base: Point::zeros(), axis: Point::x(), length: 2.0, radius: 0.5 };
        assert!((at(&cylinder, [1.0, 0.0, 0.3]) + 0.2).abs() < 1e-12);
        assert!((at(&cylinder, [2.3, 0.0, 0.9]) - 0.5).abs() < 1e-12);
        assert_eq!(cylinder.bounds(), (Point::new(0.0, -0.5, -0.5), Point::new(2.0, 0.5, 0.5)));
        let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
        let moved = unit_box().moved(turn, Point::new(3.0, 0.0, 0.0));
        assert!((at(&moved, [2.5, 0.5, 0.5]) + 0.5).abs() < 1e-12);
        assert!((moved.bounds().0 - Point::new(2.0, 0.0, 0.0)).norm() < 1e-12);
        let hole = Region::Sphere { center: Point::repeat(0.5), radius: 0.25 };
        let hollow = Region::Compose(vec![(true, unit_box()), (false, hole)]);
        assert!(at(&hollow, [0.5, 0.5, 0.5]) > 0.0);
        assert!((at(&hollow, [0.5, 0.5, 0.1]) + 0.1).abs() < 1e-12);
    }

    #[test]
    fn thickness_is_the_largest_ball() {
        let slab =
            Region::Box { lower: Point::zeros(), upper: Point::new(3.0, 2.0, 0.25), dimension: 3 };
        assert_eq!(slab.thickness(), 0.25);
        let pair = Region::Compose(vec![(true, slab.clone()), (true, slab)]);
        assert!((pair.thickness() - 0.25).abs() < 0.01);
    }
}
