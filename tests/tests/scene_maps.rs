//! Colour maps: pictures have the colours of the map that they name, modules hold none, and diverging maps are told apart
//! without red or green cones.

use pullback_compiler::lower::Precision;
use pullback_compiler::scene::colour_map;
use pullback_tests::accuracy::evaluators::suite_gpu;
use pullback_tests::pictures::{Camera, Picture};

type Rgb = [f64; 3];

/// A map at u in 0..1, linear light.
fn mapped(name: &str, u: f64) -> Rgb {
    let table = colour_map(name).expect("a map");
    let place = u.clamp(0.0, 1.0) * 128.0;
    let low = (place as usize).min(127);
    let part = place - low as f64;
    [0, 1, 2].map(|c| table[low][c] * (1.0 - part) + table[low + 1][c] * part)
}

const CAMERA: Camera = Camera {
    size: [64, 8],
    center: [0.0; 2],
    height: 0.5,
    samples: 1,
};

/// Greatest difference of a component from what is expected at the middle of each column.
fn worst(source: &str, camera: Camera, expected: impl Fn([f64; 2]) -> Rgb) -> Option<f64> {
    let gpu = suite_gpu()?;
    let picture = Picture::draw(&gpu, source, camera);
    let mut worst = 0.0_f64;
    for column in 0..camera.size[0] {
        let at = camera.world(f64::from(column) + 0.5, 4.5);
        let wanted = expected(at);
        for (found, wanted) in picture.linear(column, 4).iter().zip(wanted) {
            worst = worst.max((found - wanted).abs());
        }
    }
    Some(worst)
}

#[test]
fn values_have_the_colours_of_the_named_map() {
    for name in [
        "viridis", "cividis", "magma", "inferno", "plasma", "RdBu", "RdBu_r", "PuOr",
    ] {
        let lines = "line_opacity = 0, zero_width = 0, color_scale = 1";
        let source = format!("show levels(x + 0 y) {{ palette = {name}, {lines} }}");
        let value = |x: f64| mapped(name, 0.5 + 0.5 * x / x.hypot(1.0));
        let Some(off) = worst(&source, CAMERA, |[x, _]| value(x)) else {
            return;
        };
        assert!(off < 1e-4, "{name}: {off}");
        // far beyond the scale: the ends of the map
        let source = format!(
            "show logcontours(1e30 sign(x) + 0 y) {{ palette = {name}, line_opacity = 0 }}"
        );
        let ends = |[x, _]: [f64; 2]| mapped(name, if x < 0.0 { 0.0 } else { 1.0 });
        let off = worst(&source, CAMERA, ends).expect("a device");
        assert!(off < 2e-3, "{name}: {off}");
    }
}

#[test]
fn arguments_have_the_colours_of_the_named_map() {
    let plain = "palette = twilight, rings = none, fade_octaves = 1e30";
    let source = format!("f(z) = exp(2i re(z))\nshow domain(f) {{ {plain} }}");
    let turns = |x: f64| (x / std::f64::consts::PI).rem_euclid(1.0);
    // however far away black and white are, 1/65 of 88 % of both is there
    let far = 0.88_f64 / 65.0;
    let wanted =
        |[x, _]: [f64; 2]| mapped("twilight", turns(x)).map(|c| c * (1.0 - far).powi(2) + far);
    let Some(off) = worst(&source, CAMERA, wanted) else {
        return;
    };
    assert!(off < 1e-4, "{off}");
}

/// The tables are settings: a module holds none, and what a program names is in its settings alone.
#[test]
fn a_module_holds_no_map_and_the_settings_the_one_that_is_named() {
    for (scene, formula, first, second) in [
        ("levels", "x y", "viridis", "RdBu"),
        ("bands", "x y", "magma", "cividis"),
        ("slices", "x y z", "PuOr", "plasma"),
        ("nested", "x y z", "PuOr", "plasma"),
        ("domain", "f(z) = z^2", "twilight", "cubehelix"),
    ] {
        let built = |palette: &str| {
            let text = match formula.strip_prefix("f(z)") {
                Some(_) => format!("{formula}\nshow {scene}(f) {{ palette = {palette} }}"),
                None => format!("show {scene}({formula}) {{ palette = {palette} }}"),
            };
            let compiled = pullback_compiler::compile(&text);
            let program = compiled.program.expect("a program");
            let module = program
                .scene_module(0, Precision::Accurate)
                .expect("a scene");
            let bytes = module.pack_settings(&program.pictures()[0].settings);
            (format!("{:?}", module.module), bytes)
        };
        let ((one, with_first), (other, with_second)) = (built(first), built(second));
        assert_eq!(one, other, "{scene}: a palette changes the module");
        let literal = |name: &str| {
            let part = colour_map(name)?[40][0] as f32;
            Some(one.contains(&format!("F32({part:?})")))
        };
        assert_ne!(literal(first), Some(true), "{scene} holds {first}");
        let holds = |bytes: &[u8], name: &str| {
            let table = colour_map(name)?;
            let entry: Vec<u8> = table[40]
                .iter()
                .flat_map(|c| (*c as f32).to_le_bytes())
                .collect();
            Some(bytes.windows(entry.len()).any(|w| w == entry))
        };
        assert_eq!(holds(&with_first, first), Some(true), "{scene}");
        assert_eq!(holds(&with_second, first), Some(false), "{scene}");
        assert_ne!(holds(&with_second, second), Some(false), "{scene}");
    }
}

