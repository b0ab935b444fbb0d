//! Manufactured solutions: a body force makes a chosen large motion exact, and the
//! error must fall with the grid (Wallstedt and Guilkey 2008; Kamojjala, Brannon,
//! Sadeghirad and Guilkey 2015). All three are neo-Hookean and in plane strain.

use std::f64::consts::PI;

use crate::lattice::{lattice, parameters, planes};
use gimpm::{BodySeed, Discretisation, Frame, InitialVelocity, NeoHookean, Shape, Solid, Transfer};
use motion::Motion;
use nalgebra::{SVector, Vector2, vector};

/// A motion with the body force per mass that makes it exact.
trait Manufactured {
    fn material(&self) -> NeoHookean;
    fn displacement(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64>;
    fn velocity(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64>;
    fn body_force(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64>;
    /// Material points at a cell width.
    fn points(&self, spacing: f64) -> Vec<Vector2<f64>>;
    /// Lower corner of a grid and its width and height (m).
    fn grid(&self) -> (Vector2<f64>, f64);
    /// The faces of the unit square at which the normal displacement vanishes.
    fn symmetric_faces(&self) -> bool {
        false
    }
    fn amplitude(&self) -> f64;
    /// The largest speed (m/s).
    fn speed(&self) -> f64 {
        PI * wave_speed(&self.material()) * self.amplitude()
    }
    fn end_time(&self) -> f64;
}

/// Lamé's constants.
fn lame(material: &NeoHookean) -> (f64, f64) {
    let (e, nu) = (material.young_modulus, material.poisson_ratio);
    (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
}

fn wave_speed(material: &NeoHookean) -> f64 {
    (material.young_modulus / material.density).sqrt()
}

/// Largest root mean square of the displacement error over the run, over the
/// amplitude of the motion.
fn error(case: &impl Manufactured, discretisation: Discretisation, spacing: f64) -> f64 {
    let material = case.material();
    let points = case.points(spacing);
    let (origin, extent) = case.grid();
    let cells = (extent / spacing).round() as usize;
    let constraints = if case.symmetric_faces() {
        let inf = f64::INFINITY;
        let held = |axis: usize| std::array::from_fn(|d| (d == axis).then_some(Motion::Fixed));
        vec![
            planes("x-", 0, -inf, 0.0, held(0)),
            planes("x+", 0, 1.0, inf, held(0)),
            planes("y-", 1, -inf, 0.0, held(1)),
            planes("y+", 1, 1.0, inf, held(1)),
        ]
    } else {
        Vec::new()
    };
    let steps = {
        let limit = 0.2 * spacing / (1.5 * wave_speed(&material) + case.speed());
        (case.end_time() / limit).ceil()
    };
    let dt = case.end_time() / steps;
    let body = BodySeed {
        name: "body".into(),
        material: material.into(),
        // The scheme is a leapfrog: velocities belong to the middle of steps.
        velocity: InitialVelocity::PerPoint(
            points.iter().map(|x| case.velocity(x, -0.5 * dt)).collect(),
        ),
        points: points.clone(),
        point_spacing: 0.5 * spacing,
        discretisation,
    };
    let parameters = parameters(spacing, origin, [cells; 2], 1.0);
    let mut solid = Solid::new(parameters, vec![body], constraints).unwrap();
    let (mut worst, mut force): (f64, Vec<SVector<f64, 2>>) = (0.0, Vec::new());
    for _ in 0..steps as usize {
        let time = solid.time();
        force.clear();
        let now = solid.points();
        force.extend((0..now.len()).map(|p| {
            let mass = 0.25 * spacing * spacing * material.density;
            case.body_force(&now.reference_position[p], time) * mass
        }));
        solid.scatter_point_force(&force);
        solid.step(dt).unwrap();
        if solid.needs_sort() {
            solid.sort_points();
        }
        let now = solid.points();
        let square: f64 = (0..now.len())
            .map(|p| {
                let exact = case.displacement(&now.reference_position[p], solid.time());
                (now.position[p] - now.reference_position[p] - exact).norm_squared()
            })
            .sum();
        worst = worst.max((square / now.len() as f64).sqrt());
    }
    worst / case.amplitude()
}

/// Errors on grids that halve, and the orders between them.
fn convergence(
    name: &str,
    case: &impl Manufactured,
    discretisation: Discretisation,
    cells: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let errors: Vec<f64> =
        cells.iter().map(|cells| error(case, discretisation, 1.0 / cells)).collect();
    let orders: Vec<f64> = errors
        .windows(2)
        .zip(cells.windows(2))
        .map(|(error, cells)| (error[0] / error[1]).ln() / (cells[1] / cells[0]).ln())
        .collect();
    println!(
        "{name}, {:?}, {:?}: errors {errors:.6?}, orders {orders:.2?}",
        discretisation.frame, discretisation.shape
    );
    (errors, orders)
}

fn total() -> Discretisation {
    Discretisation { frame: Frame::Total, ..Discretisation::default() }
}

fn updated(shape: Shape) -> Discretisation {
    Discretisation { shape, ..Discretisation::default() }
}

/// Every particle of a unit square moves along the axes:
/// `u_i = A sin(π X_i) sin(π c t + φ_i)`, φ = (0, π).
struct AxisAligned;

impl AxisAligned {
    const PHASE: [f64; 2] = [0.0, PI];

    fn swing(&self, t: f64) -> [f64; 2] {
        Self::PHASE.map(|phase| PI * wave_speed(&self.material()) * t + phase)
    }
}

impl Manufactured for AxisAligned {
    fn material(&self) -> NeoHookean {
        NeoHookean { density: 1.0, young_modulus: 1.0e4, poisson_ratio: 0.3 }
    }
    fn displacement(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let swing = self.swing(t);
        Vector2::from_fn(|i, _| self.amplitude() * (PI * x[i]).sin() * swing[i].sin())
    }
    fn velocity(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let (swing, rate) = (self.swing(t), PI * wave_speed(&self.material()));
        Vector2::from_fn(|i, _| self.amplitude() * rate * (PI * x[i]).sin() * swing[i].cos())
    }
    fn body_force(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let (material, swing) = (self.material(), self.swing(t));
        let ((lambda, mu), c) = (lame(&material), wave_speed(&material));
        let stretch: [f64; 2] = std::array::from_fn(|i| {
            1.0 + self.amplitude() * PI * (PI * x[i]).cos() * swing[i].sin()
        });
        let logarithm = (stretch[0] * stretch[1]).ln();
        let u = self.displacement(x, t);
        Vector2::from_fn(|i, _| {
            let stress = (lambda * (logarithm - 1.0) - mu) / stretch[i].powi(2);
            PI * PI * u[i] * ((mu - stress) / material.density - c * c)
        })
    }
    fn points(&self, spacing: f64) -> Vec<Vector2<f64>> {
        let count = (2.0 / spacing).round() as usize;
        lattice(Vector2::zeros(), [count; 2], 0.5 * spacing)
    }
    fn grid(&self) -> (Vector2<f64>, f64) {
        (vector![0.0, 0.0], 1.0)
    }
    fn symmetric_faces(&self) -> bool {
        true
    }
    fn amplitude(&self) -> f64 {
        0.05
    }
    fn end_time(&self) -> f64 {
        2.0 / wave_speed(&self.material())
    }
}

/// A ring, free on both circles, breathes: `u_r = A sin(π c t/(2 r_b)) (c1 R + c2 R² + c3 R³)`.
struct ExpandingRing;

impl ExpandingRing {
    const INNER: f64 = 0.4;
    const OUTER: f64 = 0.6;

    /// Angular frequency (rad/s).
    fn rate(&self) -> f64 {
        PI * wave_speed(&self.material()) / (Self::INNER + Self::OUTER)
    }

    /// f(R), f'(R), f''(R).
    fn profile(r: f64) -> [f64; 3] {
        let (inner, outer) = (Self::INNER, Self::OUTER);
        let q = outer - 3.0 * inner;
        let [c1, c2, c3] = [
            -6.0 * inner / (outer * q),
            3.0 * (outer + inner) / (outer * outer * q),
            -2.0 / (outer * outer * q),
        ];
        [
            c1 * r + c2 * r * r + c3 * r.powi(3),
            c1 + 2.0 * c2 * r + 3.0 * c3 * r * r,
            2.0 * c2 + 6.0 * c3 * r,
        ]
    }
}

/// Points whose centre lies between two circles about the origin.
fn ring_points(inner: f64, outer: f64, spacing: f64) -> Vec<Vector2<f64>> {
    let half = (outer / spacing).ceil() * spacing;
    let count = (4.0 * half / spacing).round() as usize;
    let all = lattice(vector![-half, -half], [count; 2], 0.5 * spacing);
    all.into_iter().filter(|x| (inner..=outer).contains(&x.norm())).collect()
}

impl Manufactured for ExpandingRing {
    fn material(&self) -> NeoHookean {
        NeoHookean { density: 1000.0, young_modulus: 1.0e7, poisson_ratio: 0.0 }
    }
    fn displacement(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let r = x.norm();
        x * (self.amplitude() * (self.rate() * t).sin() * Self::profile(r)[0] / r)
    }
    fn velocity(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let (r, rate) = (x.norm(), self.rate());
        x * (self.amplitude() * rate * (rate * t).cos() * Self::profile(r)[0] / r)
    }
    fn body_force(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let material = self.material();
        let ((_, mu), r, rate) = (lame(&material), x.norm(), self.rate());
        let ([f, slope, curvature], swing) =
            (Self::profile(r), self.amplitude() * (rate * t).sin());
        let (radial, hoop) = (1.0 + swing * slope, 1.0 + swing * f / r);
        let stress = |stretch: f64| mu * (stretch - 1.0 / stretch);
        let gradient = mu * (1.0 + 1.0 / (radial * radial)) * swing * curvature;
        let divergence = gradient + (stress(radial) - stress(hoop)) / r;
        x * ((-rate * rate * swing * f - divergence / material.density) / r)
    }
    fn points(&self, spacing: f64) -> Vec<Vector2<f64>> {
        ring_points(Self::INNER, Self::OUTER, spacing)
    }
    fn grid(&self) -> (Vector2<f64>, f64) {
        (vector![-1.0, -1.0], 2.0)
    }
    fn amplitude(&self) -> f64 {
        0.1
    }
    fn end_time(&self) -> f64 {
        2.0 * PI / self.rate()
    }
}

/// Every circle of a ring turns by an angle of its own,
/// `α(R, t) = A sin(π c t) (1 - 32 (R-1)² + 256 (R-1)⁴)`: shear at constant volume
/// and turns of up to a radian.
struct Vortex;

impl Vortex {
    fn rate(&self) -> f64 {
        PI * wave_speed(&self.material())
    }

    /// h(R), h'(R), h''(R).
    fn profile(r: f64) -> [f64; 3] {
        let q = r - 1.0;
        [
            1.0 - 32.0 * q * q + 256.0 * q.powi(4),
            -64.0 * q + 1024.0 * q.powi(3),
            -64.0 + 3072.0 * q * q,
        ]
    }

    fn turned(x: &Vector2<f64>, angle: f64) -> Vector2<f64> {
        let (s, c) = angle.sin_cos();
        vector![c * x[0] - s * x[1], s * x[0] + c * x[1]]
    }
}

impl Manufactured for Vortex {
    fn material(&self) -> NeoHookean {
        NeoHookean { density: 1000.0, young_modulus: 1000.0, poisson_ratio: 0.3 }
    }
    fn displacement(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        Self::turned(x, (self.rate() * t).sin() * Self::profile(x.norm())[0]) - x
    }
    fn velocity(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let h = Self::profile(x.norm())[0];
        let now = Self::turned(x, (self.rate() * t).sin() * h);
        let spin = self.rate() * (self.rate() * t).cos() * h;
        vector![-spin * now[1], spin * now[0]]
    }
    fn body_force(&self, x: &Vector2<f64>, t: f64) -> Vector2<f64> {
        let material = self.material();
        let ((_, mu), r, rate) = (lame(&material), x.norm(), self.rate());
        let ([h, slope, curvature], swing) = (Self::profile(r), (rate * t).sin());
        let spin = rate * (rate * t).cos() * h;
        let radial = -r * spin * spin + mu / material.density * r * (swing * slope).powi(2);
        let hoop = -r * rate * rate * swing * h
            - mu / material.density * swing * (3.0 * slope + r * curvature);
        let outward = Self::turned(x, swing * h) / r;
        outward * radial + vector![-outward[1], outward[0]] * hoop
    }
    fn points(&self, spacing: f64) -> Vec<Vector2<f64>> {
        ring_points(0.75, 1.25, spacing)
    }
    fn grid(&self) -> (Vector2<f64>, f64) {
        (vector![-1.5, -1.5], 3.0)
    }
    fn amplitude(&self) -> f64 {
        1.0
    }
    fn end_time(&self) -> f64 {
        0.5 / wave_speed(&self.material())
    }
}

#[test]
fn axis_aligned_motion_is_of_second_order() {
    let (errors, orders) =
        convergence("axis aligned", &AxisAligned, total(), &[12.0, 24.0, 48.0, 96.0]);
    assert!(errors[errors.len() - 1] < 1e-3, "{errors:?}");
    assert!(orders.iter().all(|order| *order >= 1.8), "{orders:?}");
}

#[test]
fn an_expanding_ring_converges_in_spite_of_its_jagged_edge() {
    let (_, orders) = convergence("ring", &ExpandingRing, total(), &[20.0, 40.0, 80.0]);
    assert!(orders.iter().all(|order| *order >= 1.0), "{orders:?}");
}

#[test]
fn a_vortex_is_of_second_order_in_the_total_frame() {
    let (_, orders) = convergence("vortex", &Vortex, total(), &[64.0, 128.0]);
    assert!(orders.iter().all(|order| *order >= 1.8), "{orders:?}");
}

#[test]
fn a_vortex_converges_with_convected_domains() {
    let cpdi = Discretisation { transfer: Transfer::Apic, ..updated(Shape::Cpdi) };
    let (_, orders) = convergence("vortex", &Vortex, cpdi, &[16.0, 32.0]);
    assert!(orders.iter().all(|order| *order >= 0.9), "{orders:?}");
}
