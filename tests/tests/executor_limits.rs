//! The executor on what is large, endless or foreign: bounds with their messages, small stacks, refusals.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use cpu_time::ThreadTime;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{
    BinaryOperator, Expression, Function, FunctionArgument, FunctionResult, Handle, Literal,
    Module, Range, Scalar, Span, Statement, Type, TypeInner,
};
use pullback_compiler::lower::{Format, Precision};
use pullback_compiler::stable::Rewrites;
use pullback_compiler::{EvalModule, What, compile};
use pullback_runtime::evaluate::Surroundings;
use pullback_runtime::executor::{
    Arithmetic, Contraction, Fault, Limits, MAX_FORMULA_TURNS, MAX_STEPS, MAX_TURNS, Machine,
    Options, Painter, Program, Rows, Start, Watched,
};
use pullback_runtime::{Error, Frame, Pipeline, Size, View};

// what the language allows: 100,000 steps of each of eight loops within one another
const _: () = assert!(MAX_STEPS > 8 * 100_000);
// the longest loops of the language, and of a scene's settings
const _: () = assert!(MAX_FORMULA_TURNS > 100_000 && MAX_TURNS > 8192);

const OPTIONS: Options = Options {
    arithmetic: Arithmetic::Reference,
    format: Format::Single,
    watched: Watched::Nothing,
    contraction: Contraction::None,
};

fn validated(module: Module) -> (Module, ModuleInfo) {
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(&module)
        .expect("a valid module");
    (module, info)
}

fn parsed(wgsl: &str) -> (Module, ModuleInfo) {
    validated(
        naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|e| panic!("{}", e.emit_to_string(wgsl))),
    )
}

fn program(wgsl: &str) -> Result<Program, Fault> {
    let (module, info) = parsed(wgsl);
    Program::new(&module, &info, Start::Function("test"), OPTIONS)
}

/// Runs on a stack much smaller than that of any thread.
fn on_small_stack<T: Send>(run: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| {
        let builder = std::thread::Builder::new().stack_size(192 << 10);
        let thread = builder.spawn_scoped(scope, run).expect("a thread");
        thread.join().expect("no panic")
    })
}

/// The results of `test` for these arguments, each in a lane.
fn run(program: &Program, arguments: &[u64], limits: Limits) -> Result<Vec<u64>, Fault> {
    let mut machine = Machine::new(program);
    for (lane, &word) in arguments.iter().enumerate() {
        machine.set_argument(0, lane, word);
    }
    machine.run(arguments.len(), limits)?;
    Ok((0..arguments.len())
        .map(|lane| machine.result(0, lane))
        .collect())
}

const COUNTING: &str = "fn test(n: u32) -> u32 {
    var k = 0u;
    loop { if k == n { break; } k += 1u; }
    return k;
}";

fn steps(steps: u64) -> Limits<'static> {
    Limits {
        steps,
        turns: u64::MAX,
        ..Limits::default()
    }
}

#[test]
fn loops_end_at_the_bound_with_a_message() {
    let program = program(COUNTING).expect("it is translated");
    assert_eq!(run(&program, &[1000], steps(1000)), Ok(vec![1000]));
    let fault = run(&program, &[1001], steps(1000)).expect_err("one step too many");
    assert!(matches!(fault, Fault::Steps { limit: 1000, .. }));
    assert_eq!(
        fault.to_string(),
        "the loops of one sample take more than 1000 steps, most of them in `test`; give them a smaller bound"
    );
    let endless = run(&program, &[0, 5, u64::from(u32::MAX)], steps(100_000));
    assert!(matches!(endless, Err(Fault::Steps { limit: 100_000, .. })));
}

