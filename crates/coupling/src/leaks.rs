use kiddo::{ImmutableKdTree, SquaredEuclidean};
use nalgebra::SVector;

use crate::StructurePoints;

/// Number of fluid positions closer than `distance` (m) to a structure point.
///
/// A fluid particle rests about one spacing from the nearest point; one that is
/// nearer than half a spacing has entered the solid. Leaks are counted, not
/// repaired: a count above zero asks for a finer solid or a higher speed of sound.
pub fn count_leaks<const D: usize>(
    fluid: &[SVector<f64, D>],
    structure: &StructurePoints<D>,
    distance: f64,
) -> usize {
    if structure.position.is_empty() {
        return 0;
    }
    let points: Vec<[f64; D]> = structure.position.iter().map(|&x| x.into()).collect();
    let Ok(tree) = ImmutableKdTree::<f64, D>::new_from_slice(&points) else {
        // Positions were checked finite by the solid, and points of one body never coincide.
        return 0;
    };
    let (lower, upper) = bounds(&structure.position, distance);
    fluid
        .iter()
        .filter(|x| (0..D).all(|axis| (lower[axis]..=upper[axis]).contains(&x[axis])))
        .filter(|&&x| {
            let at: [f64; D] = x.into();
            let nearest = tree.query(&at).nearest_one::<SquaredEuclidean<f64>>().execute();
            nearest.distance < distance * distance
        })
        .count()
}

/// Box around `points`, widened by `margin`: most of the fluid is outside.
fn bounds<const D: usize>(
    points: &[SVector<f64, D>],
    margin: f64,
) -> (SVector<f64, D>, SVector<f64, D>) {
    let (mut lower, mut upper) =
        (SVector::repeat(f64::INFINITY), SVector::repeat(f64::NEG_INFINITY));
    for point in points {
        lower = SVector::inf(&lower, point);
        upper = SVector::sup(&upper, point);
    }
    (lower.add_scalar(-margin), upper.add_scalar(margin))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_particles_inside_the_distance_count() {
        let structure = StructurePoints::<2> {
            position: vec![SVector::from([0.0, 0.0]), SVector::from([1.0, 0.0])],
            ..Default::default()
        };
        let fluid = [[0.05, 0.0], [0.2, 0.0], [1.0, 0.09], [5.0, 5.0]].map(SVector::from);
        assert_eq!(count_leaks(&fluid, &structure, 0.1), 2);
        assert_eq!(count_leaks(&fluid, &StructurePoints::default(), 0.1), 0);
    }
}
