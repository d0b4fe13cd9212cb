//! What is absent: the arrows between the crates, and what their sources must not hold.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, PackageId};
use pullback_tests::corpus::{read, root};

/// The resolved graph for this machine; nothing is downloaded.
fn metadata() -> Metadata {
    let version = Command::new("rustc").arg("-vV").output().expect("rustc");
    let version = String::from_utf8_lossy(&version.stdout).into_owned();
    let host = version
        .lines()
        .find_map(|l| l.strip_prefix("host: "))
        .expect("a host");
    MetadataCommand::new()
        .manifest_path(root().join("Cargo.toml"))
        .other_options(vec![
            "--offline".into(),
            "--filter-platform".into(),
            host.into(),
        ])
        .exec()
        .expect("cargo metadata")
}

/// Dependencies of a kind, by package.
type Arrows = BTreeMap<PackageId, Vec<PackageId>>;

fn arrows(metadata: &Metadata, kind: DependencyKind) -> Arrows {
    let nodes = &metadata.resolve.as_ref().expect("a resolved graph").nodes;
    let of = |node: &cargo_metadata::Node| {
        let wanted = |d: &&cargo_metadata::NodeDep| d.dep_kinds.iter().any(|k| k.kind == kind);
        node.deps
            .iter()
            .filter(wanted)
            .map(|d| d.pkg.clone())
            .collect()
    };
    nodes
        .iter()
        .map(|node| (node.id.clone(), of(node)))
        .collect()
}

fn package(metadata: &Metadata, name: &str) -> PackageId {
    let found = metadata.packages.iter().find(|p| p.name.as_str() == name);
    found
        .unwrap_or_else(|| panic!("no package {name}"))
        .id
        .clone()
}

fn name(metadata: &Metadata, id: &PackageId) -> String {
    metadata[id].name.as_str().to_owned()
}

/// Our own crates that one of ours depends on, for a kind of dependency.
fn ours(metadata: &Metadata, crate_name: &str, kind: DependencyKind) -> BTreeSet<String> {
    let all = arrows(metadata, kind);
    let found = &all[&package(metadata, crate_name)];
    let names = found.iter().map(|id| name(metadata, id));
    names.filter(|n| n.starts_with("pullback")).collect()
}

/// Everything that a crate links, itself included.
fn tree(metadata: &Metadata, crate_name: &str) -> BTreeSet<String> {
    let all = arrows(metadata, DependencyKind::Normal);
    let mut seen = BTreeSet::new();
    let mut open = vec![package(metadata, crate_name)];
    while let Some(id) = open.pop() {
        if seen.insert(id.clone()) {
            open.extend(all[&id].iter().cloned());
        }
    }
    seen.iter().map(|id| name(metadata, id)).collect()
}

#[test]
fn data_flows_one_way() {
    let metadata = metadata();
    let check = |from: &str, kind, to: &[&str]| {
        let expected: BTreeSet<String> = to.iter().map(|&s| s.to_owned()).collect();
        assert_eq!(
            ours(&metadata, from, kind),
            expected,
            "{kind:?} dependencies of {from}"
        );
    };
    let (grammar, compiler) = ("pullback-grammar", "pullback-compiler");
    check(grammar, DependencyKind::Normal, &[]);
    check(compiler, DependencyKind::Normal, &[grammar]);
    check(
        "pullback-runtime",
        DependencyKind::Normal,
        &[compiler, grammar],
    );
    for crate_name in [grammar, compiler, "pullback-runtime"] {
        check(crate_name, DependencyKind::Development, &[]);
        check(crate_name, DependencyKind::Build, &[]);
    }
    let members: BTreeSet<String> = metadata
        .workspace_members
        .iter()
        .map(|id| name(&metadata, id))
        .collect();
    let known = [grammar, compiler, "pullback-runtime", "pullback-tests"].map(str::to_owned);
    assert_eq!(
        members,
        BTreeSet::from(known),
        "a crate without its arrows here"
    );
}

