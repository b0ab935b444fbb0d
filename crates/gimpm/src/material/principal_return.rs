//! Return of a principal stress onto the surface of [`DruckerPrager`].
//!
//! The elastic set is `f = α I1 + √J2 - k <= 0` and `σ_i <= f_t`. In the order
//! `σ1 >= σ2 >= σ3` the plastic strain comes from the cone, from one, two or
//! three of the tension planes, or from both; each of the six cases is solved
//! exactly and the one with non-negative multipliers whose stress is admissible
//! is the return (Koiter 1953; de Souza Neto, Perić and Owen, Computational
//! Methods for Plasticity, 2008, chapter 8).
//!
//! [`DruckerPrager`]: super::DruckerPrager

/// Constants of the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct PrincipalReturn {
    /// Bulk modulus K (Pa).
    pub bulk_modulus: f64,
    /// Shear modulus μ (Pa).
    pub shear_modulus: f64,
    /// Friction α of the cone.
    pub friction: f64,
    /// Dilatancy β of the plastic potential `β I1 + √J2`.
    pub dilatancy: f64,
    /// Cohesion k of the cone (Pa).
    pub cohesion: f64,
    /// Tensile strength f_t (Pa).
    pub tensile_strength: f64,
}

/// A case of the return: its stress, and the least of its multipliers (as a
/// strain; negative ones are not admissible).
struct Case {
    stress: [f64; 3],
    least_multiplier: f64,
}

fn first_invariant(s: &[f64; 3]) -> f64 {
    s[0] + s[1] + s[2]
}

fn deviator(s: &[f64; 3]) -> [f64; 3] {
    s.map(|x| x - first_invariant(s) / 3.0)
}

/// √J2 of a deviator.
fn shear_radius(s: &[f64; 3]) -> f64 {
    (0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2])).sqrt()
}

impl PrincipalReturn {
    /// Cone function `α I1 + √J2 - k` (Pa).
    fn cone(&self, stress: &[f64; 3]) -> f64 {
        self.friction * first_invariant(stress) + shear_radius(&deviator(stress)) - self.cohesion
    }

    /// How far outside the elastic set a stress is (Pa); not above 0 inside.
    pub(super) fn violation(&self, stress: &[f64; 3]) -> f64 {
        let largest = stress[0].max(stress[1]).max(stress[2]);
        self.cone(stress).max(largest - self.tensile_strength)
    }

    /// The admissible stress that a trial stress, largest first, returns to.
    pub(super) fn project(&self, trial: &[f64; 3]) -> [f64; 3] {
        if self.violation(trial) <= 0.0 {
            return *trial;
        }
        let tolerance = 1e-11 * self.cohesion;
        // The simplest first. The two vertices are on the surface whatever the
        // trial stress, so that round-off between two cases finds no gap.
        let cases = [
            self.cone_alone(trial),
            Some(self.one_plane(trial)),
            self.cone_and_plane(trial),
            Some(self.two_planes(trial)),
            Some(self.cone_and_two_planes(trial)),
        ];
        let mut best = self.three_planes(trial);
        for case in cases.into_iter().flatten() {
            if best.least_multiplier >= 0.0 {
                break;
            }
            if self.violation(&case.stress) <= tolerance
                && case.least_multiplier > best.least_multiplier
            {
                best = case;
            }
        }
        best.stress
    }

    /// Elastic strain of a principal stress.
    pub(super) fn strain(&self, stress: &[f64; 3]) -> [f64; 3] {
        let mean = first_invariant(stress) / (9.0 * self.bulk_modulus);
        deviator(stress).map(|s| s / (2.0 * self.shear_modulus) + mean)
    }

    /// `(λ, λ + 2μ)`: lateral and axial stiffness of a plane's return.
    fn confined(&self) -> (f64, f64) {
        let lambda = self.bulk_modulus - 2.0 / 3.0 * self.shear_modulus;
        (lambda, lambda + 2.0 * self.shear_modulus)
    }

