//! `pullback probe` as a user meets it, and whether it finds errors that are planted.

mod shared;

use naga::{BinaryOperator, Expression, Function, Module};
use pullback_compiler::lower::Precision;
use pullback_compiler::{EvalModule, What, compile};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::Arithmetic;
use pullback_runtime::trace::{
    self, GpuTracer, Inputs, Parting, Recorders, Site, Trace, Traced, parting, row_on_cpu,
};
use pullback_runtime::{AdapterChoice, Gpu};
use shared::pullback;

const ULPS: f64 = 16.0;

/// A formula's evaluation with its gradient.
struct Subject {
    text: &'static str,
    module: EvalModule,
}

impl Subject {
    fn new(text: &'static str) -> Self {
        let program = compile(text).program.unwrap();
        let module = program.eval_module(0, What::Gradient, Precision::Accurate);
        let Ok(module) = module else {
            panic!("{text} does not compile");
        };
        Self { text, module }
    }

    fn traced(&self, recorders: Recorders) -> Traced {
        trace::traced_evaluation(&self.module, self.text, recorders).unwrap()
    }

    fn on_cpu(&self, arithmetic: Arithmetic, traced: &Traced, row: &[f64]) -> Trace {
        row_on_cpu(
            arithmetic,
            &self.module,
            traced,
            Surroundings::default(),
            row,
        )
        .unwrap()
    }

    fn on_gpu(&self, gpu: &Gpu, traced: &Traced, row: &[f64]) -> Trace {
        let inputs = Inputs::row(&self.module, Surroundings::default(), row).unwrap();
        GpuTracer::new(gpu, traced, &inputs)
            .unwrap()
            .trace(&inputs)
            .unwrap()
    }

    /// Where a machine with an error parts from one without: by the executor, and by the GPU where there is one.
    fn found(&self, row: &[f64], plant: impl Fn(&mut Module)) -> (Site, Parting) {
        let planted = |recorders| {
            let mut traced = self.traced(recorders);
            plant(&mut traced.module);
            let info = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::default(),
            )
            .validate(&traced.module);
            traced.info = info.unwrap_or_else(|error| panic!("{error:?}"));
            traced
        };
        let good = self.traced(Recorders::Silent);
        let truth = self.on_cpu(Arithmetic::Reference, &good, row);
        let sound = self.on_cpu(Arithmetic::Ieee32, &good, row);
        assert_eq!(parting(&good.sites, [&sound, &truth], ULPS), None);
        let bad = self.on_cpu(Arithmetic::Ieee32, &planted(Recorders::Silent), row);
        let found = parting(&good.sites, [&bad, &truth], ULPS).unwrap();
        if let Ok(gpu) = Gpu::open(&AdapterChoice::Software) {
            let bad = self.on_gpu(&gpu, &planted(Recorders::Writing), row);
            let on_gpu = parting(&good.sites, [&bad, &truth], ULPS).unwrap();
            assert_eq!(on_gpu.site(), found.site(), "{}", self.text);
        }
        (good.sites[found.site()].clone(), found)
    }
}

fn function<'m>(module: &'m mut Module, name: &str) -> &'m mut Function {
    let mut functions = module.functions.iter_mut();
    let found = functions.find(|(_, f)| f.name.as_deref() == Some(name));
    found.unwrap_or_else(|| panic!("no {name}")).1
}

/// Changes the expressions of a function for which `change` gives another; at least one.
fn change(function: &mut Function, change: impl Fn(&Expression) -> Option<Expression>) {
    let mut count = 0;
    for (_, expression) in function.expressions.iter_mut() {
        if let Some(other) = change(expression) {
            *expression = other;
            count += 1;
        }
    }
    assert!(count > 0, "nothing was planted");
}

/// sin' = sin instead of cos: the first value that is wrong is the one that uses it, (sin x)' x.
#[test]
fn a_wrong_derivative_rule_is_found() {
    let subject = Subject::new("sin(x) x + y");
    let (site, _) = subject.found(&[0.5, 2.0], |module| {
        let function = function(module, "evaluate");
        let before = function.expressions.clone();
        change(function, |expression| match *expression {
            Expression::AccessIndex { base, index: 1 }
                if matches!(before[base], Expression::CallResult(_)) =>
            {
                Some(Expression::AccessIndex { base, index: 0 })
            }
            _ => None,
        });
    });
    assert_eq!(site.text, "cos(x) * x");
    assert_eq!(site.span.unwrap().text(subject.text), "sin(x) x");
}

