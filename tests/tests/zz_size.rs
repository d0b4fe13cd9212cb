//! Inlined sizes.
use pullback_compiler::lower::Precision;
use pullback_compiler::{EvalModule, What};
use pullback_runtime::accuracy::subjects::formula;
use pullback_tests::accuracy::subjects::subjects;
use pullback_tests::accuracy::tables::Domain;
use std::collections::HashMap;

fn calls(block: &naga::Block, out: &mut Vec<naga::Handle<naga::Function>>) {
    for s in block.iter() {
        match s {
            naga::Statement::Call { function, .. } => out.push(*function),
            naga::Statement::Block(b) => calls(b, out),
            naga::Statement::If { accept, reject, .. } => {
                calls(accept, out);
                calls(reject, out);
            }
            naga::Statement::Switch { cases, .. } => {
                for c in cases {
                    calls(&c.body, out);
                }
            }
            naga::Statement::Loop {
                body, continuing, ..
            } => {
                calls(body, out);
                calls(continuing, out);
            }
            _ => {}
        }
    }
}

#[test]
fn sizes() {
    let only = std::env::var("ONLY").unwrap_or_default();
    let top: usize = std::env::var("TOP")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(0);
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
            for what in [What::Value, What::Derivative] {
                let f = formula(&subject.source).unwrap();
                let module = match EvalModule::new(&f, what, precision) {
                    Ok(m) => m,
                    Err(e) => {
                        println!("{:?} {}", e, subject.word);
                        continue;
                    }
                };
                let m = &module.module;
                let mut total: HashMap<naga::Handle<naga::Function>, usize> = HashMap::new();
                let mut callees = HashMap::new();
                for (h, f) in m.functions.iter() {
                    let mut c = Vec::new();
                    calls(&f.body, &mut c);
                    let t = f.expressions.len() + c.iter().map(|g| total[g]).sum::<usize>();
                    total.insert(h, t);
                    callees.insert(h, c);
                }
                let mut c = Vec::new();
                calls(&m.entry_points[0].function.body, &mut c);
                let mut copies: HashMap<_, usize> = HashMap::new();
                for g in &c {
                    *copies.entry(*g).or_default() += 1;
                }
                let handles: Vec<_> = m.functions.iter().map(|(h, _)| h).collect();
                for h in handles.iter().rev() {
                    let n = copies.get(h).copied().unwrap_or(0);
                    for g in &callees[h] {
                        *copies.entry(*g).or_default() += n;
                    }
                }
                let all: usize = c.iter().map(|g| total[g]).sum();
                println!(
                    "{:8} {:16} {what:?}: {all}",
                    precision.name(),
                    subject.name()
                );
                let mut by: Vec<_> = m
                    .functions
                    .iter()
                    .map(|(h, f)| {
                        (
                            copies.get(&h).copied().unwrap_or(0) * f.expressions.len(),
                            copies.get(&h).copied().unwrap_or(0),
                            f.expressions.len(),
                            total[&h],
                            f.name.clone().unwrap_or_default(),
                        )
                    })
                    .collect();
                by.sort_unstable_by(|a, b| b.cmp(a));
                for b in by.iter().take(top) {
                    println!(
                        "      {:7} = {:4} x {:4}  (with callees {:6}) {}",
                        b.0, b.1, b.2, b.3, b.4
                    );
                }
                if top > 0 {
                    let mut inl: Vec<_> = m
                        .functions
                        .iter()
                        .map(|(h, f)| {
                            (
                                copies.get(&h).copied().unwrap_or(0) * total[&h],
                                copies.get(&h).copied().unwrap_or(0),
                                total[&h],
                                f.name.clone().unwrap_or_default(),
                            )
                        })
                        .collect();
                    inl.sort_unstable_by(|a, b| b.cmp(a));
                    for b in inl.iter().take(top) {
                        println!("   incl {:7} = {:4} x {:6} {}", b.0, b.1, b.2, b.3);
                    }
                }
            }
        }
    }
}