    /// The cone: `γ = f/(9Kαβ + μ)`; none beyond its apex.
    fn cone_alone(&self, trial: &[f64; 3]) -> Option<Case> {
        let (k, mu) = (self.bulk_modulus, self.shear_modulus);
        let shear = deviator(trial);
        let radius = shear_radius(&shear);
        let multiplier = self.cone(trial) / (9.0 * k * self.friction * self.dilatancy + mu);
        let left = radius - mu * multiplier;
        let mean = first_invariant(trial) / 3.0 - 3.0 * k * self.dilatancy * multiplier;
        let stress = shear.map(|s| s * (left / radius) + mean);
        (left > 0.0).then_some(Case { stress, least_multiplier: multiplier })
    }

    /// The plane of the largest stress.
    fn one_plane(&self, trial: &[f64; 3]) -> Case {
        let (lateral, axial) = self.confined();
        let multiplier = (trial[0] - self.tensile_strength) / axial;
        let drop = lateral * multiplier;
        let stress = [self.tensile_strength, trial[1] - drop, trial[2] - drop];
        Case { stress, least_multiplier: multiplier }
    }

    /// The planes of the two largest stresses: an edge.
    fn two_planes(&self, trial: &[f64; 3]) -> Case {
        let (lateral, axial) = self.confined();
        let tension = self.tensile_strength;
        let excess = [trial[0] - tension, trial[1] - tension];
        let sum = (excess[0] + excess[1]) / (axial + lateral);
        let difference = (excess[0] - excess[1]) / (axial - lateral);
        let stress = [tension, tension, trial[2] - lateral * sum];
        Case { stress, least_multiplier: 0.5 * (sum - difference.abs()) }
    }

    /// All three planes: the apex of the tension cut-off.
    fn three_planes(&self, trial: &[f64; 3]) -> Case {
        let multipliers = self.strain(&trial.map(|t| t - self.tensile_strength));
        let least_multiplier = multipliers.into_iter().fold(f64::INFINITY, f64::min);
        Case { stress: [self.tensile_strength; 3], least_multiplier }
    }

