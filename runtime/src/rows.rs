//! Tables of numbers as text: one row a line, columns separated by blanks or tabs, `#` comments.

use std::fmt;
use std::io::{self, BufRead, Write};

/// Longest line that is read. A row of 16 numbers needs far less.
const MAX_LINE: usize = 64 << 10;

/// A number that rows are made of.
pub trait Number: Copy + std::str::FromStr + fmt::Debug + PartialEq {
    /// Whether it is an infinity.
    fn is_infinite(self) -> bool;
}

impl Number for f32 {
    fn is_infinite(self) -> bool {
        self.is_infinite()
    }
}

impl Number for f64 {
    fn is_infinite(self) -> bool {
        self.is_infinite()
    }
}

/// What is wrong with a row, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowError {
    /// Line, from 1.
    pub line: u64,
    /// Column in characters, from 1.
    pub column: usize,
    /// The problem.
    pub message: String,
}

impl fmt::Display for RowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "line {}, column {}: {}",
            self.line, self.column, self.message
        )
    }
}

/// Reads rows of `columns` numbers from text, a batch at a time.
#[derive(Debug)]
pub struct RowReader<R> {
    input: R,
    columns: usize,
    line: u64,
    text: Vec<u8>,
    /// Numbers that were finite in the text and are not in the format.
    overflows: u64,
}

impl<R: BufRead> RowReader<R> {
    /// Reads from `input`.
    pub fn new(input: R, columns: usize) -> Self {
        Self {
            input,
            columns,
            line: 0,
            text: Vec::new(),
            overflows: 0,
        }
    }

    /// How many finite numbers so far lay beyond the format and were taken as infinite.
    #[must_use]
    pub fn overflows(&self) -> u64 {
        self.overflows
    }

    /// Appends up to `limit` rows to `values`; returns how many, zero at the end. Bad rows go to `errors` and are
    /// not counted.
    ///
    /// # Errors
    /// Those of the input.
    pub fn read<T: Number>(
        &mut self,
        limit: usize,
        values: &mut Vec<T>,
        errors: &mut Vec<RowError>,
    ) -> io::Result<usize> {
        let mut rows = 0;
        while rows < limit && self.next_line()? {
            match parse_row(
                &self.text,
                self.line,
                self.columns,
                values,
                &mut self.overflows,
            ) {
                Ok(true) => rows += 1,
                Ok(false) => {}
                Err(error) => {
                    errors.push(error);
                    // The caller decides how many are enough.
                    break;
                }
            }
        }
        Ok(rows)
    }

    /// Puts the next line into `text`; `false` at the end. What exceeds [`MAX_LINE`] is cut off, which leaves an
    /// unreadable row.
    fn next_line(&mut self) -> io::Result<bool> {
        self.text.clear();
        let mut some = false;
        loop {
            let chunk = match self.input.fill_buf() {
                Ok(chunk) => chunk,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error),
            };
            if chunk.is_empty() {
                break;
            }
            some = true;
            let end = chunk.iter().position(|&b| b == b'\n');
            let used = end.map_or(chunk.len(), |at| at + 1);
            let room = (MAX_LINE + 1).saturating_sub(self.text.len());
            self.text.extend_from_slice(&chunk[..used.min(room)]);
            self.input.consume(used);
            if end.is_some() {
                break;
            }
        }
        self.line += u64::from(some);
        Ok(some)
    }
}

