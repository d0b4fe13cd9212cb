//! Times of frames: each function has a process of its own, which can be ended while its driver still compiles. Processes compile side
//! by side and draw one after the other.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use pullback_compiler::table;
use pullback_runtime::{AdapterChoice, Error, Frame, Gpu, Pipeline, Renderer, Size};
use pullback_tests::special::SpecialFormula;
use pullback_tests::special_cost::{Cost, Costs};
use pullback_tests::stills::Still;

use super::Options;

/// Samples of a pixel on each axis.
const SAMPLES: u32 = 2;
/// Frames after one that does not count.
const FRAMES: u32 = 3;
/// What a child says when its shader is compiled.
const READY: &str = "ready";
/// What is said before a reason why there is no time.
const WRONG: &str = "wrong: ";

/// A child that compiles or draws.
struct Running<'a> {
    name: &'a str,
    process: Child,
}

impl Drop for Running<'_> {
    fn drop(&mut self) {
        // it may have ended by itself
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Times frames of all functions that the file does not have yet, begun with what costs the least by the operator table.
pub(super) fn measure(
    options: &Options,
    adapter: &str,
    formulas: &[SpecialFormula],
    costs: &mut Costs,
) -> Result<(), Error> {
    let end = Instant::now() + Duration::from_secs(options.seconds);
    let gpu = Gpu::open(&adapter.parse::<AdapterChoice>().unwrap_or_default())?;
    println!("{}\n", gpu.adapter());
    let cost = if gpu.adapter().is_software() {
        Cost::SoftwareFrame
    } else {
        Cost::Frame
    };
    drop(gpu);
    let mut open: Vec<&SpecialFormula> = formulas
        .iter()
        .filter(|formula| costs.of(formula.name, cost).is_none())
        .collect();
    open.sort_by_key(|formula| table::row(formula.prim).cost.complex);
    let all = open.len();
    let mut timed = 0;
    for group in open.chunks(options.threads.max(1)) {
        if Instant::now() >= end {
            break;
        }
        for (name, time) in timed_group(options, adapter, group, end)? {
            match &time {
                Ok(seconds) => println!("{name}: {seconds:.6} s"),
                Err(reason) => println!("{name}: {reason}"),
            }
            costs.add(name, cost, time)?;
            timed += 1;
        }
    }
    println!("\n{timed} of {all} functions that were open");
    Ok(())
}

/// A function and the seconds of its frame, or why there are none.
type Timed<'a> = (&'a str, Result<f64, String>);

/// Compiles the functions of a group at the same time, and then times their frames; what is not ready at the end is left out.
fn timed_group<'a>(
    options: &Options,
    adapter: &str,
    group: &[&'a SpecialFormula],
    end: Instant,
) -> Result<Vec<Timed<'a>>, Error> {
    let (sender, lines) = channel();
    let mut children = Vec::new();
    for (k, formula) in group.iter().enumerate() {
        children.push(start(options, adapter, formula.name, k, &sender)?);
    }
    drop(sender);
    let (ready, mut timed) = wait_for_all(&children, &lines, end);
    for k in ready {
        let child = &mut children[k];
        if let Some(input) = &mut child.process.stdin {
            let _ = input.write_all(b"go\n");
        }
        match next_line(&lines, end) {
            Some((_, line)) => timed.push((child.name, seconds(&line))),
            None => break,
        }
    }
    Ok(timed)
}

fn start<'a>(
    options: &Options,
    adapter: &str,
    name: &'a str,
    k: usize,
    sender: &Sender<(usize, String)>,
) -> Result<Running<'a>, Error> {
    let Size { width, height } = options.size;
    let mut process = Command::new(std::env::current_exe()?)
        .args(["--adapter", adapter, "--child", name])
        .args(["--size", &format!("{width}x{height}")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    if let Some(output) = process.stdout.take() {
        let sender = sender.clone();
        std::thread::spawn(move || {
            let mut is_over = false;
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                is_over = line != READY;
                if sender.send((k, line)).is_err() {
                    return;
                }
            }
            if !is_over {
                // nobody listens where the time is over
                let _ = sender.send((k, format!("{WRONG}the process ended")));
            }
        });
    }
    Ok(Running { name, process })
}

/// Until each child is ready or has failed: those that are ready, and those that are not, with the reason.
fn wait_for_all<'a>(
    children: &[Running<'a>],
    lines: &Receiver<(usize, String)>,
    end: Instant,
) -> (Vec<usize>, Vec<Timed<'a>>) {
    let (mut ready, mut failed) = (Vec::new(), Vec::new());
    while ready.len() + failed.len() < children.len() {
        match next_line(lines, end) {
            Some((k, line)) if line == READY => ready.push(k),
            Some((k, line)) => failed.push((children[k].name, seconds(&line))),
            None => break,
        }
    }
    (ready, failed)
}

fn next_line(lines: &Receiver<(usize, String)>, end: Instant) -> Option<(usize, String)> {
    let rest = end.saturating_duration_since(Instant::now());
    lines.recv_timeout(rest).ok()
}

fn seconds(line: &str) -> Result<f64, String> {
    let reason = line.strip_prefix(WRONG).unwrap_or(line);
    line.parse().map_err(|_| reason.to_owned())
}

/// The work of a child: it compiles, says so, waits for a line, and says how long a frame takes.
pub(super) fn child(options: &Options, formula: &SpecialFormula) -> Result<(), Error> {
    let adapter = options.adapter.as_deref().unwrap_or("auto");
    match frame(formula, adapter, options.size) {
        Ok(time) => println!("{}", time.as_secs_f64()),
        Err(error) => println!("{WRONG}{error}"),
    }
    Ok(())
}

/// A frame of the scene `domain`: by the device's timestamps, or on software by the clock.
fn frame(formula: &SpecialFormula, adapter: &str, size: Size) -> Result<Duration, Error> {
    let gpu = Gpu::open(&adapter.parse::<AdapterChoice>().unwrap_or_default())?;
    let still = Still::new(&formula.text, size, SAMPLES);
    let settings = still.scene.pack_settings(&still.settings);
    let frame = Frame {
        view: still.view,
        params: &still.params,
        settings: &settings,
        size,
        samples: SAMPLES,
        time: 0.0,
        pipeline: Pipeline::Compute,
    };
    let mut renderer = Renderer::for_settings(&gpu, &still.scene, &still.settings, SAMPLES)?;
    let mut rows = Vec::new();
    // a software adapter compiles with its first work
    let small = Size {
        width: 32,
        height: 18,
    };
    let warm = Frame {
        size: small,
        ..frame
    };
    renderer.render(&warm, &mut rows)?;
    println!("{READY}");
    let mut go = String::new();
    std::io::stdin().lock().read_line(&mut go)?;
    if !gpu.adapter().is_software() {
        renderer.render(&frame, &mut rows)?;
        if let Some(seconds) = renderer.device_time(&frame, FRAMES)? {
            return Ok(Duration::from_secs_f64(seconds));
        }
    }
    rows.clear();
    let start = Instant::now();
    renderer.render(&frame, &mut rows)?;
    Ok(start.elapsed())
}