    /// Cone and the plane of the largest stress. Taking out the plane's part
    /// first leaves a return to the cone, so that one unknown is left: the
    /// plane's multiplier that makes the largest stress f_t.
    fn cone_and_plane(&self, trial: &[f64; 3]) -> Option<Case> {
        let (lateral, axial) = self.confined();
        let reached = |multiplier: f64| {
            let drop = [axial * multiplier, lateral * multiplier, lateral * multiplier];
            self.cone_alone(&core::array::from_fn(|k| trial[k] - drop[k]))
        };
        // Beyond the apex of the cone there is too much tension left.
        let too_little = |multiplier: f64| {
            reached(multiplier).is_none_or(|case| case.stress[0] > self.tensile_strength)
        };
        let (mut low, mut high) = (0.0, (trial[0] - self.tensile_strength) / axial);
        if high <= 0.0 || !too_little(low) || too_little(high) {
            return None;
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if too_little(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let case = reached(high)?;
        Some(Case { least_multiplier: case.least_multiplier.min(high), ..case })
    }

    /// Cone and two planes: the vertex `σ1 = σ2 = f_t` on the cone.
    fn cone_and_two_planes(&self, trial: &[f64; 3]) -> Case {
        let (tension, slope) = (self.tensile_strength, 1.0 / 3.0_f64.sqrt());
        let sides = (2.0 * self.friction + slope) * tension - self.cohesion;
        let stress = [tension, tension, sides / (slope - self.friction)];
        let plastic = self.strain(&core::array::from_fn(|k| trial[k] - stress[k]));
        // The cone's flow at the vertex is (β + 1/(2√3)) twice and β - 1/√3.
        let cone = plastic[2] / (self.dilatancy - slope);
        let plane = plastic[0].min(plastic[1]) - cone * (self.dilatancy + 0.5 * slope);
        Case { stress, least_multiplier: cone.min(plane) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn surface(dilatancy_ratio: f64) -> PrincipalReturn {
        let friction = 0.07;
        PrincipalReturn {
            bulk_modulus: 16.7e9,
            shear_modulus: 12.5e9,
            friction,
            dilatancy: dilatancy_ratio * friction,
            cohesion: 30.0e6 * (1.0 / 3.0_f64.sqrt() - friction),
            tensile_strength: 3.0e6,
        }
    }

    proptest! {
        /// From anywhere the return lies on the surface and keeps the order; for
        /// associated flow it is the nearest admissible stress in the energy norm:
        /// the plastic strain makes an obtuse angle with the way to any other
        /// admissible stress (Hill's principle).
        #[test]
        fn lands_on_the_surface_at_the_nearest_point(
            trial in proptest::array::uniform3(-3.0e8..3.0e8f64),
            other in proptest::array::uniform3(-6.0e7..3.0e6f64),
            ratio in prop_oneof![Just(1.0), Just(0.0), 0.0..1.0f64],
        ) {
            let mut trial = trial;
            trial.sort_by(|a, b| b.total_cmp(a));
            let law = surface(ratio);
            let outside = law.violation(&trial) > 0.0;
            let stress = law.project(&trial);
            if outside {
                prop_assert!(law.violation(&stress).abs() < 1e-9 * 30.0e6, "{stress:?}");
            } else {
                prop_assert_eq!(stress, trial);
            }
            prop_assert!(stress[0] >= stress[1] - 1e-3 && stress[1] >= stress[2] - 1e-3);
            let plastic = law.strain(&core::array::from_fn(|k| trial[k] - stress[k]));
            let work: f64 = (0..3).map(|k| plastic[k] * stress[k]).sum();
            prop_assert!(work >= -1e-9, "{work}");
            if ratio == 1.0 && law.violation(&other) <= 0.0 {
                let angle: f64 = (0..3).map(|k| plastic[k] * (other[k] - stress[k])).sum();
                prop_assert!(angle <= 1e-6, "{angle}");
            }
        }
    }

    #[test]
    fn each_corner_is_reached() {
        let law = surface(1.0);
        let ft = 3.0e6;
        assert_eq!(law.project(&[2.0e7, 2.0e7, 2.0e7]), [ft; 3]);
        let edge = law.project(&[2.0e7, 2.0e7, -1.0e6]);
        assert_eq!(edge[..2], [ft; 2]);
        assert!(edge[2] < ft && law.cone(&edge) < 0.0);
        // A trial stress that lies beyond the vertex by construction: cone and
        // planes flow by 1e-4 each.
        let slope = 1.0 / 3.0_f64.sqrt();
        let sides = (2.0 * law.friction + slope) * ft - law.cohesion;
        let vertex = [ft, ft, sides / (slope - law.friction)];
        let axis = 1e-4 * (law.dilatancy + 0.5 * slope + 1.0);
        let flow = [axis, axis, 1e-4 * (law.dilatancy - slope)];
        let lateral = law.confined().0 * (flow[0] + flow[1] + flow[2]);
        let beyond = |k: usize| vertex[k] + lateral + 2.0 * law.shear_modulus * flow[k];
        let found = law.project(&core::array::from_fn(beyond));
        assert!((0..3).all(|k| (found[k] - vertex[k]).abs() < 1e-6), "{found:?} {vertex:?}");
        assert!(law.cone(&vertex).abs() < 1e-7, "{}", law.cone(&vertex));
        let ridge = law.project(&[6.0e7, -1.0e7, -5.0e7]);
        assert!((ridge[0] - ft).abs() < 1e-6 && law.cone(&ridge).abs() < 1e-6, "{ridge:?}");
        assert!(ridge[1] < ft);
    }
}