/// Appends the numbers of a line to `values`; `false` if it has none. A bad line leaves `values` as it was.
fn parse_row<T: Number>(
    line: &[u8],
    number: u64,
    columns: usize,
    values: &mut Vec<T>,
    overflows: &mut u64,
) -> Result<bool, RowError> {
    let bad = |at: usize, message: String| RowError {
        line: number,
        column: String::from_utf8_lossy(&line[..at]).chars().count() + 1,
        message,
    };
    if line.len() > MAX_LINE {
        return Err(bad(0, format!("line of more than {MAX_LINE} bytes")));
    }
    let content = line
        .iter()
        .position(|&b| b == b'#')
        .map_or(line, |at| &line[..at]);
    // A mark that some editors put at the beginning of a file.
    let skip = if number == 1 && content.starts_with(b"\xef\xbb\xbf") {
        3
    } else {
        0
    };
    let start = values.len();
    let mut count = 0;
    for (at, word) in words(content, skip) {
        match parse_number::<T>(word) {
            _ if count == columns => {
                values.truncate(start);
                return Err(bad(at, format!("more than {}", numbers(columns))));
            }
            Some(value) => {
                if value.is_infinite() && word.iter().any(u8::is_ascii_digit) {
                    *overflows += 1;
                }
                values.push(value);
                count += 1;
            }
            None => {
                values.truncate(start);
                let shown: String = String::from_utf8_lossy(word).chars().take(40).collect();
                return Err(bad(at, format!("`{shown}` is not a number")));
            }
        }
    }
    if count == 0 {
        return Ok(false);
    }
    if count < columns {
        values.truncate(start);
        let end = content.trim_ascii_end().len();
        return Err(bad(
            end,
            format!(
                "{} expected, but the row ends after {count}",
                numbers(columns)
            ),
        ));
    }
    Ok(true)
}

fn numbers(count: usize) -> String {
    match count {
        1 => "1 number".into(),
        n => format!("{n} numbers"),
    }
}

/// The words of a line with their offsets.
fn words(line: &[u8], skip: usize) -> impl Iterator<Item = (usize, &[u8])> {
    let mut at = skip;
    std::iter::from_fn(move || {
        let start = at
            + line
                .get(at..)?
                .iter()
                .position(|b| !b.is_ascii_whitespace())?;
        let length = line[start..]
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(line.len() - start);
        at = start + length;
        Some((start, &line[start..at]))
    })
}

/// A number, rounded once to the format; also `nan`, `inf`, `-inf`, in any case, and a leading minus U+2212.
fn parse_number<T: Number>(word: &[u8]) -> Option<T> {
    let text = std::str::from_utf8(word).ok()?;
    match text.strip_prefix('\u{2212}') {
        Some(rest) if rest.starts_with(['-', '+']) => None,
        Some(rest) => format!("-{rest}").parse().ok(),
        None => text.parse().ok(),
    }
}

