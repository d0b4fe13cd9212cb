//! The nearest name to a misspelt one.

use smallvec::SmallVec;

/// Letters of a name that are compared.
const MAX_LETTERS: usize = 64;

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
            let distance = distance(&letters, &other, limit);
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
fn folded(name: &str) -> SmallVec<[char; MAX_LETTERS]> {
    let letters = name.chars().flat_map(char::to_lowercase);
    letters.take(MAX_LETTERS).collect()
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

/// The distance of two names of at most [`MAX_LETTERS`] letters, or more than `limit` where it is above that.
fn distance(a: &[char], b: &[char], limit: usize) -> usize {
    let mut before = [0; MAX_LETTERS + 1];
    let mut above: [usize; MAX_LETTERS + 1] = std::array::from_fn(|j| j);
    let mut row = [0; MAX_LETTERS + 1];
    for i in 1..=a.len() {
        row[0] = i;
        let mut least = i;
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (above[j] + 1)
                .min(row[j - 1] + 1)
                .min(above[j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
            least = least.min(row[j]);
        }
        // a swap of neighbours looks two rows up
        if least > limit + 1 {
            return least;
        }
        (before, above) = (above, row);
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
