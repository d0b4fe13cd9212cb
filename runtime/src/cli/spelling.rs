//! What a misspelt name was probably meant to be.

/// The known name that is nearest to `name`, if it is near.
pub(super) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    known
        .into_iter()
        .map(|known| (distance(name, known), known))
        .min()
        .filter(|(distance, known)| 2 * distance <= known.chars().count())
        .map(|(_, known)| known)
}

/// Levenshtein's edit distance, by the rows of its table.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        assert_eq!(distance("levle", "level"), 2);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("gain", "gain"), 0);
    }

    #[test]
    fn near_names() {
        assert_eq!(nearest("gian", ["level", "gain"]), Some("gain"));
        assert_eq!(nearest("k", ["level", "gain"]), None);
        assert_eq!(nearest("k", []), None);
    }
}
