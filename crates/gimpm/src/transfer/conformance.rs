//! What every transfer must satisfy, as one macro.

/// Defines a function `$name` that checks a `PointTransfer` on points of a plane grid,
/// with linear weights: a velocity that is the same at all nodes reaches the point
/// whole and leaves no affine part; what a point gives to its nodes sums to its
/// momentum; an affine part that is kept is given back, and its moments are those of
/// the nodal velocities. Write `#[test]` before the name.
macro_rules! transfer_conformance {
    ($(#[$attribute:meta])* $name:ident, $transfer:expr) => {
        $(#[$attribute])*
        fn $name() {
            use crate::transfer::PointTransfer;
            fn check<T: PointTransfer>(transfer: T) {
                use nalgebra::{Matrix2, SVector};
                for k in 0..50 {
                    let place = [0.3 + 0.008 * f64::from(k), 0.71 - 0.007 * f64::from(k)];
                    let stencil = crate::stencil::PointStencil::of_cell(place, 0.5);
                    let field = |v: SVector<f64, 2>, c: Matrix2<f64>, dt: f64| {
                        stencil.entries().iter().map(move |e| {
                            let w = v + c * SVector::from([e.offset[0], e.offset[1]]);
                            [1.0, w[0], w[1], 0.0, w[0] / dt, w[1] / dt, 0.0, 0.0]
                        }).collect::<Vec<_>>()
                    };
                    let (v, dt) = (SVector::from([1.5, -0.5]), 0.1);
                    let (mut velocity, mut kept) = (SVector::zeros(), Matrix2::zeros());
                    let nodes = field(v, Matrix2::zeros(), dt);
                    transfer.gather(&stencil, &nodes, dt, &mut velocity, &mut kept);
                    assert!((velocity - v).norm() < 1e-14, "{velocity}");
                    assert!(transfer.gradient(&kept, &stencil).norm() < 1e-12, "{kept}");

                    let c = Matrix2::new(0.3, -2.0, 1.5, 0.7);
                    let given = transfer.gradient(&transfer.keep(&c, &stencil), &stencil);
                    let mut sum = SVector::<f64, 2>::zeros();
                    for e in stencil.entries() {
                        let d = SVector::from([e.offset[0], e.offset[1]]);
                        sum += (v + given * d) * e.value;
                    }
                    assert!((sum - v).norm() < 1e-14, "momentum {sum}");
                    if T::AFFINE {
                        assert!((given - c).norm() < 1e-12, "{given}");
                        let nodes = field(v, c, dt);
                        velocity = SVector::zeros();
                        transfer.gather(&stencil, &nodes, dt, &mut velocity, &mut kept);
                        assert!((transfer.gradient(&kept, &stencil) - c).norm() < 1e-12);
                        let mut moments = Matrix2::zeros();
                        for (e, node) in stencil.entries().iter().zip(&nodes) {
                            for i in 0..2 {
                                for j in 0..2 {
                                    moments[(i, j)] += e.value * node[1 + i] * e.offset[j];
                                }
                            }
                        }
                        let difference = transfer.moments(&kept, &stencil) - moments;
                        assert!(difference.norm() < 1e-12, "{difference}");
                    } else {
                        assert_eq!(given, Matrix2::zeros());
                    }
                }
            }
            check($transfer);
        }
    };
}
pub(crate) use transfer_conformance;
