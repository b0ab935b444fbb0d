//! Collects problems and warnings with the place of their field.

use crate::CaseError;
use crate::geometry::Point;
use crate::source::Source;
use crate::suggestion;

/// The checks of single fields, and what they found so far.
pub(crate) struct Checker<'a> {
    source: &'a Source,
    problems: Vec<CaseError>,
    warnings: Vec<String>,
    /// 2 or 3.
    pub(crate) dimension: usize,
}

impl<'a> Checker<'a> {
    pub(crate) fn new(source: &'a Source) -> Self {
        Self { source, problems: Vec::new(), warnings: Vec::new(), dimension: 3 }
    }

    /// Notes a problem at a field.
    pub(crate) fn problem(&mut self, path: &str, message: String, help: &str) {
        let error = self.source.error_at_path(path, message).with_help(Some(help.to_owned()));
        self.problems.push(error);
    }

    /// Notes something that does not forbid the run.
    pub(crate) fn warn(&mut self, message: String) {
        self.warnings.push(message);
    }

    /// Whether any problem was noted.
    pub(crate) fn failed(&self) -> bool {
        !self.problems.is_empty()
    }

    pub(crate) fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    /// The first problem, with the others related to it.
    pub(crate) fn into_error(self) -> CaseError {
        let mut problems = self.problems.into_iter();
        let first = problems.next().unwrap_or_else(|| {
            CaseError::new(self.source.file_name(), "", "the case could not be checked")
        });
        first.with_related(problems.collect())
    }

    /// Unit vector that points up: y in 2D, z in 3D.
    pub(crate) fn up_axis(&self) -> Point {
        if self.dimension == 2 { Point::y() } else { Point::z() }
    }

    /// One in every axis of the case, zero in the others.
    pub(crate) fn axes_mask(&self) -> Point {
        Point::from_fn(|axis, _| if axis < self.dimension { 1.0 } else { 0.0 })
    }

    /// Whether a point lies in a closed box.
    pub(crate) fn contains(&self, bounds: (Point, Point), p: &Point) -> bool {
        (0..self.dimension).all(|axis| bounds.0[axis] <= p[axis] && p[axis] <= bounds.1[axis])
    }

    /// Requires a finite number above 0.
    pub(crate) fn positive(&mut self, path: &str, value: f64, unit: &str) -> bool {
        self.within(path, value, unit, value > 0.0 && value.is_finite(), "a number above 0")
    }

    /// Requires a finite number for which `valid` holds.
    pub(crate) fn within(
        &mut self,
        path: &str,
        value: f64,
        unit: &str,
        valid: bool,
        allowed: &str,
    ) -> bool {
        if value.is_finite() && valid {
            return true;
        }
        let field = path.rsplit('.').next().unwrap_or(path);
        let separator = if unit.is_empty() { "" } else { " " };
        self.problem(
            path,
            format!("{field} is {value}{separator}{unit}"),
            &format!(
                "it must be {allowed}{}",
                if unit.is_empty() { String::new() } else { format!(", in {unit}") }
            ),
        );
        false
    }

    /// A position, velocity or acceleration: as many components as the case has
    /// dimensions, none so large that particles beside it could not be told apart.
    pub(crate) fn vector(&mut self, path: &str, components: &[f64]) -> Option<Point> {
        let usable = |c: f64| c.abs() <= LARGEST_COMPONENT;
        self.components(path, components, usable, "a number between -1e7 and 1e7")
    }

    /// A force per area: as many finite components as the case has dimensions.
    pub(crate) fn traction(&mut self, path: &str, components: &[f64]) -> Option<Point> {
        self.components(path, components, f64::is_finite, "a finite number, in Pa")
    }

    fn components(
        &mut self,
        path: &str,
        components: &[f64],
        usable: impl Fn(f64) -> bool,
        allowed: &str,
    ) -> Option<Point> {
        if components.len() != self.dimension {
            let names = if self.dimension == 2 { "[x, y]" } else { "[x, y, z]" };
            self.problem(
                path,
                format!(
                    "this vector has {} component(s), but the case has dimension {}",
                    components.len(),
                    self.dimension
                ),
                &format!("write {} numbers {names}", self.dimension),
            );
            return None;
        }
        if let Some(index) = components.iter().position(|c| !usable(*c)) {
            self.problem(
                &format!("{path}[{index}]"),
                format!("this component is {}", components[index]),
                &format!("it must be {allowed}"),
            );
            return None;
        }
        Some(Point::from_fn(|axis, _| components.get(axis).copied().unwrap_or(0.0)))
    }

    /// Like [`Self::vector`], with a default for a field left out.
    pub(crate) fn vector_or(
        &mut self,
        path: &str,
        components: Option<&Vec<f64>>,
        default: Point,
    ) -> Option<Point> {
        components.map_or(Some(default), |components| self.vector(path, components))
    }

    /// A vector of non-zero length, made a unit vector.
    pub(crate) fn direction(&mut self, path: &str, components: &[f64]) -> Option<Point> {
        let vector = self.vector(path, components)?;
        let unit = vector.try_normalize(1e-300);
        if unit.is_none() {
            self.problem(path, "this direction has length 0".into(), "give it a length");
        }
        unit
    }

    /// Two corners `lower` and `upper` of the value at `path`, in that order on every axis.
    pub(crate) fn corners(
        &mut self,
        path: &str,
        lower: &[f64],
        upper: &[f64],
    ) -> Option<(Point, Point)> {
        let low = self.vector(&format!("{path}.lower"), lower);
        let high = self.vector(&format!("{path}.upper"), upper);
        let (low, high) = (low?, high?);
        let wrong = (0..self.dimension).find(|&axis| high[axis] <= low[axis]);
        if let Some(axis) = wrong {
            self.problem(
                &format!("{path}.upper[{axis}]"),
                format!(
                    "the upper corner {} = {} m is not above the lower one, {} m",
                    AXES[axis], high[axis], low[axis]
                ),
                "every component of `upper` must be larger than that of `lower`",
            );
            return None;
        }
        Some((low, high))
    }

    /// A face name such as `z-`: its axis, and 0 for the lower or 1 for the upper side.
    pub(crate) fn face(&mut self, path: &str, name: &str) -> Option<(usize, usize)> {
        let valid = &FACES[..2 * self.dimension];
        let found = valid.iter().position(|face| *face == name);
        if found.is_none() {
            self.problem(
                path,
                format!("there is no face `{name}`"),
                &suggestion::help(name, valid),
            );
        }
        found.map(|index| (index / 2, index % 2))
    }

    /// Requires a name that can be a folder name.
    pub(crate) fn file_name(&mut self, path: &str, name: &str) {
        let valid = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(valid) {
            self.problem(
                path,
                format!("`{name}` cannot name a folder"),
                "use letters, digits, `_` and `-`",
            );
        }
    }
}

/// Beyond this a coordinate leaves too few digits for particles millimetres apart.
const LARGEST_COMPONENT: f64 = 1e7;

/// Names of the axes.
pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// Names of the faces, lower then upper by axis.
pub(crate) const FACES: [&str; 6] = ["x-", "x+", "y-", "y+", "z-", "z+"];

/// A position for messages, with the components that the case has.
pub(crate) fn position_text(p: &Point, dimension: usize) -> String {
    let components: Vec<_> = (0..dimension).map(|axis| short(p[axis])).collect();
    format!("[{}]", components.join(", "))
}

/// A number with at most seven significant digits.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let digits = (6 - value.abs().log10().floor() as i32).clamp(0, 15) as usize;
    let rounded: f64 = format!("{value:.digits$}").parse().unwrap_or(value);
    if (1e-4..1e7).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}
