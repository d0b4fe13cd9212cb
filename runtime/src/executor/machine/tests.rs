//! That results do not depend on the instructions that the processor has, nor on what lanes share.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use pullback_compiler::lower::Format;
use pullback_compiler::reference::hash::hash;

use super::*;
use crate::executor::{Arithmetic, Contraction, Options, Start, Watched};

fn program(wgsl: &str, arithmetic: Arithmetic) -> Program {
    let module = naga::front::wgsl::parse_str(wgsl).expect("WGSL");
    let capabilities = Capabilities::default() | Capabilities::SHADER_INT64;
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .expect("a module");
    let options = Options {
        arithmetic,
        contraction: Contraction::None,
        format: Format::Single,
        watched: Watched::Nothing,
    };
    Program::new(&module, &info, Start::Function("test"), options).expect("a program")
}

/// A value for each lane, of all sizes and kinds.
fn argument(lane: usize, k: usize) -> f64 {
    let kinds = [
        0.0,
        1.0,
        0.5,
        -2.75,
        1e-42,
        3e38,
        f64::NAN,
        f64::INFINITY,
        1e9,
        4097.0,
        1e-7,
        2.5,
    ];
    let value = kinds[(lane * (k + 1) + 5 * k) % kinds.len()];
    if (lane + k).is_multiple_of(3) {
        -value
    } else {
        value
    }
}

/// Results of all lanes, in code for this processor or for any.
fn results(program: &Program, for_any: bool) -> Vec<Vec<f64>> {
    let mut machine = Machine::new(program);
    for lane in 0..LANES {
        for (k, component) in program.arguments.iter().enumerate() {
            machine.set_argument(k, lane, component.encode(argument(lane, k)));
        }
    }
    let limits = Limits::default();
    if for_any {
        machine.mask = Mask::first(LANES);
        machine.execute(limits, &mut ()).expect("a run");
    } else {
        machine.run(LANES, limits).expect("a run");
    }
    let of_lane = |lane| {
        let results = program.results.iter().enumerate();
        results
            .map(|(k, component)| component.decode(machine.result(k, lane)))
            .collect()
    };
    (0..LANES).map(of_lane).collect()
}

#[test]
fn every_processor_has_the_same_bits() {
    let wgsl = "
        fn mixed(word: u32) -> u32 { return ((word >> ((word >> 28u) + 4u)) ^ word) * 277803737u; }
        fn test(a: f32, b: f32, c: f32) -> array<f32, 24> {
            let n = i32(a);
            let word = mixed(bitcast<u32>(b)) ^ u32(c);
            return array<f32, 24>(
                a + b, a - b, a * b, a / b, fma(a, b, c), min(a, b), max(b, a), clamp(c, a, b),
                floor(a), ceil(b), trunc(c), round(a), fract(b), sqrt(c), sign(a), abs(b),
                mix(a, b, c), smoothstep(a, b, c), step(a, b), select(a, b, c < a),
                f32(word), f32(n / 3), f32(countOneBits(word)), f32(n % 5),
            );
        }";
    for arithmetic in [Arithmetic::Reference, Arithmetic::Ieee32] {
        let program = program(wgsl, arithmetic);
        let (this, any) = (results(&program, false), results(&program, true));
        for (lane, (this, any)) in this.iter().zip(&any).enumerate() {
            for (k, (x, y)) in this.iter().zip(any).enumerate() {
                let same = x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
                assert!(
                    same,
                    "{arithmetic:?}, lane {lane}, result {k}: {x}, not {y}"
                );
            }
        }
    }
}

/// Hashes that lanes share in blocks that not all of them run.
#[test]
fn shared_words_are_those_of_the_lanes_that_run() {
    let wgsl = "
        fn real_hash(x: f32, y: f32, z: f32, w: f32) -> f32 { return 0.0; }
        fn early(x: f32, y: f32) -> f32 {
            if x < 0.0 { return real_hash(y, x, 3.0, 4.0); }
            return 10.0 + real_hash(x, y, 3.0, 4.0);
        }
        fn test(x: f32, y: f32) -> array<f32, 4> {
            var out = array<f32, 4>();
            if x > 0.0 { out[0] = real_hash(x, y, 1.0, 2.0); } else { out[0] = real_hash(y, y, 1.0, 2.0); }
            out[1] = real_hash(y, y, 1.0, 2.0) + real_hash(x, y, 1.0, 2.0);
            for (var k = 0; k < 3; k++) {
                if y > f32(k) { continue; }
                out[2] += real_hash(f32(k), x, 1.0, 2.0);
            }
            out[2] += real_hash(0.0, x, 1.0, 2.0);
            out[3] = early(x, y) + real_hash(y, x, 3.0, 4.0);
            return out;
        }";
    let program = program(wgsl, Arithmetic::Reference);
    for (lane, actual) in results(&program, false).iter().enumerate() {
        let (x, y) = (argument(lane, 0), argument(lane, 1));
        let at = |a: f64, b: f64, c: f64, d: f64| hash(&[a, b, c, d]);
        let mut expected = [0.0; 4];
        expected[0] = if x > 0.0 {
            at(x, y, 1.0, 2.0)
        } else {
            at(y, y, 1.0, 2.0)
        };
        expected[1] = at(y, y, 1.0, 2.0) + at(x, y, 1.0, 2.0);
        for k in [0.0, 1.0, 2.0] {
            if y > k {
                continue;
            }
            expected[2] += at(k, x, 1.0, 2.0);
        }
        expected[2] += at(0.0, x, 1.0, 2.0);
        let early = if x < 0.0 {
            at(y, x, 3.0, 4.0)
        } else {
            10.0 + at(x, y, 3.0, 4.0)
        };
        expected[3] = early + at(y, x, 3.0, 4.0);
        for (k, (&actual, expected)) in actual.iter().zip(expected).enumerate() {
            let same = actual == expected || actual.is_nan() && expected.is_nan();
            assert!(same, "({x}, {y}), {k}: {actual}, not {expected}");
        }
    }
}
