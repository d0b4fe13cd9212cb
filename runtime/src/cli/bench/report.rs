//! All tables and charts of a folder on one page that needs no other file.

use std::fmt::Write as _;
use std::path::Path;

use clap::ValueEnum;
use pullback_runtime::atomic_file;

use super::parts::Part;
use crate::cli::failure::Failure;
use crate::cli::render::name;

const STYLE: &str = "body { font: 15px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; \
    color: #222 } table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px } \
    td, th { padding: .1rem .6rem; text-align: right; border-bottom: 1px solid #ddd } \
    td:first-child, th:first-child { text-align: left } svg { max-width: 100%; height: auto }";

/// Writes the page of the tables that there are.
pub(super) fn write(folder: &Path) -> Result<(), Failure> {
    let mut found = Vec::new();
    for &part in Part::value_variants() {
        let path = folder.join(part.file());
        let Ok(table) = std::fs::read_to_string(&path) else {
            continue;
        };
        let chart = std::fs::read_to_string(path.with_extension("svg")).unwrap_or_default();
        found.push((part, table, chart));
    }
    let path = folder.join("report.html");
    atomic_file::write_text(&path, &page(&found)).map_err(|error| Failure::Io {
        what: name(&path),
        error,
    })
}

fn page(found: &[(Part, String, String)]) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>pullback bench</title>\n\
         <style>{STYLE}</style>\n<h1>What pullback costs and gives</h1>\n<ul>\n"
    );
    for (part, ..) in found {
        let (title, file) = (part.title(), part.file());
        let _ = writeln!(out, "<li><a href=\"#{file}\">{title}</a></li>");
    }
    out += "</ul>\n";
    for (part, table, chart) in found {
        let (title, file) = (part.title(), part.file());
        let _ = writeln!(out, "<h2 id=\"{file}\">{title}</h2>");
        out += chart;
        out += &html(table);
    }
    out + "</html>\n"
}

/// A text with one table in Markdown.
fn html(text: &str) -> String {
    let mut out = String::new();
    let mut in_table = false;
    for line in text.lines() {
        let cells = cells(line);
        if cells.is_empty() {
            if in_table {
                out += "</table>\n";
            }
            in_table = false;
            if !line.trim().is_empty() {
                let _ = writeln!(out, "<p>{}</p>", formatted(line));
            }
            continue;
        }
        if cells
            .iter()
            .all(|cell| cell.trim_matches([':', '-']).is_empty() && !cell.is_empty())
        {
            continue;
        }
        let kind = if in_table { "td" } else { "th" };
        if !in_table {
            out += "<table>\n";
        }
        in_table = true;
        out += "<tr>";
        for cell in cells {
            let _ = write!(out, "<{kind}>{}</{kind}>", formatted(&cell));
        }
        out += "</tr>\n";
    }
    if in_table {
        out += "</table>\n";
    }
    out
}

/// The cells of a line of a table; none of another line.
fn cells(line: &str) -> Vec<String> {
    let Some(rest) = line.strip_prefix('|') else {
        return Vec::new();
    };
    // a bar in a cell is written with a backslash
    let rest = rest.trim_end().strip_suffix('|').unwrap_or(rest);
    let rest = rest.replace("\\|", "\u{1}");
    rest.split('|')
        .map(|cell| cell.trim().replace('\u{1}', "|"))
        .collect()
}

/// Text with code between backticks, and bold words.
fn formatted(text: &str) -> String {
    let text = text
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace("**", "");
    let mut out = String::new();
    for (k, piece) in text.split('`').enumerate() {
        out += match k {
            0 => "",
            odd if odd % 2 == 1 => "<code>",
            _ => "</code>",
        };
        out += piece;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_become_html() {
        let text = "an adapter; `fast` < all\n\n| name | a |\n| --- | ---: |\n| `\\|x\\|` | 1 |\n| **median** | 2 |\n\nend\n";
        assert_eq!(
            html(text),
            "<p>an adapter; <code>fast</code> &lt; all</p>\n<table>\n<tr><th>name</th><th>a</th></tr>\n\
             <tr><td><code>|x|</code></td><td>1</td></tr>\n<tr><td>median</td><td>2</td></tr>\n</table>\n<p>end</p>\n"
        );
    }
}