/// A loop is told by its function and its place in the text.
#[test]
fn a_loop_ends_at_its_own_bound() {
    let translated = program(COUNTING).expect("it is translated");
    let limits = |turns| Limits {
        turns,
        ..Limits::default()
    };
    assert_eq!(
        run(&translated, &[5, 1000], limits(1000)),
        Ok(vec![5, 1000])
    );
    let fault = run(&translated, &[5, 1001], limits(1000)).expect_err("one step too many");
    assert_eq!(
        fault.to_string(),
        "a loop takes more than 1000 steps at a time: in `test`"
    );
    let Fault::Turns {
        place: Some(place), ..
    } = fault
    else {
        panic!("{fault:?}")
    };
    let text = &COUNTING[place.span.clone().expect("a place")];
    assert!(text.starts_with("loop {") && text.ends_with('}'), "{text}");
    assert_eq!(place.in_formula(), None);
    // entered again and again, it begins to count anew
    let again = program(
        "fn count(n: u32) -> u32 {
            var k = 0u;
            loop { if k == n { return k; } k += 1u; }
            return 0u;
        }
        fn test(n: u32) -> u32 {
            var sum = 0u;
            for (var i = 0u; i < 10u; i++) { sum += count(n) + count(n / 2u); }
            return sum;
        }",
    )
    .expect("it is translated");
    assert_eq!(run(&again, &[20, 4], limits(20)), Ok(vec![300, 60]));
    assert!(run(&again, &[20, 4], limits(19)).is_err());
}

/// Processor time for which an endless loop may run in an unoptimised build.
const SOON: Duration = Duration::from_secs(20);

/// Loops without an end, alone and around loops with one.
#[test]
fn endless_loops_are_told_soon() {
    let bodies = [
        "loop { }",
        "loop { x += 1.0; }",
        "loop { if x < 0.0 { break; } x = sin(x) * sin(x) + cos(x * 2.0) + exp(-x * x) + 1.0; }",
        "loop { for (var k = 0u; k < n / 16u; k++) { x += 1.0; } }",
    ];
    for body in bodies {
        let text = format!("fn test(n: u32) -> u32 {{ var x = f32(n); {body} return u32(x); }}");
        let program = program(&text).expect("it is translated");
        let lanes: Vec<u64> = (0..64).collect();
        let start = ThreadTime::now();
        let failed = run(&program, &lanes, Limits::default());
        let took = start.elapsed();
        assert!(
            matches!(failed, Err(Fault::Turns { .. })),
            "{body}: {failed:?}"
        );
        println!("{body}: {took:?}");
        assert!(took < SOON, "{body}: {took:?}");
    }
}

/// Each sample counts by itself.
#[test]
fn samples_do_not_count_together() {
    let program = program(
        "fn work(n: u32) -> u32 { var k = 0u; loop { if k == n { return k; } k += 1u; } return 0u; }
        fn with_samples(n: u32) -> u32 {
            var sum = 0u;
            for (var j = 0u; j < 4u; j++) { for (var i = 0u; i < 4u; i++) { sum += work(n); } }
            return sum;
        }
        fn test(n: u32) -> u32 { return with_samples(n); }",
    )
    .expect("it is translated");
    assert_eq!(run(&program, &[20], steps(22)), Ok(vec![320]));
    let failed = run(&program, &[20], steps(19));
    assert!(
        matches!(failed, Err(Fault::Steps { limit: 19, .. })),
        "{failed:?}"
    );
}

/// The formula's loop is told by its place in the user's text.
#[test]
fn a_loop_of_the_formula_is_told_by_its_place() {
    const TEXT: &str = "g(z) = z^2\nf(z) = 1 + iterate(900, w = 0, g(w) + z)";
    let program = compile(TEXT).program.expect("a program");
    let formula = &program.pictures()[0].formula;
    let module = EvalModule::new(formula, What::Value, Precision::Double).expect("a module");
    let mut rows = Rows::new(&module, Arithmetic::Reference).expect("it is translated");
    rows.steps = 100;
    let failed = rows.eval(Surroundings::default(), 1, &[0.0, 0.0], &mut Vec::new());
    let Err(Error::Executor(fault)) = failed else {
        panic!("{failed:?}")
    };
    let place = fault.in_formula().expect("a place");
    assert_eq!(&TEXT[place], "iterate(900, w = 0, g(w) + z)");
}

