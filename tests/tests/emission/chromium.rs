//! Emitted WGSL and GLSL, compiled and run in Chromium, against the tables of the gallery: WebGPU and WebGL 2 on the browser's
//! own software adapter, so that it needs no GPU. Tint and ANGLE, which compile them, share nothing with naga.

use std::fmt::Write as _;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use pullback_compiler::formula::Formula;
use pullback_compiler::types::Type;
use pullback_compiler::{Emission, EmitWhat, Emitted, Target, What, compile};
use pullback_tests::accuracy::error::Format;
use pullback_tests::accuracy::evaluators::Point;
use pullback_tests::accuracy::formulas::{MOST, gallery};

const PAGE: &str = include_str!("chromium.html");
/// How long the browser may take for all formulas.
const PATIENCE: Duration = Duration::from_secs(300);
/// How long it may take to ask for the page.
const START: Duration = Duration::from_secs(90);
/// Names under which systems install it.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

fn browser() -> Option<&'static str> {
    let is_there = |name: &&str| {
        let version = Command::new(name).arg("--version").output();
        version.is_ok_and(|output| output.status.success())
    };
    NAMES.into_iter().find(is_there)
}

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
struct Job {
    code: String,
    points: Vec<Point>,
    of_value: usize,
    all: usize,
}

impl Job {
    fn new(
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
    fn script(&self) -> String {
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
            "{{rows: {}, stride: {}, width: {}, code: `{}`, points: [{}]}}",
            self.points.len(),
            self.points[0].args.len(),
            self.all,
            self.code
                .replace('\\', "\\\\")
                .replace('`', "'")
                .replace("${", "$ {")
                .replace("</", "< /"),
            numbers.join(",")
        )
    }

    /// The rows of the value or of the derivatives, as the tables have them.
    fn rows(&self, formula: &Formula, what: What, answer: &str) -> Result<Vec<Vec<f64>>, String> {
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

/// Gives the page to who asks for it, and waits for what the page sends back. A browser that never asks cannot be started
/// here: it is missing, too.
fn served(listener: &TcpListener, page: &str) -> Result<String, String> {
    listener.set_nonblocking(true).map_err(|e| e.to_string())?;
    let started = Instant::now();
    let mut asked = false;
    while started.elapsed() < PATIENCE {
        let Ok((stream, _)) = listener.accept() else {
            if !asked && started.elapsed() > START {
                return Ok("done\nmissing display that it starts on".to_owned());
            }
            std::thread::sleep(Duration::from_millis(20));
            continue;
        };
        asked = true;
        // a browser opens connections that it does not use
        if let Some(answer) = exchanged(stream, page).unwrap_or(None) {
            return Ok(answer);
        }
    }
    Err("the browser did not answer in time".to_owned())
}

/// Serves one request: the body of a POST, or nothing where the page was wanted.
fn exchanged(stream: TcpStream, page: &str) -> std::io::Result<Option<String>> {
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(Duration::from_secs(2)))?;
    let mut reader = BufReader::new(stream);
    let (mut head, mut length) = (String::new(), 0);
    reader.read_line(&mut head)?;
    loop {
        let mut line = String::new();
        reader.read_line(&mut line)?;
        if line.trim().is_empty() {
            break;
        }
        if let Some((_, value)) = line.to_ascii_lowercase().split_once("content-length:") {
            length = value.trim().parse().unwrap_or(0);
        }
    }
    let mut body = vec![0; length];
    reader.read_exact(&mut body)?;
    let mut stream = reader.into_inner();
    let content = if head.starts_with("GET / ") { page } else { "" };
    write!(
        stream,
        "HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{content}",
        content.len()
    )?;
    let is_answer = head.starts_with("POST");
    Ok(is_answer.then(|| String::from_utf8_lossy(&body).into_owned()))
}

/// One line of the browser for each job.
fn run(browser: &str, jobs: &[Job], interface: &str, folder: &Path) -> Result<Vec<String>, String> {
    let scripts: Vec<String> = jobs.iter().map(Job::script).collect();
    let page = PAGE
        .replace("JOBS", &format!("[{}]", scripts.join(",\n")))
        .replace("INTERFACE", interface);
    let listener = TcpListener::bind("127.0.0.1:0").map_err(|e| e.to_string())?;
    let address = listener.local_addr().map_err(|e| e.to_string())?;
    let mut child = Command::new(browser)
        .args([
            "--headless=new",
            "--no-sandbox",
            "--no-first-run",
            "--disable-dev-shm-usage",
            "--enable-unsafe-webgpu",
            "--use-webgpu-adapter=swiftshader",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
        ])
        .arg(format!(
            "--user-data-dir={}",
            folder.join("profile").display()
        ))
        .arg(format!("http://{address}/"))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| e.to_string())?;
    let answer = served(&listener, &page);
    let _ = child.kill();
    let _ = child.wait();
    let answer = answer?;
    let lines = answer
        .strip_prefix("done\n")
        .ok_or_else(|| answer.clone())?;
    Ok(lines
        .split('\u{1e}')
        .map(|line| line.trim().to_owned())
        .collect())
}

