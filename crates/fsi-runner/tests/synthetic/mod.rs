//! A made-up run: water sloshing in a tank in front of a bending wall. It
//! exercises the outputs without the solvers; nothing in it is physics.

use fsi_runner::output::frame::{CloudKind, Column, Field, Frame, PointCloud, RunHeader};

/// Distance between points (m) for a given number of cells over the water's height.
pub struct Scene {
    cells: usize,
    spacing: f64,
}

const HEIGHT: f64 = 0.6;
const FRAME_INTERVAL: f64 = 0.05;

impl Scene {
    pub fn new(cells: usize) -> Self {
        Self { cells, spacing: HEIGHT / cells as f64 }
    }

    pub fn header() -> RunHeader {
        let overrides = ["fluid.spacing=0.1".to_string()];
        RunHeader::new("sloshing", "(name: \"sloshing\") // ≤ π", &overrides, 3, [0.0, 0.0, -9.81])
    }

    pub fn gauge_columns() -> Vec<Column> {
        let columns = [
            ("P1.pressure", "Pa"),
            ("P2.pressure", "Pa"),
            ("level.level", "m"),
            ("crest.x", "m"),
            ("crest.z", "m"),
        ];
        columns.map(|(name, unit)| Column { name: name.into(), unit: unit.into() }).to_vec()
    }

    pub fn ledger_columns() -> Vec<Column> {
        let columns = [("energy.fluid_kinetic", "J"), ("energy.solid_strain", "J")];
        columns.map(|(name, unit)| Column { name: name.into(), unit: unit.into() }).to_vec()
    }

    pub fn gauge_row(time: f64) -> [f64; 5] {
        let wave = (4.0 * time).sin();
        [4000.0 + 1500.0 * wave, 2000.0 + 900.0 * wave, HEIGHT + 0.1 * wave, 0.05 * wave, -0.003]
    }

    pub fn ledger_row(time: f64) -> [f64; 2] {
        [12.0 * (4.0 * time).cos().powi(2), 3.0 * (4.0 * time).sin().powi(2)]
    }

    pub fn walls(&self) -> PointCloud {
        let dx = self.spacing;
        let (nx, ny, nz) = (3 * self.cells, self.cells, 2 * self.cells);
        let mut position = Vec::new();
        for i in -3..nx as i64 + 3 {
            for j in -3..ny as i64 + 3 {
                for k in -3..nz as i64 {
                    let inside =
                        (0..nx as i64).contains(&i) && (0..ny as i64).contains(&j) && k >= 0;
                    if !inside {
                        position.push([i, j, k].map(|n| (n as f64 + 0.5) * dx));
                    }
                }
            }
        }
        cloud("walls", CloudKind::Wall, dx, position, Vec::new())
    }

    pub fn frame(&self, index: u64) -> Frame {
        let time = index as f64 * FRAME_INTERVAL;
        Frame { index, step: 100 * index, time, clouds: vec![self.fluid(time), self.solid(time)] }
    }

    fn fluid(&self, time: f64) -> PointCloud {
        let (n, dx) = (self.cells, self.spacing);
        let length = 2.0 * n as f64 * dx;
        let (mut position, mut velocity, mut pressure) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..2 * n {
            for j in 0..n {
                for k in 0..n {
                    let [x, y, z] = [i, j, k].map(|m| (m as f64 + 0.5) * dx);
                    let tilt = 0.3 * (x / length - 0.5) * (4.0 * time).sin();
                    // Disorder, so that files compress as those of real runs do.
                    let [a, b, c] = disorder(position.len()).map(|r| 0.2 * dx * r);
                    position.push([x + a, y + b, z * (1.0 + tilt) + c]);
                    velocity.extend([0.1 * (4.0 * time).cos() + a, b, tilt + c]);
                    pressure.push(1000.0 * 9.81 * (HEIGHT - z) * (1.0 + tilt) + 1e3 * a);
                }
            }
        }
        let density = pressure.iter().map(|p| 1000.0 + p / 1600.0).collect();
        let fields = vec![
            Field { name: "velocity", unit: "m/s", components: 3, values: velocity },
            Field { name: "pressure", unit: "Pa", components: 1, values: pressure },
            Field { name: "density", unit: "kg/m3", components: 1, values: density },
        ];
        cloud("fluid", CloudKind::Fluid, dx, position, fields)
    }

    fn solid(&self, time: f64) -> PointCloud {
        let (n, dx) = (self.cells, self.spacing);
        let (mut position, mut stress, mut displacement) = (Vec::new(), Vec::new(), Vec::new());
        let thickness = (n / 3).max(3);
        for i in 0..thickness {
            for j in 0..n {
                for k in 0..n * 5 / 4 {
                    let [a, y, z] = [i, j, k].map(|m| (m as f64 + 0.5) * dx);
                    let bend = 0.2 * z * z * (4.0 * time).sin();
                    let x = 2.05 * HEIGHT + a + bend;
                    let across = a / (thickness as f64 * dx) - 0.5;
                    let bending = 2e6 * across * (1.0 - z / (1.25 * HEIGHT)) * (4.0 * time).sin();
                    position.push([x, y, z]);
                    displacement.extend([bend, 0.0, 0.0]);
                    stress.extend([0.0, 0.0, bending, 0.0, 0.0, 1e4]);
                }
            }
        }
        let fields = vec![
            Field { name: "displacement", unit: "m", components: 3, values: displacement },
            Field { name: "stress", unit: "Pa", components: 6, values: stress },
        ];
        cloud("solid/seawall", CloudKind::Solid, dx, position, fields)
    }
}

/// Three numbers between -1 and 1 that follow no pattern (fractions of n φ).
fn disorder(n: usize) -> [f64; 3] {
    [0.618_033_988_749_895, 0.754_877_666_246_693, 0.819_172_513_396_164]
        .map(|step| 2.0 * (n as f64 * step).fract() - 1.0)
}

fn cloud(
    name: &str,
    kind: CloudKind,
    spacing: f64,
    position: Vec<[f64; 3]>,
    fields: Vec<Field>,
) -> PointCloud {
    let id = (0..position.len() as u32).collect();
    PointCloud { name: name.into(), kind, spacing, id, position, fields }
}
