// Complex values as colour: hue by argument, light by modulus.

// How `domain_colour` looks; each member is a setting of the scenes that draw with it.
struct PhaseStyle {
    palette: u32,       // 0 cubehelix rainbow, 1 OKLCH wheel, 2 HSV wheel, 3 a named map
    modulus: f32,       // |f| that is neither darkened nor lightened, on a ring
    rings: u32,         // 0 none, 1 waves, 2 steps
    ring_depth: f32,    // contrast of rings and phase steps
    ring_octaves: f32,  // octaves from ring to ring
    fade_octaves: f32,  // octaves from `modulus` to where the colour is half black or white
    phase_steps: u32,   // steps of brightness in a turn; 0: none
}

fn wheel_colour(turns: f32, palette: u32) -> vec3f {
    switch palette {
        case 1u: { return oklch_wheel(turns); }
        case 2u: { return hsv_wheel(turns); }
        case 3u: { return mapped_colour(turns - floor(turns)); }
        default: { return cubehelix_rainbow(turns); }
    }
}

// Mean colour of the wheel over a window in turns, at most a whole one: of its parts of at most 0.04 turns in their middles, up to
// eight of them. Over a whole turn the evenly spaced rule is exact, so that unresolved hue is one calm grey.
fn mean_wheel_colour(turns: f32, window: f32, palette: u32) -> vec3f {
    if window < 0.04 {
        return wheel_colour(turns, palette);
    }
    let w = min(window, 1.0);
    let parts = select(select(8.0, 4.0, w < 0.16), 2.0, w < 0.08);
    let share = 1.0 / parts;
    var sum = vec3f();
    for (var k = 0.5; k < parts; k += 1.0) {
        sum += wheel_colour(turns + w * (k * share - 0.5), palette);
    }
    return sum * share;
}

// Brightness of the rings, 1 at their lightest.
fn ring_light(octaves: f32, rate: f32, style: PhaseStyle) -> f32 {
    let period = max(style.ring_octaves, 1e-6);
    let u = octaves / period;
    let window = rate * sample_window() / period;
    switch style.rings {
        case 0u: { return 1.0; }
        case 1u: { return 1.0 - style.ring_depth * (1.0 - wave_train(u, window)); }
        default: { return 1.0 - style.ring_depth * (1.0 - saw_train(u, window)); }
    }
}

fn phase_light(turns: f32, rate: f32, style: PhaseStyle) -> f32 {
    if style.phase_steps == 0u {
        return 1.0;
    }
    let steps = f32(style.phase_steps);
    return 1.0 - style.ring_depth * (1.0 - saw_train(turns * steps, rate * steps * sample_window()));
}

// How steeply an exponential rise over `fade` octaves goes from 0 to 1, smoothed over the octaves of one sample: the mean of
// a logistic over a window is nearly a wider logistic of the summed variance.
fn fade_steepness(rate: f32, fade: f32) -> f32 {
    let steepness = 6.0 / max(fade, 1e-3);
    let spread = steepness * min(rate, 1e4) * sample_window() / 6.283185307179586;
    return steepness * inverseSqrt(1.0 + spread * spread);
}

// How far the rise has come: 1/2 at `fade` octaves.
fn far_fade(octaves: f32, fade: f32, steepness: f32) -> f32 {
    return 1.0 / (1.0 + exp2(steepness * (fade - octaves)));
}

// Zeros towards black and poles towards white, up to 88 %, so that rings and hue still show.
fn blend_extremes(colour: vec3f, octaves: f32, rate: f32, fade: f32) -> vec3f {
    let steepness = fade_steepness(rate, fade);
    let darkened = colour * (1.0 - 0.88 * far_fade(-octaves, fade, steepness));
    return mix(darkened, vec3f(1.0), 0.88 * far_fade(octaves, fade, steepness));
}

// Contour lines of the argument, `count` in a turn; 0: none. Where they crowd they fade out.
fn phase_line_coverage(turns: f32, rate: f32, count: u32, width: f32) -> f32 {
    if count == 0u {
        return 0.0;
    }
    let lines = f32(count);
    let per_pixel = rate * lines;
    let duty = min(per_pixel * width, 1.0);
    let dimming = 1.0 - smoothstep(0.15, 0.6, duty);
    return line_train(turns * lines, duty, per_pixel * sample_window()) * dimming;
}

// A value of finite logarithm as a colour. Each pattern is its mean where it is finer than the pixel.
fn domain_colour(polar: Polar, style: PhaseStyle) -> vec3f {
    let octaves = polar.octaves - log2(max(style.modulus, 1e-37));
    let light = ring_light(octaves, polar.octave_rate, style) * phase_light(polar.turns, polar.turn_rate, style);
    let hue = mean_wheel_colour(polar.turns, polar.turn_rate * sample_window(), style.palette);
    return blend_extremes(hue * light, octaves, polar.octave_rate, style.fade_octaves);
}
