//! The data every writer takes: point clouds with fields at one instant, and
//! named columns of numbers over time. SI units throughout.

use super::error::OutputError;

/// Everything visible at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Counts the frames of a run from 0.
    pub index: u64,
    /// Coupled steps done.
    pub step: u64,
    /// Simulated time (s).
    pub time: f64,
    /// Fluid, moving walls and solid bodies, in a fixed order.
    pub clouds: Vec<PointCloud>,
}

/// Points that belong together and carry the same fields.
#[derive(Clone, Debug, PartialEq)]
pub struct PointCloud {
    /// `fluid`, `walls`, or `solid/<body>`. Also the path inside the HDF5 file.
    pub name: String,
    /// What the points stand for.
    pub kind: CloudKind,
    /// Initial distance between neighbours (m); the drawn diameter.
    pub spacing: f64,
    /// Identity of each point, constant through the run.
    pub id: Vec<u32>,
    /// Positions (m); z = 0 in two dimensions.
    pub position: Vec<[f64; 3]>,
    /// Further quantities, each of the same number of points.
    pub fields: Vec<Field>,
}

/// Name of the field of equivalent plastic strain.
pub const PLASTIC_STRAIN: &str = "plastic_strain";

/// What the points of a cloud stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CloudKind {
    /// SPH particles.
    Fluid,
    /// Dummy particles of rigid walls.
    Wall,
    /// Material points of a solid.
    Solid,
}

/// One quantity on all points of a cloud.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// `velocity`, `pressure`, `density`, `stress`, `displacement`, `plastic_strain`, …
    pub name: &'static str,
    /// SI unit, e.g. `Pa`.
    pub unit: &'static str,
    /// 1 (scalar), 3 (vector) or 6 (symmetric tensor: xx, yy, zz, xy, yz, xz).
    pub components: usize,
    /// Point after point, `components` values each.
    pub values: Vec<f64>,
}

/// One quantity over time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// E.g. `P1.pressure`, `crest.x`, `energy.fluid_kinetic`.
    pub name: String,
    /// SI unit, e.g. `Pa`; `1` for pure numbers.
    pub unit: String,
}

/// What identifies a run; stored in its HDF5 file.
#[derive(Clone, Debug, PartialEq)]
pub struct RunHeader {
    /// Name of the case.
    pub case_name: String,
    /// The case file as it was read.
    pub case_text: String,
    /// `--set` overrides in order.
    pub overrides: Vec<String>,
    /// Version of the program that wrote the file.
    pub program_version: String,
    /// 2 (plane strain, y up) or 3 (z up).
    pub dimension: usize,
    /// Gravity (m/s²); z = 0 in two dimensions.
    pub gravity: [f64; 3],
    /// Ties the parts of a resumed Rerun recording together.
    pub run_id: String,
}

/// A cloud without its numbers: what a reader needs to know to find them.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudInfo {
    /// See [`PointCloud::name`].
    pub name: String,
    /// See [`PointCloud::kind`].
    pub kind: CloudKind,
    /// See [`PointCloud::spacing`].
    pub spacing: f64,
    /// Number of points.
    pub count: usize,
    /// Fields in stored order.
    pub fields: Vec<FieldInfo>,
}

/// A field without its numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldInfo {
    /// See [`Field::name`].
    pub name: String,
    /// See [`Field::unit`].
    pub unit: String,
    /// See [`Field::components`].
    pub components: usize,
    /// Stored as 8-byte numbers, else as 4-byte ones.
    pub double: bool,
}

impl CloudKind {
    /// The word stored in files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Fluid => "fluid",
            Self::Wall => "wall",
            Self::Solid => "solid",
        }
    }

    /// The inverse of [`word`](Self::word).
    pub fn from_word(word: &str) -> Option<Self> {
        [Self::Fluid, Self::Wall, Self::Solid].into_iter().find(|kind| kind.word() == word)
    }
}

