//! Relative L2 error of cell-averaged stress against a reference field.

use super::{Evidence, Measurement};
use crate::verify::{FinalPoints, ReferenceTable, VerifyError};
use serde::Deserialize;

/// A component of the symmetric stress tensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StressComponent {
    /// σ_xx.
    Xx,
    /// σ_yy.
    Yy,
    /// σ_zz.
    Zz,
    /// σ_xy.
    Xy,
    /// σ_yz.
    Yz,
    /// σ_xz.
    Xz,
}

impl StressComponent {
    /// Index in `[xx, yy, zz, xy, yz, xz]`.
    pub(super) fn index(self) -> usize {
        self as usize
    }

    /// Column of the reference file.
    fn column(self) -> &'static str {
        ["s_xx", "s_yy", "s_zz", "s_xy", "s_yz", "s_xz"][self.index()]
    }
}

/// Which cells count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum Mask {
    /// All cells.
    #[default]
    All,
    /// Without the cells of the first and last layer in z that touch a free
    /// side: the stress is singular along the clamped edges there.
    WithoutEndEdges,
    /// Without the first and last layer in z.
    WithoutEndLayers,
}

impl Mask {
    fn keeps(self, index: [usize; 3], cells: [usize; 3]) -> bool {
        let at_end = |d: usize| index[d] == 0 || index[d] + 1 == cells[d];
        match self {
            Self::All => true,
            Self::WithoutEndEdges => !(at_end(2) && (at_end(0) || at_end(1))),
            Self::WithoutEndLayers => !at_end(2),
        }
    }
}

/// `sqrt(Σ_c (σ̄_c/s - r_c)² / Σ_c r_c²)`, `s = modulus · strain`: σ̄_c is the mean
/// over the points of cell c, r_c the normalised cell average of the reference
/// file (columns `i,j,k,x,y,z,s_xx…`; x, y, z are cell centres in m).
///
/// Points are binned by their reference position. A run coarser than the
/// reference by a whole factor is compared on its own cells, with the mean of
/// the reference cells inside each (cells are equal in volume, so this is the
/// exact average); a finer one on the reference's cells.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StressField {
    /// The body.
    pub body: String,
    /// The stress component.
    pub component: StressComponent,
    /// Young's modulus E (Pa).
    pub modulus: f64,
    /// Nominal strain ε₀ = end displacement / length, above 0.
    pub strain: f64,
    /// Points per cell and direction in the run.
    pub points_per_cell: usize,
    /// Position of the reference's origin in the case (m); default the origin.
    #[serde(default)]
    pub origin: [f64; 3],
    /// The cells that count; default all.
    #[serde(default)]
    pub mask: Mask,
}

impl StressField {
    pub(super) fn measure(&self, evidence: &Evidence) -> Result<Measurement, VerifyError> {
        let points = evidence.points.final_points(&self.body)?;
        let lattice = Lattice::read(&evidence.references[0], self.component.column())?;
        let ratio = self.coarsening(points.reference_position.len(), &lattice)?;
        let cells = lattice.cells.map(|n| n / ratio);
        let run = self.cell_averages(&points, &lattice, ratio)?;
        let reference = lattice.coarse_averages(ratio);
        let (mut error, mut norm, mut counted) = (0.0, 0.0, 0_usize);
        for (flat, (measured, expected)) in run.iter().zip(&reference).enumerate() {
            if self.mask.keeps(unflatten(flat, cells), cells) {
                error += (measured - expected).powi(2);
                norm += expected.powi(2);
                counted += 1;
            }
        }
        if norm == 0.0 {
            return Err(VerifyError::Metric(format!(
                "the reference stress is zero in all {counted} cells of the mask"
            )));
        }
        Ok(Measurement {
            value: (error / norm).sqrt(),
            unit: "1".into(),
            reference: None,
            detail: format!("{counted} cells of {}x{}x{}", cells[0], cells[1], cells[2]),
        })
    }