/// Each lane's steps count, whatever its neighbours do: together these take more than any of them.
#[test]
fn neighbours_do_not_count() {
    let program = program(
        "fn test(n: u32) -> u32 {
            var sum = 0u;
            for (var i = 0u; i < 10u; i++) {
                for (var j = 0u; j < select(0u, 100u, i == n); j++) { sum += 1u; }
            }
            return sum;
        }",
    )
    .expect("it is translated");
    let arguments: Vec<u64> = (0..10).collect();
    assert_eq!(run(&program, &arguments, steps(110)), Ok(vec![100; 10]));
    let failed = run(&program, &arguments, steps(109));
    assert!(matches!(failed, Err(Fault::Steps { limit: 109, .. })));
}

#[test]
fn runs_are_cancelled() {
    let program = program(COUNTING).expect("it is translated");
    let flag = AtomicBool::new(true);
    let limits = Limits {
        cancel: Some(&flag),
        ..Limits::default()
    };
    assert_eq!(run(&program, &[100_000], limits), Err(Fault::Cancelled));
}

fn frame() -> Frame<'static> {
    Frame {
        view: View {
            center: [-0.5, 0.0],
            height: 2.0,
        },
        params: &[],
        settings: &[],
        size: Size {
            width: 40,
            height: 9,
        },
        samples: 1,
        time: 0.0,
        pipeline: Pipeline::Compute,
    }
}

const MANDELBROT: &str = "f(z) = iterate(50, w = 0, w^2 + z until |w| > 4)";

#[test]
fn pictures_end_at_the_bound_and_are_cancelled() {
    let program = compile(MANDELBROT).program.expect("a program");
    let Ok(scene) = program.scene_module(0, Precision::Double) else {
        panic!("no scene");
    };
    let settings = &program.pictures()[0].settings;
    let mut painter =
        Painter::new(&scene, Arithmetic::Reference, Pipeline::Compute).expect("a painter");
    let flag = AtomicBool::new(false);
    let mut rows = Vec::new();
    painter
        .render(&frame(), settings, &flag, &mut rows)
        .expect("a picture");
    assert_eq!(rows.len(), 40 * 9 * 4);
    painter.steps = 20;
    let failed = painter.render(&frame(), settings, &flag, &mut Vec::new());
    assert!(
        matches!(failed, Err(Error::Executor(Fault::Steps { limit: 20, .. }))),
        "{failed:?}"
    );
    flag.store(true, std::sync::atomic::Ordering::Relaxed);
    let failed = painter.render(&frame(), settings, &flag, &mut Vec::new());
    assert!(
        matches!(failed, Err(Error::Executor(Fault::Cancelled))),
        "{failed:?}"
    );
}

#[test]
fn a_formula_of_100_000_nodes() {
    const COUNT: usize = 100_000;
    let text = format!("f(x, y) = x{}", " + y".repeat(COUNT));
    let program = compile(&text)
        .program
        .expect("a program")
        .with_rewrites(Rewrites::OFF);
    let formula = &program.pictures()[0].formula;
    let module = EvalModule::new(formula, What::Value, Precision::Double).expect("a module");
    let (instructions, results) = on_small_stack(|| {
        let rows = Rows::new(&module, Arithmetic::Reference).expect("it is translated");
        let mut results = Vec::new();
        rows.eval(
            Surroundings::default(),
            2,
            &[1.0, 2.0, 3.0, -1.0],
            &mut results,
        )
        .expect("it runs");
        (rows.program().instructions(), results)
    });
    assert!(instructions >= COUNT, "{instructions}");
    assert_eq!(results, [200_001.0, -99_997.0]);
}

