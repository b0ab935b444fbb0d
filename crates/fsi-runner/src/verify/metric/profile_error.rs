//! A field of the last frame beside a profile along one axis.

use super::{Evidence, Measurement, StressComponent};
use crate::verify::{FinalPoints, Series, VerifyError};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A component of a field on the material points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Quantity {
    /// A component of the Cauchy stress (Pa).
    Stress(StressComponent),
    /// A component of the displacement (m).
    Displacement(Axis),
}

/// A coordinate axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// x.
    X,
    /// y.
    Y,
    /// z.
    Z,
}

impl Axis {
    fn index(self) -> usize {
        self as usize
    }
}

/// How the differences of all points become one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Norm {
    /// `Σ V |d| / Σ V`.
    #[default]
    Mean,
    /// `√(Σ V d² / Σ V)`.
    RootMeanSquare,
    /// `max |d|`.
    Maximum,
}

/// `norm(s_p - r(X_p)) / divide_by` over the points of a body with their reference
/// volumes (equal in a body), `X` the coordinate at the start along `along`.
///
/// The profile r is the polynomial `Σ c_k X^k`, or a reference file with X in the first
/// column, linear between its rows. With `Mean` and `divide_by` = ρ0 g l0 this is the
/// error of Coombs and Augarde 2020 (AMPLE) for a column under its own weight.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileError {
    /// The body.
    pub body: String,
    /// The field.
    pub quantity: Quantity,
    /// The axis of the profile.
    pub along: Axis,
    /// Coefficients c_0, c_1, … of the profile; left out when a file gives it.
    #[serde(default)]
    pub polynomial: Vec<f64>,
    /// Column of the reference file; default the second.
    pub column: Option<String>,
    /// The norm; default `Mean`.
    #[serde(default)]
    pub norm: Norm,
    /// Thickness of slabs across the axis (m), counted from the body's first points: their
    /// means are compared, not single points. With the grid spacing, cell means. Default none.
    pub slab: Option<f64>,
    /// Scale, in the field's unit; default the same norm of the profile itself.
    pub divide_by: Option<f64>,
}

impl ProfileError {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let points = evidence.points.final_points(&self.body)?;
        let count = points.reference_position.len();
        let profile = self.profile(evidence)?;
        let places: Vec<f64> =
            points.reference_position.iter().map(|place| place[self.along.index()]).collect();
        let (mut differences, mut references) = (Vec::new(), Vec::new());
        for (&place, value) in places.iter().zip(self.values(&points)) {
            let reference = profile.at(place)?;
            differences.push(value - reference);
            references.push(reference);
        }
        if let Some(thickness) = self.slab {
            if !(thickness.is_finite() && thickness > 0.0) {
                let message = format!("`slab` is {thickness} m; it must be above 0");
                return Err(VerifyError::Metric(message));
            }
            differences = slab_means(&places, &differences, thickness);
            references = slab_means(&places, &references, thickness);
        }
        let scale = self.divide_by.unwrap_or_else(|| self.norm.of(&references));
        if !(scale.is_finite() && scale > 0.0) {
            return Err(VerifyError::Metric(format!(
                "the difference is divided by {scale}, which must be above 0 (give `divide_by`)"
            )));
        }
        Ok(Measurement {
            value: self.norm.of(&differences) / scale,
            unit: "1".into(),
            reference: None,
            detail: format!(
                "{count} points, scale {scale:.4e}, largest difference {:.3e}",
                Norm::Maximum.of(&differences)
            ),
        })
    }

    fn values<'a>(&self, points: &'a FinalPoints) -> Box<dyn Iterator<Item = f64> + 'a> {
        match self.quantity {
            Quantity::Stress(component) => {
                Box::new(points.stress.iter().map(move |stress| stress[component.index()]))
            }
            Quantity::Displacement(axis) => {
                let axis = axis.index();
                let pairs = points.position.iter().zip(&points.reference_position);
                Box::new(pairs.map(move |(now, before)| now[axis] - before[axis]))
            }
        }
    }

    fn profile(&self, evidence: &Evidence) -> Result<Profile<'_>, VerifyError> {
        match (evidence.references.first(), self.polynomial.as_slice()) {
            (Some(table), []) => Ok(Profile::Table(table.series(self.column.as_deref())?)),
            (None, coefficients @ [_, ..]) => Ok(Profile::Polynomial(coefficients)),
            _ => Err(VerifyError::Metric(
                "a profile is either a `polynomial` or a reference file; give one of them".into(),
            )),
        }
    }
}

/// Mean of the values in each slab.
fn slab_means(places: &[f64], values: &[f64], thickness: f64) -> Vec<f64> {
    let first = places.iter().copied().fold(f64::INFINITY, f64::min);
    let mut slabs: BTreeMap<i64, (f64, f64)> = BTreeMap::new();
    for (place, value) in places.iter().zip(values) {
        // Round-off must not push a point out of its slab.
        let slab = ((place - first) / thickness + 1e-6).floor() as i64;
        let (sum, count) = slabs.entry(slab).or_default();
        *sum += value;
        *count += 1.0;
    }
    slabs.into_values().map(|(sum, count)| sum / count).collect()
}

enum Profile<'a> {
    Polynomial(&'a [f64]),
    Table(Series),
}

