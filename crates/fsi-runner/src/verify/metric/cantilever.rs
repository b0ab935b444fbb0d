//! A wall's crest displacement against beam theory with the measured base reactions.

use super::{Evidence, Measurement};
use crate::verify::{Series, Signal, VerifyError, Window};
use serde::Deserialize;

/// The load's distribution along the wall, of given resultant F at height a.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum LoadShape {
    /// All of it at height a. No load that only pushes bends the wall less.
    Resultant,
    /// A triangle from the base up to 3a: still water.
    Triangle,
    /// A part at the base and a part at the crest. No load that only pushes
    /// bends the wall more.
    BaseAndCrest,
}

/// Slope of the measured crest displacement over the displacement that beam
/// theory gives for the measured base force F and moment M (least squares
/// through zero over the window).
///
/// A cantilever of length L with `I = b t³/12` and `A = b t` under `q(z) ≥ 0`
/// moves by `δ = ∫ q z² (3L - z) dz / (6 E I) + M/(κ G A)`, κ = 5/6. Only
/// `F = ∫ q dz` and `M = ∫ q z dz` are measured, `a = M/F`. The kernel
/// `z² (3L - z)` is convex on 0..L, so Jensen's inequality gives
/// `M a (3L - a)/(6 E I) ≤ δ_bending ≤ M L²/(3 E I)`, the bounds for
/// [`LoadShape::Resultant`] and [`LoadShape::BaseAndCrest`]; a triangular load
/// gives `M a (0.75 L - 0.45 a)/(E I)` (for `3a ≤ L`).
///
/// Samples with F below 5 % of its largest value are left out.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CantileverCrest {
    /// Crest displacement along the load (m).
    pub displacement: Signal,
    /// Load on the wall, positive along the displacement (N).
    pub force: Signal,
    /// Moment of the load about the base, positive with the force (N m).
    pub moment: Signal,
    /// The assumed distribution.
    pub load: LoadShape,
    /// Length L (m).
    pub length: f64,
    /// Thickness t in the direction of the load (m).
    pub thickness: f64,
    /// Width b (m).
    pub width: f64,
    /// Young's modulus E (Pa).
    pub young_modulus: f64,
    /// Poisson's ratio ν.
    pub poisson_ratio: f64,
    /// The window; default all.
    #[serde(default)]
    pub window: Window,
}

impl CantileverCrest {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let read = |signal: &Signal| -> Result<Series, VerifyError> {
            evidence.histories.signal(signal)?.window(self.window)
        };
        let (displacement, force, moment) =
            (read(&self.displacement)?, read(&self.force)?, read(&self.moment)?);
        let least = 0.05 * force.maximum().0;
        let (mut up, mut down, mut counted) = (0.0, 0.0, 0_usize);
        for i in 0..force.value.len() {
            if force.value[i] > 0.0 && force.value[i] >= least {
                let predicted = self.displacement(force.value[i], moment.value[i]);
                up += displacement.value[i] * predicted;
                down += predicted * predicted;
                counted += 1;
            }
        }
        if down == 0.0 {
            return Err(VerifyError::Metric(format!(
                "`{}` never pushes the wall between {} s and {} s",
                force.name,
                force.start(),
                force.end()
            )));
        }
        Ok(Measurement {
            value: up / down,
            unit: "1".into(),
            reference: Some(1.0),
            detail: format!("{counted} samples, {:?} load", self.load),
        })
    }

    /// Crest displacement (m) for base force F (N) and moment M (N m).
    fn displacement(&self, force: f64, moment: f64) -> f64 {
        let length = self.length;
        let area = self.width * self.thickness;
        let second_moment = self.width * self.thickness.powi(3) / 12.0;
        let rigidity = self.young_modulus * second_moment;
        let shear_modulus = self.young_modulus / (2.0 * (1.0 + self.poisson_ratio));
        let arm = (moment / force).clamp(0.0, length);
        let bending = match self.load {
            LoadShape::Resultant => arm * (3.0 * length - arm) / 6.0,
            LoadShape::Triangle => arm * (0.75 * length - 0.45 * arm),
            LoadShape::BaseAndCrest => length * length / 3.0,
        };
        moment * (bending / rigidity + 1.0 / (5.0 / 6.0 * shear_modulus * area))
    }
}