/// Functions each of which calls the one before and adds 1; `calls` says how often, so that none is written out.
fn chain(count: usize, calls: usize) -> (Module, ModuleInfo) {
    let mut module = Module::default();
    let ty = module.types.insert(
        Type {
            name: None,
            inner: TypeInner::Scalar(Scalar::F32),
        },
        Span::UNDEFINED,
    );
    let mut before: Option<Handle<Function>> = None;
    for k in 0..count {
        let mut function = Function {
            name: Some(if k + 1 == count {
                "test".into()
            } else {
                format!("f{k}")
            }),
            arguments: vec![FunctionArgument {
                name: None,
                ty,
                binding: None,
            }],
            result: Some(FunctionResult { ty, binding: None }),
            ..Function::default()
        };
        let add = |function: &mut Function, e| function.expressions.append(e, Span::UNDEFINED);
        let mut sum = add(&mut function, Expression::FunctionArgument(0));
        let one = add(&mut function, Expression::Literal(Literal::F32(1.0)));
        if let Some(callee) = before {
            for _ in 0..calls {
                let result = add(&mut function, Expression::CallResult(callee));
                let call = Statement::Call {
                    function: callee,
                    arguments: vec![sum],
                    result: Some(result),
                };
                function.body.push(call, Span::UNDEFINED);
                sum = result;
            }
        }
        for _ in 0..30 {
            let start = function.expressions.len();
            let (op, left, right) = (BinaryOperator::Add, sum, one);
            sum = add(&mut function, Expression::Binary { op, left, right });
            let emitted: Range<Expression> = function.expressions.range_from(start);
            function
                .body
                .push(Statement::Emit(emitted), Span::UNDEFINED);
        }
        function
            .body
            .push(Statement::Return { value: Some(sum) }, Span::UNDEFINED);
        before = Some(module.functions.append(function, Span::UNDEFINED));
    }
    validated(module)
}

#[test]
fn deep_chains_of_calls() {
    for (count, calls, expected) in [(10_000, 1, 300_000.0), (12, 2, 30.0 * 4095.0)] {
        let (module, info) = chain(count, calls);
        let found = on_small_stack(|| {
            let program = Program::new(&module, &info, Start::Function("test"), OPTIONS)
                .expect("it is translated");
            let run = run(
                &program,
                &[0.5f64.to_bits(), 2.0f64.to_bits()],
                Limits::default(),
            );
            run.expect("it runs")
                .into_iter()
                .map(f64::from_bits)
                .collect::<Vec<_>>()
        });
        assert_eq!(found, [expected + 0.5, expected + 2.0]);
    }
}

#[test]
fn what_no_module_of_ours_has_is_refused_by_name() {
    let check = |wgsl: &str, expected: &str| {
        let refused = program(wgsl).expect_err(wgsl);
        assert_eq!(refused.to_string(), expected, "{wgsl}");
    };
    check(
        "@group(0) @binding(0) var t: texture_2d<f32>;
         fn test() -> vec4f { return textureLoad(t, vec2i(0), 0); }",
        "reading a texture cannot be executed on the processor; it is in `test`",
    );
    check(
        "fn inner(x: f32) -> f32 { return dpdx(x); } fn test(x: f32) -> f32 { return inner(x); }",
        "a derivative across pixels cannot be executed on the processor; it is in `inner`",
    );
    check(
        "var<private> p: f32; fn test() -> f32 { return p; }",
        "a private variable cannot be executed on the processor; it is in `test`",
    );
    check(
        "fn test(x: vec2f) -> f32 { return unpack2x16float(pack2x16float(x)).x; }",
        "the function Pack2x16float of these types cannot be executed on the processor; it is in `test`",
    );
    check(
        "fn by(p: ptr<function, f32>) { *p += 1.0; } fn test(x: f32) -> f32 { var y = x; by(&y); return y; }",
        "a pointer as a value cannot be executed on the processor; it is in `test`",
    );
    let missing = parsed("fn other() {}");
    let refused =
        Program::new(&missing.0, &missing.1, Start::Function("test"), OPTIONS).expect_err("none");
    assert_eq!(refused.to_string(), "the shader has no function `test`");
}

#[test]
fn rows_of_another_width_are_refused() {
    let program = compile("x + y").program.expect("a program");
    let Ok(module) = program.eval_module(0, What::Value, Precision::Accurate) else {
        panic!("no module");
    };
    let rows = Rows::new(&module, Arithmetic::Ieee32).expect("it is translated");
    let refused = rows.eval(Surroundings::default(), 2, &[1.0; 3], &mut Vec::new());
    assert!(matches!(refused, Err(Error::Invalid { .. })), "{refused:?}");
}