    /// How many reference cells make up one cell of the run, per direction.
    fn coarsening(&self, points: usize, lattice: &Lattice) -> Result<usize, VerifyError> {
        let [nx, ny, nz] = lattice.cells;
        let same = self.points_per_cell.pow(3) * nx * ny * nz;
        if points >= same && points.is_multiple_of(same) {
            return Ok(1);
        }
        (2..=nx.min(ny).min(nz))
            .find(|r| points * r.pow(3) == same && [nx, ny, nz].iter().all(|n| n.is_multiple_of(*r)))
            .ok_or_else(|| {
                VerifyError::Metric(format!(
                    "body `{}` has {points} points; the reference's {nx}x{ny}x{nz} cells take {same} at {} per cell and direction, or a whole coarsening or refinement of that",
                    self.body, self.points_per_cell
                ))
            })
    }

    /// Normalised mean stress of every (coarse) cell.
    fn cell_averages(
        &self,
        points: &FinalPoints,
        lattice: &Lattice,
        ratio: usize,
    ) -> Result<Vec<f64>, VerifyError> {
        let scale = self.modulus * self.strain;
        if !(scale.is_finite() && scale > 0.0) {
            return Err(VerifyError::Metric(format!(
                "modulus · strain is {scale} Pa; both must be above 0"
            )));
        }
        let cells = lattice.cells.map(|n| n / ratio);
        let mut sum = vec![(0.0, 0_usize); cells.iter().product()];
        for (x, stress) in points.reference_position.iter().zip(&points.stress) {
            let mut index = [0; 3];
            for d in 0..3 {
                let cell =
                    (x[d] - self.origin[d] - lattice.lower[d]) / (lattice.size[d] * ratio as f64);
                if !(0.0..cells[d] as f64).contains(&cell) {
                    return Err(VerifyError::Metric(format!(
                        "a point of body `{}` starts at {x:?} m, outside the reference's cells; is `origin` right?",
                        self.body
                    )));
                }
                index[d] = cell as usize;
            }
            let entry = &mut sum[flatten(index, cells)];
            entry.0 += stress[self.component.index()];
            entry.1 += 1;
        }
        if let Some(empty) = sum.iter().position(|(_, n)| *n == 0) {
            return Err(VerifyError::Metric(format!(
                "cell {:?} holds no point of body `{}`",
                unflatten(empty, cells),
                self.body
            )));
        }
        Ok(sum.iter().map(|(s, n)| s / *n as f64 / scale).collect())
    }
}

/// The reference's cells: counts, lowest corner and size (m), one value a cell.
struct Lattice {
    cells: [usize; 3],
    lower: [f64; 3],
    size: [f64; 3],
    value: Vec<f64>,
}

impl Lattice {
    fn read(table: &ReferenceTable, column: &str) -> Result<Self, VerifyError> {
        let fault =
            |message: String| VerifyError::Metric(format!("{}: {message}", table.path().display()));
        let index = [table.named("i")?, table.named("j")?, table.named("k")?];
        let centre = [table.named("x")?, table.named("y")?, table.named("z")?];
        let values = table.named(column)?;
        let cells = index.map(|i| i.iter().fold(0.0_f64, |m, v| m.max(*v)) as usize + 1);
        let mut lattice = Self {
            cells,
            lower: [0.0; 3],
            size: [0.0; 3],
            value: vec![f64::NAN; cells.iter().product()],
        };
        for d in 0..3 {
            let first = centre[d].iter().copied().fold(f64::INFINITY, f64::min);
            let last = centre[d].iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if cells[d] < 2 || last <= first {
                return Err(fault("at least two cells a direction are needed".into()));
            }
            lattice.size[d] = (last - first) / (cells[d] - 1) as f64;
            lattice.lower[d] = first - 0.5 * lattice.size[d];
        }
        for row in 0..values.len() {
            let at = [index[0][row] as usize, index[1][row] as usize, index[2][row] as usize];
            lattice.value[flatten(at, cells)] = values[row];
        }
        if lattice.value.iter().any(|v| v.is_nan()) {
            return Err(fault(format!("not every one of {cells:?} cells has a row")));
        }
        Ok(lattice)
    }

