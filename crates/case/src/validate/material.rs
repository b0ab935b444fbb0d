//! Constitutive laws.

use gimpm::{Material, MaterialModel};

use crate::format::MaterialForm;

use super::Checker;
use super::checker::short;

/// Bulk over shear modulus above which linear cells lock (ν above about 0.45).
const NEARLY_INCOMPRESSIBLE: f64 = 10.0;

/// Checks the constants of a law by the law itself.
pub(crate) fn plan(
    form: &MaterialForm,
    body: &str,
    check: &mut Checker<'_>,
) -> Option<MaterialModel> {
    let model = form.model();
    let Err(error) = model.validate() else { return Some(model) };
    let of = |unit: &str, link: &str| {
        if unit.is_empty() { String::new() } else { format!("{link}{unit}") }
    };
    let path = format!("{body}.material");
    // A condition on several constants belongs to the material as a whole.
    let field = if error.name.contains(' ') { path } else { format!("{path}.{}", error.name) };
    let message = format!("{} is {}{}", error.name, error.value, of(error.unit, " "));
    check.problem(
        &field,
        message,
        &format!("it must be {}{}", error.allowed, of(error.unit, ", in ")),
    );
    None
}

/// Bulk over shear modulus, where the law is so stiff against volume change that it locks.
pub(crate) fn locking(form: &MaterialForm) -> Option<String> {
    let ratio = match *form {
        MaterialForm::MooneyRivlin { c10, c01, bulk_modulus, .. } => {
            bulk_modulus / (2.0 * (c10 + c01))
        }
        MaterialForm::LinearElastic { poisson_ratio, .. }
        | MaterialForm::StVenantKirchhoff { poisson_ratio, .. }
        | MaterialForm::NeoHookean { poisson_ratio, .. }
        | MaterialForm::VonMises { poisson_ratio, .. }
        | MaterialForm::DruckerPrager { poisson_ratio, .. } => {
            2.0 * (1.0 + poisson_ratio) / (3.0 * (1.0 - 2.0 * poisson_ratio))
        }
    };
    (ratio > NEARLY_INCOMPRESSIBLE).then(|| short(ratio))
}
