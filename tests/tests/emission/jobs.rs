//! What a browser is to compute of a formula: emitted code with what calls it at the points of a table.

use std::fmt::Write as _;

use pullback_compiler::formula::Formula;
use pullback_compiler::types::Type;
use pullback_compiler::{Emission, EmitWhat, Emitted, Target, What, compile};
use pullback_runtime::validators::browser::literal;
use pullback_tests::accuracy::evaluators::Point;

/// What is asked for a formula besides its value.
fn slope(what: What) -> EmitWhat {
    match what {
        What::Gradient => EmitWhat::Gradient,
        _ => EmitWhat::Derivative,
    }
}

/// How results of a type are taken apart, into scalars.
fn scalars(text: &str, ty: &str, value: &str, target: Target) -> Vec<String> {
    let count = match ty.trim_end_matches('f') {
        "vec2" => 2,
        "vec3" => 3,
        "vec4" => 4,
        // `f32`, or `float`
        "32" | "f32" | "loat" | "float" => return vec![value.to_owned()],
        _ => 0,
    };
    if count > 0 {
        let component = |letter: char| format!("{value}.{letter}");
        return "xyzw".chars().take(count).map(component).collect();
    }
    let (_, members) = text
        .split_once(&format!("struct {ty} {{\n"))
        .expect("a structure");
    let members = members.lines().take_while(|line| line.starts_with(' '));
    let member = |line: &str| {
        let line = line.trim().trim_end_matches([',', ';']);
        let (name, ty) = match target {
            Target::Wgsl => line.split_once(": ").expect("a member"),
            _ => line
                .split_once(' ')
                .map(|(ty, name)| (name, ty))
                .expect("a member"),
        };
        scalars(text, ty, &format!("{value}.{name}"), target)
    };
    members.flat_map(member).collect()
}

/// A call with the k-th number of a point written as `point(k)`, and the type of what it gives.
fn call(
    emitted: &Emitted,
    k: usize,
    formula: &Formula,
    point: &Point,
    target: Target,
) -> (String, String) {
    let function = &emitted.functions[k];
    let mut at = 0;
    let mut next = || {
        at += 1;
        format!("point({})", at - 1)
    };
    let suffix = if target == Target::Wgsl { "f" } else { "" };
    let mut arguments: Vec<String> = Vec::new();
    for input in &formula.inputs {
        let count = match input.ty {
            Type::Complex => 2,
            Type::Vector(n) => n,
            _ => 1,
        };
        let parts: Vec<String> = (0..count).map(|_| next()).collect();
        arguments.push(match count {
            1 => parts[0].clone(),
            _ => format!("vec{count}{suffix}({})", parts.join(", ")),
        });
    }
    let taken = function.signature.matches(',').count() + 1;
    if taken > arguments.len() {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "a number as the function takes it"
        )]
        arguments.extend(
            point
                .params
                .iter()
                .map(|&value| format!("{:?}", value as f32)),
        );
    }
    // the clock stands still, and tables know no pixel
    arguments.resize(taken, "0.0".to_owned());
    let ty = match target {
        Target::Wgsl => function.signature.rsplit(' ').next(),
        _ => function.signature.split(' ').next(),
    };
    (
        format!("{}({})", function.name, arguments.join(", ")),
        ty.unwrap_or_default().to_owned(),
    )
}

/// What the browser is to compute: a program, the numbers of its points, and how many of the results are the value.
pub struct Job {
    code: String,
    points: Vec<Point>,
    of_value: usize,
    all: usize,
}

