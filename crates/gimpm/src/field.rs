//! A velocity field: a grid and the bodies that move with it.

use nalgebra::SVector;

use crate::error::SolidError;
use crate::grid::{Grid, GridGeometry, RemapRecord};
use crate::grid_momentum::{NODES_PER_TASK, NodeTally};
use crate::lattice::Lattice;
use crate::parameters::{BodySeed, Frame, SolidParameters, Transfer};

/// One velocity field.
///
/// Bodies in one field stick where they meet. A body in [`Frame::Total`] has a
/// field of its own, on a window of the background grid around its reference
/// shape; those in [`Frame::Updated`] share the whole grid in one field, or have
/// one each when contact between them is computed.
#[derive(Debug, Clone)]
pub(crate) struct Field<const D: usize> {
    pub grid: Grid<D>,
    pub tallies: Vec<NodeTally>,
    /// Components that a constraint holds, a bit each, by node; empty without damping.
    pub held: Vec<u8>,
    /// Transfer of its bodies.
    pub transfer: Transfer,
    /// Work space of the full mass matrix; empty without it.
    pub increments: [Vec<RemapRecord>; 2],
    /// The blocks of points of a body that [`Kernel::Lattice`](crate::kernel::Kernel)
    /// serves; it has the field to itself.
    pub lattice: Option<Lattice<D>>,
}

impl<const D: usize> Field<D> {
    fn new(transfer: Transfer, geometry: GridGeometry<D>) -> Self {
        let tasks = geometry.node_count().div_ceil(NODES_PER_TASK);
        Self {
            grid: Grid::new(geometry),
            tallies: vec![NodeTally::default(); tasks],
            held: Vec::new(),
            transfer,
            increments: [Vec::new(), Vec::new()],
            lattice: None,
        }
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
            Frame::Total if parameters.contact.is_some() => {
                return Err(SolidError::Body {
                    body: seed.name.clone(),
                    problem: "it is in the total Lagrangian frame, on a grid of its own, where it meets no other body; \
                              contact works between bodies in Frame::Updated: choose that frame or leave contact out"
                        .into(),
                });
            }
            Frame::Total => {
                fields.push(Field::new(seed.discretisation.transfer, window(&whole, seed)?));
                fields.len() - 1
            }
            Frame::Updated
                if parameters.contact.is_some()
                    && matches!(seed.discretisation.transfer, Transfer::Fmpm { order: 2.. }) =>
            {
                return Err(SolidError::Body {
                    body: seed.name.clone(),
                    problem:
                        "the increments of Transfer::Fmpm above order 1 know nothing of contact; \
                              choose Flip, Apic or Tpic, or leave contact out"
                            .into(),
                });
            }
            Frame::Updated if parameters.contact.is_some() => {
                fields.push(Field::new(seed.discretisation.transfer, whole.clone()));
                fields.len() - 1
            }
            Frame::Updated => *shared.get_or_insert_with(|| {
                fields.push(Field::new(seed.discretisation.transfer, whole.clone()));
                fields.len() - 1
            }),
        };
        if fields[index].transfer != seed.discretisation.transfer {
            return Err(SolidError::Body {
                body: seed.name.clone(),
                problem: format!(
                    "its transfer is {:?}, but a body that shares its velocity field has {:?}; bodies that stick need one transfer: \
                     give both the same, or separate them by contact or Frame::Total",
                    seed.discretisation.transfer, fields[index].transfer
                ),
            });
        }
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