    /// Means over blocks of `ratio`³ cells.
    fn coarse_averages(&self, ratio: usize) -> Vec<f64> {
        let coarse = self.cells.map(|n| n / ratio);
        let mut mean = vec![0.0; coarse.iter().product()];
        let share = 1.0 / ratio.pow(3) as f64;
        for (flat, value) in self.value.iter().enumerate() {
            let index = unflatten(flat, self.cells).map(|i| i / ratio);
            mean[flatten(index, coarse)] += value * share;
        }
        mean
    }
}

fn flatten(index: [usize; 3], cells: [usize; 3]) -> usize {
    (index[0] * cells[1] + index[1]) * cells[2] + index[2]
}

fn unflatten(flat: usize, cells: [usize; 3]) -> [usize; 3] {
    [flat / (cells[1] * cells[2]), flat / cells[2] % cells[1], flat % cells[2]]
}

#[cfg(test)]
mod tests {
    use super::{Evidence, FinalPoints, Mask, ReferenceTable, StressComponent, StressField};
    use crate::verify::{Histories, PointSource, VerifyError};
    use std::fmt::Write as _;
    use std::path::Path;

    struct Block(FinalPoints);
    impl PointSource for Block {
        fn final_points(&self, _: &str) -> Result<FinalPoints, VerifyError> {
            Ok(self.0.clone())
        }
    }

    /// σ_zz/(E ε₀) of the reference in a 4x4x8 lattice of cells of size 0.25.
    fn exact(x: [f64; 3]) -> f64 {
        -1.0 - 0.2 * x[0] + 0.1 * x[1] * x[2]
    }

    fn reference() -> ReferenceTable {
        let mut text = String::from("i,j,k,x,y,z,s_zz\n");
        for (i, j, k) in (0..4)
            .flat_map(|i| (0..4).map(move |j| (i, j)))
            .flat_map(|(i, j)| (0..8).map(move |k| (i, j, k)))
        {
            let x = [i, j, k].map(|n| 0.25 * (f64::from(n) + 0.5));
            writeln!(text, "{i},{j},{k},{},{},{},{}", x[0], x[1], x[2], exact(x)).unwrap();
        }
        ReferenceTable::parse(Path::new("cells.csv"), &text).unwrap()
    }

    /// Points at `spacing` in the block moved to `origin`, σ_zz = 2e6·`field`.
    fn points(spacing: f64, origin: [f64; 3], field: impl Fn([f64; 3]) -> f64) -> FinalPoints {
        let n = (1.0 / spacing).round() as i32;
        let mut points = FinalPoints::default();
        for i in 0..n {
            for j in 0..n {
                for k in 0..2 * n {
                    let x = [i, j, k].map(|m| spacing * (f64::from(m) + 0.5));
                    points.reference_position.push([0, 1, 2].map(|d| x[d] + origin[d]));
                    points.stress.push([9.0, 9.0, 2e6 * field(x), 9.0, 9.0, 9.0]);
                }
            }
        }
        points.position = points.reference_position.clone();
        points
    }

    fn error(points: FinalPoints, origin: [f64; 3], mask: Mask) -> Result<f64, String> {
        let metric = StressField {
            body: "block".into(),
            component: StressComponent::Zz,
            modulus: 2e9,
            strain: 1e-3,
            points_per_cell: 2,
            origin,
            mask,
        };
        let evidence = Evidence {
            histories: &Histories::from_tables(vec![]),
            points: &Block(points),
            references: &[reference()],
        };
        metric.measure(&evidence).map(|m| m.value).map_err(|e| e.to_string())
    }