impl Profile<'_> {
    fn at(&self, place: f64) -> Result<f64, VerifyError> {
        match self {
            Self::Polynomial(coefficients) => {
                Ok(coefficients.iter().rev().fold(0.0, |sum, c| sum * place + c))
            }
            Self::Table(series) => series.at(place).ok_or_else(|| {
                VerifyError::Metric(format!(
                    "{} reaches from {} to {}, but a point starts at {place}",
                    series.name,
                    series.start(),
                    series.end()
                ))
            }),
        }
    }
}

impl Norm {
    fn of(self, values: &[f64]) -> f64 {
        let count = values.len() as f64;
        match self {
            Self::Mean => values.iter().map(|v| v.abs()).sum::<f64>() / count,
            Self::RootMeanSquare => (values.iter().map(|v| v * v).sum::<f64>() / count).sqrt(),
            Self::Maximum => values.iter().fold(0.0, |largest, v| v.abs().max(largest)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Evidence, FinalPoints, Norm, ProfileError, Quantity, StressComponent};
    use crate::verify::{Histories, PointSource, ReferenceTable, VerifyError};
    use std::path::Path;

    struct Column(FinalPoints);
    impl PointSource for Column {
        fn final_points(&self, _: &str) -> Result<FinalPoints, VerifyError> {
            Ok(self.0.clone())
        }
    }

    /// Weight of a column 50 m high: σ_yy = -800 (50 - Y), and 1e-3 Y of settlement.
    fn column(error: impl Fn(f64) -> f64) -> Column {
        let mut points = FinalPoints::default();
        for k in 0..100 {
            let y = 0.5 * (f64::from(k) + 0.5);
            points.reference_position.push([3.0, y, 0.0]);
            points.position.push([3.0, y - 1e-3 * y, 0.0]);
            points.stress.push([9.0, -800.0 * (50.0 - y) + error(y), 9.0, 9.0, 9.0, 9.0]);
        }
        Column(points)
    }

    fn weight() -> ProfileError {
        ProfileError {
            body: "column".into(),
            quantity: Quantity::Stress(StressComponent::Yy),
            along: Axis::Y,
            polynomial: vec![-40_000.0, 800.0],
            column: None,
            norm: Norm::Mean,
            slab: None,
            divide_by: Some(40_000.0),
        }
    }

    fn measure(
        metric: &ProfileError,
        points: &Column,
        references: &[ReferenceTable],
    ) -> Result<f64, String> {
        let histories = Histories::from_tables(vec![]);
        let evidence = Evidence { histories: &histories, points, references };
        metric.measure(&evidence).map(|m| m.value).map_err(|e| e.to_string())
    }

    #[test]
    fn the_exact_profile_has_no_error_and_a_shift_is_returned() {
        let value = measure(&weight(), &column(|_| 0.0), &[]).unwrap();
        assert!(value < 1e-15, "{value}");
        let value = measure(&weight(), &column(|_| -400.0), &[]).unwrap();
        assert!((value - 0.01).abs() < 1e-12, "{value}");
        // Half of the points off by 800 Pa: mean 400, root mean square 800/√2, largest 800.
        let half = |y: f64| if y < 25.0 { 800.0 } else { 0.0 };
        for (norm, expected) in [
            (Norm::Mean, 0.01),
            (Norm::RootMeanSquare, 0.02 / 2.0_f64.sqrt()),
            (Norm::Maximum, 0.02),
        ] {
            let value = measure(&ProfileError { norm, ..weight() }, &column(half), &[]).unwrap();
            assert!((value - expected).abs() < 1e-12, "{norm:?}: {value}");
        }
    }

    #[test]
    fn slabs_compare_means() {
        // Constant in cells of two points, as far off below as above the middle.
        let steps = |y: f64| if (y - 0.25).round() as i64 % 2 == 0 { 200.0 } else { -200.0 };
        assert!(measure(&weight(), &column(steps), &[]).unwrap() > 0.004);
        let metric = ProfileError { slab: Some(1.0), ..weight() };
        let value = measure(&metric, &column(steps), &[]).unwrap();
        assert!(value < 1e-12, "{value}");
        let value = measure(&metric, &column(|_| 400.0), &[]).unwrap();
        assert!((value - 0.01).abs() < 1e-12, "{value}");
        assert!(
            measure(&ProfileError { slab: Some(0.0), ..weight() }, &column(steps), &[]).is_err()
        );
    }

    #[test]
    fn displacements_and_the_profiles_own_norm() {
        let metric = ProfileError {
            quantity: Quantity::Displacement(Axis::Y),
            polynomial: vec![0.0, -2e-3],
            divide_by: None,
            ..weight()
        };
        // The settlement is half of what the profile says.
        let value = measure(&metric, &column(|_| 0.0), &[]).unwrap();
        assert!((value - 0.5).abs() < 1e-9, "{value}");
    }

    #[test]
    fn a_file_gives_the_same_profile() {
        let text = "y,s\n0,-40000\n25,-20000\n50,0\n";
        let table = [ReferenceTable::parse(Path::new("p.csv"), text).unwrap()];
        let metric = ProfileError { polynomial: vec![], ..weight() };
        assert!(measure(&metric, &column(|_| 0.0), &table).unwrap() < 1e-15);
        let short = [ReferenceTable::parse(Path::new("p.csv"), "y,s\n0,1\n25,1\n").unwrap()];
        assert!(measure(&metric, &column(|_| 0.0), &short).unwrap_err().contains("starts at"));
        assert!(measure(&metric, &column(|_| 0.0), &[]).unwrap_err().contains("either"));
        assert!(measure(&weight(), &column(|_| 0.0), &table).unwrap_err().contains("either"));
    }
}
