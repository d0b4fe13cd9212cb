// Real values as colours and lines.

// Level lines may darken an area by no more than this on average, however dense they are.
const DENSEST: f32 = 0.34;

// The real line onto (-1, 1): f/√(1 + f²) in units of `scale`.
fn saturate_value(value: f32, scale: f32) -> f32 {
    let x = clamp(value / scale, -1e18, 1e18);
    return x * inverseSqrt(1.0 + x * x);
}

// Colour of a saturated value in [-1, 1]: 0 blue-white-red, 1 indigo to cream, 2 paper, from 3 on a named map.
fn palette_colour(palette: u32, t: f32) -> vec3f {
    switch palette {
        case 1u: { return sequential_ramp(0.5 + 0.5 * t); }
        case 2u: { return vec3f(0.93, 0.92, 0.89) - 0.10 * max(-t, 0.0) * vec3f(1.0, 0.7, 0.45); }
        case 0u: { return diverging_ramp(t); }
        default: { return mapped_colour(0.5 + 0.5 * t); }
    }
}

// Colour of a value.
fn value_colour(palette: u32, value: f32, scale: f32) -> vec3f {
    return palette_colour(palette, saturate_value(value, scale));
}

// Mean colour where the value runs linearly over value ± reach. In units of `scale`: below 0.05 it is the colour in the middle,
// which is off by less than half a step of 8 bits, but where a map has a kink at 0; up to 0.15 two points: the middles of both
// sides of 0, if that is inside, else those of Gauss.
fn mean_value_colour(palette: u32, value: f32, reach: f32, scale: f32) -> vec3f {
    let x = clamp(value / scale, -1e18, 1e18);
    let r = reach / scale;
    if r < 0.05 {
        return value_colour(palette, x, 1.0);
    }
    if r < 0.15 {
        let is_split = abs(x) < r;
        let arm = select(0.5773502691896258, 0.5, is_split) * r;
        let middle = select(x, 0.5 * x, is_split);
        let share = select(0.5, 0.5 + 0.5 * x / r, is_split);
        return mix(value_colour(palette, middle - arm, 1.0), value_colour(palette, middle + arm, 1.0), share);
    }
    return coarse_mean_colour(palette, x, min(r, 1e18));
}

// The part beyond ±8 has the end colours; the rest is integrated by the four-point Gauss rule.
fn coarse_mean_colour(palette: u32, x: f32, r: f32) -> vec3f {
    let low = clamp(x - r, -8.0, 8.0);
    let high = clamp(x + r, -8.0, 8.0);
    let below = clamp((-8.0 - (x - r)) / (2.0 * r), 0.0, 1.0);
    let above = clamp(((x + r) - 8.0) / (2.0 * r), 0.0, 1.0);
    let middle = 0.5 * (low + high);
    let arm = 0.5 * (high - low);
    var inner = vec3f();
    for (var k = 0u; k < 4u; k++) {
        let node = select(0.3399810435848563, 0.8611363115940526, k > 1u) * select(1.0, -1.0, (k & 1u) == 0u);
        let weight = select(0.3260725774312731, 0.1739274225687269, k > 1u);
        inner += weight * value_colour(palette, middle + node * arm, 1.0);
    }
    if below + above == 0.0 {
        return inner;
    }
    return below * palette_colour(palette, -1.0) + above * palette_colour(palette, 1.0) + max(1.0 - below - above, 0.0) * inner;
}

// Coverage by lines at the integers of u, `per_pixel` to a pixel and `apart` = 1/`per_pixel` pixels from one another.
fn level_lines(u: f32, per_pixel: f32, apart: f32, width: f32) -> f32 {
    let away = abs(offset_from_integer(u)) * apart;
    if (apart > max(width / DENSEST, width + sample_window())) & (abs(u) < 4194304.0) {
        // none is dimmed, and no sample sees two
        return coverage_of_line(away, width);
    }
    let dimming = min(DENSEST / max(width, 1e-20) * apart, 1.0);
    let covered = coverage_of_lines(away, apart, per_pixel, width);
    // past 2²² spacings f32 no longer resolves the place between two lines
    return select(covered, min(per_pixel * width, 1.0), abs(u) > 4194304.0) * dimming;
}

// Contour lines of a value.
struct Contours {
    spacing: f32,     // value between lines
    width: f32,       // pixels
    zero_width: f32,  // pixels, of the line f = 0
    opacity: f32,     // of the lines but the zero line
    major: u32,       // every how many lines one is stronger; 0: none
}

// All lines together, as opacity of the ink. The line f = 0 fades where several level lines share a pixel: a zero cannot
// be told from a pole there.
fn contour_opacity(value: f32, rate: f32, contours: Contours) -> f32 {
    if rate <= 0.0 {
        return 0.0;
    }
    return opacity_of_lines(value, rate, contours);
}

// The same of a value that changes.
fn opacity_of_lines(value: f32, rate: f32, contours: Contours) -> f32 {
    let u = value / contours.spacing;
    let per_pixel = clamp(rate / contours.spacing, 1e-30, 1e9);
    let apart = 1.0 / per_pixel;
    var opacity = contours.opacity * level_lines(u, per_pixel, apart, contours.width);
    if contours.major > 0u {
        let every = f32(contours.major);
        let strong = level_lines(u / every, per_pixel / every, apart * every, 1.5 * contours.width);
        opacity = max(opacity, min(1.5 * contours.opacity, 1.0) * strong);
    }
    let zero = coverage_of_line(min(abs(u) * apart, 1e9), contours.zero_width);
    return max(opacity, zero * (1.0 - smoothstep(1.0, 4.0, per_pixel)));
}

// A picture of a value by colour and lines: undefined values hatched, infinite ones in the end colours and hatched the
// other way. `rate` is the change of value per pixel, negative where it is not
// known.
fn contour_colour(value: f32, rate: f32, palette: u32, scale: f32, contours: Contours, ink: vec3f, pixel: vec2f) -> vec3f {
    if !is_finite(value) | (rate <= 0.0) {
        return still_colour(value, palette, scale, pixel);
    }
    let colour = mean_value_colour(palette, value, 0.5 * rate * sample_window(), scale);
    return mix(colour, ink, opacity_of_lines(value, rate, contours));
}

// Of a value that is no number, or does not change, or of which it is not known how it does.
fn still_colour(value: f32, palette: u32, scale: f32, pixel: vec2f) -> vec3f {
    if is_nan(value) {
        return undefined_colour(pixel);
    }
    if is_inf(value) {
        return infinite_colour(pixel, palette_colour(palette, sign(value)));
    }
    return value_colour(palette, value, scale);
}
