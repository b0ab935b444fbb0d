//! What the weights of every point domain must satisfy, as one macro.

/// Defines a function `$name` that checks a [`PointDomain`](crate::PointDomain) in
/// two and three dimensions for sites all over a cell and deformations with
/// stretches from 0.3 to 6, shear and rotation: partition of unity, gradients that
/// sum to zero, linear reproduction of value and slope, no negative weight, no
/// node twice, no node beyond `floor(x) - 1` to `floor(x) + 2`. Write `#[test]`
/// before the name in a test module.
#[macro_export]
macro_rules! point_domain_conformance {
    ($(#[$attribute:meta])* $name:ident, $shape:expr) => {
        $(#[$attribute])*
        fn $name() {
            fn check<const D: usize>(shape: impl $crate::PointDomain) {
                let mut state = 0x2545_F491_4F6C_DD1D_u64;
                let mut random = move || {
                    state ^= state << 13;
                    state ^= state >> 7;
                    state ^= state << 17;
                    (state >> 11) as f64 / (1_u64 << 53) as f64
                };
                for case in 0..4000 {
                    let mut f = nalgebra::Matrix3::identity();
                    for d in 0..D {
                        f[(d, d)] = 0.3 * 20.0_f64.powf(random());
                    }
                    if case % 4 != 0 {
                        for (i, j) in [(0, 1), (1, 2), (0, 2)] {
                            if i < D && j < D {
                                f[(i, j)] = 2.0 * random() - 1.0;
                            }
                        }
                        let (roll, pitch) = if D == 3 { (random(), random()) } else { (0.0, 0.0) };
                        let turn = nalgebra::Rotation3::from_euler_angles(
                            6.0 * roll,
                            6.0 * pitch,
                            6.0 * random(),
                        );
                        f = turn.matrix() * f;
                    }
                    let x = nalgebra::SVector::<f64, D>::from_fn(|_, _| {
                        if case % 7 == 0 { 3.0 + (2.0 * random()).floor() } else { 3.0 + 2.0 * random() }
                    });
                    let (mut sum, mut gradient_sum) = (0.0, [0.0; 3]);
                    let (mut place, mut slope) = ([0.0; D], [[0.0; D]; D]);
                    let mut seen = Vec::new();
                    shape.for_each_weight(&x, &f, |weight: $crate::NodeWeight<D>| {
                        assert!(weight.value > -1e-15, "negative weight {weight:?}");
                        assert!(!seen.contains(&weight.node), "node twice: {weight:?}");
                        seen.push(weight.node);
                        sum += weight.value;
                        for d in 0..D {
                            let base = x[d].floor() as i32;
                            let reached = (base - 1..=base + 2).contains(&weight.node[d]);
                            assert!(weight.value == 0.0 || reached, "{weight:?} at {x:?}");
                            gradient_sum[d] += weight.gradient[d];
                            place[d] += weight.value * f64::from(weight.node[d]);
                            for e in 0..D {
                                slope[d][e] += f64::from(weight.node[d]) * weight.gradient[e];
                            }
                        }
                    });
                    assert!((sum - 1.0).abs() < 1e-13, "partition of unity: {sum}");
                    for d in 0..D {
                        assert!(gradient_sum[d].abs() < 1e-10, "gradient sum {gradient_sum:?}");
                        assert!((place[d] - x[d]).abs() < 1e-12, "{place:?}, point at {x:?}");
                        for e in 0..D {
                            let exact = if d == e { 1.0 } else { 0.0 };
                            assert!((slope[d][e] - exact).abs() < 1e-10, "slope {slope:?}");
                        }
                    }
                }
            }
            check::<2>($shape);
            check::<3>($shape);
        }
    };
}