#[cfg(test)]
mod tests {
    use super::{CantileverCrest, Evidence, LoadShape, Window};
    use crate::verify::{NoPoints, Signal, histories::tests::histories};
    use std::fmt::Write as _;

    fn metric(load: LoadShape) -> CantileverCrest {
        CantileverCrest {
            displacement: Signal::parse("crest.x").unwrap(),
            force: Signal::parse("-base.force_x").unwrap(),
            moment: Signal::parse("-base.moment_y").unwrap(),
            load,
            length: 5.0,
            thickness: 0.5,
            width: 1.0,
            // Plane strain: E/(1-ν²) and ν/(1-ν) take the places of E and ν.
            young_modulus: 30e9 / (1.0 - 0.04),
            poisson_ratio: 0.25,
            window: Window::All,
        }
    }

    #[test]
    fn still_water_on_a_wall_gives_the_published_deflection() {
        // 4 m of water on a wall 5 m high: F 78.480 kN/m, M 104.640 kN m/m; Timoshenko
        // 1.370198 mm, converged FEM 1.371749 mm (scikit-fem quad2, 16 elements through
        // the thickness, graded), of which the beam formula misses 0.11 %.
        let predicted = metric(LoadShape::Triangle).displacement(78_480.0, 104_640.0);
        assert!((predicted - 1.370198e-3).abs() < 1e-9, "{predicted}");
        assert!((predicted / 1.371749e-3 - 1.0).abs() < 2e-3);
    }

    #[test]
    fn the_bounds_enclose_the_triangle_and_the_uniform_load() {
        let of = |load, f, m| metric(load).displacement(f, m);
        for (f, m) in [(78_480.0, 104_640.0), (1.0, 0.3)] {
            assert!(of(LoadShape::Resultant, f, m) < of(LoadShape::Triangle, f, m));
            assert!(of(LoadShape::Triangle, f, m) < of(LoadShape::BaseAndCrest, f, m));
        }
        // Uniform load q over all of L: bending q L⁴/(8 E I), F = q L, M = q L²/2.
        let rigidity = 30e9 / 0.96 * 0.5_f64.powi(3) / 12.0;
        let shear = 12.5 / (5.0 / 6.0 * (30e9 / 0.96 / 2.5) * 0.5);
        let exact = 625.0 / (8.0 * rigidity) + shear;
        assert!(of(LoadShape::Resultant, 5.0, 12.5) < exact);
        assert!(exact < of(LoadShape::BaseAndCrest, 5.0, 12.5));
    }

    #[test]
    fn slope_of_a_wall_twice_as_soft_is_two() {
        let mut gauges =
            String::from("time [s],crest.x [m],base.force_x [N],base.moment_y [N m]\n");
        for i in 0..=50 {
            let load = 1e4 * f64::from(i * i);
            let d = 2.0 * metric(LoadShape::Resultant).displacement(load.max(1.0), load);
            writeln!(gauges, "{},{d},{},{}", f64::from(i) * 0.01, -load, -load).unwrap();
        }
        let histories = histories(&gauges, "time [s],a.b [J]\n0,1\n");
        let evidence = Evidence { histories: &histories, points: &NoPoints, references: &[] };
        let m = metric(LoadShape::Resultant).measure(&evidence).unwrap();
        assert!((m.value - 2.0).abs() < 1e-9, "{}", m.value);
        // With the sign of the reaction forgotten nothing pushes the wall.
        let mut wrong = metric(LoadShape::Resultant);
        wrong.force = Signal::parse("base.force_x").unwrap();
        assert!(wrong.measure(&evidence).is_err());
    }
}
