//! The nearest name to a misspelt one.

/// Most names that are compared, so that programs with very many names are answered soon.
const MAX_CANDIDATES: usize = 1000;

/// The candidate nearest to `name`, if it is near enough to be meant: by case, or by at most one edit for each
/// three letters (optimal string alignment distance: insertions, deletions, changes and swaps of neighbours).
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters = folded(name);
    // one letter is another name, not a slip
    let limit = if letters.len() > 1 {
        letters.len().div_ceil(3)
    } else {
        0
    };
    candidates
        .into_iter()
        .take(MAX_CANDIDATES)
        .filter(|c| *c != name && c.len().abs_diff(name.len()) <= 4 * limit)
        .filter_map(|c| {
            let other = folded(c);
            if other.len().abs_diff(letters.len()) > limit {
                return None;
            }
            let distance = distance(&letters, &other);
            let longest = other.len().max(letters.len());
            let pairs = letters.iter().zip(&other);
            let alike = pairs.take_while(|(a, b)| a == b).count();
            // of those equally near the one that begins like it
            let rank = (distance, std::cmp::Reverse(alike), c.len());
            (distance <= limit && distance < longest).then_some((rank, c))
        })
        .min_by_key(|&(rank, c)| (rank, c))
        .map(|(_, c)| c)
}

/// The beginning of a name without the difference of small and capital letters.
fn folded(name: &str) -> Vec<char> {
    name.chars().take(64).flat_map(char::to_lowercase).collect()
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
    let mut before: Vec<usize> = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (above[j] + 1)
                .min(row[j - 1] + 1)
                .min(above[j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
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
        let near = |names: [&'static str; 2]| nearest("laplace", names);
        assert_eq!(near(["plane", "laplacian"]), Some("laplacian"));
    }
}
