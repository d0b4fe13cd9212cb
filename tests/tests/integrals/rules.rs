//! Every rule against 60 digits: operations of an integral by each rule are replaced in turn, and what that changes is seen on
//! the rays of the oracle.

use std::collections::BTreeMap;

use pullback_compiler::eval::{Leaves, Tape};
use pullback_compiler::integrate::{Otherwise, RULES, field_integral};
use pullback_compiler::ir::{Graph, Id, Op};
use pullback_compiler::table::Number;

use super::proof::{CLASSES, slip, with_other};
use super::{DOUBLE, Ray, VALUES, densities, formula};

/// Replaced operations of each integral, about.
const PLANTED: usize = 40;
/// Longest integral that is taken, in nodes, where there is a shorter one by the rule.
const LONGEST: usize = 400;
/// An integral by a rule, with its rays.
struct Specimen {
    text: String,
    graph: Graph,
    root: Id,
    rays: Vec<Ray>,
}

/// For each rule the shortest integral of the oracle that it has a part in.
fn specimens() -> BTreeMap<&'static str, Specimen> {
    let mut out: BTreeMap<&'static str, Specimen> = BTreeMap::new();
    for density in CLASSES.iter().flat_map(|class| densities(class)) {
        let of = formula(&density.text);
        let made = field_integral(&of, Otherwise::Refuse).unwrap();
        let (graph, roots) = made.graph.compacted(&[made.integral.value]);
        if graph.has_loops() {
            continue;
        }
        for part in &made.integral.parts {
            let name = part.rule.record().name;
            let length = graph.nodes().len();
            let is_shorter = out.get(name).is_none_or(|known| {
                let before = known.graph.nodes().len();
                before > LONGEST && length < before
            });
            if is_shorter {
                let specimen = Specimen {
                    text: density.text.clone(),
                    graph: graph.clone(),
                    root: roots[0],
                    rays: density.rays.clone(),
                };
                out.insert(name, specimen);
            }
        }
    }
    out
}

/// Values along rays.
fn values<'r>(graph: &Graph, root: Id, rays: impl Iterator<Item = &'r [f64]>) -> Vec<f64> {
    let mut tape = Tape::new(graph, &[root]);
    let value = |ray: &[f64]| {
        let inputs: Vec<Number> = ray.iter().map(|&x| Number::Real(x)).collect();
        let leaves = Leaves {
            inputs: &inputs,
            params: &VALUES,
            time: 0.375,
            pixel: 1e-3,
        };
        let mut out = f64::NAN;
        tape.run(&leaves, |v| {
            if let Number::Real(x) = v {
                out = x;
            }
        });
        out
    };
    rays.map(value).collect()
}

/// Rays that the oracle does not have.
fn others() -> Vec<Vec<f64>> {
    (0..60)
        .map(|k| {
            let wave = |phase: f64, size: f64| size * (f64::from(k) * 1.7 + phase).sin();
            let (a, length) = (wave(6.0, 1.0), wave(7.5, 2.0));
            vec![
                wave(0.0, 1.0),
                wave(1.0, 1.0),
                wave(2.3, 1.0),
                wave(3.1, 0.9),
                wave(4.2, 0.9),
                wave(5.4, 0.9),
                a,
                a + length,
            ]
        })
        .collect()
}

#[test]
fn a_wrong_rule_is_not_what_sixty_digits_say() {
    let specimens = specimens();
    let missing: Vec<&str> = RULES
        .iter()
        .map(|r| r.name)
        .filter(|name| !specimens.contains_key(name))
        .collect();
    assert!(missing.is_empty(), "no integral by {missing:?}");
    let others = others();
    let (mut planted, mut caught, mut missed) = (0, 0, String::new());
    for (rule, specimen) in &specimens {
        let Specimen {
            text,
            graph,
            root,
            rays,
        } = specimen;
        let is_off = |found: &[f64]| {
            let far = |(ray, found): (&Ray, &f64)| {
                let error = (found - ray.exact).abs() / ray.size.max(1e-30);
                error.is_nan() || error > DOUBLE
            };
            rays.iter().zip(found).any(far)
        };
        let on_rays = |graph: &Graph, root: Id| {
            values(graph, root, rays.iter().map(|ray| ray.args.as_slice()))
        };
        let elsewhere =
            |graph: &Graph, root: Id| values(graph, root, others.iter().map(Vec::as_slice));
        assert!(!is_off(&on_rays(graph, *root)), "{rule}: {text}");
        let right = elsewhere(graph, *root);
        let (mut here, mut found_here) = (0, 0);
        let step = graph.nodes().len() / PLANTED + 1;
        for at in graph.ids().step_by(step) {
            let Op::Apply(prim) = graph.node(at).op else {
                continue;
            };
            let planted_here = slip(prim).and_then(|other| with_other(graph, *root, at, other));
            let Some((wrong, wrong_root)) = planted_here else {
                continue;
            };
            let is_caught = is_off(&on_rays(&wrong, wrong_root));
            let differs = || {
                let found = elsewhere(&wrong, wrong_root);
                right.iter().zip(&found).any(|(right, wrong)| {
                    let error = (right - wrong).abs() / right.abs().max(1e-3);
                    right.is_finite() && (error.is_nan() || error > 1e-8)
                })
            };
            if is_caught || differs() {
                here += 1;
                found_here += u32::from(is_caught);
                if !is_caught {
                    missed += &format!("{rule}: {text}: {prim:?} at {at:?}\n");
                }
            }
        }
        println!("{rule}: {text}: {found_here} of {here}");
        assert!(here > 0, "{rule}: nothing was planted in {text}");
        planted += here;
        caught += found_here;
    }
    println!(
        "{caught} of {planted} wrong integrals by {} rules",
        specimens.len()
    );
    assert!(missed.is_empty(), "missed:\n{missed}");
}
