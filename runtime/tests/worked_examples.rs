//! The commands in the pages of documentation print what the pages say. `BLESS=1` rewrites the pages.

mod shared;

use std::path::Path;

use shared::pullback;

/// Prefix of a line with a command; its output follows, indented as the command is.
const PROMPT: &str = "    $ pullback ";

/// Arguments of a command line with simple quotes.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (k, part) in line.split('\'').enumerate() {
        if k % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// The page with the output that its commands have now.
fn current(page: &str, folder: &Path) -> String {
    let mut out = String::new();
    let mut lines = page.lines().peekable();
    while let Some(line) = lines.next() {
        out += line;
        out.push('\n');
        let Some(command) = line.strip_prefix(PROMPT) else {
            continue;
        };
        let command = words(command);
        let command: Vec<&str> = command.iter().map(String::as_str).collect();
        let (_, output, errors) = pullback(folder, &command);
        assert_eq!(errors, "", "{line}");
        for line in output.lines() {
            let indented = format!("    {line}");
            out += indented.trim_end();
            out.push('\n');
        }
        // the old output ends where the indentation does
        while let Some(next) = lines.peek() {
            if !next.is_empty() && !next.starts_with("    ") {
                break;
            }
            lines.next();
            if lines.peek().is_some_and(|line| line.starts_with(PROMPT)) {
                break;
            }
        }
        out.push('\n');
    }
    out
}

#[test]
fn pages_hold_what_commands_print() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    for name in ["probe.md", "diff.md"] {
        let path = docs.join(name);
        let page = std::fs::read_to_string(&path).unwrap();
        let now = current(&page, &docs);
        if std::env::var_os("BLESS").is_some() {
            std::fs::write(&path, &now).unwrap();
        } else {
            assert!(
                page == now,
                "{name} is not current; BLESS=1 rewrites it:\n{now}"
            );
        }
    }
}
