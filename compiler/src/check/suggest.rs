//! The nearest name to a misspelt one.

/// The candidate nearest to `name`, if it is near enough to be meant: by case, or by at most one edit for each
/// three letters (optimal string alignment distance: insertions, deletions, changes and swaps of neighbours).
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters: Vec<char> = name.chars().take(64).collect();
    // one letter is another name, not a slip
    let limit = if letters.len() > 1 {
        letters.len().div_ceil(3)
    } else {
        0
    };
    candidates
        .into_iter()
        .filter(|c| *c != name)
        .map(|c| {
            (
                distance(&letters, &c.chars().take(64).collect::<Vec<_>>()),
                c,
            )
        })
        .filter(|(d, c)| *d <= limit && *d < c.chars().count().max(letters.len()))
        .min_by_key(|(d, c)| (*d, c.len(), *c))
        .map(|(_, c)| c)
}

/// A name in backquotes, cut where it is long.
#[must_use]
pub fn quoted(name: &str) -> String {
    format!("`{}`", shortened(name))
}

/// A name or signature, cut where it is long.
#[must_use]
pub fn shortened(name: &str) -> String {
    const LIMIT: usize = 60;
    match name.char_indices().nth(LIMIT) {
        Some((at, _)) => format!("{}…", &name[..at]),
        None => name.to_owned(),
    }
}

fn distance(a: &[char], b: &[char]) -> usize {
    let same = |x: char, y: char| x.to_lowercase().eq(y.to_lowercase());
    let mut before: Vec<usize> = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let change = usize::from(!same(a[i - 1], b[j - 1]));
            row[j] = (above[j] + 1)
                .min(row[j - 1] + 1)
                .min(above[j - 1] + change);
            if i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]) {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_what_was_meant() {
        let names = ["sin", "sinh", "length", "smoothstep", "x", "y", "level"];
        let check =
            |typed, meant: Option<&str>| assert_eq!(nearest(typed, names), meant, "{typed}");
        check("sine", Some("sin"));
        check("lenght", Some("length"));
        check("SmoothStep", Some("smoothstep"));
        check("levle", Some("level"));
        check("q", None);
        check("Y", Some("y"));
        check("banana", None);
    }
}