#[test]
fn the_compiler_does_not_see_the_gpu() {
    let metadata = metadata();
    let compiler = tree(&metadata, "pullback-compiler");
    for absent in [
        "wgpu",
        "wgpu-core",
        "wgpu-hal",
        "wgpu-types",
        "ash",
        "winit",
        "pollster",
        "png",
    ] {
        assert!(!compiler.contains(absent), "the compiler links {absent}");
    }
    assert!(compiler.contains("naga"), "the tree has been read");
    let grammar = tree(&metadata, "pullback-grammar");
    for absent in ["naga", "glam", "wgpu"] {
        assert!(!grammar.contains(absent), "the grammar links {absent}");
    }
}

/// The Rust files of a folder that are no tests.
fn sources(folder: &str) -> Vec<PathBuf> {
    let mut out = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(at) = open.pop() {
        let is_test = at
            .file_name()
            .is_some_and(|n| n == "tests" || n == "tests.rs");
        if is_test {
            continue;
        }
        if at.is_dir() {
            let entries = fs::read_dir(&at).expect("a folder");
            open.extend(entries.filter_map(|entry| Some(entry.ok()?.path())));
        } else if at.extension().is_some_and(|e| e == "rs") {
            out.push(at);
        }
    }
    assert!(!out.is_empty(), "no sources in {folder}");
    out
}

/// The lines of a source that are compiled into the library: without comments and without what stands behind
/// `#[cfg(test)]`, which is a module at the end or the line that declares one.
fn library_lines(path: &Path) -> Vec<(usize, String)> {
    let text = read(path);
    let mut out = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        if line.trim() == "#[cfg(test)]" {
            match lines.next() {
                Some((_, next)) if next.trim_end().ends_with(';') => continue,
                _ => break,
            }
        }
        let code = line.split("//").next().unwrap_or_default();
        out.push((number + 1, code.to_owned()));
    }
    out
}

/// Lines of the folders that hold one of the words.
fn found(folders: &[&str], words: &[&str]) -> Vec<String> {
    let mut out = Vec::new();
    for path in folders.iter().flat_map(|folder| sources(folder)) {
        for (number, line) in library_lines(&path) {
            if words.iter().any(|word| line.contains(word)) {
                out.push(format!("{}:{number}: {}", path.display(), line.trim()));
            }
        }
    }
    out
}

fn check_absent(folders: &[&str], words: &[&str]) {
    let found = found(folders, words);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn grammar_and_compiler_touch_nothing_outside() {
    check_absent(
        &["grammar/src", "compiler/src"],
        &[
            "print!(",
            "println!(",
            "dbg!(",
            "std::fs",
            "std::process",
            "std::net",
            "std::env",
            "std::io",
            "std::thread",
            "std::time",
            "Instant::now",
            "SystemTime",
        ],
    );
}

#[test]
fn grammar_and_compiler_do_not_give_up() {
    check_absent(
        &["grammar/src", "compiler/src"],
        &[
            ".unwrap()",
            ".expect(",
            "panic!(",
            "unreachable!(",
            "todo!(",
            "unimplemented!(",
            "assert!(",
            "assert_eq!(",
            "assert_ne!(",
        ],
    );
}

#[test]
fn the_executor_knows_no_device() {
    check_absent(&["runtime/src/executor"], &["wgpu"]);
}

#[test]
fn nothing_is_unsafe_outside_of_the_runtime() {
    check_absent(&["grammar/src", "compiler/src", "tests/src"], &["unsafe "]);
}

#[test]
fn the_compiler_has_no_state_but_its_tables() {
    // the same text gives the same bytes: nothing is remembered between calls but what is built once
    check_absent(
        &["grammar/src", "compiler/src"],
        &[
            "static mut",
            "thread_local!",
            "Mutex",
            "RwLock",
            "sync::atomic",
        ],
    );
}
