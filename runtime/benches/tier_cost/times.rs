//! Frame times of a scene's tiers, within a budget.

use std::time::Instant;

use crate::scene::Scene;
use crate::stage::{Canvas, Stage};

/// A timed submission on hardware should take this long at least.
const SHORTEST: f64 = 2e-3;
/// Most frames in one.
const MOST_REPEATS: f64 = 64.0;
/// Turns that there are in any case, and at most.
const TURNS: [f64; 2] = [3.0, 15.0];
/// The part of the budget for the first frames, in which clocks rise and caches fill.
const WARM_UP: f64 = 0.1;
/// Most by which the sides of a picture are divided.
const SMALLEST: u32 = 16;

/// Seconds of a frame in `fast`, then the cost of the other tiers relative to it, none where the adapter does not have a
/// tier; and the size at which they were measured.
pub fn times(
    scene: &Scene,
    largest: [u32; 2],
    seconds: f64,
) -> Result<([u32; 2], Vec<Option<f64>>), String> {
    let mut divisor = SMALLEST;
    loop {
        let size = largest.map(|side| (side / divisor).max(1));
        let (canvas, stages) = scene.sized(size)?;
        let costs = first_frames(&canvas, &stages, seconds)?;
        let turn: f64 = costs.iter().map(|c| c.seconds * f64::from(c.repeats)).sum();
        // a picture of twice the size has four times the pixels, and must leave room for the least number of turns
        if divisor > 1 && 4.0 * turn * TURNS[0] < seconds {
            divisor /= 2;
            continue;
        }
        let turns = (seconds / turn.max(1e-9)).clamp(TURNS[0], TURNS[1]) as usize;
        return Ok((size, ratios(&canvas, &stages, &costs, turns)?));
    }
}

/// What a frame of a tier takes, and how many make a submission.
struct Cost {
    seconds: f64,
    repeats: u32,
}

/// Draws until clocks have risen, each tier for its part of the time.
fn first_frames(
    canvas: &Canvas,
    stages: &[Option<Stage>],
    seconds: f64,
) -> Result<Vec<Cost>, String> {
    let share = seconds * WARM_UP / stages.len() as f64;
    let cost = |stage: &Option<Stage>| {
        let Some(stage) = stage else {
            return Ok(Cost {
                seconds: 0.0,
                repeats: 1,
            });
        };
        // a software adapter compiles while it draws the first frame
        time(canvas, stage, 1)?;
        let start = Instant::now();
        let mut once = time(canvas, stage, 1)?;
        while start.elapsed().as_secs_f64() < share {
            once = time(canvas, stage, 1)?;
        }
        let enough = if canvas.has_clock() {
            (SHORTEST / once.max(1e-6)).ceil()
        } else {
            1.0
        };
        Ok(Cost {
            seconds: once,
            repeats: enough.clamp(1.0, MOST_REPEATS) as u32,
        })
    };
    stages.iter().map(cost).collect()
}

fn ratios(
    canvas: &Canvas,
    stages: &[Option<Stage>],
    costs: &[Cost],
    turns: usize,
) -> Result<Vec<Option<f64>>, String> {
    let mut all: Vec<Vec<f64>> = vec![Vec::new(); stages.len()];
    for _ in 0..turns {
        for ((stage, cost), times) in stages.iter().zip(costs).zip(&mut all) {
            if let Some(stage) = stage {
                times.push(time(canvas, stage, cost.repeats)?);
            }
        }
    }
    let fast = all[0].clone();
    let ratio = |times: &Vec<f64>| {
        let ratios = times.iter().zip(&fast).map(|(ours, fast)| ours / fast);
        (!times.is_empty()).then(|| median(ratios.collect()))
    };
    let mut out: Vec<Option<f64>> = all.iter().map(ratio).collect();
    out[0] = Some(median(fast));
    Ok(out)
}

fn time(canvas: &Canvas, stage: &Stage, repeats: u32) -> Result<f64, String> {
    canvas.time(stage, repeats).map_err(|e| e.to_string())
}

/// The middle of the list.
pub fn median(mut list: Vec<f64>) -> f64 {
    list.sort_by(f64::total_cmp);
    list.get(list.len() / 2).copied().unwrap_or(f64::NAN)
}
