//! The tables of docs/surfaces.md.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use pullback_tests::corpus::{read, root};

use crate::facts::{Nodes, SURFACES, Surface};
use crate::rays::{Counts, measure};

const FACTS: [&str; 2] = [
    "<!-- facts: `BLESS=1 cargo test --workspace --test surfaces` -->\n",
    "<!-- end of the facts -->\n",
];
const RAYS: [&str; 2] = [
    "<!-- rays: `BLESS=1 cargo test --workspace --test surfaces` -->\n",
    "<!-- end of the rays -->\n",
];

fn document() -> PathBuf {
    root().join("docs/surfaces.md")
}

/// Head, body and tail of a text around two marks.
fn parts<'t>(text: &'t str, marks: &[&str; 2]) -> [&'t str; 3] {
    let (head, rest) = text.split_once(marks[0]).expect("a place for the table");
    let (body, tail) = rest.split_once(marks[1]).expect("its end");
    [head, body, tail]
}

fn with_body(text: &str, marks: &[&str; 2], body: &str) -> String {
    let [head, _, tail] = parts(text, marks);
    format!("{head}{}{body}{}{tail}", marks[0], marks[1])
}

fn checked(surface: &Surface) -> String {
    match surface.nodes {
        Nodes::Exact(_) => format!("{}, in closed form", surface.count),
        Nodes::Near(_) => format!("{}", surface.count),
        Nodes::Unclaimed => String::new(),
    }
}

fn facts() -> String {
    let mut out = String::from(
        "| Surface | Degree | Singular | Nodes checked | Points checked | Symmetries | Equation |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for s in SURFACES {
        let points = if s.points.is_some() { "yes" } else { "" };
        let _ = writeln!(
            out,
            "| [{}](surfaces/{}.pull) | {} | {} | {} | {points} | {} | {} |",
            s.title,
            s.name,
            s.degree,
            s.singular,
            checked(s),
            s.symmetry.name(),
            s.source
        );
    }
    out
}

#[test]
fn the_document_has_the_facts() {
    if std::env::var_os("BLESS").is_some() {
        // The test of rays writes both tables.
        return;
    }
    let text = read(&document());
    assert!(
        parts(&text, &FACTS)[1] == facts(),
        "docs/surfaces.md is not up to date: run with BLESS=1 and read the difference"
    );
}

/// Measures all surfaces, on all cores.
fn measured() -> Vec<Counts> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let results = Mutex::new(vec![Counts::default(); SURFACES.len()]);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    let Some(surface) = SURFACES.get(k) else {
                        break;
                    };
                    let counts = measure(surface, &[]);
                    results.lock().expect("no panic")[k] = counts;
                }
            });
        }
    });
    results.into_inner().expect("no panic")
}

fn row(surface: &Surface, c: &Counts) -> String {
    format!(
        "| {} | {} | {} | {} | {} | {} | {} | {} |",
        surface.name, c.hits, c.grazing, c.missed, c.invented, c.displaced, c.off, c.tilted
    )
}

fn rays(all: &[Counts]) -> String {
    let mut out = String::from(
        "| Surface | hits | not judged | missed | invented | displaced | off, 10⁻⁶ | tilted |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for (surface, counts) in SURFACES.iter().zip(all) {
        let _ = writeln!(out, "{}", row(surface, counts));
    }
    out
}

/// The numbers of a row.
fn listed(row: &str) -> Vec<usize> {
    row.split('|')
        .filter_map(|cell| cell.trim().parse().ok())
        .collect()
}

#[test]
fn rays_meet_the_surfaces_where_their_roots_are() {
    let all = measured();
    let text = read(&document());
    if std::env::var_os("BLESS").is_some() {
        let text = with_body(&text, &FACTS, &facts());
        let text = with_body(&text, &RAYS, &rays(&all));
        std::fs::write(document(), text).expect("the document is written");
        return;
    }
    let rows: Vec<&str> = parts(&text, &RAYS)[1].lines().skip(2).collect();
    assert_eq!(rows.len(), SURFACES.len());
    for ((surface, counts), listed_row) in SURFACES.iter().zip(&all).zip(rows) {
        assert!(listed_row.starts_with(&format!("| {} |", surface.name)));
        assert!(counts.hits > 10, "{}: {} hits", surface.name, counts.hits);
        let found = listed(&row(surface, counts));
        let most = listed(listed_row);
        assert_eq!(found[0], most[0], "{}: hits", surface.name);
        for (found, most) in found.iter().zip(&most).skip(1) {
            assert!(
                found <= most,
                "{}: {counts:?}, not {listed_row}",
                surface.name
            );
        }
    }
}

/// With eight steps the march steps over thin parts, and the counts tell.
#[test]
fn what_a_coarse_march_misses_is_counted() {
    let surface = SURFACES.iter().find(|s| s.name == "barth-decic");
    let counts = measure(surface.expect("it"), &[("steps", [8.0; 3])]);
    assert!(counts.missed + counts.displaced > 5, "{counts:?}");
}

/// Depths and normals under the other cameras: no worse than under the one of the table, up to rays that touch.
#[test]
fn every_camera_finds_the_surfaces() {
    const LOOK_AT: [(&str, [f64; 3]); 3] = [
        ("camera", [1.0; 3]),
        ("eye", [-9.0, 6.0, 7.0]),
        ("up", [1.0, 0.0, 2.0]),
    ];
    const PARALLEL: (&str, [f64; 3]) = ("projection", [1.0; 3]);
    let cameras = [
        ("orbit", vec![("yaw", [75.0; 3]), ("pitch", [-40.0; 3])]),
        ("look-at", LOOK_AT.to_vec()),
        ("orthographic", vec![PARALLEL]),
        ("orthographic look-at", [&LOOK_AT[..], &[PARALLEL]].concat()),
    ];
    for name in ["clebsch", "cayley", "torus", "heart", "barth-sextic"] {
        let surface = SURFACES.iter().find(|s| s.name == name).expect("it");
        for (camera, changes) in &cameras {
            let counts = measure(surface, changes);
            println!("{name}, {camera}: {counts:?}");
            assert!(counts.hits > 20, "{name}, {camera}: {counts:?}");
            let wrong = counts.missed + counts.invented + counts.displaced + counts.tilted;
            assert!(
                wrong == 0 && counts.off <= 3,
                "{name}, {camera}: {counts:?}"
            );
        }
    }
}
