//! Which columns share a plot.

use super::frame::Column;
use super::layout::Table;

/// One plot: columns of one unit that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plot {
    /// E.g. `pressure [Pa]`.
    pub title: String,
    /// Path of the plot; each column is an entity below it.
    pub path: String,
    /// Positions of the columns in their table.
    pub columns: Vec<usize>,
}

impl Plot {
    /// The entity of one column.
    pub fn entity(&self, column: usize) -> String {
        format!("{}/{column}", self.path)
    }
}

/// Groups the columns of a table, in order of first appearance.
///
/// `P1.pressure` and `P2.pressure` share the plot `pressure`; `crest.x` and
/// `crest.y` share `crest`; `base.force_x` and `base.force_y` share `base force`;
/// `energy.a` and `energy.b` of the ledger share `energy`.
pub fn group(table: Table, columns: &[Column]) -> Vec<Plot> {
    let mut plots: Vec<Plot> = Vec::new();
    for (i, column) in columns.iter().enumerate() {
        let title = format!("{} [{}]", subject(table, &column.name), column.unit);
        match plots.iter_mut().find(|plot| plot.title == title) {
            Some(plot) => plot.columns.push(i),
            None => {
                let path = format!("plots/{}/{}", table.name(), plots.len());
                plots.push(Plot { title, path, columns: vec![i] });
            }
        }
    }
    plots
}

fn subject(table: Table, name: &str) -> String {
    let Some((owner, quantity)) = name.rsplit_once('.') else {
        return name.into();
    };
    let component = |word| ["x", "y", "z", "xx", "yy", "zz", "xy", "yz", "xz"].contains(&word);
    match quantity.rsplit_once('_') {
        _ if component(quantity) || table == Table::Ledger => owner.into(),
        Some((vector, last)) if component(last) => format!("{owner} {vector}"),
        _ => quantity.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_grouped_and_units_never_mix() {
        let names =
            [("P1.pressure", "Pa"), ("crest.x", "m"), ("P2.pressure", "Pa"), ("crest.z", "m")];
        let forces = [("base.force_x", "N"), ("base.moment_y", "N m"), ("front", "m")];
        let columns: Vec<_> = names
            .into_iter()
            .chain(forces)
            .map(|(name, unit)| Column { name: name.into(), unit: unit.into() })
            .collect();
        let titles: Vec<_> = group(Table::Gauges, &columns)
            .into_iter()
            .map(|plot| (plot.title, plot.columns))
            .collect();
        let expected = [
            ("pressure [Pa]", vec![0, 2]),
            ("crest [m]", vec![1, 3]),
            ("base force [N]", vec![4]),
            ("base moment [N m]", vec![5]),
            ("front [m]", vec![6]),
        ];
        assert_eq!(titles, expected.map(|(title, columns)| (title.to_string(), columns)));
    }
}
