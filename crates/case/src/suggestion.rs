//! The valid name nearest to a mistyped one.

/// The entry of `valid` with the fewest edits from `found`, upper and lower case
/// alike, unless it is too far away to be meant.
///
/// ```
/// assert_eq!(case::nearest_name("spacng", ["density", "spacing"]), Some("spacing"));
/// assert_eq!(case::nearest_name("viscosity", ["density", "spacing"]), None);
/// ```
pub fn nearest_name<'a>(found: &str, valid: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = found.to_lowercase();
    valid
        .into_iter()
        .map(|name| (edit_distance(&wanted, &name.to_lowercase()), name))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, name)| *distance <= name.chars().count().max(3) / 2)
        .map(|(_, name)| name)
}

/// Help text: the nearest name, then all valid ones.
pub(crate) fn help(found: &str, valid: &[&str]) -> String {
    let list = valid.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    match (nearest_name(found, valid.iter().copied()), valid.is_empty()) {
        (_, true) => "nothing can be named here".into(),
        (Some(name), _) => format!("did you mean `{name}`? Valid here: {list}"),
        (None, _) => format!("valid here: {list}"),
    }
}

/// Levenshtein distance, with a swap of neighbours counted once.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before_last = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let substitute = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = substitute.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before_last[j - 2] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn typing_errors_find_their_name() {
        let names = ["spacing", "density", "sound_speed", "blocks"];
        for (typed, meant) in
            [("spacng", "spacing"), ("densitiy", "density"), ("soundspeed", "sound_speed")]
        {
            assert_eq!(nearest_name(typed, names), Some(meant));
        }
        assert_eq!(nearest_name("viscosity_model", names), None);
        assert_eq!(edit_distance("abcd", "abdc"), 1);
    }
}