/// The logarithm is taken of negative numbers, too.
#[test]
fn a_removed_guard_is_found() {
    let subject = Subject::new("a + y where a = if x > 0 then log(x) else x");
    let (site, found) = subject.found(&[-0.5, 2.0], |module| {
        change(
            function(module, "evaluate"),
            |expression| match expression {
                &Expression::Select {
                    condition,
                    accept,
                    reject,
                } if accept != reject => Some(Expression::Select {
                    condition,
                    accept,
                    reject: accept,
                }),
                _ => None,
            },
        );
    });
    assert_eq!(site.name, "a");
    assert_eq!(
        site.span.unwrap().text(subject.text),
        "if x > 0 then log(x) else x"
    );
    let Parting::Value { values, ulps, .. } = found else {
        panic!("{found:?}");
    };
    assert!(values[0].numbers()[0].is_nan());
    assert_eq!((values[1].numbers(), ulps), (&[-0.5][..], f64::INFINITY));
}

/// A product that is subnormal becomes zero, and is made large behind that.
#[test]
fn a_flushed_subnormal_is_found() {
    let subject = Subject::new("1e30 (x y) + y");
    let (site, found) = subject.found(&[1.5e-20, 2.5e-20], |module| {
        change(
            function(module, "evaluate"),
            |expression| match expression {
                &Expression::Binary {
                    op: BinaryOperator::Multiply,
                    left,
                    ..
                } => Some(Expression::Binary {
                    op: BinaryOperator::Subtract,
                    left,
                    right: left,
                }),
                _ => None,
            },
        );
    });
    assert_eq!(site.text, "x * y");
    let Parting::Value { values, .. } = found else {
        panic!("{found:?}");
    };
    assert_eq!(values[0].numbers(), [0.0]);
    let product = 1.5e-20 * 2.5e-20;
    assert!((values[1].numbers()[0] - product).abs() < 1e-6 * product);
}

/// The compiled form of this formula computes the difference, too, and chooses another value.
#[test]
fn what_is_not_chosen_does_not_count() {
    let subject = Subject::new("√(x^2 + 1) - x");
    let traced = subject.traced(Recorders::Silent);
    let both = [Arithmetic::Ieee32, Arithmetic::Reference];
    let [single, double] = both.map(|arithmetic| subject.on_cpu(arithmetic, &traced, &[300.0]));
    let far = single.events.iter().zip(&double.events).any(|(a, b)| {
        let shape = traced.sites[a.site].shape;
        trace::distance(shape, a.value, b.value) > 1000.0
    });
    assert!(far, "the difference cancels");
    assert_eq!(parting(&traced.sites, [&single, &double], ULPS), None);
}

/// Where a driver takes no liberties, it computes what binary32 is, bit by bit, whatever way it takes.
#[test]
fn the_gpu_and_exact_binary32_agree() {
    let Ok(gpu) = Gpu::open(&AdapterChoice::Software) else {
        return;
    };
    for text in [
        "x^2 - 3 x y + √(x^2 + y^2)",
        "if x > y then x - y else x/y",
        "iterate(7, s = x, s^2 + y until |s| > 2)",
    ] {
        let subject = Subject::new(text);
        let sites = subject.traced(Recorders::Silent);
        for row in [[0.3, -0.2], [0.1, 0.25], [1e-20, 3e-19], [3.0, 2.5]] {
            let exact = subject.on_cpu(Arithmetic::Ieee32, &sites, &row);
            let found = subject.on_gpu(&gpu, &subject.traced(Recorders::Writing), &row);
            assert!(exact.events.len() > 5, "{text}");
            // drivers contract and reorder, by one rounding or two
            assert_eq!(
                parting(&sites.sites, [&found, &exact], 4.0),
                None,
                "{text} at {row:?}"
            );
        }
    }
}

#[test]
fn every_tier_tells_its_values() {
    let folder = tempfile::tempdir().unwrap();
    for tier in ["fast", "accurate", "extended", "double"] {
        let arguments = [
            "probe",
            "√(x^2 + 1) - x",
            "--at",
            "3",
            "--on",
            "ieee32,reference",
        ];
        let arguments = [&arguments[..], &["--precision", tier, "--all"]].concat();
        let (code, table, errors) = pullback(folder.path(), &arguments);
        assert_eq!(code, 0, "{errors}");
        assert!(table.contains("0.16227766"), "{tier}\n{table}");
    }
}

#[test]
fn pixels_of_every_scene() {
    let folder = tempfile::tempdir().unwrap();
    for (formula, expected) in [
        ("x^2 - y", "field_grad"),
        ("z^2 + 1/z", "map_jet"),
        ("x^2 + y^2 + z^2 - 1", "field_ray"),
    ] {
        let arguments = ["probe", formula, "--pixel", "30,20", "--size", "64x48"];
        let arguments = [
            &arguments[..],
            &["--on", "ieee32,reference", "--format", "json"],
        ]
        .concat();
        let (code, json, errors) = pullback(folder.path(), &arguments);
        assert_eq!(code, 0, "{errors}");
        let json: serde_json::Value = serde_json::from_str(&json).unwrap();
        let values = json["values"].as_array().unwrap();
        let told = |name: &str| values.iter().any(|value| value["function"] == name);
        assert!(told("shade") && told(expected), "{formula}");
        let pixel = &values[0];
        assert_eq!(
            (&pixel["name"], &pixel["what"]),
            (&"pixel".into(), &"argument".into())
        );
        assert_eq!(
            pixel["shown"][0]["values"][1],
            serde_json::json!([30.5, 20.5])
        );
        assert_eq!(json["machines"].as_array().unwrap().len(), 2);
    }
}

