//! Frame, shape function, transfer and what they exclude.

use gimpm::{Contact, Discretisation, Frame, Relaxation, Shape, StressUpdate, Transfer};

use crate::format::{
    BodyForm, FrameForm, ShapeFunctionForm, SolidForm, StressUpdateForm, TransferForm,
};
use crate::plan::BodyPlan;

use super::{Checker, material};

/// Largest number of terms of the inverse mass matrix.
const MOST_TERMS: u32 = 20;

/// Discretisation of one body: its own choices, else those of the solid.
pub(crate) fn plan(
    form: &BodyForm,
    solid: &SolidForm,
    path: &str,
    check: &mut Checker<'_>,
) -> Option<Discretisation> {
    let frame = frame(form, solid);
    let (chosen_shape, shape_path) = match (form.shape_function, solid.shape_function) {
        (Some(shape), _) => (Some(shape), format!("{path}.shape_function")),
        (None, shape) => (shape, "solid.shape_function".into()),
    };
    let (transfer, transfer_path) = match form.transfer {
        Some(transfer) => (transfer, format!("{path}.transfer")),
        None => (solid.transfer, "solid.transfer".into()),
    };
    let mut valid = true;
    if let TransferForm::Fmpm { order } = transfer {
        let inside = (1..=MOST_TERMS).contains(&order);
        let field = format!("{transfer_path}.order");
        let allowed = format!("1 (PIC) to {MOST_TERMS}");
        valid &= check.within(&field, f64::from(order), "", inside, &allowed);
    }
    if frame == Frame::Updated && form.mean_dilatation {
        let message = format!(
            "body `{}` asks for mean dilatation in the updated frame, where points change cells",
            form.name
        );
        let help = "leave it out, or give the body `frame: Total`";
        check.problem(&format!("{path}.mean_dilatation"), message, help);
        valid = false;
    }
    if frame == Frame::Total
        && matches!(chosen_shape, Some(ShapeFunctionForm::Cpgimp | ShapeFunctionForm::Cpdi))
    {
        check.warn(format!(
            "body `{}`: `{shape_path}` changes nothing in the total frame, where every point's box \
             stays inside one cell and all shape functions are the same",
            form.name
        ));
    }
    if frame == Frame::Total
        && !form.mean_dilatation
        && let Some(ratio) = material::locking(&form.material)
    {
        check.warn(format!(
            "body `{}` is nearly incompressible (bulk over shear modulus {ratio}) and will be too \
             stiff; set `mean_dilatation: true`",
            form.name
        ));
    }
    valid.then_some(Discretisation {
        frame,
        shape: match chosen_shape.unwrap_or_default() {
            ShapeFunctionForm::Ugimp => Shape::Ugimp,
            ShapeFunctionForm::Linear => Shape::Linear,
            ShapeFunctionForm::Cpgimp => Shape::Cpgimp,
            ShapeFunctionForm::Cpdi => Shape::Cpdi,
        },
        transfer: match transfer {
            TransferForm::Flip => Transfer::Flip,
            TransferForm::Apic => Transfer::Apic,
            TransferForm::Tpic => Transfer::Tpic,
            TransferForm::Fmpm { order } => Transfer::Fmpm { order },
        },
        mean_dilatation: form.mean_dilatation,
    })
}

/// A body's frame: its own, the solid's, or the default.
pub(crate) fn frame(form: &BodyForm, solid: &SolidForm) -> Frame {
    let default = if solid.contact.is_some() { FrameForm::Updated } else { FrameForm::Total };
    match form.frame.or(solid.frame).unwrap_or(default) {
        FrameForm::Total => Frame::Total,
        FrameForm::Updated => Frame::Updated,
    }
}

/// Order of the stress update.
pub(crate) fn stress_update(form: StressUpdateForm) -> StressUpdate {
    match form {
        StressUpdateForm::Musl => StressUpdate::ModifiedLast,
        StressUpdateForm::Usf => StressUpdate::First,
        StressUpdateForm::Usl => StressUpdate::Last,
    }
}

/// Contact, which needs bodies in the updated frame.
pub(crate) fn contact(form: &SolidForm, check: &mut Checker<'_>) -> Option<Contact> {
    let friction = form.contact?.friction;
    let path = "solid.contact.friction";
    check.within(path, friction, "", friction >= 0.0, "at least 0");
    let help = "use `Updated`, or leave out `contact`";
    let message = |who: &str| {
        format!("{who} in the total frame cannot meet others, but `contact` asks for that")
    };
    if form.frame == Some(FrameForm::Total) {
        check.problem("solid.frame", message("bodies"), help);
    } else {
        for (index, body) in form.bodies.iter().enumerate() {
            if body.frame == Some(FrameForm::Total) {
                let path = format!("solid.bodies[{index}].frame");
                check.problem(&path, message(&format!("body `{}`", body.name)), help);
            }
        }
    }
    if form.bodies.len() < 2 {
        check.warn("`solid.contact` changes nothing: there is only one body".into());
    }
    Some(Contact { friction })
}

/// Relaxation, which searches for a state that nothing keeps moving.
pub(crate) fn relaxation(
    form: &SolidForm,
    has_fluid: bool,
    check: &mut Checker<'_>,
) -> Option<Relaxation> {
    let tolerance = form.relaxation?.tolerance;
    let inside = tolerance > 0.0 && tolerance <= 0.1;
    let allowed = "above 0 and at most 0.1";
    check.within("solid.relaxation.tolerance", tolerance, "", inside, allowed);
    if has_fluid {
        let message = "relaxation looks for the static state of a solid alone, and this case has a \
                       fluid";
        let help = "load the body by `loads` instead of water, or use `solid.damping`";
        check.problem("solid.relaxation", message.into(), help);
    }
    Some(Relaxation { tolerance })
}

/// Tells of boundaries that never let a relaxed solid come to rest.
pub(crate) fn report_restless(bodies: &[BodyPlan], end_time: f64, check: &mut Checker<'_>) {
    for boundary in bodies.iter().flat_map(|body| &body.boundaries) {
        if boundary.hold.motions().any(|motion| motion.velocity(end_time) != 0.0) {
            check.warn(format!(
                "boundary `{}` still moves at the end, so the solid cannot come to rest; drive it \
                 by a Table that ends",
                boundary.name
            ));
        }
    }
}
