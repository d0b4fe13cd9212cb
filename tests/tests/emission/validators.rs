//! Every formula for every target, judged by whoever is installed.

use std::collections::BTreeMap;

use pullback_compiler::lower::Precision;
use pullback_compiler::{Emission, EmitWhat, ParamsAs, Program, Target};
use pullback_runtime::validators::{Verdict, judge};
use pullback_tests::corpus::gallery;

use crate::program;

/// Emits and asks; counts what each judge has accepted.
fn check(
    name: &str,
    program: &Program,
    emission: &Emission,
    counts: &mut BTreeMap<String, [usize; 2]>,
) {
    let Ok(emitted) = program.emit_all(emission) else {
        return;
    };
    for judgement in judge(&emitted.bytes, emission.target, &emission.parts) {
        let counted = counts.entry(judgement.judge.clone()).or_default();
        match judgement.verdict {
            Verdict::Accepted => counted[0] += 1,
            Verdict::Absent => counted[1] += 1,
            Verdict::Rejected(why) => panic!(
                "{name}: {:?} in {} is rejected by {}\n{why}\n{}",
                emission.parts,
                emission.target.name(),
                judgement.judge,
                String::from_utf8_lossy(&emitted.bytes)
            ),
        }
    }
}

/// What a formula can have, together in one module; what takes long to derive only where it is wanted.
fn all_parts(program: &Program, with_long: bool) -> Option<Emission> {
    let short = [EmitWhat::Value, EmitWhat::Gradient, EmitWhat::Derivative];
    let long = [
        EmitWhat::Partials,
        EmitWhat::Directional,
        EmitWhat::Hessian,
        EmitWhat::Integral,
        EmitWhat::Opacity,
    ];
    let more = if with_long { &long[..] } else { &[] };
    let mut whole: Option<Emission> = None;
    for &what in short.iter().chain(more) {
        let alone = Emission::new(what, Target::Wgsl);
        if program.emit_all(&alone).is_ok() {
            whole = Some(whole.map_or(alone, |w| w.and(what)));
        }
    }
    whole
}

#[allow(clippy::print_stderr, reason = "a judge that is not there is named")]
fn tell(counts: &BTreeMap<String, [usize; 2]>) {
    for (judge, [accepted, absent]) in counts {
        if *absent > 0 {
            eprintln!("not installed: {judge}");
        } else {
            eprintln!("{judge}: {accepted} accepted");
        }
    }
}

#[test]
fn the_gallery_for_every_target_is_accepted() {
    let (mut counts, mut turn) = (BTreeMap::new(), 0);
    for (k, source) in gallery().iter().enumerate() {
        let program = program(&source.name, &source.text);
        let Some(all) = all_parts(&program, k % 8 == 0) else {
            continue;
        };
        for target in Target::ALL {
            let mut emission = all.clone();
            emission.target = target;
            // the ways to have parameters take turns
            let ways = [ParamsAs::Arguments, ParamsAs::Uniform, ParamsAs::Constants];
            let emission = emission.params(ways[turn % 3]);
            turn += usize::from(!program.params().is_empty());
            check(&source.name, &program, &emission, &mut counts);
        }
    }
    tell(&counts);
    assert!(
        counts.values().any(|[accepted, _]| *accepted > 50),
        "{counts:?}"
    );
}

#[test]
fn pairs_for_every_target_are_accepted() {
    let mut counts = BTreeMap::new();
    let texts = [
        "f(x, y) = sin(1000 x) y + x^y",
        "f(x, y) = gamma(x) + mod(y, 0.7) + |x|",
        "f(z) = log(z) + z^(2 + i)",
        "f(x, y) = sum(j in 1..8, sin(j x)/j) - floor(y)",
        "f(p: vec3) = |p| + exp(-p.x²) p.y",
    ];
    for text in texts {
        let program = program(text, text);
        let all = all_parts(&program, false).expect("a part");
        for target in Target::ALL {
            let mut emission = all.clone().precision(Precision::Extended);
            emission.target = target;
            let emitted = program.emit_all(&emission);
            assert!(emitted.is_ok(), "{text} for {}: {emitted:?}", target.name());
            check(text, &program, &emission, &mut counts);
        }
    }
    tell(&counts);
}

#[test]
fn scenes_are_accepted() {
    let mut counts = BTreeMap::new();
    for source in gallery().iter().step_by(5) {
        let program = program(&source.name, &source.text);
        for target in [Target::Wgsl, Target::Glsl] {
            let mut emission = Emission::new(EmitWhat::Scene, target);
            emission.fixed_samples = Some(2);
            check(&source.name, &program, &emission, &mut counts);
        }
    }
    tell(&counts);
}
