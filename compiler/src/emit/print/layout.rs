//! Lines of bounded length.

/// Columns of a line.
pub(super) const WIDTH: usize = 100;

/// A statement, indented by levels of four blanks, broken where it is longer than a line: at its outermost operators and commas.
pub(super) fn wrap(line: &str, level: usize) -> String {
    let mut out = String::new();
    let mut rest = line.trim_end();
    let mut indent = 4 * level;
    let inner = 4 * (level + 1);
    while indent + rest.chars().count() > WIDTH {
        let room = WIDTH - indent;
        let Some(cut) = best_break(rest, room).or_else(|| bracket(rest, room)) else {
            break;
        };
        out.extend(std::iter::repeat_n(' ', indent));
        out.push_str(rest[..cut].trim_end());
        out.push('\n');
        rest = rest[cut..].trim_start();
        indent = inner;
    }
    out.extend(std::iter::repeat_n(' ', indent));
    out.push_str(rest);
    out.push('\n');
    out
}

/// Behind an opening bracket, the first that leaves no short line: for calls within calls, without a better place.
fn bracket(line: &str, room: usize) -> Option<usize> {
    let mut all = line.match_indices('(').map(|(at, _)| at + 1);
    all.find(|at| (room / 4..room).contains(at))
}

/// How loosely an operator binds; breaks are before the loosest.
fn looseness(operator: &str) -> Option<u8> {
    Some(match operator {
        "?" | ":" => 1,
        "||" => 2,
        "&&" => 3,
        "|" | "^" | "&" => 4,
        "+" | "-" => 5,
        "*" | "/" | "%" => 6,
        _ => return None,
    })
}

/// Where to break: behind a comma or before an operator. Of the places that fit the outermost, of those the one before the loosest
/// operator, of those the last.
fn best_break(line: &str, room: usize) -> Option<usize> {
    let bytes = line.as_bytes();
    let mut depth = 0_usize;
    let mut best: Option<((usize, u8), usize)> = None;
    for (at, &byte) in bytes.iter().enumerate() {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            b' ' if at > 0 => {
                let rest = &line[at + 1..];
                let word = rest.split(' ').next().unwrap_or("");
                let place = match bytes[at - 1] {
                    b',' => Some(0),
                    _ => looseness(word),
                };
                // not right at the begin, where little would stand on the line
                if let Some(loose) = place
                    && at <= room
                    && at > room / 4
                    && best.is_none_or(|(known, _)| (depth, loose) <= known)
                {
                    best = Some(((depth, loose), at));
                }
            }
            _ => {}
        }
        if at > room {
            break;
        }
    }
    best.map(|(_, at)| at)
}

/// A comment of one or more lines.
pub(in crate::emit) fn comment(text: &str, mark: &str) -> String {
    let mut out = String::new();
    for line in text.lines() {
        let mut column = 0;
        let lead: String = line.chars().take_while(|c| *c == ' ').collect();
        out.push_str(mark);
        for word in line.split_whitespace() {
            let length = word.chars().count();
            if column > 0 && mark.len() + 1 + column + length > WIDTH {
                out.push('\n');
                out.push_str(mark);
                out.push_str(&lead);
                out.push_str("    ");
                column = lead.len() + 4;
            }
            if column == 0 {
                out.push_str(&lead);
                column = lead.len();
            }
            out.push(' ');
            out.push_str(word);
            column += length + 1;
        }
        out.push('\n');
    }
    out
}
