//! Integrands of public test problems beside other programs: tests/oracle/integrals_peers.py.

use std::fmt::Write as _;
use std::path::Path;

use pullback_compiler::What;
use pullback_compiler::integrate::{Otherwise, field_integral};
use pullback_compiler::lower::Precision;
use pullback_runtime::executor::Arithmetic;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::stability::tables::digit;

use super::{DOUBLE, Ray, SINGLE, formula, points, with_allowances};

/// An integrand with what the others made of it.
struct Problem {
    source: String,
    text: String,
    peers: [Verdict; 2],
    rays: Vec<Ray>,
}

/// What a program made of an integrand.
#[derive(Clone, Debug, PartialEq)]
enum Verdict {
    /// It was not asked.
    Unknown,
    /// Nothing was found.
    None,
    /// What was found is not the integral.
    Wrong,
    /// Errors in binary32 as parts of ∫ |f|, one for each ray.
    Right(Vec<f64>),
}

impl Verdict {
    fn read(text: &str) -> Self {
        match text {
            "–" => Self::Unknown,
            "no" => Self::None,
            "wrong" => Self::Wrong,
            errors => Self::Right(errors.split(' ').map(|e| e.parse().unwrap()).collect()),
        }
    }

    fn told(&self) -> String {
        match self {
            Self::Unknown => "–".to_owned(),
            Self::None => "none".to_owned(),
            Self::Wrong => "wrong".to_owned(),
            Self::Right(errors) => {
                let errors: Vec<String> = errors.iter().map(|&e| digit(e)).collect();
                errors.join(", ")
            }
        }
    }
}

fn problems() -> Vec<Problem> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/integrals/peers.tsv");
    let text = std::fs::read_to_string(path).unwrap();
    let mut out: Vec<Problem> = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        if let Some(head) = line.strip_prefix("= ") {
            let parts: Vec<&str> = head.split(" | ").collect();
            assert_eq!(parts.len(), 4, "{line}");
            out.push(Problem {
                source: parts[0].to_owned(),
                text: parts[1].to_owned(),
                peers: [2, 3].map(|k| Verdict::read(parts[k])),
                rays: Vec::new(),
            });
            continue;
        }
        let n: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
        let ray = Ray {
            args: vec![n[0], 0.0, 0.0, n[1], 0.0, 0.0, n[2], n[3]],
            exact: n[4],
            size: n[5],
        };
        out.last_mut().unwrap().rays.push(ray);
    }
    out
}

/// What we make of it; complaints where it is not right.
fn ours(problem: &Problem, complaints: &mut String) -> Verdict {
    let of = formula(&problem.text);
    let Ok(made) = field_integral(&of, Otherwise::Refuse) else {
        return Verdict::None;
    };
    let (integral, allowed) = with_allowances(&of, made, &problem.rays);
    let at = points(problem.rays.iter().map(|r| r.args.clone()));
    let run = |machine: &Machine| machine.run(&integral, What::Value, &at).unwrap();
    let exact = run(&Machine::Reference);
    let single = run(&Machine::Processor(Arithmetic::Ieee32, Precision::Accurate));
    let mut errors = Vec::new();
    for (k, ray) in problem.rays.iter().enumerate() {
        let off = |value: f64| {
            let off = (value - ray.exact).abs() / ray.size;
            if off.is_nan() { f64::INFINITY } else { off }
        };
        errors.push(off(single[k][0]));
        let beyond = off(single[k][0]) - allowed[k] / ray.size;
        if off(exact[k][0]) > DOUBLE || beyond > SINGLE {
            let _ = writeln!(
                complaints,
                "{} on {:?}: {:e} and {:e}, not {:e}",
                problem.text, ray.args, exact[k][0], single[k][0], ray.exact
            );
        }
    }
    Verdict::Right(errors)
}

/// A line of the summary: how many were found and right, and the medians and the worst of the errors on each kind of ray.
fn summary(name: &str, verdicts: &[Verdict]) -> String {
    let asked = verdicts.iter().filter(|v| **v != Verdict::Unknown).count();
    if asked == 0 {
        return format!("| {name} | not asked | | | | | |\n");
    }
    let right: Vec<&Vec<f64>> = verdicts
        .iter()
        .filter_map(|v| match v {
            Verdict::Right(errors) => Some(errors),
            _ => None,
        })
        .collect();
    let wrong = verdicts.iter().filter(|v| **v == Verdict::Wrong).count();
    let mut out = format!("| {name} | {asked} | {} | {wrong} |", right.len());
    for k in 0..3 {
        let mut errors: Vec<f64> = right.iter().map(|e| e[k]).collect();
        errors.sort_by(f64::total_cmp);
        let _ = write!(
            out,
            " {}, {} |",
            digit(errors[errors.len() / 2]),
            digit(errors[errors.len() - 1])
        );
    }
    out + "\n"
}

const BEGIN: &str =
    "<!-- peers: `BLESS=1 cargo test -p pullback-tests --test integrals peers` -->\n";
const END: &str = "<!-- end of the peers -->\n";

/// What has a closed form is right; the tables of docs/integrals-peers.md are what was found. `BLESS=1` writes them.
#[test]
fn peers() {
    let problems = problems();
    let mut complaints = String::new();
    let mut list =
        "| source | integrand | pullback | SymPy | symplex |\n| --- | --- | --- | --- | --- |\n"
            .to_owned();
    let mut all: [Vec<Verdict>; 3] = Default::default();
    for problem in &problems {
        let own = ours(problem, &mut complaints);
        let [sympy, symplex] = problem.peers.clone();
        let _ = writeln!(
            list,
            "| {} | `{}` | {} | {} | {} |",
            problem.source,
            problem.text,
            own.told(),
            sympy.told(),
            symplex.told()
        );
        for (all, verdict) in all.iter_mut().zip([own, sympy, symplex]) {
            all.push(verdict);
        }
    }
    assert!(complaints.is_empty(), "{complaints}");
    let mut table =
        "\n| program | integrands | right | wrong | rate 1: median, worst | 1e-3 | 1e-6 |\n\
                     | --- | ---: | ---: | ---: | --- | --- | --- |\n"
            .to_owned();
    for (name, verdicts) in ["pullback", "SymPy", "symplex"].iter().zip(&all) {
        table += &summary(name, verdicts);
    }
    let text = format!("{table}\n{list}\n");
    println!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/integrals-peers.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let begin = page.find(BEGIN).expect("the mark of the table") + BEGIN.len();
    let end = page.find(END).expect("the end of the table");
    let now = format!("{}{text}{}", &page[..begin], &page[end..]);
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, now).unwrap();
    } else {
        assert!(
            page == now,
            "docs/integrals-peers.md is not up to date: run with BLESS=1 and read the difference"
        );
    }
}
