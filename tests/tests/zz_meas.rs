//! Measures.
use pullback_compiler::lower::Precision;
use pullback_tests::accuracy::evaluators::{Machine, suite_gpu};
use pullback_tests::accuracy::measure::measure_together;
use pullback_tests::accuracy::subjects::subjects;
use pullback_tests::accuracy::tables::Domain;
use std::time::Instant;

#[test]
fn meas() {
    let gpu = suite_gpu().unwrap();
    let only = std::env::var("ONLY").unwrap_or_default();
    let tier = std::env::var("TIER").unwrap_or_default();
    let real = std::env::var("REAL").is_ok();
    for subject in &mut subjects() {
        if !only.is_empty() && !only.split(',').any(|w| w == subject.word) {
            continue;
        }
        if (subject.domain == Domain::Complex) == real {
            continue;
        }
        for precision in [Precision::Double, Precision::Extended] {
            if !tier.is_empty() && tier != precision.name() {
                continue;
            }
            let machine = Machine::Gpu(Box::new(gpu.clone()), precision);
            let t = Instant::now();
            let m = match measure_together(subject, &machine) {
                Ok(m) => m,
                Err(e) => {
                    println!("{} {e}", subject.name());
                    continue;
                }
            };
            let s = t.elapsed().as_secs_f64();
            let list = |e: &[pullback_tests::accuracy::measure::Errors; 3]| {
                format!("{:.4e} {:.4e} {:.4e}", e[0].max(), e[1].max(), e[2].max())
            };
            println!(
                "{:8} {:16} n {:4} {s:5.2} s  value {}  slope {}",
                precision.name(),
                subject.name(),
                subject.cases.len(),
                list(&m.value),
                m.derivative.as_ref().map(list).unwrap_or_default()
            );
            let limit = if precision == Precision::Extended {
                40.0
            } else {
                4.0
            };
            for (q, e, f) in [
                ("value", Some(&m.value), 1.0),
                ("slope", m.derivative.as_ref(), 4.0),
            ] {
                let Some(e) = e else { continue };
                for w in e[0].wrong.iter().take(4) {
                    println!("    WRONG {q}: {w}");
                }
                if e[0].wrong.len() > 4 {
                    println!("    ... {} wrong", e[0].wrong.len());
                }
                if e[0].max() > f * limit {
                    println!("    {q} comp {:.1}: {}", e[0].max(), e[0].worst);
                }
                if e[1].max() > f * limit {
                    println!("    {q} norm {:.1}: {}", e[1].max(), e[1].worst);
                }
            }
        }
    }
}