impl RunHeader {
    /// A header of this program version with a run id that no other run has.
    pub fn new(
        case_name: &str,
        case_text: &str,
        overrides: &[String],
        dimension: usize,
        gravity: [f64; 3],
    ) -> Self {
        let now = std::time::UNIX_EPOCH.elapsed().map_or(0, |elapsed| elapsed.as_nanos());
        Self {
            case_name: case_name.into(),
            case_text: case_text.into(),
            overrides: overrides.to_vec(),
            program_version: env!("CARGO_PKG_VERSION").into(),
            dimension,
            gravity,
            run_id: format!("{case_name}-{now:x}-{:x}", std::process::id()),
        }
    }
}

impl Field {
    /// Stress keeps 8 bytes: verification reads it against references closer
    /// than 4 bytes resolve. Everything else is for looking at.
    pub fn stored_double(&self) -> bool {
        self.name == "stress"
    }
}

impl PointCloud {
    /// The field called `name`.
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name == name)
    }

    /// Shape and names without the numbers.
    pub fn info(&self) -> CloudInfo {
        let field = |f: &Field| FieldInfo {
            name: f.name.into(),
            unit: f.unit.into(),
            components: f.components,
            double: f.stored_double(),
        };
        CloudInfo {
            name: self.name.clone(),
            kind: self.kind,
            spacing: self.spacing,
            count: self.position.len(),
            fields: self.fields.iter().map(field).collect(),
        }
    }

    /// Checks that names can be paths and that all lengths agree.
    ///
    /// # Errors
    /// [`OutputError::InvalidData`] naming the cloud, the field and both lengths.
    pub fn validate(&self) -> Result<(), OutputError> {
        let fail = |reason: String| {
            Err(OutputError::InvalidData { what: format!("point cloud `{}`", self.name), reason })
        };
        if self.name.split('/').any(|part| part.is_empty() || part == "." || part == "..") {
            return fail("the name must be words joined by single slashes".into());
        }
        let count = self.position.len();
        if self.id.len() != count {
            return fail(format!("{} ids for {count} points", self.id.len()));
        }
        for field in &self.fields {
            if !matches!(field.components, 1 | 3 | 6) {
                return fail(format!(
                    "field `{}` has {} components; 1, 3 and 6 are allowed",
                    field.name, field.components
                ));
            }
            if field.values.len() != count * field.components {
                return fail(format!(
                    "field `{}` has {} values for {count} points of {} components",
                    field.name,
                    field.values.len(),
                    field.components
                ));
            }
        }
        Ok(())
    }
}

/// Length of each vector of a field of 3 components, or the magnitude of a scalar.
pub fn magnitudes(values: &[f64], components: usize) -> Vec<f64> {
    values.chunks_exact(components).map(|v| v.iter().map(|x| x * x).sum::<f64>().sqrt()).collect()
}

/// Von Mises equivalent stress of each symmetric tensor (xx, yy, zz, xy, yz, xz):
/// √(½[(xx-yy)² + (yy-zz)² + (zz-xx)²] + 3(xy² + yz² + xz²)).
pub fn von_mises(stress: &[f64]) -> Vec<f64> {
    let one = |s: &[f64]| {
        let normal = (s[0] - s[1]).powi(2) + (s[1] - s[2]).powi(2) + (s[2] - s[0]).powi(2);
        let shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
        (0.5 * normal + 3.0 * shear).sqrt()
    };
    stress.chunks_exact(6).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn von_mises_of_uniaxial_and_pure_shear_stress() {
        let values = von_mises(&[-3e6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2e6, 0.0, 0.0]);
        assert!((values[0] - 3e6).abs() < 1e-6, "{values:?}");
        assert!((values[1] - 2e6 * 3f64.sqrt()).abs() < 1e-6, "{values:?}");
    }

    #[test]
    fn wrong_lengths_are_named() {
        let cloud = PointCloud {
            name: "fluid".into(),
            kind: CloudKind::Fluid,
            spacing: 0.1,
            id: vec![0, 1],
            position: vec![[0.0; 3]; 2],
            fields: vec![Field { name: "velocity", unit: "m/s", components: 3, values: vec![0.0] }],
        };
        let message = cloud.validate().err().map(|error| error.to_string());
        assert_eq!(
            message.as_deref(),
            Some("point cloud `fluid`: field `velocity` has 1 values for 2 points of 3 components")
        );
    }
}