impl Job {
    pub fn new(
        source: &str,
        formula: &Formula,
        what: What,
        points: &[Point],
        target: Target,
    ) -> Result<Self, String> {
        let program = compile(source).program.ok_or("no program")?;
        let emission = Emission::new(EmitWhat::Value, target).and(slope(what));
        let emitted = program
            .emit_all(&emission)
            .map_err(|problems| format!("{problems:?}"))?;
        let text = String::from_utf8_lossy(&emitted.bytes).into_owned();
        let first = points.first().ok_or("no points")?;
        let mut calls = String::new();
        let mut results = Vec::new();
        let mut of_value = 0;
        for k in 0..2 {
            let (call, ty) = call(&emitted, k, formula, first, target);
            let _ = match target {
                Target::Wgsl => writeln!(calls, "    let check_{k} = {call};"),
                _ => writeln!(calls, "    {ty} check_{k} = {call};"),
            };
            results.extend(scalars(&text, &ty, &format!("check_{k}"), target));
            if k == 0 {
                of_value = results.len();
            }
        }
        let all = results.len();
        let stride = first.args.len();
        let code = match target {
            Target::Wgsl => of_wgsl(&text, &calls, &results, stride),
            _ => of_glsl(&text, &calls, &results),
        };
        Ok(Self {
            code,
            points: points.to_vec(),
            of_value,
            all,
        })
    }

    /// The job as an object of JavaScript.
    pub fn script(&self) -> String {
        #[allow(
            clippy::cast_possible_truncation,
            reason = "a number as the function takes it"
        )]
        let number = |v: &f64| match *v as f32 {
            v if v.is_nan() => "NaN".to_owned(),
            v if v.is_infinite() => format!("{}Infinity", if v < 0.0 { "-" } else { "" }),
            v => format!("{v:?}"),
        };
        let numbers: Vec<String> = self
            .points
            .iter()
            .flat_map(|p| p.args.iter().map(number))
            .collect();
        format!(
            "{{rows: {}, stride: {}, width: {}, code: {}, points: [{}]}}",
            self.points.len(),
            self.points[0].args.len(),
            self.all,
            literal(&self.code),
            numbers.join(",")
        )
    }

    /// The rows of the value or of the derivatives, as the tables have them.
    pub fn rows(
        &self,
        formula: &Formula,
        what: What,
        answer: &str,
    ) -> Result<Vec<Vec<f64>>, String> {
        if let Some(error) = answer.strip_prefix("error ") {
            return Err(format!("{error}\n{}", self.code));
        }
        let number = |n: &str| {
            n.parse::<f32>()
                .map(f64::from)
                .map_err(|e| format!("{n}: {e}"))
        };
        let all: Result<Vec<f64>, String> = answer.split_whitespace().map(number).collect();
        let all = all?;
        if all.len() != self.all * self.points.len() {
            return Err(format!("{} numbers", all.len()));
        }
        let row = |row: &[f64]| {
            if what == What::Value {
                return row[..self.of_value].to_vec();
            }
            let mut row = row[self.of_value..].to_vec();
            // the function has the value behind the derivatives, the tables before them
            if what == What::Gradient && formula.ty == Type::Real && row.len() <= 4 {
                row.rotate_right(1);
            }
            row
        };
        Ok(all.chunks(self.all).map(row).collect())
    }
}

fn of_wgsl(text: &str, calls: &str, results: &[String], stride: usize) -> String {
    let mut stores = String::new();
    for (k, result) in results.iter().enumerate() {
        let _ = writeln!(
            stores,
            "    check_results[id.x * {}u + {k}u] = {result};",
            results.len()
        );
    }
    let mut calls = calls.to_owned();
    for k in 0..stride {
        calls = calls.replace(
            &format!("point({k})"),
            &format!("check_points[id.x * {stride}u + {k}u]"),
        );
    }
    format!(
        "{text}
@group(0) @binding(0) var<storage, read> check_points: array<f32>;
@group(0) @binding(1) var<storage, read_write> check_results: array<f32>;

@compute @workgroup_size(64)
fn check_main(@builtin(global_invocation_id) id: vec3u) {{
    if id.x * {stride}u >= arrayLength(&check_points) {{ return; }}
{calls}{stores}}}
"
    )
}

fn of_glsl(text: &str, calls: &str, results: &[String]) -> String {
    let mut stores = String::new();
    for (k, result) in results.iter().enumerate() {
        let _ = writeln!(
            stores,
            "    if (gl_FragCoord.x > {k}.0) check_result = vec4({result});"
        );
    }
    format!(
        "#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
{text}
uniform sampler2D check_points;
out vec4 check_result;
float point(int k) {{ return texelFetch(check_points, ivec2(k, int(gl_FragCoord.y)), 0).r; }}
void main() {{
{calls}{stores}}}
"
    )
}