/// Writes rows of `columns` numbers, separated by tabs, each in the fewest digits that give it back.
///
/// # Errors
/// Those of the output.
pub fn write_rows<T: Number>(
    output: &mut dyn Write,
    columns: usize,
    values: &[T],
) -> io::Result<()> {
    let mut line = String::new();
    for row in values.chunks_exact(columns.max(1)) {
        line.clear();
        for (i, &value) in row.iter().enumerate() {
            if i > 0 {
                line.push('\t');
            }
            push_number(&mut line, value);
        }
        line.push('\n');
        output.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// Appends the shortest decimal that reads back as the same number.
fn push_number<T: Number>(line: &mut String, value: T) {
    use fmt::Write;
    let start = line.len();
    // Debug prints like Display, but with an exponent where that is long. Writing to a string cannot fail.
    let _ = write!(line, "{value:?}");
    if line.ends_with(".0") {
        line.truncate(line.len() - 2);
    }
    if line[start..].eq_ignore_ascii_case("nan") {
        line.truncate(start);
        line.push_str("nan");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read<T: Number>(columns: usize, text: &[u8]) -> (Vec<T>, Vec<String>) {
        let mut reader = RowReader::new(text, columns);
        let (mut values, mut errors) = (Vec::new(), Vec::new());
        loop {
            let before = errors.len();
            if reader.read(2, &mut values, &mut errors).unwrap() == 0 && errors.len() == before {
                break;
            }
        }
        (values, errors.iter().map(RowError::to_string).collect())
    }

    #[test]
    fn rows_in() {
        let check = |columns, text: &str, values: &[f64]| {
            assert_eq!(
                read::<f64>(columns, text.as_bytes()),
                (values.to_vec(), vec![]),
                "{text:?}"
            );
        };
        check(2, "1 2\n", &[1.0, 2.0]);
        check(2, "1\t2", &[1.0, 2.0]);
        check(
            2,
            "\n# c\n 1e3  -2.5 # d\r\n\n+.5 5.\n",
            &[1e3, -2.5, 0.5, 5.0],
        );
        check(
            1,
            "inf\n-inf\nInfinity\n",
            &[f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY],
        );
        check(1, "\u{feff}1\n\u{2212}3\n", &[1.0, -3.0]);
        check(1, "", &[]);
        check(1, "#", &[]);
        assert!(read::<f64>(1, b"nan NaN").1.len() == 1);
        assert!(read::<f64>(1, b"nan\n-nan").0.iter().all(|v| v.is_nan()));
    }

    #[test]
    fn bad_rows() {
        let check = |columns, text: &[u8], errors: &[&str]| {
            assert_eq!(read::<f64>(columns, text).1, errors, "{text:?}");
        };
        check(
            2,
            b"1\n",
            &["line 1, column 2: 2 numbers expected, but the row ends after 1"],
        );
        check(1, b"1 2\n", &["line 1, column 3: more than 1 number"]);
        check(
            2,
            b"1 2\n\n3  x # y\n4 5\n6 7 8",
            &[
                "line 3, column 4: `x` is not a number",
                "line 5, column 5: more than 2 numbers",
            ],
        );
        check(1, b"1,5", &["line 1, column 1: `1,5` is not a number"]);
        check(
            1,
            b"\xff\xfe",
            &["line 1, column 1: `\u{fffd}\u{fffd}` is not a number"],
        );
        check(
            2,
            "π 1".as_bytes(),
            &["line 1, column 1: `π` is not a number"],
        );
        check(
            2,
            "1 π".as_bytes(),
            &["line 1, column 3: `π` is not a number"],
        );
        let long = vec![b'1'; MAX_LINE * 3];
        check(
            1,
            &long,
            &["line 1, column 1: line of more than 65536 bytes"],
        );
    }

    #[test]
    fn good_rows_before_and_after_a_bad_one_are_read() {
        assert_eq!(read::<f64>(1, b"1\nx\n2").0, [1.0, 2.0]);
    }

    #[test]
    fn numbers_are_rounded_once_to_single_precision() {
        // Halfway between two floats, and a little more: by way of f64 it would fall on the even one below.
        let text = b"1.00000005960464477540";
        assert_eq!(read::<f32>(1, text).0, [1.000_000_1]);
        let mut reader = RowReader::new(&b"1e50\ninf\n-1e50\n1e38"[..], 1);
        let mut values = Vec::new();
        reader.read::<f32>(9, &mut values, &mut Vec::new()).unwrap();
        assert_eq!(
            values,
            [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, 1e38]
        );
        assert_eq!(reader.overflows(), 2);
    }

    #[test]
    fn numbers_out() {
        let text = |values: &[f32]| {
            let mut out = Vec::new();
            write_rows(&mut out, values.len(), values).unwrap();
            String::from_utf8(out).unwrap()
        };
        assert_eq!(
            text(&[1.0, -0.0, 0.1, 1e38, 1e-45]),
            "1\t-0\t0.1\t1e38\t1e-45\n"
        );
        assert_eq!(
            text(&[f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY]),
            "nan\tnan\tinf\t-inf\n"
        );
        assert_eq!(
            text(&[16_777_217.0, 0.333_333_34]),
            "16777216\t0.33333334\n"
        );
        for bits in (0..u32::MAX).step_by(65_537) {
            let value = f32::from_bits(bits);
            let back: f32 = text(&[value]).trim().parse().unwrap();
            assert!(back.to_bits() == bits || value.is_nan(), "{bits:x}");
        }
    }
}
