//! Times.
use pullback_compiler::lower::Precision;
use pullback_compiler::{EvalModule, What};
use pullback_runtime::GpuEvaluator;
use pullback_runtime::accuracy::subjects::formula;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::accuracy::subjects::subjects;
use pullback_tests::accuracy::tables::Domain;
use std::time::Instant;

#[test]
fn times() {
    let gpu = suite_gpu().unwrap();
    let only = std::env::var("ONLY").unwrap_or_default();
    let tier = std::env::var("TIER").unwrap_or_default();
    for subject in &subjects() {
        if !only.is_empty() && !only.split(',').any(|w| w == subject.word) {
            continue;
        }
        if subject.domain != Domain::Complex
            && !["gamma", "lgamma", "digamma", "trigamma"].contains(&subject.word)
        {
            continue;
        }
        for precision in [Precision::Double, Precision::Extended] {
            if !tier.is_empty() && tier != precision.name() {
                continue;
            }
            for what in [What::Value, What::Derivative] {
                let f = formula(&subject.source).unwrap();
                let t = Instant::now();
                let Ok(module) = EvalModule::new(&f, what, precision) else {
                    continue;
                };
                let a = t.elapsed().as_secs_f64();
                let t = Instant::now();
                let mut e = GpuEvaluator::new(&gpu, &module).unwrap();
                let b = t.elapsed().as_secs_f64();
                let t = Instant::now();
                let mut out = Vec::new();
                let n = subject.cases[0].args.len();
                let params = vec![1.0; subject.cases.iter().map(|c| c.params.len()).max().unwrap()];
                e.eval_exactly(
                    pullback_runtime::evaluate::Surroundings {
                        params: &params,
                        ..Default::default()
                    },
                    1,
                    &vec![1.5; n],
                    &mut out,
                )
                .unwrap();
                let c = t.elapsed().as_secs_f64();
                println!(
                    "{:8} {:16} {what:?}: module {a:.2} pipeline {b:.2} first {c:.2}",
                    precision.name(),
                    subject.name()
                );
            }
        }
    }
}
