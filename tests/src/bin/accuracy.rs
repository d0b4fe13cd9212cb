//! Measures the accuracy of every function.
use pullback_compiler::lower::Precision;
use pullback_runtime::Gpu;
use pullback_tests::accuracy::evaluators::Machine;
use pullback_tests::accuracy::measure::measure;
use pullback_tests::accuracy::subjects::subjects;
use pullback_tests::accuracy::formulas::{gallery, library};

fn main() {
    let gpu = Gpu::open(&pullback_runtime::AdapterChoice::Software).unwrap();
    for machine in [Machine::Reference, Machine::Gpu(Box::new(gpu), Precision::Accurate)] {
        println!("== {:?}", machine.format());
        for t in gallery().iter().chain(&library()) {
            match t.measure(&machine) {
                Ok(f) => {
                    println!("K {:14} {:40} rows {:3} K {:12.3} {:12.3} {}", t.name, t.source.lines().last().unwrap(), f.rows, f.value, f.derivative, f.worst);
                    for w in f.wrong { println!("   KWRONG {w}"); }
                }
                Err(e) => println!("K {}: {e}", t.name),
            }
        }
        for s in subjects() {
            let t = std::time::Instant::now();
            match measure(&s, &machine) {
                Err(e) => println!("{} {}: {e}", s.word, s.domain),
                Ok(m) => {
                    for (k, e) in [Some(&m.value), m.derivative.as_ref()].into_iter().enumerate() {
                        let Some([c, n, u]) = e else { continue };
                        println!(
                            "{:14} {:8} {} {:5} {:12.2} {:10.2} norm {:12.2} unit {:9.2} {:.0?} {}",
                            s.word, s.domain.to_string(), ["f", "d"][k], c.count(), c.max(), c.percentile(), n.max(), u.max(), t.elapsed(), c.worst
                        );
                        println!("        norm: {}", n.worst);
                        for w in &c.wrong {
                            println!("    WRONG {w}");
                        }
                    }
                }
            }
        }
    }
}