/// What `--nan` finds in a formula, a machine after the other.
fn odd(formula: &str, size: &str, machines: &[&str]) -> Vec<serde_json::Value> {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "probe", formula, "--nan", "--size", size, "--format", "json",
    ];
    let (code, json, errors) = pullback(folder.path(), &[&arguments[..], machines].concat());
    assert_eq!(code, 0, "{errors}");
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    json["machines"].as_array().unwrap().clone()
}

/// The ways in which odd pixels are looked for, and the names of the machines.
fn ways() -> Vec<(&'static [&'static str], &'static [&'static str])> {
    let mut ways: Vec<(&[&str], &[&str])> =
        vec![(&["--on", "ieee32,reference"], &["ieee32", "reference"])];
    if Gpu::open(&AdapterChoice::Software).is_ok() {
        ways.push((&["--adapter", "software"], &["gpu"]));
    }
    ways
}

/// log x is NaN left of 0, and infinite in the column of pixels at 0, on every machine.
#[test]
fn odd_pixels_are_found() {
    for (way, names) in ways() {
        let all = odd("y + log(x)", "65x48", way);
        assert_eq!(all.len(), names.len());
        for (found, name) in all.iter().zip(names) {
            assert_eq!(found["name"], *name);
            assert_eq!(found["nan"]["pixels"], 32 * 48);
            assert_eq!(found["infinite"]["pixels"], 48);
            assert_eq!(found["infinite"]["first"], serde_json::json!([32, 0]));
            for kind in ["nan", "infinite"] {
                let operation = &found[kind]["operations"][0];
                assert_eq!(operation["operation"], "log(x)", "{kind}");
                assert_eq!(operation["span"]["start"], 4);
                assert_eq!(operation["pixels"], found[kind]["traced"]);
            }
            assert_eq!(
                found["infinite"]["operations"][0]["result"],
                serde_json::json!(["-inf"])
            );
        }
        // what is not chosen is not to blame
        for found in odd("(if x > 0 then log(x) else x) + √y", "64x48", way) {
            assert_eq!(found["nan"]["pixels"], 64 * 24);
            assert_eq!(found["nan"]["operations"].as_array().unwrap().len(), 1);
            let culprit = found["nan"]["operations"][0]["operation"].as_str().unwrap();
            assert!(culprit.ends_with("sqrt(y)"), "{culprit}");
        }
    }
}

/// What leaves the range of single precision is infinite there, and a number in double precision.
#[test]
fn each_arithmetic_has_odd_pixels_of_its_own() {
    let all = odd("exp(9 x)", "64x8", &["--on", "ieee32,reference"]);
    let infinite = |k: usize| all[k]["infinite"]["pixels"].as_u64().unwrap();
    assert!(infinite(0) > 0, "{all:?}");
    assert_eq!(infinite(1), 0, "{all:?}");
}

#[test]
fn odd_pixels_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let tell = |formula: &str, on: &str| {
        let arguments = ["probe", formula, "--nan", "--size", "9x9", "--on", on];
        pullback(folder.path(), &arguments).1
    };
    let text = tell("y + log(x)", "reference");
    assert!(text.contains("`log(x)` in field_grad"), "{text}");
    assert!(text.starts_with("NaN "), "{text}");
    let both = tell("x + y", "ieee32,reference");
    let calm = "NaN       0 of 9x9 pixels (0.0000 %)\ninfinite  0 of 9x9 pixels (0.0000 %)\n";
    assert_eq!(
        both,
        format!("ieee32, accurate\n{calm}\nreference, double\n{calm}")
    );
}

#[test]
fn what_is_wrong_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let check = |arguments: &str, code: i32, message: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let arguments = [&["probe"], &arguments[..], &["--on", "reference"]].concat();
        let (found, _, errors) = pullback(folder.path(), &arguments);
        assert_eq!(found, code, "{arguments:?}: {errors}");
        assert!(errors.contains(message), "{arguments:?}: {errors}");
    };
    check("x", 2, "--pixel");
    check("x --pixel 1,1 --nan", 2, "cannot be used with");
    check("x --pixel 1.5,1", 2, "whole numbers");
    check("x --pixel 1200,1", 2, "1200x900");
    check("x*y --at 1", 2, "x,y");
    check("x*y --at 1,2,3", 2, "x,y");
    check("x --at 1,nan", 2, "X,Y,Z");
    check("foo(x) --at 1", 1, "foo");
    check("none.pull --at 1", 4, "none.pull");
}