    #[test]
    fn the_reference_itself_has_no_error_at_any_resolution() {
        // x y-bilinear fields: the mean of symmetric points is the cell average.
        for spacing in [0.25, 0.125, 0.0625] {
            let e = error(points(spacing, [0.0; 3], exact), [0.0; 3], Mask::All).unwrap();
            assert!(e < 1e-14, "spacing {spacing}: {e}");
        }
        let origin = [3.0, -1.0, 0.5];
        assert!(error(points(0.125, origin, exact), origin, Mask::All).unwrap() < 1e-13);
    }

    #[test]
    fn a_uniform_relative_error_is_returned_exactly() {
        let e = error(points(0.125, [0.0; 3], |x| 1.05 * exact(x)), [0.0; 3], Mask::All).unwrap();
        assert!((e - 0.05).abs() < 1e-12, "{e}");
    }

    #[test]
    fn masks_leave_out_the_end_cells() {
        let edge = |x: [f64; 3]| {
            let end = x[2] < 0.25 || x[2] > 1.75;
            let side = x[0] < 0.25 || x[0] > 0.75 || x[1] < 0.25 || x[1] > 0.75;
            end && side
        };
        let broken = |x: [f64; 3]| if edge(x) { 0.0 } else { exact(x) };
        let of = |mask| error(points(0.125, [0.0; 3], broken), [0.0; 3], mask).unwrap();
        assert!(of(Mask::All) > 0.3);
        assert!(of(Mask::WithoutEndEdges) < 1e-14);
        let broken_end = |x: [f64; 3]| if x[2] < 0.25 { 0.0 } else { exact(x) };
        let of = |mask| error(points(0.125, [0.0; 3], broken_end), [0.0; 3], mask).unwrap();
        assert!(of(Mask::WithoutEndEdges) > 0.05);
        assert!(of(Mask::WithoutEndLayers) < 1e-14);
    }

    #[test]
    fn the_same_grid_limit_is_at_its_known_distance_from_finite_elements() {
        // 0.43 % over all cells, 0.33 % without the end layers' edge cells and 0.26 %
        // without both end layers: computed by a separate script from the same two files.
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../../cases/uniaxial_compression/reference");
        let limit = ReferenceTable::read(&folder.join("cell_average_gimpm_limit.csv")).unwrap();
        let mut points = FinalPoints::default();
        for row in 0..limit.column(0).len() {
            let centre = [3, 4, 5].map(|column| limit.column(column)[row]);
            for corner in 0..8 {
                let side = |d: usize| if corner >> d & 1 == 0 { -0.025 } else { 0.025 };
                points.reference_position.push([0, 1, 2].map(|d| centre[d] + side(d)));
                points.stress.push([0.0, 0.0, 1.5e6 * limit.column(6)[row], 0.0, 0.0, 0.0]);
            }
        }
        points.position = points.reference_position.clone();
        let source = Block(points);
        let references = [ReferenceTable::read(&folder.join("cell_average_fem.csv")).unwrap()];
        for (mask, expected) in [
            (Mask::All, 0.004_316_0),
            (Mask::WithoutEndEdges, 0.003_276_2),
            (Mask::WithoutEndLayers, 0.002_575_8),
        ] {
            let metric = StressField {
                body: "block".into(),
                component: StressComponent::Zz,
                modulus: 30e9,
                strain: 5e-5,
                points_per_cell: 2,
                origin: [0.0; 3],
                mask,
            };
            let evidence = Evidence {
                histories: &Histories::from_tables(vec![]),
                points: &source,
                references: &references,
            };
            let measured = metric.measure(&evidence).unwrap().value;
            assert!((measured - expected).abs() < 1e-7, "{mask:?}: {measured}");
        }
    }

    #[test]
    fn misplaced_or_miscounted_bodies_are_refused() {
        let moved = error(points(0.125, [0.0; 3], exact), [1.0, 0.0, 0.0], Mask::All);
        assert!(moved.unwrap_err().contains("origin"));
        let mut short = points(0.125, [0.0; 3], exact);
        short.reference_position.pop();
        short.stress.pop();
        assert!(error(short, [0.0; 3], Mask::All).unwrap_err().contains("points"));
    }
}
