//! A velocity field: a grid and the bodies that move with it.

use nalgebra::SVector;

use crate::error::SolidError;
use crate::grid::{Grid, GridGeometry};
use crate::grid_momentum::{NODES_PER_TASK, NodeTally};
use crate::parameters::{BodySeed, Frame, SolidParameters};

/// One velocity field.
///
/// Bodies in one field stick where they meet. A body in [`Frame::Total`] has a
/// field of its own, on a window of the background grid around its reference
/// shape; those in [`Frame::Updated`] share the whole grid in one field, or have
/// one each when contact between them is computed.
#[derive(Debug, Clone)]
pub(crate) struct Field<const D: usize> {
    pub frame: Frame,
    pub grid: Grid<D>,
    pub tallies: Vec<NodeTally>,
}

impl<const D: usize> Field<D> {
    fn new(frame: Frame, geometry: GridGeometry<D>) -> Self {
        let tasks = geometry.node_count().div_ceil(NODES_PER_TASK);
        Self { frame, grid: Grid::new(geometry), tallies: vec![NodeTally::default(); tasks] }
    }
}

/// Makes the fields; the second list holds the field of each body.
pub(crate) fn fields<const D: usize>(
    parameters: &SolidParameters<D>,
    bodies: &[BodySeed<D>],
) -> Result<(Vec<Field<D>>, Vec<usize>), SolidError> {
    let whole =
        GridGeometry::new(parameters.grid_spacing, parameters.grid_origin, parameters.grid_cells);
    let mut fields = Vec::new();
    let mut shared = None;
    let mut field_of = Vec::with_capacity(bodies.len());
    for seed in bodies {
        let index = match seed.discretisation.frame {
            Frame::Total => {
                fields.push(Field::new(Frame::Total, window(&whole, seed)?));
                fields.len() - 1
            }
            Frame::Updated => *shared.get_or_insert_with(|| {
                fields.push(Field::new(Frame::Updated, whole.clone()));
                fields.len() - 1
            }),
        };
        field_of.push(index);
    }
    Ok((fields, field_of))
}

/// How far a box may reach over the faces of its cell in [`Frame::Total`], in cells.
const PATTERN_TOLERANCE: f64 = 1e-6;

/// The part of the grid that a body's reference shape covers.
fn window<const D: usize>(
    whole: &GridGeometry<D>,
    seed: &BodySeed<D>,
) -> Result<GridGeometry<D>, SolidError> {
    let half = 0.5 * seed.point_spacing * whole.inverse_spacing;
    let (mut first, mut last) = ([usize::MAX; D], [0; D]);
    for (k, position) in seed.points.iter().enumerate() {
        for d in 0..D {
            let along = whole.coordinate(position, d);
            if !(along >= 0.0 && along <= whole.cells[d] as f64) {
                return Err(SolidError::OutsideGrid {
                    point: k as u32,
                    position: position.iter().copied().collect(),
                    time: 0.0,
                    lower: whole.origin.iter().copied().collect(),
                    upper: whole.upper().iter().copied().collect(),
                });
            }
            let cell = (along - half + PATTERN_TOLERANCE).floor();
            if along + half > cell + 1.0 + PATTERN_TOLERANCE || cell < 0.0 {
                return Err(SolidError::Body {
                    body: seed.name.clone(),
                    problem: format!(
                        "the box of point {k} at {:?} m (edge {} m) reaches over a face of its cell (spacing {} m) along axis {d}; \
                         a body in the total Lagrangian frame needs whole points in every cell: align it with grid_origin or use Frame::Updated",
                        position.as_slice(),
                        seed.point_spacing,
                        whole.spacing
                    ),
                });
            }
            first[d] = first[d].min(cell as usize);
            last[d] = last[d].max(cell as usize + 1);
        }
    }
    let origin: SVector<f64, D> =
        SVector::from_fn(|d, _| whole.origin[d] + first[d] as f64 * whole.spacing);
    Ok(GridGeometry::new(whole.spacing, origin, std::array::from_fn(|d| last[d] - first[d])))
}
