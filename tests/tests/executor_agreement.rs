//! The executor against the evaluator of the IR, on the gallery.

use pullback_compiler::lower::Precision;
use pullback_compiler::{What, compile};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{Arithmetic, Rows};
use pullback_tests::corpus::gallery;

#[test]
fn gallery_in_f64() {
    for source in gallery() {
        let program = compile(&source.text).program.expect("the gallery compiles");
        let mut reference = match program.evaluator(0, What::Value) {
            Ok(r) => r,
            Err(e) => panic!("{e:?}"),
        };
        let module = match program.eval_module(0, What::Value, Precision::Double) {
            Ok(r) => r,
            Err(e) => panic!("{e:?}"),
        };
        let rows = Rows::new(&module, Arithmetic::Reference)
            .unwrap_or_else(|e| panic!("{}: {e}", source.name));
        let columns = reference.inputs().len();
        let count = 100;
        let points: Vec<f64> = (0..count * columns)
            .map(|k| ((k * 7919) % 1009) as f64 / 251.0 - 2.0)
            .collect();
        let params: Vec<f64> = program.params().iter().map(|p| p.default).collect();
        let surroundings = Surroundings {
            params: &params,
            time: 0.25,
            pixel: 0.01,
        };
        let mut results = Vec::new();
        rows.eval(surroundings, count, &points, &mut results)
            .unwrap_or_else(|e| panic!("{}: {e}", source.name));
        let outputs = reference.outputs().len();
        let mut worst = 0.0f64;
        for k in 0..count {
            let mut out = vec![0.0; outputs];
            reference.eval(
                &params,
                0.25,
                0.01,
                &points[k * columns..(k + 1) * columns],
                &mut out,
            );
            for (a, b) in out.iter().zip(&results[k * outputs..(k + 1) * outputs]) {
                if a.is_nan() && b.is_nan() || a == b {
                    continue;
                }
                worst = worst.max((a - b).abs() / a.abs().max(1e-300));
                if !((a - b).abs() <= 1e-9 * a.abs()) {
                    println!("{} row {k}: {a} {b}", source.name);
                    break;
                }
            }
        }
        println!(
            "{}: {worst:e} {} instructions",
            source.name,
            rows.program().instructions()
        );
    }
}
