//! Domains that deform with their points: large stretch and shear, patch test.

use crate::lattice::{at_rest, lattice, parameters};
use gimpm::{BodySeed, Discretisation, LinearElastic, Shape, Solid, SolidState};
use nalgebra::{Matrix2, SVector};

const H: f64 = 0.1;
/// Points along each axis of the block, two a cell before it is deformed.
const ALONG: usize = 24;
const RUBBER: LinearElastic =
    LinearElastic { density: 1.0, young_modulus: 100.0, poisson_ratio: 0.0 };

/// A block uniformly deformed by `f`, without stress, at rest; `change` may set the state.
///
/// The seed holds the deformed positions, so the points are sorted as they lie.
fn deformed(
    shape: Shape,
    f: Matrix2<f64>,
    centre: [f64; 2],
    change: impl Fn(&mut SolidState<2>),
) -> Solid<2> {
    let spacing = 0.5 * H;
    let points = lattice::<2>(SVector::repeat(-0.5 * spacing * ALONG as f64), [ALONG; 2], spacing)
        .into_iter()
        .map(|x| f * x + SVector::from(centre))
        .collect();
    let seed = BodySeed {
        name: "block".into(),
        material: RUBBER.into(),
        points,
        velocity: at_rest(),
        point_spacing: spacing,
        discretisation: Discretisation { shape, ..Default::default() },
    };
    let grid = parameters::<2>(H, SVector::repeat(-4.0), [80; 2], 0.3);
    let mut solid = Solid::new(grid, vec![seed], Vec::new()).unwrap();
    let mut state = solid.state().clone();
    for gradient in &mut state.points.deformation_gradient {
        gradient.fixed_view_mut::<2, 2>(0, 0).copy_from(&f);
    }
    for volume in &mut state.points.volume {
        *volume *= f.determinant();
    }
    change(&mut state);
    solid.restore_state(state).unwrap();
    solid
}

/// Largest acceleration of a point in the middle of a block with the same stress
/// everywhere, over `|σ|/(ρ h)`: where the domains fill the body without gap, the
/// forces on its inner nodes vanish.
fn patch(shape: Shape, f: Matrix2<f64>) -> f64 {
    let centre = [0.0137, 0.0291];
    let mut solid = deformed(shape, f, centre, |state| {
        state.points.stress.fill([3.0, -1.0, 0.0, 2.0, 0.0, 0.0]);
    });
    let dt = 1e-9;
    solid.step(dt).unwrap();
    let points = solid.points();
    let inverse = f.try_inverse().unwrap();
    // A point sees nodes up to 1.7 cells away along each axis, and a node the surface up
    // to one cell away.
    let inner = |p: usize| {
        let x = points.position[p] - SVector::from(centre);
        let half = 0.25 * H * ALONG as f64;
        let beyond = (0..8).all(|k| {
            let angle = f64::from(k) * std::f64::consts::FRAC_PI_4;
            let reached = inverse * (x + SVector::from([angle.cos(), angle.sin()]) * 4.0 * H);
            reached.abs().max() < half
        });
        beyond.then(|| points.velocity[p].norm() / dt)
    };
    let seen: Vec<f64> = (0..points.len()).filter_map(inner).collect();
    assert!(!seen.is_empty());
    seen.iter().fold(0.0_f64, |a, b| a.max(*b)) * H / (3.0 * f.determinant())
}

/// cpGIMP boxes fill a body stretched along the axes, CPDI domains one deformed in any
/// way (up to half diagonals of one cell); boxes that do not follow leave gaps.
#[test]
fn uniform_stress_is_in_balance_at_large_stretch() {
    let shapes = [Shape::Linear, Shape::Ugimp, Shape::Cpgimp, Shape::Cpdi];
    for (name, f, boxes_fill) in [
        ("no stretch", Matrix2::identity(), true),
        ("stretch 2.3", Matrix2::new(2.3, 0.0, 0.0, 1.0), true),
        ("stretch 3", Matrix2::new(3.0, 0.0, 0.0, 1.0), true),
        ("stretch 2.3 and 1.7", Matrix2::new(2.3, 0.0, 0.0, 1.7), true),
        ("stretch 2.3 and shear 0.7", Matrix2::new(2.3, 0.7, 0.0, 1.0), false),
        ("stretch 2.3 turned by 30°", turned(30.0) * Matrix2::new(2.3, 0.0, 0.0, 1.0), false),
    ] {
        let force = shapes.map(|shape| patch(shape, f));
        println!("{name}: linear, uGIMP, cpGIMP, CPDI: {force:?}");
        assert!(force[3] < 1e-12, "{name}: CPDI {}", force[3]);
        assert!(!boxes_fill || force[2] < 1e-12, "{name}: cpGIMP {}", force[2]);
        assert!(f == Matrix2::identity() || force[1] > 1e-2, "{name}: uGIMP {}", force[1]);
    }
}

fn turned(degrees: f64) -> Matrix2<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Matrix2::new(cos, -sin, sin, cos)
}

/// The left half of a deformed block is given a small velocity. Returns the smallest
/// difference of velocity between the halves, over the one at the start, while a wave
/// crosses the block four times: near 1 the halves do not feel each other.
fn separation(shape: Shape, f: Matrix2<f64>) -> f64 {
    let left = |k: u32| (k as usize % ALONG) < ALONG / 2;
    let start = 1e-4;
    let mut solid = deformed(shape, f, [0.5 * H, 0.137 * H], |state| {
        for p in 0..state.points.len() {
            let speed = if left(state.points.id[p]) { start } else { 0.0 };
            state.points.velocity[p] = SVector::from([speed, 0.0]);
        }
    });
    let stretch = f[(0, 0)];
    let duration = 4.0 * stretch * 0.5 * H * ALONG as f64 / 10.0;
    let mut smallest = 1.0_f64;
    while solid.time() < duration {
        solid.step(solid.stable_time_step().unwrap().value).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
        let points = solid.points();
        let difference: f64 = (0..points.len())
            .map(|p| points.velocity[p][0] * if left(points.id[p]) { 1.0 } else { -1.0 })
            .sum();
        smallest = smallest.min(2.0 * difference / (start * points.len() as f64));
    }
    smallest
}

/// Numerical fracture. The columns of points at the middle of the block, `s` cells apart,
/// share no node when none lies within a point's reach of both: here, with a node half
/// way between nodes, from `s > 1` on for linear weights and `s > 1.5` for uGIMP (two
/// points a cell: stretch 2 and 3). Domains that follow the stretch reach on.
#[test]
fn stretched_bodies_keep_together() {
    for (stretch, linear, ugimp) in
        [(1.0, true, true), (2.5, false, true), (3.5, false, false), (4.0, false, false)]
    {
        for shear in [0.0, 1.0] {
            let f = Matrix2::new(stretch, 0.0, shear, 1.0);
            let kept = [Shape::Linear, Shape::Ugimp, Shape::Cpgimp, Shape::Cpdi]
                .map(|shape| separation(shape, f));
            println!("stretch {stretch}, shear {shear}: linear, uGIMP, cpGIMP, CPDI {kept:.3?}");
            for (kept, together) in kept.iter().zip([linear, ugimp, true, true]) {
                assert!(if together { *kept < 0.5 } else { *kept > 0.99 }, "{f}: {kept}");
            }
        }
    }
}
