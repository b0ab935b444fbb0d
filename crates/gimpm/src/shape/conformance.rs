//! What every shape function must satisfy, as one macro.

/// Defines a function `$name` that checks a
/// [`ShapeFunction`](crate::ShapeFunction): partition of unity, gradients that
/// sum to zero, linear reproduction (`Σ S x_node = x`), derivative equal to the
/// finite difference of the value, no weight beyond `reach`, zero entries
/// beyond `count`, the same weights for eight points at once. Write `#[test]` before the name in a test module.
#[macro_export]
macro_rules! shape_function_conformance {
    ($(#[$attribute:meta])* $name:ident, $shape:expr) => {
        $(#[$attribute])*
        fn $name() {
            use $crate::ShapeFunction as _;
            let shape = $shape;
            let at = |x: f64, node: i32| {
                let weights = shape.weights(x);
                usize::try_from(node - weights.base)
                    .ok()
                    .filter(|slot| *slot < 3)
                    .map_or((0.0, 0.0), |slot| (weights.value[slot], weights.gradient[slot]))
            };
            for k in 0..4000 {
                let x = 2.0 + 0.0007 * f64::from(k) + 1.3e-5;
                let weights = shape.weights(x);
                assert!(weights.count == 2 || weights.count == 3);
                let (mut sum, mut gradient_sum, mut position, mut slope) = (0.0, 0.0, 0.0, 0.0);
                for slot in 0..3 {
                    let (value, gradient) = (weights.value[slot], weights.gradient[slot]);
                    let node = f64::from(weights.base) + slot as f64;
                    assert!(value > -1e-15, "negative weight {value} at {x}");
                    assert!(slot < weights.count || (value == 0.0 && gradient == 0.0));
                    assert!(value.abs() < 1e-15 || (x - node).abs() <= shape.reach() + 1e-12);
                    sum += value;
                    gradient_sum += gradient;
                    position += value * node;
                    slope += gradient * node;
                }
                assert!((sum - 1.0).abs() < 1e-14, "partition of unity at {x}: {sum}");
                assert!(gradient_sum.abs() < 1e-13, "gradient sum at {x}: {gradient_sum}");
                assert!((position - x).abs() < 1e-13, "linear reproduction at {x}: {position}");
                assert!((slope - 1.0).abs() < 1e-12, "linear slope at {x}: {slope}");
                let lanes = shape.lane_weights([x; 8].into());
                assert_eq!(lanes.base.to_array(), [f64::from(weights.base); 8]);
                assert_eq!(lanes.third, if weights.count == 3 { 0xff } else { 0 });
                for slot in 0..3 {
                    let value = lanes.value[slot].to_array()[slot];
                    let gradient = lanes.gradient[slot].to_array()[7 - slot];
                    assert!((value - weights.value[slot]).abs() < 1e-15, "lanes at {x}");
                    assert!((gradient - weights.gradient[slot]).abs() < 1e-14, "lanes at {x}");
                }
                let step = 1e-6;
                for node in weights.base..weights.base + 3 {
                    let difference = (at(x + step, node).0 - at(x - step, node).0) / (2.0 * step);
                    let exact = 0.5 * (at(x + step, node).1 + at(x - step, node).1);
                    assert!((difference - exact).abs() < 1e-6, "gradient at {x}, node {node}");
                }
            }
        }
    };
}
