//! Random programs: what is printed of them reads back as them, with comments and formatted too; damaged ones are
//! read, and what is accepted of them is printed and read as well.

mod support;

use std::collections::HashMap;
use std::mem::discriminant;

use pullback_grammar::ast::Item;
use pullback_grammar::{format, parse, print, same_tree};
use support::generate::{Random, damaged, program, with_comments};
use support::{is_function, read};

const COUNT: u64 = 100_000;

#[test]
fn programs_are_read_as_they_are_printed() {
    let (mut nodes, mut statements) = (HashMap::new(), HashMap::new());
    for seed in 0..COUNT {
        let random = &mut Random::new(seed);
        let file = program(random);
        for (_, expr, _) in file.exprs.iter() {
            *nodes.entry(discriminant(expr)).or_insert(0_u32) += 1;
        }
        for item in &file.items {
            *statements
                .entry(discriminant::<Item>(item))
                .or_insert(0_u32) += 1;
        }
        let printed = print(&file);
        let parsed = parse(&printed, &is_function);
        assert!(
            !parsed.has_errors(),
            "{seed}:\n{printed}\n{:?}",
            parsed.diagnostics
        );
        assert!(same_tree(&file, &parsed.file), "{seed}:\n{printed}");
        assert_eq!(print(&parsed.file), printed, "{seed}");

        let commented = with_comments(&printed, random);
        let formatted = format(&commented, &is_function);
        let formatted = formatted.unwrap_or_else(|| panic!("{seed}:\n{commented}"));
        let parsed = parse(&formatted, &is_function);
        assert!(
            same_tree(&file, &parsed.file),
            "{seed}:\n{printed}\n{commented}\n{formatted}"
        );
    }
    assert_eq!(nodes.len(), 15, "every node but the error");
    assert_eq!(statements.len(), 5);
    assert!(
        nodes
            .values()
            .chain(statements.values())
            .all(|&count| count > 5000)
    );
}

#[test]
fn damaged_programs_are_read() {
    let mut accepted = 0;
    for seed in 0..15_000 {
        let random = &mut Random::new(seed);
        let text = damaged(&print(&program(random)), random);
        let parsed = read(&text);
        if parsed.has_errors() {
            continue;
        }
        accepted += 1;
        let printed = print(&parsed.file);
        let again = read(&printed);
        assert!(
            !again.has_errors(),
            "{seed}:\n{text}\n{printed}\n{:?}",
            again.diagnostics
        );
        assert!(
            same_tree(&parsed.file, &again.file),
            "{seed}:\n{text}\n{printed}"
        );
        assert_eq!(print(&again.file), printed, "{seed}:\n{text}");
    }
    assert!((1000..10_000).contains(&accepted), "{accepted}");
}