/// What those see who lack the cones for long or for medium waves, linear rgb: severity 1 of G. M. Machado, M. M. Oliveira
/// and L. A. F. Fernandes, "A physiologically-based model for simulation of color vision deficiency", IEEE TVCG 15, 2009.
const PROTANOPIA: [Rgb; 3] = [
    [0.152_286, 1.052_583, -0.204_868],
    [0.114_503, 0.786_281, 0.099_216],
    [-0.003_882, -0.048_116, 1.051_998],
];
const DEUTERANOPIA: [Rgb; 3] = [
    [0.367_322, 0.860_646, -0.227_968],
    [0.280_085, 0.672_501, 0.047_413],
    [-0.011_820, 0.042_940, 0.968_881],
];
const TRITANOPIA: [Rgb; 3] = [
    [1.255_528, -0.076_749, -0.178_779],
    [-0.078_411, 0.930_809, 0.147_602],
    [0.004_733, 0.691_367, 0.303_900],
];
const NORMAL: [Rgb; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn seen_by(eyes: &[Rgb; 3], colour: Rgb) -> Rgb {
    eyes.map(|row| {
        (0..3)
            .map(|k| row[k] * colour[k])
            .sum::<f64>()
            .clamp(0.0, 1.0)
    })
}

/// CIELAB under D65 (CIE 15), from linear rgb.
fn lab([r, g, b]: Rgb) -> Rgb {
    let xyz = [
        (0.412_456_4 * r + 0.357_576_1 * g + 0.180_437_5 * b) / 0.950_47,
        0.212_672_9 * r + 0.715_152_2 * g + 0.072_175 * b,
        (0.019_333_9 * r + 0.119_192 * g + 0.950_304_1 * b) / 1.088_83,
    ];
    let [x, y, z] = xyz.map(|t| {
        if t > 216.0 / 24389.0 {
            t.cbrt()
        } else {
            (24389.0 / 27.0 * t + 16.0) / 116.0
        }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn apart(a: Rgb, b: Rgb) -> f64 {
    let (a, b) = (lab(a), lab(b));
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// The least distance in CIELAB of any two of nine colours at even distances.
fn least(colours: &[Rgb], eyes: &[Rgb; 3]) -> f64 {
    let mut least = f64::INFINITY;
    for (k, &a) in colours.iter().enumerate() {
        for &b in &colours[..k] {
            least = least.min(apart(seen_by(eyes, a), seen_by(eyes, b)));
        }
    }
    least
}

/// A distance of 2.3 in CIELAB is just noticeable (M. Mahy, L. Van Eycken and A. Oosterlinck, 1994). Any two of nine colours
/// of the default map are at least five times as far apart, of the others three times, with and without red or green cones.
#[test]
fn maps_are_told_apart_without_red_or_green_cones() {
    let Some(gpu) = suite_gpu() else { return };
    let places: Vec<f64> = (0..9).map(|k| f64::from(k) / 8.0).collect();
    // the default map is the shader's: x in its middle column shows each place
    let lines = "line_opacity = 0, zero_width = 0, color_scale = 1";
    let ramp = |palette: &str| -> Vec<Rgb> {
        let shown = |u: &f64| {
            let t = (2.0 * u - 1.0) * 0.999_9;
            let value = t / (1.0 - t * t).sqrt();
            let source = format!("show levels({value} + 0 x y) {{ palette = {palette}, {lines} }}");
            Picture::draw(&gpu, &source, CAMERA).linear(32, 4)
        };
        places.iter().map(shown).collect()
    };
    for (palette, bound) in [
        ("diverging", 11.5),
        ("sequential", 6.9),
        ("viridis", 6.9),
        ("cividis", 6.9),
        ("RdBu", 6.9),
        ("PuOr", 6.9),
    ] {
        let colours = ramp(palette);
        let all = [&NORMAL, &PROTANOPIA, &DEUTERANOPIA, &TRITANOPIA].map(|e| least(&colours, e));
        println!("{palette}: normal, protanopia, deuteranopia, tritanopia: {all:.1?}");
        for (eyes, least) in ["normal", "protanopia", "deuteranopia"].iter().zip(all) {
            assert!(least > bound, "{palette}, {eyes}: {least}");
        }
    }
}