/// The rows of all tables, by a browser's interface.
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn judged(target: Target, interface: &str) {
    let Some(browser) = browser() else {
        eprintln!("skipped: Chromium is not installed (Debian: chromium)");
        return;
    };
    // the browser's adapter takes subnormal numbers for 0, as both standards allow, and so what is made of them
    let started = Instant::now();
    let tables: Vec<_> = gallery()
        .into_iter()
        .map(|table| table.without("underflow"))
        .collect();
    let (mut jobs, mut found) = (Vec::new(), Vec::new());
    for table in &tables {
        // what is asked is known only to the table: the second question brings the derivative with it
        let told = table.measure_by(Format::Single, &mut |formula, what, points| {
            if what != What::Value {
                jobs.push(Job::new(&table.source, formula, what, points, target)?);
            }
            Ok(vec![vec![0.0; 64]; points.len()])
        });
        told.unwrap_or_else(|reason| panic!("{}: {reason}", table.name));
    }
    let folder = tempfile::tempdir().expect("a folder");
    let emitted = started.elapsed();
    let answers = run(browser, &jobs, interface, folder.path()).expect("an answer");
    if let Some(missing) = answers[0].strip_prefix("missing ") {
        eprintln!("skipped: {browser} has no {missing}");
        return;
    }
    assert_eq!(answers.len(), jobs.len());
    let (mut judged, mut worst) = (0, 0.0f64);
    for ((table, job), answer) in tables.iter().zip(&jobs).zip(&answers) {
        let factors = table.measure_by(Format::Single, &mut |formula, what, _| {
            job.rows(formula, what, answer)
        });
        match factors {
            Err(reason) => found.push(format!("{}: {reason}", table.name)),
            Ok(factors) => {
                judged += factors.rows;
                let most = factors.value.max(factors.derivative);
                worst = worst.max(most);
                if most > MOST {
                    found.push(format!(
                        "{}: K = {most:.2}, not {MOST}: {}",
                        table.name, factors.worst
                    ));
                }
                found.extend(factors.wrong.iter().map(|w| format!("{}: {w}", table.name)));
            }
        }
    }
    eprintln!(
        "{interface}: {} formulas, {judged} rows, at most K = {worst:.2}, in {:.0?}, {emitted:.0?} of them emitting",
        jobs.len(),
        started.elapsed()
    );
    assert!(
        found.is_empty(),
        "{} violations\n{}",
        found.len(),
        found.join("\n")
    );
    assert!(judged > 4000, "{judged} rows");
}

#[test]
fn emitted_wgsl_runs_in_chromium() {
    judged(Target::Wgsl, "webgpu");
}

#[test]
fn emitted_glsl_runs_in_chromium() {
    judged(Target::Glsl, "webgl2");
}
