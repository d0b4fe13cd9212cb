//! Every formula for every target, judged by whoever is installed.

use std::collections::BTreeMap;

use pullback_compiler::lower::Precision;
use pullback_compiler::{Emission, EmitWhat, ParamsAs, Program, Target};
use pullback_runtime::validators::{Judgement, Verdict, judge, judge_in_browser};
use pullback_tests::corpus::gallery;

use crate::program;

/// How many texts each judge has accepted, and how many it was not there for.
type Counts = BTreeMap<String, [usize; 2]>;

/// Emits and asks; counts what each judge has accepted.
fn check(name: &str, program: &Program, emission: &Emission, counts: &mut Counts) {
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
fn tell(counts: &Counts) {
    for (judge, [accepted, absent]) in counts {
        if *absent > 0 {
            eprintln!("not installed: {judge}");
        } else {
            eprintln!("{judge}: {accepted} accepted");
        }
    }
}

/// Every other formula of the gallery.
fn every_other(first: usize) -> Counts {
    let (mut counts, mut turn) = (BTreeMap::new(), first);
    for (k, source) in gallery().iter().enumerate().skip(first).step_by(2) {
        let program = program(&source.name, &source.text);
        let Some(all) = all_parts(&program, k % 16 < 2) else {
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
    counts
}

#[test]
fn the_gallery_for_every_target_is_accepted() {
    let counts = std::thread::scope(|scope| {
        let workers = [0, 1].map(|first| scope.spawn(move || every_other(first)));
        let mut all: Counts = BTreeMap::new();
        for worker in workers {
            for (judge, [accepted, absent]) in worker.join().expect("a worker") {
                let sum = all.entry(judge).or_default();
                sum[0] += accepted;
                sum[1] += absent;
            }
        }
        all
    });
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
fn a_mistake_in_metal_is_noticed() {
    let program = program("f", "f(x, y) = sin(x) y");
    let scene = Emission::new(EmitWhat::Scene, Target::Msl);
    let emitted = program.emit_all(&scene).expect("a scene");
    let text = String::from_utf8(emitted.bytes).expect("a text");
    let first = |text: &str| text.replacen("metal::max(", "metal::maximum(", 1);
    let untyped = |text: &str| text.replacen("float ", "floot ", 1);
    let place = |text: &str| text.replacen("[[buffer(0)]]", "[[buffer(2)]]", 1);
    let wrong = [first(&text), untyped(&text), place(&text)];
    for wrong in wrong {
        let verdicts = judge(wrong.as_bytes(), Target::Msl, &[EmitWhat::Scene]);
        let is_absent = verdicts.iter().any(|j| j.verdict == Verdict::Absent);
        let is_rejected = |j: &Judgement| matches!(j.verdict, Verdict::Rejected(_));
        assert!(is_absent || verdicts.iter().any(is_rejected));
    }
}

#[test]
#[allow(clippy::print_stderr, reason = "a judge that is not there is named")]
fn judges_in_the_browser_accept_and_notice_mistakes() {
    let program = program("f", "param k = 2 in 0..5\nf(x, y) = k exp(x) y");
    for target in [Target::Wgsl, Target::Glsl, Target::Three, Target::Tsl] {
        let emission = Emission::new(EmitWhat::Gradient, target)
            .precision(Precision::Fast)
            .params(ParamsAs::Uniform);
        let emitted = program.emit_all(&emission).expect("a function");
        let text = String::from_utf8(emitted.bytes).expect("a text");
        let wrong = text.replace("exp(", "expo(");
        for (text, is_good) in [(text, true), (wrong, false)] {
            let verdicts = judge_in_browser(text.as_bytes(), target, &emission.parts);
            assert_eq!(verdicts.len(), 1, "{}", target.name());
            match &verdicts[0].verdict {
                Verdict::Absent => eprintln!("not installed: {}", verdicts[0].judge),
                verdict => assert_eq!(
                    *verdict == Verdict::Accepted,
                    is_good,
                    "{verdicts:?}\n{text}"
                ),
            }
        }
    }
}

#[test]
fn scenes_are_accepted() {
    let mut counts = BTreeMap::new();
    for (k, source) in gallery().iter().enumerate() {
        let program = program(&source.name, &source.text);
        let scene = |target| Emission::new(EmitWhat::Scene, target);
        check(&source.name, &program, &scene(Target::Msl), &mut counts);
        // the others but for every fifth have been read back by naga alone
        let targets = [Target::Wgsl, Target::Glsl, Target::Hlsl];
        for target in targets.into_iter().filter(|_| k % 5 == 0) {
            let mut emission = scene(target);
            emission.fixed_samples = Some(2);
            check(&source.name, &program, &emission, &mut counts);
        }
    }
    tell(&counts);
    let metal = counts.iter().filter(|(judge, _)| judge.contains("Metal"));
    assert!(
        metal.clone().count() == 1 && metal.into_iter().all(|(_, [n, _])| *n >= 70),
        "{counts:?}"
    );
}
